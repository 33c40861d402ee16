/* Everything that is counted, and who is speaking. */
#ifndef PROTOCOL_STATUS_H
#define PROTOCOL_STATUS_H

#include <stdint.h>

#include "base/text.h"
#include "protocol/console.h"
#include "sim/executive.h"

/* Fields " key=value" of the answers. [MAIN] */
void status_write(struct text *text, const struct console *console, const struct executive_report *report);
void status_write_id(struct text *text, const struct console *console);

#endif
