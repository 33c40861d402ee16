/* Parameters as text. */
#include "protocol/values.h"

#include "base/compiler.h"
#include "base/fmath.h"
#include "model/scale.h"

enum { DIGITS = 4 };

/* What helps, where the error's own sentence is too general. */
static const struct hint {
    enum error error;
    const char *symbol, *text;
} hints[] = {
    {ERROR_OUT_OF_SCALE, "N0", ", latched at reset; raise N_max"},
    {ERROR_OUT_OF_SCALE, "v0", ", latched at reset; raise v_max"},
    {ERROR_OUT_OF_SCALE, "kt", "; raise ke"},
    {ERROR_OUT_OF_SCALE, "mu_s", ", latched at reset; raise v_max"},
    {ERROR_OUT_OF_SCALE, "alpha", "; lower N_max"},
    {ERROR_OUT_OF_RANGE, "t2", "; the ramp ends after its start t1"},
    {ERROR_OUT_OF_RANGE, "tv2", "; the ramp ends after its start tv1"},
    {ERROR_NOT_SERVED, "method", "; naive goes with normal rk4 only"},
};

static void write_names(struct text *text, const struct params_info *info)
{
    size_t length;
    const char *name;

    for (unsigned i = 0u; (name = params_choice_name(info, i, &length)) != NULL && length != 0u; i++) {
        if (i > 0u) {
            text_put(text, '|');
        }
        for (size_t j = 0u; j < length; j++) {
            text_put(text, name[j]);
        }
    }
}

void values_write(struct text *text, const struct params_info *info, float value)
{
    size_t length = 0u;
    const char *name = NULL;

    if (params_is_choice(info) && value >= 0.0f && value < 64.0f) {
        name = params_choice_name(info, (unsigned)value, &length);
    }
    if (name == NULL) {
        text_shortest(text, value);
    }
    for (size_t i = 0u; i < length; i++) {
        text_put(text, name[i]);
    }
}

void values_write_unit(struct text *text, const struct params_info *info)
{
    if (!params_is_choice(info) && !token_equal(info->unit, 1u, "1")) {
        text_put(text, ' ');
        text_write(text, info->unit);
    }
}

void values_write_unit_word(struct text *text, const struct params_info *info)
{
    if (params_is_choice(info)) {
        write_names(text, info);
        return;
    }
    for (const char *c = info->unit; *c != '\0' && *c != ','; c++) {
        text_put(text, *c == ' ' ? '.' : *c);
    }
}

void values_write_range(struct text *text, const struct params_info *info, float low, float high)
{
    if (params_is_choice(info)) {
        write_names(text, info);
        return;
    }
    text_shortest(text, low);
    text_write(text, " .. ");
    text_shortest(text, high);
}

/* "0 .. 12000 N", "1 .. 64, a whole number" */
void values_write_allowed(struct text *text, const struct params_info *info, float low, float high)
{
    values_write_range(text, info, low, high);
    if (token_is(token_first(info->unit), "count")) {
        text_write(text, ", a whole number");
    } else {
        values_write_unit(text, info);
    }
}

/* z as model/scale.c judges it. */
static float step_of(const struct params *params)
{
    const float impedance = fmath_sqrt(params->mass_kg) * fmath_sqrt(params->stiffness_normal_n_per_m);
    const float stiffness =
        (params->stiffness_contact_n_per_m + params->stiffness_caliper_n_per_m) / params->stiffness_normal_n_per_m;
    const float damping = fmath_max(params->damping_n_s_per_m, params->damping_normal_n_s_per_m) / impedance;

    return 2.0f * FMATH_PI / (float)scale_steps_per_period(params) *
           fmath_max(fmath_max(1.0f, fmath_sqrt(stiffness)), damping);
}

static void write_hint(struct text *text, const struct params_problem *problem)
{
    for (size_t i = 0u; i < BASE_COUNT(hints); i++) {
        if (hints[i].error == problem->error && token_is(token_first(hints[i].symbol), problem->info->symbol)) {
            text_write(text, hints[i].text);
        }
    }
}

static void write_reason(struct text *text, const struct params_problem *problem, const struct params *wanted)
{
    if (problem->error == ERROR_OUT_OF_RANGE || problem->error == ERROR_OUT_OF_SCALE) {
        values_write_allowed(text, problem->info, problem->low, problem->high);
    } else if (problem->error == ERROR_STEP_TOO_LARGE) {
        text_write(text, "z = ");
        text_f32(text, step_of(wanted), DIGITS);
        text_write(text, " exceeds ");
        text_f32(text, SCALE_STEP_MAX, DIGITS);
        text_write(text, "; raise spp or ke");
    } else {
        text_write(text, error_text(problem->error));
    }
    write_hint(text, problem);
}

void values_write_problem(struct text *text, const struct params_problem *problem, const struct params *wanted,
                          struct token typed)
{
    if (problem->info == NULL) {
        text_write(text, ": ");
        text_write(text, error_text(problem->error));
        return;
    }
    text_put(text, ' ');
    text_write(text, problem->info->symbol);
    text_put(text, '=');
    if (typed.length != 0u) {
        token_write(text, typed);
    } else {
        values_write(text, problem->info, params_value(wanted, problem->info));
    }
    text_write(text, ": ");
    write_reason(text, problem, wanted);
}
