/* Parameters as text, and in words why a set was refused. [MAIN] */
#ifndef PROTOCOL_VALUES_H
#define PROTOCOL_VALUES_H

#include "base/text.h"
#include "model/params.h"
#include "protocol/token.h"

/* A number in the fewest digits that carry it, a choice by name. */
void values_write(struct text *text, const struct params_info *info, float value);

/* " N s/m"; nothing for a ratio or a choice. */
void values_write_unit(struct text *text, const struct params_info *info);

/* The unit in one word, "N.s/m", without what follows a comma; of a ratio 1, of a choice its names. */
void values_write_unit_word(struct text *text, const struct params_info *info);

/* "0 .. 12000", "f32", "constant|step|ramp|sine" */
void values_write_range(struct text *text, const struct params_info *info, float low, float high);

/* The same as a person should read it: "0 .. 12000 N", "1 .. 64, a whole number". */
void values_write_allowed(struct text *text, const struct params_info *info, float low, float high);

/* What follows "error <name>": the parameter, the value as it was typed, or if it was not, as the set would have it,
 * and what would have been accepted. */
void values_write_problem(struct text *text, const struct params_problem *problem, const struct params *wanted,
                          struct token typed);

#endif
