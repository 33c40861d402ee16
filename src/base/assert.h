/* Assertions for bugs, never for data from outside. They stay on in every build. */
#ifndef BASE_ASSERT_H
#define BASE_ASSERT_H

#include "base/compiler.h"

/* Supplied by the program: brings outputs to the safe state, reports file and line, and ends. Never returns. [ANY] */
BASE_NORETURN void base_assert_failed(const char *file, unsigned line);

#define BASE_ASSERT(cond)                           \
    do {                                            \
        if (BASE_UNLIKELY(!(cond))) {               \
            base_assert_failed(__FILE__, __LINE__); \
        }                                           \
    } while (0)

#endif
