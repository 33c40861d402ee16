/* The acts, one after the other. Steps are granted a detector's frame at a time, so that the instant at which squeal is
 * recognised does not depend on how fast main is. */
#include "protocol/demo.h"

#include "base/assert.h"
#include "base/compiler.h"
#include "model/presets.h"
#include "protocol/console_parts.h"
#include "protocol/report.h"

enum { DIGITS = 4 }; /* enough for a sentence */

#define STILL_UM 0.01f /* a motion smaller than this is none worth telling */

static const struct act {
    uint8_t number;
    const char *title, *preset, *assignments;
    uint32_t periods;
} acts[] = {
#define ACT(number, title, preset, assignments, periods) {number, title, preset, assignments, periods},
#include "protocol/demo.def"
#undef ACT
};

void demo_obey(struct console *console)
{
    const struct token word = token_first(console->arguments);
    uint32_t number = 0u;

    if (token_next(word).length != 0u) {
        console_refuse_usage(console);
        return;
    }
    if (word.length != 0u && !token_number(word, 1u, BASE_COUNT(acts), &number)) {
        console_refuse_count(console, "act", word, 1u, BASE_COUNT(acts));
        return;
    }
    console->demo.act = number == 0u ? 0u : (uint8_t)(number - 1u);
    console->demo.last = number == 0u ? (uint8_t)(BASE_COUNT(acts) - 1u) : console->demo.act;
    console->demo.stage = DEMO_OPENS;
    console_start_task(console, CONSOLE_TASK_DEMO);
}

/* Everything but the pace and the number format, which are the user's. */
static void load_act(const struct act *act, const struct params *now, struct params *params)
{
    const struct preset *preset = presets_find(act->preset, token_first(act->preset).length);
    const struct params_info *info;
    const char *bad;
    size_t bad_length;
    enum error error;

    BASE_ASSERT(preset != NULL);
    presets_load(preset, params);
    error = presets_assign(params, act->assignments, &info, &bad, &bad_length);
    BASE_ASSERT(error == ERROR_OK);
    params->arithmetic = now->arithmetic;
    params->tick_hz = now->tick_hz;
    params->steps_per_tick = now->steps_per_tick;
}

static void write_from_to(struct text *text, const char *name, float from, float to, const char *unit)
{
    text_write(text, name);
    text_shortest(text, from);
    if (to != from) {
        text_write(text, " to ");
        text_shortest(text, to);
    }
    text_write(text, unit);
}

/* "- N = 0 to 1500 N, v0 = 0.1 m/s, mu_s = 0.42, ..." */
static void tell_set(struct console *console, const struct act *act, const struct params *params)
{
    struct text *text = console->text;
    const bool load_ends = (int)params->load_profile != LOAD_CONSTANT;
    const bool speed_ends = (int)params->speed_profile != SPEED_CONSTANT;
    const struct scale *scale = &executive_plan(console->executive)->scale;

    console_begin_body(console);
    write_from_to(text, "N = ", params->load_n, load_ends ? params->load_end_n : params->load_n, " N");
    write_from_to(text, ", v0 = ", params->speed_m_per_s,
                  speed_ends ? params->speed_end_m_per_s : params->speed_m_per_s, " m/s");
    write_from_to(text, ", mu_s = ", params->friction_static_ratio, params->friction_static_ratio, "");
    write_from_to(text, ", alpha = ", params->friction_slope_s_per_m, params->friction_slope_s_per_m, " s/m");
    write_from_to(text, ", c = ", params->damping_n_s_per_m, params->damping_n_s_per_m, " N s/m; ");
    text_product(text, (uint64_t)act->periods * scale->steps_per_period, scale->step_s, DIGITS);
    text_write(text, " s are ");
    text_u64(text, act->periods);
    text_write(text, " normal periods");
    console_end(console);
}

static void open_act(struct console *console)
{
    const struct act *act = &acts[console->demo.act];
    struct params params;
    struct params_problem problem;

    load_act(act, executive_params(console->executive), &params);
    problem = executive_reset(console->executive, &params);
    BASE_ASSERT(problem.error == ERROR_OK);
    console->demo.has_squealed = false;
    console_begin_body(console);
    text_write(console->text, "act ");
    text_u64(console->text, act->number);
    text_write(console->text, ": ");
    text_write(console->text, act->title);
    console_end(console);
    tell_set(console, act, &params);
}

static void write_length(struct text *text, float length_um)
{
    if (length_um < 1e3f) {
        text_f32(text, length_um, DIGITS);
        text_write(text, " um");
    } else if (length_um < 1e6f) {
        text_f32(text, length_um / 1e3f, DIGITS);
        text_write(text, " mm");
    } else {
        text_f32(text, length_um / 1e6f, DIGITS);
        text_write(text, " m");
    }
}

static void tell_squeal(struct text *text, const struct report_verdict *judged)
{
    if (!judged->is_audible) {
        text_write(text, "The pad vibrates by itself, though nobody can hear it: ");
    } else if (judged->band == REPORT_GROAN) {
        text_write(text, "The brake groans: ");
    } else {
        text_write(text, "The brake squeals: ");
    }
    text_f32(text, judged->frequency_hz, DIGITS);
    text_write(text, " Hz, ");
    write_length(text, judged->amplitude_um);
    text_write(text, ", sticking ");
    text_f32(text, judged->stick * 100.0f, 3u);
    text_write(text, " % of the time.");
}

static void tell_quiet(struct text *text, const struct report_verdict *judged)
{
    if (judged->amplitude_um < STILL_UM) {
        text_write(text, "The brake is quiet: the pad slides and stands still within ");
        write_length(text, STILL_UM);
    } else {
        text_write(text, "The brake is quiet: the pad slides, and swings with its load by ");
        write_length(text, judged->amplitude_um);
    }
    text_put(text, '.');
}

/* The sentence of an act, made from what was measured. */
static void tell_outcome(struct console *console, const struct report_verdict *judged)
{
    struct text *text = console->text;

    console_begin_body(console);
    switch ((enum detector_propensity)judged->propensity) {
    case PROPENSITY_SQUEAL:
        tell_squeal(text, judged);
        break;
    case PROPENSITY_QUIET:
        tell_quiet(text, judged);
        break;
    case PROPENSITY_WATCH:
        text_write(text, "Not settled yet: the motion may still grow.");
        break;
    case PROPENSITY_UNKNOWN:
    default:
        text_write(text, "Too short to tell.");
        break;
    }
    console_end(console);
}

static void tell_beginning(struct console *console, const struct sim_plan *plan)
{
    struct text *text = console->text;

    console_begin_body(console);
    text_write(text, "Squeal began at t = ");
    text_product(text, console->demo.squeal_step, plan->scale.step_s, DIGITS);
    text_write(text, " s, v0 = ");
    text_f32(text, profile_value(&plan->speed.profile, console->demo.squeal_step) * plan->scale.speed_m_per_s, DIGITS);
    text_write(text, " m/s.");
    console_end(console);
}

static void close_act(struct console *console, const struct executive_report *report)
{
    const struct sim_plan *plan = executive_plan(console->executive);
    const struct report_verdict judged = report_judge(&report->verdict, &plan->scale);

    console_begin_body(console);
    text_write(console->text, "verdict");
    report_write_verdict(console->text, report, plan);
    console_end(console);
    tell_outcome(console, &judged);
    if ((int)plan->params.speed_profile != SPEED_CONSTANT && console->demo.has_squealed) {
        tell_beginning(console, plan);
    }
}

static void end_demo(struct console *console)
{
    console_begin_ok(console);
    text_key_u64(console->text, "act", acts[console->demo.act].number);
    console_end(console);
    console_end_task(console);
}

static bool play_act(struct console *console)
{
    struct demo *demo = &console->demo;
    const struct sim_plan *plan = executive_plan(console->executive);
    const uint32_t frame_steps = plan->scale.steps_per_period * DETECTOR_FRAME_PERIODS;
    struct executive_report report;
    const enum console_progress progress = console_go_on(console, frame_steps, &report);

    if (progress == CONSOLE_WAITS) {
        return false;
    }
    if (report.verdict.propensity == PROPENSITY_SQUEAL && !demo->has_squealed) {
        demo->has_squealed = true;
        demo->squeal_step = (uint64_t)report.verdict.frame * frame_steps;
    }
    if (progress == CONSOLE_ADVANCES) {
        return true;
    }
    close_act(console, &report);
    if (demo->act == demo->last) {
        end_demo(console);
    } else {
        demo->act++;
        demo->stage = DEMO_OPENS;
    }
    return true;
}

bool demo_continue(struct console *console)
{
    struct demo *demo = &console->demo;

    if (executive_has_order(console->executive)) {
        return false;
    }
    switch (demo->stage) {
    case DEMO_OPENS:
        open_act(console);
        demo->stage = DEMO_IS_SET;
        return true;
    case DEMO_IS_SET:
        console_begin_steps(console, (uint64_t)acts[demo->act].periods *
                                         executive_plan(console->executive)->scale.steps_per_period);
        demo->stage = DEMO_PLAYS;
        return true;
    case DEMO_PLAYS:
    default:
        return play_act(console);
    }
}
