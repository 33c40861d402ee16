/* What a broken invariant does on this machine: it says where and ends the tool. */
#include "base/assert.h"

#include <stdio.h>
#include <stdlib.h>

void base_assert_failed(const char *file, unsigned line)
{
    fprintf(stderr, "squeal: broken invariant at %s:%u\n", file, line);
    abort();
}
