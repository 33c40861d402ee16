/* What the subcommands that talk to a device share. */
#include "squeal/commands/linked.h"

#include "base/decimal.h"
#include "protocol/signals.h"
#include "sim/detector.h"
#include "sim/watch.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define LIMIT_MAX_S 86400.0

int linked_open(const struct arguments *arguments, struct device **device)
{
    const char *port = arguments_text(arguments, "--port");
    char problem[DEVICE_PROBLEM_MAX];
    double limit_s = 5.0;

    port = port != NULL ? port : getenv("SQUEAL_PORT");
    if (port == NULL || port[0] == '\0') {
        fprintf(stderr, "squeal: --port is missing: host, qemu:BOARD, /dev/ttyUSB0 ...; squeal %s --help tells more\n",
                arguments->subcommand->name);
        return EXIT_USAGE;
    }
    if (!arguments_real(arguments, "--limit", 0.1, LIMIT_MAX_S, &limit_s)) {
        return EXIT_USAGE;
    }
    *device = device_open(port, limit_s, problem);
    if (*device == NULL) {
        fprintf(stderr, "squeal: %s\n", problem);
        return EXIT_PORT;
    }
    return EXIT_OK;
}

int linked_fail(const struct device *device, enum device_result result)
{
    (void)fflush(stdout);
    fprintf(stderr, "squeal: %s\n", device_problem(device));
    return result == DEVICE_REFUSED ? EXIT_REFUSED : EXIT_PORT;
}

int linked_fail_name(const struct device *device)
{
    return linked_fail(device, device_is_lost(device) ? DEVICE_LOST : DEVICE_REFUSED);
}

int linked_read_values(struct device *device, char *const *words, size_t count, struct device_value *values)
{
    for (size_t i = 0; i < count; i++) {
        char symbol[DEVICE_TEXT(LINK_SYMBOL_WIDTH)], shown[DEVICE_TEXT(LINK_SYMBOL_WIDTH)];
        const size_t length = strcspn(words[i], "=");
        if (words[i][length] != '=') {
            fprintf(stderr, "squeal: '%s': NAME=VALUE is wanted\n", printable_copy(shown, sizeof shown, words[i]));
            return EXIT_USAGE;
        }
        (void)snprintf(symbol, sizeof symbol, "%.*s", (int)length, words[i]);
        values[i].index = device_find(device, DEVICE_PARAMS, symbol);
        if (values[i].index < 0 ||
            !device_parse(device, (size_t)values[i].index, words[i] + length + 1, &values[i].value)) {
            return linked_fail_name(device);
        }
    }
    return EXIT_OK;
}

/* One of two options that exclude each other, in the demand's terms. Which of the kinds it was, 0 none, -1 a
 * mistake. */
static int read_held(const struct arguments *arguments, const char *first, const char *second, float *value)
{
    const char *const names[] = {first, second};
    int kind = 0;

    for (int i = 0; i < 2; i++) {
        const char *text = arguments_text(arguments, names[i]);
        if (text == NULL) {
            continue;
        }
        if (kind != 0) {
            fprintf(stderr, "squeal: %s or %s, not both\n", first, second);
            return -1;
        }
        if (i == 0 && strcmp(text, "profile") == 0) {
            kind = INPUT_LOAD_PROFILE;
        } else if (decimal_parse_f32(text, strlen(text), value)) {
            kind = INPUT_LOAD_FORCE + i;
        } else {
            fprintf(stderr, "squeal: %s: a number%s is wanted\n", names[i], i == 0 ? ", or profile," : "");
            return -1;
        }
    }
    return kind;
}

bool linked_read_demand(const struct arguments *arguments, struct input_demand *demand)
{
    /* Kinds of load and speed have the same order: keep, profile, one way to say it, the other. */
    const int load = read_held(arguments, "--load", "--pressure", &demand->load_value);
    const int speed = load < 0 ? -1 : read_held(arguments, "--v0", "--vehicle", &demand->speed_value);

    demand->load = (enum input_load)load;
    demand->speed = (enum input_speed)speed;
    return load >= 0 && speed >= 0;
}

const char *linked_unit(const struct device_row *row)
{
    static char out[sizeof row->unit + 1];

    if (row->kind == LINK_CHOICE || row->unit[0] == '\0' || strcmp(row->unit, "1") == 0) {
        return "";
    }
    (void)snprintf(out, sizeof out, " %s", row->unit);
    return out;
}

const char *linked_number(float value, char out[DEVICE_TEXT_MAX])
{
    if (isfinite(value)) {
        (void)decimal_format_f32(value, DECIMAL_DIGITS_EXACT, out);
    } else {
        (void)strcpy(out, "nan");
    }
    return out;
}

void linked_format_signal(const struct device_row *row, double value, char out[DEVICE_TEXT_MAX])
{
    const enum signal signal = signals_find(row->symbol, strlen(row->symbol));
    const enum signal_form form = signal < SIGNAL_COUNT ? signals_table[signal].form : SIGNAL_FORM_REAL;
    const bool is_name = form == SIGNAL_FORM_PROPENSITY && value >= PROPENSITY_UNKNOWN && value <= PROPENSITY_SQUEAL;

    if (row->kind == LINK_BITS) {
        (void)decimal_format_hex32((uint32_t)value, out);
    } else if (form == SIGNAL_FORM_MODE && value >= -1.0 && value <= SIGNAL_MODE_FAULT) {
        (void)snprintf(out, DEVICE_TEXT_MAX, "%s", signals_mode_name((int)value));
    } else if (form == SIGNAL_FORM_WATCH && value >= WATCH_OFF && value <= WATCH_SAFE) {
        (void)snprintf(out, DEVICE_TEXT_MAX, "%s", watch_state_name((uint8_t)value));
    } else if (is_name) {
        (void)snprintf(out, DEVICE_TEXT_MAX, "%s", detector_propensity_name((uint8_t)value));
    } else {
        (void)decimal_format_f32((float)value, DECIMAL_DIGITS_EXACT, out);
    }
}
