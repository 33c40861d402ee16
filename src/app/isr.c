/* The tick: the executive's work, its time, the pin. Nothing here talks or waits. */
#include "app/isr.h"

#include "hal_board.h"
#include "hal_tick.h"

static struct executive *executive;

/* The interrupt's, but for the baseline: main sets it while the timer stands still. */
static struct {
    uint32_t rate_hz;
    uint32_t period;     /* clock counts */
    uint32_t last_clock; /* of the tick before, or of the start */
    struct isr_ticks ticks;
} timer;

void isr_init(struct executive *which) { executive = which; }

/* Whole periods since the tick before; one, if none was lost. */
static void count_ticks(uint32_t now)
{
    timer.ticks.counted++;
    timer.ticks.expected += (now - timer.last_clock + timer.period / 2u) / timer.period;
    timer.last_clock = now;
}

void app_tick(void)
{
    const uint32_t entered = hal_clock_now();
    const bool is_due = hal_tick_take();

    if (is_due) {
        count_ticks(entered);
    }
    executive_tick(executive, is_due);
    if (is_due) {
        executive_book(executive, hal_clock_now() - entered, timer.period, hal_tick_is_late());
        if (!executive_wants_tick(executive)) {
            hal_tick_stop();
        }
    }
    hal_flag_set(executive_is_squealing(executive));
}

static void start_timer(uint32_t rate_hz)
{
    if (hal_tick_is_running() && rate_hz == timer.rate_hz) {
        return;
    }
    hal_tick_stop();
    timer.rate_hz = rate_hz;
    timer.period = hal_clock_hz() / rate_hz;
    timer.last_clock = hal_clock_now();
    hal_tick_start(rate_hz);
}

void isr_follow(void)
{
    if (executive_has_order(executive)) {
        hal_tick_trigger();
    }
    if (executive_wants_tick(executive)) {
        start_timer((uint32_t)executive_params(executive)->tick_hz);
    } else if (hal_tick_is_running()) {
        hal_tick_stop();
    }
}

struct isr_ticks isr_ticks(void) { return timer.ticks; }
