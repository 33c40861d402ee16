/* The textbook's text, twice. */
#include "textbook.h"

#include "base/compiler.h"

#define REAL float
#define NAME(name) name##_float
#include "textbook_rk4.h"

#undef REAL
#undef NAME
#define REAL double
#define NAME(name) name##_double
#include "textbook_rk4.h"
