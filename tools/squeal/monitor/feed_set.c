/* The set in force, and what a hand does to it. */
#include "squeal/monitor/feed_parts.h"

#include "squeal/support/clock.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double CLICK_SHARE = 0.05;    /* of the value that a click changes */
static const double REFERENCE_SHARE = 0.2; /* a small value is changed as if it were this much of the preset's */
static const double SUBSTEPS_MAX = 64.0;

enum { NAME_SIZE = DEVICE_TEXT_MAX };

enum device_result feed_list_presets(struct feed *feed)
{
    const size_t count = device_count(feed->device, DEVICE_PRESETS);

    feed->choices = calloc(count > 0u ? count : 1u, sizeof *feed->choices);
    for (size_t i = 0u; feed->choices != NULL && i < count; i++) {
        const struct device_row *row = device_row(feed->device, DEVICE_PRESETS, i);

        feed->choices[i] = (struct picture_choice){row->symbol, row->help};
    }
    feed->picture->choices = feed->choices;
    feed->picture->choice_count = feed->choices != NULL ? count : 0u;
    return DEVICE_OK;
}

/* A parameter that the device may lack; then the value stays. */
static enum device_result get(struct feed *feed, const char *symbol, double *value)
{
    const int index = device_find(feed->device, DEVICE_PARAMS, symbol);
    float found = 0.0f;
    enum device_result result;

    if (index < 0) {
        return DEVICE_OK;
    }
    result = device_get(feed->device, index, &found);
    if (result == DEVICE_OK) {
        *value = (double)found;
    }
    return result;
}

/* A choice by its name. */
static enum device_result get_name(struct feed *feed, const char *symbol, char name[NAME_SIZE])
{
    const int index = device_find(feed->device, DEVICE_PARAMS, symbol);
    float found = 0.0f;
    enum device_result result;

    name[0] = '\0';
    if (index < 0) {
        return DEVICE_OK;
    }
    result = device_get(feed->device, index, &found);
    if (result == DEVICE_OK) {
        device_format(device_row(feed->device, DEVICE_PARAMS, (size_t)index), found, name);
    }
    return result;
}

/* Which parameter is behind an input, and its value. */
static enum device_result read_input(struct feed *feed, size_t i, const char *name, const char *symbol)
{
    struct picture_input *input = &feed->picture->input[i];

    feed->params[i] = device_find(feed->device, DEVICE_PARAMS, symbol);
    (void)snprintf(input->name, sizeof input->name, "%s", name);
    (void)snprintf(input->symbol, sizeof input->symbol, "%s", symbol);
    if (feed->params[i] >= 0) {
        (void)snprintf(input->unit, sizeof input->unit, "%.15s",
                       device_row(feed->device, DEVICE_PARAMS, (size_t)feed->params[i])->unit);
    }
    return get(feed, symbol, &input->set);
}

/* Of a profile that ends elsewhere than it begins, the end is what lasts. */
static bool has_end(const char *profile) { return strcmp(profile, "step") == 0 || strcmp(profile, "ramp") == 0; }

enum device_result feed_read_set(struct feed *feed, const struct device_status *status)
{
    struct trace *trace = &feed->picture->trace;
    char load[NAME_SIZE];
    char speed[NAME_SIZE];
    char spp[NAME_SIZE];
    enum device_result result = get_name(feed, "load", load);

    result = result == DEVICE_OK ? get_name(feed, "speed", speed) : result;
    result = result == DEVICE_OK ? get_name(feed, "spp", spp) : result;
    result = result == DEVICE_OK ? read_input(feed, 0u, "N", has_end(load) ? "N1" : "N0") : result;
    result = result == DEVICE_OK ? read_input(feed, 1u, "v0", has_end(speed) ? "v1" : "v0") : result;
    result = result == DEVICE_OK ? read_input(feed, 2u, "alpha", "alpha") : result;
    result = result == DEVICE_OK ? get(feed, "tick", &feed->tick_hz) : result;
    result = result == DEVICE_OK ? get(feed, "substeps", &feed->substeps) : result;
    if (result != DEVICE_OK) {
        return result;
    }
    feed->picture->steps_per_s = feed->tick_hz * feed->substeps;
    feed->set_crc = status->set_crc;
    if ((double)status->step_s != trace->step_s) {
        const unsigned long steps = strtoul(spp, NULL, 10);

        trace_clear(trace, (double)status->step_s, steps > 0u ? (uint32_t)steps : 64u, trace->every);
        picture_forget(feed->picture);
    }
    return DEVICE_OK;
}

static enum device_result read_status_and_set(struct feed *feed)
{
    struct device_status status;
    const enum device_result result = device_status(feed->device, &status);

    return result == DEVICE_OK ? feed_read_set(feed, &status) : result;
}

static void forget(struct feed *feed)
{
    struct trace *trace = &feed->picture->trace;

    trace_clear(trace, trace->step_s, trace->steps_per_period, trace->every);
    picture_forget(feed->picture);
    feed->pace_step = 0u;
    feed->picture->pace = (double)NAN;
    feed->question = 0u;
}

static enum device_result set_pace(struct feed *feed, double tick_hz, double substeps)
{
    const struct device_value values[] = {{device_find(feed->device, DEVICE_PARAMS, "tick"), (float)tick_hz},
                                          {device_find(feed->device, DEVICE_PARAMS, "substeps"), (float)substeps}};
    enum device_result result;

    if (values[0].index < 0 || values[1].index < 0) {
        return DEVICE_OK;
    }
    result = device_set(feed->device, values, 2u, NULL, true, NULL);
    feed->pace_s = 0.0; /* measured anew */
    return result == DEVICE_OK ? read_status_and_set(feed) : result;
}

enum device_result feed_preset(struct feed *feed, size_t preset)
{
    enum device_result result = device_preset(feed->device, (int)preset, NULL);

    if (result != DEVICE_OK) {
        return feed_settle(feed, result);
    }
    forget(feed);
    (void)snprintf(feed->picture->preset, sizeof feed->picture->preset, "%.60s", feed->choices[preset].name);
    feed->picture->choice = preset;
    feed->every_wanted = 0u;
    result = read_status_and_set(feed);
    for (size_t i = 0u; i < PICTURE_INPUTS; i++) {
        feed->reference[i] = feed->picture->input[i].set;
    }
    if (result == DEVICE_OK && !feed->is_as_is && feed->tick_hz > 0.0) {
        const double substeps = floor(FEED_STEPS_PER_S / feed->tick_hz);

        result = feed_settle(feed, set_pace(feed, feed->tick_hz, fmin(fmax(substeps, 1.0), SUBSTEPS_MAX)));
    }
    result = result == DEVICE_OK ? feed_settle(feed, feed_stream(feed)) : result;
    return result == DEVICE_OK ? feed_settle(feed, device_run(feed->device, NULL)) : result;
}

enum device_result feed_run_or_stop(struct feed *feed)
{
    feed->question = 0u;
    return feed_settle(feed,
                       feed->picture->state == 1u ? device_stop(feed->device, NULL) : device_run(feed->device, NULL));
}

enum device_result feed_reset(struct feed *feed)
{
    const bool was_running = feed->picture->state == 1u;
    enum device_result result = device_reset(feed->device, NULL);

    if (result == DEVICE_OK) {
        forget(feed);
        result = was_running ? device_run(feed->device, NULL) : DEVICE_OK;
    }
    return feed_settle(feed, result);
}

enum device_result feed_turn(struct feed *feed, size_t input, int clicks)
{
    struct picture_input *shown = &feed->picture->input[input];
    const double size = fmax(fabs(shown->set), REFERENCE_SHARE * fabs(feed->reference[input]));
    const double click = size > 0.0 ? axis_round_down(CLICK_SHARE * size) : CLICK_SHARE;
    const struct device_value value = {feed->params[input], (float)(click * (round(shown->set / click) + clicks))};
    enum device_result result;

    if (value.index < 0 || !isfinite(shown->set)) {
        return DEVICE_OK;
    }
    result = device_set(feed->device, &value, 1u, NULL, false, NULL);
    if (result == DEVICE_OK) {
        feed_say(feed, false, "%s = %g %s", shown->symbol, (double)value.value, shown->unit);
        return read_status_and_set(feed);
    }
    if (result == DEVICE_REFUSED && device_refusal(feed->device)->low < device_refusal(feed->device)->high) {
        const struct master_refusal *refusal = device_refusal(feed->device);

        feed_say(feed, true, "%s = %g %s is refused: %g .. %g would do (%s)", shown->symbol, (double)value.value,
                 shown->unit, (double)refusal->low, (double)refusal->high, error_name((enum error)refusal->error));
        return DEVICE_OK;
    }
    return feed_settle(feed, result);
}

enum device_result feed_pace(struct feed *feed, bool is_faster)
{
    const double tick_hz = !is_faster && feed->substeps <= 1.0           ? floor(0.5 * feed->tick_hz)
                           : is_faster && feed->substeps >= SUBSTEPS_MAX ? 2.0 * feed->tick_hz
                                                                         : feed->tick_hz;
    const double substeps = tick_hz != feed->tick_hz ? feed->substeps : (is_faster ? 2.0 : 0.5) * feed->substeps;
    enum device_result result = set_pace(feed, tick_hz, fmin(fmax(round(substeps), 1.0), SUBSTEPS_MAX));

    if (result == DEVICE_OK) {
        feed_say(feed, false, "%g steps a tick, %g ticks a second", feed->substeps, feed->tick_hz);
        feed->every_wanted = 0u;
        result = feed_stream(feed);
    }
    return feed_settle(feed, result);
}

enum device_result feed_thin(struct feed *feed, bool is_thinner)
{
    const uint32_t every = feed->picture->trace.every;

    feed->every_wanted = is_thinner ? 2u * every : every > 1u ? every / 2u : 1u;
    feed_say(feed, false, "samples every %u steps", feed->every_wanted);
    return feed_settle(feed, feed_stream(feed));
}
