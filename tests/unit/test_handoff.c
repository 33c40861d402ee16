/* The two hand-offs as far as one context can see them; platform_host.c and the system tests interrupt them. */
#include "base/handoff.h"

#include "tap.h"
#include "tests.h"

struct set {
    uint32_t words[5];
};

static struct set set_of(uint32_t number)
{
    struct set set;

    for (uint32_t i = 0u; i < 5u; i++) {
        set.words[i] = number + i;
    }
    return set;
}

static bool is_set(const struct set *set, uint32_t number)
{
    bool ok = true;

    for (uint32_t i = 0u; i < 5u; i++) {
        ok = ok && set->words[i] == number + i;
    }
    return ok;
}

static void check_handoff(void)
{
    struct set storage;
    struct set value = set_of(1u);
    struct set out = set_of(99u);
    struct handoff handoff;

    handoff_init(&handoff, &storage, sizeof(storage));
    tap_check(!handoff_read(&handoff, &out) && is_set(&out, 99u), "before the first write there is no value");
    handoff_write(&handoff, &value);
    tap_check(handoff_read(&handoff, &out) && is_set(&out, 1u), "the value written is read");
    tap_check(handoff_read(&handoff, &out) && is_set(&out, 1u), "and read again");
    for (uint32_t i = 2u; i < 10u; i++) {
        value = set_of(i);
        handoff_write(&handoff, &value);
    }
    tap_check(handoff_read(&handoff, &out) && is_set(&out, 9u), "of many values the latest is read");
    tap_check(handoff.sequence == 18u, "the counter moves twice for each write and rests even");

    handoff.sequence = UINT32_MAX - 1u; /* as after a long run */
    value = set_of(50u);
    handoff_write(&handoff, &value);
    tap_check(handoff_read(&handoff, &out) && is_set(&out, 50u), "a counter that wraps does not look like no value");
}

static void check_publish(void)
{
    struct set storage[2] = {set_of(0u), set_of(0u)};
    struct publish publish;
    struct set *back;
    const struct set *live;

    publish_init(&publish, storage, sizeof(storage[0]));
    tap_check(publish_take(&publish) == NULL && publish_taken(&publish) == 0u, "at first there is nothing to take");
    back = publish_back(&publish);
    tap_check(back != NULL && publish_back(&publish) == back, "main gets a buffer, the same until it commits");
    *back = set_of(10u);
    tap_check(publish_take(&publish) == NULL, "what is not committed cannot be taken");
    tap_check(publish_commit(&publish) == 1u, "the first generation is 1");
    tap_check(publish_back(&publish) == NULL, "main gets no buffer before the interrupt has taken this one");
    live = publish_take(&publish);
    tap_check(live != NULL && is_set(live, 10u) && publish_taken(&publish) == 1u, "the interrupt takes it and says so");
    tap_check(publish_take(&publish) == NULL, "and takes it once");
    back = publish_back(&publish);
    tap_check(back != NULL && back != live, "main then gets the other buffer");
    *back = set_of(20u);
    tap_check(is_set(live, 10u), "while the live one stays as it is");
    tap_check(publish_commit(&publish) == 2u && publish_taken(&publish) == 1u, "a commit alone changes nothing taken");
    live = publish_take(&publish);
    tap_check(live == back && is_set(live, 20u) && publish_taken(&publish) == 2u, "the second set follows");
}

static void check_publish_wrap(void)
{
    struct set storage[2];
    struct publish publish;
    bool ok = true;

    publish_init(&publish, storage, sizeof(storage[0]));
    publish.generation = UINT32_MAX - 2u; /* as after a long run */
    publish.taken = UINT32_MAX - 2u;
    for (uint32_t i = 0u; i < 6u; i++) {
        struct set *back = publish_back(&publish);
        const struct set *live;

        ok = ok && back != NULL;
        if (!ok) {
            break;
        }
        *back = set_of(i);
        (void)publish_commit(&publish);
        live = publish_take(&publish);
        ok = live != NULL && is_set(live, i) && publish_taken(&publish) == UINT32_MAX - 1u + i;
    }
    tap_check(ok, "generations go on across the wrap at 2^32");
}

void test_handoff(void)
{
    check_handoff();
    check_publish();
    check_publish_wrap();
}
