/* What is looked at, and how often. */
#include "squeal/monitor/feed.h"

#include "squeal/monitor/feed_parts.h"
#include "squeal/port/port.h"
#include "squeal/support/clock.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double PACE_S = 1.0;    /* over which the pace is measured */
static const double MESSAGE_S = 6.0; /* that a message stays */

enum {
    SAMPLES_PER_PERIOD = 16,
    JUDGED = 2000, /* samples, before it is asked whether the link carries them */
    MANY = 20      /* of a hundred samples lost are too many */
};

static const char *const streamed[] = {"x", "xd", "propensity"};

void feed_say(struct feed *feed, bool is_refusal, const char *format, ...)
{
    va_list arguments;

    va_start(arguments, format);
    (void)vsnprintf(feed->picture->message, sizeof feed->picture->message, format, arguments);
    va_end(arguments);
    feed->picture->is_refusal = is_refusal;
    feed->message_s = clock_now_s();
}

enum device_result feed_settle(struct feed *feed, enum device_result result)
{
    if (result == DEVICE_REFUSED) {
        const char *problem = device_problem(feed->device);
        const size_t length = strlen(feed->picture->port);

        /* The port is known. */
        if (strncmp(problem, feed->picture->port, length) == 0 && strncmp(problem + length, ": ", 2) == 0) {
            problem += length + 2;
        }
        feed_say(feed, true, "%s", problem);
        return DEVICE_OK;
    }
    return result;
}

static void take_sample(void *context, const struct device_sample *sample)
{
    struct feed *feed = context;

    if (sample->count == sizeof streamed / sizeof streamed[0]) {
        const double propensity = sample->value[2];

        feed->picture->propensity = propensity >= 0.0 && propensity < 256.0 ? (uint8_t)propensity : 0u;
        feed->picture->step = sample->step;
        trace_add(&feed->picture->trace, sample->step, sample->value[0], sample->value[1], feed->picture->propensity,
                  sample->missing);
    }
}

enum device_result feed_stream(struct feed *feed)
{
    struct trace *trace = &feed->picture->trace;
    int signals[sizeof streamed / sizeof streamed[0]];
    struct device_stream stream;
    uint32_t every = feed->every_wanted;
    enum device_result result;

    for (size_t i = 0u; i < sizeof streamed / sizeof streamed[0]; i++) {
        signals[i] = device_find(feed->device, DEVICE_SIGNALS, streamed[i]);
        if (signals[i] < 0) {
            return DEVICE_REFUSED;
        }
    }
    if (every == 0u) {
        every = trace->steps_per_period > SAMPLES_PER_PERIOD ? trace->steps_per_period / SAMPLES_PER_PERIOD : 1u;
    }
    result = device_stream(feed->device, signals, sizeof signals / sizeof signals[0], every, &stream);
    if (result == DEVICE_OK && stream.smallest > every && feed->every_wanted == 0u) {
        every = stream.smallest;
        result = device_stream(feed->device, signals, sizeof signals / sizeof signals[0], every, &stream);
    }
    trace_break(trace, every);
    feed->offered = feed->dropped = 0u;
    return result;
}

/* Too many are lost: fewer are asked for. */
static enum device_result thin_out(struct feed *feed, const struct device_status *status)
{
    const uint32_t offered = status->offered - feed->offered;
    const uint32_t dropped = status->dropped - feed->dropped;

    if (offered < JUDGED) {
        return DEVICE_OK;
    }
    feed->offered = status->offered;
    feed->dropped = status->dropped;
    if (dropped <= offered / 100u * MANY) {
        return DEVICE_OK;
    }
    feed->every_wanted = 2u * feed->picture->trace.every;
    feed_say(feed, false, "the link carries no more: samples every %u steps", feed->every_wanted);
    return feed_settle(feed, feed_stream(feed));
}

static void measure_pace(struct feed *feed, const struct device_status *status)
{
    const double now_s = clock_now_s();
    struct picture *picture = feed->picture;

    if (status->state != 1u || status->step < feed->pace_step || now_s - feed->pace_s > 4.0 * PACE_S) {
        picture->pace = (double)NAN;
    } else if (now_s - feed->pace_s < PACE_S) {
        return;
    } else {
        const double pace = (double)(status->step - feed->pace_step) * (double)status->step_s / (now_s - feed->pace_s);

        picture->pace = isfinite(picture->pace) ? picture->pace + 0.3 * (pace - picture->pace) : pace;
    }
    feed->pace_s = now_s;
    feed->pace_step = status->step;
}

static enum device_result look_at_status(struct feed *feed)
{
    struct picture *picture = feed->picture;
    struct device_status status;
    enum device_result result = device_status(feed->device, &status);

    if (result != DEVICE_OK) {
        return result;
    }
    picture->state = status.state;
    picture->step = status.step;
    picture->sigma = (double)status.sigma;
    picture->counters =
        (struct picture_counters){status.offered, status.sent,        status.dropped, status.overruns, status.shed,
                                  status.caps,    status.saturations, status.refused, status.bad_crc,  status.damaged};
    measure_pace(feed, &status);
    if (status.set_crc != feed->set_crc) {
        result = feed_read_set(feed, &status);
    }
    return result == DEVICE_OK ? thin_out(feed, &status) : result;
}

static enum device_result look_at_signal(struct feed *feed, const char *symbol, double *value)
{
    const int signal = device_find(feed->device, DEVICE_SIGNALS, symbol);

    return signal < 0 ? DEVICE_OK : device_look(feed->device, signal, value);
}

/* Without samples it comes this way. */
static enum device_result look_at_propensity(struct feed *feed)
{
    double propensity = (double)feed->picture->propensity;
    const enum device_result result = look_at_signal(feed, "propensity", &propensity);

    feed->picture->propensity = propensity >= 0.0 && propensity < 256.0 ? (uint8_t)propensity : 0u;
    return result;
}

enum device_result feed_look(struct feed *feed)
{
    struct picture *picture = feed->picture;

    if (clock_now_s() - feed->message_s > MESSAGE_S) {
        picture->message[0] = '\0';
    }
    switch (feed->question++ % 4u) {
    case 0u:
        return look_at_status(feed);
    case 1u:
        return look_at_signal(feed, "N", &picture->input[0].held);
    case 2u:
        return look_at_signal(feed, "v0", &picture->input[1].held);
    default:
        return feed->lacks_verdict ? look_at_propensity(feed) : feed_look_at_verdict(feed);
    }
}

static void name_board(struct feed *feed)
{
    const struct device_identity *identity = device_identity(feed->device);

    (void)snprintf(feed->picture->board, sizeof feed->picture->board, "%.60s, %.40s%s", identity->board, identity->core,
                   identity->is_emulated ? ", emulated" : "");
}

enum device_result feed_open(struct feed *feed, struct device *device, struct picture *picture, const char *preset,
                             bool is_as_is)
{
    const char *const wanted = preset != NULL ? preset : "brake";
    struct device_status status;
    enum device_result result;

    *feed = (struct feed){.device = device, .picture = picture, .is_as_is = is_as_is};
    name_board(feed);
    (void)snprintf(picture->port, sizeof picture->port, "%s", device_port(device)->name);
    result = device_read_table(device, DEVICE_TABLES);
    result = result == DEVICE_OK ? feed_list_presets(feed) : result;
    result = result == DEVICE_OK ? device_status(device, &status) : result;
    if (result != DEVICE_OK) {
        return result;
    }
    device_on_sample(device, take_sample, feed);
    if (preset != NULL || (!is_as_is && status.state == 0u && status.step == 0u)) {
        const int index = device_find(device, DEVICE_PRESETS, wanted);

        if (index >= 0) {
            return feed_preset(feed, (size_t)index);
        }
        if (preset != NULL) {
            return DEVICE_REFUSED;
        }
    }
    result = feed_read_set(feed, &status);
    return result == DEVICE_OK ? feed_settle(feed, feed_stream(feed)) : result;
}

void feed_close(struct feed *feed)
{
    /* The device may live on: it need not send to nobody. */
    if (feed->device != NULL) {
        (void)device_stream(feed->device, NULL, 0u, 0u, NULL);
        device_on_sample(feed->device, NULL, NULL);
    }
    free(feed->choices);
}
