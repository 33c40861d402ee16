/* Text from elsewhere. */
#include "squeal/support/printable.h"

#include <stdio.h>

char *printable_copy(char *out, size_t size, const char *text)
{
    size_t length = 0;

    for (; *text != '\0'; text++) {
        const unsigned char byte = (unsigned char)*text;
        if (byte >= ' ' && byte <= '~') {
            if (length + 1 >= size) {
                break;
            }
            out[length++] = (char)byte;
        } else {
            if (length + PRINTABLE_GROWTH >= size) {
                break;
            }
            length += (size_t)snprintf(out + length, size - length, "\\x%02x", byte);
        }
    }
    out[length] = '\0';
    return out;
}
