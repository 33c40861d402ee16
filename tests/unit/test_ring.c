/* The ring: order, limits, losses, and indices that wrap. */
#include "base/ring.h"

#include "tap.h"
#include "tests.h"

enum { CAPACITY = 4 };

struct record {
    uint32_t a;
    uint16_t b;
    uint8_t c;
};

static struct record record_of(uint32_t number)
{
    const struct record record = {number, (uint16_t)(number * 3u), (uint8_t)(number * 7u)};

    return record;
}

static bool pops(struct ring *ring, uint32_t number)
{
    const struct record expected = record_of(number);
    struct record record;

    return ring_pop(ring, &record) && record.a == expected.a && record.b == expected.b && record.c == expected.c;
}

static bool pushes(struct ring *ring, uint32_t number)
{
    const struct record record = record_of(number);

    return ring_push(ring, &record);
}

static void check_limits(void)
{
    struct record storage[CAPACITY + 1];
    struct ring ring;
    struct record untouched = record_of(99u);

    storage[CAPACITY] = record_of(77u);
    ring_init(&ring, storage, sizeof(storage[0]), CAPACITY);
    tap_check(ring_fill(&ring) == 0u && !ring_pop(&ring, &untouched) && untouched.a == 99u,
              "an empty ring gives nothing and leaves the record alone");
    for (uint32_t i = 0u; i < CAPACITY; i++) {
        (void)pushes(&ring, i);
    }
    tap_check(ring_fill(&ring) == CAPACITY && ring.dropped == 0u, "it takes as many records as it has room for");
    tap_check(!pushes(&ring, 100u) && !pushes(&ring, 101u) && ring.dropped == 2u,
              "a full ring refuses the newest and counts it");
    tap_check(pops(&ring, 0u) && pops(&ring, 1u) && pops(&ring, 2u) && pops(&ring, 3u) && !ring_pop(&ring, &untouched),
              "the oldest come out first, all bytes of them, and none of the refused");
    tap_check(storage[CAPACITY].a == 77u, "nothing is written behind the storage");
}

static void check_wrap(void)
{
    struct record storage[CAPACITY];
    struct ring ring;
    bool ok = true;

    ring_init(&ring, storage, sizeof(storage[0]), CAPACITY);
    ring.head = UINT32_MAX - 5u; /* as after a long run */
    ring.tail = UINT32_MAX - 5u;
    for (uint32_t i = 0u; i < 20u; i++) {
        ok = ok && pushes(&ring, 2u * i) && pushes(&ring, 2u * i + 1u) && ring_fill(&ring) == 2u;
        ok = ok && pops(&ring, 2u * i) && pops(&ring, 2u * i + 1u) && ring_fill(&ring) == 0u;
    }
    tap_check(ok && ring.head < 100u, "records pass unharmed while the indices wrap at 2^32");

    ring.head = 1u;
    ring.tail = UINT32_MAX - 2u;
    tap_check(ring_fill(&ring) == CAPACITY && !pushes(&ring, 0u), "a ring that is full across the wrap is full");
}

void test_ring(void)
{
    check_limits();
    check_wrap();
}
