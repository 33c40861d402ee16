/* Plants for tests. */
#include "plants.h"

#include "base/assert.h"
#include "base/fmath.h"
#include "model/presets.h"
#include "model/sine.h"
#include "tap.h"

static uint32_t length_of(const char *text)
{
    uint32_t length = 0u;

    while (text[length] != '\0') {
        length++;
    }
    return length;
}

void plants_assign(struct params *params, const char *assignments)
{
    const struct params_info *info;
    const char *bad;
    size_t bad_length;

    const enum error error = presets_assign(params, assignments, &info, &bad, &bad_length);

    BASE_ASSERT(error == ERROR_OK);
}

struct params plants_params(const char *assignments)
{
    struct params params;

    params_default(&params);
    plants_assign(&params, assignments);
    return params;
}

struct params plants_preset(const char *name, const char *assignments)
{
    const struct preset *preset = presets_find(name, length_of(name));
    struct params params;

    BASE_ASSERT(preset != NULL);
    presets_load(preset, &params);
    plants_assign(&params, assignments);
    return params;
}

void plants_plan(struct sim_plan *plan, const struct params *params)
{
    const struct params_problem problem = sim_plan_make(plan, params, NULL);

    BASE_ASSERT(problem.error == ERROR_OK);
}

static void start(struct plant *plant, struct params params)
{
    plants_plan(&plant->plan, &params);
    sim_reset(&plant->sim, &plant->plan);
}

void plants_start(struct plant *plant, const char *assignments) { start(plant, plants_params(assignments)); }

void plants_start_preset(struct plant *plant, const char *name, const char *assignments)
{
    start(plant, plants_preset(name, assignments));
}

void plants_run_steps(struct plant *plant, uint32_t steps)
{
    for (uint32_t i = 0u; i < steps; i++) {
        (void)sim_step(&plant->sim);
    }
}

void plants_run_periods(struct plant *plant, uint32_t periods)
{
    plants_run_steps(plant, periods * plant->plan.scale.steps_per_period);
}

float plants_x_m(const struct plant *plant) { return plant->sim.f32.x * plant->plan.scale.length_m; }

float plants_largest_v(struct plant *plant, uint32_t steps)
{
    float largest = 0.0f;

    for (uint32_t i = 0u; i < steps; i++) {
        (void)sim_step(&plant->sim);
        largest = fmath_max(largest, fmath_abs(plant->sim.f32.v));
    }
    return largest;
}

/* x = mu n [(1 - cos Z t)/Z2 - (cos t - cos Z t)/(Z2 - 1)] */
void plants_check_undamped(struct plant *plant, const char *assignments, float tolerance)
{
    const struct scale *scale = &plant->plan.scale;
    struct params params = plants_params("c 0 alpha 0 kt 1.25 k 1 N0 0.5");
    float worst = 0.0f;

    plants_assign(&params, assignments);
    start(plant, params);
    for (uint32_t i = 1u; i <= 20u * scale->steps_per_period; i++) {
        const uint32_t turn = i * (SINE_GRID / scale->steps_per_period);
        const float normal = sine_cosine_f32(turn);
        const float own = sine_cosine_f32(turn * 3u / 2u);
        const float expected = (1.0f - own) / 2.25f + (own - normal) / 1.25f;
        float x;

        plants_run_steps(plant, 1u);
        x = (int)plant->plan.params.arithmetic == ARITH_F32 ? plant->sim.f32.x : (float)plant->sim.q27.x / 134217728.0f;
        worst = fmath_max(worst, fmath_abs(x / (0.25f * scale->friction) - expected));
    }
    tap_check_close(worst / 1.7f, 0.0f, tolerance, "undamped slip against its closed form, of the largest swing");
    tap_check(plant->sim.counters.events == 0u && sim_output(&plant->sim)->mode == PLANT_SLIP_PLUS,
              "which never stuck");
}

void plants_executive(struct executive *executive, const char *assignments)
{
    const struct params params = plants_params(assignments);

    executive_init(executive, ARITH_F32);
    (void)executive_reset(executive, &params);
    executive_tick(executive, false);
}

enum error plants_order(struct executive *executive, const char *assignments, bool may_reset, bool *was_reset)
{
    const struct params params = plants_params(assignments);

    return executive_set(executive, &params, may_reset, was_reset).error;
}

void plants_ticks(struct executive *executive, uint32_t count)
{
    for (uint32_t i = 0u; i < count; i++) {
        executive_tick(executive, true);
    }
}

void plants_spend(struct executive *executive)
{
    while (executive_wants_tick(executive)) {
        executive_tick(executive, true);
    }
}

uint32_t plants_scaled(uint32_t hosted, uint32_t on_board) { return tap_is_hosted() ? hosted : on_board; }

float plants_random(uint32_t *state, float low, float high)
{
    return low + (high - low) * ((float)(tap_random(state) >> 8) * (1.0f / 16777216.0f));
}
