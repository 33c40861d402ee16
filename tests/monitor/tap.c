/* TAP. */
#include "tests/monitor/tap.h"

#include <stdio.h>

static int count, failed;

void tap_check(bool holds, const char *claim)
{
    count++;
    failed += holds ? 0 : 1;
    printf("%sok %d - %s\n", holds ? "" : "not ", count, claim);
}

int tap_end(void)
{
    printf("1..%d\n", count);
    return failed;
}
