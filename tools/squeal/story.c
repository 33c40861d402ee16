/* The flow of the story: one conversation, act after act, then sound, pictures and the record. */
#include "story.h"

#include "children.h"
#include "fields.h"
#include "options.h"
#include "plot.h"
#include "report.h"
#include "tell.h"
#include "wav.h"

#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#define SOUND_LEAST_S 0.6 /* of physical time; a tone is hard to judge in less */
#define SOUND_LONGEST_S 10.0
#define SOUND_LOWEST_HZ 200.0 /* below this it is a groan that small speakers do not play */
#define TICK_FASTEST_HZ 4000.0
#define TICK_SLOWEST_HZ 10.0
#define TICK_RATIO 0.7  /* between two tries */
#define DISC_SLOWS 0.05 /* a disc that loses this share of its speed within an act is being stopped */

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

/* Adds a line to a growing text, with LF before it unless it is the first. */
static void text_append(char **text, const char *line)
{
    const size_t used = *text == NULL ? 0 : strlen(*text);
    char *longer = realloc(*text, used + strlen(line) + 2);

    if (longer != NULL) {
        (void)sprintf(longer + used, "%s%s", used > 0 ? "\n" : "", line);
        *text = longer;
    }
}

/* Everything that the device says besides its answers. */
static void listen(void *context, enum session_line kind, const char *text)
{
    struct story *story = context;
    struct act *act = story->record.act;

    switch (kind) {
    case SESSION_HEADER:
        record_header(&story->record, text);
        break;
    case SESSION_SAMPLE:
        record_sample(&story->record, text);
        break;
    case SESSION_NOTICE:
        tell_words(text);
        break;
    case SESSION_BODY:
        if (act == NULL) {
            break;
        }
        if (strncmp(story->session.command, "list", 4) == 0) {
            text_append(&act->parameters, text);
        } else if (strncmp(text, "verdict ", 8) == 0) {
            (void)strcpy(act->verdict, text + 8);
            act->has_verdict = true;
            tell_verdict(act->verdict);
        } else {
            if (act->title[0] == '\0') {
                (void)strcpy(act->title, text);
            }
            tell_words(text);
        }
        break;
    }
}

/* Sends one line that must be answered ok. */
static bool must(struct story *story, const char *line)
{
    switch (session_command(&story->session, story->limit_s, "%s", line)) {
    case SESSION_OK:
        return true;
    case SESSION_REFUSED:
        story_fail(story, "'%s' was answered: %s", line, story->session.answer);
        return false;
    case SESSION_LOST:
        story_fail(story, "%s", story->session.failure);
        return false;
    }
    return false;
}

/* Has the device stream every step, and slows its tick down until the line carries that. Time is virtual or the device
 * paces itself, and no bit of the trajectory depends on the tick. */
static bool stream_start(struct story *story, struct act *act)
{
    char line[SESSION_COMMAND_MAX];

    for (double tick_hz = TICK_FASTEST_HZ; tick_hz >= TICK_SLOWEST_HZ; tick_hz *= TICK_RATIO) {
        (void)snprintf(line, sizeof line, "set tick %.0f substeps 1", tick_hz);
        if (!must(story, line)) {
            return false;
        }
        const enum session_result result =
            session_command(&story->session, story->limit_s, "stream csv " RECORD_SIGNALS " every %.0f", act->every);
        if (result == SESSION_OK) {
            return true;
        }
        if (result == SESSION_LOST || strncmp(story->session.answer, "error line-overload", 19) != 0) {
            story_fail(story, "%s", result == SESSION_LOST ? story->session.failure : story->session.answer);
            return false;
        }
    }
    story_fail(story, "the line is too slow for a stream of every step");
    return false;
}

static bool is_audible(const struct act *act)
{
    return fields_number(act->verdict, "frequency_hz") >= SOUND_LOWEST_HZ &&
           strstr(act->verdict, "propensity=squeal") != NULL;
}

static double act_length_s(const struct act *act)
{
    return act->count < 2 ? 0.0 : act->samples[act->count - 1].t_s - act->samples[0].t_s;
}

/* Lets a squealing brake go on until there is enough of it to hear. */
static bool prolong(struct story *story, struct act *act)
{
    char line[SESSION_COMMAND_MAX];
    const double left_s = SOUND_LEAST_S - act_length_s(act);

    if (!is_audible(act) || act->count < 2 || left_s <= 0.0) {
        return true;
    }
    const struct sample *last = &act->samples[act->count - 1];
    const double step_s = (last->t_s - act->samples[0].t_s) / (last->step - act->samples[0].step);
    (void)snprintf(line, sizeof line, "step %.0f", ceil(left_s / step_s));
    return must(story, line);
}

/* After an act the device's own count of what it could not send must explain every gap in the step column. */
static void losses_check(struct story *story, const struct act *act)
{
    const double drops = fields_number(act->status, "drops");

    if (!(drops >= act->missing && drops <= act->missing)) {
        story_fail(story, "act %d: %.0f samples are missing, the device counted %.0f", act->number, act->missing,
                   drops);
    } else if (act->missing > 0.0) {
        printf("    %.0f samples did not fit the line; the device counted them\n", drops);
    }
}

static bool act_play(struct story *story, struct act *act)
{
    char line[SESSION_COMMAND_MAX];

    printf("\nAct %d\n", act->number);
    story->record.act = act;
    if (!must(story, "status")) {
        return false;
    }
    (void)fields_text(story->session.answer, "hash", act->first_hash, sizeof act->first_hash);
    (void)snprintf(line, sizeof line, "demo %d", act->number);
    if (!stream_start(story, act) || !must(story, line) || !prolong(story, act) || !must(story, "stream off") ||
        !must(story, "status")) {
        return false;
    }
    (void)strcpy(act->status, story->session.answer);
    losses_check(story, act);
    if (!act->has_verdict) {
        story_fail(story, "act %d came without a verdict", act->number);
    }
    act->is_done = must(story, "list");
    return act->is_done;
}

static void sound_write(struct story *story)
{
    const struct act *loudest = NULL;
    char path[STORY_PATH_SIZE], problem[CSV_PROBLEM_MAX], what[96];

    for (size_t i = 0; i < story->act_count; i++) {
        const struct act *act = &story->acts[i];
        if (is_audible(act) && (loudest == NULL || act_length_s(act) > act_length_s(loudest))) {
            loudest = act;
        }
    }
    if (loudest == NULL) {
        return;
    }
    const double length_s = wav_write(story_path(story, path, "squeal.wav"), loudest, SOUND_LONGEST_S, problem);
    if (length_s <= 0.0) {
        story_fail(story, "%s", problem);
        return;
    }
    (void)snprintf(what, sizeof what, "act %d as it sounds: the pad's velocity, %.2f s", loudest->number, length_s);
    story_wrote(story, path, what);
}

static bool is_stop(const struct act *act)
{
    return act->count > 1 &&
           act->samples[act->count - 1].disc_m_per_s < (1.0 - DISC_SLOWS) * act->samples[0].disc_m_per_s;
}

static void pictures_draw(struct story *story)
{
    if (!plot_is_possible()) {
        printf("\nno pictures: gnuplot is not installed\n");
        return;
    }
    for (size_t i = 0; i < story->act_count; i++) {
        plot_phase(story, &story->acts[i]);
        if (is_stop(&story->acts[i])) {
            plot_stop(story, &story->acts[i]);
        }
    }
}

/* The first line that the emulator prints about itself. It is the program of the command line whose name begins with
 * "qemu", else the first. */
static void emulator_ask(struct story *story)
{
    char command[STORY_PATH_SIZE];
    const char *program = story->command[0];

    for (char **word = story->command; *word != NULL; word++) {
        const char *slash = strrchr(*word, '/');
        if (strncmp(slash == NULL ? *word : slash + 1, "qemu", 4) == 0) {
            program = *word;
            break;
        }
    }
    (void)snprintf(command, sizeof command, "'%s' --version </dev/null 2>/dev/null", program);
    FILE *pipe = strchr(program, '\'') == NULL ? popen(command, "r") : NULL;
    if (pipe != NULL) {
        if (fgets(story->emulator, sizeof story->emulator, pipe) != NULL) {
            story->emulator[strcspn(story->emulator, "\r\n")] = '\0';
        }
        (void)pclose(pipe);
    }
}

static void story_play(struct story *story)
{
    char emulated[16];

    const size_t wanted = story->act_count;

    story->act_count = 0;
    if (!must(story, "id")) {
        return;
    }
    (void)strcpy(story->id, story->session.answer);
    if (fields_text(story->id, "emulated", emulated, sizeof emulated) && strcmp(emulated, "yes") == 0) {
        emulator_ask(story);
    }
    tell_title(story);
    while (story->act_count < wanted) {
        if (!act_play(story, &story->acts[story->act_count++])) {
            return;
        }
    }
}

/* Reads "1,3,5" into the acts to play. */
static bool acts_read(struct story *story, const char *list)
{
    for (const char *text = list; story->act_count < RECORD_ACTS; text += 2) {
        if (text[0] < '1' || text[0] > '0' + RECORD_ACTS || (text[1] != ',' && text[1] != '\0')) {
            break;
        }
        story->acts[story->act_count++] = (struct act){.number = text[0] - '0', .every = 1.0};
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
    if (session_open(&story->session, story->command, story->limit_s, listen, story) == SESSION_LOST) {
        story_fail(story, "%s", story->session.failure);
    } else {
        story_play(story);
    }
    session_close(&story->session);
    story->record.act = NULL;
    if (record_close(&story->record)) {
        story_wrote(story, path, "every sample of every act");
    } else {
        story_fail(story, "%s", story->record.problem);
    }
    report_write(story);
    sound_write(story);
    pictures_draw(story);
    tell_files(story);
    return story->has_failed ? EXIT_FAILED : EXIT_OK;
}

int story_main(int argc, char **argv)
{
    struct story *story = calloc(1, sizeof *story);
    const char *acts = "1,2,3,4,5", *limit = "600";
    long limit_s = 0;
    int code = EXIT_USAGE;

    if (story == NULL) {
        fprintf(stderr, "squeal: out of memory\n");
        return EXIT_FAILED;
    }
    const struct option options[] = {
        {"--board", &story->board, NULL, true},
        {"--out", &story->out, NULL, true},
        {"--acts", &acts, NULL, false},
        {"--limit", &limit, NULL, false},
    };
    story->command = options_read(options, sizeof options / sizeof options[0], argc, argv);
    if (story->command != NULL && acts_read(story, acts) && options_whole("--limit", limit, 1, 86400, &limit_s)) {
        story->limit_s = (double)limit_s;
        code = story_run(story);
    }
    for (size_t i = 0; i < RECORD_ACTS; i++) {
        free(story->acts[i].samples);
        free(story->acts[i].parameters);
    }
    free(story);
    return code;
}
