/* Draws, and what can be concluded from them. */
#include "sim/occurrence.h"

#include "base/fmath.h"
#include "base/random.h"

enum { STREAM = 0x6f636375 }; /* "occu": draws have nothing in common with the disc's surface of the same seed */

#define DEVIATIONS_95 1.95996398f

static float deviation(const struct occurrence *occurrence, uint32_t amount, uint32_t index)
{
    const uint32_t stream = (uint32_t)STREAM + amount;

    if (occurrence->is_uniform) {
        return (float)random_uniform_q31(occurrence->seed, stream, index) * (1.0f / 2147483648.0f);
    }
    return random_normal(occurrence->seed, stream, index);
}

/* A parameter times a factor, inside its range. */
static float scale_one(struct occurrence_draw *draw, const char *symbol, size_t length, float factor)
{
    const struct params_info *info = params_find(symbol, length);
    const float wanted = params_value(&draw->params, info) * factor;
    const float value = fmath_min(fmath_max(wanted, info->low), info->high);

    draw->clamped += value != wanted ? 1u : 0u;
    params_set(&draw->params, info, value);
    return value;
}

void occurrence_draw(const struct occurrence *occurrence, uint32_t index, struct occurrence_draw *draw)
{
    float factors[OCCURRENCE_AMOUNTS];

    draw->params = occurrence->base;
    draw->clamped = 0u;
    for (uint32_t i = 0u; i < OCCURRENCE_AMOUNTS; i++) {
        factors[i] = 1.0f + occurrence->spread[i] * deviation(occurrence, i, index);
    }
    if (factors[OCCURRENCE_LOAD] < 0.0f) {
        factors[OCCURRENCE_LOAD] = 0.0f;
        draw->clamped++;
    }
    draw->values[OCCURRENCE_FRICTION] = scale_one(draw, "mu_s", 4u, factors[OCCURRENCE_FRICTION]);
    draw->values[OCCURRENCE_SLOPE] = scale_one(draw, "alpha", 5u, factors[OCCURRENCE_SLOPE]);
    draw->values[OCCURRENCE_DAMPING] = scale_one(draw, "c", 1u, factors[OCCURRENCE_DAMPING]);
    draw->values[OCCURRENCE_LOAD] = factors[OCCURRENCE_LOAD];
    (void)scale_one(draw, "N0", 2u, factors[OCCURRENCE_LOAD]);
    (void)scale_one(draw, "N1", 2u, factors[OCCURRENCE_LOAD]);
    draw->params.seed = (float)(random_words(occurrence->seed, (uint32_t)STREAM + OCCURRENCE_AMOUNTS, index).first &
                                OCCURRENCE_SEED_MAX);
}

void occurrence_interval(uint32_t k, uint32_t n, float *low, float *high)
{
    const float count = (float)n;
    const float share = (float)k / count;
    const float square = DEVIATIONS_95 * DEVIATIONS_95 / count;
    const float middle = share + 0.5f * square;
    const float half = DEVIATIONS_95 * fmath_sqrt((share * (1.0f - share) + 0.25f * square) / count);

    *low = k == 0u ? 0.0f : (middle - half) / (1.0f + square);
    *high = k == n ? 1.0f : (middle + half) / (1.0f + square);
}

const char *occurrence_name(enum occurrence_amount amount)
{
    static const char *const names[] = {"mu_s", "alpha", "c", "N"};

    return (unsigned)amount < sizeof names / sizeof names[0] ? names[amount] : "?";
}
