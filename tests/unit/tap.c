/* Counts and prints claims. Numbers are printed by what is under test elsewhere only where a claim has failed anyway.
 */
#include "tap.h"

#include "base/decimal.h"

static const char *module_name = "";
static uint32_t claims;
static uint32_t failures;

static void write_count(uint32_t count)
{
    char digits[11];
    char *next = &digits[10];

    *next = '\0';
    do {
        *--next = (char)('0' + count % 10u);
        count /= 10u;
    } while (count > 0u);
    tap_write(next);
}

void tap_module(const char *name) { module_name = name; }

bool tap_check_at(bool ok, const char *claim, const char *file, unsigned line)
{
    claims++;
    failures += ok ? 0u : 1u;
    tap_write(ok ? "ok " : "not ok ");
    write_count(claims);
    tap_write(" - ");
    tap_write(module_name);
    tap_write(": ");
    tap_write(claim);
    tap_write("\n");
    if (!ok) {
        tap_write("# ");
        tap_write(file);
        tap_write(":");
        write_count(line);
        tap_write("\n");
    }
    return ok;
}

bool tap_check_close_at(float actual, float expected, float tolerance, const char *claim, const char *file,
                        unsigned line)
{
    const float difference = actual - expected;
    const bool ok = difference <= tolerance && difference >= -tolerance;

    (void)tap_check_at(ok, claim, file, line);
    if (!ok) {
        tap_note_number("actual", actual);
        tap_note_number("expected", expected);
        tap_note_number("tolerance", tolerance);
    }
    return ok;
}

bool tap_check_text_at(const char *actual, const char *expected, const char *claim, const char *file, unsigned line)
{
    unsigned i = 0u;
    bool ok;

    while (actual[i] != '\0' && actual[i] == expected[i]) {
        i++;
    }
    ok = actual[i] == expected[i];
    (void)tap_check_at(ok, claim, file, line);
    if (!ok) {
        tap_note(actual);
        tap_note(expected);
    }
    return ok;
}

void tap_note(const char *text)
{
    tap_write("# ");
    tap_write(text);
    tap_write("\n");
}

static void note_pair(const char *text, const char *number)
{
    tap_write("# ");
    tap_write(text);
    tap_write(" ");
    tap_write(number);
    tap_write("\n");
}

void tap_note_number(const char *text, float value)
{
    char number[DECIMAL_SIZE_MAX];

    (void)decimal_format_f32(value, DECIMAL_DIGITS_EXACT, number);
    note_pair(text, number);
}

void tap_note_bits(const char *text, uint32_t bits)
{
    char number[DECIMAL_SIZE_MAX];

    (void)decimal_format_hex32(bits, number);
    note_pair(text, number);
}

bool tap_is_hosted(void) { return __STDC_HOSTED__ == 1; }

uint32_t tap_random(uint32_t *state)
{
    *state ^= *state << 13;
    *state ^= *state >> 17;
    *state ^= *state << 5;
    return *state;
}

int tap_finish(void)
{
    tap_write("1..");
    write_count(claims);
    tap_write("\n");
    if (failures > 0u) {
        tap_write("# failed: ");
        write_count(failures);
        tap_write("\n");
    }
    return claims > 0u && failures == 0u ? 0 : 1;
}
