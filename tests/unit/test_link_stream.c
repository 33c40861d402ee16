/* The link's samples: whole, in order, and every lost one seen. */
#include "base/fmath.h"
#include "controller.h"
#include "protocol/signals.h"
#include "tap.h"
#include "tests.h"

static uint32_t offered, sent, dropped, waiting;

static void say_stream(uint32_t signals, uint32_t every)
{
    say(LINK_STREAM, 1u, 0u);
    bytes_put_u32(&fields, signals);
    bytes_put_u32(&fields, every);
}

static bool step(uint16_t sequence, uint32_t count)
{
    say(LINK_STEP, sequence, (uint32_t)bench.executive.sim.step);
    bytes_put_u32(&fields, count);
    bytes_put_u16(&fields, 0u);
    bytes_put_u64(&fields, 0u);
    return is_answered();
}

static void count_samples(void)
{
    (void)is_done(LINK_STATUS);
    (void)bytes_get_block(&answer, 29u + 12u * 4u);
    offered = bytes_get_u32(&answer);
    sent = bytes_get_u32(&answer);
    dropped = bytes_get_u32(&answer);
    waiting = bytes_get_u32(&answer);
}

/* Numbers and steps of the samples since index, each number being the place of its step. */
static bool is_in_order(size_t index, uint32_t every)
{
    const uint32_t first = bench_samples[index].step - bench_samples[index].sequence * every;
    bool ok = true;

    for (size_t i = index; i < bench_sample_count; i++) {
        ok = ok && bench_samples[i].step == first + bench_samples[i].sequence * every;
        ok = ok && (i == index || bench_samples[i].sequence > bench_samples[i - 1u].sequence);
    }
    return ok;
}

static void check_samples(void)
{
    struct bytes_reader sample;

    say_stream(1u << SIGNAL_X | 1u << SIGNAL_N | 1u << SIGNAL_HASH, 10u);
    tap_check(is_answered() && bytes_get_u32(&answer) == 10u && bytes_get_u32(&answer) > 0u &&
                  bytes_get_u16(&answer) == 25u && bytes_is_spent(&answer),
              "a stream, and what it costs");
    tap_check(step(1u, 1005u) && bench_sample_count == 100u, "all samples of a STEP come before its reply");
    tap_check(bench_samples[0].sequence == 0u && bench_samples[99].sequence == 99u && bench_samples[99].step == 1000u &&
                  is_in_order(0u, 10u),
              "numbered from 0");
    sample = (struct bytes_reader){.bytes = bench_samples[99].payload, .size = bench_samples[99].size};
    (void)bytes_get_f32(&sample);
    tap_check(bytes_get_f32(&sample) > 0.0f && bytes_get_u32(&sample) != 0u && bytes_is_spent(&sample),
              "each with its signals in the order of their bits");
    count_samples();
    tap_check(offered == 100u && sent == 100u && dropped == 0u && waiting == 0u, "and counted");
    tap_check(step(2u, 100000u), "more than fit between interrupt and main");
    count_samples();
    tap_check(offered == 10100u && sent == 10100u, "none of which is lost: who grants steps waits for them");
}

static void check_reader_that_stops(void)
{
    bool is_busy;

    bench_sample_count = 0u;
    say_stream(1u << SIGNAL_X, 1u);
    (void)is_answered();
    tap_check(is_done(LINK_RUN), "free run");
    bench_link_is_read = false;
    bench_wait(2000u);
    tap_check(bench.executive.samples.dropped > 500u, "nobody reads");
    say(LINK_STOP, 1u, 0u);
    tap_check(!bench_ask(&request, &reply, 5u) && !executive_wants_tick(&bench.executive), "a STOP acts all the same");
    (void)bench_turn("", 0u, SIZE_MAX, &is_busy);
    tap_check(is_busy, "nobody sleeps while samples wait");
    bench_link_is_read = true;
    tap_check(bench_link_turns(NULL, 0u, 2000u, &reply) && reply.type == LINK_STOP + LINK_REPLY,
              "then somebody reads, and it is answered");
    count_samples();
    tap_check(offered == bench.executive.sim.step - (bench_samples[0].step - 1u) && offered == sent + dropped &&
                  waiting == 0u && sent == bench_sample_count && dropped > 500u,
              "offered is sent and dropped, exactly");
    tap_check(is_in_order(0u, 1u), "and each gap shows");
}

static void check_one_stream(void)
{
    say_stream(1u << SIGNAL_X, 1u);
    tap_check(is_answered(), "the link streams");
    tap_check(bench_starts(bench_say("stream csv\r"), "error busy stream: the link streams"), "the console may not");
    tap_check(bench_starts(bench_say("step 2000\r"), "ok step"), "but step: it does not wait for the link's reader");
    say_stream(0u, 0u);
    tap_check(is_answered() && bytes_get_u32(&answer) == 0u, "off");
    bench_wait(3u);
    tap_check(bench_starts(bench_say("stream csv\r"), "ok stream csv"), "then it may");
    say_stream(1u, 1u);
    tap_check(is_refused(ERROR_BUSY, LINK_NO_INDEX, 0u), "and the link may not");
    say_stream(0u, 0u);
    tap_check(is_answered() && bench.executive.in_force.sample_every != 0u, "nor end what is the console's");
    (void)bench_say("stream off\r");
    say_stream(1u << SIGNAL_COUNT, 1u);
    tap_check(is_refused(ERROR_OUT_OF_RANGE, 0u, 0u) && has_range(0.0f, (float)((1u << SIGNAL_COUNT) - 1u)),
              "no such signal");
    say_stream(1u, 1000000001u);
    tap_check(is_refused(ERROR_OUT_OF_RANGE, 1u, 0u) && has_range(0.0f, 1e9f), "too seldom");
}

void test_link_stream(void)
{
    bench_open();
    (void)load_preset("brake", 5u);
    (void)bench_say("set substeps 16\r");
    check_samples();
    check_reader_that_stops();
    check_one_stream();
}
