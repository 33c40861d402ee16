/* FNV-1a over 32-bit words: two runs with equal hashes went through the same bits. One multiplication a word. [ANY] */
#ifndef BASE_HASH_H
#define BASE_HASH_H

#include <stdint.h>

/* The hash of nothing, from which every hash starts. */
#define HASH_INIT UINT32_C(2166136261)

static inline uint32_t hash_word(uint32_t hash, uint32_t word) { return (hash ^ word) * UINT32_C(16777619); }

#endif
