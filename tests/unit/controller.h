/* A controller at the other end of the bench's link: a request is said field by field, its reply read field by field.
 *
 *     say(LINK_STAGE, sequence, step);
 *     bytes_put_u8(&fields, index);
 *     bytes_put_f32(&fields, 3.0f);
 *     tap_check(is_answered() && bytes_get_u8(&answer) == index, "staged");
 */
#ifndef CONTROLLER_H
#define CONTROLLER_H

#include <stdbool.h>
#include <stdint.h>

#include "base/bytes.h"
#include "base/errors.h"
#include "bench.h"

extern struct bench_frame request, reply;
extern struct bytes_writer fields; /* of the request */
extern struct bytes_reader answer; /* of the reply */

/* Starts a request. */
void say(enum link_message type, uint16_t sequence, uint32_t step);

/* Sends it. True if it is answered by its own reply. */
bool is_answered(void);

/* Sends it. True if it is refused for this reason, with these particulars; then the range can be asked for. */
bool is_refused(enum error error, uint8_t index, uint32_t expected);
bool has_range(float low, float high);

/* A whole request without fields. */
bool is_done(enum link_message type);

/* Does the text hold " key=value", as the console writes a float? */
bool holds_value(const char *text, const char *key, float value);
bool holds_setting(const char *text, const char *key, float value); /* as it writes a parameter */

/* The place of a parameter in its table; a preset by name. */
uint8_t index_of(const char *symbol, size_t length);
bool load_preset(const char *name, size_t length);

#endif
