/* From a raw sample to SI text. */
#include "protocol/signals.h"

#include "base/decimal.h"
#include "base/fmath.h"
#include "model/params.h"
#include "model/plant.h"
#include "protocol/token.h"
#include "sim/detector.h"

const struct signal_info signals_table[SIGNAL_COUNT] = {
#define SIGNAL(id, field, name, unit, width, form, value, help) [id] = {#name, unit, help, width, SIGNAL_FORM_##form},
#include "protocol/signals.def"
#undef SIGNAL
};

enum signal signals_find(const char *name, size_t length)
{
    unsigned signal = 0u;

    while (signal < SIGNAL_COUNT && !token_equal(name, length, signals_table[signal].name)) {
        signal++;
    }
    return (enum signal)signal;
}

static const char *mode_name(const struct sample *sample)
{
    if (sample->is_fault != 0u) {
        return "fault";
    }
    return sample->mode == PLANT_STICK ? "stick" : sample->mode == PLANT_SLIP_PLUS ? "slip+" : "slip-";
}

/* Only bilateral contact, the paper's, can pull. */
static float contact_force_n(const struct sample *sample, const struct scale *scale)
{
    const float force_n = sample_value(sample, sample->y) * scale->load_n;

    return scale->contact == CONTACT_BILATERAL || force_n > 0.0f ? force_n : 0.0f;
}

static float friction_ratio(const struct sample *sample, const struct scale *scale)
{
    return sample_value(sample, sample->friction) * scale->force_n / contact_force_n(sample, scale);
}

static void append_COUNT(struct text *text, const struct scale *scale, uint64_t value)
{
    (void)scale;
    text_u64(text, value);
}

static void append_TIME(struct text *text, const struct scale *scale, uint64_t value)
{
    text_product(text, value, scale->step_s, DECIMAL_DIGITS_EXACT);
}

/* A plant beyond its domain may hold infinities: not a number for any reader. */
static void append_REAL(struct text *text, const struct scale *scale, float value)
{
    (void)scale;
    if (fmath_is_finite(value)) {
        text_f32(text, value, DECIMAL_DIGITS_EXACT);
    } else {
        text_write(text, "nan");
    }
}

static void append_WORD(struct text *text, const struct scale *scale, const char *value)
{
    (void)scale;
    text_write(text, value);
}

static void append_BITS(struct text *text, const struct scale *scale, uint32_t value)
{
    (void)scale;
    text_hex32(text, value);
}

void signals_append(struct text *text, enum signal signal, const struct sample *sample, const struct scale *scale)
{
    switch (signal) {
#define SIGNAL(id, field, name, unit, width, form, value, help) \
    case SIGNAL_##field:                                        \
        append_##form(text, scale, value);                      \
        break;
#include "protocol/signals.def"
#undef SIGNAL
    case SIGNAL_COUNT:
    default:
        break;
    }
}
