/* What a sample means in SI, as text: the table is signals.def. */
#ifndef PROTOCOL_SIGNALS_H
#define PROTOCOL_SIGNALS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/text.h"
#include "model/scale.h"
#include "sim/sample.h"

enum {
#define TABLE_VERSION(version) SIGNALS_VERSION = version
#define SIGNAL(...)
#include "protocol/signals.def"
#undef SIGNAL
};

enum signal {
#define SIGNAL(id, field, name, unit, width, form, value, help) SIGNAL_##field = id,
#include "protocol/signals.def"
#undef SIGNAL
    SIGNAL_COUNT
};

enum { SIGNALS_DEFAULT = 11 }; /* so many from the head of the table where none are named */

enum { SIGNAL_MODE_FAULT = 2 }; /* beside enum plant_mode */

enum signal_form {
    SIGNAL_FORM_COUNT,
    SIGNAL_FORM_TIME,
    SIGNAL_FORM_REAL,
    SIGNAL_FORM_MODE,
    SIGNAL_FORM_PROPENSITY,
    SIGNAL_FORM_WATCH,
    SIGNAL_FORM_BITS
};

struct signal_info {
    const char *name, *unit, *help;
    uint8_t width; /* characters of the longest text */
    enum signal_form form;
};

/* By enum signal. */
extern const struct signal_info signals_table[SIGNAL_COUNT];

/* Finds a signal by its name of the given length; SIGNAL_COUNT if there is none. [MAIN] */
enum signal signals_find(const char *name, size_t length);

/* The name of a mode, slip- to SIGNAL_MODE_FAULT; "" of any other number. [ANY] */
const char *signals_mode_name(int mode);

/* Appends the value as text, at most width characters; nan where there is none. scale is that of the
 * sample's reset. [MAIN] */
void signals_append(struct text *text, enum signal signal, const struct sample *sample, const struct scale *scale);

/* The value as a word for a program: the bits of a float, numbers and names included; a hash as it is. [MAIN] */
uint32_t signals_word(enum signal signal, const struct sample *sample, const struct scale *scale);

#endif
