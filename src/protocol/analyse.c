/* What can be said of the set in force without integrating it. */
#include "protocol/console_parts.h"

#include "analysis/analysis.h"
#include "protocol/report.h"

static void write_mode(struct console *console, const char *name, const struct analysis_mode *mode)
{
    console_begin_body(console);
    text_write(console->text, "mode");
    text_key_text(console->text, "of", name);
    report_field(console->text, "growth_per_s", mode->growth_per_s);
    report_field(console->text, "frequency_hz", mode->frequency_hz);
    report_field(console->text, "damping_ratio", mode->damping_ratio);
    text_end_line(console->text);
}

static void write_slip(struct console *console, const struct analysis *analysis)
{
    console_begin_body(console);
    text_write(console->text, "slip");
    report_field(console->text, "floquet_per_s", analysis->floquet_per_s);
    report_field(console->text, "closed_per_s", analysis->closed_per_s);
    report_field(console->text, "outer_m_per_s", analysis->outer_m_per_s);
    text_end_line(console->text);
}

static void write_borders(struct console *console, const struct analysis *analysis)
{
    console_begin_body(console);
    text_write(console->text, "borders");
    report_field(console->text, "N", analysis->load_n);
    report_field(console->text, "N_grows", analysis->load_border_n);
    report_field(console->text, "alpha_grows", analysis->alpha_border_s_per_m);
    report_field(console->text, "N_touches", analysis->load_touch_n);
    text_end_line(console->text);
}

static void write_forced(struct console *console, const struct analysis *analysis)
{
    console_begin_body(console);
    text_write(console->text, "forced");
    text_key_text(console->text, "served", analysis->has_forced ? "yes" : "no");
    if (analysis->has_forced) {
        report_field(console->text, "order0_um", analysis->forced_um[0]);
        report_field(console->text, "order1_um", analysis->forced_um[1]);
        report_field(console->text, "order2_um", analysis->forced_um[2]);
    }
    text_end_line(console->text);
}

void analyse_obey(struct console *console)
{
    const struct prediction *prediction;
    struct analysis analysis;

    analysis_make(&analysis, executive_params(console->executive), &executive_plan(console->executive)->scale);
    prediction = &analysis.prediction;
    write_mode(console, "tangential", &analysis.tangential);
    write_mode(console, "normal", &analysis.normal);
    write_slip(console, &analysis);
    write_borders(console, &analysis);
    write_forced(console, &analysis);
    console_begin_ok(console);
    text_key_text(console->text, "predicted", predictor_verdict_name(prediction->verdict));
    report_field(console->text, "touch_ratio", prediction->touch_ratio);
    report_field(console->text, "onset_touch_ratio", prediction->onset_touch_ratio);
    text_key_text(console->text, "bistable", prediction->is_bistable ? "yes" : "no");
    console_end(console);
}
