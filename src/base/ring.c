#include "base/ring.h"

#include "base/assert.h"
#include "base/compiler.h"
#include "base/mem.h"

void ring_init(struct ring *ring, void *storage, size_t record_size, uint32_t capacity)
{
    BASE_ASSERT(capacity != 0u && (capacity & (capacity - 1u)) == 0u);
    ring->records = storage;
    ring->record_size = record_size;
    ring->capacity = capacity;
    ring->head = 0u;
    ring->tail = 0u;
    ring->dropped = 0u;
}

bool ring_push(struct ring *ring, const void *record)
{
    void *const place = ring_reserve(ring);

    if (place == NULL) {
        return false;
    }
    memcpy(place, record, ring->record_size);
    ring_commit(ring);
    return true;
}

bool ring_pop(struct ring *ring, void *record)
{
    const uint32_t tail = ring->tail;

    if (tail == ring->head) {
        return false;
    }
    BASE_BARRIER();
    memcpy(record, ring_slot(ring, tail), ring->record_size);
    BASE_BARRIER();
    ring->tail = tail + 1u;
    return true;
}
