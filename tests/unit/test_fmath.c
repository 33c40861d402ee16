/* Functions of float: against exact integers where there are such, else against tables of more digits than a float has.
 */
#include "base/fmath.h"

#include <float.h>

#include "tap.h"
#include "tests.h"

#define INFINITE fmath_from_bits(0x7f800000u)
#define NOT_A_NUMBER fmath_from_bits(0x7fc00000u)

static uint32_t significand_of(uint32_t bits, int *exponent)
{
    uint32_t significand = bits & 0x7fffffu;

    *exponent = -149;
    if (bits >= 0x800000u) {
        significand |= 0x800000u;
        *exponent = (int)(bits >> 23) - 150;
    }
    for (; significand < 0x800000u; significand <<= 1) {
        (*exponent)--;
    }
    return significand;
}

/* Is the root the nearest float? Compares (root -+ half a unit)^2 with the value, all times 4. */
static bool is_root(uint32_t bits)
{
    int exponent;
    int root_exponent;
    const uint64_t value = significand_of(bits, &exponent);
    const uint64_t root = significand_of(fmath_bits(fmath_sqrt(fmath_from_bits(bits))), &root_exponent);
    const int shift = exponent - 2 * root_exponent + 2;

    if (shift < 22 || shift > 28) {
        return false;
    }
    return (2u * root - 1u) * (2u * root - 1u) < value << shift && value << shift < (2u * root + 1u) * (2u * root + 1u);
}

static void check_sqrt(void)
{
    const unsigned count = tap_is_hosted() ? 200000u : 2000u;
    uint32_t state = 12345u;
    bool ok = true;

    tap_check(fmath_sqrt(0.0f) == 0.0f && fmath_sqrt(4.0f) == 2.0f && fmath_sqrt(2.25f) == 1.5f, "squares have roots");
    tap_check(fmath_sqrt(-1.0f) == 0.0f && fmath_sqrt(NOT_A_NUMBER) == 0.0f, "negative values and NaN give 0");
    tap_check(fmath_sqrt(INFINITE) == INFINITE, "infinity gives infinity");
    tap_check(is_root(fmath_bits(FLT_MAX)) && is_root(fmath_bits(FLT_MIN)) && is_root(1u) && is_root(0x7fffffu),
              "the largest, the smallest and subnormal floats are rounded correctly");
    for (unsigned i = 0u; i < count && ok; i++) {
        const uint32_t bits = tap_random(&state) % 0x7f7fffffu + 1u;

        ok = is_root(bits);
        if (!ok) {
            tap_note_bits("sqrt of", bits);
        }
    }
    tap_check(ok, "random floats are rounded correctly");
    for (uint32_t i = 0u; i < count / 10u && ok; i++) {
        ok = is_root(fmath_bits(1.0f) + i) && is_root(fmath_bits(2.0f) - 1u - i);
    }
    tap_check(ok, "so are the floats next to 1 and 2");
}

static void check_sine(void)
{
    /* sin(2 pi k / 128) */
    static const struct {
        uint32_t k;
        float sine;
    } known[] = {{1u, 0.049067674f},  {3u, 0.146730474f},  {5u, 0.242980180f},  {7u, 0.336889853f},
                 {11u, 0.514102744f}, {13u, 0.595699304f}, {16u, 0.707106781f}, {23u, 0.903989293f},
                 {29u, 0.989176510f}, {31u, 0.998795456f}};
    float worst = 0.0f;
    uint32_t state = 777u;
    bool is_symmetric = true;
    bool is_unit = true;

    for (unsigned i = 0u; i < sizeof(known) / sizeof(known[0]); i++) {
        worst = fmath_max(worst, fmath_abs(fmath_sine_turns(known[i].k << 25) - known[i].sine));
    }
    tap_check_close(worst, 0.0f, 1e-7f, "a table of sines is met to 1e-7");
    tap_check(fmath_sine_turns(0u) == 0.0f && fmath_sine_turns(0x80000000u) == 0.0f, "no turn and half a turn give 0");
    tap_check(fmath_sine_turns(0x40000000u) == 1.0f && fmath_sine_turns(0xc0000000u) == -1.0f,
              "a quarter turn gives 1, three give -1");
    tap_check_close(fmath_sine_turns(1u) * 4294967296.0f, 6.28318531f, 1e-6f,
                    "the smallest angle keeps all its digits");
    for (unsigned i = 0u; i < 2000u; i++) {
        const uint32_t turns = tap_random(&state);
        const float sine = fmath_sine_turns(turns);
        const float cosine = fmath_sine_turns(turns + 0x40000000u);

        is_symmetric = is_symmetric && fmath_bits(fmath_sine_turns(0u - turns)) == fmath_bits(-sine) &&
                       fmath_bits(fmath_sine_turns(0x80000000u - turns)) == fmath_bits(sine);
        is_unit = is_unit && fmath_abs(sine * sine + cosine * cosine - 1.0f) < 4e-7f;
    }
    tap_check(is_symmetric, "sine is odd and mirrored at a quarter turn, to the bit");
    tap_check(is_unit, "sine and cosine lie on the unit circle");
}

static void check_log2(void)
{
    bool ok = true;

    for (int exponent = -149; exponent < 128; exponent++) {
        const uint32_t bits = exponent < -126 ? 1u << (exponent + 149) : (uint32_t)(exponent + 127) << 23;

        ok = ok && fmath_log2(fmath_from_bits(bits)) == (float)exponent;
    }
    tap_check(ok, "every power of two, subnormal ones too, gives its exponent");
    tap_check_close(fmath_log2(10.0f), 3.32192809f, 4e-7f, "log2(10)");
    tap_check_close(fmath_log2(0.1f), -3.32192807f, 4e-7f, "log2(0.1)");
    tap_check_close(fmath_log2(1.41421356f), 0.5f, 2e-7f, "log2 of the root of 2");
    tap_check_close(fmath_log2(1.00000012f), 1.71982633e-7f, 2e-7f, "log2 right above 1");
    tap_check_close(fmath_log2(0.99999994f), -8.5991322e-8f, 2e-7f, "log2 right below 1");
    tap_check_close(fmath_log2(FLT_MAX), 128.0f, 8e-6f, "log2 of the largest float");
}

static void check_decay(void)
{
    tap_check(fmath_decay(0.0f) == 0.0f && fmath_decay(1e-30f) == 1e-30f, "nothing decays in no time");
    tap_check_close(fmath_decay(1e-4f) / 9.99950002e-5f, 1.0f, 3e-7f, "1 - e^-0.0001 keeps its digits");
    tap_check_close(fmath_decay(0.5f), 0.39346934f, 1e-7f, "1 - e^-0.5");
    tap_check_close(fmath_decay(1.0f), 0.632120559f, 2e-7f, "1 - e^-1, the last by its series");
    tap_check_close(fmath_decay(1.00001f), 0.632124238f, 2e-7f, "right above it");
    tap_check_close(fmath_decay(3.0f), 0.950212932f, 2e-7f, "1 - e^-3");
    tap_check(fmath_decay(1e6f) == 1.0f, "all in a long time");
}

static void check_round(void)
{
    tap_check(fmath_round_i32(0.5f) == 1 && fmath_round_i32(-0.5f) == -1 && fmath_round_i32(2.5f) == 3 &&
                  fmath_round_i32(-2.5f) == -3,
              "halves are rounded away from zero");
    tap_check(fmath_round_i32(0.49999997f) == 0 && fmath_round_i32(-0.49999997f) == 0, "right below a half gives 0");
    tap_check(fmath_round_i32(8388607.5f) == 8388608 && fmath_round_i32(-8388606.5f) == -8388607,
              "so do the largest halves");
    tap_check(fmath_round_i32(16777217.0f) == 16777216 && fmath_round_i32(2147483520.0f) == 2147483520 &&
                  fmath_round_i32(-2147483520.0f) == -2147483520,
              "large values stay what they are");
}

void test_fmath(void)
{
    check_sqrt();
    check_sine();
    check_log2();
    check_decay();
    check_round();
    tap_check(fmath_bits(-2.0f) == 0xc0000000u && fmath_from_bits(0x3f800000u) == 1.0f, "bits and back");
    tap_check(fmath_is_finite(FLT_MAX) && fmath_is_finite(0.0f) && !fmath_is_finite(INFINITE) &&
                  !fmath_is_finite(-INFINITE) && !fmath_is_finite(NOT_A_NUMBER),
              "finite is neither infinite nor NaN");
}
