/* Inputs from files, without a fuzzer: by any compiler.
 *   files [--lines folder] input ...
 * With --lines what each input says goes to the folder too: NAME.console and NAME.link, for a board that has lines. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "board.h"
#include "input.h"

enum { INPUT_MAX = 1 << 20, PATH_LENGTH = 1024 };

static FILE *lines[HAL_UART_COUNT];

static void fail(const char *path)
{
    perror(path);
    exit(2);
}

static void keep(enum hal_uart port, const void *bytes, size_t size)
{
    if (fwrite(bytes, 1u, size, lines[port]) != size) {
        fail("cannot write");
    }
}

static FILE *open_line(const char *folder, const char *input, const char *line)
{
    const char *const slash = strrchr(input, '/');
    char path[PATH_LENGTH];
    FILE *file;

    (void)snprintf(path, sizeof path, "%s/%s.%s", folder, slash != NULL ? slash + 1 : input, line);
    file = fopen(path, "wb");
    if (file == NULL) {
        fail(path);
    }
    return file;
}

static void run(const char *path)
{
    static uint8_t bytes[INPUT_MAX];
    FILE *file = fopen(path, "rb");
    size_t size;

    if (file == NULL) {
        fail(path);
    }
    size = fread(bytes, 1u, sizeof bytes, file);
    (void)fclose(file);
    (void)LLVMFuzzerTestOneInput(bytes, size);
}

int main(int count, char **arguments)
{
    const char *const folder = count > 2 && strcmp(arguments[1], "--lines") == 0 ? arguments[2] : NULL;
    const int first = folder != NULL ? 3 : 1;

    for (int i = first; i < count; i++) {
        if (folder != NULL) {
            lines[HAL_UART_CONSOLE] = open_line(folder, arguments[i], "console");
            lines[HAL_UART_LINK] = open_line(folder, arguments[i], "link");
            board_listener = keep;
        }
        run(arguments[i]);
        for (unsigned port = 0u; port < HAL_UART_COUNT && folder != NULL; port++) {
            (void)fclose(lines[port]);
        }
    }
    printf("%d inputs\n", count - first);
    return count > first ? 0 : 2;
}
