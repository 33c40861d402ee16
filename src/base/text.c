/* Numbers go through a short buffer on the stack: base/decimal wants contiguous room and the ring may wrap. */
#include "base/text.h"

#include "base/assert.h"
#include "base/compiler.h"
#include "base/decimal.h"

void text_init(struct text *text, void *storage, size_t capacity)
{
    BASE_ASSERT(capacity != 0u && (capacity & (capacity - 1u)) == 0u);
    text->bytes = storage;
    text->capacity = capacity;
    text->head = 0u;
    text->tail = 0u;
    text->overflowed = false;
}

size_t text_room(const struct text *text) { return text->capacity - (text->head - text->tail); }

void text_put(struct text *text, char symbol)
{
    if (text_room(text) == 0u) {
        text->overflowed = true;
        return;
    }
    text->bytes[text->head & (text->capacity - 1u)] = (uint8_t)symbol;
    text->head++;
}

/* Not inlined a dozen times below. */
BASE_NOINLINE void text_write(struct text *text, const char *string)
{
    for (; *string != '\0'; string++) {
        text_put(text, *string);
    }
}

void text_u64(struct text *text, uint64_t value)
{
    char number[DECIMAL_SIZE_MAX];

    (void)decimal_format_u64(value, number);
    text_write(text, number);
}

void text_f32(struct text *text, float value, unsigned digits)
{
    char number[DECIMAL_SIZE_MAX];

    (void)decimal_format_f32(value, digits, number);
    text_write(text, number);
}

void text_shortest(struct text *text, float value)
{
    char number[DECIMAL_SIZE_MAX];

    (void)decimal_format_shortest(value, number);
    text_write(text, number);
}

void text_product(struct text *text, uint64_t count, float unit, unsigned digits)
{
    char number[DECIMAL_SIZE_MAX];

    (void)decimal_format_product(count, unit, digits, number);
    text_write(text, number);
}

void text_hex32(struct text *text, uint32_t value)
{
    char number[DECIMAL_SIZE_MAX];

    (void)decimal_format_hex32(value, number);
    text_write(text, number);
}

static void write_key(struct text *text, const char *key)
{
    text_put(text, ' ');
    text_write(text, key);
    text_put(text, '=');
}

void text_key_text(struct text *text, const char *key, const char *value)
{
    write_key(text, key);
    text_write(text, value);
}

void text_key_u64(struct text *text, const char *key, uint64_t value)
{
    write_key(text, key);
    text_u64(text, value);
}

void text_key_f32(struct text *text, const char *key, float value, unsigned digits)
{
    write_key(text, key);
    text_f32(text, value, digits);
}

void text_key_shortest(struct text *text, const char *key, float value)
{
    write_key(text, key);
    text_shortest(text, value);
}

void text_key_product(struct text *text, const char *key, uint64_t count, float unit, unsigned digits)
{
    write_key(text, key);
    text_product(text, count, unit, digits);
}

void text_key_hex32(struct text *text, const char *key, uint32_t value)
{
    write_key(text, key);
    text_hex32(text, value);
}

void text_end_line(struct text *text)
{
    text_put(text, '\r');
    text_put(text, '\n');
}

size_t text_mark(struct text *text)
{
    text->overflowed = false;
    return text->head;
}

void text_rollback(struct text *text, size_t mark)
{
    BASE_ASSERT(text->head - mark <= text->head - text->tail);
    text->head = mark;
    text->overflowed = false;
}

bool text_end_or_rollback(struct text *text, size_t mark)
{
    text_end_line(text);
    if (text->overflowed) {
        text_rollback(text, mark);
        return false;
    }
    return true;
}

const uint8_t *text_peek(const struct text *text, size_t *size)
{
    const size_t start = text->tail & (text->capacity - 1u);
    const size_t fill = text->head - text->tail;
    const size_t piece = text->capacity - start;

    *size = fill < piece ? fill : piece;
    return text->bytes + start;
}

void text_drop(struct text *text, size_t size)
{
    BASE_ASSERT(size <= text->head - text->tail);
    text->tail += size;
}
