/* One plant with load, detector and counters: passage of ten times the disc's speed, fault, hash, records. */
#include "sim/sim.h"

#include "base/fmath.h"
#include "base/hash.h"
#include "plants.h"
#include "tap.h"
#include "tests.h"

static struct plant plant;
static struct sim *const sim = &plant.sim;

static float v10_s(void)
{
    return ((float)sim->v10_step + (float)sim->v10_fraction_q15 / 32768.0f) * plant.plan.scale.step_s;
}

/* tests/golden: fig7_ke5000 passes 10 v0 after 0.412073451 s. */
static void check_v10(void)
{
    plants_start_preset(&plant, "fig7-ke5000", "normal exact spp 128");
    while (!sim->has_v10 && sim->step < 20000u) {
        plants_run_steps(&plant, 1u);
    }
    tap_check(sim->has_v10 && fmath_abs(sim->f32.v) > 10.0f * sim->f32.disc,
              "a diverging pad passes ten times the disc");
    tap_check_close(v10_s(), 0.412073451f, 2e-5f, "at the time of the reference, between two steps");
    {
        const uint64_t step = sim->v10_step;

        plants_run_steps(&plant, 500u);
        tap_check(sim->v10_step == step, "the first time counts");
    }
    sim_reset(sim, &plant.plan);
    tap_check(!sim->has_v10, "a reset forgets it");
    plants_start(&plant, "N0 1 v0 0 xd0 1 c 0.5");
    plants_run_steps(&plant, 100u);
    tap_check(!sim->has_v10, "a disc at rest has no ten times its speed");
}

static void check_fault(void)
{
    struct sim frozen;
    struct sample sample;
    bool has_verdict = false;

    plants_start_preset(&plant, "fig7-ke5000", "normal exact");
    for (uint32_t i = 0u; i < 100000u && sim->fault == SIM_FAULT_NONE; i++) {
        has_verdict = sim_step(sim);
    }
    tap_check(sim->fault == SIM_FAULT_DOMAIN && has_verdict,
              "a plant that leaves its domain is at fault, and says so once");
    tap_check(sim->detector.verdict.propensity == PROPENSITY_SQUEAL && sim->detector.verdict.motion == CLASS_DIVERGING,
              "which is squeal, diverging");
    frozen = *sim;
    tap_check(!sim_step(sim) && !sim_step(sim) && sim->step == frozen.step && sim->hash == frozen.hash &&
                  sim->f32.x == frozen.f32.x && sim->f32.v == frozen.f32.v && sim->f32.normal.y == frozen.f32.normal.y,
              "it stands still then, to the bit");
    sim_sample(sim, &sample);
    tap_check(sample.is_fault == 1u && sample.step == frozen.step && sample_value(&sample, sample.v) == frozen.f32.v,
              "and can still be read");
    sim_apply(sim, &plant.plan);
    tap_check(!sim_step(sim) && sim->step == frozen.step && sim->detector.verdict.motion == CLASS_DIVERGING,
              "a new set does not free it");
    sim_reset(sim, &plant.plan);
    (void)sim_step(sim);
    tap_check(sim->fault == SIM_FAULT_NONE && sim->step == 1u && sim->detector.verdict.motion == CLASS_UNSETTLED,
              "a reset does");
}

static void check_not_finite(void)
{
    const float zero = (float)(plant.plan.scale.steps_per_period & 1u);

    plants_start(&plant, "N0 1");
    plants_run_steps(&plant, 10u);
    sim->f32.v = zero / zero;
    (void)sim_step(sim);
    tap_check(sim->fault == SIM_FAULT_DOMAIN, "what is not a number is a fault at once");
    plants_start(&plant, "N0 1");
    sim->f32.normal.y = 1.0f / zero;
    (void)sim_step(sim);
    tap_check(sim->fault == SIM_FAULT_DOMAIN, "so is the infinite");
    plants_start(&plant, "N0 1");
    sim->f32.normal.y = 70.0f;
    (void)sim_step(sim);
    tap_check(sim->fault == SIM_FAULT_DOMAIN, "so is a pad pressed far beyond any load");
    plants_start(&plant, "N0 1 xd0 60 v_max 5"); /* twelve units, three more than Q4.27 would need */
    tap_check(!plant_notes(sim_output(sim)).is_saturated, "twelve units fit the output");
    (void)sim_step(sim);
    tap_check(sim->fault == SIM_FAULT_DOMAIN, "but lie beyond ten, the limit of the domain");
}

static void check_hash(void)
{
    uint32_t hash = HASH_INIT;

    plants_start(&plant, "N0 5");
    tap_check(sim->hash == HASH_INIT, "no step, no hash");
    for (uint32_t i = 0u; i < 300u; i++) {
        plants_run_steps(&plant, 1u);
        hash = hash_word(hash, fmath_bits(sim->f32.x));
        hash = hash_word(hash, fmath_bits(sim->f32.v));
        hash = hash_word(hash, fmath_bits(sim->f32.normal.y));
        hash = hash_word(hash, fmath_bits(sim->f32.normal.w));
        hash = hash_word(hash, (uint32_t)(int32_t)sim->f32.mode);
    }
    tap_check(sim->hash == hash, "it covers position, velocity, normal motion and mode of every step");
    sim_reset(sim, &plant.plan);
    plants_run_steps(&plant, 300u);
    tap_check(sim->hash == hash, "the same set gives it again");
}

/* A change between two steps keeps state and step, and asks the detector anew. */
static void check_apply(void)
{
    static struct sim_plan changed;
    struct params params = plants_params("N0 2");
    struct step_f32 before;
    float x;

    plants_start(&plant, "N0 1");
    plants_run_periods(&plant, 40u);
    tap_check(sim->detector.verdict.propensity == PROPENSITY_QUIET, "quiet under 1 N");
    (void)tap_check(sim_plan_make(&changed, &params, &plant.plan.scale).error == ERROR_OK, "2 N fit its scale");
    before = sim->f32;
    sim_apply(sim, &changed);
    x = before.x;
    tap_check(sim->f32.x == x && sim->f32.v == before.v && sim->f32.mode == before.mode && sim->step == 40u * 64u,
              "the motion goes on from where it is");
    tap_check(sim->detector.verdict.propensity == PROPENSITY_UNKNOWN, "the verdict does not");
    (void)sim_step(sim);
    tap_check(sim->f32.normal.n == 0.5f, "the next step has the new load");
}

/* What the detector is told, against hand values for Table 1 at N = 1. */
static void check_config(void)
{
    const struct detector_config *config = &plant.plan.detector;

    plants_start(&plant, "");
    tap_check(config->steps_per_period == 64u && config->stiffness_q16 == 2u << 16 && config->load_speed == 0 &&
                  config->load_response == 0,
              "the detector knows steps and springs");
    tap_check_close((float)config->step_q27 / 134217728.0f, 0.09817477f, 1e-7f, "the step");
    tap_check_close((float)config->gain_q16 / 65536.0f, 0.54766f, 1e-4f, "and what the normal motion explains");
    plants_start(&plant, "kt 0.05 k 0 N1 0.5 load sine fN 0.14528816 c 0 alpha 0");
    tap_check_close((float)config->stiffness_q16 / 65536.0f, 3.2f, 1e-4f, "in the units of a shifted x");
    tap_check_close((float)config->step_q27 / 134217728.0f, 0.09817477f / 8.0f, 1e-7f, "the step too");
    /* n1 r/(1 - r^2) with n1 = 0.5/6, r = 1/2; then mu/(r^2 - Z2) of it */
    tap_check_close((float)config->load_speed / 134217728.0f, 0.0555556f, 1e-5f, "a sine of the load moves y");
    tap_check_close((float)config->load_response / 134217728.0f, 0.0555556f * 0.82158f / 0.2f, 3e-5f, "and x");
}

static void check_counters(void)
{
    plants_start(&plant, "N0 1");
    plants_run_steps(&plant, 5u);
    tap_check(sim->counters.saturations == 0u, "nothing saturates");
    sim->f32.x = 20.0f;
    plants_run_steps(&plant, 1u);
    tap_check(sim->counters.saturations == 1u && sim_output(sim)->x == INT32_MAX && sim->fault == SIM_FAULT_NONE,
              "an x beyond the output's numbers is held there and counted");
    sim_measure(sim, 100u);
    sim_reset(sim, &plant.plan);
    tap_check(sim->counters.saturations == 0u && !measure_is_active(&sim->measure),
              "a reset ends counts and measurement");
}

static void check_sample(void)
{
    struct sample sample;

    plants_start(&plant, "N0 5");
    plants_run_steps(&plant, 77u);
    sim_sample(sim, &sample);
    tap_check(sample.step == 77u && sample.x == fmath_bits(sim->f32.x) && sample.v == fmath_bits(sim->f32.v) &&
                  sample.y == fmath_bits(sim->f32.normal.y) && sample.w == fmath_bits(sim->f32.normal.w) &&
                  sample.load == fmath_bits(0.25f) && sample.disc == fmath_bits(sim->f32.disc) &&
                  sample.mode == sim->f32.mode && sample.hash == sim->hash && sample.is_fault == 0u,
              "a record holds the present state");
    tap_check(sample_value(&sample, sample.friction) == step_f32_friction(&sim->f32, &plant.plan.f32), "and friction");
    sim_measure(sim, 64u);
    plants_run_steps(&plant, 100u);
    tap_check(sim->measure.done == 64u && sim->measure.x_max > sim->measure.x_min, "a measurement runs beside");
}

/* The short way through a step against the long one, which is_usual = false takes. */
static bool is_same_by_the_long_way(const char *preset, const char *assignments)
{
    static struct plant twin;
    bool was_usual = false;

    plants_start_preset(&plant, preset, assignments);
    plants_start_preset(&twin, preset, assignments);
    for (uint32_t i = 0u; i < 6000u; i++) {
        was_usual = was_usual || sim->is_usual;
        twin.sim.is_usual = false;
        if (sim_step(sim) != sim_step(&twin.sim)) {
            return false;
        }
    }
    return was_usual && sim->hash == twin.sim.hash && sim->fault == twin.sim.fault &&
           sim->v10_step == twin.sim.v10_step && sim->v10_fraction_q15 == twin.sim.v10_fraction_q15 &&
           sim->counters.events == twin.sim.counters.events && sim->counters.lifted == twin.sim.counters.lifted &&
           sim->detector.verdict.propensity == twin.sim.detector.verdict.propensity &&
           detector_step(&sim->detector) == detector_step(&twin.sim.detector);
}

static void check_usual(void)
{
    tap_check(is_same_by_the_long_way("fig7-ke5000", "") && is_same_by_the_long_way("fig7-ke5000", "arith q27"),
              "the usual step is the step, to the end of the domain");
    tap_check(is_same_by_the_long_way("fig5-n5", "contact lift") && is_same_by_the_long_way("fig5-n5", "arith q27"),
              "and with events in it");
}

void test_sim(void)
{
    check_usual();
    check_v10();
    check_fault();
    check_not_finite();
    check_hash();
    check_apply();
    check_config();
    check_counters();
    check_sample();
}
