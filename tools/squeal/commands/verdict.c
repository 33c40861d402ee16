/* verdict: what the device says of the motion now. */
#include "squeal/commands/linked.h"

#include "sim/detector.h"

#include <math.h>
#include <stdio.h>

static void tell_verdict(const struct device_verdict *verdict)
{
    static const char *const bands[] = {"none", "groan", "squeal"};
    const struct {
        const char *name, *unit;
        float value;
    } values[] = {
        {"amplitude", "um", verdict->amplitude_um},
        {"velocity", "mm/s", verdict->velocity_mm_s},
        {"velocity, rms", "mm/s", verdict->velocity_mm_s_rms},
        {"level", "dB re 1 nm/s", verdict->level_db},
        {"acceleration", "g", verdict->acceleration_g},
        {"frequency", "Hz", verdict->frequency_hz},
        {"level estimate", "dB(A)", verdict->level_dba_estimate},
        {"growth", "1/s", verdict->growth_per_s},
        {"growth error", "1/s", verdict->growth_error_per_s},
        {"stick", "of the time", verdict->stick},
        {"slip-", "of the time", verdict->slip_minus},
        {"predicted growth", "1/s", verdict->predicted_growth_per_s},
        {"predicted touch", "", verdict->predicted_touch_ratio},
        {"onset touch", "", verdict->onset_touch_ratio},
        {"t_v10", "s", verdict->t_v10_s},
        {"sigma", "s/s", verdict->sigma},
    };
    char text[DEVICE_TEXT_MAX];

    printf("%-17s %s\n%-17s %s\n%-17s %u\n%-17s %s\n%-17s %s\n", "propensity",
           detector_propensity_name(verdict->propensity), "class", detector_class_name(verdict->motion), "period",
           verdict->period, "predicted", detector_propensity_name(verdict->predicted), "band",
           verdict->band < 3 ? bands[verdict->band] : "?");
    printf("%-17s %s\n%-17s %s\n", "audible", verdict->is_audible ? "yes" : "no", "bistable",
           verdict->is_bistable ? "yes" : "no");
    for (size_t i = 0; i < sizeof values / sizeof values[0]; i++) {
        const bool has_unit = values[i].unit[0] != '\0' && isfinite(values[i].value);
        printf("%-17s %s%s%s\n", values[i].name, linked_number(values[i].value, text), has_unit ? " " : "",
               has_unit ? values[i].unit : "");
    }
}

int command_verdict(const struct arguments *arguments)
{
    struct device *device = NULL;
    struct device_verdict verdict;

    if (!arguments_has_operands(arguments, 0, 0)) {
        return EXIT_USAGE;
    }
    int code = linked_open(arguments, &device);
    if (code == EXIT_OK) {
        const enum device_result result = device_verdict(device, &verdict);
        if (result == DEVICE_OK) {
            tell_verdict(&verdict);
        } else {
            code = linked_fail(device, result);
        }
    }
    device_close(device);
    return code;
}
