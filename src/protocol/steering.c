/* input: what a controller would ask of the brake, by hand. */
#include "base/fmath.h"
#include "protocol/console_parts.h"

#define VALUE_MAX 1e12f /* beyond any brake; what the scale holds is asked later */

static const struct kind {
    const char *word;
    enum input_load load;
    enum input_speed speed;
} kinds[] = {
    {"N", INPUT_LOAD_FORCE, INPUT_SPEED_KEEP},
    {"pressure", INPUT_LOAD_PRESSURE, INPUT_SPEED_KEEP},
    {"v0", INPUT_LOAD_KEEP, INPUT_SPEED_DISC},
    {"vehicle", INPUT_LOAD_KEEP, INPUT_SPEED_VEHICLE},
};

static const struct kind *find_kind(struct token word)
{
    for (size_t i = 0u; i < sizeof kinds / sizeof kinds[0]; i++) {
        if (token_is(word, kinds[i].word)) {
            return &kinds[i];
        }
    }
    return NULL;
}

/* One force or speed; a second of the same is refused. */
static bool read_kind(struct console *console, const struct kind *kind, struct token word, struct input_demand *demand)
{
    const bool is_load = kind->load != INPUT_LOAD_KEEP;
    const bool is_taken = is_load ? demand->load != INPUT_LOAD_KEEP : demand->speed != INPUT_SPEED_KEEP;

    if (is_taken) {
        console_refuse_usage(console);
        return false;
    }
    if (is_load) {
        demand->load = kind->load;
        return console_read_number(console, kind->word, word, -VALUE_MAX, VALUE_MAX, &demand->load_value);
    }
    demand->speed = kind->speed;
    return console_read_number(console, kind->word, word, -VALUE_MAX, VALUE_MAX, &demand->speed_value);
}

/* "profile", or "N|pressure|v0|vehicle <value> ...", then "at <step>" if wanted. */
static bool read_demand(struct console *console, struct input_demand *demand)
{
    struct token word = token_first(console->arguments);
    uint32_t step = INPUT_NOW;

    if (token_is(word, "profile")) {
        demand->load = INPUT_LOAD_PROFILE;
        demand->speed = INPUT_SPEED_PROFILE;
        word = token_next(word);
    }
    for (const struct kind *kind = find_kind(word); kind != NULL; kind = find_kind(word)) {
        if (!read_kind(console, kind, token_next(word), demand)) {
            return false;
        }
        word = token_next(token_next(word));
    }
    if (token_is(word, "at")) {
        word = token_next(word);
        if (word.length != 0u && !token_number(word, 1u, UINT32_MAX, &step)) {
            console_refuse_count(console, "at", word, 1u, UINT32_MAX);
            return false;
        }
        word = word.length != 0u ? token_next(word) : token_first("at");
    }
    demand->step = step;
    if (word.length != 0u || (demand->load == INPUT_LOAD_KEEP && demand->speed == INPUT_SPEED_KEEP)) {
        console_refuse_usage(console);
        return false;
    }
    return true;
}

void steering_obey(struct console *console)
{
    struct input_demand demand = {.load = INPUT_LOAD_KEEP};
    enum error error;
    bool is_clamped;

    if (console_is_in_fault(console)) {
        console_refuse_fault(console);
        return;
    }
    if (!read_demand(console, &demand)) {
        return;
    }
    error = executive_input(console->executive, &demand, &is_clamped);
    if (error != ERROR_OK) {
        console_refuse(console, error, token_first(console->command), error_text(error));
        return;
    }
    console_begin_ok(console);
    text_key_text(console->text, "clamped", is_clamped ? "yes" : "no");
    console_end(console);
}
