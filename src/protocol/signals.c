/* From a raw sample to SI text. */
#include "protocol/signals.h"

#include "base/decimal.h"
#include "base/fmath.h"
#include "model/params.h"
#include "model/plant.h"
#include "protocol/token.h"
#include "sim/detector.h"
#include "sim/watch.h"

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

static int mode_number(const struct sample *sample)
{
    return sample->is_fault != 0u ? SIGNAL_MODE_FAULT : sample->mode;
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

const char *signals_mode_name(int mode)
{
    static const char *const names[] = {"slip-", "stick", "slip+", "fault"};

    return mode >= PLANT_SLIP_MINUS && mode <= SIGNAL_MODE_FAULT ? names[mode - PLANT_SLIP_MINUS] : "";
}

static void append_MODE(struct text *text, const struct scale *scale, int value)
{
    (void)scale;
    text_write(text, signals_mode_name(value));
}

static void append_PROPENSITY(struct text *text, const struct scale *scale, uint8_t value)
{
    (void)scale;
    text_write(text, detector_propensity_name(value));
}

static void append_WATCH(struct text *text, const struct scale *scale, uint8_t value)
{
    (void)scale;
    text_write(text, watch_state_name(value));
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

static uint32_t word_COUNT(const struct scale *scale, uint64_t value)
{
    (void)scale;
    return fmath_bits(fmath_from_u64(value));
}

static uint32_t word_TIME(const struct scale *scale, uint64_t value)
{
    return fmath_bits(fmath_from_u64(value) * scale->step_s);
}

static uint32_t word_REAL(const struct scale *scale, float value)
{
    (void)scale;
    return fmath_bits(value);
}

static uint32_t word_MODE(const struct scale *scale, int value) { return word_REAL(scale, (float)value); }

static uint32_t word_PROPENSITY(const struct scale *scale, uint8_t value) { return word_REAL(scale, (float)value); }

static uint32_t word_WATCH(const struct scale *scale, uint8_t value) { return word_REAL(scale, (float)value); }

static uint32_t word_BITS(const struct scale *scale, uint32_t value)
{
    (void)scale;
    return value;
}

uint32_t signals_word(enum signal signal, const struct sample *sample, const struct scale *scale)
{
    switch (signal) {
#define SIGNAL(id, field, name, unit, width, form, value, help) \
    case SIGNAL_##field:                                        \
        return word_##form(scale, value);
#include "protocol/signals.def"
#undef SIGNAL
    case SIGNAL_COUNT:
    default:
        return 0u;
    }
}
