/* The detector's own rooms: booking (detector.c), rules (detector_rules.c), search for a period (detector_search.c).
 * Not for anybody else. */
#ifndef SIM_DETECTOR_PARTS_H
#define SIM_DETECTOR_PARTS_H

#include "sim/detector.h"

/* What the window says as a whole. */
struct detector_window {
    uint32_t speed;   /* half the range of v, Q4.27 */
    uint32_t floor;   /* speeds below it are no motion worth a verdict */
    uint32_t forced;  /* speed that the normal oscillation explains */
    uint32_t normal;  /* half the range of w, the normal velocity, in the newest frame */
    bool has_contact; /* the pad touches the disc at all */
    bool has_events;  /* sticks or crosses now and then, but not always */
};

/* The newest frame has been closed; index is its place in frames. */
void detector_rules_measure(struct detector *detector);
void detector_rules_judge(struct detector *detector);

struct detector_window detector_rules_window(const struct detector *detector);

/* Starts the search for a period, or names the motion at once where none is needed. */
void detector_search_start(struct detector *detector, const struct detector_window *window);

/* Goes on with it: at most 8 comparisons, 16 with 16 steps a period. */
void detector_search_continue(struct detector *detector);

static inline struct detector_frame *detector_newest_frame(struct detector *detector)
{
    return &detector->frames[(detector->frame - 1u) % DETECTOR_WINDOW_FRAMES];
}

#endif
