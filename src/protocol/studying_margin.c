/* margin: how far from the border of squeal, parameter by parameter. */
#include "protocol/report.h"
#include "protocol/studying_parts.h"
#include "protocol/values.h"

enum { BORDER_DIGITS = 6 };

/* The parameter that was asked for; NULL for all. False if it is refused. */
static bool read_parameter(struct console *console, struct token *word, const struct params_info **info)
{
    *info = NULL;
    if (word->length == 0u || token_is(*word, "within") || studying_is_span(*word)) {
        return true;
    }
    *info = studying_read_parameter(console, *word);
    if (*info == NULL) {
        return false;
    }
    if (!margin_covers(executive_params(console->executive), *info)) {
        console_refuse(console, ERROR_NOT_SERVED, *word,
                       "margin takes the amounts that act once the profiles have come to rest");
        return false;
    }
    *word = token_next(*word);
    return true;
}

void studying_margin(struct console *console)
{
    struct token word = token_first(console->arguments);
    struct trial_span span = {.transient = TRIAL_TRANSIENT_BRIEF, .window = TRIAL_WINDOW_DEFAULT, .is_brief = true};
    const struct params_info *only;
    float factor = MARGIN_FACTOR_DEFAULT;

    if (!read_parameter(console, &word, &only)) {
        return;
    }
    if (token_is(word, "within")) {
        word = token_next(word);
        if (!console_read_number(console, "within", word, MARGIN_FACTOR_LOW, MARGIN_FACTOR_HIGH, &factor)) {
            return;
        }
        word = token_next(word);
    }
    if (studying_read_span(console, word, &span) && studying_start(console)) {
        study_begin_margin(&console->work->study, executive_params(console->executive), only, factor, &span);
    }
}

static void write_value(struct text *text, const char *prefix, const char *suffix, const struct params_info *info,
                        float value)
{
    text_put(text, ' ');
    text_write(text, prefix);
    text_write(text, suffix);
    text_put(text, '=');
    values_write(text, info, value);
}

/* " below=2000.2 below_quiet=1999.4 below_squeal=2001.1", or " below=none below_searched=187.5" */
static void write_side(struct text *text, const char *name, const struct margin *margin, const struct margin_side *side)
{
    if (side->has_border) {
        text_put(text, ' ');
        text_write(text, name);
        text_put(text, '=');
        text_f32(text, margin_border(side), BORDER_DIGITS);
        write_value(text, name, "_quiet", margin->info, side->quiet);
        write_value(text, name, "_squeal", margin->info, side->loud);
    } else {
        text_key_text(text, name, "none");
        write_value(text, name, "_searched", margin->info, side->searched);
    }
}

void studying_write_borders(struct console *console)
{
    const struct study *study = &console->work->study;
    const struct margin *margin = &study->its.margin.margin;
    struct text *text = console->text;

    console_begin_body(console);
    text_write(text, "margin");
    text_key_u64(text, "done", study->done);
    text_key_u64(text, "of", study->of);
    write_value(text, margin->info->symbol, "", margin->info, margin->value);
    text_key_text(text, "unit", "");
    values_write_unit_word(text, margin->info);
    text_key_text(text, "now", margin->is_loud ? "squeal" : "quiet");
    write_side(text, "below", margin, &margin->sides[0]);
    write_side(text, "above", margin, &margin->sides[1]);
    text_key_text(text, "quiets", margin_way_name(margin_quiets(margin)));
    console_end(console);
}

void studying_write_margin_answer(struct text *text, const struct study *study)
{
    text_key_u64(text, "parameters", study->done);
    text_key_text(text, "now", study->its.margin.is_loud ? "squeal" : "quiet");
}
