#include "base/errors.h"

#include "tap.h"
#include "tests.h"

static bool is_name(const char *name)
{
    bool ok = *name != '\0';

    for (; *name != '\0'; name++) {
        ok = ok && ((*name >= 'a' && *name <= 'z') || *name == '-');
    }
    return ok;
}

void test_errors(void)
{
    static const enum error all[] = {
#define ERROR(number, field, name, sentence) ERROR_##field,
#include "base/errors.def"
#undef ERROR
    };
    bool are_names = true;
    bool are_sentences = true;
    bool are_in_order = true;

    for (unsigned i = 0u; i < sizeof(all) / sizeof(all[0]); i++) {
        are_names = are_names && is_name(error_name(all[i]));
        are_sentences = are_sentences && error_text(all[i])[0] != '\0';
        are_in_order = are_in_order && (unsigned)all[i] == i;
    }
    tap_check(are_names, "every name is of small letters and hyphens: one word of an answer line");
    tap_check(are_sentences, "every error has a sentence");
    tap_check(are_in_order, "the numbers have no gap");
    tap_check(ERROR_OK == 0, "0 is no error");
    tap_check_text(error_name(ERROR_UNKNOWN_COMMAND), "unknown-command", "a number leads to its name");
    tap_check_text(error_text(ERROR_OUT_OF_RANGE), "outside the allowed range", "and to its sentence");
}
