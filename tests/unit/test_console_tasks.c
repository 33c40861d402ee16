/* What takes the console its time: steps, their end, what is announced on the way, the self-test and the story. */
#include "bench.h"
#include "tap.h"
#include "tests.h"

static void check_step(void)
{
    uint32_t hash;

    bench_open();
    tap_check(bench_starts(bench_say("step 64\r"), "ok step done=64 step=64 t=3.44144225 x="), "step steps");
    (void)bench_say("step 1000\r");
    hash = bench.executive.sim.hash;
    (void)bench_say("defaults\rset substeps 7\rstep 900\rstep 100\rstep 64\r");
    tap_check(bench.executive.sim.hash == hash && bench.executive.sim.step == 1064u, "in any portions the same bits");
    (void)bench_say("defaults\rrun\r");
    bench_wait(62u);
    tap_check_text(bench_say("stop\r"), "ok stop step=64", "run and stop");
    (void)bench_say("step 1000\r");
    tap_check(bench.executive.sim.hash == hash, "the same again");
    tap_check(bench_starts(bench_say("measure 3\r"), "ok measure periods=3 step=1256 t="), "a measurement steps");
}

static void check_stop(void)
{
    bool is_busy;

    bench_open();
    (void)bench_turn("step 1000000\r", 13u, SIZE_MAX, &is_busy);
    bench_wait(50u);
    (void)bench_say("get m\r\nstop\nget c\n");
    tap_check(bench_starts(bench.heard, "error stopped step="), "stop ends a step at once");
    tap_check(bench_holds(bench.heard, "\r\nok get m=0.3 unit=kg\r\nok stop step="),
              "lines before it wait for their turn");
    tap_check_text(bench.last, "ok get c=0.01 unit=N.s/m", "and lines behind it");
    tap_check(bench.oks == 3u && bench.errors == 1u, "each with one answer");
    tap_check(!executive_wants_tick(&bench.executive) && bench.executive.sim.step < 100u, "the plant stands");
    tap_check(bench_starts(bench_say("step 5\r"), "ok step done=5 "), "and steps again when told to");
    (void)bench_say("measure 100000\rstop\r");
    tap_check(bench_starts(bench.heard, "error stopped step=") && bench.oks == 1u, "a measurement is stopped");
    (void)bench_say("demo\rstop\r");
    tap_check(bench_holds(bench.heard, "error stopped step=") && bench.oks == 1u, "so is the story");
    (void)bench_say("selftest\rstop\r");
    tap_check(bench_holds(bench.heard, "error stopped step=") && bench.oks == 1u, "and the self-test");
    tap_check_text(bench_say("stop\r"), "ok stop step=0", "stop with nothing to stop is fine");
    (void)bench_turn("step 100000\r", 12u, SIZE_MAX, &is_busy);
    for (unsigned i = 0u; i < 100u; i++) {
        if (bench_turn("get m\r", 6u, SIZE_MAX, &is_busy) < 6u) {
            break;
        }
    }
    tap_check(bench.console.waiting_size <= CONSOLE_WAITING_MAX && bench.console.task == CONSOLE_TASK_STEP,
              "more than it can hold is left to the sender");
    (void)bench_say("\r");
    tap_check(bench.console.waiting_size == 0u, "and nothing is forgotten");
}

static void check_notices(void)
{
    bench_open();
    (void)bench_say("set N0 10 alpha -0.02\rmeasure 200\r");
    tap_check(bench.notices == 1u && bench_holds(bench.heard, "\r\n! propensity=squeal step="),
              "squeal is announced, once");
    (void)bench_say("measure 100\r");
    tap_check(bench.notices == 0u, "and not again");
    (void)bench_say("set mu_s 0.31\rmeasure 100\r");
    tap_check(bench.notices == 0u, "nor when a change of the set has only made it unknown for a while");
    (void)bench_say("preset fig7-ke5000\rstep 100000\r");
    tap_check(bench_holds(bench.heard, "! fault=domain step=") && bench.notices <= 2u, "a fault is announced, once");
    tap_check(bench_starts(bench.last, "error in-fault step="), "and ends the step");
    tap_check(bench_starts(bench_say("run\r"), "error in-fault step=") &&
                  bench_starts(bench_say("measure 1\r"), "error in-fault step="),
              "nothing steps in a fault");
    tap_check(bench_starts(bench_say("set mu_s 0.2\r"), "error in-fault step=") &&
                  executive_params(&bench.executive)->friction_static_ratio == 0.3f,
              "nor is the set changed");
    (void)bench_say("status\r");
    tap_check(bench_starts(bench.last, "ok status state=fault ") && bench_holds(bench.last, " fault=domain "),
              "the status says so");
    tap_check(bench_starts(bench_say("verdict\r"), "ok verdict propensity=squeal class=diverging period=0 "),
              "and the verdict");
    tap_check(bench_starts(bench_say("reset\r"), "ok reset ") && bench_starts(bench_say("step 5\r"), "ok step "),
              "a reset leaves it");
    (void)bench_say("preset fig7-ke5000\rstep 100000\r");
    tap_check(bench_starts(bench_say("defaults\r"), "ok defaults ") && bench_starts(bench_say("step 5\r"), "ok step "),
              "so do the defaults, which are a reset");
}

static void check_selftest(void)
{
    bench_open();
    bench.work.ticks_counted = 1000u;
    bench.work.ticks_expected = 1001u;
    tap_check_text(bench_say("selftest\r"), "ok selftest passed=9 failed=0", "the self-test passes");
    bench.work.ticks_expected = 1002u;
    tap_check_text(bench_say("selftest\r"), "error selftest passed=8 failed=1", "lost ticks fail it");
    tap_check(bench_holds(bench.heard, "- fail ticks 1000 counted, 1002 expected by the other clock\r\n"), "by name");
    bench.work.ticks_expected = 998u;
    tap_check_text(bench_say("selftest\r"), "error selftest passed=8 failed=1", "so do too many");
}

static void check_demo(void)
{
    bench_open();
    (void)bench_say("set substeps 64 tick 4000\r");
    (void)bench_say("demo 3\r");
    tap_check(bench_starts(bench.heard, "- act 3: ") &&
                  bench_holds(bench.heard, "\r\n- N = 0 to 1500 N, v0 = 0.1 m/s, ") &&
                  bench_holds(bench.heard, "\r\n- verdict propensity=quiet class=rest period=0 ") &&
                  bench_holds(bench.heard, "\r\n- The brake is quiet: "),
              "an act says what is set and what came of it");
    tap_check_text(bench.last, "ok demo act=3", "and ends with one answer");
    (void)bench_say("demo 5\r");
    tap_check(bench_holds(bench.heard, "\r\n- The brake squeals: 1999 Hz, 4.07") &&
                  bench_holds(bench.heard, "\r\n- Squeal began at t = 0.18"),
              "in the stop squeal begins on the way");
    tap_check(executive_params(&bench.executive)->steps_per_tick == 64.0f &&
                  executive_params(&bench.executive)->tick_hz == 4000.0f,
              "the user's pace is kept");
    (void)bench_say("stream csv step every 1000 force\rdemo 2\r");
    tap_check(bench.samples == 19u && bench_holds(bench.heard, "class=stickslip-p1"),
              "a stream goes on through an act");
    (void)bench_say("demo\r");
    tap_check_text(bench.last, "ok demo act=5", "the whole story");
}

/* What happened in a step reaches the person who asks. */
static void check_counters(void)
{
    bench_open();
    (void)bench_say("set spp 16 contact lift kt 0.25 k 0.25 y0 2.5 v0 0 x0 0.3\rstep 75\rstatus\r");
    tap_check(bench_holds(bench.last, " step=75 ") && bench_holds(bench.last, " caps=0 "), "no cap reached so far");
    (void)bench_say("step 1\rstatus\r");
    tap_check(bench_holds(bench.last, " caps=1 "), "status counts a step that reached its cap");
    (void)bench_say("reset\rset arith q27\rstep 76\rstatus\r");
    tap_check(bench_holds(bench.last, " arith=q27 ") && bench_holds(bench.last, " caps=1 "), "in fixed point too");
}

/* Of the interrupt's time: the rate stays when the plant is reset, what it took does not. */
static void check_share(void)
{
    bench_open();
    executive_begin_rate(&bench.executive, 1000u);
    (void)executive_book(&bench.executive, 250u, 500u, false);
    (void)bench_say("step 1\rstatus\r");
    tap_check(bench_holds(bench.last, " isr_share=0.5 isr_share_max=0.25 "), "shares of the interrupt");
    (void)bench_say("reset\rstatus\r");
    tap_check(bench_holds(bench.last, " isr_share=nan isr_share_max=nan "), "which nobody knows before the first tick");
}

void test_console_tasks(void)
{
    check_step();
    check_stop();
    check_notices();
    check_counters();
    check_share();
    check_selftest();
    check_demo();
}
