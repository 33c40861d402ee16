/* What a terminal sends when a key is pressed, made into keys. */
#ifndef SQUEAL_KEYS_H
#define SQUEAL_KEYS_H

#include <stdbool.h>
#include <stddef.h>

/* A printable character, or control character, is its own number. */
enum key {
    KEY_NONE = 0,
    KEY_INTERRUPT = 3, /* Ctrl-C, which is a key like others while the terminal is ours */
    KEY_REDRAW = 12,
    KEY_ENTER = 13,
    KEY_SUSPEND = 26,
    KEY_ESCAPE = 27,
    KEY_BACKSPACE = 127,
    KEY_UP = 256,
    KEY_DOWN,
    KEY_RIGHT,
    KEY_LEFT,
    KEY_PAGE_UP,
    KEY_PAGE_DOWN,
    KEY_HOME,
    KEY_END,
    KEY_F1
};

enum { KEYS_SIZE = 16 };

struct keys {
    char held[KEYS_SIZE]; /* the beginning of a sequence */
    size_t size;
};

/* Takes a byte; the key that it completes, or KEY_NONE. What no one knows is dropped as a whole. */
int keys_take(struct keys *keys, char byte);

/* No byte for a while: an escape on its own was the key of that name. */
int keys_pause(struct keys *keys);

#endif
