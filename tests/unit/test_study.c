/* scan and margin through the console. */
#include "base/fmath.h"
#include "bench.h"
#include "tap.h"
#include "tests.h"

static bool hears(const char *part) { return bench_holds(bench.heard, part); }

static void check_scan(void)
{
    bench_open();
    (void)bench_say("preset brake\r");
    bench_listen_anew();
    tap_check(bench_starts(bench_say("scan N1 1000 3000 3 alpha -0.05 -0.03 2 transient 1000\r"),
                           "ok scan trials=6 unknown=0 quiet=5 watch=0 squeal=1 loud=1 undecided=0 refused=0 "
                           "diverged=0 caps=0 saturations=0 gap_held=0 steps="),
              "a map of six points is counted");
    tap_check(
        hears("- point done=1 of=6 i=0 j=0 N1=1000 alpha=-0.05 propensity=quiet class=rest period=0 amplitude_um=") &&
            hears("- point done=3 of=6 i=2 j=0 N1=3000 alpha=-0.05 propensity=squeal "
                  "class=limitcycle-stickslip-p1 period=1 amplitude_um=8.") &&
            hears("- point done=6 of=6 i=2 j=1 N1=3000 alpha=-0.03 propensity=quiet "),
        "and told point by point, the first axis fastest");
    tap_check(hears(" predicted=squeal predicted_growth_per_s=49.99") && hears(" end=squealed periods=") &&
                  hears(" end=decayed periods="),
              "with the prediction, and why it ended");
    tap_check(bench_starts(bench_say("scan spp 16 1024 2 transient 0 window 8\r"), "ok scan trials=2 "),
              "a parameter that needs a restart is scanned as well");
    bench_listen_anew();
    tap_check(bench_starts(bench_say("scan N1 3000 20000 2 transient 0 window 8\r"), "ok scan trials=2 ") &&
                  hears("- point done=2 of=2 i=1 j=0 N1=20000 error=out-of-scale") &&
                  bench_holds(bench.last, " refused=1 "),
              "a point that the model cannot hold is told and counted");
}

static void check_refusals(void)
{
    static const struct {
        const char *line, *answer;
    } rows[] = {
        {"scan\r", "error usage scan <symbol>"},
        {"scan N7 1 2 3\r", "error unknown-name N7: no parameter has this name; list shows them"},
        {"scan N0 1 2\r", "error usage scan"},
        {"scan N0 1 x 3\r", "error bad-number N0=x: "},
        {"scan N0 1 1e10 3\r", "error out-of-range N0=1e10: 0 .. 1000000000 N"},
        {"scan N0 1 2 257\r", "error out-of-range points=257: 1 .. 256, a whole number"},
        {"scan alpha -1 1 3 log\r", "error usage alpha: log needs two ends of one sign, neither of them 0"},
        {"scan N0 1 2 3 N0 3 4 5\r", "error usage N0: one axis for a parameter"},
        {"scan N0 1 2 3 transient\r", "error usage scan"},
        {"scan N0 1 2 3 window 7\r", "error out-of-range window=7: 8 .. 1000000, a whole number"},
        {"scan N0 1 2 3 whole often\r", "error usage scan"},
        {"scan arith f32 f64 2\r", "error out-of-range arith=f64: f32|q27"},
        {"occurrence 0\r", "error out-of-range trials=0: 1 .. 100000, a whole number"},
        {"occurrence\r", "error usage occurrence"},
        {"occurrence 5 N 2\r", "error out-of-range N=2: 0 .. 1"},
        {"occurrence 5 N\r", "error usage occurrence"},
        {"occurrence 5 m 0.1\r", "error usage occurrence"},
        {"occurrence 5 seed -1\r", "error out-of-range seed=-1: 0 .. 16777215, a whole number"},
        {"margin nothing\r", "error unknown-name nothing: "},
        {"margin spp\r", "error not-served spp: margin takes "},
        {"margin N0 within 1\r", "error out-of-range within=1: 1.001 .. 1000000"},
        {"margin N0 within a\r", "error bad-number a: "},
        {"margin N0 within\r", "error usage margin"},
        {"margin N0 far\r", "error usage margin"},
    };
    bool is_silent = true;

    bench_open();
    for (size_t i = 0u; i < sizeof rows / sizeof rows[0]; i++) {
        bench_listen_anew();
        tap_check(bench_starts(bench_say(rows[i].line), rows[i].answer), rows[i].line);
        is_silent = is_silent && !hears("- ");
    }
    tap_check(is_silent, "nothing is tried before a refusal");
}

/* A set that has no scale is the answer, not what the last trial said. */
static void check_margin_refused(void)
{
    bench_open();
    (void)bench_say("set N0 10 alpha -0.02\rscan N0 10 10 1\rstep 64\rset N0 0 v0 0\r");
    tap_check(bench_starts(bench_say("margin\r"), "error no-scale"), "a set that cannot be tried is the answer");
    tap_check(bench_starts(bench_say("occurrence 3\r"), "ok occurrence share=nan low=0 high=1 ") &&
                  bench_holds(bench.last, " trials=3 ") && bench_holds(bench.last, " refused=3 "),
              "nothing tried, nothing known");
}

static void check_margin(void)
{
    bench_open();
    (void)bench_say("preset brake\r");
    bench_listen_anew();
    tap_check(bench_starts(bench_say("margin N1\r"), "ok margin parameters=1 now=squeal trials="), "the border of one");
    tap_check(hears("- margin done=1 of=1 N1=3000 unit=N now=squeal below=1999.") ||
                  hears("- margin done=1 of=1 N1=3000 unit=N now=squeal below=2000."),
              "N |alpha| = c, to a thousandth");
    tap_check(hears(" below_quiet=") && hears(" below_squeal=") && hears(" above=none above_searched=") &&
                  hears(" quiets=down"),
              "its bracket, where there is none, and the way out");
    bench_listen_anew();
    tap_check(bench_starts(bench_say("margin within 1.01 transient 200\r"), "ok margin parameters=11 now=squeal "),
              "all of them, near by");
    tap_check(hears("- margin done=11 of=11 v0=0.1 unit=m/s now=squeal "), "one line each");
}

static void check_occurrence(void)
{
    bench_open();
    (void)bench_say("preset brake\rset N1 2000\r");
    bench_listen_anew();
    tap_check(bench_starts(bench_say("occurrence 40 uniform N 0.2 seed 3\r"), "ok occurrence share=0."),
              "a brake on its border squeals as often as not");
    tap_check(bench_holds(bench.last, " scatter=uniform seed=3 clamped=0 trials=40 ") &&
                  bench_holds(bench.last, " low=0.") && bench_holds(bench.last, " high=0."),
              "with an interval, and what it was drawn from");
    tap_check(hears("- trial done=1 of=40 mu_s=0.419999987 alpha=-0.0599999987 c=120 N_factor=") &&
                  hears("- trial done=40 of=40 "),
              "a line for each trial");
    tap_check(bench_starts(bench_say("occurrence 10 N 0\r"), "ok occurrence share="), "no scatter is allowed");
    (void)bench_say("set N1 1000\r");
    tap_check(bench_starts(bench_say("occurrence 10 c 0.01\r"), "ok occurrence share=0 low=0 high=0.27"),
              "none of ten is not never");
}

/* The plant in the interrupt steps on through a study as it would without it. */
static void check_undisturbed(void)
{
    uint32_t hash;
    uint64_t steps;

    bench_open();
    (void)bench_say("preset fig5-n10\rset tick 100000\rrun\r");
    (void)bench_say("scan N0 1 10 3 mu_s 0.1 0.3 2\r");
    (void)bench_say("stop\r");
    steps = bench.executive.sim.step;
    hash = bench.executive.sim.hash;
    tap_check(steps > 100u, "a free run goes on beside a map");
    bench_open();
    (void)bench_say("preset fig5-n10\r");
    executive_grant(&bench.executive, (uint32_t)steps);
    while (bench.executive.sim.step < steps) {
        bench_wait(1u);
    }
    tap_check(bench.executive.sim.hash == hash, "with the same bits as without");
}

static void check_stop(void)
{
    bool is_busy;
    uint64_t before;

    bench_open();
    (void)bench_say("preset fig5-n10\rrun\r");
    bench_listen_anew();
    (void)bench_turn("scan N0 1 10 100 whole\r", 23u, SIZE_MAX, &is_busy);
    bench_wait(300u);
    tap_check(bench.console.task == CONSOLE_TASK_STUDY && is_busy, "a map is under way");
    before = bench.work.study.trial.sim.step;
    (void)console_poll(&bench.console);
    tap_check(bench.work.study.trial.sim.step - before > 0u && bench.work.study.trial.sim.step - before <= 128u,
              "a poll makes 128 steps of it at most, half of what may lie between two looks at the line");
    before = bench.executive.sim.step;
    tap_check(bench_starts(bench_say("stop\r"), "ok stop step="), "a stop is answered");
    tap_check(hears("error stopped trials=") && bench.console.task == CONSOLE_TASK_NONE, "and ends the map");
    bench_wait(10u);
    tap_check(executive_wants_tick(&bench.executive) && bench.executive.sim.step > before, "while the plant runs on");
    (void)bench_say("stop\r");
    tap_check(!executive_wants_tick(&bench.executive), "until the next one");
    tap_check(bench_starts(bench_say("scan N0 1 2 2 transient 0 window 8\r"), "ok scan trials=2 "),
              "nothing is left behind");
    bench_listen_anew();
    (void)bench_say("scan N0 1 10 100 whole\rrun\rstop\r");
    bench_wait(20u);
    tap_check(!executive_wants_tick(&bench.executive), "a stop with other lines before it halts the plant as well");
    bench_listen_anew();
    (void)bench_say("scan N0 0 4 2 transient 0 window 8\r");
    tap_check(hears("- point done=1 of=2 i=0 j=0 N0=0 propensity="), "a study begins anew after one that was cut");
    (void)bench_say("set ke 5000 kt 5000 k 5000 alpha -0.15 N0 100\rstep 100000\r");
    tap_check(bench_starts(bench.last, "error in-fault") &&
                  bench_starts(bench_say("scan N0 1 2 2 transient 0 window 8\r"), "ok scan trials=2 "),
              "a plant in fault is no obstacle");
}

void test_study(void)
{
    check_scan();
    check_refusals();
    check_margin();
    check_margin_refused();
    check_occurrence();
    check_undisturbed();
    check_stop();
}
