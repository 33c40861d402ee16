/* Which period does the motion repeat in, if any? Strobes where the normal oscillation sets the clock, maxima of x
 * where the pad keeps its own. A few comparisons a step. */
#include "base/compiler.h"
#include "base/fixed.h"
#include "sim/detector_parts.h"

enum {
    STROBES_COMPARED = DETECTOR_STROBES - DETECTOR_FRAME_PERIODS, /* older ones may be overwritten meanwhile */
    PEAKS_COMPARED = 20,
    PEAK_PERIOD_MAX = 4,
    PAIRS_PER_STEP = 4, /* two comparisons each */
    PAIRS_PER_LONG_STEP = 8,
    LONG_STEPS = 16,        /* a period: they have the time for more, and a frame has few of them */
    TOLERANCE_SHIFT = 10,   /* of the range: 1e-3 */
    TOLERANCE_LEAST = 1024, /* 8e-6 Vref: below it rounding may go in circles */
    INTERVAL_SHIFT = 8,     /* of the interval between maxima: 4e-3 */
    SPIRAL_LEAST_Q16 = 76,  /* growth of 1e-4 a period */
    AUTONOMOUS_RATIO = 8,   /* the normal oscillation explains less than an eighth: the pad may keep its own time */
    NORMAL_SILENT = 1 << 19 /* normal speed below 1/256: nothing that could set the clock */
};

/* The longest search: every period that is tried agrees up to its last pair. It ends before the next frame does, three
 * steps of which do other work. */
#define PAIRS_OF(compared, periods) ((periods) * (compared) - (periods) * ((periods) + 1) / 2)
#define PAIRS_MAX (PAIRS_OF(STROBES_COMPARED, DETECTOR_PERIOD_MAX) + PAIRS_OF(PEAKS_COMPARED, PEAK_PERIOD_MAX))
#define FRAME_STEPS(steps_per_period) (DETECTOR_FRAME_PERIODS * (steps_per_period)-3)
BASE_STATIC_ASSERT(PAIRS_MAX <= PAIRS_PER_LONG_STEP * FRAME_STEPS(LONG_STEPS), search_ends_in_a_frame_of_long_steps);
BASE_STATIC_ASSERT(PAIRS_MAX <= PAIRS_PER_STEP * FRAME_STEPS(2 * LONG_STEPS), search_ends_in_any_other_frame);

static void finish(struct detector *detector, enum detector_class motion, uint32_t period)
{
    detector->search.stage = STAGE_IDLE;
    detector->verdict.motion = (uint8_t)motion;
    detector->verdict.period = (uint8_t)period;
}

static bool sticks(const struct detector *detector) { return detector->verdict.stick > 0u; }

/* Name of a motion for which no period was found. */
static void finish_without_period(struct detector *detector, const struct detector_window *window)
{
    const struct detector_verdict *verdict = &detector->verdict;

    if (window->has_events || !verdict->has_growth) {
        finish(detector, CLASS_APERIODIC, 0u);
    } else if (verdict->growth_q16 < -verdict->growth_error_q16) {
        finish(detector, CLASS_DECAYING, 0u);
    } else if (verdict->growth_q16 > verdict->growth_error_q16) {
        finish(detector, CLASS_GROWING, 0u);
    } else {
        finish(detector, CLASS_APERIODIC, 0u);
    }
}

static bool is_autonomous(const struct detector_window *window)
{
    return (uint64_t)window->forced * AUTONOMOUS_RATIO < window->speed;
}

static void begin(struct detector *detector, enum detector_stage stage)
{
    detector->search.stage = (uint8_t)stage;
    detector->search.period = 1u;
    detector->search.index = 0u;
    detector->search.head = stage == STAGE_PEAKS ? detector->peaks : detector->strobes;
}

/* Looks for a period in the maxima of x, if there are enough of them. */
static void begin_peaks(struct detector *detector, const struct detector_window *window)
{
    if (detector->peaks > PEAKS_COMPARED) {
        begin(detector, STAGE_PEAKS);
    } else {
        finish_without_period(detector, window);
    }
}

void detector_search_start(struct detector *detector, const struct detector_window *window)
{
    if (detector->frame < DETECTOR_WINDOW_FRAMES) {
        finish(detector, CLASS_UNSETTLED, 0u);
    } else if (window->speed <= window->floor) {
        finish(detector, CLASS_REST, 0u);
    } else if (is_autonomous(window) && window->normal < NORMAL_SILENT) {
        begin_peaks(detector, window);
    } else if (detector->strobes >= STROBES_COMPARED) {
        begin(detector, STAGE_STROBES);
    } else {
        finish(detector, CLASS_UNSETTLED, 0u);
    }
}

/* No period among those tried in this stage. */
static void give_up(struct detector *detector)
{
    const struct detector_window window = detector_rules_window(detector);

    if (detector->search.stage == STAGE_STROBES && is_autonomous(&window)) {
        begin_peaks(detector, &window);
    } else {
        finish_without_period(detector, &window);
    }
}

static int64_t tolerance_of(int32_t high, int32_t low)
{
    const int64_t part = ((int64_t)high - low) >> TOLERANCE_SHIFT;

    return part > TOLERANCE_LEAST ? part : TOLERANCE_LEAST;
}

static bool differs(int32_t a, int32_t b, int64_t tolerance)
{
    const int64_t difference = (int64_t)a - b;

    return difference > tolerance || -difference > tolerance;
}

static bool strobes_differ(const struct detector *detector, uint32_t newer, uint32_t older)
{
    const struct detector_verdict *verdict = &detector->verdict;
    const uint32_t a = newer % DETECTOR_STROBES;
    const uint32_t b = older % DETECTOR_STROBES;

    return differs(detector->strobe_x[a], detector->strobe_x[b], tolerance_of(verdict->x_max, verdict->x_min)) ||
           differs(detector->strobe_v[a], detector->strobe_v[b], tolerance_of(verdict->v_max, verdict->v_min));
}

static bool peaks_differ(const struct detector *detector, uint32_t newer, uint32_t older)
{
    const struct detector_verdict *verdict = &detector->verdict;
    const uint32_t a = newer % DETECTOR_PEAKS;
    const uint32_t b = older % DETECTOR_PEAKS;
    const uint32_t interval_a = detector->peak_time_q8[a] - detector->peak_time_q8[(newer - 1u) % DETECTOR_PEAKS];
    const uint32_t interval_b = detector->peak_time_q8[b] - detector->peak_time_q8[(older - 1u) % DETECTOR_PEAKS];

    return differs(detector->peak_x[a], detector->peak_x[b], 2 * tolerance_of(verdict->x_max, verdict->x_min)) ||
           differs((int32_t)interval_a, (int32_t)interval_b, interval_a >> INTERVAL_SHIFT);
}

/* A slow spiral repeats nearly; its growth gives it away. */
static bool is_spiral(const struct detector_verdict *verdict)
{
    const uint32_t growth = fixed_abs(verdict->growth_q16);

    return verdict->has_growth && growth > SPIRAL_LEAST_Q16 && growth > (uint32_t)verdict->growth_error_q16;
}

/* Names a motion that repeats after period strobes or maxima. */
static void finish_with_period(struct detector *detector, const struct detector_window *window)
{
    const uint32_t period = detector->search.period;

    if (detector->search.stage == STAGE_PEAKS) {
        if (!window->has_events && is_spiral(&detector->verdict)) {
            finish_without_period(detector, window);
            return;
        }
        finish(detector, window->has_events ? CLASS_LIMITCYCLE_STICKSLIP : CLASS_LIMITCYCLE_SLIP, period);
    } else if (!window->has_events) {
        finish(detector, CLASS_FORCED, period);
    } else {
        finish(detector, sticks(detector) ? CLASS_STICKSLIP : CLASS_CROSS, period);
    }
}

void detector_search_continue(struct detector *detector)
{
    struct detector_search *search = &detector->search;
    const bool by_peaks = search->stage == STAGE_PEAKS;
    const uint32_t compared = by_peaks ? PEAKS_COMPARED : STROBES_COMPARED;
    const uint32_t newest = search->head - 1u;
    const uint32_t pairs = detector->config.steps_per_period <= LONG_STEPS ? PAIRS_PER_LONG_STEP : PAIRS_PER_STEP;

    for (uint32_t pair = 0u; pair < pairs; pair++) {
        const uint32_t newer = newest - search->index;
        const uint32_t older = newer - search->period;

        if (by_peaks ? peaks_differ(detector, newer, older) : strobes_differ(detector, newer, older)) {
            search->index = 0u;
            search->period++;
            if (search->period > (by_peaks ? PEAK_PERIOD_MAX : DETECTOR_PERIOD_MAX)) {
                give_up(detector);
                return;
            }
        } else if (++search->index + search->period >= compared) {
            const struct detector_window window = detector_rules_window(detector);

            finish_with_period(detector, &window);
            return;
        }
    }
}
