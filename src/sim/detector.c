/* Booking: every step into the present frame, every period into the strobes. */
#include "sim/detector.h"

#include "base/compiler.h"
#include "base/fixed.h"
#include "sim/detector_parts.h"
#include "sim/extremum.h"

enum {
    CHANGE_SHIFT = 2,     /* of strobe changes before squaring, so that a frame's sum fits 64 bits */
    CHANGE_MAX = 1 << 27, /* the same, after the shift */
    CHANGE_KNOWN = 1 << 30,
    SQUARE_SHIFT = 11 /* of v before squaring: Q16 */
};

static const struct detector_frame empty_frame = {
    .x_max = -INT32_MAX,
    .x_min = INT32_MAX,
    .v_max = -INT32_MAX,
    .v_min = INT32_MAX,
    .w_max = -INT32_MAX,
    .w_min = INT32_MAX,
};

void detector_empty_bands(struct detector *detector)
{
    static const struct detector_band none = {0, 0u};

    detector->x_band = none;
    detector->v_band = none;
    detector->w_band = none;
    detector->change_band = none;
}

static void open_frame(struct detector *detector)
{
    detector->now = empty_frame;
    detector->change_sum = 0u;
    detector->v_sum = 0;
    detector->frame_v_sum = 0;
    detector->v_square_sum = 0u;
    detector->periods = 0u;
    detector_empty_bands(detector);
}

void detector_restart(struct detector *detector, const struct detector_config *config)
{
    detector->config = *config;
    detector->frame = 0u;
    detector->evidence = 0u;
    detector->strobes = 0u;
    detector->peaks = 0u;
    detector->period_step = detector_step(detector);
    detector->phase = 0u;
    detector->is_below = false;
    detector->hysteresis = 0;
    detector->search.stage = STAGE_IDLE;
    open_frame(detector);
    if (!detector->has_diverged) {
        detector->verdict.propensity = PROPENSITY_UNKNOWN;
        detector->verdict.motion = CLASS_UNSETTLED;
        detector->verdict.period = 0u;
        detector->verdict.has_growth = false;
    }
}

void detector_reset(struct detector *detector, const struct detector_config *config, const struct plant_output *now)
{
    detector->has_diverged = false;
    detector->period_step = 0u;
    detector->phase = 0u;
    detector->x1 = now->x;
    detector->v1 = now->v;
    detector->level = 0;
    detector->verdict = (struct detector_verdict){0};
    for (unsigned i = 0u; i < DETECTOR_WINDOW_FRAMES; i++) {
        detector->frames[i] =
            empty_frame; /* the line of growth is drawn through all of them, also before they are filled */
    }
    detector_restart(detector, config);
}

void detector_set_diverged(struct detector *detector)
{
    detector->has_diverged = true;
    detector->search.stage = STAGE_IDLE;
    detector->verdict.propensity = PROPENSITY_SQUEAL;
    detector->verdict.motion = CLASS_DIVERGING;
    detector->verdict.period = 0u;
}

BASE_INLINE void widen(int32_t value, int32_t *low, int32_t *high)
{
    if (value > *high) {
        *high = value;
    }
    if (value < *low) {
        *low = value;
    }
}

/* Displacement turns where the velocity changes its sign; a maximum is remembered with its time. */
static BASE_NOINLINE void book_turn(struct detector *detector, const struct plant_output *output)
{
    const bool is_maximum = detector->v1 > 0;
    const int32_t extreme =
        extremum_of_displacement(detector->x1, detector->v1, output->x, output->v, detector->config.step_q27);

    widen(extreme, &detector->now.x_min, &detector->now.x_max);
    if (is_maximum) {
        const uint32_t slot = detector->peaks % DETECTOR_PEAKS;
        const uint32_t before = fixed_abs(detector->v1) >> 1;
        const uint32_t whole = before + (fixed_abs(output->v) >> 1) + 1u;

        detector->peak_x[slot] = extreme;
        detector->peak_time_q8[slot] =
            ((uint32_t)detector_step(detector) << 8) + (extremum_ratio_q15(before, whole) >> 7);
        detector->peaks++;
    }
}

static BASE_NOINLINE void book_crossing(struct detector *detector, int32_t x)
{
    const uint32_t before = (uint32_t)((int64_t)detector->level - detector->x1);
    const uint32_t whole = (uint32_t)((int64_t)x - detector->x1);

    detector->now.last_q15 = (detector_step(detector) << 15) + extremum_ratio_q15(before, whole);
    if (detector->now.crossings == 0u) {
        detector->now.first_q15 = detector->now.last_q15;
    }
    detector->now.crossings++;
    detector->is_below = false;
}

/* Upward passages of the level that the frame before has set, with hysteresis against small wiggles. */
static void book_passage(struct detector *detector, int32_t x)
{
    if (!detector->is_below) {
        detector->is_below = x < detector->level - detector->hysteresis && detector->hysteresis != 0;
    } else if (x >= detector->level && detector->x1 < detector->level) {
        book_crossing(detector, x);
    }
}

static uint64_t square_of_change(int64_t change)
{
    const uint64_t size = (uint64_t)(change < 0 ? -change : change) >> CHANGE_SHIFT;
    const uint64_t bounded = size < CHANGE_MAX ? size : CHANGE_MAX;

    return bounded * bounded;
}

/* Once a period. The second difference of three strobes is blind to what repeats every period and to a steady drift:
 * what is left is the free part of the motion. */
static BASE_NOINLINE void book_strobe(struct detector *detector, const struct plant_output *output)
{
    const uint32_t slot = detector->strobes % DETECTOR_STROBES;

    if (detector->strobes >= 2u) {
        const uint32_t one = (detector->strobes - 1u) % DETECTOR_STROBES;
        const uint32_t two = (detector->strobes - 2u) % DETECTOR_STROBES;
        const int64_t dx = (int64_t)output->x - 2 * (int64_t)detector->strobe_x[one] + detector->strobe_x[two];
        const int64_t dv = (int64_t)output->v - 2 * (int64_t)detector->strobe_v[one] + detector->strobe_v[two];

        detector->change_sum += square_of_change(dv);
        detector->change_sum += (square_of_change(dx) >> 16) * detector->config.stiffness_q16;
    }
    detector->strobe_x[slot] = output->x;
    detector->strobe_v[slot] = output->v;
    detector->strobes++;
    detector->periods++;
}

static void close_frame(struct detector *detector)
{
    detector->frames[detector->frame % DETECTOR_WINDOW_FRAMES] = detector->now;
    detector->frame++;
    detector->search.stage = STAGE_MEASURE;
    detector->level = (int32_t)(((int64_t)detector->now.x_max + detector->now.x_min) / 2);
    detector->hysteresis = (int32_t)(((int64_t)detector->now.x_max - detector->now.x_min) / 10);
}

static void set_band(struct detector_band *band, int32_t low, int32_t high)
{
    band->low = low;
    band->count = low <= high ? (uint32_t)high - (uint32_t)low + 1u : 0u;
}

BASE_INLINE bool is_news(struct detector_band band, uint32_t value)
{
    return BASE_UNLIKELY(value - (uint32_t)band.low >= band.count);
}

/* Until it passes the level, or the hysteresis below it, x is news beyond its extremes. */
static BASE_NOINLINE void book_x(struct detector *detector, int32_t x)
{
    struct detector_frame *now = &detector->now;
    const int32_t armed = detector->level - detector->hysteresis;

    widen(x, &now->x_min, &now->x_max);
    book_passage(detector, x);
    if (detector->is_below) {
        set_band(&detector->x_band, now->x_min, now->x_max < detector->level ? now->x_max : detector->level - 1);
    } else {
        set_band(&detector->x_band, detector->hysteresis != 0 && armed > now->x_min ? armed : now->x_min, now->x_max);
    }
}

/* Until it changes its sign, v is news beyond its extremes. Nothing turns at 0, whose band is that of the side it came
 * from. */
static BASE_NOINLINE void book_v(struct detector *detector, const struct plant_output *output)
{
    struct detector_frame *now = &detector->now;
    const int32_t v = output->v;

    widen(v, &now->v_min, &now->v_max);
    if ((detector->v1 ^ v) < 0 && detector->v1 != 0 && v != 0) {
        book_turn(detector, output);
    }
    if (v > 0) {
        set_band(&detector->v_band, now->v_min > 0 ? now->v_min : 1, now->v_max);
    } else if (v < 0) {
        set_band(&detector->v_band, now->v_min, now->v_max < 0 ? now->v_max : -1);
    }
}

static BASE_NOINLINE void book_w(struct detector *detector, int32_t w)
{
    struct detector_frame *now = &detector->now;

    widen(w, &now->w_min, &now->w_max);
    set_band(&detector->w_band, now->w_min, now->w_max);
}

/* The largest change of v in a step. Up to 8 the band tells it from one that does not fit 32 bits: v is within 10. */
static BASE_NOINLINE void book_change(struct detector *detector, int32_t v)
{
    struct detector_frame *now = &detector->now;
    const int32_t change = fixed_saturate((int64_t)v - detector->v1);
    const int32_t size = change < 0 ? -change : change;
    int32_t known;

    now->acceleration = size > now->acceleration ? size : now->acceleration;
    known = now->acceleration < CHANGE_KNOWN ? now->acceleration : CHANGE_KNOWN;
    set_band(&detector->change_band, -known, known);
}

/* Forward slip, the whole step, is what is left of a period. */
BASE_INLINE void book_shares(struct detector_frame *now, const struct plant_output *output)
{
    if (BASE_UNLIKELY(output->has_notes)) {
        now->stick += output->noted.stick;
        now->slip_minus += output->noted.slip_minus;
    } else if (output->mode == PLANT_STICK) {
        now->stick += PLANT_SHARE_ONE;
    } else if (output->mode == PLANT_SLIP_MINUS) {
        now->slip_minus += PLANT_SHARE_ONE;
    }
}

/* Most values are no news. */
BASE_INLINE void book_sample(struct detector *detector, const struct plant_output *output)
{
    const int32_t x = output->x;
    const int32_t v = output->v;
    const int32_t v_q16 = fixed_floor_word(v, SQUARE_SHIFT);

    if (is_news(detector->x_band, (uint32_t)x)) {
        book_x(detector, x);
    }
    if (is_news(detector->v_band, (uint32_t)v)) {
        book_v(detector, output);
    }
    if (is_news(detector->w_band, (uint32_t)output->w)) {
        book_w(detector, output->w);
    }
    if (is_news(detector->change_band, (uint32_t)v - (uint32_t)detector->v1)) {
        book_change(detector, v);
    }
    if (output->y > detector->now.y_max) {
        detector->now.y_max = output->y;
    }
    book_shares(&detector->now, output);
    detector->v_sum += v_q16;
    detector->v_square_sum += (uint64_t)((int64_t)v_q16 * v_q16);
    detector->x1 = x;
    detector->v1 = v;
}

static BASE_NOINLINE void close_period(struct detector *detector, const struct plant_output *output)
{
    detector->period_step = detector_step(detector);
    detector->phase = 0u;
    detector->frame_v_sum += detector->v_sum;
    detector->v_sum = 0;
    book_strobe(detector, output);
    if (detector->periods == DETECTOR_FRAME_PERIODS && !detector->has_diverged) {
        close_frame(detector);
    }
}

/* Work left over from the last frame; true when it has brought something new to say. */
static BASE_NOINLINE bool continue_work(struct detector *detector)
{
    switch ((enum detector_stage)detector->search.stage) {
    case STAGE_MEASURE:
        detector_rules_measure(detector);
        detector->search.stage = STAGE_JUDGE;
        open_frame(detector);
        return false;
    case STAGE_JUDGE:
        detector_rules_judge(detector);
        return true;
    case STAGE_STROBES:
    case STAGE_PEAKS:
        detector_search_continue(detector);
        return detector->search.stage == STAGE_IDLE;
    case STAGE_IDLE:
    default:
        return false;
    }
}

bool detector_push(struct detector *detector, const struct plant_output *output)
{
    bool is_new = false;

    if (BASE_UNLIKELY(detector->search.stage != STAGE_IDLE)) {
        is_new = continue_work(detector);
    }
    book_sample(detector, output);
    detector->verdict.disc = output->disc;
    if (BASE_UNLIKELY(++detector->phase == detector->config.steps_per_period)) {
        close_period(detector, output);
    }
    return is_new;
}

bool detector_skip(struct detector *detector, const struct plant_output *output)
{
    detector->x1 = output->x;
    detector->v1 = output->v;
    detector->verdict.disc = output->disc;
    detector->period_step++;
    detector->v_band.count = 0u;
    return false;
}

const char *detector_propensity_name(uint8_t propensity)
{
    static const char *const names[] = {"unknown", "quiet", "watch", "squeal"};

    return propensity < sizeof names / sizeof names[0] ? names[propensity] : "?";
}

const char *detector_class_name(uint8_t motion)
{
    static const char *const names[] = {"unsettled",
                                        "rest",
                                        "decaying",
                                        "growing",
                                        "forced",
                                        "stickslip",
                                        "cross",
                                        "limitcycle-slip",
                                        "limitcycle-stickslip",
                                        "aperiodic",
                                        "diverging"};

    return motion < sizeof names / sizeof names[0] ? names[motion] : "?";
}
