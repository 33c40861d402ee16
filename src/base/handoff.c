/* The counters are volatile and a barrier stands between each of them and the record it guards: that order is the whole
 * mechanism. */
#include "base/handoff.h"

#include "base/assert.h"
#include "base/compiler.h"
#include "base/mem.h"

void handoff_init(struct handoff *handoff, void *storage, size_t size)
{
    handoff->record = storage;
    handoff->size = size;
    handoff->sequence = 0u;
}

void *handoff_open(struct handoff *handoff)
{
    handoff->sequence = handoff->sequence + 1u;
    BASE_BARRIER();
    return handoff->record;
}

void handoff_close(struct handoff *handoff)
{
    const uint32_t sequence = handoff->sequence + 1u;

    BASE_BARRIER();
    /* After a wrap 0 would mean "no value yet". */
    handoff->sequence = sequence != 0u ? sequence : 2u;
}

void handoff_write(struct handoff *handoff, const void *value)
{
    memcpy(handoff_open(handoff), value, handoff->size);
    handoff_close(handoff);
}

bool handoff_read(const struct handoff *handoff, void *value)
{
    uint32_t sequence = handoff->sequence;

    if (sequence == 0u) {
        return false;
    }
    for (;;) {
        uint32_t after;

        BASE_BARRIER();
        memcpy(value, handoff->record, handoff->size);
        BASE_BARRIER();
        after = handoff->sequence;
        if (after == sequence && after % 2u == 0u) {
            return true;
        }
        sequence = after;
    }
}

uint32_t handoff_version(const struct handoff *handoff) { return handoff->sequence; }

static uint8_t *record_of(const struct publish *publish, uint32_t generation)
{
    return publish->records + (generation & 1u) * publish->record_size;
}

void publish_init(struct publish *publish, void *storage, size_t record_size)
{
    publish->records = storage;
    publish->record_size = record_size;
    publish->generation = 0u;
    publish->taken = 0u;
}

void *publish_back(struct publish *publish)
{
    const uint32_t generation = publish->generation;

    if (publish->taken != generation) {
        return NULL;
    }
    BASE_BARRIER();
    return record_of(publish, generation + 1u);
}

uint32_t publish_commit(struct publish *publish)
{
    const uint32_t generation = publish->generation + 1u;

    BASE_ASSERT(publish->taken + 1u == generation);
    BASE_BARRIER();
    publish->generation = generation;
    return generation;
}

const void *publish_take(struct publish *publish)
{
    const uint32_t generation = publish->generation;

    if (!publish_has_new(publish)) {
        return NULL;
    }
    BASE_BARRIER();
    publish->taken = generation;
    return record_of(publish, generation);
}

uint32_t publish_taken(const struct publish *publish) { return publish->taken; }
