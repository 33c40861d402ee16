/* The table of parameters is sane, and what lies outside it is refused by name. */
#include "model/params.h"

#include "plants.h"
#include "tap.h"
#include "tests.h"

enum { ROWS_MAX = 128 };

static uint32_t length_of(const char *text)
{
    uint32_t length = 0u;

    while (text[length] != '\0') {
        length++;
    }
    return length;
}

static const struct params_info *find(const char *name) { return params_find(name, length_of(name)); }

static void check_table(void)
{
    bool are_found = true;
    bool are_inside = true;
    bool are_told = true;
    bool are_unique = true;
    bool are_placed = true;
    uint64_t ids[ROWS_MAX / 64] = {0u};

    for (size_t i = 0u; i < params_count; i++) {
        const struct params_info *info = &params_table[i];

        are_found = are_found && find(info->symbol) == info && find(info->field) == info;
        are_inside = are_inside && info->low <= info->standard && info->standard <= info->high;
        are_told = are_told && *info->help != '\0' && *info->unit != '\0';
        are_unique =
            are_unique && info->id >= 1u && info->id < ROWS_MAX && (ids[info->id / 64u] >> info->id % 64u & 1u) == 0u;
        ids[info->id % ROWS_MAX / 64u] |= (uint64_t)1 << info->id % 64u;
        are_placed = are_placed && info->offset == i * sizeof(float);
    }
    tap_check(params_count > 30u && are_unique, "every parameter has an id of its own");
    tap_check(are_found, "symbol and field name lead to the parameter that bears them and to no earlier one");
    tap_check(are_inside, "every default lies inside its range");
    tap_check(are_told, "every parameter has a unit and a help text");
    tap_check(are_placed && params_count * sizeof(float) == offsetof(struct params, tables),
              "the table covers the whole struct");
    tap_check(find("mu") == NULL && find("mu_s2") == NULL && find("") == NULL && params_find("mu_sxx", 4u) != NULL,
              "names are compared whole, no further than their length");
}

static void check_access(void)
{
    struct params params = plants_params("");
    struct params other = params;
    bool are_kept = true;

    for (size_t i = 0u; i < params_count; i++) {
        params_set(&other, &params_table[i], (float)(i + 100u));
    }
    for (size_t i = 0u; i < params_count; i++) {
        are_kept = are_kept && params_value(&other, &params_table[i]) == (float)(i + 100u) &&
                   params_value(&params, &params_table[i]) == params_table[i].standard;
    }
    tap_check(are_kept, "every parameter is set and read in its own place");
    tap_check(other.mass_kg == 100.0f && params.friction_static_ratio == 0.3f, "which is the field of its name");
}

/* Is every value refused that one parameter must not have, and is the parameter named? */
static bool refuses(const struct params_info *info, float value)
{
    struct params params = plants_params("");
    struct params_problem problem;

    params_set(&params, info, value);
    problem = params_check(&params);
    return problem.error == ERROR_OUT_OF_RANGE && problem.info == info && problem.low == info->low &&
           problem.high == info->high;
}

static bool accepts(const struct params_info *info, float value)
{
    struct params params = plants_params("");

    params_set(&params, info, value);
    return params_check(&params).error == ERROR_OK;
}

static bool holds_whole_numbers(const struct params_info *info)
{
    return params_is_choice(info) || info->unit[0] == 'c';
}

static void check_ranges(void)
{
    const float zero = params_table[0].low - params_table[0].low;
    struct params params = plants_params("");
    bool refuse_nan = true;
    bool refuse_outside = true;
    bool refuse_parts = true;
    bool accept_ends = true;

    for (size_t i = 0u; i < params_count; i++) {
        const struct params_info *info = &params_table[i];

        refuse_nan = refuse_nan && refuses(info, zero / zero);
        refuse_outside = refuse_outside && refuses(info, 3e38f) && refuses(info, -3e38f) &&
                         refuses(info, 1.0f / zero) && refuses(info, -1.0f / zero);
        accept_ends = accept_ends && accepts(info, info->low) && accepts(info, info->high);
        if (holds_whole_numbers(info)) {
            refuse_parts = refuse_parts && refuses(info, info->low + 0.5f) && refuses(info, info->high + 1.0f) &&
                           refuses(info, info->low - 1.0f);
        }
    }
    tap_check(params_check(&params).error == ERROR_OK && params_check(&params).info == NULL, "the defaults pass");
    tap_check(accept_ends, "both ends of every range pass");
    tap_check(refuse_outside, "what lies outside is refused by name and range, infinities too");
    tap_check(refuse_nan, "so is NaN, which lies in no range");
    tap_check(refuse_parts, "choices and counts take whole numbers only");
}

static void check_choices(void)
{
    const struct params_info *contact = find("contact");
    const struct params_info *arith = find("arith");
    const struct params_info *spp = find("spp");
    size_t length = 0u;
    bool have_names = true;

    for (size_t i = 0u; i < params_count; i++) {
        const struct params_info *info = &params_table[i];

        for (unsigned choice = 0u; params_is_choice(info) && choice <= (unsigned)info->high; choice++) {
            have_names = have_names && params_choice_name(info, choice, &length) != NULL && length > 0u;
        }
        have_names = have_names && (!params_is_choice(info) || params_choice_name(info, 9u, &length) == NULL);
    }
    tap_check(have_names, "every choice inside its range has a name, none outside has");
    tap_check(params_is_choice(contact) && params_is_choice(arith) && !params_is_choice(find("m")) &&
                  !params_is_choice(find("substeps")),
              "choices are told from numbers");
    tap_check(params_choice_name(contact, 1u, &length) != NULL && length == 7u &&
                  params_choice_name(contact, 1u, &length)[0] == 'n',
              "the second kind of contact is no_pull");
    tap_check(params_choice_name(spp, 6u, &length) != NULL && length == 4u, "the last number of steps is 1024");
}

static void check_parse(void)
{
    const struct params_info *contact = find("contact");
    const struct params_info *mass = find("m");
    float value = 77.0f;

    tap_check(params_parse(contact, "lift", 4u, &value) == ERROR_OK && value == (float)CONTACT_LIFT,
              "a choice is read by its name");
    value = 77.0f;
    tap_check(params_parse(contact, "lif", 3u, &value) == ERROR_OUT_OF_RANGE &&
                  params_parse(contact, "lifted", 6u, &value) == ERROR_OUT_OF_RANGE &&
                  params_parse(contact, "2", 1u, &value) == ERROR_OUT_OF_RANGE && value == 77.0f,
              "neither part of a name nor its number is a choice, and the value stays");
    tap_check(params_parse(mass, "12e-1", 5u, &value) == ERROR_OK && value == 1.2f, "a number is read as one");
    value = 77.0f;
    tap_check(params_parse(mass, "1,5", 3u, &value) == ERROR_BAD_NUMBER &&
                  params_parse(mass, "nan", 3u, &value) == ERROR_BAD_NUMBER && value == 77.0f,
              "what is no number leaves the value alone");
}

static void check_changes(void)
{
    const struct params from = plants_params("");
    struct params to = from;
    bool are_told = true;

    tap_check(params_restart_change(&from, &to) == NULL, "equal sets need no restart");
    for (size_t i = 0u; i < params_count; i++) {
        const struct params_info *info = &params_table[i];

        to = from;
        params_set(&to, info, params_value(&to, info) + 1.0f);
        are_told = are_told && params_restart_change(&from, &to) == (info->change == PARAMS_RESTART ? info : NULL);
    }
    tap_check(are_told, "a change that needs a restart is named, a live one is not");
    tap_check(find("m")->change == PARAMS_RESTART && find("ke")->change == PARAMS_RESTART &&
                  find("spp")->change == PARAMS_RESTART && find("N0")->change == PARAMS_LIVE &&
                  find("alpha")->change == PARAMS_LIVE && find("kt")->change == PARAMS_LIVE,
              "the scale's parameters restart, load and friction are live");
}

void test_params(void)
{
    check_table();
    check_access();
    check_ranges();
    check_choices();
    check_parse();
    check_changes();
}
