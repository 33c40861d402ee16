/* Numbers as text: the extremes, the points halfway between floats, and random floats there and back. */
#include "base/decimal.h"

#include <float.h>

#include "base/fmath.h"
#include "tap.h"
#include "tests.h"

static size_t length_of(const char *text)
{
    size_t length = 0u;

    while (text[length] != '\0') {
        length++;
    }
    return length;
}

static bool reads_bits(const char *text, uint32_t bits)
{
    float value = -77.0f;
    const bool ok = decimal_parse_f32(text, length_of(text), &value) && fmath_bits(value) == bits;

    if (!ok) {
        tap_note(text);
        tap_note_bits("read as", fmath_bits(value));
    }
    return ok;
}

static bool reads(const char *text, float value) { return reads_bits(text, fmath_bits(value)); }

static bool is_refused(const char *text)
{
    float value = -77.0f;
    const bool ok = !decimal_parse_f32(text, length_of(text), &value) && value == -77.0f;

    if (!ok) {
        tap_note(text);
    }
    return ok;
}

static void check_parse_form(void)
{
    static const char *const refused[] = {"",    "+",     "-",    ".",   "-.",   "e5",  "1e",    "1e+",
                                          "1e-", "1.2.3", " 1",   "1 ",  "nan",  "inf", "0x1",   "1,5",
                                          "--1", "1e1.5", "1e 5", "+-1", "1e5x", "1-",  "1e5e5", ".e1"};
    bool ok = true;

    tap_check(reads("0.3", 0.3f) && reads("+1500", 1500.0f) && reads("-2.5e-3", -2.5e-3f) && reads("1e8", 1e8f) &&
                  reads("1E+08", 1e8f) && reads(".5", 0.5f) && reads("5.", 5.0f) && reads("007", 7.0f),
              "every form of a number is read");
    tap_check(reads_bits("0", 0u) && reads_bits("-0.000", 0x80000000u) && reads_bits("0e999999999999", 0u),
              "zero keeps its sign, whatever its exponent");
    for (unsigned i = 0u; i < sizeof(refused) / sizeof(refused[0]); i++) {
        ok = is_refused(refused[i]) && ok;
    }
    tap_check(ok, "what is no number is refused and the value left alone");
    ok = true;
    for (size_t length = 0u; length <= 6u; length++) {
        float value = 0.0f;

        ok = ok && decimal_parse_f32("123456", length, &value) == (length > 0u);
        ok = ok && (length != 3u || value == 123.0f);
    }
    tap_check(ok, "the text ends where its length says, not at a 0");
}

static void check_parse_range(void)
{
    tap_check(reads("3.4028234663852886e38", FLT_MAX) && reads("3.40282356779733661637539395458e38", FLT_MAX),
              "the largest float, and what still rounds to it");
    tap_check(is_refused("3.40282356779733661637539395458142568448e38") && is_refused("-3.5e38") &&
                  is_refused("1e39") && is_refused("1e999999999999") && is_refused("1e4294967296"),
              "half a unit beyond it and everything larger is refused");
    tap_check(reads_bits("1.17549435e-38", 0x00800000u) && reads_bits("1.1754942e-38", 0x007fffffu),
              "the smallest normal and the largest subnormal");
    tap_check(reads_bits("1.4e-45", 1u) && reads_bits("-1e-45", 0x80000001u) && reads_bits("1e-50", 0u) &&
                  reads_bits("-1e-999999999999", 0x80000000u),
              "the smallest subnormal, and zero below it");
}

/* Texts that lie on, right below and right above the point halfway between two floats. */
static void check_parse_ties(void)
{
    tap_check(reads("16777217", 16777216.0f) && reads("16777219", 16777220.0f), "a tie goes to the even neighbour");
    tap_check(reads("16777217.000000000000000000000000000000000000000000000000001", 16777218.0f) &&
                  reads("16777216.999999999999999999999999999999999999999999999999999", 16777216.0f),
              "the least excess decides otherwise");
    /* 2^-150, half the smallest float, has 105 digits; the largest number of digits needed is 113. */
    tap_check(
        reads_bits("7.0064923216240853546186479164495806564013097093825788587853414193489554134293720358654e-46", 0u) &&
            reads_bits("7.006492321624085354618647916449580656401309709382578858785341419448955413429304e-46", 1u),
        "half the smallest float and a little less or more");
    tap_check(
        reads_bits("0.000000000000000000000000000000000000000000000700649232162408535461864791644958065640130970938"
                   "257885878534141944895541342930300743319094181060791015625",
                   0u) &&
            reads_bits("0.00000000000000000000000000000000000000000000070064923216240853546186479164495806564013097"
                       "0938257885878534141944895541342930300743319094181060791015625000000000000001",
                       1u),
        "exactly half the smallest float is a tie, and a digit far behind it is none");
    tap_check(reads("9007199791611904000000000000000000000e-21", 9.0071996e15f) && reads("1e10", 1e10f) &&
                  reads("123456789012345678901234567890", 1.2345679e29f) &&
                  reads("0.0000000000000000000000000000000000000123456789e10", 1.23456789e-28f),
              "long digits and exponents that cancel");
}

static bool writes(float value, unsigned digits, const char *expected)
{
    char text[DECIMAL_SIZE_MAX];
    const size_t length = decimal_format_f32(value, digits, text);
    unsigned i = 0u;

    while (text[i] != '\0' && text[i] == expected[i]) {
        i++;
    }
    if (text[i] != expected[i] || length != length_of(expected)) {
        tap_note(text);
        tap_note(expected);
        return false;
    }
    return true;
}

static void check_format(void)
{
    tap_check(writes(0.0f, 9u, "0") && writes(-0.0f, 9u, "-0") && writes(fmath_from_bits(0x7fc00000u), 9u, "nan") &&
                  writes(fmath_from_bits(0x7f800000u), 6u, "inf") && writes(fmath_from_bits(0xff800000u), 6u, "-inf"),
              "zeros, nan and infinities");
    tap_check(writes(0.3f, 9u, "0.300000012") && writes(0.3f, 6u, "0.3") && writes(-1500.0f, 9u, "-1500") &&
                  writes(123456.789f, 9u, "123456.789") && writes(1.0f, 1u, "1"),
              "plain numbers without trailing zeros");
    tap_check(writes(0.00012f, 6u, "0.00012") && writes(0.0000125f, 6u, "0.0000125") &&
                  writes(1.25e-6f, 6u, "1.25e-06"),
              "small numbers turn to an exponent below 1e-5");
    tap_check(writes(1e6f, 6u, "1000000") && writes(1e7f, 6u, "1e+07") && writes(1e9f, 9u, "1000000000") &&
                  writes(17179869184.0f, 9u, "1.71798692e+10"),
              "large ones above as many places as digits");
    tap_check(writes(FLT_MAX, 9u, "3.40282347e+38") && writes(-FLT_MIN, 9u, "-1.17549435e-38") &&
                  writes(fmath_from_bits(1u), 9u, "1.40129846e-45") && writes(fmath_from_bits(1u), 1u, "1e-45"),
              "the extremes");
    tap_check(writes(0.5f, 0u, "0.5") && writes(0.3f, 99u, "0.300000012"), "digits out of range become 1 or 9");
    tap_check(writes(2.5f, 1u, "2") && writes(3.5f, 1u, "4") && writes(0.125f, 2u, "0.12") &&
                  writes(0.375f, 2u, "0.38") && writes(1048576.5f, 7u, "1048576") && writes(2.50000024f, 1u, "3") &&
                  writes(25e9f, 1u, "2e+10") && writes(35e9f, 1u, "4e+10"),
              "ties go to the even digit, a little more does not");
    tap_check(writes(9.9999995f, 6u, "10") && writes(999999.9f, 6u, "1000000") && writes(0.00099999999f, 3u, "0.001"),
              "nines carry into the next power of ten");
}

static void check_shortest(void)
{
    char text[DECIMAL_SIZE_MAX];

    (void)decimal_format_shortest(0.3f, text);
    tap_check_text(text, "0.3", "0.3 is written as such");
    (void)decimal_format_shortest(-1e8f, text);
    tap_check_text(text, "-100000000", "so is a stiffness");
    (void)decimal_format_shortest(16777216.0f, text);
    tap_check_text(text, "16777216", "eight digits where they are needed");
    (void)decimal_format_shortest(fmath_from_bits(0x00000001u), text);
    tap_check_text(text, "1e-45", "one digit for the smallest float");
    (void)decimal_format_shortest(fmath_from_bits(0x0f800000u), text);
    tap_check_text(text, "1.2621775e-29", "2^-96, to which 1.2621774e-29 is nearer but does not read back");
    (void)decimal_format_shortest(-0.0f, text);
    tap_check_text(text, "-0", "negative zero");
}

static void check_product(void)
{
    char text[DECIMAL_SIZE_MAX];

    (void)decimal_format_product(UINT64_MAX, 1.0f, 9u, text);
    tap_check_text(text, "1.84467441e+19", "a large count");
    (void)decimal_format_product(123456789u, 1e-5f, 9u, text);
    tap_check_text(text, "1234.56786", "a step count times a step of 9.99999975e-06");
    (void)decimal_format_product(16777217u, 3.0f, 9u, text);
    tap_check_text(text, "50331651", "a product that no float holds");
    (void)decimal_format_product(UINT64_MAX, FLT_MAX, 9u, text);
    tap_check_text(text, "6.27710136e+57", "the largest product of all");
    (void)decimal_format_product(0u, 0.5f, 9u, text);
    tap_check_text(text, "0", "nothing");
    (void)decimal_format_product(3u, fmath_from_bits(1u), 9u, text);
    tap_check_text(text, "4.20389539e-45", "subnormal units");
}

static void check_integers(void)
{
    static const char *const refused[] = {"", "-1", "+1", "1.0", "18446744073709551616", "99999999999999999999", "1 "};
    char text[DECIMAL_SIZE_MAX];
    uint64_t value = 77u;
    bool ok = true;

    (void)decimal_format_u64(UINT64_MAX, text);
    tap_check_text(text, "18446744073709551615", "the largest integer");
    tap_check(decimal_parse_u64(text, length_of(text), &value) && value == UINT64_MAX, "is read back");
    (void)decimal_format_u64(0u, text);
    tap_check_text(text, "0", "zero is one digit");
    (void)decimal_format_u64(10000u, text);
    tap_check_text(text, "10000", "inner zeros stay");
    (void)decimal_format_u64(UINT64_C(4294967296), text);
    tap_check_text(text, "4294967296", "one more than a word");
    value = 77u;
    for (unsigned i = 0u; i < sizeof(refused) / sizeof(refused[0]); i++) {
        ok = ok && !decimal_parse_u64(refused[i], length_of(refused[i]), &value) && value == 77u;
    }
    tap_check(ok, "what is no unsigned integer of 64 bits is refused");
    (void)decimal_format_hex32(0x1a2b3c4fu, text);
    tap_check_text(text, "1a2b3c4f", "hexadecimal digits");
}

static void check_round_trips(void)
{
    const unsigned count = tap_is_hosted() ? 200000u : 2000u;
    uint32_t state = 2463534242u;
    bool is_exact = true;
    bool is_shortest = true;
    bool is_short_enough = true;

    for (unsigned i = 0u; i < count && is_exact && is_shortest; i++) {
        const uint32_t bits = tap_random(&state);
        char text[DECIMAL_SIZE_MAX];
        float value;
        size_t length;

        if (!fmath_is_finite(fmath_from_bits(bits))) {
            continue;
        }
        length = decimal_format_f32(fmath_from_bits(bits), DECIMAL_DIGITS_EXACT, text);
        is_short_enough = is_short_enough && length < DECIMAL_SIZE_MAX;
        is_exact = decimal_parse_f32(text, length, &value) && fmath_bits(value) == bits;
        if (i % 16u == 0u) {
            length = decimal_format_shortest(fmath_from_bits(bits), text);
            is_shortest = decimal_parse_f32(text, length, &value) && fmath_bits(value) == bits;
        }
        if (!is_exact || !is_shortest) {
            tap_note_bits("float", bits);
            tap_note(text);
        }
    }
    tap_check(is_exact, "random floats survive nine digits");
    tap_check(is_shortest, "and their shortest text");
    tap_check(is_short_enough, "no text is longer than promised");
}

void test_decimal(void)
{
    check_parse_form();
    check_parse_range();
    check_parse_ties();
    check_format();
    check_shortest();
    check_product();
    check_integers();
    check_round_trips();
}
