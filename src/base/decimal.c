/* Every conversion scales one exact integer by a power of ten and rounds once.
 * The usual numbers of a stream take one or two words there and no division at all; the extremes take the same path
 * with more words. */
#include "base/decimal.h"

#include "base/big.h"
#include "base/fmath.h"

enum {
    /* Halfway between two floats lies a number of at most 113 significant digits. Digits beyond them cannot move a text
     * across such a point; they only tell whether it lies on one or above. */
    DIGITS_KEPT = 113,
    SIGNIFICAND_BITS = 24,
    EXPONENT_MIN = -149, /* of the last place of a subnormal */
    POWER_MAX = 38,      /* 10^39 is beyond the largest float */
    POWER_MIN = -160,    /* 113 digits times this are below half the smallest float */
    TYPED_EXPONENT_MAX = 1000000
};

#define FLOAT_SIGN 0x80000000u
#define FLOAT_INFINITE 0x7f800000u
#define FLOAT_FRACTION 0x007fffffu

/* value * 10^power */
struct digits {
    uint32_t value;
    int power;
};

static const uint32_t powers_of_ten[] = {1u,      10u,      100u,      1000u,      10000u,
                                         100000u, 1000000u, 10000000u, 100000000u, 1000000000u};

/* The bits of the float nearest to big * 10^power; FLOAT_INFINITE or more if that is beyond the largest. */
static uint32_t nearest_float(struct big *big, int power)
{
    if (big->count == 0u || power < POWER_MIN) {
        return 0u;
    }
    if (power > POWER_MAX) {
        return FLOAT_INFINITE;
    }
    big_scale(big, power);

    const int normal = big->exponent + (int)big_length(big) - SIGNIFICAND_BITS;
    const int exponent = normal > EXPONENT_MIN ? normal : EXPONENT_MIN;

    if (exponent > 104) {
        return FLOAT_INFINITE;
    }
    /* A normal significand brings its leading bit along, which counts the exponent field up by the one that lacks. */
    return ((uint32_t)(exponent - EXPONENT_MIN) << 23) + big_round(big, exponent);
}

/* Decimal exponent of a magnitude, or one less: log2(1 + f) >= f, and log10 from it by constants rounded down. */
static int big_power_estimate(const struct big *big)
{
    const unsigned length = big_length(big);
    const uint32_t fraction = length > 17u ? big_bits_at(big, length - 17u) : big->words[0] << (17u - length);
    /* log2 with 16 bits behind the point, of 10^60 times the magnitude so that it is positive: log2(10^60) = 199.3157
     */
    const uint32_t log2_raw = ((uint32_t)(big->exponent + (int)length - 1 + 199) << 16) + (fraction & 0xffffu) + 20688u;

    return (int)((uint64_t)log2_raw * 1292913986u >> 48) - 60; /* log10(2) * 2^32 */
}

/* The nearest number of so many digits to count * significand * 2^exponent, which is not 0. */
static struct digits nearest_digits(uint64_t count, uint32_t significand, int exponent, unsigned digits)
{
    struct digits result = {0u, 0};
    struct big big;

    big_set(&big, count, exponent);
    big_multiply_add(&big, significand, 0u);
    result.power = big_power_estimate(&big) - (int)digits + 1;
    big_scale(&big, -result.power);
    result.value = big_round(&big, 0);
    if (result.value >= powers_of_ten[digits]) { /* the estimate was one less, or nines were rounded up */
        big_set(&big, count, exponent);
        big_multiply_add(&big, significand, 0u);
        result.power++;
        big_scale(&big, -result.power);
        result.value = big_round(&big, 0);
    }
    return result;
}

static uint32_t significand_of(uint32_t bits)
{
    return (bits & FLOAT_FRACTION) + ((bits & FLOAT_INFINITE) != 0u ? FLOAT_FRACTION + 1u : 0u);
}

static int exponent_of(uint32_t bits)
{
    const int field = (int)((bits & FLOAT_INFINITE) >> 23);

    return EXPONENT_MIN + (field > 0 ? field - 1 : 0);
}

static size_t write_text(char *out, const char *text)
{
    size_t length = 0u;

    for (; text[length] != '\0'; length++) {
        out[length] = text[length];
    }
    out[length] = '\0';
    return length;
}

/* Lays the digits out; point_max is the largest decimal exponent in plain notation. */
static size_t write_digits(char *out, bool is_negative, struct digits number, int point_max)
{
    char figures[10];
    int count = 0;
    char *end = out;

    while (number.value % 10u == 0u) {
        number.value /= 10u;
        number.power++;
    }
    while (powers_of_ten[count] <= number.value) {
        count++;
    }
    for (int i = count; i-- > 0; number.value /= 10u) {
        figures[i] = (char)('0' + number.value % 10u);
    }

    const int first = number.power + count - 1; /* the decimal exponent */
    const bool is_plain = first >= -5 && first <= point_max;
    const int shift = is_plain ? 0 : first;
    const int high = first - shift > 0 ? first - shift : 0;
    const int low = number.power - shift < 0 ? number.power - shift : 0;

    if (is_negative) {
        *end++ = '-';
    }
    for (int place = high; place >= low; place--) {
        const int index = first - shift - place;

        if (place == -1) {
            *end++ = '.';
        }
        *end++ = index >= 0 && index < count ? figures[index] : '0';
    }
    if (!is_plain) {
        *end++ = 'e';
        *end++ = first < 0 ? '-' : '+';
        *end++ = (char)('0' + (first < 0 ? -first : first) / 10);
        *end++ = (char)('0' + (first < 0 ? -first : first) % 10);
    }
    *end = '\0';
    return (size_t)(end - out);
}

static bool is_digit(char symbol) { return symbol >= '0' && symbol <= '9'; }

/* Reads digits [. digits] from *text into big * 10^power, and moves *text behind them. False without a digit. */
static bool parse_digits(const char **text, const char *end, struct big *big, int *power)
{
    bool has_digit = false;
    bool is_behind_point = false;
    unsigned kept = 0u;

    for (; *text < end && (is_digit(**text) || (**text == '.' && !is_behind_point)); (*text)++) {
        if (**text == '.') {
            is_behind_point = true;
            continue;
        }
        has_digit = true;
        if (kept < DIGITS_KEPT) {
            big_multiply_add(big, 10u, (uint32_t)(**text - '0'));
            kept += big->count > 0u ? 1u : 0u; /* leading zeros do not count */
            *power -= is_behind_point ? 1 : 0;
        } else {
            big->is_inexact |= **text != '0';
            *power += is_behind_point ? 0 : 1;
        }
    }
    return has_digit;
}

static bool parse_sign(const char **text, const char *end)
{
    const bool is_negative = *text < end && **text == '-';

    if (is_negative || (*text < end && **text == '+')) {
        (*text)++;
    }
    return is_negative;
}

/* Reads [+-] digits up to the end and adds them to *power. */
static bool parse_exponent(const char *text, const char *end, int *power)
{
    const bool is_negative = parse_sign(&text, end);
    int exponent = 0;

    if (text == end) {
        return false;
    }
    for (; text < end; text++) {
        if (!is_digit(*text)) {
            return false;
        }
        exponent = exponent < TYPED_EXPONENT_MAX ? 10 * exponent + (*text - '0') : exponent;
    }
    *power += is_negative ? -exponent : exponent;
    return true;
}

bool decimal_parse_f32(const char *text, size_t length, float *value)
{
    const char *const end = text + length;
    const bool is_negative = parse_sign(&text, end);
    struct big big;
    int power = 0;

    big_set(&big, 0u, 0);
    if (!parse_digits(&text, end, &big, &power)) {
        return false;
    }
    if (text < end && ((*text != 'e' && *text != 'E') || !parse_exponent(text + 1, end, &power))) {
        return false;
    }

    const uint32_t bits = nearest_float(&big, power);

    if (bits >= FLOAT_INFINITE) {
        return false;
    }
    *value = fmath_from_bits(bits | (is_negative ? FLOAT_SIGN : 0u));
    return true;
}

bool decimal_parse_u64(const char *text, size_t length, uint64_t *value)
{
    uint64_t sum = 0u;

    for (size_t i = 0u; i < length; i++) {
        const uint32_t digit = (uint32_t)(text[i] - '0');

        if (!is_digit(text[i]) || sum > UINT64_MAX / 10u || 10u * sum > UINT64_MAX - digit) {
            return false;
        }
        sum = 10u * sum + digit;
    }
    if (length == 0u) {
        return false;
    }
    *value = sum;
    return true;
}

size_t decimal_format_product(uint64_t count, float unit, unsigned digits, char *out)
{
    const uint32_t bits = fmath_bits(unit);
    const bool is_negative = (bits & FLOAT_SIGN) != 0u;

    if ((bits & ~FLOAT_SIGN) > FLOAT_INFINITE) {
        return write_text(out, "nan");
    }
    if ((bits & ~FLOAT_SIGN) == FLOAT_INFINITE) {
        return write_text(out, is_negative ? "-inf" : "inf");
    }
    if (count == 0u || (bits & ~FLOAT_SIGN) == 0u) {
        return write_text(out, is_negative ? "-0" : "0");
    }
    digits = digits < 1u ? 1u : digits > DECIMAL_DIGITS_EXACT ? DECIMAL_DIGITS_EXACT : digits;
    return write_digits(out, is_negative, nearest_digits(count, significand_of(bits), exponent_of(bits), digits),
                        (int)digits);
}

size_t decimal_format_f32(float value, unsigned digits, char *out)
{
    return decimal_format_product(1u, value, digits, out);
}

static bool reads_back(struct digits number, uint32_t bits)
{
    struct big big;

    big_set(&big, number.value, 0);
    return nearest_float(&big, number.power) == bits;
}

size_t decimal_format_shortest(float value, char *out)
{
    const uint32_t bits = fmath_bits(value) & ~FLOAT_SIGN;

    if (bits == 0u || bits >= FLOAT_INFINITE) {
        return decimal_format_f32(value, DECIMAL_DIGITS_EXACT, out);
    }
    for (unsigned digits = 1u;; digits++) {
        struct digits number = nearest_digits(1u, significand_of(bits), exponent_of(bits), digits);
        bool is_found = reads_back(number, bits) || digits == DECIMAL_DIGITS_EXACT;

        /* Floats lie twice as close below a power of two as above it: the farther neighbour above may be the near one.
         */
        if (!is_found && (bits & FLOAT_FRACTION) == 0u) {
            number.value++;
            is_found = reads_back(number, bits);
        }
        if (is_found) {
            return write_digits(out, (fmath_bits(value) & FLOAT_SIGN) != 0u, number, DECIMAL_DIGITS_EXACT);
        }
    }
}

size_t decimal_format_u64(uint64_t value, char *out)
{
    char reversed[DECIMAL_SIZE_MAX];
    size_t count = 0u;
    size_t length = 0u;
    struct big big;

    big_set(&big, value, 0);
    do {
        uint32_t group = big_divide(&big, 10000u);

        for (unsigned i = 0u; i < 4u; i++, group /= 10u) {
            reversed[count++] = (char)('0' + group % 10u);
        }
    } while (big.count > 0u);
    while (count > 1u && reversed[count - 1u] == '0') {
        count--;
    }
    while (count > 0u) {
        out[length++] = reversed[--count];
    }
    out[length] = '\0';
    return length;
}

size_t decimal_format_hex32(uint32_t value, char *out)
{
    for (unsigned i = 8u; i-- > 0u; value >>= 4) {
        out[i] = "0123456789abcdef"[value & 0xfu];
    }
    out[8] = '\0';
    return 8u;
}
