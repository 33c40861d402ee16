/* What the device finds out by itself: its verdict, its self-tests, and studies. */
#include "squeal/device/device_parts.h"

#include "squeal/support/clock.h"

enum { SCAN_SIZE = 29, MARGIN_SIZE = 10, END_TALLIES = 12 };

/* A study may be silent for long; so often the device is asked whether it is still there. */
#define LOOK_AGAIN_S 2.0
#define LISTEN_S 0.01

static void get_floats(struct bytes_reader *reader, float *const values[], size_t count)
{
    for (size_t i = 0; i < count; i++) {
        *values[i] = bytes_get_f32(reader);
    }
}

#define GET_FLOATS(reader, ...) \
    get_floats(reader, (float *const[]){__VA_ARGS__}, sizeof((float *const[]){__VA_ARGS__}) / sizeof(float *))

enum device_result device_verdict(struct device *device, struct device_verdict *verdict)
{
    struct bytes_reader reply;
    const enum device_result result = device_ask(device, LINK_VERDICT, NULL, &reply);

    if (result != DEVICE_OK) {
        return result;
    }
    verdict->propensity = bytes_get_u8(&reply);
    verdict->motion = bytes_get_u8(&reply);
    verdict->period = bytes_get_u8(&reply);
    verdict->band = bytes_get_u8(&reply);
    verdict->predicted = bytes_get_u8(&reply);
    const uint8_t flags = bytes_get_u8(&reply);
    verdict->is_audible = (flags & LINK_IS_AUDIBLE) != 0;
    verdict->is_bistable = (flags & LINK_IS_BISTABLE) != 0;
    GET_FLOATS(&reply, &verdict->amplitude_um, &verdict->velocity_mm_s, &verdict->velocity_mm_s_rms, &verdict->level_db,
               &verdict->acceleration_g, &verdict->frequency_hz, &verdict->level_dba_estimate, &verdict->growth_per_s,
               &verdict->growth_error_per_s, &verdict->stick, &verdict->slip_minus, &verdict->predicted_growth_per_s,
               &verdict->predicted_touch_ratio, &verdict->onset_touch_ratio, &verdict->t_v10_s, &verdict->sigma);
    return DEVICE_OK;
}

enum device_result device_selftest(struct device *device, double limit_s, unsigned *passed, unsigned *failed,
                                   uint32_t *failures)
{
    const double before_s = device->limit_s;
    struct bytes_reader reply;

    device->limit_s = limit_s > before_s ? limit_s : before_s;
    const enum device_result result = device_ask(device, LINK_SELFTEST, NULL, &reply);
    device->limit_s = before_s;
    if (result == DEVICE_OK) {
        *passed = bytes_get_u8(&reply);
        *failed = bytes_get_u8(&reply);
        *failures = bytes_get_u32(&reply);
    }
    return result;
}

/* --- Requests ----------------------------------------------------------------------------------------------------- */

static void put_axis(struct bytes_writer *request, const struct device_axis *axis)
{
    bytes_put_u8(request, axis != NULL ? (uint8_t)axis->param : LINK_NO_INDEX);
    bytes_put_u8(request, axis != NULL && axis->is_log ? 1u : 0u);
    bytes_put_f32(request, axis != NULL ? axis->from : 0.0f);
    bytes_put_f32(request, axis != NULL ? axis->to : 0.0f);
    bytes_put_u16(request, axis != NULL ? (uint16_t)axis->points : 0u);
}

static void put_span(struct bytes_writer *request, const struct device_span *span)
{
    bytes_put_u16(request, (uint16_t)span->transient);
    bytes_put_u16(request, (uint16_t)span->window);
    bytes_put_u8(request, span->is_whole ? LINK_IS_WHOLE : 0);
}

/* What comes of it has the sequence of the request, and may come in one piece with the reply. */
static enum device_result begin(struct device *device, enum link_message type, const struct bytes_writer *request,
                                const struct device_study *study, uint32_t *results)
{
    struct bytes_reader reply;

    (void)device_read_table(device, DEVICE_PARAMS); /* for the words of a refusal */
    device->study = *study;
    device->is_studying = true;
    device->study_sequence = (uint16_t)(device->master.sequence + 1u);
    const enum device_result result = device_ask(device, type, request, &reply);
    if (result == DEVICE_OK) {
        *results = bytes_get_u32(&reply);
    } else {
        device->is_studying = false;
    }
    return result;
}

enum device_result device_scan(struct device *device, const struct device_axis *axes, size_t count,
                               const struct device_span *span, const struct device_study *study, uint32_t *results)
{
    uint8_t bytes[SCAN_SIZE];
    struct bytes_writer request = {.bytes = bytes, .capacity = sizeof bytes};

    put_axis(&request, &axes[0]);
    put_axis(&request, count > 1 ? &axes[1] : NULL);
    put_span(&request, span);
    return begin(device, LINK_SCAN, &request, study, results);
}

enum device_result device_margin(struct device *device, int param, float within, const struct device_span *span,
                                 const struct device_study *study, uint32_t *results)
{
    uint8_t bytes[MARGIN_SIZE];
    struct bytes_writer request = {.bytes = bytes, .capacity = sizeof bytes};

    bytes_put_u8(&request, param >= 0 ? (uint8_t)param : LINK_NO_INDEX);
    bytes_put_f32(&request, within);
    put_span(&request, span);
    return begin(device, LINK_MARGIN, &request, study, results);
}

enum device_result device_await_study(struct device *device, bool (*is_unwanted)(void))
{
    enum device_result result = DEVICE_OK;
    double looked_s = clock_now_s();

    while (result == DEVICE_OK && device->is_studying) {
        if (is_unwanted != NULL && is_unwanted()) {
            return device_stop(device, NULL);
        }
        result = device_listen(device, LISTEN_S);
        if (result == DEVICE_OK && device->heard_s > looked_s) {
            looked_s = device->heard_s;
        }
        if (result == DEVICE_OK && device->is_studying && clock_now_s() - looked_s > LOOK_AGAIN_S) {
            uint64_t echo;
            result = device_ping(device, 0, &echo);
            looked_s = clock_now_s();
        }
    }
    return result;
}

/* --- Results ------------------------------------------------------------------------------------------------------ */

static void take_point(struct device *device, struct bytes_reader *reader)
{
    struct device_point point = {.index = bytes_get_u32(reader)};

    point.at[0] = bytes_get_f32(reader);
    point.at[1] = bytes_get_f32(reader);
    point.error = bytes_get_u8(reader);
    point.propensity = bytes_get_u8(reader);
    point.motion = bytes_get_u8(reader);
    point.period = bytes_get_u8(reader);
    point.predicted = bytes_get_u8(reader);
    point.end = bytes_get_u8(reader);
    const uint8_t flags = bytes_get_u8(reader);
    point.is_loud = (flags & LINK_IS_LOUD) != 0;
    point.is_undecided = (flags & LINK_IS_UNDECIDED) != 0;
    GET_FLOATS(reader, &point.amplitude_um, &point.velocity_mm_s, &point.frequency_hz, &point.level_db,
               &point.growth_per_s, &point.growth_error_per_s, &point.predicted_growth_per_s, &point.periods);
    if (bytes_is_spent(reader) && device->study.on_point != NULL) {
        device->study.on_point(device->study.context, &point);
    }
}

static void take_border(struct device *device, struct bytes_reader *reader)
{
    struct device_border border = {.param = bytes_get_u8(reader)};

    border.is_squeal = bytes_get_u8(reader) != 0;
    border.quiets = bytes_get_u8(reader);
    GET_FLOATS(reader, &border.value, &border.below.border, &border.below.quiet, &border.below.squeal,
               &border.below.searched, &border.above.border, &border.above.quiet, &border.above.squeal,
               &border.above.searched);
    if (bytes_is_spent(reader) && device->study.on_border != NULL) {
        device->study.on_border(device->study.context, &border);
    }
}

static void take_end(struct device *device, struct bytes_reader *reader)
{
    struct device_tally tally = {0};
    uint32_t *const counts[END_TALLIES] = {&tally.trials,   &tally.unknown, &tally.quiet,       &tally.watch,
                                           &tally.squeal,   &tally.loud,    &tally.undecided,   &tally.refused,
                                           &tally.diverged, &tally.caps,    &tally.saturations, &tally.gap_held};

    (void)bytes_get_u8(reader); /* type of the request */
    tally.reason = bytes_get_u8(reader);
    tally.results = bytes_get_u32(reader);
    for (size_t i = 0; i < END_TALLIES; i++) {
        *counts[i] = bytes_get_u32(reader);
    }
    tally.steps = bytes_get_u64(reader);
    device->is_studying = false;
    if (!reader->is_short && device->study.on_end != NULL) {
        device->study.on_end(device->study.context, &tally);
    }
}

void device_take_result(struct device *device, const struct frame *frame)
{
    struct bytes_reader reader = {.bytes = frame->payload, .size = frame->size};

    if (!device->is_studying || frame->sequence != device->study_sequence) {
        return;
    }
    if (frame->type == LINK_POINT) {
        take_point(device, &reader);
    } else if (frame->type == LINK_BORDER) {
        take_border(device, &reader);
    } else if (frame->type == LINK_STUDY_END) {
        take_end(device, &reader);
    }
}
