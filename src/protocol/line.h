/* Bytes become lines. A line is printable ASCII of at most LINE_LENGTH_MAX characters; tab counts as a blank, backspace
 * and delete rub out, CR, LF and CR LF end it. Lines of blanks alone are none. EOT says that no line will follow. What
 * is typed is echoed into the output. */
#ifndef PROTOCOL_LINE_H
#define PROTOCOL_LINE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/text.h"

enum { LINE_LENGTH_MAX = 240 };

enum line_state {
    LINE_OPEN,     /* goes on */
    LINE_DONE,     /* bytes holds it */
    LINE_TOO_LONG, /* ended, and more was typed than fits */
    LINE_DAMAGED,  /* ended, and holds bytes that are no text, or has lost some */
    LINE_LAST      /* there will be no more; a line in progress stays open, and damaged */
};

struct line {
    char bytes[LINE_LENGTH_MAX + 1]; /* 0-terminated when done; valid until the next byte */
    size_t length;
    bool has_echo;       /* what is typed is sent back */
    bool is_half_echoed; /* the cursor stands behind an unfinished line */
    bool is_too_long, is_damaged, was_cr;
    uint32_t garbage; /* bytes that are no text, so far */
};

/* Empty, with echo. [INIT] */
void line_init(struct line *line);

/* Takes one byte; its echo, at most three bytes, goes to text. [MAIN] */
enum line_state line_take(struct line *line, uint8_t byte, struct text *text);

/* Bytes of the line in progress were lost on the way. [MAIN] */
void line_damage(struct line *line);

/* Something else is about to be written: an unfinished echo gets a line of its own. [MAIN] */
void line_make_way(struct line *line, struct text *text);

#endif
