/* Over the link: a controller that falls silent and how it comes back; a run that is taken away in pieces and put
 * back. */
#include "base/mem.h"
#include "controller.h"
#include "plants.h"
#include "tap.h"
#include "tests.h"

enum { REPLY_FLAGS = 44, STARTS = 0x80 };

enum { PIECES = (SNAPSHOT_SIZE + LINK_PIECE - 1) / LINK_PIECE };

static uint16_t sequence;

static void say_step(uint32_t count, uint8_t load, float newton)
{
    say(LINK_STEP, ++sequence, (uint32_t)bench.executive.sim.step);
    bytes_put_u32(&fields, count);
    bytes_put_u8(&fields, load);
    bytes_put_u8(&fields, INPUT_SPEED_KEEP);
    bytes_put_f32(&fields, newton);
    bytes_put_f32(&fields, 0.0f);
}

/* Flags of a STEP; 255 if it was refused. */
static uint8_t step(uint32_t count, uint8_t load, float newton)
{
    say_step(count, load, newton);
    if (!is_answered()) {
        sequence--;
        return 255u;
    }
    return reply.payload[REPLY_FLAGS];
}

static void say_input(float newton)
{
    say(LINK_INPUT, 1u, 0u);
    bytes_put_u64(&fields, INPUT_NOW);
    bytes_put_u8(&fields, INPUT_LOAD_FORCE);
    bytes_put_u8(&fields, INPUT_SPEED_KEEP);
    bytes_put_f32(&fields, newton);
    bytes_put_f32(&fields, 0.0f);
}

static bool status_is(uint8_t state, uint32_t stales, uint32_t safes)
{
    if (!is_done(LINK_STATUS)) {
        return false;
    }
    (void)bytes_get_block(&answer, 125u);
    return bytes_get_u8(&answer) == state && bytes_get_u32(&answer) == stales && bytes_get_u32(&answer) == safes;
}

/* At step 0; a step is 0.0538 s. */
static void open_watched(void)
{
    bench_open();
    (void)bench_say("set N0 2 N_max 8 spp 64 stale 0.565 safe 1.15 ramp 0.05\r");
    sequence = 0u;
}

static void check_silence(void)
{
    open_watched();
    tap_check(step(30u, INPUT_LOAD_KEEP, 0.0f) == 0u && status_is(WATCH_OFF, 0u, 0u),
              "who asks for nothing is not watched");
    tap_check(step(11u, INPUT_LOAD_FORCE, 3.0f) == 0u && step(1u, INPUT_LOAD_KEEP, 0.0f) == LINK_IS_STALE &&
                  status_is(WATCH_STALE, 1u, 0u),
              "a STEP tells that the demand is stale");
    tap_check(step(11u, INPUT_LOAD_FORCE, 3.0f) == 0u && step(11u, INPUT_LOAD_KEEP, 0.0f) == LINK_IS_STALE &&
                  step(1u, INPUT_LOAD_KEEP, 0.0f) == LINK_IS_SAFE && status_is(WATCH_SAFE, 2u, 1u),
              "and that it is too old");
    say_step(1u, INPUT_LOAD_FORCE, 3.0f);
    tap_check(is_refused(ERROR_SAFE_STATE, LINK_NO_INDEX, 0u), "then no STEP may ask for anything");
    sequence--;
    say_input(3.0f);
    tap_check(is_refused(ERROR_SAFE_STATE, LINK_NO_INDEX, 0u), "nor an INPUT");
    tap_check(step(5u, INPUT_LOAD_KEEP, 0.0f) == LINK_IS_SAFE && bench.executive.sim.f32.normal.n == 0.0f,
              "a plain STEP is made, without force");
    tap_check(step(1u, STARTS | INPUT_LOAD_FORCE, 3.0f) == 0u && status_is(WATCH_FRESH, 2u, 1u) &&
                  bench.executive.sim.f32.normal.n == 0.375f,
              "a STEP that starts leads back");
    tap_check(step(50u, INPUT_LOAD_KEEP, 0.0f) == LINK_IS_SAFE && step(1u, STARTS, 0.0f) == 0u &&
                  bench.executive.sim.f32.normal.n == 0.0f,
              "one that asks for nothing too, with the force that is left");
    say_step(1u, STARTS | 4u, 3.0f);
    tap_check(is_refused(ERROR_OUT_OF_RANGE, 1u, 0u), "and beside it there are no other kinds");
    say(LINK_INPUT, 1u, 0u);
    bytes_put_u64(&fields, INPUT_NOW);
    bytes_put_u8(&fields, STARTS | INPUT_LOAD_FORCE);
    fields.size = 18u;
    tap_check(is_refused(ERROR_OUT_OF_RANGE, 1u, 0u), "an INPUT does not start");
    sequence--;
    (void)step(50u, INPUT_LOAD_KEEP, 0.0f);
    tap_check(status_is(WATCH_SAFE, 4u, 3u) && is_done(LINK_RUN) && status_is(WATCH_FRESH, 4u, 3u),
              "a RUN starts, and has started when it is answered");
    say_input(3.0f);
    tap_check(is_answered() && is_done(LINK_STOP), "so that an INPUT is taken");
    (void)step(50u, INPUT_LOAD_KEEP, 0.0f);
    tap_check(is_done(LINK_RESET) && status_is(WATCH_OFF, 0u, 0u), "a reset ends it all");
}

static void check_console(void)
{
    open_watched();
    (void)bench_say("input N 3\rstep 30\r");
    tap_check(bench_holds(bench.heard, "! input_state=stale step=") &&
                  bench_holds(bench.heard, "! input_state=safe step=") && bench.notices == 2u,
              "a person is told");
    tap_check(bench_holds(bench_say("status\r"), " inputs_refused=0 input_state=safe times_stale=1 times_safe=1 "),
              "sees it in the status");
    tap_check(bench_starts(bench_say("input N 3\r"), "error safe-state input: "), "and is refused");
    tap_check(bench_starts(bench_say("input profile\r"), "error safe-state input: "), "whatever it is");
    (void)bench_say("stream csv input_state every 1 force\r");
    (void)bench_say("step 1\r");
    tap_check(bench_holds(bench.heard, "31,") && bench_holds(bench.heard, ",safe\r"), "every sample can say it");
    tap_check(bench_starts(bench_say("run\rinput N 3\r"), "ok input") && bench_starts(bench_say("stop\r"), "ok stop"),
              "run leads back");
    tap_check(bench_holds(bench.heard, "! input_state=fresh ") || bench.executive.sim.watch.state == WATCH_FRESH,
              "which is told as well");
    tap_check(bench_starts(bench_say("set safe 0.2\r"), "error out-of-range safe=0.2: "),
              "the safe state does not come before the stale one");
}

/* --- A run in pieces ---------------------------------------------------------------------------------------------- */

static uint8_t run[PIECES * LINK_PIECE];

static void say_snapshot(uint16_t offset)
{
    say(LINK_SNAPSHOT, 7u, 0u);
    bytes_put_u16(&fields, offset);
}

static bool fetch(void)
{
    for (uint16_t offset = 0u; offset < SNAPSHOT_SIZE; offset = (uint16_t)(offset + LINK_PIECE)) {
        const uint8_t *piece;

        say_snapshot(offset);
        if (!is_answered() || bytes_get_u16(&answer) != SNAPSHOT_SIZE || bytes_get_u16(&answer) != offset) {
            return false;
        }
        piece = bytes_get_block(&answer, LINK_PIECE);
        memcpy(run + offset, piece, LINK_PIECE);
    }
    return true;
}

static void say_restore(uint16_t offset, uint16_t size)
{
    say(LINK_RESTORE, 8u, 0u);
    bytes_put_u16(&fields, offset);
    bytes_put_u16(&fields, size);
    bytes_put_block(&fields, run + offset % sizeof run, LINK_PIECE);
}

static bool is_put(uint16_t offset, uint64_t standing)
{
    const size_t next = (size_t)offset + LINK_PIECE < SNAPSHOT_SIZE ? (size_t)offset + LINK_PIECE : SNAPSHOT_SIZE;

    say_restore(offset, SNAPSHOT_SIZE);
    return is_answered() && bytes_get_u16(&answer) == next && bytes_get_u64(&answer) == standing;
}

enum { LAST = (PIECES - 1) * LINK_PIECE };

/* All pieces but the last. */
static bool send_most(uint64_t standing)
{
    bool ok = true;

    for (uint16_t offset = 0u; offset < LAST; offset = (uint16_t)(offset + LINK_PIECE)) {
        ok = is_put(offset, standing) && ok;
    }
    return ok;
}

static void check_pieces(void)
{
    uint32_t hash;

    bench_open();
    (void)load_preset("brake", 5u);
    sequence = 0u;
    (void)step(3000u, INPUT_LOAD_FORCE, 2500.0f);
    tap_check(fetch() && run[sizeof run - 1u] == 0u, "a run in pieces, the last of them filled up");
    (void)step(5000u, INPUT_LOAD_KEEP, 0.0f);
    hash = bench.executive.sim.hash;
    tap_check(send_most(8000u) && bench.executive.sim.hash == hash, "put back, it waits for its last piece");
    tap_check(is_put(LAST, 3000u) && bench.executive.sim.step == 3000u, "with that it is in force");
    say_step(5000u, INPUT_LOAD_KEEP, 0.0f);
    tap_check(is_answered() && bench.executive.sim.step == 8000u && bench.executive.sim.hash == hash,
              "and goes on with the same bits");
    tap_check(is_put(LAST, 3000u) && is_put(LAST, 3000u), "the last piece again puts it back again");
    sequence = 100u;
    (void)step(5000u, INPUT_LOAD_KEEP, 0.0f);
    tap_check(bench.executive.sim.hash == hash, "a restore starts the count of STEPs, as a reset does");
    tap_check(is_done(LINK_RESET) && send_most(0u) && is_put(LINK_PIECE, 0u) && !is_put(LAST, 3000u),
              "a piece again means all that follow again");
    (void)bench_say("defaults\r");
    tap_check(send_most(0u) && is_put(LAST, 3000u) && executive_params(&bench.executive)->load_end_n == 3000.0f,
              "whatever set is in force");
    say(LINK_READ, 1u, 0u);
    bytes_put_u8(&fields, 1u);
    bytes_put_u8(&fields, index_of("N1", 2u));
    tap_check(is_answered() && bytes_get_u16(&answer) >= 1u && bytes_get_f32(&answer) == 3000.0f,
              "and what is staged follows");
}

static void check_refused_snapshots(void)
{
    uint64_t at;

    bench_open();
    sequence = 0u;
    say_snapshot(LINK_PIECE);
    tap_check(is_refused(ERROR_BAD_PIECE, 0u, 0u), "no piece of what has not been taken");
    say_snapshot(1u);
    tap_check(is_refused(ERROR_BAD_PIECE, 0u, 0u), "nor from between");
    say_snapshot(PIECES * LINK_PIECE);
    tap_check(is_refused(ERROR_BAD_PIECE, 0u, 0u), "nor from beyond");
    (void)is_done(LINK_RUN);
    say_snapshot(0u);
    tap_check(is_refused(ERROR_IS_RUNNING, LINK_NO_INDEX, 0u), "nothing is taken from a plant that runs");
    (void)is_done(LINK_STOP);
    at = bench.executive.sim.step;
    tap_check(fetch(), "it must stand");
    (void)load_preset("fig7-ke5000", 11u);
    say_snapshot(2u * LINK_PIECE);
    tap_check(is_answered(), "what has been taken stays, whatever becomes of the plant");
    (void)step(1000000u, INPUT_LOAD_KEEP, 0.0f);
    say_snapshot(0u);
    tap_check(is_refused(ERROR_IN_FAULT, LINK_NO_INDEX, 0u), "nothing goes on from a fault");
    tap_check(send_most(reply.step) && is_put(LAST, at) && bench.executive.sim.fault == SIM_FAULT_NONE,
              "but a restore leaves one");
}

static void check_refused_restores(void)
{
    static const char line[] = "step 1000000\r";
    bool is_busy;

    bench_open();
    sequence = 0u;
    tap_check(fetch(), "a run");
    say_restore(LINK_PIECE, SNAPSHOT_SIZE);
    tap_check(is_refused(ERROR_BAD_PIECE, 0u, 0u), "a restore begins with its first piece");
    say_restore(0u, SNAPSHOT_SIZE + 1u);
    tap_check(is_refused(ERROR_WRONG_LAYOUT, 1u, SNAPSHOT_SIZE), "its size is that of the layout");
    (void)is_put(0u, 0u);
    say_restore(2u * LINK_PIECE, SNAPSHOT_SIZE);
    tap_check(is_refused(ERROR_BAD_PIECE, 0u, LINK_PIECE), "none may be left out");
    say_restore(1u, SNAPSHOT_SIZE);
    tap_check(is_refused(ERROR_BAD_PIECE, 0u, LINK_PIECE), "nor shifted");
    tap_check(fetch() && !is_put(LINK_PIECE, 0u), "a snapshot ends it");
    run[100]++;
    (void)send_most(0u);
    say_restore(LAST, SNAPSHOT_SIZE);
    tap_check(is_refused(ERROR_WRONG_CRC, LINK_NO_INDEX, 0u), "a bit that is not as it was");
    run[100]--;
    (void)send_most(0u);
    (void)bench_turn(line, sizeof line - 1u, SIZE_MAX, &is_busy);
    bench_wait(3u);
    say_restore(LAST, SNAPSHOT_SIZE);
    tap_check(is_refused(ERROR_BUSY, LINK_NO_INDEX, 0u), "not while the console steps");
    say_snapshot(0u);
    tap_check(is_refused(ERROR_BUSY, LINK_NO_INDEX, 0u), "nor a snapshot");
    (void)is_done(LINK_STOP);
    bench_wait(5u);
    (void)is_done(LINK_RUN);
    say_restore(LAST, SNAPSHOT_SIZE);
    tap_check(is_refused(ERROR_IS_RUNNING, LINK_NO_INDEX, 0u), "nor in free run");
    (void)is_done(LINK_STOP);
    tap_check(is_put(LAST, 0u), "then the last piece may be sent again");
}

void test_link_safety(void)
{
    check_silence();
    check_console();
    check_pieces();
    check_refused_snapshots();
    check_refused_restores();
}
