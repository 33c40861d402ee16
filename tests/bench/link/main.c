/* bench-link: how many turns of lockstep a second, beside what the line alone takes.
 *   bench-link --turns n --socket path -- firmware .. [-- echo ..]
 * The commands must listen at the path, one after the other; that of the firmware may take it from SQUEAL_LINK. The
 * second one is echo.c's image. All are asked in small lots in turn, so that what the machine does beside hits all
 * alike. Ends with 1 and a word to stderr where an answer is missing or is none. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "base/assert.h"
#include "base/bytes.h"
#include "model/presets.h"
#include "peer.h"
#include "protocol/master.h"
#include "wire.h"

enum { ROWS = 4, LOTS = 20, OUT_SIZE = 1024, WARM_UP = 20 };

static const char preset[] = "brake";

/* The tick is as fast as five steps allow, so that a turn waits for it as little as can be. */
static const struct {
    const char *symbol;
    float value;
} settings[] = {{"tick", 3000.0f}, {"substeps", 5.0f}};

struct row {
    const char *name;
    bool (*turn)(struct row *row);
    uint32_t steps;
    struct peer *peer;
    double *us; /* what each turn took */
    size_t count;
    double mean_us, median_us, p99_us;
};

static struct peer firmware = {.name = "firmware"}, bare = {.name = "echo image"}, process = {.name = "echo process"};
static struct master master;
static struct text out;
static uint8_t out_bytes[OUT_SIZE];

void base_assert_failed(const char *file, unsigned line)
{
    fprintf(stderr, "%s:%u: assertion failed\n", file, line);
    exit(1);
}

static double now_us(void)
{
    struct timespec now;

    (void)clock_gettime(CLOCK_MONOTONIC, &now);
    return 1e6 * (double)now.tv_sec + 1e-3 * (double)now.tv_nsec;
}

static bool refuse(const struct frame *frame)
{
    struct master_refusal refusal;

    master_read_refusal(frame, &refusal);
    fprintf(stderr, "firmware: refuses type 0x%02x with error %u\n", refusal.type, refusal.error);
    return false;
}

/* Sends what is in out, and waits for the reply. */
static bool hear(struct frame *reply)
{
    static uint8_t bytes[FRAME_WIRE_MAX];
    static size_t size, taken;
    const double until_us = now_us() + 1e6 * PEER_PATIENCE_S;
    size_t length;
    const uint8_t *const said = text_peek(&out, &length);

    if (!peer_send(&firmware, said, length)) {
        return false;
    }
    text_init(&out, out_bytes, sizeof out_bytes);
    while (now_us() < until_us) {
        if (taken == size) {
            taken = 0u;
            size = peer_receive(&firmware, bytes, sizeof bytes);
        }
        if (size == 0u) {
            return false;
        }
        switch (master_take(&master, bytes[taken++], reply)) {
        case MASTER_ANSWERED:
            return true;
        case MASTER_REFUSED:
            return refuse(reply);
        case MASTER_NOTHING:
        case MASTER_UNASKED:
        case MASTER_STRAY:
            break;
        }
    }
    fprintf(stderr, "firmware: no answer in time among what it says\n");
    return false;
}

static bool ask(enum link_message type, const struct bytes_writer *fields, struct frame *reply)
{
    return master_ask(&master, &out, type, fields->bytes, fields->size) && hear(reply);
}

static bool turn_step(struct row *row)
{
    static unsigned count;
    const struct input_demand demand = {.load = INPUT_LOAD_FORCE, .load_value = 2000.0f + (float)(count++ % 7u)};
    const uint32_t before = master.step;
    struct frame reply;

    if (!master_step(&master, &out, row->steps, &demand) || !hear(&reply)) {
        return false;
    }
    if (reply.step - before == row->steps) {
        return true;
    }
    fprintf(stderr, "firmware: made %" PRIu32 " steps instead of %" PRIu32 "\n", reply.step - before, row->steps);
    return false;
}

static bool turn_echo(struct row *row)
{
    static uint8_t bytes[WIRE_STEP_ANSWERED];
    size_t size = 0u;

    if (!peer_send(row->peer, bytes, WIRE_STEP_ASKED)) {
        return false;
    }
    while (size < WIRE_STEP_ANSWERED) {
        const size_t count = peer_receive(row->peer, bytes + size, sizeof bytes - size);

        if (count == 0u) {
            return false;
        }
        size += count;
    }
    return true;
}

static bool prepare(void)
{
    uint8_t bytes[16];
    struct bytes_writer fields = {.bytes = bytes, .capacity = sizeof bytes};
    struct bytes_reader answer;
    struct frame reply;
    uint32_t crc = 0u;

    bytes_put_u8(&fields, LINK_MAJOR);
    bytes_put_u8(&fields, LINK_MINOR);
    if (!ask(LINK_HELLO, &fields, &reply)) {
        return false;
    }
    fields.size = 0u;
    bytes_put_u8(&fields, (uint8_t)(presets_find(preset, strlen(preset)) - presets_table));
    if (!ask(LINK_PRESET, &fields, &reply)) {
        return false;
    }
    for (size_t i = 0u; i < sizeof settings / sizeof settings[0]; i++) {
        fields.size = 0u;
        bytes_put_u8(&fields, (uint8_t)(params_find(settings[i].symbol, strlen(settings[i].symbol)) - params_table));
        bytes_put_f32(&fields, settings[i].value);
        if (!ask(LINK_STAGE, &fields, &reply)) {
            return false;
        }
        answer = (struct bytes_reader){.bytes = reply.payload, .size = reply.size, .offset = 5u};
        crc = bytes_get_u32(&answer);
    }
    fields.size = 0u;
    bytes_put_u32(&fields, crc);
    bytes_put_u8(&fields, 1u);
    return ask(LINK_COMMIT, &fields, &reply);
}

static bool run_lot(struct row *row, size_t turns, bool is_busy)
{
    row->peer->is_busy = is_busy;
    for (size_t i = 0u; i < turns; i++) {
        const double begun_us = now_us();

        if (!row->turn(row)) {
            return false;
        }
        row->us[row->count++] = now_us() - begun_us;
    }
    return true;
}

static int compare(const void *a, const void *b)
{
    const double x = *(const double *)a;
    const double y = *(const double *)b;

    return (x > y) - (x < y);
}

static void weigh(struct row *row)
{
    double sum_us = 0.0;

    for (size_t i = 0u; i < row->count; i++) {
        sum_us += row->us[i];
    }
    qsort(row->us, row->count, sizeof row->us[0], compare);
    row->mean_us = sum_us / (double)row->count;
    row->median_us = row->us[row->count / 2u];
    row->p99_us = row->us[row->count * 99u / 100u];
}

static bool measure(struct row *first, struct row *end, size_t turns, bool is_busy)
{
    for (struct row *row = first; row < end; row++) {
        row->count = 0u;
        if (!run_lot(row, WARM_UP, is_busy)) {
            return false;
        }
        row->count = 0u;
    }
    for (size_t lot = 0u; lot < LOTS; lot++) {
        for (struct row *row = first; row < end; row++) {
            if (!run_lot(row, turns / LOTS, is_busy)) {
                return false;
            }
        }
    }
    return true;
}

/* All rows in one way of waiting. The row before the steps is what the others are measured by. */
static bool run(struct row *first, struct row *end, size_t turns, bool is_busy)
{
    const struct row *const least = end - 3;

    if (!measure(first, end, turns, is_busy)) {
        return false;
    }
    for (struct row *row = first; row < end; row++) {
        weigh(row);
    }
    printf("%-24s turns/s  mean us  median us  p99 us  median in %s\n",
           is_busy ? "the client polls" : "the client sleeps", least->name);
    for (const struct row *row = first; row < end; row++) {
        printf("  %-22s %7.0f %8.0f %10.0f %7.0f %7.2f\n", row->name, 1e6 / row->mean_us, row->mean_us, row->median_us,
               row->p99_us, row->median_us / least->median_us);
    }
    return true;
}

struct options {
    size_t turns;
    const char *socket;
    char **firmware, **echo; /* commands; the second one may be missing */
};

static bool read_options(char **argv, struct options *options)
{
    options->turns = strcmp(argv[1], "--turns") == 0 ? strtoul(argv[2], NULL, 10) : 0u;
    options->socket = strcmp(argv[3], "--socket") == 0 ? argv[4] : NULL;
    options->firmware = &argv[6];
    for (char **word = options->firmware; *word != NULL; word++) {
        if (strcmp(*word, "--") == 0) {
            *word = NULL;
            options->echo = word + 1;
            break;
        }
    }
    return options->turns >= LOTS && options->turns <= 10000000u && options->socket != NULL &&
           strcmp(argv[5], "--") == 0;
}

int main(int argc, char **argv)
{
    struct row rows[] = {{.turn = turn_echo, .peer = &process, .name = "two processes"},
                         {.turn = turn_echo, .peer = &bare, .name = "bare UART"},
                         {.turn = turn_step, .peer = &firmware, .name = "STEP of 1", .steps = 1u},
                         {.turn = turn_step, .peer = &firmware, .name = "STEP of 10", .steps = 10u}};
    struct row *first = rows;
    struct options options = {0};

    if (argc < 7 || !read_options(argv, &options)) {
        fprintf(stderr, "usage: bench-link --turns n --socket path -- firmware .. [-- echo ..]     n from %d\n", LOTS);
        return 2;
    }
    if (options.echo == NULL) {
        rows[1] = rows[0];
        first = &rows[1];
    }
    for (size_t i = 0u; i < ROWS; i++) {
        rows[i].us = calloc(options.turns + WARM_UP, sizeof rows[i].us[0]);
        if (rows[i].us == NULL) {
            return 1;
        }
    }
    text_init(&out, out_bytes, sizeof out_bytes);
    master_init(&master);
    if (!peer_echo(&process, WIRE_STEP_ASKED, WIRE_STEP_ANSWERED) ||
        (options.echo != NULL && !peer_start(&bare, options.echo, options.socket)) ||
        !peer_start(&firmware, options.firmware, options.socket) || !prepare()) {
        return 1;
    }
    printf("a turn: %d bytes there, %d back; %zu turns a row\n", WIRE_STEP_ASKED, WIRE_STEP_ANSWERED, options.turns);
    for (int is_busy = 1; is_busy >= 0; is_busy--) {
        if (!run(first, &rows[ROWS], options.turns, is_busy != 0)) {
            return 1;
        }
    }
    return 0;
}
