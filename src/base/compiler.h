/* What C99 lacks and every freestanding program needs: the only place where compilers differ. */
#ifndef BASE_COMPILER_H
#define BASE_COMPILER_H

/* Keeps memory accesses on their side. Enough between an interrupt and the code it interrupts on one core. */
#define BASE_BARRIER() __asm__ volatile("" ::: "memory")

#define BASE_JOIN_(a, b) a##b
#define BASE_JOIN(a, b) BASE_JOIN_(a, b)

/* Fails to compile where cond is false; name says what was expected. */
#define BASE_STATIC_ASSERT(cond, name) \
    typedef char BASE_JOIN(static_assert_##name##_, __LINE__)[(cond) ? 1 : -1] __attribute__((unused))

#define BASE_NORETURN __attribute__((noreturn))
#define BASE_INLINE static inline __attribute__((always_inline))
#define BASE_NOINLINE __attribute__((noinline))
#define BASE_LIKELY(cond) __builtin_expect(!!(cond), 1)
#define BASE_UNLIKELY(cond) __builtin_expect(!!(cond), 0)
/* Takes what the compiler knows of a word from it. Without it gcc multiplies the upper word of a sum as 64 bits
 * again. */
#define BASE_FORGET(word) __asm__("" : "+r"(word))
/* One instruction each: the product of two words, and a product added to a sum of two words. Left to itself gcc keeps
 * such sums in pairs of neighbouring registers, of which there are too few for the step, and moves them about. */
#ifdef __arm__
#define BASE_PRODUCT(low, high, a, b) __asm__("smull %0, %1, %2, %3" : "=r"(low), "=r"(high) : "r"(a), "r"(b))
#define BASE_ADD_PRODUCT(low, high, a, b) __asm__("smlal %0, %1, %2, %3" : "+r"(low), "+r"(high) : "r"(a), "r"(b))
#endif
#define BASE_LEADING_ZEROS(word) ((unsigned)__builtin_clz(word)) /* of a 32-bit word other than 0 */
#define BASE_COUNT(array) (sizeof(array) / sizeof((array)[0]))

#endif
