/* The integrator's sine: correct to the last bit, symmetric, periodic. */
#include "model/sine.h"

#include "base/fmath.h"
#include "base/hash.h"
#include "tap.h"
#include "tests.h"

void test_sine(void)
{
    uint32_t hash = HASH_INIT;
    bool is_odd = true;
    bool is_periodic = true;
    bool is_shifted = true;
    float worst = 0.0f;

    for (uint32_t i = 0u; i <= SINE_GRID / 4u; i++) {
        hash = hash_word(hash, fmath_bits(sine_f32(i)));
    }
    for (uint32_t i = 0u; i < SINE_GRID; i++) {
        const float error = sine_f32(i) - fmath_sine_turns(i << 22);

        worst = fmath_max(worst, fmath_abs(error));
        is_odd = is_odd && sine_f32(0u - i) == -sine_f32(i) && sine_f32(SINE_GRID / 2u - i) == sine_f32(i);
        is_periodic = is_periodic && sine_f32(i + 7u * SINE_GRID) == sine_f32(i);
        is_shifted = is_shifted && sine_cosine_f32(i) == sine_f32(SINE_GRID / 4u - i);
    }
    /* python3: FNV-1a over struct.pack('<f', math.sin(2 * math.pi * i / 1024)) for i in 0 ... 256 */
    tap_check(hash == 0xc4752712u, "the quarter wave has the bits of correctly rounded sines");
    tap_check_close(worst, 0.0f, 1e-7f, "the full wave agrees with the other sine");
    tap_check(is_odd && is_periodic, "it is odd, symmetric and periodic to the bit");
    tap_check(is_shifted && sine_cosine_f32(0u) == 1.0f && sine_cosine_f32(256u) == 0.0f,
              "the cosine leads by a quarter");
}
