/* The plant in single precision: one step of Eq. 20 with the slip sign frozen per piece, switches of regime located
 * inside the step, and an explicit stick state. PHYSICS and the reasons: MODEL.md. Pure: no I/O, no globals, no
 * time. */
#ifndef MODEL_STEP_F32_H
#define MODEL_STEP_F32_H

#include <stdbool.h>
#include <stdint.h>

#include "model/normal_f32.h"
#include "model/plant.h"
#include "model/scale.h"

/* What the tangential equation is made of, times half the duration of a piece in 1/wn; of a whole step that is h/2. */
struct slip_f32_factors {
    float travel;               /* h: x per v */
    float spring, stretch;      /* h/2 Z2; h/2 Z2 h/2, what a velocity adds to the pull of the spring by half a step */
    float friction, fade, drag; /* h/2 mu, h/2 eps, h/2 C */
    float floor;                /* h/2 times the floor of mu */
};

/* How a step goes. All but PIECES try it as a whole, and may find that it holds an event: they differ by the way in
 * which y comes, and by whether friction has a floor. A naive method, or a pad that lifts, cannot be tried. The calm
 * ones are for the set of PHASE, the paper's, while the pad is pressed on the disc whatever the phase, and sticks or
 * slips forward. */
enum step_f32_way {
    STEP_F32_PIECES,
    STEP_F32_SLIP_CALM,
    STEP_F32_STICK_CALM,
    STEP_F32_PHASE,
    STEP_F32_RK4,
    STEP_F32_MAP,
    STEP_F32_FLOOR
};

struct step_f32_coeffs {
    struct slip_f32_factors whole;
    float output_length; /* 1/2^length_shift */
    bool has_floor;
    bool is_naive;                                    /* RK4 on the raw sign, no stick: for comparison only */
    uint8_t path;                                     /* enum step_f32_way, unless the step is calm */
    float damping, stiffness, friction, slope, floor; /* C, Z2, mu, eps, floor of mu, for reports */
    struct normal_f32_coeffs normal;
};

/* Brake force in n_max and disc speed in Vref, held over one step. */
struct step_f32_input {
    float load, speed;
};

/* What a step needs of the disc's speed under the present coefficients: the same in every step until one of them
 * changes. */
struct step_f32_turning {
    float carry;   /* x in a step while the pad sticks */
    float drive;   /* h/2 (mu + eps disc), what drives a pad that slips forward */
    float resists; /* h/2 C disc, what damping does to a pad that sticks */
};

struct step_f32 {
    float x, v;   /* displacement and velocity of the pad along the disc */
    float x_rest; /* what rounding took from x so far: without it an equilibrium rustles at 1e-5 of x */
    float disc;   /* disc speed held over the present step */
    int8_t mode;  /* enum plant_mode */
    uint8_t way;  /* enum step_f32_way */
    struct step_f32_turning turning;
    struct normal_f32 normal;
    struct plant_output output; /* of the last step */
};

/* Coefficients of a set whose scale has been derived. [MAIN] */
void step_f32_configure(struct step_f32_coeffs *coeffs, const struct params *params, const struct scale *scale);

/* Initial state of the set under the first input, with nothing having happened. [ANY] */
void step_f32_reset(struct step_f32 *state, const struct step_f32_coeffs *coeffs, const struct params *params,
                    const struct scale *scale, struct step_f32_input first);

/* Other coefficients are in force from here on, or the state has been put back as it stood under these. [ISR] */
void step_f32_adopt(struct step_f32 *state, const struct step_f32_coeffs *coeffs);

/* What is held over the steps to come. [ISR] */
void step_f32_set_input(struct step_f32 *state, const struct step_f32_coeffs *coeffs, struct step_f32_input input);

/* Advances by one step h. Cost: one RK4 step, and at most 1 + 2 (PLANT_EVENTS_MAX + PLANT_CONTACTS_MAX) where regimes
 * switch. [ISR] */
void step_f32_advance(struct step_f32 *state, const struct step_f32_coeffs *coeffs);

/* Friction force on the pad in the unit m wn Vref: mu P sgn(vr) while slipping, what holds the pad while sticking. */
float step_f32_friction(const struct step_f32 *state, const struct step_f32_coeffs *coeffs);

/* The plant has left its domain: a state is not finite or beyond what the model means. */
bool step_f32_is_outside(const struct step_f32 *state);

#endif
