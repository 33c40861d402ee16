/* The controller's vehicle and score, against sums made by hand. */
#include "hil/controller/stop.h"

#include "sim/detector.h"

#include "tap.h"
#include "tests.h"

/* A turn of 10 ms; 100 kg for two faces; a lever of a quarter: 100 N of friction slow it by 0.5 m/s in a second. */
static const struct brake brake = {
    .step_s = 1e-4f,
    .turn_steps = 100u,
    .pad_kg = 0.5f,
    .contact_n_per_m = 1.5e6f,
    .caliper_n_per_m = 0.5e6f,
    .friction_ratio = 0.5f,
    .piston_area_m2 = 1e-3f,
    .radius_m = 0.1f,
    .tyre_radius_m = 0.4f,
};
static const struct stop_settings settings = {
    .speed_m_per_s = 1.0f,
    .mass_kg = 100.0f,
    .faces = 2.0f,
    .demand_pa = 1e6f,
    .apply_s = 0.1f,
    .limit_s = 5.0f,
};

static void check_demand(void)
{
    struct stop stop = stop_start(&settings, &brake);

    tap_check(stop_demand_pa(&settings, &stop, &brake) == 0.0f, "the driver begins with nothing");
    stop.turns = 5u;
    tap_check_close(stop_demand_pa(&settings, &stop, &brake), 5e5f, 1.0f, "half way up after half the time");
    stop.turns = 11u;
    tap_check(stop_demand_pa(&settings, &stop, &brake) == settings.demand_pa, "then keeps it");
    tap_check_close(stop_time_s(&stop, &brake), 0.11f, 1e-6f, "time is turns");
}

static void check_vehicle(void)
{
    const struct master_state state = {.load_n = 200.0f, .friction_n = 100.0f, .propensity = PROPENSITY_QUIET};
    struct stop stop = stop_start(&settings, &brake);
    unsigned turns = 0u;

    for (; turns < 100u; turns++) {
        stop = stop_next(&settings, &stop, &brake, &state);
    }
    tap_check_close(stop.speed_m_per_s, 0.5f, 1e-4f, "a second of 100 N");
    while (!stop_is_over(&settings, &stop, &brake) && turns < 1000u) {
        stop = stop_next(&settings, &stop, &brake, &state);
        turns++;
    }
    tap_check(turns >= 200u && turns <= 201u && stop.speed_m_per_s == 0.0f,
              "it stands after two, and does not roll back");
    stop = stop_start(&settings, &brake);
    stop.turns = 500u;
    tap_check(stop_is_over(&settings, &stop, &brake), "or time is up");
}

static void check_score(void)
{
    const struct master_state loud = {.load_n = 1000.0f, .friction_n = 400.0f, .propensity = PROPENSITY_SQUEAL};
    const struct master_state quiet = {.load_n = 500.0f, .friction_n = 200.0f, .propensity = PROPENSITY_QUIET};
    const struct master_state nothing = {.propensity = PROPENSITY_QUIET};
    struct stop stop = stop_start(&settings, &brake);

    tap_check(stop_kept_ratio(&stop) == 0.0f && stop_squeal_ratio(&stop) == 0.0f, "no score without a turn");
    stop.turns = 20u; /* the driver's 1000 N stand */
    stop = stop_next(&settings, &stop, &brake, &loud);
    tap_check_close(stop_kept_ratio(&stop), 1.0f, 1e-5f, "what the driver wants: all is kept");
    stop = stop_next(&settings, &stop, &brake, &quiet);
    tap_check_close(stop_kept_ratio(&stop), 0.75f, 1e-5f, "half the force: half of it");
    stop = stop_next(&settings, &stop, &brake, &nothing);
    tap_check_close(stop_kept_ratio(&stop), 0.5f, 1e-5f, "no force at all counts with the friction seen last");
    tap_check_close(stop_squeal_ratio(&stop), 1.0f / 23.0f, 1e-6f, "one loud turn");
}

static void check_amplitude(void)
{
    const struct master_state still = {.x_m = 1e-4f, .friction_n = 200.0f};
    const struct master_state away = {.x_m = 1.03e-4f, .friction_n = 200.0f, .xd_m_per_s = 8e-3f};

    tap_check_close(stop_amplitude_m(&brake, &still), 0.0f, 1e-10f, "where friction holds it the pad does not swing");
    tap_check_close(stop_amplitude_m(&brake, &away), 5e-6f, 1e-9f, "3 um away, at the speed of 4: it swings by 5");
}

void test_stop(void)
{
    check_demand();
    check_vehicle();
    check_score();
    check_amplitude();
}
