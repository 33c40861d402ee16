/* What every arithmetic of the plant offers: the shapes that the rest of the program sees.
 *
 * The plant is a pure function of (coefficients, state, input). One call advances it by one step h; the input is held
 * over the step. Number formats differ per arithmetic (step_f32, a fixed-point twin beside it), the output does not. */
#ifndef MODEL_PLANT_H
#define MODEL_PLANT_H

#include <stdbool.h>
#include <stdint.h>

/* Regimes of the contact. REVERSE is the pad overtaking the disc in the sense that the disc turns. */
enum plant_mode { PLANT_SLIP_PLUS = 1, PLANT_STICK = 0, PLANT_SLIP_MINUS = -1 };

enum {
    PLANT_EVENTS_MAX = 3,   /* switches of regime located inside one step; a further one is counted as capped */
    PLANT_CONTACTS_MAX = 2, /* losses and gains of contact located inside one step */
    PLANT_SHARE_ONE = 1 << 30,
    PLANT_FRACTION_BITS = 27 /* of the output's Q4.27 */
};

#define PLANT_GAP_MAX 8.0f /* largest gap of a lifted pad, in n_max/ke; held there and counted */

/* What happened inside a step. */
struct plant_notes {
    uint32_t stick;      /* share of the step spent sticking, PLANT_SHARE_ONE = all of it */
    uint32_t slip_minus; /* share of the step spent in slip with vr < 0 */
    uint8_t events;      /* regime switches inside the step */
    bool is_capped;      /* one more was due than may be located */
    bool is_saturated;   /* an output did not fit Q4.27 */
    bool is_gap_held;    /* the gap was held at its limit */
    bool is_lifted;      /* contact was lost during the step: y < 0 */
};

/* What a step has come to. State in Q4.27 of the model's units; x divided by 2^length_shift. Out of range values are
 * saturated and noted, so that readers never meet a wrapped number. It is a part of the plant's state, and a step
 * writes no more of it than may have changed. */
struct plant_output {
    int32_t x, v, y, w; /* displacement, velocity, normal displacement, normal velocity at the end of the step */
    int32_t disc;       /* disc speed held over the step */
    int8_t mode;        /* enum plant_mode at the end of the step */
    bool has_notes;     /* if not, the step stayed in its regime, and nothing else happened: noted is an older step's */
    struct plant_notes noted;
};

/* The notes of a step, of whatever kind. */
static inline struct plant_notes plant_notes(const struct plant_output *output)
{
    if (output->has_notes) {
        return output->noted;
    }
    return (struct plant_notes){.stick = output->mode == PLANT_STICK ? PLANT_SHARE_ONE : 0u,
                                .slip_minus = output->mode == PLANT_SLIP_MINUS ? PLANT_SHARE_ONE : 0u};
}

#endif
