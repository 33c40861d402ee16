/* The text ring: what is written comes out, and a line that does not fit leaves no trace. */
#include "base/text.h"

#include "tap.h"
#include "tests.h"

enum { CAPACITY = 64 };

/* Takes everything out into a 0-terminated string. */
static const char *drain(struct text *text)
{
    static char out[CAPACITY + 1];
    size_t length = 0u;
    size_t size;

    for (;;) {
        const uint8_t *piece = text_peek(text, &size);

        if (size == 0u) {
            break;
        }
        for (size_t i = 0u; i < size; i++) {
            out[length++] = (char)piece[i];
        }
        text_drop(text, size);
    }
    out[length] = '\0';
    return out;
}

static void check_numbers(void)
{
    uint8_t storage[CAPACITY];
    struct text text;

    text_init(&text, storage, sizeof(storage));
    text_write(&text, "ok");
    text_put(&text, '!');
    text_u64(&text, UINT64_MAX);
    text_end_line(&text);
    tap_check_text(drain(&text), "ok!18446744073709551615\r\n", "text, character, integer and line end");
    text_f32(&text, 0.3f, 9u);
    text_put(&text, ' ');
    text_f32(&text, -1500.0f, 6u);
    text_put(&text, ' ');
    text_shortest(&text, 0.3f);
    text_put(&text, ' ');
    text_hex32(&text, 0xbeefu);
    text_put(&text, ' ');
    text_product(&text, 3u, 0.5f, 9u);
    tap_check_text(drain(&text), "0.300000012 -1500 0.3 0000beef 1.5", "floats, hexadecimals and products");
    text_key_text(&text, "a", "yes");
    text_key_u64(&text, "b", 7u);
    text_key_f32(&text, "c", 0.25f, 9u);
    text_key_shortest(&text, "d", 1e8f);
    text_key_product(&text, "e", 2u, 4.0f, 9u);
    text_key_hex32(&text, "f", 1u);
    tap_check_text(drain(&text), " a=yes b=7 c=0.25 d=100000000 e=8 f=00000001", "fields");
}

static void check_limits(void)
{
    uint8_t storage[16 + 1] = {0u};
    struct text text;
    size_t size;
    size_t mark;

    storage[16] = 77u;
    text_init(&text, storage, 16u);
    (void)text_peek(&text, &size);
    tap_check(size == 0u && text_room(&text) == 16u, "an empty text has nothing to send and all its room");
    mark = text_mark(&text);
    text_write(&text, "0123456789abcd");
    tap_check(text_end_or_rollback(&text, mark) && text_room(&text) == 0u, "a line that fits exactly stays");
    mark = text_mark(&text);
    tap_check(!text_end_or_rollback(&text, mark), "then not even a line end fits");
    tap_check_text(drain(&text), "0123456789abcd\r\n", "and the line before it is whole");

    text_write(&text, "first\r\n");
    mark = text_mark(&text);
    text_write(&text, "a second one");
    tap_check(text.overflowed && text_room(&text) == 0u, "what does not fit raises the flag");
    text_rollback(&text, mark);
    tap_check(!text.overflowed && text_room(&text) == 9u, "a rollback clears it and gives the room back");
    text_write(&text, "2");
    tap_check_text(drain(&text), "first\r\n2", "as if the long line had never been");
    tap_check(storage[16] == 77u, "nothing is written behind the storage");
}

static void check_wrap(void)
{
    uint8_t storage[16];
    struct text text;
    size_t size;
    bool ok = true;

    text_init(&text, storage, sizeof(storage));
    text.head = SIZE_MAX - 20u; /* as after a long run */
    text.tail = SIZE_MAX - 20u;
    for (unsigned i = 0u; i < 40u && ok; i++) {
        const char *line;

        text_write(&text, "abcdefg");
        line = drain(&text);
        ok = line[0] == 'a' && line[6] == 'g' && line[7] == '\0';
    }
    tap_check(ok, "text passes unharmed across the end of the storage and the wrap of the indices");

    text_init(&text, storage, sizeof(storage));
    text_write(&text, "0123456789");
    text_drop(&text, 10u);
    text_write(&text, "ABCDEFGH");
    (void)text_peek(&text, &size);
    tap_check(size == 6u, "only what lies in one piece is offered");
    text_drop(&text, 2u);
    tap_check_text(drain(&text), "CDEFGH", "and a short send goes on where it stopped");
}

void test_text(void)
{
    check_numbers();
    check_limits();
    check_wrap();
}
