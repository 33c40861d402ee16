/* The normal oscillator in integers: what RK4 loses, that the closed forms lose nothing, and the arc that events
 * use. */
#include "model/normal_q27.h"

#include "base/fmath.h"
#include "plants.h"
#include "tap.h"
#include "tests.h"

/* wn = 1 rad/s; the model's units of load and normal displacement are 10 N and 10 m. */
#define UNIT_SET "m 1 ke 1 kt 0.5 k 0.5 N_max 10 v_max 10 arith q27 "
#define UNIT (1.0f / 134217728.0f)

struct pad {
    struct normal_q27_coeffs coeffs;
    struct normal_q27 normal;
    struct scale scale;
    bool is_saturated;
};

static struct pad pad_of(const char *assignments, float y, float w, float n)
{
    const struct params params = plants_params(assignments);
    struct sim_plan plan;
    struct pad pad;

    plants_plan(&plan, &params);
    pad.coeffs = plan.q27.normal;
    pad.scale = plan.scale;
    pad.is_saturated = false;
    normal_q27_reset(&pad.normal, &pad.coeffs, fixed_from_float(y, 27), fixed_from_float(w, 27),
                     fixed_from_float(n, 27), &pad.is_saturated);
    return pad;
}

/* One whole step; returns the least force of its stages. */
static int32_t advance(struct pad *pad)
{
    struct normal_q27_piece piece;

    normal_q27_open_step(&pad->normal, &pad->coeffs);
    normal_q27_look(&pad->normal, &pad->coeffs, &piece, &pad->is_saturated);
    normal_q27_move(&pad->normal, &piece);
    (void)normal_q27_close_step(&pad->normal, &pad->coeffs, &pad->is_saturated);
    return piece.p1 < piece.p2 ? (piece.p1 < piece.p4 ? piece.p1 : piece.p4)
                               : (piece.p2 < piece.p4 ? piece.p2 : piece.p4);
}

static int32_t run(struct pad *pad, uint32_t steps)
{
    int32_t least = INT32_MAX;

    for (uint32_t i = 0u; i < steps; i++) {
        const int32_t force = advance(pad);

        least = force < least ? force : least;
    }
    return least;
}

static float amplitude(const struct normal_q27 *normal)
{
    const float d = (float)(normal->y - normal->n) * UNIT;
    const float w = (float)normal->w * UNIT;

    return fmath_sqrt(d * d + w * w);
}

static void check_table(void)
{
    float worst = 0.0f;

    for (uint32_t i = 0u; i < SINE_GRID / 4u; i++) {
        worst = fmath_max(worst, fmath_abs((float)sine_quarter_q31[i] / 2147483648.0f - sine_f32(i)));
    }
    tap_check_close(worst, 0.0f, 1.2e-7f, "the table of integers is that of floats");
    tap_check(sine_quarter_q31[0] == 0 && sine_quarter_q31[256] == INT32_MAX && sine_quarter_q31[128] == 1518500250 &&
                  sine_quarter_q31[1] == 13176712,
              "with 31 bits");
}

static void check_rk4_loss(const char *assignments, uint32_t periods)
{
    struct pad pad = pad_of(assignments, 0.0f, 0.0f, 0.25f);
    const float predicted = scale_rk4_loss_per_period(&pad.scale) * (float)periods;
    const int32_t least = run(&pad, periods * pad.scale.steps_per_period);

    tap_check_close((1.0f - amplitude(&pad.normal) / 0.25f) / predicted, 1.0f, 0.05f,
                    "RK4 takes 2 pi h^5/144 of the amplitude a period");
    tap_check(least >= 0, "and from rest the force never pulls");
}

static void check_no_drift(void)
{
    const uint32_t periods = plants_scaled(10000u, 300u);
    struct pad pad = pad_of(UNIT_SET "normal exact", 0.0f, 0.0f, 0.25f);
    struct normal_q27 once;
    float worst = 0.0f;
    int32_t least;

    tap_check(pad.coeffs.has_phase, "the undamped closed form counts its phase");
    for (uint32_t i = 1u; i <= 64u; i++) {
        (void)advance(&pad);
        worst = fmath_max(worst, fmath_abs((float)pad.normal.y * UNIT - 0.25f * (1.0f - sine_cosine_f32(16u * i))));
        worst = fmath_max(worst, fmath_abs((float)pad.normal.w * UNIT - 0.25f * sine_f32(16u * i)));
    }
    tap_check_close(worst, 0.0f, 3e-8f, "from rest y is n (1 - cos)");
    tap_check(pad.normal.y == 0 && pad.normal.w == 0, "which is 0 again, to the bit, after a period");
    (void)run(&pad, 17u);
    once = pad.normal;
    least = run(&pad, periods * 64u);
    tap_check(pad.normal.y == once.y && pad.normal.w == once.w, "thousands of periods later it has the same bits");
    tap_check(least >= 0 && !pad.is_saturated, "and the force never pulled");
}

/* The maps of a whole step, against the float twin's series in a unit where it has all its digits. */
static void check_map(void)
{
    struct pad pad = pad_of(UNIT_SET "normal exact contact lift", 0.5f, 0.0f, 0.5f);
    float first;

    pad.normal.y += 1 << 25; /* not at rest, but so that it never lifts off */
    first = amplitude(&pad.normal);
    (void)run(&pad, plants_scaled(64u * 2000u, 64u * 50u));
    tap_check_close(amplitude(&pad.normal) / first, 1.0f, 2e-5f,
                    "the map of an undamped step turns and does not stretch");
}

/* Q = (w + Cn y/2)^2 + (1 - Cn^2/4) y^2 of the free motion decays like exp(-Cn t) exactly. */
static void check_decay(const char *assignments, float tolerance)
{
    struct pad pad = pad_of(assignments, 0.5f, 0.3f, 0.1f);
    float before = 0.0f;
    float after = 0.0f;

    for (uint32_t i = 0u; i < 2u; i++) {
        const float y = (float)(pad.normal.y - pad.normal.n) * UNIT;
        const float w = (float)pad.normal.w * UNIT + 0.025f * y;

        before = after;
        after = w * w + (1.0f - 0.025f * 0.025f) * y * y;
        if (i == 0u) {
            (void)run(&pad, 640u); /* ten periods, Cn t = pi */
        }
    }
    tap_check_close(after / before, 0.043213918f, tolerance, "a damped pad loses what its damping says");
}

/* A whole step by its map or by RK4, against parts of it, and the arc through its ends against the motion inside. */
static void check_parts(const char *assignments, float tolerance, float arc_tolerance)
{
    uint32_t state = 12u;
    float worst_cut = 0.0f;
    float worst_arc = 0.0f;

    for (uint32_t i = 0u; i < plants_scaled(300u, 30u); i++) {
        struct pad pad = pad_of(assignments, plants_random(&state, 0.1f, 2.0f), plants_random(&state, -1.0f, 1.0f),
                                plants_random(&state, 0.0f, 1.0f));
        const int32_t part = (int32_t)(tap_random(&state) >> 2);
        struct normal_q27_piece whole;
        struct normal_q27_piece piece;
        struct normal_q27_arc arc;

        normal_q27_open_step(&pad.normal, &pad.coeffs);
        normal_q27_look(&pad.normal, &pad.coeffs, &whole, &pad.is_saturated);
        normal_q27_arc_make(&arc, &pad.normal, &pad.coeffs, NORMAL_Q27_WHOLE, &whole);
        normal_q27_look_part(&pad.normal, &pad.coeffs, part, &piece, &pad.is_saturated);
        worst_arc = fmath_max(worst_arc, fmath_abs((float)(normal_q27_arc_y(&arc, part) - piece.y) * UNIT));
        normal_q27_move(&pad.normal, &piece);
        normal_q27_look_part(&pad.normal, &pad.coeffs, NORMAL_Q27_WHOLE - part, &piece, &pad.is_saturated);
        worst_cut = fmath_max(worst_cut, fmath_abs((float)(piece.y - whole.y) * UNIT) +
                                             fmath_abs((float)(piece.w - whole.w) * UNIT));
    }
    tap_check_close(worst_cut, 0.0f, tolerance, "a whole step is the same cut in two");
    tap_check_close(worst_arc, 0.0f, arc_tolerance, "and inside it runs along its arc");
}

static void check_load_change(void)
{
    struct pad phase = pad_of(UNIT_SET "normal exact", 0.3f, -0.2f, 0.25f);
    struct pad map = phase;

    map.coeffs.has_phase = false;
    for (uint32_t i = 0u; i < 200u; i++) {
        if (i % 37u == 5u) {
            const int32_t n = fixed_from_float(0.1f * (float)(i % 7u), 27);

            normal_q27_set_load(&phase.normal, &phase.coeffs, n, &phase.is_saturated);
            normal_q27_set_load(&map.normal, &map.coeffs, n, &map.is_saturated);
        }
        (void)advance(&phase);
        (void)advance(&map);
    }
    tap_check_close((float)(phase.normal.y - map.normal.y) * UNIT, 0.0f, 5e-7f, "a change of load leaves displacement");
    tap_check_close((float)(phase.normal.w - map.normal.w) * UNIT, 0.0f, 5e-7f,
                    "and velocity of the phase form continuous");
}

void test_normal_q27(void)
{
    check_table();
    check_rk4_loss(UNIT_SET "spp 16", 20u);
    check_rk4_loss(UNIT_SET "spp 32", 200u);
    check_rk4_loss(UNIT_SET "spp 64", plants_scaled(2000u, 1000u));
    check_no_drift();
    check_map();
    check_decay(UNIT_SET "cn 0.05 normal exact", 1e-6f);
    check_decay(UNIT_SET "cn 0.05", 1e-5f);
    check_parts(UNIT_SET "cn 0.05 normal exact", 3e-8f, 1e-6f);
    check_parts(UNIT_SET "cn 2 spp 32 normal exact", 1e-7f, 1e-4f);
    check_parts(UNIT_SET "cn 0.05", 2e-6f, 1e-6f);
    check_load_change();
}
