/* Steps over the link: exactly as many as were asked for, once each, whatever is repeated, lost or late. */
#include "base/fmath.h"
#include "base/mem.h"
#include "controller.h"
#include "plants.h"
#include "protocol/signals.h"
#include "tap.h"
#include "tests.h"

enum { REPLY_FLAGS = 44 };

static void say_step(uint16_t sequence, uint32_t step, uint32_t count)
{
    say(LINK_STEP, sequence, step);
    bytes_put_u32(&fields, count);
    bytes_put_u8(&fields, INPUT_LOAD_KEEP);
    bytes_put_u8(&fields, INPUT_SPEED_KEEP);
    bytes_put_f32(&fields, 0.0f);
    bytes_put_f32(&fields, 0.0f);
}

/* Steps with a demand. */
static void say_demand(uint16_t sequence, uint32_t step, uint8_t load, float load_value, uint8_t speed,
                       float speed_value)
{
    say(LINK_STEP, sequence, step);
    bytes_put_u32(&fields, 1u);
    bytes_put_u8(&fields, load);
    bytes_put_u8(&fields, speed);
    bytes_put_f32(&fields, load_value);
    bytes_put_f32(&fields, speed_value);
}

static void say_input(uint64_t at, uint8_t load, float newton)
{
    say(LINK_INPUT, 1u, 0u);
    bytes_put_u64(&fields, at);
    bytes_put_u8(&fields, load);
    bytes_put_u8(&fields, INPUT_SPEED_KEEP);
    bytes_put_f32(&fields, newton);
    bytes_put_f32(&fields, 0.0f);
}

static bool stepped_to(uint64_t step)
{
    return is_answered() && reply.step == (uint32_t)step && bytes_get_u64(&answer) == step &&
           bench.executive.sim.step == step;
}

static void hello(void)
{
    say(LINK_HELLO, 1u, 0u);
    bytes_put_u8(&fields, LINK_MAJOR);
    bytes_put_u8(&fields, LINK_MINOR);
    (void)is_answered();
}

static void open_brake(void)
{
    bench_open();
    (void)load_preset("brake", 5u);
}

static void check_reply(void)
{
    const struct executive_report *report = &bench.executive.report_store;
    const struct scale *scale;
    bool ok = true;

    open_brake();
    say_step(1u, 0u, 1000u);
    tap_check(stepped_to(1000u), "a thousand steps");
    scale = &executive_plan(&bench.executive)->scale;
    ok = bytes_get_u32(&answer) == report->now.hash;
    for (unsigned i = SIGNAL_X; i <= SIGNAL_F; i++) {
        ok = ok && bytes_get_u32(&answer) == signals_word((enum signal)i, &report->now, scale);
    }
    ok = ok && bytes_get_u32(&answer) == signals_word(SIGNAL_V0, &report->now, scale);
    tap_check(ok, "hash and state in SI");
    ok = bytes_get_u8(&answer) == (uint8_t)report->now.mode && bytes_get_u8(&answer) == report->now.propensity;
    ok = ok && bytes_get_u8(&answer) == report->verdict.motion && bytes_get_u8(&answer) == report->verdict.period;
    tap_check(ok && bytes_get_u8(&answer) == 0u && bytes_is_spent(&answer), "mode and verdict");
}

static void check_sequence(void)
{
    static struct bench_frame first;

    open_brake();
    say_step(65535u, 0u, 10u);
    tap_check(stepped_to(10u), "any number starts the count");
    first = reply;
    tap_check(is_answered() && memcmp(&first, &reply, sizeof reply) == 0 && bench.executive.sim.step == 10u,
              "the same again is answered from memory and not stepped");
    say_step(65535u, 0u, 11u);
    tap_check(is_refused(ERROR_BAD_SEQUENCE, LINK_NO_INDEX, 0u), "the same number with something else");
    say_step(1u, 10u, 10u);
    tap_check(is_refused(ERROR_BAD_SEQUENCE, LINK_NO_INDEX, 0u), "and a gap are refused");
    say_step(0u, 9u, 10u);
    tap_check(is_refused(ERROR_BAD_STEP, LINK_NO_INDEX, 10u), "and so is a stale step");
    say_step(0u, 10u, 10u);
    tap_check(stepped_to(20u), "none of them counts");
    tap_check(is_done(LINK_RUN) && is_done(LINK_STOP) && bytes_get_u64(&answer) > 20u, "after a free run");
    say_step(0u, 10u, 10u);
    tap_check(is_answered() && reply.step == 20u, "the last is still answered as it was");
    hello();
    say_step(0u, 10u, 10u);
    tap_check(is_refused(ERROR_BAD_STEP, LINK_NO_INDEX, (uint32_t)bench.executive.sim.step), "a HELLO forgets it");
    tap_check(is_done(LINK_RESET), "a reset");
    say_step(77u, 0u, 10u);
    tap_check(stepped_to(10u), "starts the count");
    (void)bench_say("reset\r");
    tap_check(stepped_to(10u), "and so does one by the console");
}

static void check_fields(void)
{
    open_brake();
    say_step(1u, 0u, 0u);
    tap_check(is_refused(ERROR_OUT_OF_RANGE, 0u, 0u) && has_range(1.0f, 1e6f), "no step at all");
    say_step(1u, 0u, 1000001u);
    tap_check(is_refused(ERROR_OUT_OF_RANGE, 0u, 0u), "too many");
    say_demand(1u, 0u, 4u, 0.0f, 0u, 0.0f);
    tap_check(is_refused(ERROR_OUT_OF_RANGE, 1u, 0u) && has_range(0.0f, 3.0f), "no such force");
    say_demand(1u, 0u, 0u, 0.0f, 4u, 0.0f);
    tap_check(is_refused(ERROR_OUT_OF_RANGE, 2u, 0u) && has_range(0.0f, 3.0f), "no such speed");
    say_demand(1u, 0u, INPUT_LOAD_FORCE, fmath_from_bits(0x7f800000u), 0u, 0.0f);
    tap_check(is_refused(ERROR_BAD_NUMBER, 3u, 0u), "an endless force");
    say_demand(1u, 0u, INPUT_LOAD_FORCE, 1.0f, INPUT_SPEED_DISC, fmath_from_bits(0x7fc00000u));
    tap_check(is_refused(ERROR_BAD_NUMBER, 4u, 0u), "a speed that is no number");
    tap_check(bench.executive.sim.step == 0u && ring_fill(&bench.executive.inputs) == 0u, "nothing of it happens");
    say_demand(1u, 0u, INPUT_LOAD_FORCE, 1e9f, INPUT_SPEED_KEEP, fmath_from_bits(0x7fc00000u));
    tap_check(stepped_to(1u) && reply.payload[REPLY_FLAGS] == LINK_WAS_CLAMPED,
              "a limit is told; what is not used is not looked at");
    say_input(5u, INPUT_LOAD_KEEP, 1.0f);
    tap_check(is_refused(ERROR_USAGE, LINK_NO_INDEX, 0u), "an input that asks for nothing");
    say_input(5u, 9u, 1.0f);
    tap_check(is_refused(ERROR_OUT_OF_RANGE, 1u, 0u), "or for what there is not");
    say_input(5u, INPUT_LOAD_FORCE, fmath_from_bits(0xff800000u));
    tap_check(is_refused(ERROR_BAD_NUMBER, 3u, 0u), "or is no number");
}

static float load_newton(void)
{
    return bench.executive.sim.f32.normal.n * executive_plan(&bench.executive)->scale.load_n;
}

static void check_inputs(void)
{
    bench_open();
    (void)bench_say("set N0 2 N_max 8 spp 128\r");
    say_input(5u, INPUT_LOAD_FORCE, 3.0f);
    tap_check(is_answered() && bytes_get_u8(&answer) == 0u && bytes_is_spent(&answer), "an input ahead of time");
    say_step(1u, 0u, 5u);
    tap_check(stepped_to(5u) && load_newton() == 2.0f, "the profile acts before");
    say_step(2u, 5u, 1u);
    tap_check(stepped_to(6u) && load_newton() == 3.0f, "its step has it");
    say_input(6u, INPUT_LOAD_FORCE, 4.0f);
    (void)is_answered();
    say_demand(3u, 6u, INPUT_LOAD_FORCE, 5.0f, INPUT_SPEED_KEEP, 0.0f);
    tap_check(stepped_to(7u) && load_newton() == 5.0f, "a STEP's own input is the last word on its step");
    for (unsigned i = 0u; i < INPUT_QUEUE_MAX; i++) {
        say_input(1000u + i, INPUT_LOAD_FORCE, 1.0f);
        (void)is_answered();
    }
    say_input(2000u, INPUT_LOAD_FORCE, 1.0f);
    tap_check(is_refused(ERROR_BUSY, LINK_NO_INDEX, 0u), "more than can wait for their steps");
    say_demand(4u, 7u, INPUT_LOAD_FORCE, 6.0f, INPUT_SPEED_KEEP, 0.0f);
    tap_check(stepped_to(8u) && load_newton() == 6.0f, "a STEP's input needs no place among them");
}

/* The hash after 4000 steps with eight demands: step by step in pieces, or ahead of time. */
static uint32_t hash_by(uint32_t piece, bool is_ahead)
{
    uint16_t sequence = 0u;

    open_brake();
    for (unsigned i = 0u; is_ahead && i < 8u; i++) {
        say_input(500u * i + 1u, INPUT_LOAD_FORCE, 1000.0f + 300.0f * (float)i);
        (void)is_answered();
    }
    for (uint32_t step = 0u; step < 4000u; sequence++) {
        const bool is_change = step % 500u == 1u;
        const uint32_t left = step % 500u == 0u ? 1u : 501u - step % 500u;
        uint32_t count = piece < left ? piece : left;

        count = count < 4000u - step ? count : 4000u - step;
        say(LINK_STEP, sequence, step);
        bytes_put_u32(&fields, count);
        bytes_put_u8(&fields, is_change && !is_ahead ? INPUT_LOAD_FORCE : INPUT_LOAD_KEEP);
        bytes_put_u8(&fields, INPUT_SPEED_KEEP);
        bytes_put_f32(&fields, 1000.0f + 300.0f * (float)(step / 500u));
        bytes_put_f32(&fields, 0.0f);
        if (!is_answered()) {
            return sequence;
        }
        step += count;
    }
    return bench.executive.sim.hash;
}

static void check_bits(void)
{
    const uint32_t truth = hash_by(1000u, true);

    tap_check(bench.executive.sim.step == 4000u, "the run is whole");
    tap_check(hash_by(1u, true) == truth && hash_by(1u, false) == truth && hash_by(7u, false) == truth,
              "step by step or ahead of time, the same bits");
}

static void check_states(void)
{
    open_brake();
    tap_check(is_done(LINK_RUN), "in free run");
    say_step(1u, 0u, 1u);
    tap_check(is_refused(ERROR_IS_RUNNING, LINK_NO_INDEX, 0u), "nothing is stepped");
    tap_check(is_done(LINK_RUN) && is_done(LINK_STOP) && is_done(LINK_STOP),
              "running twice and stopping twice is fine");
    (void)load_preset("fig7-ke5000", 11u);
    say_step(1u, 0u, 1000000u);
    tap_check(is_answered() && (reply.payload[REPLY_FLAGS] & LINK_IS_FAULT) != 0u &&
                  bench.executive.sim.step < 1000000u,
              "a plant that leaves its domain ends a STEP");
    say_step(2u, reply.step, 1u);
    tap_check(is_refused(ERROR_IN_FAULT, LINK_NO_INDEX, 0u), "and takes no other");
    say_input(0u, INPUT_LOAD_FORCE, 1.0f);
    tap_check(is_refused(ERROR_IN_FAULT, LINK_NO_INDEX, 0u), "nor an input");
    say(LINK_RUN, 1u, 0u);
    tap_check(is_refused(ERROR_IN_FAULT, LINK_NO_INDEX, 0u), "nor a run");
    say(LINK_COMMIT, 1u, 0u);
    fields.size = 5u;
    tap_check(!is_answered() && reply.type == LINK_ERROR, "nor a set");
    tap_check(is_done(LINK_RESET) && bench.executive.sim.fault == SIM_FAULT_NONE, "a reset leaves it");
}

/* The console has steps under way. */
static void check_console_at_work(void)
{
    static const char line[] = "step 1000000\r";
    bool is_busy;

    open_brake();
    (void)bench_turn(line, sizeof line - 1u, SIZE_MAX, &is_busy);
    bench_wait(3u);
    say_step(1u, 0u, 1u);
    tap_check(is_refused(ERROR_BUSY, LINK_NO_INDEX, 0u), "while the console steps the link does not");
    tap_check(is_done(LINK_STATUS), "but looks");
    bench_listen_anew();
    tap_check(is_done(LINK_STOP) && !executive_wants_tick(&bench.executive), "and stops");
    bench_wait(5u);
    tap_check(bench_starts(bench.last, "error stopped step="), "which the console is told");
    say_step(1u, (uint32_t)bench.executive.sim.step, 1u);
    tap_check(is_answered(), "then it is the link's turn");
}

/* The link has. */
static void check_link_at_work(void)
{
    static const char lines[] = "get N0\rstop\r";
    bool is_busy;

    open_brake();
    say_step(1u, 0u, 1000000u);
    request.size = fields.size;
    tap_check(!bench_ask(&request, &reply, 20u), "a long STEP");
    bench_listen_anew();
    (void)bench_turn(lines, sizeof lines - 1u, SIZE_MAX, &is_busy);
    tap_check(bench.oks == 0u, "the console waits");
    bench_wait(20u);
    tap_check(bench.oks == 2u && bench_starts(bench.last, "ok stop step="),
              "but not its stop: then its lines are answered");
    tap_check(is_answered() && reply.payload[REPLY_FLAGS] == LINK_WAS_CUT &&
                  reply.step == (uint32_t)bench.executive.sim.step && reply.step < 1000u,
              "for the STEP it was cut short, and says so if it is asked again");
}

/* The link has, and nobody reads its samples; the stop comes behind more lines than can wait. */
static void check_stuck(void)
{
    static const char stop[] = "stop\r";
    char lines[140u * 7u + sizeof stop];
    size_t taken = 0u;
    bool is_busy;

    for (unsigned i = 0u; i < 140u; i++) {
        memcpy(lines + (size_t)i * 7u, "get N0\r", 7u);
    }
    memcpy(lines + 140u * 7u, stop, sizeof stop);
    open_brake();
    say(LINK_STREAM, 1u, 0u);
    bytes_put_u32(&fields, 1u << SIGNAL_X);
    bytes_put_u32(&fields, 1u);
    (void)is_answered();
    bench_link_is_read = false;
    say_step(2u, (uint32_t)bench.executive.sim.step, 1000000u);
    request.size = fields.size;
    tap_check(!bench_ask(&request, &reply, 200u) && bench.turn.is_stuck, "a STEP whose samples nobody reads is stuck");
    bench_listen_anew();
    for (unsigned i = 0u; i < 2000u && taken < sizeof lines - 1u; i++) {
        taken += bench_turn(lines + taken, sizeof lines - 1u - taken, SIZE_MAX, &is_busy);
    }
    bench_wait(200u);
    tap_check(bench.oks == 141u && bench_starts(bench.last, "ok stop step=") && bench.turn.holder == TURN_NOBODY,
              "the console is not, however many lines stand before its stop");
}

void test_link_steps(void)
{
    check_reply();
    check_sequence();
    check_fields();
    check_inputs();
    check_bits();
    check_states();
    check_console_at_work();
    check_link_at_work();
    check_stuck();
}
