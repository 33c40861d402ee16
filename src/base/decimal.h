/* Numbers as text, exactly: both directions are correctly rounded (to nearest, ties to even) by integer arithmetic
 * alone, so host and target read and print the same bits. Nine significant digits carry every float through text
 * unchanged. */
#ifndef BASE_DECIMAL_H
#define BASE_DECIMAL_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum {
    DECIMAL_DIGITS_EXACT = 9, /* significant digits that tell any two floats apart */
    DECIMAL_SIZE_MAX = 24     /* characters that one number may take, with the closing 0 */
};

/* Reads all of text[0..length) as one number: [+-] digits [. digits] [e|E [+-] digits], at least one digit before the
 * exponent, on either side of the point. Returns false, and leaves *value as it was, for anything else (also nan, inf,
 * blanks, an empty text) and for a magnitude that rounds beyond the largest float. What is too small becomes a
 * subnormal or 0. [MAIN] */
bool decimal_parse_f32(const char *text, size_t length, float *value);

/* Reads all of text as an unsigned decimal integer; false if it is none or exceeds 2^64 - 1. [MAIN] */
bool decimal_parse_u64(const char *text, size_t length, uint64_t *value);

/* Each of these writes a 0-terminated text of at most DECIMAL_SIZE_MAX bytes and returns its length without the 0.
 * Plain notation where the decimal exponent lies in -5..digits (0.00012, 1500), else d.ddde-07. No trailing zeros.
 * NaN gives nan, infinities inf and -inf, negative zero -0. Digits outside 1..9 count as the nearest of these. [MAIN]
 */
size_t decimal_format_f32(float value, unsigned digits, char *out);

/* The fewest digits that read back as the same float: 0.3, not 0.300000012. */
size_t decimal_format_shortest(float value, char *out);

/* count * unit, rounded once: the time of a step counter stays exact where a float product would not. */
size_t decimal_format_product(uint64_t count, float unit, unsigned digits, char *out);

size_t decimal_format_u64(uint64_t value, char *out);

/* Eight lower-case hexadecimal digits. */
size_t decimal_format_hex32(uint32_t value, char *out);

#endif
