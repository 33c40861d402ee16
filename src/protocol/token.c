/* Words of a line. */
#include "protocol/token.h"

#include "base/decimal.h"

struct token token_first(const char *text)
{
    struct token word = {text, 0u};

    while (*word.start == ' ') {
        word.start++;
    }
    while (word.start[word.length] != '\0' && word.start[word.length] != ' ') {
        word.length++;
    }
    return word;
}

struct token token_next(struct token word) { return token_first(word.start + word.length); }

bool token_equal(const char *start, size_t length, const char *text)
{
    size_t i = 0u;

    while (i < length && text[i] != '\0' && text[i] == start[i]) {
        i++;
    }
    return i == length && text[i] == '\0';
}

bool token_is_held(struct token part, const char *text)
{
    for (; *text != '\0'; text++) {
        size_t i = 0u;

        while (i < part.length && text[i] != '\0' && text[i] == part.start[i]) {
            i++;
        }
        if (i == part.length) {
            return true;
        }
    }
    return part.length == 0u;
}

bool token_count_is(const char *text, unsigned count)
{
    struct token word = token_first(text);

    for (; word.length != 0u && count > 0u; count--) {
        word = token_next(word);
    }
    return word.length == 0u && count == 0u;
}

void token_write(struct text *text, struct token word)
{
    for (size_t i = 0u; i < word.length; i++) {
        text_put(text, word.start[i]);
    }
}

bool token_number(struct token word, uint32_t low, uint32_t high, uint32_t *value)
{
    uint64_t number;

    if (!decimal_parse_u64(word.start, word.length, &number) || number < low || number > high) {
        return false;
    }
    *value = (uint32_t)number;
    return true;
}
