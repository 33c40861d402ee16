/* The periodic interrupt that steps the plant, and a free-running clock beside it. */
#ifndef HAL_TICK_H
#define HAL_TICK_H

#include <stdbool.h>
#include <stdint.h>

/* Supplied by the program: the tick's handler. It must call hal_tick_take() once. [ISR] */
void app_tick(void);

/* Highest and lowest rate that the timer can make, Hz. [ANY] */
enum { HAL_TICK_HZ_MIN = 1, HAL_TICK_HZ_MAX = 100000 };

/* Starts the timer, first interrupt one period from now. Does nothing if it runs at this rate already; changes the rate
 * otherwise. rate_hz within the limits above, else nothing happens. [MAIN] */
void hal_tick_start(uint32_t rate_hz);

/* Stops the timer; no tick follows. May be called by the handler itself: the sleep of a stopped plant begins here.
 * [MAIN, ISR] */
void hal_tick_stop(void);

/* Does the timer run? [ANY] */
bool hal_tick_is_running(void);

/* Runs app_tick() once at the tick's priority and returns after it, whether or not the timer runs. hal_tick_take()
 * tells the handler that no period has passed. [MAIN] */
void hal_tick_trigger(void);

/* Acknowledges the timer. True if a period has ended since the last call. [ISR] */
bool hal_tick_take(void);

/* Has another period ended already, before this handler has returned? Then the handler was too slow. [ISR] */
bool hal_tick_is_late(void);

/* Free-running counter, wraps at 2^32; differences are taken as uint32_t. Counts on while the tick is stopped. [ANY] */
uint32_t hal_clock_now(void);
uint32_t hal_clock_hz(void);

#endif
