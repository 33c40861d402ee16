/* All that the monitor shows, as plain data: who fills it knows the device, who draws it knows the screen. */
#ifndef SQUEAL_PICTURE_H
#define SQUEAL_PICTURE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "squeal/monitor/canvas.h"
#include "squeal/monitor/trace.h"

enum {
    PICTURE_TEXT_MAX = 512,
    PICTURE_INPUTS = 3,
    PICTURE_PERIODS = 32,       /* of a window to measure over */
    PICTURE_SAMPLES_MAX = 2048, /* of a spectrum */
    PICTURE_SAMPLES_MIN = 128
};

enum picture_overlay { PICTURE_PLAIN, PICTURE_HELP, PICTURE_CHOOSER };

/* One of the things that a hand can turn. */
struct picture_input {
    char name[16], unit[16]; /* what a person calls it */
    char symbol[32];         /* the parameter behind it */
    double set;              /* the parameter's value */
    double held;             /* what acts now; nan if it is the same */
};

/* How strong the motion is; nan what is not known. */
struct picture_severity {
    double level_db; /* of the rms velocity, re 1 nm/s */
    double velocity_m_per_s;
    double amplitude_m;
    double frequency_hz;
    double growth_per_s;
    double stick_share;
    double loudness_dba;
};

struct picture_counters {
    uint32_t offered, sent, dropped, overruns, shed, caps, saturations, refused, bad_crc, damaged;
};

struct picture_choice {
    const char *name, *help;
};

struct picture {
    char port[PICTURE_TEXT_MAX], board[128], preset[64];
    unsigned state; /* 0 ready, 1 run, 2 fault */
    uint64_t step;
    double pace;        /* physical seconds per second of the wall, as seen here; nan while it is not known */
    double sigma;       /* the same by the device's own clock */
    double steps_per_s; /* as the set has it: tick x substeps; nan while it is not known */

    uint8_t propensity;
    bool is_measured;  /* motion and severity come from the device, not from the samples */
    char motion[96];   /* in words; empty if it is not known */
    char forecast[96]; /* of the closed form; empty if it is not known */
    struct picture_severity severity;
    struct picture_input input[PICTURE_INPUTS];
    struct picture_counters counters;

    struct trace trace;
    unsigned merged; /* normal periods in a column of dots of the strip */
    struct axis strip, x, xd, level_db;
    double power[PICTURE_SAMPLES_MAX / 2]; /* (m/s)^2, mean square of each line of the spectrum, smoothed */
    size_t lines;                          /* 0: no spectrum */
    double line_hz;                        /* from one to the next */
    double peak_hz;

    char message[PICTURE_TEXT_MAX]; /* empty: the keys are listed in its place */
    bool is_refusal;
    enum picture_overlay overlay;
    const struct picture_choice *choices;
    size_t choice_count, choice;
};

/* Nothing known. */
void picture_init(struct picture *picture);

/* Axes, spectrum and, unless it is measured elsewhere, severity from what the trace holds now. cols: of the strip. */
void picture_update(struct picture *picture, int cols);

/* Nothing of what was seen before belongs to what comes. */
void picture_forget(struct picture *picture);

/* Level of an rms velocity. */
double picture_level_db(double velocity_m_per_s);

/* A kind of motion in words: enum detector_class, and after how many it repeats. Empty for one that is not known
 * here. */
void picture_motion(char *out, size_t size, uint8_t motion, uint8_t period);

/* "quiet" and its like; capitals for large letters. */
const char *picture_propensity(uint8_t propensity);
const char *picture_headline(const struct picture *picture);
enum tint picture_tint(uint8_t propensity);

/* A number in three digits and the prefix that suits its unit: "8.15 um"; a round one as short as it is: "20 um"; "-"
 * for what is no number. */
void picture_quantity(char *out, size_t size, double value, const char *unit);
void picture_round(char *out, size_t size, double value, const char *unit);

/* A frequency to the Hertz, where it has some hundred. */
void picture_frequency(char *out, size_t size, double value_hz);

/* A whole number in groups of three digits. */
void picture_count(char *out, size_t size, uint64_t value);

#endif
