/* Reads the list of boards. */
#include "squeal/port/boards.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { PATH_SIZE = 1024, LINE_SIZE = 4096, PORT_SIZE = 80 };

static const char place[] = "@LINK@";

static void path_find(char path[PATH_SIZE])
{
    static const char name[] = "boards";
    const char *told = getenv("SQUEAL_BOARDS");

    if (told != NULL) {
        (void)snprintf(path, PATH_SIZE, "%s", told);
        return;
    }
    const ssize_t length = readlink("/proc/self/exe", path, PATH_SIZE - sizeof name);
    path[length > 0 ? length : 0] = '\0';
    char *slash = strrchr(path, '/');
    (void)strcpy(slash != NULL ? slash + 1 : path, name);
}

/* The next board of the list: its port's name and its command, both in line; false at its end. */
static bool line_read(FILE *file, char line[LINE_SIZE], char port[PORT_SIZE], char **command)
{
    while (fgets(line, LINE_SIZE, file) != NULL) {
        char *colon = strstr(line, ": ");
        line[strcspn(line, "\n")] = '\0';
        if (colon != NULL) {
            *colon = '\0';
            *command = colon + 2;
            (void)snprintf(port, PORT_SIZE, "%s%.60s", strcmp(line, "host") == 0 ? "" : "qemu:", line);
            return true;
        }
    }
    return false;
}

static void ports_write(FILE *file, char *out, size_t size)
{
    char line[LINE_SIZE], port[PORT_SIZE], *command;
    size_t length = 0;

    out[0] = '\0';
    rewind(file);
    while (length < size && line_read(file, line, port, &command)) {
        length += (size_t)snprintf(out + length, size - length, " %s", port);
    }
}

/* With the path at each place for it, behind room for so many words. */
static char **words_cut(const char *command, const char *link)
{
    const size_t words_max = strlen(command) / 2 + 2;
    const size_t text_max = strlen(command) + 1 + strlen(command) / (sizeof place - 1) * strlen(link);
    char **words = malloc(words_max * sizeof *words + text_max);
    size_t count = 0;

    if (words == NULL) {
        return NULL;
    }
    char *text = (char *)(words + words_max);
    for (const char *at = command; *at != '\0';) {
        at += strspn(at, " ");
        words[count++] = text;
        for (; *at != '\0' && *at != ' '; at++) {
            if (strncmp(at, place, sizeof place - 1) == 0) {
                text += strlen(strcpy(text, link));
                at += sizeof place - 2;
            } else {
                *text++ = *at;
            }
        }
        *text++ = '\0';
    }
    words[count] = NULL;
    return words;
}

/* Is the image there, the last word of the command? */
static bool is_built(const char *command)
{
    const char *blank = strrchr(command, ' ');

    return access(blank != NULL ? blank + 1 : command, R_OK) == 0;
}

static char **command_of(FILE *file, const char *wanted, const char *link, char problem[BOARDS_PROBLEM_MAX])
{
    char line[LINE_SIZE], port[PORT_SIZE], ports[BOARDS_PROBLEM_MAX / 2], *command;

    (void)snprintf(problem, BOARDS_PROBLEM_MAX, "out of memory");
    while (line_read(file, line, port, &command)) {
        if (strcmp(port, wanted) == 0) {
            if (is_built(command)) {
                return words_cut(command, link);
            }
            (void)snprintf(problem, BOARDS_PROBLEM_MAX, "its image is not built; make BOARD=%.60s builds it", line);
            return NULL;
        }
    }
    ports_write(file, ports, sizeof ports);
    (void)snprintf(problem, BOARDS_PROBLEM_MAX, "there is no such board; there are:%s", ports);
    return NULL;
}

static FILE *list_open(char path[PATH_SIZE])
{
    path_find(path);
    return fopen(path, "r");
}

char **boards_command(const char *port, const char *link, char problem[BOARDS_PROBLEM_MAX])
{
    char path[PATH_SIZE];
    FILE *file = list_open(path);

    if (file == NULL) {
        (void)snprintf(problem, BOARDS_PROBLEM_MAX, "no list of boards: %.200s: %s; make tool writes it", path,
                       strerror(errno));
        return NULL;
    }
    char **command = command_of(file, port, link, problem);
    (void)fclose(file);
    return command;
}

void boards_ports(char *out, size_t size)
{
    char path[PATH_SIZE];
    FILE *file = list_open(path);

    out[0] = '\0';
    if (file != NULL) {
        ports_write(file, out, size);
        (void)fclose(file);
    }
}
