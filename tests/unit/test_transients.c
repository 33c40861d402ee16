/* What a real plant does on its way must not read as squeal, however it begins; nor is squeal at a creep missed. */
#include "sim/detector.h"

#include "plants.h"
#include "tap.h"
#include "tests.h"

static struct plant plant;

/* Was the verdict squeal at any time within so many periods? */
static bool squeals(const char *assignments, uint32_t periods)
{
    bool is_squeal = false;

    plants_start(&plant, assignments);
    for (uint32_t period = 0u; period < periods && !is_squeal; period++) {
        plants_run_periods(&plant, 1u);
        is_squeal = plant.sim.detector.verdict.propensity == PROPENSITY_SQUEAL;
    }
    return is_squeal;
}

/* The corner at a ramp's end leaves a free motion that is larger than the forced one, and decays. */
static void check_jolt(void)
{
    static const char *const ramp = "m 0.0198028 c 6.92534 v0 3.40891 mu_s 0.634063 alpha -0.000854395 ke 8479290 "
                                    "kt 796943 k 1745350 load ramp N0 0 N1 5968.96 t2 0.00800475 normal exact";

    plants_start(&plant, ramp);
    tap_check(plant.plan.prediction.verdict == PREDICTION_QUIET, "a load that comes fast");
    tap_check(!squeals(ramp, 300u), "jolts the pad, which is no squeal");
}

/* Next to the normal frequency strobes hardly differ, and the free part drowns in rounding long before the motion
 * ends. */
static void check_slow_strobes(void)
{
    static const char *const near =
        "m 0.0179743 c 2.15283 v0 -0.112349 mu_s 0.466186 alpha -0.000331959 ke 6158670 "
        "kt 1086720 k 5482310 N0 3966.67 mu_floor 0.382244 y0 0.000644078997576 normal exact";

    tap_check(!squeals(near, 700u), "a decay that growth cannot follow is no squeal");
    tap_check(plant.sim.detector.verdict.motion == CLASS_REST, "and ends in rest");
}

/* The disc creeps at 3e-5 of the model's unit of speed. */
static void check_creep(void)
{
    static const char *const creep =
        "m 0.000841291 c 0.90578 v0 -0.0102971 mu_s 0.600812 alpha -0.000168471 ke 2104660 "
        "kt 828370 k 5084570 cn 1.01652 N0 6268.18 normal exact";

    tap_check(squeals(creep, 1500u), "stick-slip under a creeping disc is squeal");
}

void test_transients(void)
{
    check_jolt();
    check_slow_strobes();
    check_creep();
}
