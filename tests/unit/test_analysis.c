/* What is said of a set without integrating, in SI, against the figures of the paper's model. */
#include "analysis/analysis.h"

#include "base/fmath.h"
#include "bench.h"
#include "plants.h"
#include "tap.h"
#include "tests.h"

static struct sim_plan plan;
static struct analysis analysis;

static const struct analysis *analyse(const char *preset, const char *assignments)
{
    const struct params params = plants_preset(preset, assignments);

    plants_plan(&plan, &params);
    analysis_make(&analysis, &plan.params, &plan.scale);
    return &analysis;
}

static void check_table1(void)
{
    const struct analysis *of = analyse("table1", "");

    tap_check_close(of->tangential.frequency_hz, 0.41093f, 1e-5f, "Table 1: sqrt((kt + k)/m) in Hz");
    tap_check_close(of->floquet_per_s, -1.0f / 75.0f, 1e-6f, "slip dies out in 75 s");
    tap_check_close(of->load_border_n, 5.0f, 1e-4f, "and grows above N = 5: the paper's number");
    tap_check_close(of->alpha_border_s_per_m, -0.01f, 1e-6f, "or beyond alpha = -0.01");
    tap_check_close(of->load_touch_n, 1.8443f, 0.01f, "forced motion touches above 1.84 N");
    tap_check(of->normal.growth_per_s == 0.0f && of->normal.damping_ratio == 0.0f, "the normal direction is undamped");
    tap_check(of->has_forced && fmath_abs(of->forced_um[2] / 297969.5f - 1.0f) < 1e-4f,
              "and the size is that of the reference, 0.595939 m");
}

static void check_borders(void)
{
    tap_check_close(analyse("table1", "kt 0.125 k 0.125")->load_border_n, 3.335f, 0.01f, "in the tongue: 2/3 of it");
    tap_check_close(analyse("brake", "")->load_border_n, 2000.0f, 0.1f, "brake: 2000 N");
    tap_check_close(analysis.tangential.growth_per_s, 100.0f, 1e-3f, "it grows by 100/s at 3000 N");
    tap_check(!analysis.has_forced && !fmath_is_finite(analysis.outer_m_per_s), "a floor: no solution, no outer cycle");
    tap_check(!fmath_is_finite(analyse("table1", "alpha 0.01")->load_border_n), "friction that rises has no border");
    tap_check_close(analyse("fig7-ke10000", "")->outer_m_per_s, 2.548f, 1e-3f, "Fig. 7: V* = 2.55 m/s");
    tap_check(!analyse("fig5-n2", "")->has_forced, "a pad that touches does not follow the solution");
}

static void check_command(void)
{
    bench_open();
    tap_check(bench_starts(bench_say("analyse\n"), "ok analyse predicted=quiet touch_ratio=0.544") &&
                  bench_holds(bench.heard, "- borders N=1 N_grows=") &&
                  bench_holds(bench.heard, "- forced served=yes order0_um="),
              "the command");
}

void test_analysis(void)
{
    check_table1();
    check_borders();
    check_command();
}
