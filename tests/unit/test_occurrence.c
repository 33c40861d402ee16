/* Scatter and its interval. */
#include "sim/occurrence.h"

#include "base/fmath.h"
#include "plants.h"
#include "tap.h"
#include "tests.h"

static const float look_values[OCCURRENCE_AMOUNTS] = {0.42f, -0.06f, 120.0f, 1.0f};

enum { DRAWS = 4000, FIRST_BITS = 0x3eff54f7 };

static struct occurrence brake_with(bool is_uniform, float spread)
{
    struct occurrence occurrence = {.base = plants_preset("brake", ""), .seed = 11u, .is_uniform = is_uniform};

    for (uint32_t i = 0u; i < OCCURRENCE_AMOUNTS; i++) {
        occurrence.spread[i] = spread;
    }
    return occurrence;
}

/* Mean and deviation of an amount over its value, and the largest distance from 1. */
static void look(const struct occurrence *occurrence, uint32_t amount, float value, float *mean, float *rms,
                 float *most)
{
    float sum = 0.0f;
    float square = 0.0f;
    struct occurrence_draw draw;

    *most = 0.0f;
    for (uint32_t i = 0u; i < DRAWS; i++) {
        float distance;

        occurrence_draw(occurrence, i, &draw);
        distance = draw.values[amount] / value - 1.0f;
        sum += distance;
        square += distance * distance;
        *most = fmath_max(*most, fmath_abs(distance));
    }
    *mean = 1.0f + sum / (float)DRAWS;
    *rms = fmath_sqrt(square / (float)DRAWS);
}

static void check_scatter(void)
{
    const struct occurrence uniform = brake_with(true, 0.1f);
    const struct occurrence normal = brake_with(false, 0.1f);
    float mean;
    float rms;
    float most;

    for (uint32_t i = 0u; i < OCCURRENCE_AMOUNTS; i++) {
        look(&uniform, i, look_values[i], &mean, &rms, &most);
        tap_check(fmath_abs(mean - 1.0f) < 3e-3f && fmath_abs(rms - 0.057735f) < 1e-3f && most < 0.1001f &&
                      most > 0.0995f,
                  occurrence_name((enum occurrence_amount)i));
        look(&normal, i, look_values[i], &mean, &rms, &most);
        tap_check(fmath_abs(mean - 1.0f) < 5e-3f && fmath_abs(rms - 0.1f) < 4e-3f && most > 0.3f && most < 0.5f,
                  "and normally distributed");
    }
}

/* The amounts are drawn independently of each other. */
static void check_independence(void)
{
    const struct occurrence occurrence = brake_with(true, 0.1f);
    float product[OCCURRENCE_AMOUNTS] = {0.0f};
    struct occurrence_draw draw;

    for (uint32_t i = 0u; i < DRAWS; i++) {
        occurrence_draw(&occurrence, i, &draw);
        for (uint32_t k = 0u; k < OCCURRENCE_AMOUNTS; k++) {
            const uint32_t next = (k + 1u) % OCCURRENCE_AMOUNTS;
            const float a = draw.values[k] / look_values[k] - 1.0f;
            const float b = draw.values[next] / look_values[next] - 1.0f;

            product[k] += a * b * 300.0f / (float)DRAWS;
        }
    }
    for (uint32_t k = 0u; k < OCCURRENCE_AMOUNTS; k++) {
        tap_check(fmath_abs(product[k]) < 0.06f, "two amounts have nothing to do with each other");
    }
}

static void check_draws(void)
{
    const struct occurrence occurrence = brake_with(false, 0.1f);
    struct occurrence other = occurrence;
    struct occurrence_draw first;
    struct occurrence_draw again;
    struct occurrence_draw draw;

    occurrence_draw(&occurrence, 5u, &first);
    occurrence_draw(&occurrence, 9u, &draw);
    occurrence_draw(&occurrence, 5u, &again);
    tap_check(first.params.load_end_n == again.params.load_end_n && first.params.load_end_n != draw.params.load_end_n,
              "a draw depends on its number alone");
    tap_check_close(first.params.load_end_n, 3000.0f * first.values[OCCURRENCE_LOAD], 1e-3f,
                    "the load is scaled as a whole");
    tap_check(first.params.seed != draw.params.seed && first.params.seed >= 0.0f, "each has a disc of its own");
    other.seed = 12u;
    occurrence_draw(&other, 5u, &draw);
    tap_check(first.params.load_end_n != draw.params.load_end_n, "and on the seed");
    tap_check(fmath_bits(first.params.friction_static_ratio) == FIRST_BITS, "the same bits on every machine");
    other.base = plants_params("N0 10");
    occurrence_draw(&other, 5u, &draw);
    tap_check_close(draw.params.load_n, 10.0f * draw.values[OCCURRENCE_LOAD], 1e-4f, "where it is constant too");
    other = brake_with(false, 1.0f);
    for (uint32_t k = 0u; k < OCCURRENCE_LOAD; k++) {
        other.spread[k] = 0.0f;
    }
    for (uint32_t i = 0u; i < 60u; i++) {
        occurrence_draw(&other, i, &draw);
        if (draw.values[OCCURRENCE_LOAD] == 0.0f) {
            break;
        }
    }
    tap_check(draw.values[OCCURRENCE_LOAD] == 0.0f && draw.clamped > 0u, "a load below 0 is held there and counted");
    other = brake_with(false, 1.0f);
    for (uint32_t i = 0u; i < 20u; i++) {
        occurrence_draw(&other, i, &draw);
        if (draw.clamped > 0u) {
            break;
        }
    }
    tap_check(draw.clamped > 0u && params_check(&draw.params).error == ERROR_OK,
              "what leaves its range is clamped and counted");
}

/* Wilson's interval at 95 %, to four digits: 1 of 10 is 0.0179 to 0.4042, 50 of 100 is 0.4038 to 0.5962. */
static void check_interval(void)
{
    float low;
    float high;

    occurrence_interval(1u, 10u, &low, &high);
    tap_check(fmath_abs(low - 0.01788f) < 1e-4f && fmath_abs(high - 0.40415f) < 1e-4f, "one of ten");
    occurrence_interval(50u, 100u, &low, &high);
    tap_check(fmath_abs(low - 0.40383f) < 1e-4f && fmath_abs(high - 0.59617f) < 1e-4f, "half of a hundred");
    occurrence_interval(0u, 20u, &low, &high);
    tap_check(low == 0.0f && fmath_abs(high - 0.16113f) < 1e-4f, "none of twenty");
    occurrence_interval(20u, 20u, &low, &high);
    tap_check(high == 1.0f && fmath_abs(low - 0.83887f) < 1e-4f, "all of them");
}

void test_occurrence(void)
{
    check_scatter();
    check_independence();
    check_draws();
    check_interval();
}
