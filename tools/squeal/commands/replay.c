/* replay: makes a recorded run again and compares the hash of all its states. */
#include "squeal/commands/linked.h"
#include "squeal/record/recording.h"

#include <inttypes.h>
#include <stdio.h>

static int compare(struct recording *recording, struct device *device, const char *path)
{
    const uint32_t hash = recording->hash;
    enum device_result result = recording_load(recording, device);

    result = result == DEVICE_OK ? recording_play(recording, device) : result;
    if (result != DEVICE_OK) {
        return linked_fail(device, result);
    }
    if (recording->at != recording->steps || recording->hash != hash) {
        (void)fflush(stdout);
        fprintf(stderr, "squeal: %s: differs: %08x at step %" PRIu64 " instead of %08x at step %" PRIu64 "\n", path,
                recording->hash, recording->at, hash, recording->steps);
        return EXIT_FAILED;
    }
    printf("the same bits: %08x at step %" PRIu64 "\n", hash, recording->steps);
    return EXIT_OK;
}

int command_replay(const struct arguments *arguments)
{
    struct device *device = NULL;
    struct recording recording;
    char problem[CSV_PROBLEM_MAX];

    if (!arguments_has_operands(arguments, 1, 1)) {
        return EXIT_USAGE;
    }
    int code = linked_open(arguments, &device);
    if (code == EXIT_OK) {
        if (recording_read(&recording, device, arguments->operands[0], problem)) {
            code = compare(&recording, device, arguments->operands[0]);
            recording_free(&recording);
        } else {
            fprintf(stderr, "squeal: %s\n", problem);
            code = EXIT_FAILED;
        }
    }
    device_close(device);
    return code;
}
