/* The normal oscillator: what RK4 loses, and that the closed forms lose nothing. */
#include "model/normal_f32.h"

#include "base/fmath.h"
#include "model/sine.h"
#include "plants.h"
#include "tap.h"
#include "tests.h"

/* wn = 1 rad/s; the model's units of load and normal displacement are 10 N and 10 m. */
#define UNIT_SET "m 1 ke 1 kt 0.5 k 0.5 N_max 10 v_max 10 "

struct pad {
    struct normal_f32_coeffs coeffs;
    struct normal_f32 normal;
    struct scale scale;
};

static struct pad pad_of(const char *assignments, float y, float w, float n)
{
    const struct params params = plants_params(assignments);
    struct sim_plan plan;
    struct pad pad;

    plants_plan(&plan, &params);
    pad.coeffs = plan.f32.normal;
    pad.scale = plan.scale;
    normal_f32_reset(&pad.normal, &pad.coeffs, y, w, n);
    return pad;
}

/* One whole step; returns the least force of its stages. */
static float advance(struct pad *pad)
{
    struct normal_f32_piece piece;

    (void)normal_f32_open_step(&pad->normal, &pad->coeffs);
    normal_f32_look(&pad->normal, &pad->coeffs, pad->coeffs.step, true, &piece);
    normal_f32_move(&pad->normal, &piece);
    (void)normal_f32_close_step(&pad->normal, &pad->coeffs);
    return fmath_min(fmath_min(piece.p1, piece.p2), fmath_min(piece.p3, piece.p4));
}

static float run(struct pad *pad, uint32_t steps)
{
    float least = 1e9f;

    for (uint32_t i = 0u; i < steps; i++) {
        least = fmath_min(least, advance(pad));
    }
    return least;
}

static float amplitude(const struct normal_f32 *normal)
{
    const float d = normal->y - normal->n;

    return fmath_sqrt(d * d + normal->w * normal->w);
}

static void check_rk4_loss(const char *assignments, uint32_t periods)
{
    struct pad pad = pad_of(assignments, 0.0f, 0.0f, 0.25f);
    const float predicted = scale_rk4_loss_per_period(&pad.scale) * (float)periods;
    float least;

    least = run(&pad, periods * pad.scale.steps_per_period);
    tap_check_close((1.0f - amplitude(&pad.normal) / 0.25f) / predicted, 1.0f, 0.05f,
                    "RK4 takes 2 pi h^5/144 of the amplitude a period");
    tap_check(least >= 0.0f, "and from rest the force never pulls");
}

static void check_no_drift(void)
{
    const uint32_t periods = plants_scaled(10000u, 100u);
    struct pad pad = pad_of(UNIT_SET "normal exact", 0.0f, 0.0f, 0.25f);
    struct normal_f32 once;
    float worst = 0.0f;
    float least;

    tap_check(pad.coeffs.has_phase, "the undamped closed form counts its phase");
    for (uint32_t i = 0u; i < 64u; i++) {
        struct normal_f32_piece piece;

        normal_f32_look(&pad.normal, &pad.coeffs, pad.coeffs.step, true, &piece);
        worst = fmath_max(worst, fmath_abs(piece.p2 - 0.25f * (1.0f - sine_cosine_f32(16u * i + 8u))));
        (void)advance(&pad);
        worst = fmath_max(worst, fmath_abs(pad.normal.y - 0.25f * (1.0f - sine_cosine_f32(16u * i + 16u))));
        worst = fmath_max(worst, fmath_abs(pad.normal.w - 0.25f * sine_f32(16u * i + 16u)));
    }
    tap_check_close(worst, 0.0f, 5e-8f, "from rest y is n (1 - cos), at the middle of steps too");
    (void)run(&pad, 17u);
    once = pad.normal;
    least = run(&pad, periods * 64u);
    tap_check(pad.normal.y == once.y && pad.normal.w == once.w, "thousands of periods later it has the same bits");
    tap_check(least >= 0.0f, "and the force never pulled");
}

/* Q = (w + Cn y/2)^2 + (1 - Cn^2/4) y^2 of the free motion decays like exp(-Cn t) exactly. */
static void check_decay(const char *assignments, float tolerance)
{
    struct pad pad = pad_of(assignments, 0.5f, 0.3f, 0.1f);
    float before = 0.0f;
    float after = 0.0f;

    for (uint32_t i = 0u; i < 2u; i++) {
        const float y = pad.normal.y - pad.normal.n;
        const float w = pad.normal.w + 0.025f * y;

        before = after;
        after = w * w + (1.0f - 0.025f * 0.025f) * y * y;
        if (i == 0u) {
            (void)run(&pad, 640u); /* ten periods, Cn t = pi */
        }
    }
    tap_check_close(after / before, 0.043213918f, tolerance, "a damped pad loses what its damping says");
}

/* Whole steps from the prepared map, against the series that serves parts of a step, whole and cut in two. */
static void check_pieces(const char *assignments, float tolerance)
{
    uint32_t state = 12u;
    float worst_whole = 0.0f;
    float worst_cut = 0.0f;

    for (uint32_t i = 0u; i < plants_scaled(300u, 30u); i++) {
        struct pad pad = pad_of(assignments, plants_random(&state, 0.1f, 2.0f), plants_random(&state, -1.0f, 1.0f),
                                plants_random(&state, 0.0f, 1.0f));
        const float h = pad.coeffs.step;
        const float part = plants_random(&state, 0.0f, 1.0f) * h;
        struct normal_f32_piece whole;
        struct normal_f32_piece piece;

        normal_f32_look(&pad.normal, &pad.coeffs, h, true, &whole);
        normal_f32_look(&pad.normal, &pad.coeffs, h, false, &piece);
        worst_whole = fmath_max(worst_whole, fmath_abs(piece.y - whole.y) + fmath_abs(piece.w - whole.w) +
                                                 fmath_abs(piece.p2 - whole.p2));
        normal_f32_look(&pad.normal, &pad.coeffs, part, false, &piece);
        normal_f32_move(&pad.normal, &piece);
        normal_f32_look(&pad.normal, &pad.coeffs, h - part, false, &piece);
        worst_cut = fmath_max(worst_cut, fmath_abs(piece.y - whole.y) + fmath_abs(piece.w - whole.w));
    }
    tap_check_close(worst_whole, 0.0f, tolerance, "a whole step is the same by map and by series");
    tap_check_close(worst_cut, 0.0f, tolerance, "and cut in two");
}

static void check_load_change(void)
{
    struct pad phase = pad_of(UNIT_SET "normal exact", 0.3f, -0.2f, 0.25f);
    struct pad map = phase;

    map.coeffs.has_phase = false;
    for (uint32_t i = 0u; i < 200u; i++) {
        if (i % 37u == 5u) {
            const float n = 0.1f * (float)(i % 7u);

            normal_f32_set_load(&phase.normal, &phase.coeffs, n);
            normal_f32_set_load(&map.normal, &map.coeffs, n);
        }
        (void)advance(&phase);
        (void)advance(&map);
    }
    tap_check_close(phase.normal.y, map.normal.y, 3e-6f, "a change of load leaves displacement");
    tap_check_close(phase.normal.w, map.normal.w, 3e-6f, "and velocity of the phase form continuous");
}

void test_normal(void)
{
    check_rk4_loss(UNIT_SET "spp 16", 20u);
    check_rk4_loss(UNIT_SET "spp 32", 200u);
    check_rk4_loss(UNIT_SET "spp 64", plants_scaled(2000u, 1000u));
    check_no_drift();
    check_decay(UNIT_SET "cn 0.05 normal exact", 1e-6f);
    check_decay(UNIT_SET "cn 0.05", 1e-5f);
    check_pieces(UNIT_SET "cn 0.05 normal exact", 1e-6f);
    check_pieces(UNIT_SET "cn 2 spp 32 normal exact", 2e-6f);
    check_pieces(UNIT_SET "cn 0.05", 2e-6f);
    check_load_change();
}
