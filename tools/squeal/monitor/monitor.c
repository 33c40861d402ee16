/* One loop: bytes of the device, keys, and a frame when it is time for one. */
#include "squeal/monitor/monitor.h"

#include "squeal/monitor/feed.h"
#include "squeal/monitor/keys.h"
#include "squeal/monitor/lines.h"
#include "squeal/monitor/panels.h"
#include "squeal/monitor/picture.h"
#include "squeal/monitor/terminal.h"
#include "squeal/port/port.h"
#include "squeal/support/clock.h"

#include <errno.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

static const double FRAME_S = 1.0 / 15.0;
static const double LINE_S = 1.0;

enum { KEYS_READ = 64, MERGED_MAX = 64, OUTPUT_SIZE = 1 << 17, STANDARD_COLS = 80 };

struct monitor {
    struct device *device;
    struct feed feed;
    struct picture picture;
    struct screen screen;
    struct keys keys;
    int clicks[PICTURE_INPUTS]; /* since the last frame */
    bool is_ascii, is_over;
};

static void zoom(struct monitor *monitor, bool is_longer)
{
    unsigned *merged = &monitor->picture.merged;

    *merged = is_longer ? (*merged < MERGED_MAX ? 2u * *merged : MERGED_MAX) : *merged > 1u ? *merged / 2u : 1u;
    monitor->picture.strip = (struct axis){0.0, 0.0};
}

/* A key while the presets are shown. */
static enum device_result choose(struct monitor *monitor, int key)
{
    struct picture *picture = &monitor->picture;

    switch (key) {
    case KEY_UP:
    case 'k':
        picture->choice -= picture->choice > 0u ? 1u : 0u;
        return DEVICE_OK;
    case KEY_DOWN:
    case 'j':
        picture->choice += picture->choice + 1u < picture->choice_count ? 1u : 0u;
        return DEVICE_OK;
    case KEY_HOME:
        picture->choice = 0u;
        return DEVICE_OK;
    case KEY_END:
        picture->choice = picture->choice_count > 0u ? picture->choice_count - 1u : 0u;
        return DEVICE_OK;
    case KEY_ENTER:
        picture->overlay = PICTURE_PLAIN;
        return picture->choice < picture->choice_count ? feed_preset(&monitor->feed, picture->choice) : DEVICE_OK;
    default:
        picture->overlay = PICTURE_PLAIN;
        return DEVICE_OK;
    }
}

/* Turns an input, if the key does that. */
static bool turn(struct monitor *monitor, int key)
{
    static const struct {
        int key;
        size_t input;
        int clicks;
    } turns[] = {{'n', 0, -1}, {'N', 0, 1}, {KEY_DOWN, 0, -1},      {KEY_UP, 0, 1},
                 {'v', 1, -1}, {'V', 1, 1}, {KEY_LEFT, 1, -1},      {KEY_RIGHT, 1, 1},
                 {'a', 2, -1}, {'A', 2, 1}, {KEY_PAGE_DOWN, 2, -1}, {KEY_PAGE_UP, 2, 1}};

    for (size_t i = 0u; i < sizeof turns / sizeof turns[0]; i++) {
        if (turns[i].key == key) {
            monitor->clicks[turns[i].input] += turns[i].clicks;
            return true;
        }
    }
    return false;
}

static enum device_result obey(struct monitor *monitor, int key)
{
    struct picture *picture = &monitor->picture;

    if (key == 'q' || key == 'Q' || key == KEY_INTERRUPT) {
        monitor->is_over = true;
        return DEVICE_OK;
    }
    if (key >= '1' && key <= '9') {
        picture->overlay = PICTURE_PLAIN;
        return (size_t)(key - '1') < picture->choice_count ? feed_preset(&monitor->feed, (size_t)(key - '1'))
                                                           : DEVICE_OK;
    }
    if (picture->overlay == PICTURE_CHOOSER) {
        return choose(monitor, key);
    }
    if (picture->overlay == PICTURE_HELP) {
        picture->overlay = PICTURE_PLAIN; /* any key */
        return DEVICE_OK;
    }
    if (turn(monitor, key)) {
        return DEVICE_OK;
    }
    switch (key) {
    case ' ':
        return feed_run_or_stop(&monitor->feed);
    case 'r':
        return feed_reset(&monitor->feed);
    case '+':
    case '=':
    case '-':
        return feed_pace(&monitor->feed, key != '-');
    case ',':
    case '.':
        return feed_thin(&monitor->feed, key == '.');
    case '[':
    case ']':
        zoom(monitor, key == ']');
        return DEVICE_OK;
    case 'p':
        picture->overlay = PICTURE_CHOOSER;
        return DEVICE_OK;
    case 'h':
    case '?':
    case KEY_F1:
        picture->overlay = PICTURE_HELP;
        return DEVICE_OK;
    case KEY_SUSPEND:
        terminal_suspend();
        monitor->screen.is_known = false;
        return DEVICE_OK;
    case KEY_REDRAW:
        monitor->screen.is_known = false;
        return DEVICE_OK;
    default:
        return DEVICE_OK;
    }
}

static enum device_result read_keys(struct monitor *monitor)
{
    char bytes[KEYS_READ];
    const ssize_t count = read(STDIN_FILENO, bytes, sizeof bytes);
    enum device_result result = DEVICE_OK;

    if (count == 0 || (count < 0 && errno != EINTR && errno != EAGAIN)) {
        monitor->is_over = true; /* the terminal is gone */
    }
    for (ssize_t i = 0; i < count && result == DEVICE_OK; i++) {
        const int key = keys_take(&monitor->keys, bytes[i]);

        result = key != KEY_NONE ? obey(monitor, key) : DEVICE_OK;
    }
    return result;
}

/* All the clicks of a key that is held down in one change of the set. */
static enum device_result turn_inputs(struct monitor *monitor)
{
    enum device_result result = DEVICE_OK;

    for (size_t i = 0u; i < PICTURE_INPUTS && result == DEVICE_OK; i++) {
        if (monitor->clicks[i] != 0) {
            result = feed_turn(&monitor->feed, i, monitor->clicks[i]);
            monitor->clicks[i] = 0;
        }
    }
    return result;
}

static void draw(struct monitor *monitor)
{
    struct screen *screen = &monitor->screen;
    int rows, cols;

    terminal_size(&rows, &cols);
    if (!screen_has_size(screen, rows, cols)) {
        struct screen_style style = terminal_style();

        style.is_ascii = style.is_ascii || monitor->is_ascii;
        screen_open(screen, rows, cols, style);
    }
    panels_draw(screen, &monitor->picture);
    if (screen_show(screen, stdout) && (fflush(stdout) != 0 || ferror(stdout) != 0)) {
        monitor->is_over = true; /* nobody sees it */
    }
}

/* Waits for bytes or keys, at most until then. */
static enum device_result attend(struct monitor *monitor, bool has_keys, double until_s)
{
    const double wait_s = until_s - clock_now_s();
    struct pollfd places[] = {{.fd = device_port(monitor->device)->fd, .events = POLLIN},
                              {.fd = has_keys ? STDIN_FILENO : -1, .events = POLLIN}};
    enum device_result result = DEVICE_OK;

    if (poll(places, 2, wait_s > 0.0 ? (int)(1e3 * wait_s) + 1 : 0) <= 0) {
        return DEVICE_OK; /* a signal, or time */
    }
    if (places[0].revents != 0) {
        result = device_listen(monitor->device, 0.0);
    }
    if (result == DEVICE_OK && places[1].revents != 0) {
        result = read_keys(monitor);
    }
    return result;
}

static enum device_result frame(struct monitor *monitor, bool is_drawn)
{
    enum device_result result = turn_inputs(monitor);

    result = result == DEVICE_OK ? feed_look(&monitor->feed) : result;
    if (result == DEVICE_OK) {
        picture_update(&monitor->picture, panels_strip_cols(is_drawn ? monitor->screen.cols : STANDARD_COLS));
    }
    return feed_settle(&monitor->feed, result);
}

static enum device_result watch(struct monitor *monitor, bool is_drawn, double end_s)
{
    double frame_s = clock_now_s();
    double line_s = frame_s + LINE_S;
    enum device_result result = DEVICE_OK;

    while (result == DEVICE_OK && !monitor->is_over && clock_now_s() < end_s) {
        if (clock_now_s() < frame_s) {
            result = attend(monitor, is_drawn, frame_s < end_s ? frame_s : end_s);
            continue;
        }
        frame_s = clock_now_s() + FRAME_S;
        result = frame(monitor, is_drawn);
        if (result == DEVICE_OK && is_drawn) {
            draw(monitor);
        } else if (result == DEVICE_OK && clock_now_s() >= line_s) {
            line_s += LINE_S;
            monitor->is_over = !lines_print(stdout, &monitor->picture);
        }
    }
    return result;
}

enum device_result monitor_show(struct device *device, const struct monitor_options *options)
{
    static struct monitor monitor;
    const bool is_drawn = !options->is_lines && terminal_can_draw();
    enum device_result result;

    monitor = (struct monitor){.device = device, .is_ascii = options->is_ascii};
    picture_init(&monitor.picture);
    result = feed_open(&monitor.feed, device, &monitor.picture, options->preset, options->is_as_is);
    if (result == DEVICE_OK) {
        if (is_drawn) {
            (void)setvbuf(stdout, NULL, _IOFBF, OUTPUT_SIZE);
            (void)terminal_take();
        }
        result = watch(&monitor, is_drawn, clock_now_s() + options->seconds);
        terminal_give_back();
    }
    if (result == DEVICE_OK) {
        feed_close(&monitor.feed);
    }
    return result;
}
