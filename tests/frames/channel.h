/* A line that turns bits over, and drops, doubles and swaps bytes, each independently at its own rate. */
#ifndef CHANNEL_H
#define CHANNEL_H

#include <stddef.h>
#include <stdint.h>

enum channel_fault {
    CHANNEL_FLIP,   /* of a bit */
    CHANNEL_DROP,   /* of a byte */
    CHANNEL_DOUBLE, /* of a byte */
    CHANNEL_SWAP,   /* of a byte with the next one of the same frame */
    CHANNEL_FAULTS
};

struct channel {
    uint32_t seed;
    uint64_t draws;
    struct {
        double log_keep; /* log of the probability that a bit or byte passes */
        uint64_t gap;    /* bits or bytes that pass before the next fault */
    } fault[CHANNEL_FAULTS];
};

/* Rates are probabilities a bit for flips, a byte for the others: 0 <= rate < 1. */
void channel_open(struct channel *channel, const double rate[CHANNEL_FAULTS], uint32_t seed);

/* Carries size bytes; what arrives goes to out, which has room for twice as many. Returns how many arrive. */
size_t channel_carry(struct channel *channel, const uint8_t *bytes, size_t size, uint8_t *out);

#endif
