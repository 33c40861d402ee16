/* The tick: the executive's work, its time, the pin. Nothing here talks or waits. */
#include "app/isr.h"

#include "base/word.h"
#include "hal_board.h"
#include "hal_tick.h"

static struct executive *executive;

/* The interrupt's, but for the baseline: main sets it while the timer stands still. */
static struct {
    uint32_t rate_hz;
    uint32_t period;               /* clock counts */
    uint32_t last_clock;           /* of the tick before, or of the start */
    struct word counted, expected; /* ticks that came, ticks that should have */
} timer;

void isr_init(struct executive *which) { executive = which; }

/* Clock counts since the tick before; whole periods of them, one if none was lost, are expected ticks. While ticks are
 * shed after an overrun some must get lost: that is counted there, and is no fault of the timer. */
static uint32_t count_tick(uint32_t now)
{
    const uint32_t elapsed = now - timer.last_clock;

    word_write(&timer.counted, word_read(&timer.counted) + 1u);
    word_write(&timer.expected,
               word_read(&timer.expected) +
                   (executive_is_behind(executive) ? 1u : (elapsed + timer.period / 2u) / timer.period));
    timer.last_clock = now;
    return elapsed;
}

static void work(uint32_t entered)
{
    struct executive_tick_time time = {.elapsed = count_tick(entered), .period = timer.period};
    const bool has_worked = executive_tick(executive, true);

    time.busy = hal_clock_now() - entered;
    if (!executive_book(executive, &time, has_worked && hal_tick_is_late())) {
        hal_tick_stop();
    }
}

void app_tick(void)
{
    const uint32_t entered = hal_clock_now();

    if (hal_tick_take()) {
        work(entered);
    } else {
        (void)executive_tick(executive, false);
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
    timer.period = (hal_clock_hz() + rate_hz / 2u) / rate_hz;
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

struct isr_ticks isr_ticks(void) { return (struct isr_ticks){word_read(&timer.counted), word_read(&timer.expected)}; }
