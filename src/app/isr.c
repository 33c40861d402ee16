/* The tick: the executive's work, its time, the pin. Nothing here talks or waits. */
#include "app/isr.h"

#include "base/compiler.h"
#include "base/word.h"
#include "hal_board.h"
#include "hal_tick.h"

/* The interrupt's, but for the baseline: main sets it while the timer stands still. */
static struct {
    struct executive *executive;
    uint32_t rate_hz;
    uint32_t period;             /* clock counts */
    uint32_t last_clock;         /* of the tick before, or of the start */
    struct word counted, missed; /* ticks that came, ticks that should have beside them */
    uint8_t propensity;          /* that the pin shows */
} timer;

void isr_init(struct executive *which) { timer.executive = which; }

/* So many ticks should have come instead of one. While ticks are shed after an overrun some must get lost: that is
 * counted there, and is no fault of the timer. */
static BASE_NOINLINE void count_missed(uint32_t expected)
{
    if (!executive_is_behind(timer.executive)) {
        word_write(&timer.missed, word_read(&timer.missed) + expected - 1u);
    }
}

/* Clock counts since the tick before; whole periods of them are ticks that should have come. */
static uint32_t count_tick(uint32_t now)
{
    const uint32_t elapsed = now - timer.last_clock;
    const uint32_t rounded = elapsed + timer.period / 2u;

    timer.last_clock = now;
    word_write(&timer.counted, word_read(&timer.counted) + 1u);
    if (BASE_UNLIKELY(rounded - timer.period >= timer.period)) {
        count_missed(rounded / timer.period);
    }
    return elapsed;
}

static void work(struct executive *executive, uint32_t entered)
{
    const uint32_t elapsed = count_tick(entered);
    const bool has_worked = executive_tick(executive, true);
    const uint32_t busy = hal_clock_now() - entered;
    const bool is_late = hal_tick_is_late();

    if (!executive_book(executive, busy, elapsed, has_worked && is_late)) {
        hal_tick_stop();
    }
}

/* The pin follows the propensity. */
static void show(uint8_t propensity)
{
    if (BASE_UNLIKELY(propensity != timer.propensity)) {
        timer.propensity = propensity;
        hal_flag_set(propensity == PROPENSITY_SQUEAL);
    }
}

void app_tick(void)
{
    struct executive *const executive = timer.executive;
    const uint32_t entered = hal_clock_now();

    if (BASE_LIKELY(hal_tick_take())) {
        work(executive, entered);
    } else {
        (void)executive_tick(executive, false);
    }
    show(executive_propensity(executive));
}

static void start_timer(uint32_t rate_hz)
{
    if (hal_tick_is_running() && rate_hz == timer.rate_hz) {
        return;
    }
    hal_tick_stop();
    timer.rate_hz = rate_hz;
    timer.period = (hal_clock_hz() + rate_hz / 2u) / rate_hz;
    executive_begin_rate(timer.executive, timer.period);
    timer.last_clock = hal_clock_now();
    hal_tick_start(rate_hz);
}

void isr_follow(void)
{
    struct executive *const executive = timer.executive;

    if (executive_has_order(executive)) {
        hal_tick_trigger();
    }
    if (executive_wants_tick(executive)) {
        start_timer((uint32_t)executive_params(executive)->tick_hz);
    } else if (hal_tick_is_running()) {
        hal_tick_stop();
    }
}

struct isr_ticks isr_ticks(void)
{
    const uint32_t counted = word_read(&timer.counted);

    return (struct isr_ticks){counted, counted + word_read(&timer.missed)};
}
