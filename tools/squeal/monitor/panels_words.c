/* The rows of text: header, motion, inputs, counters, message. */
#include "squeal/monitor/panels_parts.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { TEXT_SIZE = 512, DOT = 0x25cf };

static void tell_pace(char *out, size_t size, const struct picture *picture)
{
    const double pace = picture->pace;

    if (picture->state != 1u || !(pace > 0.0)) {
        (void)snprintf(out, size, "%s", picture->state == 1u ? "running" : picture->state == 2u ? "fault" : "stopped");
    } else if (pace < 0.95) {
        (void)snprintf(out, size, "running, slow motion 1:%.*f", pace > 0.1 ? 1 : 0, 1.0 / pace);
    } else if (pace > 1.05) {
        (void)snprintf(out, size, "running, %.*f times as fast", pace < 10.0 ? 1 : 0, pace);
    } else {
        (void)snprintf(out, size, "running, real time");
    }
}

void panels_draw_header(struct screen *screen, const struct picture *picture)
{
    const int end = screen->cols - PANELS_MARGIN;
    char pace[TEXT_SIZE];
    int state_col, col = PANELS_MARGIN;

    tell_pace(pace, sizeof pace, picture);
    state_col = end - panels_width(pace) - 2;
    col += screen_text(screen, 0, col, state_col - 2 - col, TINT_STRONG, "squeal") + 2;
    col += screen_text(screen, 0, col, state_col - 2 - col, TINT_PLAIN, picture->preset) + 2;
    col += screen_text(screen, 0, col, state_col - 2 - col, TINT_DIM, picture->board) + 2;
    (void)screen_text(screen, 0, col, state_col - 2 - col, TINT_DIM, picture->port);
    screen_put(screen, 0, state_col, DOT,
               picture->state == 1u   ? TINT_QUIET
               : picture->state == 2u ? TINT_SQUEAL
                                      : TINT_DIM);
    panels_print_left_of(screen, 0, end, TINT_PLAIN, pace);
}

void panels_draw_motion(struct screen *screen, const struct picture *picture, int row)
{
    const int end = screen->cols - PANELS_MARGIN;
    const int taken = screen_text(screen, row, PANELS_MARGIN, end - PANELS_MARGIN, TINT_PLAIN, picture->motion);

    if (panels_width(picture->forecast) + taken + 4 < end - PANELS_MARGIN) {
        panels_print_left_of(screen, row, end, TINT_DIM, picture->forecast);
    }
}

/* A value and the keys that turn it: "n/N  N 3000 N". */
static int draw_input(struct screen *screen, int row, int col, char key, const struct picture_input *input)
{
    const int begin = col;
    const int room = screen->cols - PANELS_MARGIN - col;
    const bool differs = isfinite(input->held) && fabs(input->held - input->set) > 0.005 * fabs(input->set) + 1e-9;

    col += panels_print(screen, row, col, room, TINT_KEY, "%c/%c", key, key - 'a' + 'A') + 1;
    col += panels_print(screen, row, col, room, TINT_DIM, "%s ", input->name);
    col += isfinite(input->set) ? panels_print(screen, row, col, room, TINT_STRONG, "%.5g %s", input->set, input->unit)
                                : panels_print(screen, row, col, room, TINT_DIM, "-");
    col += differs ? panels_print(screen, row, col, room, TINT_DIM, " now %.4g", input->held) : 0;
    return col - begin;
}

void panels_draw_inputs(struct screen *screen, const struct picture *picture, int row)
{
    static const char keys[PICTURE_INPUTS] = {'n', 'v', 'a'};
    int col = PANELS_MARGIN;

    for (size_t i = 0u; i < PICTURE_INPUTS; i++) {
        col += draw_input(screen, row, col, keys[i], &picture->input[i]) + 3;
    }
    if (isfinite(picture->steps_per_s)) {
        col += screen_text(screen, row, col, screen->cols - PANELS_MARGIN - col, TINT_KEY, "-/+") + 1;
        (void)panels_print(screen, row, col, screen->cols - PANELS_MARGIN - col, TINT_DIM, "%g steps/s",
                           picture->steps_per_s);
    }
}

/* Text that goes on in the next row when one is full; what has no room in the last one is left out. */
struct flow {
    struct screen *screen; /* NULL: only to see whether there is room */
    int end, row, col, last_row;
    bool is_full; /* something was left out */
};

static void flow_put(struct flow *flow, const char *name, const char *value, enum tint tint)
{
    const int width = panels_width(name) + 1 + panels_width(value);

    if (flow->col + width > flow->end && flow->row < flow->last_row) {
        flow->row++;
        flow->col = PANELS_MARGIN;
    }
    if (flow->col + width > flow->end) {
        flow->is_full = true;
        return;
    }
    if (flow->screen != NULL) {
        (void)screen_text(flow->screen, flow->row, flow->col, width, TINT_DIM, name);
        panels_print_left_of(flow->screen, flow->row, flow->col + width, tint, value);
    }
    flow->col += width + 2;
}

static void put_position(struct flow *flow, const struct picture *picture)
{
    const struct picture_counters *counters = &picture->counters;
    char text[32];
    char offered[32];
    char both[72];

    picture_count(text, sizeof text, picture->step);
    flow_put(flow, "step", text, TINT_PLAIN);
    picture_quantity(text, sizeof text, (double)picture->step * picture->trace.step_s, "s");
    flow_put(flow, "t", text, TINT_PLAIN);
    (void)snprintf(text, sizeof text, "%.3g", picture->sigma);
    flow_put(flow, "sigma", text, TINT_PLAIN);
    picture_count(text, sizeof text, picture->trace.every);
    flow_put(flow, "every", text, TINT_PLAIN);
    picture_count(text, sizeof text, counters->sent);
    picture_count(offered, sizeof offered, counters->offered);
    (void)snprintf(both, sizeof both, "%s of %s", text, offered);
    flow_put(flow, "sent", both, TINT_PLAIN);
}

/* What should be 0 stands out where it is not. */
static void put_losses(struct flow *flow, const struct picture *picture, bool has_zeros)
{
    const struct picture_counters *counters = &picture->counters;
    const struct {
        const char *name;
        uint64_t count;
    } losses[] = {{"dropped", counters->dropped}, {"lost", picture->trace.lost}, {"overruns", counters->overruns},
                  {"shed", counters->shed},       {"caps", counters->caps},      {"saturated", counters->saturations},
                  {"refused", counters->refused}, {"CRC", counters->bad_crc}};
    char text[32];

    for (size_t i = 0u; i < sizeof losses / sizeof losses[0]; i++) {
        picture_count(text, sizeof text, losses[i].count);
        if (losses[i].count > 0u || has_zeros) {
            flow_put(flow, losses[i].name, text, losses[i].count > 0u ? TINT_WATCH : TINT_PLAIN);
        }
    }
}

/* Where there is no room for all of them, zeros go first. */
void panels_draw_counters(struct screen *screen, const struct picture *picture, int row)
{
    struct flow flow = {screen, screen->cols - PANELS_MARGIN, row, PANELS_MARGIN, row + PANELS_COUNTER_ROWS - 1, false};
    struct flow trial;

    put_position(&flow, picture);
    trial = flow;
    trial.screen = NULL;
    put_losses(&trial, picture, true);
    put_losses(&flow, picture, !trial.is_full);
}

/* A long one takes the row above as well. */
static void draw_message(struct screen *screen, const struct picture *picture, int row)
{
    const enum tint tint = picture->is_refusal ? TINT_WATCH : TINT_PLAIN;
    const int room = screen->cols - 2 * PANELS_MARGIN;
    const char *text = picture->message;
    size_t length = strlen(text);

    if (panels_width(text) > room) {
        for (length = (size_t)room; length > 0u && text[length] != ' '; length--) {
        }
        length = length > 0u ? length : (size_t)room;
        for (int col = 0; col < screen->cols; col++) {
            screen_put(screen, row - 1, col, ' ', TINT_PLAIN);
        }
        (void)panels_print(screen, row - 1, PANELS_MARGIN, room, tint, "%.*s", (int)length, text);
        text += length + (text[length] == ' ' ? 1u : 0u);
    }
    (void)screen_text(screen, row, PANELS_MARGIN, room, tint, text);
}

void panels_draw_bottom(struct screen *screen, const struct picture *picture)
{
    static const struct {
        const char *key, *name;
    } hints[] = {{"space", "run or stop"}, {"r", "reset"}, {"p", "presets"},
                 {"[ ]", "time shown"},    {"h", "help"},  {"q", "quit"}};
    const int row = screen->rows - 1;
    const int end = screen->cols - PANELS_MARGIN;
    int col = PANELS_MARGIN;

    if (picture->message[0] != '\0') {
        draw_message(screen, picture, row);
        return;
    }
    for (size_t i = 0u; i < sizeof hints / sizeof hints[0]; i++) {
        col += screen_text(screen, row, col, end - col, TINT_KEY, hints[i].key) + 1;
        col += screen_text(screen, row, col, end - col, TINT_DIM, hints[i].name) + 3;
    }
}
