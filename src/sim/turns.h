/* Phases: parts of a turn in 2^-64, which wrap as a circle does. */
#ifndef SIM_TURNS_H
#define SIM_TURNS_H

#include <stdint.h>

/* What is left of so many turns a step when whole ones are taken away. [MAIN] */
uint64_t turns_in_step(float turns);

/* Turns in so much time, in 2^-30 steps. [MAIN] */
uint64_t turns_in_time(uint64_t turns_per_step, uint64_t time);

/* Part of a whole at this phase. [ANY, pure] */
uint64_t turns_part(uint64_t turns, uint64_t whole);

/* Phase in the middle of a step, in 2^-32. [ANY, pure] */
static inline uint32_t turns_at_middle(uint64_t turns_per_step, uint64_t step)
{
    return (uint32_t)((step * turns_per_step + (turns_per_step >> 1)) >> 32);
}

#endif
