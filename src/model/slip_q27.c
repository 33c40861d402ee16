/* Slip over parts of a step, where either arithmetic may have to serve. */
#include "model/slip_q27.h"

void slip_q27_take_part(const struct slip_q27_factors *whole, int32_t fraction, bool has_floor, bool is_wide,
                        struct slip_q27_factors *part)
{
    slip_q27_fine_part(whole, fraction, part);
    if (is_wide) {
        part->drag = fixed_part((int32_t)fixed_floor(whole->drag, 27u), fraction) * (INT64_C(1) << 27) + (1 << 26);
    }
    if (has_floor) {
        part->floor = fixed_part(whole->floor, fraction);
        part->knee = ((int64_t)part->floor - part->friction) * (1 << 27);
    }
}

int32_t slip_q27_any_increment(const struct slip_q27_factors *f, const struct slip_q27_view *view, int32_t x, int32_t v,
                               int32_t p, bool has_floor, bool *is_saturated)
{
    if (is_saturated != NULL) {
        return slip_q27_increment(f, view, x, v, p, has_floor, SLIP_Q27_WIDE, is_saturated);
    }
    return slip_q27_fine_increment(f, view, x, v, p, has_floor);
}

void slip_q27_any_go(const struct slip_q27_factors *f, const struct slip_q27_view *view,
                     const struct slip_q27_rest *rest, const struct normal_q27_piece *piece, struct slip_q27_end *end,
                     bool has_floor, bool *is_saturated)
{
    if (is_saturated != NULL) {
        slip_q27_go_wide(f, view, rest, piece, end, has_floor, is_saturated);
    } else if (has_floor) {
        slip_q27_go_fine(f, view, rest, piece, end, true, true);
    } else {
        slip_q27_go_fine(f, view, rest, piece, end, true, false);
    }
}
