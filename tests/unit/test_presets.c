/* Every preset loads, and assignments are taken whole or not at all. */
#include "model/presets.h"

#include "model/scale.h"
#include "plants.h"
#include "tap.h"
#include "tests.h"

static uint32_t length_of(const char *text)
{
    uint32_t length = 0u;

    while (text[length] != '\0') {
        length++;
    }
    return length;
}

static void check_table(void)
{
    bool are_found = true;
    bool are_told = true;
    bool are_served = true;

    for (size_t i = 0u; i < presets_count; i++) {
        const struct preset *preset = &presets_table[i];
        struct params params;
        struct sim_plan plan;

        presets_load(preset, &params);
        are_found = are_found && presets_find(preset->name, length_of(preset->name)) == preset;
        are_told = are_told && length_of(preset->help) > 10u;
        if (sim_plan_make(&plan, &params, NULL).error != ERROR_OK) {
            are_served = false;
            tap_note(preset->name);
        }
    }
    tap_check(presets_count > 30u && are_found, "every preset has a name of its own");
    tap_check(are_told, "every preset says what it is");
    tap_check(are_served, "every preset loads and fits its scale");
    tap_check(presets_find("brak", 4u) == NULL && presets_find("brakes", 6u) == NULL &&
                  presets_find("brakes", 5u) != NULL && presets_find("", 0u) == NULL,
              "names are compared whole");
}

static void check_values(void)
{
    struct params params = plants_preset("brake", "");

    tap_check(params.mass_kg == 0.3f && params.damping_n_s_per_m == 120.0f &&
                  params.damping_normal_n_s_per_m == 219.0f && params.stiffness_normal_n_per_m == 1e8f &&
                  params.stiffness_contact_n_per_m == 4e7f && params.stiffness_caliper_n_per_m == 7.5e6f &&
                  params.friction_static_ratio == 0.42f && params.friction_slope_s_per_m == -0.06f &&
                  params.friction_floor_ratio == 0.36f && params.speed_m_per_s == 0.1f &&
                  params.load_profile == (float)LOAD_RAMP && params.load_n == 0.0f && params.load_end_n == 3000.0f &&
                  params.load_end_s == 0.05f && params.roughness_ratio == 2.5e-7f && params.runout_ratio == 1e-3f,
              "brake is the documented set");
    params = plants_preset("fig5-n10", "");
    tap_check(params.load_n == 10.0f && params.mass_kg == 0.3f && params.load_profile == (float)LOAD_CONSTANT &&
                  params.roughness_ratio == 0.0f && params.runout_ratio == 0.0f,
              "a preset starts from Table 1 and changes what it names");
}

static bool refuses(const char *assignments, enum error error, const char *symbol, uint32_t bad_at, uint32_t bad_size)
{
    const struct params before = plants_params("");
    struct params params = before;
    const struct params_info *info = NULL;
    const char *bad = assignments;
    size_t bad_length = 0u;
    bool ok = presets_assign(&params, assignments, &info, &bad, &bad_length) == error;

    ok = ok && bad == assignments + bad_at && bad_length == bad_size;
    ok = ok && (symbol == NULL ? info == NULL : info == params_find(symbol, length_of(symbol)));
    for (size_t i = 0u; i < params_count; i++) {
        ok = ok && params_value(&params, &params_table[i]) == params_value(&before, &params_table[i]);
    }
    return ok;
}

static void check_assign(void)
{
    struct params params = plants_params("  v0  2.5   load ramp friction_static_ratio 0.5 ");
    const struct params_info *info;
    const char *bad;
    size_t bad_length;

    tap_check(params.speed_m_per_s == 2.5f && params.load_profile == (float)LOAD_RAMP &&
                  params.friction_static_ratio == 0.5f && params.mass_kg == 0.3f,
              "symbols and field names, numbers and choices, any number of blanks");
    tap_check(refuses("v0 2 nothing 5", ERROR_UNKNOWN_NAME, NULL, 5u, 7u), "an unknown name is pointed at");
    tap_check(refuses("v0 2 N0 3 m 1x", ERROR_BAD_NUMBER, "m", 12u, 2u), "so is what is no number");
    tap_check(refuses("v0 2 load hill", ERROR_OUT_OF_RANGE, "load", 10u, 4u), "so is an unknown choice");
    tap_check(refuses("v0 2 N0", ERROR_USAGE, "N0", 5u, 2u), "so is a name without a value");
    tap_check(presets_assign(&params, "  ", &info, &bad, &bad_length) == ERROR_OK && params.speed_m_per_s == 2.5f,
              "no assignment changes nothing");
}

void test_presets(void)
{
    check_table();
    check_values();
    check_assign();
}
