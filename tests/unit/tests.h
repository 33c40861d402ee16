/* Prototypes of the unit tests. */
#ifndef TESTS_H
#define TESTS_H

#define TEST(module) void test_##module(void);
#include "tests.def"
#undef TEST

#endif
