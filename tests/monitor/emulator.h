/* A terminal as far as the monitor needs one: moves, colours, UTF-8, erasing. What it does not know it counts. */
#ifndef EMULATOR_H
#define EMULATOR_H

#include <stddef.h>
#include <stdint.h>

enum { EMULATOR_ROWS = 40, EMULATOR_COLS = 120, EMULATOR_LOOK = 16 };

struct emulator {
    int rows, cols, row, col;
    unsigned unknown; /* sequences */
    char look[EMULATOR_LOOK];
    uint32_t codes[EMULATOR_ROWS][EMULATOR_COLS];
    char looks[EMULATOR_ROWS][EMULATOR_COLS][EMULATOR_LOOK]; /* the colour's parameters, "" none */
};

void emulator_open(struct emulator *emulator, int rows, int cols);

void emulator_take(struct emulator *emulator, const char *bytes, size_t size);

#endif
