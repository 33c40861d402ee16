/* The console's line: every line that is typed has one answer, and what comes out is text in lines. */
#include <string.h>

#include "firmware.h"
#include "watch_parts.h"

enum { TYPED_MAX = 240, START_MAX = 8 };

static struct {
    char typed[TYPED_MAX];
    size_t length;
    bool is_too_long, is_damaged, was_cr;
    uint32_t answered_before, lines; /* that want an answer */

    uint8_t last;          /* byte that came out */
    char start[START_MAX]; /* of the line that comes out */
    size_t column;
    uint32_t answers, samples;
    bool has_echo; /* or had: what comes out may be what was typed */
} seen;

void watch_console_reset(void)
{
    memset(&seen, 0, sizeof seen);
    seen.answered_before = firmware.console->lines;
}

void watch_console_lost(void)
{
    seen.is_damaged = true;
    seen.was_cr = false;
}

static bool is_blank(void)
{
    for (size_t i = 0u; i < seen.length; i++) {
        if (seen.typed[i] != ' ') {
            return false;
        }
    }
    return true;
}

static void end_typed(void)
{
    if (seen.is_damaged || seen.is_too_long || !is_blank()) {
        seen.lines++;
    }
    seen.length = 0u;
    seen.is_damaged = seen.is_too_long = false;
}

static void type(uint8_t byte)
{
    const bool is_print = (byte >= ' ' && byte < 0x7f) || byte == '\t';

    if (byte == '\b' || byte == 0x7f) {
        seen.length -= seen.length > 0u ? 1u : 0u;
    } else if (!is_print) {
        seen.is_damaged = seen.is_damaged || byte != 0x04 || seen.length > 0u;
    } else if (seen.length == TYPED_MAX) {
        seen.is_too_long = true;
    } else {
        seen.typed[seen.length++] = byte == '\t' ? ' ' : (char)byte;
    }
}

void watch_console_taken(const uint8_t *bytes, size_t size)
{
    for (size_t i = 0u; i < size; i++) {
        const bool is_second = bytes[i] == '\n' && seen.was_cr;

        seen.was_cr = bytes[i] == '\r';
        if (is_second) {
            continue;
        }
        if (bytes[i] == '\r' || bytes[i] == '\n') {
            end_typed();
        } else {
            type(bytes[i]);
        }
    }
}

static bool starts(const char *part) { return strncmp(seen.start, part, strlen(part)) == 0; }

static void end_line(void)
{
    memset(seen.start + (seen.column < START_MAX ? seen.column : START_MAX), 0,
           seen.column < START_MAX ? START_MAX - seen.column : 0u);
    seen.answers += starts("ok ") || starts("error ") ? 1u : 0u;
    seen.samples += (seen.start[0] >= '0' && seen.start[0] <= '9') || starts(">step:") ? 1u : 0u;
    seen.column = 0u;
}

/* Printable text, a paragraph sign, a rub out, and line ends that are whole. */
static bool may_follow(uint8_t byte)
{
    if (seen.last == '\r' || byte == '\n') {
        return seen.last == '\r' && byte == '\n';
    }
    if (seen.last == 0xc2u || byte == 0xa7u) {
        return seen.last == 0xc2u && byte == 0xa7u;
    }
    return (byte >= ' ' && byte < 0x7fu) || byte == '\r' || byte == 0xc2u || (byte == '\b' && seen.has_echo);
}

void watch_console_sent(const uint8_t *bytes, size_t size)
{
    seen.has_echo = seen.has_echo || firmware.console->line.has_echo;
    for (size_t i = 0u; i < size; i++) {
        WATCH(may_follow(bytes[i]));
        seen.last = bytes[i];
        if (bytes[i] == '\n') {
            end_line();
        } else if (bytes[i] != '\r') {
            if (seen.column < START_MAX) {
                seen.start[seen.column] = (char)bytes[i];
            }
            seen.column++;
        }
    }
}

bool watch_console_end(uint32_t *samples)
{
    WATCH(firmware.console->lines - seen.answered_before == seen.lines);
    WATCH(seen.has_echo || seen.answers == seen.lines);
    *samples = seen.samples;
    return !seen.has_echo;
}
