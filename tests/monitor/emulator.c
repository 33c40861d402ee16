/* It gets whole frames: no sequence is cut. */
#include "tests/monitor/emulator.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void erase(struct emulator *emulator)
{
    for (int row = 0; row < EMULATOR_ROWS; row++) {
        for (int col = 0; col < EMULATOR_COLS; col++) {
            emulator->codes[row][col] = ' ';
            emulator->looks[row][col][0] = '\0';
        }
    }
}

void emulator_open(struct emulator *emulator, int rows, int cols)
{
    memset(emulator, 0, sizeof *emulator);
    emulator->rows = rows;
    emulator->cols = cols;
    erase(emulator);
}

/* CSI parameters and a last letter; returns what comes after it. */
static const char *sequence_take(struct emulator *emulator, const char *at)
{
    const size_t length = strspn(at, "0123456789;?");
    const char last = at[length];

    if (last == 'H') {
        char *rest;

        emulator->row = (int)strtol(at, &rest, 10) - 1;
        emulator->col = *rest == ';' ? (int)strtol(rest + 1, NULL, 10) - 1 : 0;
    } else if (last == 'm') {
        const char *look = strncmp(at, "0;", 2) == 0 ? at + 2 : at;

        (void)snprintf(emulator->look, sizeof emulator->look, "%.*s", (int)(at + length - look), look);
    } else if (last == 'J') {
        erase(emulator);
    } else if (strncmp(at, "?2026", 5) != 0) {
        emulator->unknown++;
    }
    return at + length + 1;
}

static const char *character_take(struct emulator *emulator, const char *at)
{
    const unsigned char lead = (unsigned char)*at++;
    const int more = lead >= 0xf0u ? 3 : lead >= 0xe0u ? 2 : lead >= 0xc0u ? 1 : 0;
    uint32_t code = more == 3 ? lead & 7u : more == 2 ? lead & 15u : more == 1 ? lead & 31u : lead;

    for (int i = 0; i < more; i++) {
        code = code * 64u + ((unsigned char)*at++ & 63u);
    }
    if (emulator->row >= emulator->rows || emulator->col >= emulator->cols || emulator->row < 0 || emulator->col < 0) {
        emulator->unknown++;
    } else {
        emulator->codes[emulator->row][emulator->col] = code;
        (void)strcpy(emulator->looks[emulator->row][emulator->col], emulator->look);
    }
    emulator->col++;
    return at;
}

void emulator_take(struct emulator *emulator, const char *bytes, size_t size)
{
    const char *at = bytes;

    while (at < bytes + size) {
        at = at[0] == '\033' && at[1] == '[' ? sequence_take(emulator, at + 2) : character_take(emulator, at);
    }
}
