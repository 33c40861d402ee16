/* The line editor. */
#include "protocol/line.h"

enum { END_OF_TEXT = 0x04, BACKSPACE = 0x08, RUBOUT = 0x7f };

static void open_line(struct line *line)
{
    line->length = 0u;
    line->is_too_long = false;
    line->is_damaged = false;
}

void line_init(struct line *line) { *line = (struct line){.has_echo = true}; }

/* A line feed that comes now may end what was lost. */
void line_damage(struct line *line)
{
    line->is_damaged = true;
    line->was_cr = false;
}

void line_make_way(struct line *line, struct text *text)
{
    if (line->is_half_echoed) {
        text_end_line(text);
        line->is_half_echoed = false;
    }
}

static bool is_blank(const struct line *line)
{
    for (size_t i = 0u; i < line->length; i++) {
        if (line->bytes[i] != ' ') {
            return false;
        }
    }
    return true;
}

static enum line_state end_line(struct line *line, struct text *text)
{
    enum line_state state = LINE_DONE;

    if (line->is_damaged) {
        state = LINE_DAMAGED;
    } else if (line->is_too_long) {
        state = LINE_TOO_LONG;
    } else if (is_blank(line)) {
        state = LINE_OPEN;
    }
    if (line->has_echo) {
        text_end_line(text);
    }
    line->is_half_echoed = false;
    line->bytes[line->length] = '\0';
    open_line(line);
    return state;
}

static void rub_out(struct line *line, struct text *text)
{
    if (line->length == 0u) {
        return;
    }
    line->length--;
    if (line->has_echo) {
        text_write(text, "\b \b");
    }
}

static void append(struct line *line, char symbol, struct text *text)
{
    if (line->length == LINE_LENGTH_MAX) {
        line->is_too_long = true;
        return;
    }
    line->bytes[line->length++] = symbol;
    if (line->has_echo) {
        text_put(text, symbol);
        line->is_half_echoed = true;
    }
}

enum line_state line_take(struct line *line, uint8_t byte, struct text *text)
{
    const bool was_cr = line->was_cr;

    line->was_cr = byte == '\r';
    if (byte == '\n' && was_cr) {
        return LINE_OPEN;
    }
    if (byte == '\r' || byte == '\n') {
        return end_line(line, text);
    }
    if (byte == BACKSPACE || byte == RUBOUT) {
        rub_out(line, text);
    } else if (byte == '\t') {
        append(line, ' ', text);
    } else if (byte >= ' ' && byte < RUBOUT) {
        append(line, (char)byte, text);
    } else if (byte != END_OF_TEXT || line->length > 0u) {
        line->garbage++;
        line->is_damaged = true;
    }
    return byte == END_OF_TEXT ? LINE_LAST : LINE_OPEN;
}
