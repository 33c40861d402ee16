/* squeal monitor: the plant, live, in a terminal; or a line a second where there is none. */
#ifndef SQUEAL_MONITOR_H
#define SQUEAL_MONITOR_H

#include <stdbool.h>

#include "squeal/device/device.h"

struct monitor_options {
    const char *preset; /* to load and run; NULL: see feed_open() */
    bool is_as_is;      /* change nothing at the start, and no preset's pace */
    bool is_lines;      /* lines even in a terminal */
    bool is_ascii;      /* no character beyond ASCII */
    double seconds;     /* end after these; infinite: never */
};

/* Until the person has enough. DEVICE_OK, or why it ended: device_problem() in words. The terminal is as it was. */
enum device_result monitor_show(struct device *device, const struct monitor_options *options);

#endif
