/* Magnitudes that are exact where a float is not: the common ground of decimal and binary. Fixed size, on the stack, no
 * 64-bit division. Large enough for what base/decimal makes of any float and any text, and for nothing more. [ANY] */
#ifndef BASE_BIG_H
#define BASE_BIG_H

#include <stdbool.h>
#include <stdint.h>

enum { BIG_WORDS = 16 }; /* 113 digits (376 bits) times 10^38 (127 bits) */

struct big {
    uint32_t words[BIG_WORDS]; /* least significant first */
    unsigned count;            /* words in use, the last of them not 0; none for zero */
    int exponent;              /* the magnitude is words * 2^exponent */
    bool is_inexact;           /* and a little more, less than one in the last place of words */
};

void big_set(struct big *big, uint64_t value, int exponent);

/* words = words * factor + summand. */
void big_multiply_add(struct big *big, uint32_t factor, uint32_t summand);

/* Divides the words by a divisor up to 2^16 and returns the remainder. */
uint32_t big_divide(struct big *big, uint32_t divisor);

/* Multiplies the magnitude by 10^power. Where a quotient does not end, 40 bits of it remain at least. */
void big_scale(struct big *big, int power);

/* The magnitude in units of 2^exponent, to nearest, ties to even; the caller knows that it fits. Changes big. */
uint32_t big_round(struct big *big, int exponent);

/* Number of bits of words up to the highest one that is set. */
unsigned big_length(const struct big *big);

/* 32 bits of words, the lowest of them at the given position. */
uint32_t big_bits_at(const struct big *big, unsigned position);

#endif
