#include "tap.h"
#include "tests.h"

int unit_main(void)
{
#define TEST(module)     \
    tap_module(#module); \
    test_##module();
#include "tests.def"
#undef TEST
    return tap_finish();
}
