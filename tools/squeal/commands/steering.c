/* What moves the plant, and what tells how it stands: step, run, stop, reset, status, id. */
#include "squeal/commands/linked.h"

#include "protocol/signals.h"
#include "sim/detector.h"
#include "sim/watch.h"

#include <stdio.h>

static void tell_state(const struct master_state *state)
{
    printf("step         %llu\n"
           "x            %.9g m\n"
           "xd           %.9g m/s\n"
           "y            %.9g m\n"
           "yd           %.9g m/s\n"
           "N            %.9g N\n"
           "F            %.9g N\n"
           "v0           %.9g m/s\n"
           "mode         %s\n"
           "propensity   %s\n"
           "hash         %08x\n",
           (unsigned long long)state->step, (double)state->x_m, (double)state->xd_m_per_s, (double)state->y_m,
           (double)state->yd_m_per_s, (double)state->load_n, (double)state->friction_n, (double)state->disc_m_per_s,
           signals_mode_name(state->mode), detector_propensity_name(state->propensity), state->hash);
    if ((state->flags & LINK_WAS_CLAMPED) != 0) {
        printf("an input was held at a limit\n");
    }
    if ((state->flags & (LINK_IS_STALE | LINK_IS_SAFE)) != 0) {
        printf("%s\n", (state->flags & LINK_IS_SAFE) != 0 ? "in the safe state: step --start leaves it"
                                                          : "the last input is stale");
    }
}

static int step_all(struct device *device, uint64_t count, const struct input_demand *demand)
{
    struct master_state state;
    const enum device_result result = device_step(device, count, demand, &state);

    if (result != DEVICE_OK) {
        return linked_fail(device, result);
    }
    tell_state(&state);
    if ((state.flags & (LINK_IS_FAULT | LINK_WAS_CUT)) != 0) {
        (void)fflush(stdout);
        fprintf(stderr, "squeal: %s at step %llu\n",
                (state.flags & LINK_IS_FAULT) != 0 ? "the plant left its domain and is frozen: reset"
                                                   : "stopped on the console",
                (unsigned long long)state.step);
        return EXIT_FAILED;
    }
    return EXIT_OK;
}

int command_step(const struct arguments *arguments)
{
    struct input_demand demand = {.step = INPUT_NOW};
    struct device *device = NULL;
    uint64_t count;

    if (!arguments_has_operands(arguments, 1, 1) ||
        !arguments_parse_whole("STEPS", arguments->operands[0], 1, UINT64_C(1000000000000), &count) ||
        !linked_read_demand(arguments, &demand)) {
        return EXIT_USAGE;
    }
    demand.starts = arguments_flag(arguments, "--start");
    int code = linked_open(arguments, &device);
    if (code == EXIT_OK) {
        code = step_all(device, count, &demand);
    }
    device_close(device);
    return code;
}

static int steer(const struct arguments *arguments, enum device_result (*ask)(struct device *, uint64_t *),
                 const char *words)
{
    struct device *device = NULL;
    uint64_t step = 0;

    if (!arguments_has_operands(arguments, 0, 0)) {
        return EXIT_USAGE;
    }
    int code = linked_open(arguments, &device);
    if (code == EXIT_OK) {
        const enum device_result result = ask(device, &step);
        if (result == DEVICE_OK) {
            printf("%s step %llu\n", words, (unsigned long long)step);
        } else {
            code = linked_fail(device, result);
        }
    }
    device_close(device);
    return code;
}

int command_run(const struct arguments *arguments) { return steer(arguments, device_run, "runs from"); }
int command_stop(const struct arguments *arguments) { return steer(arguments, device_stop, "stands at"); }
int command_reset(const struct arguments *arguments) { return steer(arguments, device_reset, "back at"); }

static void tell_status(const struct device_status *status)
{
    static const char *const states[] = {"ready", "run", "fault"};
    const struct {
        const char *name;
        uint32_t count;
    } counters[] = {
        {"generation", status->generation},
        {"events", status->events},
        {"caps", status->caps},
        {"saturations", status->saturations},
        {"lifted", status->lifted},
        {"gap_held", status->gap_held},
        {"ticks", status->ticks},
        {"overruns", status->overruns},
        {"shed", status->shed},
        {"inputs", status->inputs},
        {"inputs_late", status->inputs_late},
        {"inputs_clamped", status->inputs_clamped},
        {"inputs_refused", status->inputs_refused},
        {"offered", status->offered},
        {"sent", status->sent},
        {"dropped", status->dropped},
        {"waiting", status->waiting},
        {"frames", status->frames},
        {"damaged", status->damaged},
        {"too_long", status->too_long},
        {"bad_cobs", status->bad_cobs},
        {"too_short", status->too_short},
        {"bad_crc", status->bad_crc},
        {"garbage_bytes", status->garbage_bytes},
        {"refused", status->refused},
        {"times_stale", status->times_stale},
        {"times_safe", status->times_safe},
    };

    printf("%-15s %s\n", "state", status->state < 3 ? states[status->state] : "?");
    printf("%-15s %s\n", "input_state", watch_state_name(status->input_state));
    printf("%-15s %llu\n", "step", (unsigned long long)status->step);
    printf("%-15s %.9g s\n", "t", (double)status->step * (double)status->step_s);
    printf("%-15s %08x\n%-15s %08x\n", "hash", status->hash, "set_crc", status->set_crc);
    printf("%-15s %.9g s\n%-15s %.9g\n", "step_s", (double)status->step_s, "sigma", (double)status->sigma);
    for (size_t i = 0; i < sizeof counters / sizeof counters[0]; i++) {
        printf("%-15s %u\n", counters[i].name, counters[i].count);
    }
}

int command_status(const struct arguments *arguments)
{
    struct device *device = NULL;
    struct device_status status;

    if (!arguments_has_operands(arguments, 0, 0)) {
        return EXIT_USAGE;
    }
    int code = linked_open(arguments, &device);
    if (code == EXIT_OK) {
        const enum device_result result = device_status(device, &status);
        if (result == DEVICE_OK) {
            tell_status(&status);
        } else {
            code = linked_fail(device, result);
        }
    }
    device_close(device);
    return code;
}

int command_id(const struct arguments *arguments)
{
    struct device *device = NULL;

    if (!arguments_has_operands(arguments, 0, 0)) {
        return EXIT_USAGE;
    }
    const int code = linked_open(arguments, &device);
    if (code == EXIT_OK) {
        const struct device_identity *identity = device_identity(device);
        printf("version      %s\nbuild        %s\nboard        %s\ncore         %s, %s FPU%s\nlink         %u.%u\n"
               "tables       parameters %u, signals %u, commands %u\n",
               identity->version, identity->build, identity->board, identity->core,
               identity->has_fpu ? "with" : "without", identity->is_emulated ? ", emulated" : "", identity->major,
               identity->minor, identity->params_version, identity->signals_version, identity->commands_version);
    }
    device_close(device);
    return code;
}
