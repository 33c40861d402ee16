/* Everything that can be refused, by number, name and sentence; the table is errors.def. */
#ifndef BASE_ERRORS_H
#define BASE_ERRORS_H

enum error {
#define ERROR(number, field, name, sentence) ERROR_##field = number,
#include "base/errors.def"
#undef ERROR
};

/* The name in the protocol, "unknown-command". [ANY] */
const char *error_name(enum error error);

/* What a person should know, "no command has this name; help lists them". [ANY] */
const char *error_text(enum error error);

#endif
