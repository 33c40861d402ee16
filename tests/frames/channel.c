/* Gaps between faults are drawn, from the geometric distribution, so that what passes costs nothing. */
#include "channel.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "base/random.h"

enum { STREAM = 1 }; /* of random numbers */

/* Larger than any campaign, and far from where a sum of two wraps. */
#define NEVER (UINT64_MAX / 4u)

static uint64_t draw_gap(struct channel *channel, double log_keep)
{
    const struct random_words words = random_words(channel->seed, STREAM, channel->draws++);
    const double unit = (words.first + (words.second + 0.5) / 4294967296.0) / 4294967296.0;
    const double gap = log(unit) / log_keep; /* inf at rate 0 */

    return gap < (double)NEVER ? (uint64_t)gap : NEVER;
}

void channel_open(struct channel *channel, const double rate[CHANNEL_FAULTS], uint32_t seed)
{
    *channel = (struct channel){.seed = seed};
    for (int i = 0; i < CHANNEL_FAULTS; i++) {
        channel->fault[i].log_keep = -fabs(log1p(-rate[i]));
        channel->fault[i].gap = draw_gap(channel, channel->fault[i].log_keep);
    }
}

/* Does the fault strike one of the next trials? Then *which of them; to be asked again about the others. */
static bool strikes(struct channel *channel, enum channel_fault fault, uint64_t trials, uint64_t *which)
{
    if (channel->fault[fault].gap >= trials) {
        channel->fault[fault].gap -= trials;
        return false;
    }
    *which = channel->fault[fault].gap;
    channel->fault[fault].gap = draw_gap(channel, channel->fault[fault].log_keep);
    return true;
}

static uint8_t flip(struct channel *channel, uint8_t byte)
{
    uint64_t done = 0u;
    uint64_t which;

    while (strikes(channel, CHANNEL_FLIP, 8u - done, &which)) {
        done += which;
        byte ^= (uint8_t)(1u << done);
        done++;
    }
    return byte;
}

/* No fault strikes any of so many bytes: the usual case. */
static bool pass(struct channel *channel, size_t size)
{
    for (int i = 0; i < CHANNEL_FAULTS; i++) {
        if (channel->fault[i].gap < 8u * size) {
            return false;
        }
    }
    for (int i = 0; i < CHANNEL_FAULTS; i++) {
        channel->fault[i].gap -= i == CHANNEL_FLIP ? 8u * size : size;
    }
    return true;
}

size_t channel_carry(struct channel *channel, const uint8_t *bytes, size_t size, uint8_t *out)
{
    size_t count = 0u;
    int held = -1; /* a byte that waits to be sent behind the next one */
    uint64_t which;

    if (pass(channel, size)) {
        memcpy(out, bytes, size);
        return size;
    }
    for (size_t i = 0u; i < size; i++) {
        const uint8_t byte = flip(channel, bytes[i]);
        const bool is_dropped = strikes(channel, CHANNEL_DROP, 1u, &which);
        const bool is_doubled = strikes(channel, CHANNEL_DOUBLE, 1u, &which);

        if (strikes(channel, CHANNEL_SWAP, 1u, &which) && held < 0 && i + 1u < size) {
            held = byte;
            continue;
        }
        if (!is_dropped) {
            out[count++] = byte;
        }
        if (is_doubled) {
            out[count++] = byte;
        }
        if (held >= 0) {
            out[count++] = (uint8_t)held;
            held = -1;
        }
    }
    return count;
}
