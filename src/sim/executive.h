/* The executive: one plant between an interrupt that steps it and a main loop that talks. It knows neither timers nor
 * wires; the program calls executive_tick() from its interrupt and the rest from main, so a test can be both.
 *
 *   main                                        interrupt
 *   executive_reset/apply/... --- order ------> executive_tick: take order, step while there is credit
 *   executive_grant, executive_free_run - words -^        |          |
 *   executive_report  <------ latest value ---------------+          |
 *   ring_pop(&samples) <------ ring of samples -----------------------+
 *   executive_input ---------- ring of inputs --> before the step each is for
 *
 * These are the only ways across; each is listed in src/app/CONCURRENCY.md. */
#ifndef SIM_EXECUTIVE_H
#define SIM_EXECUTIVE_H

#include <stdbool.h>
#include <stdint.h>

#include "base/compiler.h"
#include "base/errors.h"
#include "base/handoff.h"
#include "base/ring.h"
#include "base/word.h"
#include "sim/sim.h"
#include "sim/snapshot.h"

enum {
    EXECUTIVE_SAMPLES = 512,         /* records between interrupt and main */
    EXECUTIVE_INPUTS = 64,           /* demands of a controller on their way to the interrupt */
    EXECUTIVE_GRANT_MAX = 1000000000 /* steps of credit at a time */
};

/* One thing that main asks of the interrupt, whole or not at all. */
struct executive_order {
    bool is_reset;          /* start again from the plan's initial state; else take it over between two steps */
    bool is_restore;        /* of a reset: from the state in the image instead */
    bool is_snapshot;       /* take the state into the image */
    bool is_new_plan;       /* the plan differs from the one in use */
    uint64_t measure_steps; /* start a measurement; 0 none */
    uint32_t sample_every;  /* steps between samples; 0 none */
    uint32_t substeps;      /* steps a tick */
    uint8_t epoch;          /* of the reset that this order belongs to */
    struct sim_plan plan;   /* last: it is long */
};

/* What the interrupt's time went into. Clock counts are those of the program's clock. */
struct executive_load {
    uint32_t ticks;    /* that did their work */
    uint32_t overruns; /* ticks still at work past 15/16 of their period */
    uint32_t shed;     /* ticks skipped after an overrun so that main goes on */
    uint32_t busy_max; /* clock counts of the longest tick */
    uint64_t busy_sum; /* of all ticks at this rate */
    uint64_t elapsed;  /* clock counts over which they came */
    uint32_t period;   /* clock counts between two ticks */
};

/* What main can know: the latest state of everything. */
struct executive_report {
    struct sample now;
    struct sim_counters counters;
    struct detector_verdict verdict;
    struct measure measure;
    struct executive_load load;
    bool has_v10;
    uint64_t v10_step;
    uint32_t v10_fraction_q15;
    uint32_t generation; /* of the order in force */
    struct input_state input;
    uint32_t stales, safes; /* times since reset that a controller was silent for too long */
};

struct executive {
    /* the interrupt's, what each tick reads first: it lies near */
    struct sim sim;
    struct executive_load load;
    uint32_t until_sample, until_report;
    uint32_t to_shed;    /* ticks to skip after an overrun */
    uint32_t busy_usual; /* clock counts of a tick up to which it is neither the longest nor an overrun */

    /* single words, one writer each */
    struct word granted;       /* main: steps granted so far */
    struct word used;          /* interrupt: steps of it used */
    struct word is_free;       /* main: endless credit */
    struct word inputs_queued; /* interrupt: demands that wait for their step */

    struct publish publish; /* main's orders */
    struct handoff handoff; /* the interrupt's reports */
    struct ring samples, inputs;
    struct executive_order in_force;   /* interrupt */
    struct input_queue inputs_waiting; /* interrupt: out of the ring, their steps not reached */

    /* what lies behind the ways across */
    struct executive_order orders[2];
    struct executive_report report_store;
    struct sample sample_store[EXECUTIVE_SAMPLES];
    struct input input_store[EXECUTIVE_INPUTS];
    uint8_t image[SNAPSHOT_SIZE]; /* whose it is: main's, but for the one that an order waits to be made of or into */

    /* main's own */
    float arithmetic;             /* of the defaults on this board */
    struct executive_order draft; /* last order given */
    struct scale scales[2];       /* by epoch & 1, for samples that are still on their way */
    uint32_t inputs_clamped;      /* demands held at a limit, since the start */
    uint32_t inputs_refused;      /* demands for which there was no place, since the start */
    uint32_t resets;              /* ordered, since the start */
};

/* Starts with the defaults in the given number format (ARITH_F32 or ARITH_Q27), which is the board's; the plant stands
 * at step 0 without credit. [INIT] */
void executive_init(struct executive *executive, int arithmetic);

/* --- main --------------------------------------------------------------------------------------------------------- */

/* An order given waits until the next tick, or until the program triggers one; no further order can be given before. */
bool executive_has_order(const struct executive *executive);

/* Checks a set and orders it. Where restart parameters differ from the set in use: with may_reset the plant restarts,
 * else NEEDS_RESTART. On a problem nothing changes. *was_reset (may be NULL) tells which. [MAIN] */
struct params_problem executive_set(struct executive *executive, const struct params *params, bool may_reset,
                                    bool *was_reset);

/* The same for a change as a user means it: while the plant stands at step 0 nothing can be lost, and every change is a
 * reset, so that the scale follows the set; while it runs nothing may reset it. [MAIN] */
struct params_problem executive_change(struct executive *executive, const struct params *params, bool may_reset,
                                       bool *was_reset);

/* Orders a restart of a set from its initial state, credit gone. On a problem nothing changes. [MAIN] */
struct params_problem executive_reset(struct executive *executive, const struct params *params);

/* Orders samples every n steps from here on; 0 ends them. [MAIN] */
void executive_stream(struct executive *executive, uint32_t every);

/* Orders a measurement over n steps from here, without granting them. [MAIN] */
void executive_measure(struct executive *executive, uint64_t steps);

/* Orders a copy of the run into executive->image, which is main's again once the order is taken. The plant must stand,
 * and not in a fault; anything that shall not be in it must have been waited for. [MAIN] */
void executive_snapshot(struct executive *executive);

/* Checks the image, and orders a reset to the run in it. What may be wrong is snapshot_check()'s to say; then nothing
 * changes. [MAIN] */
struct params_problem executive_restore(struct executive *executive);

/* Hands over a controller's demand, to be taken before its step, in whatever order; up to INPUT_QUEUE_MAX wait. A reset
 * voids what waits, and the profiles act again. BUSY if there is no place, SAFE_STATE where an explicit start must come
 * first: nothing is handed over then, and it is counted. *is_clamped (may be NULL) tells whether a limit held it.
 * [MAIN] */
enum error executive_input(struct executive *executive, const struct input_demand *demand, bool *is_clamped);

/* Credit: n more steps (at most EXECUTIVE_GRANT_MAX outstanding), endless, or none any more. A free run is an explicit
 * start, and leaves the safe state, by an order; BUSY if there is no place for that. [MAIN] */
void executive_grant(struct executive *executive, uint32_t steps);
enum error executive_free_run(struct executive *executive);
void executive_stop(struct executive *executive);

/* Takes the credit back by an order that changes nothing: once it is taken, the report tells where the plant stands.
 * [MAIN] */
void executive_halt(struct executive *executive);

/* Steps of credit left; 0 in free run, and where a stop came while some were being used. [ANY] */
static inline uint32_t executive_credit(const struct executive *executive)
{
    const uint32_t left = word_read(&executive->granted) - word_read(&executive->used);

    return word_read(&executive->is_free) == 0u && left <= EXECUTIVE_GRANT_MAX ? left : 0u;
}

/* Should the timer run? [ANY] */
static inline bool executive_wants_tick(const struct executive *executive)
{
    return word_read(&executive->is_free) != 0u || executive_credit(executive) != 0u;
}

/* The set last ordered, and its plan. [MAIN] */
const struct params *executive_params(const struct executive *executive);
const struct sim_plan *executive_plan(const struct executive *executive);

/* The latest report. [MAIN] */
void executive_report(const struct executive *executive, struct executive_report *report);

/* The scale that a sample was taken under, NULL if it is older than the reset before last. [MAIN] */
const struct scale *executive_scale(const struct executive *executive, uint8_t epoch);

/* --- interrupt ---------------------------------------------------------------------------------------------------- */

/* Takes an order if there is one; if a period has passed, makes up to substeps steps. True if it did; false too where
 * the tick was shed. [ISR] */
bool executive_tick(struct executive *executive, bool is_due);

/* Ticks come at another rate from here on, so many counts of the program's clock apart, and what was booked belonged to
 * the old one; does nothing at the same rate. While none comes. [MAIN] */
void executive_begin_rate(struct executive *executive, uint32_t period);

/* The rest of executive_book(). [ISR] */
void executive_book_unusual(struct executive *executive, uint32_t busy, bool is_late);
void executive_book_end(struct executive *executive);

/* Books a tick's time, in counts of the program's clock: from its begin to its end, and since the tick before. One that
 * was late, or left main less than 1/16 of the period, is an overrun: as many ticks as it took periods are shed after
 * it, and one more, so that main has at least half of the time whatever the load. A tick that was shed is never late.
 * Returns whether the timer should go on. [ISR] */
static inline bool executive_book(struct executive *executive, uint32_t busy, uint32_t elapsed, bool is_late)
{
    executive->load.busy_sum += busy;
    executive->load.elapsed += elapsed;
    if (BASE_UNLIKELY(is_late || busy > executive->busy_usual)) {
        executive_book_unusual(executive, busy, is_late);
    }
    if (BASE_UNLIKELY(!executive_wants_tick(executive))) {
        executive_book_end(executive);
        return false;
    }
    return true;
}

/* Ticks are being shed after an overrun. [ISR] */
static inline bool executive_is_behind(const struct executive *executive) { return executive->to_shed != 0u; }

/* enum detector_propensity at this step, for the pin. [ISR] */
static inline uint8_t executive_propensity(const struct executive *executive)
{
    return executive->sim.detector.verdict.propensity;
}

#endif
