/* What the tests of the plant share: a plant from assignments as a person would type them, and how to run it; the same
 * for an executive. */
#ifndef PLANTS_H
#define PLANTS_H

#include <stdint.h>

#include "sim/executive.h"
#include "sim/sim.h"

struct plant {
    struct sim_plan plan;
    struct sim sim;
};

/* Defaults, then assignments ("N0 5 alpha -0.02"). Text that does not parse is a bug of the test. */
struct params plants_params(const char *assignments);

/* Further assignments. */
void plants_assign(struct params *params, const char *assignments);

/* The same after a preset of this name. */
struct params plants_preset(const char *name, const char *assignments);

/* A plan of a set that must be accepted. */
void plants_plan(struct sim_plan *plan, const struct params *params);

/* A plant at step 0, from assignments alone or from a preset and assignments. */
void plants_start(struct plant *plant, const char *assignments);
void plants_start_preset(struct plant *plant, const char *name, const char *assignments);

void plants_run_steps(struct plant *plant, uint32_t steps);
void plants_run_periods(struct plant *plant, uint32_t periods);

/* Displacement in metres. */
float plants_x_m(const struct plant *plant);

/* Largest |v| in the model's units over the next steps. */
float plants_largest_v(struct plant *plant, uint32_t steps);

/* Starts the plant without damping and slope, with Z = 3/2, N a quarter of N_max and further assignments, and holds
 * twenty periods of slip, in either arithmetic, against the closed form; the tolerance is a part of the largest
 * swing. */
void plants_check_undamped(struct plant *plant, const char *assignments, float tolerance);

/* An executive from assignments, the order taken but no step made. */
void plants_executive(struct executive *executive, const char *assignments);

/* Orders a set as executive_set() does. */
enum error plants_order(struct executive *executive, const char *assignments, bool may_reset, bool *was_reset);

/* So many ticks; as many as the credit lasts. */
void plants_ticks(struct executive *executive, uint32_t count);
void plants_spend(struct executive *executive);

/* A count for the host, or a part of it for a board. */
uint32_t plants_scaled(uint32_t hosted, uint32_t on_board);

/* A random number from low to high. */
float plants_random(uint32_t *state, float low, float high);

#endif
