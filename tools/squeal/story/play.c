/* The conversation of the story: what is sent for an act, and what becomes of each line that comes back. */
#include "squeal/story/play.h"

#include "squeal/story/tell.h"
#include "squeal/support/fields.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define SOUND_LEAST_S 0.55    /* of physical time; a tone is hard to judge in less */
#define SOUND_LOWEST_HZ 200.0 /* below this it is a groan that small speakers do not play */
#define DISC_SLOWS 0.05       /* a disc that loses this share of its speed within an act is being stopped */
#define TICK_FASTEST_HZ 4000.0
#define TICK_SLOWEST_HZ 10.0
#define TICK_RATIO 0.9 /* between two tries */

bool play_is_audible(const struct act *act)
{
    return fields_number(act->verdict, "frequency_hz") >= SOUND_LOWEST_HZ &&
           strstr(act->verdict, "propensity=squeal") != NULL;
}

double play_length_s(const struct act *act)
{
    return act->count < 2 ? 0.0 : act->samples[act->count - 1].t_s - act->samples[act->start].t_s;
}

bool play_is_stop(const struct act *act)
{
    return act->count > 1 &&
           act->samples[act->count - 1].disc_m_per_s < (1.0 - DISC_SLOWS) * act->samples[act->start].disc_m_per_s;
}

/* Everything that the device says besides its answers. */
static void listen(void *context, enum session_line kind, const char *text)
{
    struct story *story = context;
    struct act *act = story->record.act;

    if (story->map.is_open) {
        map_listen(&story->map, kind, text);
        return;
    }
    switch (kind) {
    case SESSION_HEADER:
        record_header(&story->record, text);
        break;
    case SESSION_SAMPLE:
        record_sample(&story->record, text);
        break;
    case SESSION_NOTICE:
        tell_notice(text);
        break;
    case SESSION_BODY:
        if (act == NULL) {
            break;
        }
        if (strncmp(story->session.command, "list", 4) == 0) {
            fields_append_line(&act->parameters, text);
        } else if (strncmp(text, "verdict ", 8) == 0) {
            (void)strcpy(act->verdict, text + 8);
            act->has_verdict = true;
            tell_verdict(act->verdict);
        } else if (act->title[0] == '\0') {
            (void)strcpy(act->title, text);
            tell_act(text);
        } else {
            tell_words(text);
        }
        break;
    }
}

bool play_must(struct story *story, const char *line)
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

/* Has the device stream, and slows its tick down until the line carries that. No bit of the trajectory depends on the
 * tick. */
static bool stream_start(struct story *story, struct act *act)
{
    char line[SESSION_COMMAND_MAX];

    for (double tick_hz = TICK_FASTEST_HZ; tick_hz >= TICK_SLOWEST_HZ; tick_hz *= TICK_RATIO) {
        (void)snprintf(line, sizeof line, "set tick %.0f substeps 1", tick_hz);
        if (!play_must(story, line)) {
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
    story_fail(story, "the line is too slow for the stream");
    return false;
}

/* Lets a squealing brake go on until there is enough of it to hear. */
static bool prolong(struct story *story, struct act *act)
{
    char line[SESSION_COMMAND_MAX];
    const double left_s = SOUND_LEAST_S - play_length_s(act);

    if (!play_is_audible(act) || play_is_stop(act) || act->count < act->start + 2 || left_s <= 0.0) {
        return true;
    }
    const struct act_sample *first = &act->samples[act->start];
    const struct act_sample *last = &act->samples[act->count - 1];
    const double step_s = (last->t_s - first->t_s) / (last->step - first->step);
    (void)snprintf(line, sizeof line, "step %.0f", ceil(left_s / step_s));
    return play_must(story, line);
}

/* Samples that the step column shows to be missing: before the first one, in gaps, and after the last one. */
static double missing_of(const struct act *act)
{
    const double last = act->count > 0 ? act->samples[act->count - 1].step : 0.0;
    const double first = act->count > act->start ? act->samples[act->start].step : act->every;
    const double end = fields_number(act->status, "step");

    return first / act->every - 1.0 + act->missing + floor((end - last) / act->every);
}

/* The device's own count of what it could not send must explain every one of them. */
static void losses_check(struct story *story, struct act *act)
{
    const double drops = fields_number(act->status, "drops");

    act->missing = missing_of(act);
    if (!(drops >= act->missing && drops <= act->missing)) {
        story_fail(story, "act %d: %.0f samples are missing, the device counted %.0f", act->number, act->missing,
                   drops);
    } else if (act->missing > 0.0) {
        printf("(%.0f samples did not fit the line; the device counted them.)\n", drops);
    }
}

static bool act_play(struct story *story, struct act *act)
{
    char line[SESSION_COMMAND_MAX];

    story->record.act = act;
    if (!play_must(story, "status")) {
        return false;
    }
    (void)fields_text(story->session.answer, "hash", act->first_hash, sizeof act->first_hash);
    (void)snprintf(line, sizeof line, "demo %d", act->number);
    if (!stream_start(story, act) || !play_must(story, line) || !prolong(story, act) ||
        !play_must(story, "stream off") || !play_must(story, "status")) {
        return false;
    }
    (void)strcpy(act->status, story->session.answer);
    losses_check(story, act);
    if (!act->has_verdict) {
        story_fail(story, "act %d came without a verdict", act->number);
    }
    act->is_done = play_must(story, "list");
    return act->is_done;
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

static void acts_play(struct story *story)
{
    char emulated[16];

    const size_t wanted = story->act_count;

    story->act_count = 0;
    if (!play_must(story, "id")) {
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
    story->record.act = NULL;
    if (story->map.side > 0) {
        map_play(story);
    }
}

void play_all(struct story *story)
{
    if (session_open(&story->session, story->command, listen, story) == SESSION_LOST) {
        story_fail(story, "%s", story->session.failure);
        story->act_count = 0;
        return;
    }
    acts_play(story);
    session_close(&story->session);
    story->record.act = NULL;
}
