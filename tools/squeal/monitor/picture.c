/* What is shown is made calm here: axes in round numbers that stay, a spectrum that is smoothed. */
#include "squeal/monitor/picture.h"

#include "squeal/plot/spectrum.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double LEVEL_REFERENCE_M_PER_S = 1e-9;
static const double LEVEL_STEP_DB = 20.0;
static const double LEVEL_SPAN_DB = 100.0;
static const double LEAST_SHARE = 2e-3;  /* of a place or speed that an axis spans at least */
static const double LEAST_SPAN = 1e-12;  /* m, m/s */
static const double LEAST_POWER = 1e-30; /* for its logarithm */
static const double SMOOTHING = 0.25;    /* share of a new spectrum in the one shown */

void picture_init(struct picture *picture)
{
    memset(picture, 0, sizeof *picture);
    picture->merged = 4u;
    picture->steps_per_s = picture->pace = (double)NAN;
    for (size_t i = 0u; i < PICTURE_INPUTS; i++) {
        picture->input[i].set = picture->input[i].held = (double)NAN;
    }
    trace_clear(&picture->trace, 1.0, 64u, 1u);
    picture_forget(picture);
}

void picture_forget(struct picture *picture)
{
    const double none = (double)NAN;

    picture->severity = (struct picture_severity){none, none, none, none, none, none, none};
    picture->motion[0] = picture->forecast[0] = '\0';
    picture->strip = picture->x = picture->xd = picture->level_db = (struct axis){0.0, 0.0};
    picture->lines = 0u;
    picture->peak_hz = none;
    picture->propensity = 0u;
}

double picture_level_db(double velocity_m_per_s)
{
    return velocity_m_per_s > 0.0 ? 20.0 * log10(velocity_m_per_s / LEVEL_REFERENCE_M_PER_S) : (double)NAN;
}

/* Motion that is small beside where the pad stands is shown small. */
static double least_span_m(double low_m, double high_m)
{
    return LEAST_SHARE * fmax(fabs(low_m), fabs(high_m)) + LEAST_SPAN;
}

static void follow_strip(struct picture *picture, int cols)
{
    const struct trace *trace = &picture->trace;
    const struct trace_point *latest = trace_point(trace, 0u);
    double low = INFINITY;
    double high = -(double)INFINITY;
    uint64_t last, span;

    if (latest == NULL) {
        return;
    }
    last = latest->step / trace->steps_per_period;
    span = (uint64_t)cols * CANVAS_ACROSS * picture->merged;
    for (uint64_t back = 0u; back <= span && back <= last; back++) {
        const struct trace_period *period = trace_period(trace, last - back);

        if (period != NULL) {
            low = fmin(low, (double)period->low_m);
            high = fmax(high, (double)period->high_m);
        }
    }
    (void)axis_follow(&picture->strip, low, high, least_span_m(low, high));
}

/* A fixed span below the highest peak, in steps that are seldom taken. */
static void follow_level(struct picture *picture)
{
    double top = 0.0;
    double level_db;

    for (size_t k = 1u; k < picture->lines; k++) {
        top = fmax(top, picture->power[k]);
    }
    level_db = picture_level_db(sqrt(top));
    if (isfinite(level_db) &&
        !(level_db <= picture->level_db.high && level_db > picture->level_db.high - 2.5 * LEVEL_STEP_DB)) {
        picture->level_db.high = LEVEL_STEP_DB * ceil(level_db / LEVEL_STEP_DB);
        picture->level_db.low = picture->level_db.high - LEVEL_SPAN_DB;
    }
}

/* Between two lines: a parabola through three levels, which is within a hundredth of a line for Hann's window. */
static double find_peak(const struct picture *picture)
{
    const double *power = picture->power;
    size_t best = 0u;
    double left, middle, right, curve;

    for (size_t k = 2u; k + 1u < picture->lines; k++) {
        if (power[k] > 0.0 && power[k] >= power[k - 1u] && power[k] >= power[k + 1u] &&
            (best == 0u || power[k] > power[best])) {
            best = k;
        }
    }
    if (best == 0u) {
        return (double)NAN;
    }
    left = log(power[best - 1u] + LEAST_POWER);
    middle = log(power[best] + LEAST_POWER);
    right = log(power[best + 1u] + LEAST_POWER);
    curve = left - 2.0 * middle + right;
    return ((double)best + (curve < 0.0 ? 0.5 * (left - right) / curve : 0.0)) * picture->line_hz;
}

static void follow_spectrum(struct picture *picture)
{
    static double values[PICTURE_SAMPLES_MAX];
    const struct trace *trace = &picture->trace;
    const size_t count = trace_latest(trace, PICTURE_SAMPLES_MAX, values);
    struct spectrum spectrum;

    if (count < PICTURE_SAMPLES_MIN || !spectrum_make(&spectrum, values, count, 1.0 / (trace->every * trace->step_s))) {
        return; /* what was shown last is better than nothing */
    }
    for (size_t k = 0u; k < spectrum.lines; k++) {
        const double power = 0.5 * spectrum.amplitude[k] * spectrum.amplitude[k];

        picture->power[k] =
            picture->lines == spectrum.lines ? picture->power[k] + SMOOTHING * (power - picture->power[k]) : power;
    }
    picture->lines = spectrum.lines;
    picture->line_hz = spectrum.step_hz;
    free(spectrum.amplitude);
    follow_level(picture);
    picture->peak_hz = find_peak(picture);
}

void picture_update(struct picture *picture, int cols)
{
    const struct trace_measure measure = trace_measure(&picture->trace, PICTURE_PERIODS);
    double disc_m_per_s = picture->input[1].held;

    if (!picture->is_measured) {
        picture->severity.velocity_m_per_s = measure.velocity_m_per_s;
        picture->severity.level_db = picture_level_db(measure.velocity_m_per_s);
        picture->severity.amplitude_m = measure.amplitude_m;
        picture->severity.frequency_hz = measure.frequency_hz;
        picture->severity.growth_per_s = measure.growth_per_s;
    }
    /* The disc's speed belongs into the portrait wherever the motion is of its order. */
    if (!(fabs(disc_m_per_s) <= 20.0 * fmax(fabs(measure.xd_low_m_per_s), fabs(measure.xd_high_m_per_s)))) {
        disc_m_per_s = measure.xd_high_m_per_s;
    }
    (void)axis_follow(&picture->x, measure.x_low_m, measure.x_high_m, least_span_m(measure.x_low_m, measure.x_high_m));
    (void)axis_follow(&picture->xd, fmin(measure.xd_low_m_per_s, disc_m_per_s),
                      fmax(measure.xd_high_m_per_s, disc_m_per_s),
                      LEAST_SHARE * fmax(fabs(picture->input[1].held), 0.0) + LEAST_SPAN);
    follow_strip(picture, cols);
    follow_spectrum(picture);
}

void picture_motion(char *out, size_t size, uint8_t motion, uint8_t period)
{
    static const char *const words[] = {
        "not settled yet",
        "at rest",
        "slipping, with a swing that decays",
        "slipping, with a swing that grows",
        "slipping, in step with the normal oscillation",
        "stick-slip, in step with the normal oscillation",
        "overtaking the disc, in step with the normal oscillation",
        "limit cycle without sticking",
        "limit cycle with stick-slip",
        "aperiodic",
        "left its domain",
    };

    (void)snprintf(out, size, "%s", motion < sizeof words / sizeof words[0] ? words[motion] : "");
    if (period > 1u && out[0] != '\0') {
        const size_t length = strlen(out);

        (void)snprintf(out + length, size - length, ", repeating after %u", period);
    }
}

const char *picture_propensity(uint8_t propensity)
{
    static const char *const names[] = {"unknown", "quiet", "watch", "squeal"};

    return propensity < sizeof names / sizeof names[0] ? names[propensity] : names[0];
}

const char *picture_headline(const struct picture *picture)
{
    static const char *const names[] = {"UNKNOWN", "QUIET", "WATCH", "SQUEAL"};

    return picture->state == 2u ? "FAULT"
                                : names[picture->propensity < sizeof names / sizeof names[0] ? picture->propensity : 0];
}

enum tint picture_tint(uint8_t propensity)
{
    static const enum tint tints[] = {TINT_UNKNOWN, TINT_QUIET, TINT_WATCH, TINT_SQUEAL};

    return propensity < sizeof tints / sizeof tints[0] ? tints[propensity] : TINT_UNKNOWN;
}

static void append_unit(char *out, size_t size, double value, const char *unit, bool is_round)
{
    static const struct {
        double factor;
        const char *prefix;
    } prefixes[] = {{1e6, "M"}, {1e3, "k"}, {1.0, ""}, {1e-3, "m"}, {1e-6, "\xc2\xb5"}, {1e-9, "n"}, {1e-12, "p"}};
    size_t i = 0u;
    double scaled, magnitude;

    if (!isfinite(value) || fabs(value) < 1e-15) {
        (void)snprintf(out, size, isfinite(value) ? "0 %s" : "-", unit);
        return;
    }
    while (i + 1u < sizeof prefixes / sizeof prefixes[0] && fabs(value) < 0.9995 * prefixes[i].factor) {
        i++;
    }
    scaled = value / prefixes[i].factor;
    magnitude = fabs(scaled);
    if (is_round) {
        (void)snprintf(out, size, "%.4g %s%s", scaled, prefixes[i].prefix, unit);
    } else {
        (void)snprintf(out, size, "%.*f %s%s",
                       magnitude >= 99.95   ? 0
                       : magnitude >= 9.995 ? 1
                                            : 2,
                       scaled, prefixes[i].prefix, unit);
    }
}

void picture_quantity(char *out, size_t size, double value, const char *unit)
{
    append_unit(out, size, value, unit, false);
}

void picture_round(char *out, size_t size, double value, const char *unit)
{
    append_unit(out, size, value, unit, true);
}

void picture_frequency(char *out, size_t size, double value_hz)
{
    if (value_hz >= 99.5 && value_hz < 99999.5) {
        (void)snprintf(out, size, "%.0f Hz", value_hz);
    } else {
        picture_quantity(out, size, value_hz, "Hz");
    }
}

void picture_count(char *out, size_t size, uint64_t value)
{
    char digits[32];
    const int length = snprintf(digits, sizeof digits, "%" PRIu64, value);
    size_t put = 0u;

    for (int i = 0; i < length && put + 2u < size; i++) {
        if (i > 0 && (length - i) % 3 == 0) {
            out[put++] = ' ';
        }
        out[put++] = digits[i];
    }
    out[put] = '\0';
}
