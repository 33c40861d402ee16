/* The line editor. */
#include "protocol/line.h"

#include "bench.h"
#include "tap.h"
#include "tests.h"

static struct line line;
static struct text echo;
static uint8_t storage[1024];

static void open_line(void)
{
    line_init(&line);
    text_init(&echo, storage, sizeof storage);
}

/* The state after the last byte. */
static enum line_state type(const char *bytes)
{
    enum line_state state = LINE_OPEN;

    for (; *bytes != '\0'; bytes++) {
        state = line_take(&line, (uint8_t)*bytes, &echo);
    }
    return state;
}

static bool echoed(const char *expected)
{
    size_t size;
    const uint8_t *bytes = text_peek(&echo, &size);
    bool ok = true;

    for (size_t i = 0u; i < size; i++) {
        ok = ok && expected[i] != '\0' && bytes[i] == (uint8_t)expected[i];
    }
    ok = ok && expected[size] == '\0';
    text_drop(&echo, size);
    return ok;
}

static void check_ends(void)
{
    open_line();
    tap_check(type("ab") == LINE_OPEN && type("\r") == LINE_DONE, "CR ends a line");
    tap_check_text(line.bytes, "ab", "and it holds what was typed");
    tap_check(type("\n") == LINE_OPEN && type("c\n") == LINE_DONE, "LF after CR is the same end, LF alone is one");
    tap_check_text(line.bytes, "c", "and nothing of the line before is left");
    tap_check(type("\r\n\n \t \r") == LINE_OPEN, "empty and blank lines are none");
    tap_check(type("a\tb\r") == LINE_DONE, "tab");
    tap_check_text(line.bytes, "a b", "counts as a blank");
    tap_check(type("\bab\bc\x7f\x7f\x7f\x7fxy\r") == LINE_DONE, "backspace and delete");
    tap_check_text(line.bytes, "xy", "rub out, and nothing before the start");
}

static void check_echo(void)
{
    open_line();
    (void)type("ab\b\b\b\tc\r");
    tap_check(echoed("ab\b \b\b \b c\r\n"), "what is typed is echoed");
    (void)type("a\r\n\r");
    tap_check(echoed("a\r\n\r\n"), "CR LF is one end to the eye as well");
    (void)type("get");
    (void)echoed("get");
    line_make_way(&line, &echo);
    line_make_way(&line, &echo);
    tap_check(echoed("\r\n"), "another's output gets a line of its own, once");
    tap_check(type(" m\r") == LINE_DONE, "and the line goes on");
    tap_check_text(line.bytes, "get m", "whole");
    (void)echoed(" m\r\n");
    line.has_echo = false;
    (void)type("quiet\b\r");
    line_make_way(&line, &echo);
    tap_check(echoed(""), "without echo nothing comes back");
}

static void check_damage(void)
{
    open_line();
    line.has_echo = false;
    for (unsigned i = 0u; i < LINE_LENGTH_MAX; i++) {
        (void)type("x");
    }
    tap_check(type("\r") == LINE_DONE, "240 characters are a line");
    for (unsigned i = 0u; i < LINE_LENGTH_MAX + 1u; i++) {
        (void)type("x");
    }
    tap_check(type("\r") == LINE_TOO_LONG, "241 are too long");
    tap_check(type("ok\r") == LINE_DONE, "the next one is not");
    for (unsigned byte = 1u; byte < 256u; byte++) {
        const uint32_t before = line.garbage;
        const bool is_text = (byte >= ' ' && byte < 0x7f) || byte == '\t' || byte == '\b' || byte == 0x7f ||
                             byte == '\r' || byte == '\n';
        const char typed[] = {'a', (char)byte, 'b', '\0'};
        bool ok = type(typed) == LINE_OPEN && (line.garbage == before) == is_text;

        ok = (type("\r") == (is_text ? LINE_DONE : LINE_DAMAGED)) && ok;
        if (!ok || byte == 255u) {
            tap_check(ok, "a byte that is no text damages its line, and is counted");
        }
    }
    (void)line_take(&line, 0u, &echo);
    tap_check(type("\r") == LINE_DAMAGED, "a zero too, even alone");
    tap_check(type("\x04") == LINE_LAST && type("a\r") == LINE_DONE,
              "EOT says that no line will follow, and harms none");
    (void)type("se");
    line_damage(&line);
    tap_check(type("t m 1\r") == LINE_DAMAGED && type("a\r") == LINE_DONE, "lost bytes damage one line");
    line_damage(&line);
    tap_check(type("\n") == LINE_DAMAGED && type("b\r") == LINE_DONE,
              "a line feed after lost bytes ends what they were of, and the next line is whole");
}

void test_line(void)
{
    check_ends();
    check_echo();
    check_damage();
}
