/* A measurement over a fixed number of steps. */
#include "sim/measure.h"

#include "base/fixed.h"
#include "base/fmath.h"
#include "sim/extremum.h"

void measure_start(struct measure *measure, const struct plant_output *now, uint64_t steps, int32_t step_q27)
{
    *measure = (struct measure){
        .planned = steps,
        .x_max = now->x,
        .x_min = now->x,
        .v_max = now->v,
        .v_min = now->v,
        .step_q27 = step_q27,
        .x1 = now->x,
        .v1 = now->v,
        .v2 = now->v,
    };
}

static void widen(int32_t value, int32_t *low, int32_t *high)
{
    if (value > *high) {
        *high = value;
    }
    if (value < *low) {
        *low = value;
    }
}

/* Displacement turns where the velocity changes its sign. */
static void book_displacement(struct measure *measure, const struct plant_output *output)
{
    widen(output->x, &measure->x_min, &measure->x_max);
    if ((measure->v1 > 0 && output->v < 0) || (measure->v1 < 0 && output->v > 0)) {
        widen(extremum_of_displacement(measure->x1, measure->v1, output->x, output->v, measure->step_q27),
              &measure->x_min, &measure->x_max);
    }
}

/* Velocity turns smoothly only inside one slip regime; at an event it has a kink, and the sample is the extreme. */
static void book_velocity(struct measure *measure, const struct plant_output *output)
{
    const bool is_peak = measure->v1 > measure->v2 && measure->v1 >= output->v;
    const bool is_dip = measure->v1 < measure->v2 && measure->v1 <= output->v;

    widen(output->v, &measure->v_min, &measure->v_max);
    measure->smooth = plant_notes(output).events == 0u && output->mode != PLANT_STICK ? measure->smooth + 1u : 0u;
    if (measure->smooth >= 2u && (is_peak || is_dip)) {
        widen(extremum_of_parabola(measure->v2, measure->v1, output->v), &measure->v_min, &measure->v_max);
    }
}

static void book_crossing(struct measure *measure, const struct plant_output *output)
{
    if (measure->x1 < measure->level && output->x >= measure->level) {
        const uint32_t before = (uint32_t)((int64_t)measure->level - measure->x1);
        const uint32_t whole = (uint32_t)((int64_t)output->x - measure->x1);

        measure->last_q15 = (measure->done << 15) + extremum_ratio_q15(before, whole);
        if (measure->crossings == 0u) {
            measure->first_q15 = measure->last_q15;
        }
        measure->crossings++;
    }
}

void measure_push(struct measure *measure, const struct plant_output *output)
{
    const struct plant_notes notes = plant_notes(output);

    if (!measure_is_active(measure)) {
        return;
    }
    book_displacement(measure, output);
    book_velocity(measure, output);
    if (measure->done == measure->planned / 2u) {
        measure->level = (int32_t)(((int64_t)measure->x_max + measure->x_min) / 2);
    } else if (measure->done > measure->planned / 2u) {
        book_crossing(measure, output);
    }
    measure->stick += notes.stick;
    measure->slip_minus += notes.slip_minus;
    measure->x1 = output->x;
    measure->v2 = measure->v1;
    measure->v1 = output->v;
    measure->done++;
}

float measure_frequency(const struct measure *measure)
{
    if (measure->crossings < 2u || measure->last_q15 == measure->first_q15) {
        return 0.0f;
    }
    return (float)(measure->crossings - 1u) * 32768.0f / fmath_from_u64(measure->last_q15 - measure->first_q15);
}

float measure_share(const struct measure *measure, uint64_t sum)
{
    return measure->done == 0u ? 0.0f : fmath_from_u64(sum) / (fmath_from_u64(measure->done) * (float)PLANT_SHARE_ONE);
}
