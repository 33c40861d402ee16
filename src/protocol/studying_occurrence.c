/* occurrence: the share of squeal among brakes that differ a little. */
#include "protocol/report.h"
#include "protocol/studying_parts.h"

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

    for (; word->length != 0u && !studying_is_span(*word); *word = token_next(*word)) {
        const enum occurrence_amount amount = find_amount(*word);

        if (token_is(*word, "normal") || token_is(*word, "uniform")) {
            occurrence->is_uniform = token_is(*word, "uniform");
        } else if (token_is(*word, "seed")) {
            *word = token_next(*word);
            if (!studying_read_count(console, "seed", *word, 0u, OCCURRENCE_SEED_MAX, &occurrence->seed)) {
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

void studying_occurrence(struct console *console)
{
    struct token word = token_first(console->arguments);
    struct occurrence occurrence = {.base = *executive_params(console->executive)};
    uint32_t trials;
    struct trial_span span = {.transient = TRIAL_TRANSIENT_BRIEF, .window = TRIAL_WINDOW_DEFAULT, .is_brief = true};

    if (!studying_read_count(console, "trials", word, 1u, OCCURRENCE_TRIALS_MAX, &trials)) {
        return;
    }
    word = token_next(word);
    if (read_scatter(console, &word, &occurrence) && studying_read_span(console, word, &span) &&
        studying_start(console)) {
        study_begin_occurrence(&console->work->study, &occurrence, trials, &span);
    }
}

void studying_write_draw(struct console *console)
{
    const struct study *study = &console->work->study;
    struct text *text = console->text;

    console_begin_body(console);
    text_write(text, "trial");
    text_key_u64(text, "done", study->done);
    text_key_u64(text, "of", study->of);
    for (unsigned i = 0u; i < OCCURRENCE_AMOUNTS; i++) {
        const char *name = occurrence_name((enum occurrence_amount)i);

        report_field(text, i == OCCURRENCE_LOAD ? "N_factor" : name, study->its.occurrence.draw.values[i]);
    }
    studying_write_outcome(text, study);
    console_end(console);
}

void studying_write_share(struct text *text, const struct study *study)
{
    const struct study_share share = study_share(study);

    report_field(text, "share", share.share);
    report_field(text, "low", share.low);
    report_field(text, "high", share.high);
    text_key_text(text, "scatter", study->its.occurrence.occurrence.is_uniform ? "uniform" : "normal");
    text_key_u64(text, "seed", study->its.occurrence.occurrence.seed);
    text_key_u64(text, "clamped", study->its.occurrence.clamped);
}
