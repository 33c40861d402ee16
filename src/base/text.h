/* Output text: lines are built in a ring of bytes, and main sends from its other end as the line takes them.
 *
 * Nothing waits. What does not fit is left out and the text says so by its overflowed flag, until the next mark. A line
 * is sent whole or not at all:
 *
 *     const size_t mark = text_mark(text);
 *     text_write(text, "ok status");
 *     text_key_u64(text, "step", step);
 *     if (!text_end_or_rollback(text, mark)) {
 *         lines_lost++;
 *     }
 *
 * Building and sending belong to one context, and sending goes on between lines only. */
#ifndef BASE_TEXT_H
#define BASE_TEXT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct text {
    uint8_t *bytes;  /* capacity of them, owned by the caller */
    size_t capacity; /* a power of two */
    size_t head;     /* bytes put so far; runs freely like the indices of base/ring.h */
    size_t tail;     /* bytes dropped so far */
    bool overflowed; /* something did not fit since the last mark */
};

/* Binds an empty text to storage. Capacity must be a power of two. [INIT] */
void text_init(struct text *text, void *storage, size_t capacity);

/* Bytes that still fit. [MAIN], like all that follow */
size_t text_room(const struct text *text);

/* Each of these appends: one character, a 0-terminated text, a number as base/decimal.h writes it. */
void text_put(struct text *text, char symbol);
void text_write(struct text *text, const char *string);
void text_u64(struct text *text, uint64_t value);
void text_f32(struct text *text, float value, unsigned digits);
void text_shortest(struct text *text, float value);
void text_product(struct text *text, uint64_t count, float unit, unsigned digits);
void text_hex32(struct text *text, uint32_t value);

/* The same as a field " key=value". */
void text_key_text(struct text *text, const char *key, const char *value);
void text_key_u64(struct text *text, const char *key, uint64_t value);
void text_key_f32(struct text *text, const char *key, float value, unsigned digits);
void text_key_shortest(struct text *text, const char *key, float value);
void text_key_product(struct text *text, const char *key, uint64_t count, float unit, unsigned digits);
void text_key_hex32(struct text *text, const char *key, uint32_t value);

/* CR LF. */
void text_end_line(struct text *text);

/* Remembers where a line starts, and clears overflowed. */
size_t text_mark(struct text *text);

/* Takes back all that was put since the mark, and clears overflowed. */
void text_rollback(struct text *text, size_t mark);

/* Ends the line; takes it back and returns false if it did not fit whole. */
bool text_end_or_rollback(struct text *text, size_t mark);

/* The oldest bytes that lie in one piece, *size of them: 0 only if there are none. */
const uint8_t *text_peek(const struct text *text, size_t *size);

/* Forgets the oldest size bytes, which have been sent. */
void text_drop(struct text *text, size_t size);

#endif
