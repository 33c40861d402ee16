/* One aligned word between an interrupt and main: one context writes it, the other reads it, neither waits. */
#ifndef BASE_WORD_H
#define BASE_WORD_H

#include <stdint.h>

struct word {
    volatile uint32_t value;
};

/* [the one writer, which may also read] */
static inline void word_write(struct word *word, uint32_t value) { word->value = value; }

/* The value written last. [ANY] */
static inline uint32_t word_read(const struct word *word) { return word->value; }

#endif
