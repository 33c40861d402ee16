/* Each kind of function has a pointer that stands on it, or on one that does nothing and takes the same arguments. */
#include "subjects.h"

#include "base/assert.h"
#include "base/compiler.h"
#include "model/presets.h"
#include "sim/executive.h"
#include "textbook.h"

/* Sticks and slips once a period, with two events; slips on. At 64 steps a period. */
#define STICKSLIP "N0 10 alpha -0.02"
#define SLIP "N0 1"
#define EVENTS "spp 16 contact lift kt 0.25 k 0.25 y0 2.5 v0 0 x0 0.3"

enum { PERIODS = 25, STEPS = PERIODS * 64, EVENTFUL = 2000 };

static struct sim_plan plan;
static struct sim sim;
static struct executive executive;
static struct textbook_float pad_float;
static struct textbook_double pad_double;

static void load(const char *set, const char *arith, struct params *params)
{
    const struct params_info *info;
    const char *bad;
    size_t bad_length;

    params_default(params);
    BASE_ASSERT(presets_assign(params, set, &info, &bad, &bad_length) == ERROR_OK);
    params->arithmetic = arith[0] == 'q' ? (float)ARITH_Q27 : (float)ARITH_F32;
}

static void start_sim(const struct subject *subject)
{
    struct params params;

    load(subject->set, subject->arith, &params);
    BASE_ASSERT(sim_plan_make(&plan, &params, NULL).error == ERROR_OK);
    sim_reset(&sim, &plan);
}

const struct plant_output *subjects_output(void) { return sim_output(&sim); }

/* --- Steps -------------------------------------------------------------------------------------------------------- */

static void no_step_f32(struct step_f32 *s, const struct step_f32_coeffs *c)
{
    (void)s;
    (void)c;
}

static void no_step_q27(struct step_q27 *s, const struct step_q27_coeffs *c)
{
    (void)s;
    (void)c;
}

static void (*volatile step_f32)(struct step_f32 *, const struct step_f32_coeffs *);
static void (*volatile step_q27)(struct step_q27 *, const struct step_q27_coeffs *);

static void aim_f32(bool at_nothing) { step_f32 = at_nothing ? no_step_f32 : step_f32_advance; }
static void aim_q27(bool at_nothing) { step_q27 = at_nothing ? no_step_q27 : step_q27_advance; }

static void call_f32(void) { step_f32(&sim.f32, &plan.f32); }

static void call_q27(void) { step_q27(&sim.q27, &plan.q27); }

/* --- The textbook ------------------------------------------------------------------------------------------------- */

static void start_textbook(const struct subject *subject)
{
    struct params params;

    load(subject->set, subject->arith, &params);
    BASE_ASSERT(sim_plan_make(&plan, &params, NULL).error == ERROR_OK);
    textbook_start_float(&pad_float, params.load_n, params.friction_slope_s_per_m, plan.scale.step_s);
    textbook_start_double(&pad_double, params.load_n, params.friction_slope_s_per_m, plan.scale.step_s);
}

static void no_textbook_float(struct textbook_float *pad) { (void)pad; }
static void no_textbook_double(struct textbook_double *pad) { (void)pad; }

static void (*volatile textbook_float)(struct textbook_float *);
static void (*volatile textbook_double)(struct textbook_double *);

static void aim_float(bool at_nothing) { textbook_float = at_nothing ? no_textbook_float : textbook_step_float; }
static void aim_double(bool at_nothing) { textbook_double = at_nothing ? no_textbook_double : textbook_step_double; }
static void call_float(void) { textbook_float(&pad_float); }
static void call_double(void) { textbook_double(&pad_double); }

/* --- What is around a step ---------------------------------------------------------------------------------------- */

static bool no_sim_step(struct sim *which)
{
    (void)which;
    return false;
}

static bool (*volatile sim_function)(struct sim *);

static void aim_unhashed(bool at_nothing) { sim_function = at_nothing ? no_sim_step : sim_step_unhashed; }
static void aim_sim(bool at_nothing) { sim_function = at_nothing ? no_sim_step : sim_step; }
static void call_sim(void) { (void)sim_function(&sim); }

static bool no_detector_push(struct detector *detector, const struct plant_output *output)
{
    (void)detector;
    (void)output;
    return false;
}

static bool (*volatile detector_function)(struct detector *, const struct plant_output *);

static void aim_detector(bool at_nothing) { detector_function = at_nothing ? no_detector_push : detector_push; }

static void call_detector(void) { (void)detector_function(&sim.detector, sim_output(&sim)); }

static bool no_executive_tick(struct executive *which, bool is_due)
{
    (void)which;
    (void)is_due;
    return false;
}

static bool (*volatile executive_function)(struct executive *, bool);

static void aim_executive(bool at_nothing) { executive_function = at_nothing ? no_executive_tick : executive_tick; }
static void call_executive(void) { (void)executive_function(&executive, true); }

struct executive *subjects_executive(const char *set, const char *arith, uint32_t sample_every)
{
    struct params params;

    load(set, arith, &params);
    executive_init(&executive, ARITH_F32);
    (void)executive_tick(&executive, false);
    BASE_ASSERT(executive_reset(&executive, &params).error == ERROR_OK);
    (void)executive_tick(&executive, false);
    executive_stream(&executive, sample_every);
    (void)executive_tick(&executive, false);
    BASE_ASSERT(executive_free_run(&executive) == ERROR_OK);
    return &executive;
}

static void start_tick(const struct subject *subject) { (void)subjects_executive(subject->set, subject->arith, 0u); }

static void start_tick_sampled(const struct subject *subject)
{
    (void)subjects_executive(subject->set, subject->arith, 1u);
}

/* Main's part, so that no ring fills. */
static void drain(void)
{
    struct sample sample;

    while (ring_pop(&executive.samples, &sample)) {
    }
}

/* --- The list ----------------------------------------------------------------------------------------------------- */

/* The plant that the detector hears, beside the count. */
static void advance_plant(void)
{
    if (plan.arithmetic == ARITH_Q27) {
        step_q27 = step_q27_advance;
        call_q27();
    } else {
        step_f32 = step_f32_advance;
        call_f32();
    }
}

static float displacement_float(void) { return pad_float.state[0]; }
static float displacement_double(void) { return (float)pad_double.state[0]; }

static float displacement_sim(void)
{
    struct sample sample;

    sim_sample(&sim, &sample);
    return sample_displacement(&sample, &plan.scale) * plan.scale.length_m;
}

#define STEP(variant, setting, count)                                                                            \
    {variant, "f32", setting, "step_f32_advance", start_sim, NULL, call_f32, aim_f32, count, displacement_sim},  \
    {                                                                                                            \
        variant, "q27", setting, "step_q27_advance", start_sim, NULL, call_q27, aim_q27, count, displacement_sim \
    }
#define AROUND(variant, function, start, prepare, call, aim)                                        \
    {variant, "f32", STICKSLIP " normal exact", function, start, prepare, call, aim, STEPS, NULL},  \
    {                                                                                               \
        variant, "q27", STICKSLIP " normal exact", function, start, prepare, call, aim, STEPS, NULL \
    }

const struct subject subjects[] = {
    {"naive-double", "double", STICKSLIP, "textbook_step_double", start_textbook, NULL, call_double, aim_double, STEPS,
     displacement_double},
    {"naive-float", "float", STICKSLIP, "textbook_step_float", start_textbook, NULL, call_float, aim_float, STEPS,
     displacement_float},
    STEP("step-slip", SLIP, STEPS),
    STEP("step-stickslip", STICKSLIP, STEPS),
    STEP("step-slip-exact", SLIP " normal exact", STEPS),
    STEP("step-stickslip-exact", STICKSLIP " normal exact", STEPS),
    STEP("step-events", EVENTS, EVENTFUL),
    AROUND("detector", "detector_push", start_sim, advance_plant, call_detector, aim_detector),
    AROUND("sim-unhashed", "sim_step_unhashed", start_sim, NULL, call_sim, aim_unhashed),
    AROUND("sim", "sim_step", start_sim, NULL, call_sim, aim_sim),
    AROUND("tick", "executive_tick", start_tick, NULL, call_executive, aim_executive),
    AROUND("tick-sampled", "executive_tick", start_tick_sampled, drain, call_executive, aim_executive),
};

const uint32_t subjects_count = BASE_COUNT(subjects);
