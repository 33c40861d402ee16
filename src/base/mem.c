/* Small and quick enough: a word at a time where both ends are aligned, a byte at a time elsewhere.
 *
 * The build compiles this file alone and with -fno-tree-loop-distribute-patterns: otherwise the compiler recognises
 * these loops as what they are and replaces them by calls to themselves. Compiled alone, words may be read here
 * whatever type they have outside. */
#include "base/mem.h"

#include <stdbool.h>
#include <stdint.h>

#define WORD sizeof(uint32_t)

static bool is_aligned(const void *a, const void *b) { return (((uintptr_t)a | (uintptr_t)b) & (WORD - 1u)) == 0u; }

void *memcpy(void *restrict to, const void *restrict from, size_t size)
{
    uint8_t *out = to;
    const uint8_t *in = from;

    if (is_aligned(to, from)) {
        for (; size >= WORD; size -= WORD, out += WORD, in += WORD) {
            *(uint32_t *)(void *)out = *(const uint32_t *)(const void *)in;
        }
    }
    while (size-- > 0u) {
        *out++ = *in++;
    }
    return to;
}

void *memmove(void *to, const void *from, size_t size)
{
    uint8_t *out = to;
    const uint8_t *in = from;

    if ((uintptr_t)to - (uintptr_t)from >= size) { /* the start of "to" is not inside "from": forwards */
        if (is_aligned(to, from)) {
            for (; size >= WORD; size -= WORD, out += WORD, in += WORD) {
                *(uint32_t *)(void *)out = *(const uint32_t *)(const void *)in;
            }
        }
        while (size-- > 0u) {
            *out++ = *in++;
        }
        return to;
    }
    while (size-- > 0u) {
        out[size] = in[size];
    }
    return to;
}

void *memset(void *to, int byte, size_t size)
{
    const uint32_t word = (uint32_t)(uint8_t)byte * 0x01010101u;
    uint8_t *out = to;

    if (is_aligned(to, to)) {
        for (; size >= WORD; size -= WORD, out += WORD) {
            *(uint32_t *)(void *)out = word;
        }
    }
    while (size-- > 0u) {
        *out++ = (uint8_t)byte;
    }
    return to;
}

int memcmp(const void *a, const void *b, size_t size)
{
    const uint8_t *left = a;
    const uint8_t *right = b;

    for (; size > 0u; size--, left++, right++) {
        if (*left != *right) {
            return *left - *right;
        }
    }
    return 0;
}
