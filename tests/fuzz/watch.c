/* State and counters, and what belongs to both lines. */
#include "watch.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "firmware.h"
#include "watch_parts.h"

enum { COUNTERS_EVER = 19, COUNTERS_OF_RUN = 12, RESETS_WITHOUT_LOSS = 2 /* the first at the start */ };

static struct {
    uint32_t ever[COUNTERS_EVER], of_run[COUNTERS_OF_RUN];
    uint8_t epoch;
    uint32_t without_scale;                   /* samples in all */
    uint32_t console_has_lost, link_has_lost; /* of it, in the present streams */
} seen;

void watch_failed(const char *file, int line, const char *what)
{
    (void)fprintf(stderr, "%s:%d: it does not hold that %s\n", file, line, what);
    abort();
}

static void gather_ever(uint32_t counters[COUNTERS_EVER])
{
    const struct frame_receiver *receiver = &firmware.link->receiver;
    const struct console *console = firmware.console;
    const struct executive *executive = firmware.executive;
    const uint32_t now[COUNTERS_EVER] = {
        receiver->accepted,
        receiver->damaged,
        receiver->too_long,
        receiver->bad_cobs,
        receiver->too_short,
        receiver->bad_crc,
        receiver->garbage_bytes,
        firmware.link->refused,
        console->lines,
        console->rejected,
        console->uart_lost,
        console->line.garbage,
        executive->inputs_clamped,
        executive->resets,
        executive->inputs_refused,
        executive->samples.head,
        executive->samples.tail,
        executive->samples.dropped,
        executive->publish.generation,
    };

    memcpy(counters, now, sizeof now);
}

static void gather_of_run(uint32_t counters[COUNTERS_OF_RUN])
{
    const struct executive *executive = firmware.executive;
    const struct sim_counters *sim = &executive->sim.counters;
    const uint32_t now[COUNTERS_OF_RUN] = {
        (uint32_t)executive->sim.step,
        sim->events,
        sim->caps,
        sim->saturations,
        sim->lifted,
        sim->gap_held,
        sim->lowered,
        executive->load.ticks,
        executive->load.overruns,
        executive->load.shed,
        sim->inputs,
        sim->inputs_late,
    };

    memcpy(counters, now, sizeof now);
}

static void compare_counters(void)
{
    uint32_t ever[COUNTERS_EVER];
    uint32_t of_run[COUNTERS_OF_RUN];
    const uint8_t epoch = firmware.executive->in_force.epoch;

    gather_ever(ever);
    gather_of_run(of_run);
    for (unsigned i = 0u; i < COUNTERS_EVER; i++) {
        WATCH(ever[i] >= seen.ever[i]);
    }
    for (unsigned i = 0u; i < COUNTERS_OF_RUN; i++) {
        WATCH(of_run[i] >= seen.of_run[i] || epoch != seen.epoch);
    }
    memcpy(seen.ever, ever, sizeof ever);
    memcpy(seen.of_run, of_run, sizeof of_run);
    seen.epoch = epoch;
}

void watch_reset(void)
{
    memset(&seen, 0, sizeof seen);
    watch_link_reset();
    watch_console_reset();
    watch_round();
}

void watch_lost(enum hal_uart port, uint32_t count)
{
    if (count == 0u) {
        return;
    }
    if (port == HAL_UART_LINK) {
        watch_link_lost();
    } else {
        watch_console_lost();
    }
}

void watch_sent(enum hal_uart port, const uint8_t *bytes, size_t size)
{
    if (port == HAL_UART_LINK) {
        watch_link_sent(bytes, size);
    } else {
        watch_console_sent(bytes, size);
    }
}

/* A check takes longer than many rounds. */
static void check_params(const struct params *params)
{
    static struct params good;

    if (memcmp(&good, params, sizeof good) != 0) {
        WATCH(params_check(params).error == ERROR_OK);
        good = *params;
    }
}

static bool is_number(uint32_t word) { return fmath_is_finite(fmath_from_bits(word)); }

/* A plant in its domain. */
void watch_tick(void)
{
    struct sample now;

    sim_sample(&firmware.executive->sim, &now);
    if (now.arithmetic == ARITH_F32 && now.is_fault == 0u && now.step > 0u) {
        WATCH(is_number(now.x) && is_number(now.v) && is_number(now.y) && is_number(now.w));
        WATCH(is_number(now.load) && is_number(now.disc) && is_number(now.friction));
    }
    check_params(&firmware.executive->in_force.plan.params);
}

/* Nothing but a byte will wake it, so nothing may be left to do. */
void watch_sleep(void)
{
    WATCH(!executive_has_order(firmware.executive) && !executive_wants_tick(firmware.executive));
    WATCH(firmware.console->task == CONSOLE_TASK_NONE && firmware.console->waiting_size == 0u);
    WATCH(!firmware.link->has_request && firmware.turn->holder == TURN_NOBODY);
    WATCH(firmware.turn->studies == TURN_NOBODY);
    WATCH(firmware.console_text->head == firmware.console_text->tail);
    WATCH(firmware.link_text->head == firmware.link_text->tail);
    WATCH(firmware.turn->streams == TURN_NOBODY || ring_fill(&firmware.executive->samples) == 0u);
}

static uint32_t growth(uint32_t *before, uint32_t now)
{
    const uint32_t count = now >= *before ? now - *before : now; /* a stream that has begun counts anew */

    *before = now;
    return count;
}

void watch_round(void)
{
    compare_counters();
    seen.without_scale += growth(&seen.console_has_lost, firmware.console->stream.without_scale);
    seen.without_scale += growth(&seen.link_has_lost, firmware.link->stream.without_scale);
    check_params(executive_params(firmware.executive));
}

/* Samples that were not dropped were sent, but for those that a second reset has overtaken: of these a stream that
 * begins anew takes its count along. */
void watch_end(void)
{
    const struct executive *executive = firmware.executive;
    uint32_t samples;

    WATCH(watch_unanswered() == 0u);
    if (watch_console_end(&samples)) {
        samples += watch_link_samples() + seen.without_scale;
        WATCH(executive->samples.tail >= samples);
        WATCH(executive->samples.tail == samples || executive->resets > RESETS_WITHOUT_LOSS);
    }
}
