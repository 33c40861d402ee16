/* The numbers of errors.def are the indices of a table; a number given twice does not compile. */
#include "base/errors.h"

#include "base/assert.h"
#include "base/compiler.h"

static const struct entry {
    const char *name;
    const char *text;
} entries[] = {
#define ERROR(number, field, name, sentence) [number] = {name, sentence},
#include "base/errors.def"
#undef ERROR
};

static const struct entry *entry_of(enum error error)
{
    const unsigned number = (unsigned)error;

    BASE_ASSERT(number < BASE_COUNT(entries) && entries[number].name != 0);
    return &entries[number];
}

const char *error_name(enum error error) { return entry_of(error)->name; }

const char *error_text(enum error error) { return entry_of(error)->text; }
