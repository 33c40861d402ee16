/* A command line is words with blanks between. Words are ranges of a 0-terminated text. [MAIN, pure] */
#ifndef PROTOCOL_TOKEN_H
#define PROTOCOL_TOKEN_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/text.h"

struct token {
    const char *start;
    size_t length; /* 0 at the end of the text */
};

/* The first word of a text. */
struct token token_first(const char *text);

/* The word after this one. */
struct token token_next(struct token word);

/* Is the range the 0-terminated text? */
bool token_equal(const char *start, size_t length, const char *text);
static inline bool token_is(struct token word, const char *text) { return token_equal(word.start, word.length, text); }

/* Does the 0-terminated text hold the range somewhere? Nothing is held by every text. */
bool token_is_held(struct token part, const char *text);

/* Has a text exactly so many words? */
bool token_count_is(const char *text, unsigned count);

/* Appends the word. */
void token_write(struct text *text, struct token word);

/* Reads a whole number in low .. high. */
bool token_number(struct token word, uint32_t low, uint32_t high, uint32_t *value);

#endif
