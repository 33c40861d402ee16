/* The four memory functions that a compiler may call by itself. On the target base/mem.c supplies them; hosted programs
 * use their C library's. Semantics: ISO C99 7.21. [ANY] */
#ifndef BASE_MEM_H
#define BASE_MEM_H

#include <stddef.h>

void *memcpy(void *restrict to, const void *restrict from, size_t size);
void *memmove(void *to, const void *from, size_t size);
void *memset(void *to, int byte, size_t size);
int memcmp(const void *a, const void *b, size_t size);

#endif
