/* The paper's solution of forced slip against the plant, started on its orbit: each error in print costs what MODEL.md
 * says. */
#include "analysis/perturbation.h"

#include "base/fmath.h"
#include "plants.h"
#include "tap.h"
#include "tests.h"

enum { SPP = 256, PERIODS = 10 };

static struct plant plant;

/* The plant on the orbit of order 2, and the largest distance of a form from it over ten periods, over half its
 * range. */
static float error_of(const char *assignments, enum perturbation_form form, unsigned order)
{
    struct params params = plants_params(assignments);
    struct perturbation orbit, tried;
    struct perturbation_state start;
    float largest = 0.0f, high = -1e30f, low = 1e30f;

    params.steps_per_period = 4.0f; /* 256 */
    params.normal_method = NORMAL_EXACT;
    plants_plan(&plant.plan, &params);
    perturbation_derive(&orbit, &params, &plant.plan.scale, PERTURBATION_CORRECTED, 2u);
    perturbation_derive(&tried, &params, &plant.plan.scale, form, order);
    start = perturbation_forced(&orbit, 0u);
    params.x_initial_m = start.x * plant.plan.scale.length_m;
    params.xd_initial_m_per_s = start.v * plant.plan.scale.speed_m_per_s;
    plants_plan(&plant.plan, &params);
    sim_reset(&plant.sim, &plant.plan);
    for (uint32_t i = 1u; i <= PERIODS * SPP; i++) {
        const float x = (plants_run_steps(&plant, 1u), plant.sim.f32.x);

        largest = fmath_max(largest, fmath_abs(x - perturbation_forced(&tried, i * (0x100000000u / SPP)).x));
        high = fmath_max(high, x);
        low = fmath_min(low, x);
    }
    return largest / (0.5f * (high - low));
}

static void check_orders(void)
{
    tap_check_close(error_of("", PERTURBATION_CORRECTED, 0u), 9.3e-4f, 1e-4f, "Table 1: order 0");
    tap_check_close(error_of("", PERTURBATION_CORRECTED, 1u), 2.9e-6f, 2e-6f, "order 1");
    tap_check(error_of("", PERTURBATION_CORRECTED, 2u) < 4e-6f, "order 2: nothing but rounding");
    tap_check_close(error_of("alpha -0.009", PERTURBATION_CORRECTED, 0u), 4e-3f, 5e-4f, "alpha = -0.009: order 0");
    tap_check_close(error_of("alpha -0.009", PERTURBATION_CORRECTED, 1u), 5.9e-5f, 1e-5f, "order 1");
    tap_check(error_of("alpha -0.009", PERTURBATION_CORRECTED, 2u) < 4e-6f, "order 2");
}

static void check_mirror(void)
{
    tap_check(error_of("v0 -1", PERTURBATION_CORRECTED, 2u) < 4e-6f, "a disc that turns back");
}

static void check_print(void)
{
    tap_check_close(error_of("", PERTURBATION_PRINTED, 2u), 1.4f, 0.1f, "as printed: 140 %");
    tap_check_close(error_of("", PERTURBATION_WITH_COS, 2u), 4.8e-3f, 1e-3f, "with 1 - cos: 0.5 %");
    tap_check_close(error_of("alpha -0.009", PERTURBATION_WITH_COS, 2u), 2.2e-2f, 3e-3f,
                    "and 2 % nearer to N |alpha| = c");
    tap_check_close(error_of("kt 0.25 k 0.5 v0 10", PERTURBATION_WITH_COS, 2u), 2.0f, 0.1f, "200 % for Z < 1");
}

/* From rest: the transient of order 0 leads from 0 to the orbit, and is wrong by no more than the order of eps. */
static void check_transient(void)
{
    struct perturbation solution;
    float largest = 0.0f;

    plants_start(&plant, "spp 256 normal exact");
    perturbation_derive(&solution, &plant.plan.params, &plant.plan.scale, PERTURBATION_CORRECTED, 2u);
    for (uint32_t i = 1u; i <= 20u * SPP; i++) {
        const float periods = (float)i / (float)SPP;
        struct perturbation_state state;

        plants_run_steps(&plant, 1u);
        state = perturbation_from(&solution, (struct perturbation_state){0.0f, 0.0f}, periods);
        largest = fmath_max(largest, fmath_abs(state.x - plant.sim.f32.x) * plant.plan.scale.length_m);
    }
    tap_check(largest < 2e-3f && largest > 1e-5f, "from rest, with its transient");
}

static void check_served(void)
{
    struct params params = plants_params("");

    plants_plan(&plant.plan, &params);
    tap_check(perturbation_is_served(&params, &plant.plan.scale), "Table 1 has it");
    params = plants_params("load ramp t2 1");
    plants_plan(&plant.plan, &params);
    tap_check(!perturbation_is_served(&params, &plant.plan.scale), "a ramp has not");
    params = plants_params("mu_floor 0.1");
    plants_plan(&plant.plan, &params);
    tap_check(!perturbation_is_served(&params, &plant.plan.scale), "nor a floor");
}

void test_perturbation(void)
{
    check_orders();
    check_mirror();
    check_print();
    check_transient();
    check_served();
}
