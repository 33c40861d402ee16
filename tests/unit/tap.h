/* Test Anything Protocol, freestanding: the same tests run on the host and on a board.
 *
 * A platform supplies main(), which calls unit_main(), and the two functions marked so below. */
#ifndef TAP_H
#define TAP_H

#include <stdbool.h>
#include <stdint.h>

/* Supplied by the platform: writes a 0-terminated text to the test's output and waits until it is there.
 * base_assert_failed() of base/assert.h is its other duty: report, and end with a failure. */
void tap_write(const char *text);

/* Runs every test of tests.def, prints the plan, and returns the exit code: 0 if all claims held. */
int unit_main(void);

/* Names the module that the next claims are about. */
void tap_module(const char *name);

/* One claim, and whether it holds. Returns ok. */
#define tap_check(ok, claim) tap_check_at((ok), (claim), __FILE__, __LINE__)
bool tap_check_at(bool ok, const char *claim, const char *file, unsigned line);

/* One claim about a number: |actual - expected| <= tolerance, which NaN never fulfils. */
#define tap_check_close(actual, expected, tolerance, claim) \
    tap_check_close_at((actual), (expected), (tolerance), (claim), __FILE__, __LINE__)
bool tap_check_close_at(float actual, float expected, float tolerance, const char *claim, const char *file,
                        unsigned line);

/* One claim about a 0-terminated text. */
#define tap_check_text(actual, expected, claim) tap_check_text_at((actual), (expected), (claim), __FILE__, __LINE__)
bool tap_check_text_at(const char *actual, const char *expected, const char *claim, const char *file, unsigned line);

/* Diagnosis in a line of its own, without influence on the result. */
void tap_note(const char *text);
void tap_note_number(const char *text, float value);
void tap_note_bits(const char *text, uint32_t bits);

/* True where the machine is fast: loops over random cases may be a hundred times as long. */
bool tap_is_hosted(void);

/* The next of a fixed sequence of random words (Marsaglia's xorshift32); *state starts anywhere but at 0. */
uint32_t tap_random(uint32_t *state);

/* Prints the plan and returns the exit code. */
int tap_finish(void);

#endif
