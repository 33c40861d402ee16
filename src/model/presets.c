/* Presets, and the assignments that they and a person's "set" are made of. */
#include "model/presets.h"

#include "base/assert.h"

const struct preset presets_table[] = {
#define PRESET(name, help, assignments) {name, help, assignments},
#include "model/presets.def"
#undef PRESET
};

const size_t presets_count = sizeof presets_table / sizeof presets_table[0];

/* Next word of a text; its length is 0 at the end. */
static const char *next_word(const char *text, size_t *length)
{
    while (*text == ' ') {
        text++;
    }
    *length = 0u;
    while (text[*length] != '\0' && text[*length] != ' ') {
        (*length)++;
    }
    return text;
}

const struct preset *presets_find(const char *name, size_t length)
{
    for (const struct preset *preset = presets_table; preset < presets_table + presets_count; preset++) {
        size_t i = 0u;

        while (i < length && preset->name[i] != '\0' && preset->name[i] == name[i]) {
            i++;
        }
        if (i == length && preset->name[i] == '\0') {
            return preset;
        }
    }
    return NULL;
}

enum error presets_assign(struct params *params, const char *assignments, const struct params_info **info,
                          const char **bad, size_t *bad_length)
{
    struct params changed = *params;
    size_t length = 0u;
    const char *word = next_word(assignments, &length);
    enum error error = length == 0u ? ERROR_OK : ERROR_USAGE;

    *info = NULL;
    while (length != 0u) {
        float value = 0.0f;

        *bad = word;
        *bad_length = length;
        *info = params_find(word, length);
        if (*info == NULL) {
            return ERROR_UNKNOWN_NAME;
        }
        word = next_word(word + length, &length);
        if (length == 0u) {
            return ERROR_USAGE;
        }
        *bad = word;
        *bad_length = length;
        error = params_parse(*info, word, length, &value);
        if (error != ERROR_OK) {
            return error;
        }
        params_set(&changed, *info, value);
        word = next_word(word + length, &length);
    }
    *params = changed;
    return error;
}

void presets_load(const struct preset *preset, struct params *params)
{
    const struct params_info *info;
    const char *bad;
    size_t bad_length;
    enum error error;

    params_default(params);
    error = presets_assign(params, preset->assignments, &info, &bad, &bad_length);
    BASE_ASSERT(error == ERROR_OK);
}
