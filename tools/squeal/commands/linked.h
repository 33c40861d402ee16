/* What the subcommands that talk to a device share. */
#ifndef SQUEAL_LINKED_H
#define SQUEAL_LINKED_H

#include "squeal/device/device.h"
#include "squeal/exits.h"
#include "squeal/subcommands.h"
#include "squeal/support/arguments.h"

/* Opens the device of --port. EXIT_OK, or the exit code after the mistake has been printed. */
int linked_open(const struct arguments *arguments, struct device **device);

/* Prints what went wrong. Returns the exit code. */
int linked_fail(const struct device *device, enum device_result result);

/* The same for a name or value that the device does not have, if it is still there. */
int linked_fail_name(const struct device *device);

/* Reads NAME=VALUE words into values, one for each. EXIT_OK, or the exit code after the mistake has been printed. */
int linked_read_values(struct device *device, char *const *words, size_t count, struct device_value *values);

/* Reads --load, --pressure, --v0 and --vehicle. False: the mistake has been printed. */
bool linked_read_demand(const struct arguments *arguments, struct input_demand *demand);

/* A parameter's or signal's unit with a blank before it; "" of a ratio or a choice. */
const char *linked_unit(const struct device_row *row);

/* A float as the device's console prints it, nan where it makes no sense. Returns out. */
const char *linked_number(float value, char out[DEVICE_TEXT_MAX]);

/* A signal as a person reads it: a name for a mode and its like. */
void linked_format_signal(const struct device_row *row, double value, char out[DEVICE_TEXT_MAX]);

#endif
