/* The build gives BUILD_ID to this file alone, so that a new commit compiles one file anew and not all. */
#include "app/version.h"

const char *version_name(void) { return "0.1.0"; }

const char *version_build_id(void) { return BUILD_ID; }
