/* A sequence is ESC [ with parameters and a last letter, or ESC O and a letter; letters and numbers are those of xterm,
 * the Linux console and what descends from them. */
#include "squeal/monitor/keys.h"

#include <string.h>

static const struct {
    const char *sequence; /* after ESC */
    int key;
} known[] = {{"[A", KEY_UP},    {"[B", KEY_DOWN},     {"[C", KEY_RIGHT},      {"[D", KEY_LEFT}, {"OA", KEY_UP},
             {"OB", KEY_DOWN},  {"OC", KEY_RIGHT},    {"OD", KEY_LEFT},       {"[H", KEY_HOME}, {"OH", KEY_HOME},
             {"[1~", KEY_HOME}, {"[7~", KEY_HOME},    {"[F", KEY_END},        {"OF", KEY_END},  {"[4~", KEY_END},
             {"[8~", KEY_END},  {"[5~", KEY_PAGE_UP}, {"[6~", KEY_PAGE_DOWN}, {"OP", KEY_F1},   {"[11~", KEY_F1},
             {"[[A", KEY_F1}};

static int look_up(const char *sequence, size_t size)
{
    for (size_t i = 0u; i < sizeof known / sizeof known[0]; i++) {
        if (strlen(known[i].sequence) == size && memcmp(known[i].sequence, sequence, size) == 0) {
            return known[i].key;
        }
    }
    return KEY_NONE;
}

/* Is the sequence in held whole? */
static bool is_whole(const struct keys *keys)
{
    const char last = keys->held[keys->size - 1u];

    if (keys->size == 2u) {
        return last != '[' && last != 'O';
    }
    if (keys->held[1] == 'O' || (keys->size == 4u && keys->held[2] == '[')) {
        return true;
    }
    return last >= '@' && last <= '~' && last != '[';
}

int keys_take(struct keys *keys, char byte)
{
    int key;

    if (keys->size == 0u && byte != KEY_ESCAPE) {
        return (unsigned char)byte < 128u ? (byte == '\n' ? KEY_ENTER : byte) : KEY_NONE;
    }
    if (keys->size == 1u && byte == KEY_ESCAPE) {
        return KEY_ESCAPE; /* pressed twice; the second one may begin something */
    }
    if (keys->size < KEYS_SIZE) {
        keys->held[keys->size++] = byte;
    } else {
        keys->held[KEYS_SIZE - 1] = byte; /* too long to be known; only its end matters */
    }
    if (keys->size == 1u || !is_whole(keys)) {
        return KEY_NONE;
    }
    key = look_up(keys->held + 1, keys->size - 1u);
    keys->size = 0u;
    return key;
}

int keys_pause(struct keys *keys)
{
    const bool was_alone = keys->size == 1u;

    keys->size = 0u;
    return was_alone ? KEY_ESCAPE : KEY_NONE;
}
