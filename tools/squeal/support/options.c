/* Command-line options. */
#include "squeal/support/options.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const struct option *option_find(const struct option *options, size_t count, const char *name)
{
    for (size_t i = 0; i < count; i++) {
        if (strcmp(options[i].name, name) == 0) {
            return &options[i];
        }
    }
    return NULL;
}

static bool is_complete(const struct option *options, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        if (options[i].is_required && *options[i].text == NULL) {
            fprintf(stderr, "squeal: %s is missing\n", options[i].name);
            return false;
        }
    }
    return true;
}

char **options_read(const struct option *options, size_t count, int argc, char **argv)
{
    int i = 0;

    for (; i < argc && strcmp(argv[i], "--") != 0; i++) {
        const struct option *option = option_find(options, count, argv[i]);
        if (option == NULL) {
            fprintf(stderr, "squeal: unknown option %s (the firmware's command follows --)\n", argv[i]);
            return NULL;
        }
        if (option->flag != NULL) {
            *option->flag = true;
        } else if (i + 1 < argc && strcmp(argv[i + 1], "--") != 0) {
            *option->text = argv[++i];
        } else {
            fprintf(stderr, "squeal: %s needs a value\n", argv[i]);
            return NULL;
        }
    }
    if (!is_complete(options, count)) {
        return NULL;
    }
    if (i + 1 >= argc) {
        fprintf(stderr, "squeal: the firmware's command line is missing after --\n");
        return NULL;
    }
    return argv + i + 1;
}

bool options_whole(const char *name, const char *text, long low, long high, long *value)
{
    char *end = NULL;

    *value = strtol(text, &end, 10);
    if (end == text || *end != '\0' || *value < low || *value > high) {
        fprintf(stderr, "squeal: %s %s: a whole number from %ld to %ld is wanted\n", name, text, low, high);
        return false;
    }
    return true;
}
