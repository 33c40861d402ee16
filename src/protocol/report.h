/* What the plant did, in SI: the fields of measure and verdict. What makes no sense is nan. */
#ifndef PROTOCOL_REPORT_H
#define PROTOCOL_REPORT_H

#include <stdbool.h>
#include <stdint.h>

#include "base/text.h"
#include "sim/executive.h"
#include "sim/trial.h"

/* Creep groan, and brake squeal after SAE J2521. */
enum report_band { REPORT_NO_BAND, REPORT_GROAN, REPORT_SQUEAL };

/* The verdict as numbers for people. While the propensity is unknown nothing has been measured: all nan. */
struct report_verdict {
    uint8_t propensity; /* enum detector_propensity */
    uint8_t motion;     /* enum detector_class */
    uint8_t period;
    float amplitude_um;  /* half the range of x over the window */
    float velocity_mm_s; /* half the range of v */
    float velocity_mm_s_rms;
    float level_db;       /* of the rms velocity, re 1 nm/s */
    float acceleration_g; /* largest change of v in a step, over the step */
    float frequency_hz;   /* nan at rest */
    uint8_t band;         /* enum report_band */
    bool is_audible;
    float level_dba_estimate; /* see report_sound_level() */
    float growth_per_s, growth_error_per_s;
    float stick, slip_minus; /* shares of the time */
};

struct report_verdict report_judge(const struct detector_verdict *verdict, const struct scale *scale);

/* All that a verdict says: of the plant as it is, and of what the closed form says of its set or, where a controller
 * holds force or speed, of what it holds. */
struct report_answer {
    struct report_verdict judged;
    uint8_t predicted; /* enum predictor_verdict */
    bool is_bistable;
    float predicted_growth_per_s;
    float predicted_touch_ratio, onset_touch_ratio;
    float v10_s; /* when the pad was first ten times as fast as the disc */
    float sigma; /* physical seconds per second of the wall in free run */
};

struct report_answer report_answer(const struct executive_report *report, const struct sim_plan *plan);

/* A measurement as numbers for people; all nan while nothing was measured. */
struct report_motion {
    float amplitude_um;  /* half the range of x */
    float velocity_mm_s; /* half the range of v */
    float frequency_hz;  /* nan where nothing oscillates */
};

struct report_motion report_motion(const struct measure *measure, const struct scale *scale);

/* What a trial that is over came to: the window's motion, the rest at its end. */
struct report_trial {
    struct report_verdict judged;
    struct report_motion motion;
    uint8_t predicted; /* enum predictor_verdict */
    float predicted_growth_per_s;
    float periods; /* normal periods of the trial */
};

struct report_trial report_trial(const struct trial *trial);

/* Estimate of the sound pressure level of a pad that moves with this rms velocity, for tones in which the A-weighting
 * lies within 2 dB of nothing (0.8 to 9 kHz); nan elsewhere. The pad is taken as a rigid piston of 0.01 m2 with
 * radiation efficiency 1 that radiates into a half space, heard at 0.5 m: p = rho c v sqrt(S/(2 pi r^2)), rho c = 413 N
 * s/m3. Real brakes radiate with other areas and efficiencies; the number ranks, it does not certify. */
float report_sound_level(float velocity_m_per_s_rms, float frequency_hz);

/* Fields " key=value" of the answers. [MAIN] */
void report_write_verdict(struct text *text, const struct executive_report *report, const struct sim_plan *plan);
void report_write_measure(struct text *text, const struct executive_report *report, const struct sim_plan *plan);

/* The word of the protocol for enum report_band. */
const char *report_band_name(uint8_t band);

/* " class=stickslip-p1 period=1" */
void report_write_class(struct text *text, const struct report_verdict *judged);

/* A float as a field, nine digits; nan if it is not finite. */
void report_field(struct text *text, const char *key, float value);

#endif
