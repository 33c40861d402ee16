/* What shows the plant while it moves: monitor. */
#include "squeal/commands/linked.h"
#include "squeal/monitor/monitor.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#define SECONDS_MAX 1e9

int command_monitor(const struct arguments *arguments)
{
    struct monitor_options options = {.preset = arguments_text(arguments, "--preset"),
                                      .is_as_is = arguments_flag(arguments, "--as-is"),
                                      .is_lines = arguments_flag(arguments, "--lines"),
                                      .is_ascii = arguments_flag(arguments, "--ascii"),
                                      .seconds = (double)INFINITY};
    struct device *device;

    if (!arguments_has_operands(arguments, 0, 0) ||
        !arguments_real(arguments, "--seconds", 0.0, SECONDS_MAX, &options.seconds)) {
        return EXIT_USAGE;
    }
    /* A firmware that is a process of this machine is to be looked at in its own time, not as fast as it can. */
    (void)setenv("SQUEAL_REALTIME", "1", 0);
    const int code = linked_open(arguments, &device);
    if (code != EXIT_OK) {
        return code;
    }
    const enum device_result result = monitor_show(device, &options);
    const int end = result == DEVICE_OK ? EXIT_OK : linked_fail(device, result);
    device_close(device);
    return end;
}
