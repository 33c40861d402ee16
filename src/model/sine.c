/* One quarter wave in flash, read forwards and backwards. */
#include "model/sine.h"

#define SINE_POINT(value) value##f,
const float sine_quarter_f32[SINE_GRID / 4 + 1] = {
#include "model/sine_table.def"
};
#undef SINE_POINT

/* The compiler rounds: these doubles never reach the firmware. */
#define SINE_POINT(value) (int32_t)((value) < 1.0 ? (value)*2147483648.0 + 0.5 : 2147483647.0),
const int32_t sine_quarter_q31[SINE_GRID / 4 + 1] = {
#include "model/sine_table.def"
};
#undef SINE_POINT

float sine_f32(uint32_t index)
{
    const uint32_t in_quarter = index & (SINE_GRID / 4u - 1u);
    const uint32_t turn = index & (SINE_GRID - 1u);
    const float value =
        (turn & (SINE_GRID / 4u)) != 0u ? sine_quarter_f32[SINE_GRID / 4u - in_quarter] : sine_quarter_f32[in_quarter];

    return (turn & (SINE_GRID / 2u)) != 0u ? -value : value;
}
