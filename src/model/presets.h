/* Sets by name: presets.def. */
#ifndef MODEL_PRESETS_H
#define MODEL_PRESETS_H

#include <stddef.h>

#include "model/params.h"

struct preset {
    const char *name, *help;
    const char *assignments; /* "symbol value symbol value", blanks between */
};

extern const struct preset presets_table[];
extern const size_t presets_count;

/* NULL if no preset has this name. [MAIN] */
const struct preset *presets_find(const char *name, size_t length);

/* Defaults, then the preset's assignments. [MAIN] */
void presets_load(const struct preset *preset, struct params *params);

/* Applies "symbol value symbol value ..." to a set: all or nothing. On a problem *params is as it was, *info the
 * parameter or NULL, and *bad points at the word that is to blame, *bad_length characters long. Ranges are not checked
 * here. [MAIN] */
enum error presets_assign(struct params *params, const char *assignments, const struct params_info **info,
                          const char **bad, size_t *bad_length);

#endif
