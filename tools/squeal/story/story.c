/* The flow of the story: one conversation, act after act and the map, then sound, pictures and the record. */
#include "squeal/story/story.h"

#include "squeal/exits.h"
#include "squeal/plot/figure.h"
#include "squeal/story/play.h"
#include "squeal/story/plot.h"
#include "squeal/story/report.h"
#include "squeal/story/tell.h"
#include "squeal/subcommands.h"
#include "squeal/support/arguments.h"
#include "squeal/support/wav.h"

#include <errno.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#define SOUND_LONGEST_S 10.0

void story_fail(struct story *story, const char *format, ...)
{
    va_list arguments;

    (void)fflush(stdout);
    (void)fputs("squeal: ", stderr);
    va_start(arguments, format);
    (void)vfprintf(stderr, format, arguments);
    va_end(arguments);
    (void)fputc('\n', stderr);
    story->has_failed = true;
}

const char *story_path(const struct story *story, char path[STORY_PATH_SIZE], const char *name)
{
    (void)snprintf(path, STORY_PATH_SIZE, "%s/%s", story->out, name);
    return path;
}

void story_wrote(struct story *story, const char *path, const char *what)
{
    if (story->file_count < STORY_FILES_MAX) {
        (void)snprintf(story->files[story->file_count].path, STORY_PATH_SIZE, "%s", path);
        (void)snprintf(story->files[story->file_count].what, sizeof story->files[0].what, "%s", what);
        story->file_count++;
    }
}

/* The last run of an act as a sound; its length in s, or 0 with the problem. */
static double act_write(const struct act *act, const char *path, char problem[CSV_PROBLEM_MAX])
{
    const size_t count = act->count - act->start;
    double *t_s = malloc((count + 1) * sizeof *t_s), *velocity = malloc((count + 1) * sizeof *velocity);
    double length_s = 0.0;

    (void)snprintf(problem, CSV_PROBLEM_MAX, "out of memory for the sound");
    for (size_t i = 0; i < count && t_s != NULL && velocity != NULL; i++) {
        t_s[i] = act->samples[act->start + i].t_s;
        velocity[i] = act->samples[act->start + i].xd_m_per_s;
    }
    if (t_s != NULL && velocity != NULL) {
        length_s = wav_write(path, t_s, velocity, count, SOUND_LONGEST_S, problem);
    }
    free(t_s);
    free(velocity);
    return length_s;
}

static void sound_write(struct story *story)
{
    const struct act *loudest = NULL;
    char path[STORY_PATH_SIZE], problem[CSV_PROBLEM_MAX], what[96];

    for (size_t i = 0; i < story->act_count; i++) {
        const struct act *act = &story->acts[i];
        if (play_is_audible(act) && (loudest == NULL || play_length_s(act) > play_length_s(loudest))) {
            loudest = act;
        }
    }
    if (loudest == NULL) {
        return;
    }
    const double length_s = act_write(loudest, story_path(story, path, "squeal.wav"), problem);
    if (length_s <= 0.0) {
        story_fail(story, "%s", problem);
        return;
    }
    (void)snprintf(what, sizeof what, "act %d as it sounds: the pad's velocity, %.2f s", loudest->number, length_s);
    story_wrote(story, path, what);
}

static void pictures_draw(struct story *story)
{
    if (!figure_is_possible()) {
        printf("\nno pictures: gnuplot is not installed\n");
        return;
    }
    for (size_t i = 0; i < story->act_count; i++) {
        plot_phase(story, &story->acts[i]);
        if (play_is_stop(&story->acts[i])) {
            plot_stop(story, &story->acts[i]);
        }
    }
    plot_map(story);
}

/* Steps from one sample to the next, by act. The line is what a run waits for, so no act is sampled finer than its
 * picture needs: 8 to 32 points a normal period. The fourth act is heard, at 46 kHz. */
static const double every[RECORD_ACTS] = {4.0, 2.0, 8.0, 4.0, 4.0};

/* Reads "1,3,5" into the acts to play. */
static bool acts_read(struct story *story, const char *list)
{
    for (const char *text = list; story->act_count < RECORD_ACTS; text += 2) {
        if (text[0] < '1' || text[0] > '0' + RECORD_ACTS || (text[1] != ',' && text[1] != '\0')) {
            break;
        }
        story->acts[story->act_count++] = (struct act){.number = text[0] - '0', .every = every[text[0] - '1']};
        if (text[1] == '\0') {
            return true;
        }
    }
    fprintf(stderr, "squeal: --acts %s: numbers from 1 to %d, joined by commas, are wanted\n", list, RECORD_ACTS);
    return false;
}

static int story_run(struct story *story)
{
    char path[STORY_PATH_SIZE];

    if (mkdir(story->out, 0777) != 0 && errno != EEXIST) {
        story_fail(story, "%s: %s", story->out, strerror(errno));
        return EXIT_FAILED;
    }
    if (!record_open(&story->record, story_path(story, path, "state.csv"))) {
        story_fail(story, "%s", story->record.problem);
        return EXIT_FAILED;
    }
    map_forget(story);
    play_all(story);
    if (record_close(&story->record)) {
        story_wrote(story, path, "the samples of every act");
    } else {
        story_fail(story, "%s", story->record.problem);
    }
    map_write(story);
    report_write(story);
    sound_write(story);
    pictures_draw(story);
    tell_files(story);
    return story->has_failed ? EXIT_FAILED : EXIT_OK;
}

int command_demo(const struct arguments *arguments)
{
    struct story *story = calloc(1, sizeof *story);
    const char *acts = arguments_text(arguments, "--acts");
    uint64_t limit_s = 600, side = MAP_SIDE;
    int code = EXIT_USAGE;

    if (story == NULL) {
        fprintf(stderr, "squeal: out of memory\n");
        return EXIT_FAILED;
    }
    story->command = arguments->firmware;
    story->board = arguments_need(arguments, "--board");
    story->out = story->board != NULL ? arguments_need(arguments, "--out") : NULL;
    if (story->out != NULL && arguments_has_operands(arguments, 0, 0) &&
        acts_read(story, acts != NULL ? acts : "1,2,3,4,5") &&
        arguments_whole(arguments, "--points", 0, MAP_SIDE_MAX, &side) &&
        arguments_whole(arguments, "--limit", 1, 86400, &limit_s)) {
        story->limit_s = (double)limit_s;
        story->map.side = (size_t)side;
        code = story_run(story);
    }
    for (size_t i = 0; i < RECORD_ACTS; i++) {
        free(story->acts[i].samples);
        free(story->acts[i].parameters);
    }
    map_free(&story->map);
    free(story);
    return code;
}
