/* From a full window to a verdict. Every constant here has its reason in DETECTOR.md. */
#include "base/fixed.h"
#include "sim/detector_parts.h"

enum {
    NOISE_SUM = 1 << 20,      /* squared changes of a frame below this are rounding */
    GROWTH_LEAST_Q16 = 38,    /* 5e-5 a period: slower than this is no growth */
    EVIDENCE_GAIN = 4,        /* a frame with squeal */
    EVIDENCE_ENTER = 12,      /* three frames */
    EVIDENCE_MAX = 16,        /* forgotten after 128 quiet periods */
    FLOOR_SHIFT = 6,          /* motion below 1/64 of the disc's speed is none */
    FLOOR_MIN = 1 << 12,      /* 3e-5 Vref */
    FLOOR_TOUCHING = 1 << 10, /* 8e-6 Vref: a pad that touches the disc moves, if it is not rounding that moves it */
    FLOOR_DISC_STOPPED = 1 << 17,
    CONTACT_LEAST = 1 << 17,  /* contact below 1/1024 of the largest load is none */
    ERROR_MOST_Q16 = 1 << 14, /* 0.02 a period: a growth less certain is not known */
    STEADY_SHIFT = 4,         /* of the speed, over a window */
    FALLING_SHIFT = 7,        /* the same if it falls from frame to frame: 3e-4 a period */
    SHARE_LEAST_SHIFT = 20    /* a share within 1e-6 of none or all is none or all */
};

/* Steps of a frame as a power of two. */
static uint32_t frame_shift(const struct detector *detector)
{
    uint32_t shift = 0u;

    while ((1u << shift) < detector->config.steps_per_period * DETECTOR_FRAME_PERIODS) {
        shift++;
    }
    return shift;
}

/* The frame's sums, before the next frame takes their place. */
void detector_rules_measure(struct detector *detector)
{
    struct detector_frame *frame = detector_newest_frame(detector);
    struct detector_verdict *verdict = &detector->verdict;
    const uint32_t shift = frame_shift(detector);
    const int64_t mean = fixed_shift_right(detector->frame_v_sum, shift);

    verdict->variance = detector->v_square_sum >> shift;
    verdict->variance -= verdict->variance > (uint64_t)(mean * mean) ? (uint64_t)(mean * mean) : verdict->variance;
    if (detector->frame == 1u) {
        /* The first two strobes have no second difference: six stand for eight. */
        detector->change_sum += (detector->change_sum >> 2) + (detector->change_sum >> 4) + (detector->change_sum >> 6);
    }
    frame->change_log2_q16 = detector->change_sum >= NOISE_SUM ? fixed_log2_q16(detector->change_sum) : -1;
    /* An amplitude, so half the logarithm of its square. */
    verdict->free_log2_q16 = frame->change_log2_q16 < 0 ? -1 : frame->change_log2_q16 / 2;
}

/* Straight line through the logarithms of the last four frames: its slope, and as error twice the largest distance from
 * it, which noise alone rarely exceeds. */
static void fit_growth(struct detector *detector)
{
    struct detector_verdict *verdict = &detector->verdict;
    int32_t log2_q16[DETECTOR_WINDOW_FRAMES];
    int32_t sum = 0;
    int32_t slope;
    int32_t worst = 0;

    verdict->has_growth = detector->frame >= DETECTOR_WINDOW_FRAMES;
    for (uint32_t i = 0u; i < DETECTOR_WINDOW_FRAMES; i++) {
        /* Amplitudes, so half the logarithm of their squares. */
        const int32_t value = detector->frames[(detector->frame + i) % DETECTOR_WINDOW_FRAMES].change_log2_q16;

        verdict->has_growth = verdict->has_growth && value >= 0;
        log2_q16[i] = value / 2;
        sum += log2_q16[i];
    }
    slope = (3 * (log2_q16[3] - log2_q16[0]) + (log2_q16[2] - log2_q16[1])) / 10;
    for (int32_t i = 0; i < DETECTOR_WINDOW_FRAMES; i++) {
        const int32_t line = sum / 4 + slope * (2 * i - 3) / 2;
        const int32_t distance = log2_q16[i] > line ? log2_q16[i] - line : line - log2_q16[i];

        worst = distance > worst ? distance : worst;
    }
    verdict->growth_q16 = verdict->has_growth ? slope : 0;
    verdict->growth_error_q16 = verdict->has_growth ? 2 * worst : 0;
}

static void widen(struct detector_verdict *verdict, const struct detector_frame *frame)
{
    verdict->x_max = frame->x_max > verdict->x_max ? frame->x_max : verdict->x_max;
    verdict->x_min = frame->x_min < verdict->x_min ? frame->x_min : verdict->x_min;
    verdict->v_max = frame->v_max > verdict->v_max ? frame->v_max : verdict->v_max;
    verdict->v_min = frame->v_min < verdict->v_min ? frame->v_min : verdict->v_min;
    verdict->acceleration = frame->acceleration > verdict->acceleration ? frame->acceleration : verdict->acceleration;
}

/* Mean share a step of filled frames (1 ... 4), without a 64-bit division: a frame has a power of two of steps. */
static uint32_t mean_share(uint64_t sum, uint32_t filled, uint32_t shift)
{
    return (uint32_t)(sum >> (shift + 1u)) / filled * 2u;
}

/* Extremes, shares and passages of the window, oldest frame first. */
static void gather_window(struct detector *detector)
{
    struct detector_verdict *verdict = &detector->verdict;
    const uint32_t filled = detector->frame < DETECTOR_WINDOW_FRAMES ? detector->frame : DETECTOR_WINDOW_FRAMES;
    uint64_t stick = 0u;
    uint64_t slip_minus = 0u;
    uint64_t first = 0u;
    uint64_t last = 0u;
    uint32_t passages = 0u;

    verdict->x_max = verdict->v_max = -INT32_MAX;
    verdict->x_min = verdict->v_min = INT32_MAX;
    verdict->acceleration = 0;
    for (uint32_t i = detector->frame - filled; i < detector->frame; i++) {
        const struct detector_frame *frame = &detector->frames[i % DETECTOR_WINDOW_FRAMES];

        widen(verdict, frame);
        stick += frame->stick;
        slip_minus += frame->slip_minus;
        if (frame->crossings > 0u) {
            first = passages == 0u ? frame->first_q15 : first;
            last = frame->last_q15;
            passages += frame->crossings;
        }
    }
    verdict->stick = mean_share(stick, filled, frame_shift(detector));
    verdict->slip_minus = mean_share(slip_minus, filled, frame_shift(detector));
    verdict->cycles = passages > 0u ? passages - 1u : 0u;
    verdict->cycle_steps_q15 = last - first;
}

/* Slip against the disc's sense; under a stopped disc the lesser of both senses. */
static uint64_t slip_against(const struct detector *detector, const struct detector_frame *frame, uint64_t whole)
{
    const uint64_t slip_plus = whole - frame->stick - frame->slip_minus;

    if (detector->verdict.disc == 0) {
        return slip_plus < frame->slip_minus ? slip_plus : frame->slip_minus;
    }
    return detector->verdict.disc > 0 ? frame->slip_minus : slip_plus;
}

/* Does the frame hold both: sticking or slip against the disc's sense, and slip with it? */
static bool has_events(const struct detector *detector, const struct detector_frame *frame)
{
    const uint64_t whole = (uint64_t)PLANT_SHARE_ONE << frame_shift(detector);
    const uint64_t least = whole >> SHARE_LEAST_SHIFT;
    const uint64_t share = frame->stick + slip_against(detector, frame, whole);

    return share > least && share < whole - least;
}

static uint32_t motion_floor(int32_t disc, bool has_events)
{
    const uint32_t part = fixed_abs(disc) >> FLOOR_SHIFT;
    const uint32_t least = has_events ? FLOOR_TOUCHING : FLOOR_MIN;

    if (disc == 0) {
        return FLOOR_DISC_STOPPED;
    }
    return part > least ? part : least;
}

/* Half the range of the normal velocity. */
static uint32_t normal_speed(const struct detector_frame *frame)
{
    return (uint32_t)(((int64_t)frame->w_max - frame->w_min) / 2);
}

/* Speed that the normal motion present in y explains: the load's sine by its own response, the rest as free
 * oscillation. */
static uint32_t forced_speed(const struct detector *detector, const struct detector_frame *frame)
{
    const uint32_t normal = normal_speed(frame);
    const uint32_t from_load = (uint32_t)detector->config.load_speed;
    const uint32_t free = normal > from_load ? normal - from_load : 0u;
    const uint64_t speed =
        (((uint64_t)free * detector->config.gain_q16) >> 16) + (uint32_t)detector->config.load_response;

    return speed < INT32_MAX ? (uint32_t)speed : INT32_MAX;
}

struct detector_window detector_rules_window(const struct detector *detector)
{
    const struct detector_verdict *verdict = &detector->verdict;
    const struct detector_frame *newest = &detector->frames[(detector->frame - 1u) % DETECTOR_WINDOW_FRAMES];
    struct detector_window window;

    window.speed = (uint32_t)(((int64_t)verdict->v_max - verdict->v_min) / 2);
    window.forced = forced_speed(detector, newest);
    window.normal = normal_speed(newest);
    window.has_contact = newest->y_max > CONTACT_LEAST;
    window.has_events = window.has_contact && has_events(detector, newest);
    window.floor = motion_floor(verdict->disc, window.has_events);
    return window;
}

static bool is_decaying(const struct detector_verdict *verdict)
{
    return verdict->has_growth && verdict->growth_q16 < -GROWTH_LEAST_Q16 &&
           verdict->growth_q16 < -verdict->growth_error_q16;
}

static bool is_growing(const struct detector_verdict *verdict)
{
    return verdict->has_growth && verdict->growth_q16 > GROWTH_LEAST_Q16 &&
           verdict->growth_q16 > verdict->growth_error_q16;
}

static int64_t speed_range(const struct detector *detector, uint32_t place)
{
    const struct detector_frame *frame = &detector->frames[(detector->frame + place) % DETECTOR_WINDOW_FRAMES];

    return (int64_t)frame->v_max - frame->v_min;
}

/* Are all frames alike in speed, and not slower one after the other? */
static bool is_steady(const struct detector *detector)
{
    int64_t range = speed_range(detector, 0u);
    int64_t most = range;
    int64_t least = range;
    bool is_falling = true;

    for (uint32_t i = 1u; i < DETECTOR_WINDOW_FRAMES; i++) {
        const int64_t next = speed_range(detector, i);

        is_falling = is_falling && next < range;
        most = next > most ? next : most;
        least = next < least ? next : least;
        range = next;
    }
    return most - least <= most >> (is_falling ? FALLING_SHIFT : STEADY_SHIFT);
}

/* Is it known that the motion does not die out? After a jolt nothing is. Where the normal frequency is near a multiple
 * of the motion's own, the free part hardly changes from strobe to strobe and drowns in rounding: then speed tells. */
static bool lasts(const struct detector *detector)
{
    const struct detector_verdict *verdict = &detector->verdict;

    if (verdict->has_growth) {
        return verdict->growth_error_q16 < ERROR_MOST_Q16 && !is_decaying(verdict);
    }
    return verdict->free_log2_q16 < 0 && is_steady(detector);
}

/* More motion than the normal oscillation explains, and it does not die out; that takes a full window to know. */
static bool is_self_excited(const struct detector *detector, const struct detector_window *window)
{
    return detector->frame >= DETECTOR_WINDOW_FRAMES &&
           window->speed > window->forced + window->forced / 2u + 2u * window->floor && lasts(detector);
}

static uint8_t propensity(const struct detector *detector, const struct detector_window *window)
{
    const struct detector_verdict *verdict = &detector->verdict;
    const bool was_squeal = verdict->propensity == PROPENSITY_SQUEAL;
    const uint32_t disc = fixed_abs(verdict->disc);

    if (detector->frame < DETECTOR_WINDOW_FRAMES) {
        return PROPENSITY_UNKNOWN;
    }
    if (detector->evidence >= EVIDENCE_ENTER || (was_squeal && detector->evidence > 0u)) {
        return PROPENSITY_SQUEAL;
    }
    if (detector->evidence > 0u || is_growing(verdict) || (disc > 0u && window->speed > disc - disc / 20u)) {
        return PROPENSITY_WATCH;
    }
    return PROPENSITY_QUIET;
}

void detector_rules_judge(struct detector *detector)
{
    struct detector_window window;

    gather_window(detector);
    fit_growth(detector);
    window = detector_rules_window(detector);
    if (window.speed > window.floor && (window.has_events || is_self_excited(detector, &window))) {
        detector->evidence += EVIDENCE_GAIN;
        detector->evidence = detector->evidence < EVIDENCE_MAX ? detector->evidence : EVIDENCE_MAX;
    } else if (detector->evidence > 0u) {
        detector->evidence--;
    }
    detector->verdict.propensity = propensity(detector, &window);
    detector->verdict.frame++;
    detector_search_start(detector, &window);
}
