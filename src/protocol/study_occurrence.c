/* occurrence: the share of squeal among brakes that differ a little. */
#include "base/fmath.h"
#include "protocol/report.h"
#include "protocol/study_parts.h"
#include "protocol/values.h"

/* The amount of this name; OCCURRENCE_AMOUNTS if there is none. */
static enum occurrence_amount find_amount(struct token word)
{
    unsigned i = 0u;

    while (i < OCCURRENCE_AMOUNTS && !token_is(word, occurrence_name((enum occurrence_amount)i))) {
        i++;
    }
    return (enum occurrence_amount)i;
}

/* "normal|uniform", "seed <n>", "<amount> <spread>" in any order; *word moves past them. */
static bool read_scatter(struct console *console, struct token *word, struct occurrence *occurrence)
{
    bool has_spread = false;

    for (; word->length != 0u && !study_is_span(*word); *word = token_next(*word)) {
        const enum occurrence_amount amount = find_amount(*word);

        if (token_is(*word, "normal") || token_is(*word, "uniform")) {
            occurrence->is_uniform = token_is(*word, "uniform");
        } else if (token_is(*word, "seed")) {
            *word = token_next(*word);
            if (!study_read_count(console, "seed", *word, 0u, OCCURRENCE_SEED_MAX, &occurrence->seed)) {
                return false;
            }
        } else if (amount != OCCURRENCE_AMOUNTS) {
            *word = token_next(*word);
            if (!console_read_number(console, occurrence_name(amount), *word, 0.0f, OCCURRENCE_SPREAD_MAX,
                                     &occurrence->spread[amount])) {
                return false;
            }
            has_spread = true;
        } else {
            console_refuse_usage(console);
            return false;
        }
    }
    for (unsigned i = 0u; i < OCCURRENCE_AMOUNTS && !has_spread; i++) {
        occurrence->spread[i] = OCCURRENCE_SPREAD_DEFAULT;
    }
    return true;
}

void study_occurrence_obey(struct console *console)
{
    struct token word = token_first(console->arguments);
    struct study_occurrence study = {.occurrence = {.base = *executive_params(console->executive)}};
    struct trial_span span = {.transient = TRIAL_TRANSIENT_BRIEF, .window = TRIAL_WINDOW_DEFAULT, .is_brief = true};

    if (!study_read_count(console, "trials", word, 1u, OCCURRENCE_TRIALS_MAX, &study.of)) {
        return;
    }
    word = token_next(word);
    if (!read_scatter(console, &word, &study.occurrence) || !study_read_span(console, word, &span)) {
        return;
    }
    console->study.occurrence = study;
    console->study.span = span;
    study_start(console, CONSOLE_TASK_OCCURRENCE);
}

static void write_draw(struct console *console, const struct params_problem *problem)
{
    const struct occurrence_draw *draw = &console->study.occurrence.draw;
    struct text *text = console->text;

    console_begin_body(console);
    text_write(text, "trial");
    text_key_u64(text, "done", console->study.occurrence.done);
    text_key_u64(text, "of", console->study.occurrence.of);
    for (unsigned i = 0u; i < OCCURRENCE_AMOUNTS; i++) {
        const char *name = occurrence_name((enum occurrence_amount)i);

        report_field(text, i == OCCURRENCE_LOAD ? "N_factor" : name, draw->values[i]);
    }
    study_write_outcome(text, &console->study.trial, problem);
    console_end(console);
}

static void answer(struct console *console)
{
    const struct study *study = &console->study;
    const uint32_t loud = study->tally.loud;
    const uint32_t tried = study->tally.trials - study->tally.refused;
    float low = 0.0f;
    float high = 1.0f;

    if (tried > 0u) {
        occurrence_interval(loud, tried, &low, &high);
    }
    console_begin_ok(console);
    report_field(console->text, "share", (float)loud / (float)tried);
    report_field(console->text, "low", low);
    report_field(console->text, "high", high);
    text_key_text(console->text, "scatter", study->occurrence.occurrence.is_uniform ? "uniform" : "normal");
    text_key_u64(console->text, "seed", study->occurrence.occurrence.seed);
    text_key_u64(console->text, "clamped", study->occurrence.clamped);
    study_write_tally(console->text, &study->tally);
    console_end(console);
    console_end_task(console);
}

bool study_occurrence_continue(struct console *console)
{
    struct study_occurrence *study = &console->study.occurrence;
    struct params_problem problem;

    if (!console->study.is_trying) {
        occurrence_draw(&study->occurrence, study->done, &study->draw);
    }
    if (!study_try(&console->study, &study->draw.params, &problem)) {
        return true;
    }
    study->done++;
    study->clamped += study->draw.clamped;
    write_draw(console, &problem);
    if (study->done == study->of) {
        answer(console);
    }
    return true;
}
