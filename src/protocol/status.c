/* The answers of status and id. */
#include "protocol/status.h"

#include "base/decimal.h"
#include "base/fmath.h"
#include "model/demand.h"
#include "protocol/commands.h"
#include "protocol/report.h"

enum { STATES = 4 }; /* of the plant: x, xd, y, yd */

#define LOSS_WARNING 1e-3f /* of the normal amplitude a period */

static void write_choice(struct text *text, const struct params *params, const char *symbol)
{
    const struct token word = token_first(symbol);
    const struct params_info *info = params_find(word.start, word.length);
    size_t length;
    const char *name = params_choice_name(info, (unsigned)params_value(params, info), &length);

    text_key_text(text, symbol, "");
    for (size_t i = 0u; i < length; i++) {
        text_put(text, name[i]);
    }
}

static void write_method(struct text *text, const struct sim_plan *plan)
{
    write_choice(text, &plan->params, "arith");
    write_choice(text, &plan->params, "normal");
    write_choice(text, &plan->params, "method");
    text_key_u64(text, "states", STATES);
    text_key_u64(text, "spp", plan->scale.steps_per_period);
}

static void write_loss(struct text *text, const struct sim_plan *plan)
{
    const bool is_rk4 = (int)plan->params.normal_method == NORMAL_RK4;
    const float loss = is_rk4 ? scale_rk4_loss_per_period(&plan->scale) : 0.0f;

    report_field(text, "y_loss_per_period", loss);
    text_key_text(text, "y_loss_warning", loss > LOSS_WARNING ? "yes" : "no");
}

static void write_load(struct text *text, const struct executive_load *load)
{
    report_field(text, "isr_share", fmath_from_u64(load->busy_sum) / fmath_from_u64(load->elapsed));
    report_field(text, "isr_share_max", (float)load->busy_max / (load->elapsed == 0u ? 0.0f : (float)load->period));
    text_key_u64(text, "ticks", load->ticks);
    text_key_u64(text, "overruns", load->overruns);
    text_key_u64(text, "shed", load->shed);
}

static void write_counters(struct text *text, const struct console *console, const struct executive_report *report)
{
    const struct sim_counters *counters = &report->counters;

    text_key_u64(text, "drops", stream_drops(&console->stream, console->executive));
    text_key_u64(text, "caps", counters->caps);
    text_key_u64(text, "saturations", counters->saturations);
    text_key_u64(text, "events", counters->events);
    text_key_u64(text, "lifted", counters->lifted);
    text_key_u64(text, "gap_held", counters->gap_held);
    text_key_u64(text, "inputs", report->counters.inputs);
    text_key_u64(text, "inputs_late", report->counters.inputs_late);
    text_key_u64(text, "inputs_clamped", console->executive->inputs_clamped + counters->lowered);
    text_key_u64(text, "inputs_refused", console->executive->inputs_refused + report->counters.inputs_void);
    text_key_text(text, "input_state", watch_state_name(report->now.watch));
    text_key_u64(text, "times_stale", report->stales);
    text_key_u64(text, "times_safe", report->safes);
    text_key_u64(text, "rejected", console->rejected);
    text_key_u64(text, "garbage", console->line.garbage);
    text_key_u64(text, "uart_lost", console->uart_lost);
    text_key_u64(text, "lines", console->lines);
}

/* The paper's dimensionless groups, at the end of the profiles. */
static void write_groups(struct text *text, const struct sim_plan *plan)
{
    const struct params *params = &plan->params;
    const float impedance = plan->scale.force_n / plan->scale.speed_m_per_s;
    const float load_n = demand_load_end_n(params);
    const float speed_m_per_s = demand_speed_end_m_per_s(params);

    report_field(text, "C", plan->scale.damping);
    report_field(text, "Z2", plan->scale.stiffness);
    report_field(text, "eps", params->friction_slope_s_per_m * load_n / impedance);
    report_field(text, "mu", params->friction_static_ratio);
    report_field(text, "V0", speed_m_per_s * impedance / load_n);
}

static const char *state_name(const struct console *console, const struct executive_report *report)
{
    if (report->now.is_fault != 0u) {
        return "fault";
    }
    return executive_wants_tick(console->executive) ? "run" : "ready";
}

void status_write(struct text *text, const struct console *console, const struct executive_report *report)
{
    const struct sim_plan *plan = executive_plan(console->executive);
    const struct params *params = &plan->params;

    text_key_text(text, "state", state_name(console, report));
    text_key_u64(text, "step", report->now.step);
    text_key_product(text, "t", report->now.step, plan->scale.step_s, DECIMAL_DIGITS_EXACT);
    text_key_u64(text, "generation", report->generation);
    write_method(text, plan);
    text_key_u64(text, "substeps", (uint32_t)params->steps_per_tick);
    text_key_shortest(text, "tick", params->tick_hz);
    report_field(text, "sigma", params->tick_hz * params->steps_per_tick * plan->scale.step_s);
    write_loss(text, plan);
    write_load(text, &report->load);
    write_counters(text, console, report);
    text_key_hex32(text, "hash", report->now.hash);
    text_key_text(text, "fault", report->now.is_fault != 0u ? "domain" : "none");
    write_groups(text, plan);
}

void status_write_id(struct text *text, const struct console *console)
{
    const struct identity *identity = console->identity;

    text_key_text(text, "name", "squeal");
    text_key_text(text, "version", identity->version);
    text_key_text(text, "build", identity->build);
    text_key_text(text, "board", identity->board);
    text_key_text(text, "core", identity->core);
    text_key_text(text, "emulated", identity->is_emulated ? "yes" : "no");
    text_key_text(text, "fpu", identity->has_fpu ? "yes" : "no");
    text_key_text(text, "link", identity->has_link ? "yes" : "no");
    text_key_u64(text, "params", PARAMS_VERSION);
    text_key_u64(text, "signals", SIGNALS_VERSION);
    text_key_u64(text, "commands", COMMANDS_VERSION);
    write_method(text, executive_plan(console->executive));
}
