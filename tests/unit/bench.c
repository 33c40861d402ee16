/* The bench. */
#include "bench.h"

#include "base/mem.h"

struct bench bench;

static uint8_t storage[2 * CONSOLE_ANSWER_MAX];
static uint8_t link_storage[1024];

struct bench_frame bench_samples[BENCH_SAMPLES_MAX];
size_t bench_sample_count;
bool bench_link_is_read;

static struct bench_frame reply_heard;
static bool has_reply;

struct bench_frame bench_results[BENCH_RESULTS_MAX];
size_t bench_result_count;

static const struct identity identity = {.version = "0.0.0",
                                         .build = "test",
                                         .board = "bench",
                                         .core = "none",
                                         .is_emulated = false,
                                         .has_fpu = true,
                                         .has_link = true,
                                         .baud = BENCH_BAUD};

static char line[4096];
static size_t line_size;

bool bench_starts(const char *text, const char *part)
{
    while (*part != '\0' && *text == *part) {
        text++;
        part++;
    }
    return *part == '\0';
}

bool bench_holds(const char *text, const char *part)
{
    for (; *text != '\0'; text++) {
        if (bench_starts(text, part)) {
            return true;
        }
    }
    return false;
}

static void hear_line(void)
{
    line[line_size] = '\0';
    line_size = 0u;
    if (bench_starts(line, "ok ") || bench_starts(line, "error ")) {
        bench.oks += line[0] == 'o' ? 1u : 0u;
        bench.errors += line[0] == 'e' ? 1u : 0u;
        memcpy(bench.last, line, sizeof line);
    } else if (line[0] == '!') {
        bench.notices++;
    } else if (line[0] >= '0' && line[0] <= '9') {
        bench.samples++;
    }
}

static void hear(uint8_t byte)
{
    if (bench.heard_size < BENCH_HEARD_MAX - 1u) {
        bench.heard[bench.heard_size++] = (char)byte;
        bench.heard[bench.heard_size] = '\0';
    }
    if (byte == '\n') {
        hear_line();
    } else if (byte != '\r' && line_size < sizeof line - 1u) {
        line[line_size++] = (char)byte;
    }
}

static void send(size_t room)
{
    size_t size;

    while (room > 0u) {
        const uint8_t *bytes = text_peek(&bench.text, &size);

        size = size < room ? size : room;
        if (size == 0u) {
            return;
        }
        for (size_t i = 0u; i < size; i++) {
            hear(bytes[i]);
        }
        text_drop(&bench.text, size);
        room -= size;
    }
}

static void keep(struct bench_frame *kept, const struct frame *frame)
{
    *kept = (struct bench_frame){
        .type = frame->type, .sequence = frame->sequence, .step = frame->step, .size = frame->size};
    memcpy(kept->payload, frame->payload, frame->size);
}

static void hear_link(void)
{
    struct frame frame;
    size_t size;
    const uint8_t *bytes = text_peek(&bench.link_text, &size);

    for (size_t i = 0u; i < size; i++) {
        if (!frame_take(&bench.controller, bytes[i], &frame)) {
            continue;
        }
        if (frame.type == LINK_POINT || frame.type == LINK_BORDER || frame.type == LINK_STUDY_END) {
            if (bench_result_count < BENCH_RESULTS_MAX) {
                keep(&bench_results[bench_result_count++], &frame);
            }
        } else if (frame.type != LINK_SAMPLE) {
            keep(&reply_heard, &frame);
            has_reply = true;
        } else if (bench_sample_count < BENCH_SAMPLES_MAX) {
            keep(&bench_samples[bench_sample_count++], &frame);
        }
    }
    text_drop(&bench.link_text, size);
}

bool bench_link_turns(const uint8_t *bytes, size_t size, unsigned turns, struct bench_frame *reply)
{
    bool is_busy;

    has_reply = false;
    for (unsigned i = 0u; i < turns && !has_reply; i++) {
        const size_t taken = link_receive(&bench.link, bytes, size);

        bytes += taken;
        size -= taken;
        (void)bench_turn("", 0u, SIZE_MAX, &is_busy);
    }
    *reply = reply_heard;
    return has_reply;
}

bool bench_ask(const struct bench_frame *request, struct bench_frame *reply, unsigned limit)
{
    static uint8_t wire_bytes[512];
    struct text wire;
    size_t size;
    const uint8_t *bytes;

    text_init(&wire, wire_bytes, sizeof wire_bytes);
    (void)frame_write(&wire, &(struct frame){.type = request->type,
                                             .sequence = request->sequence,
                                             .step = request->step,
                                             .payload = request->payload,
                                             .size = request->size});
    bytes = text_peek(&wire, &size);
    return bench_link_turns(bytes, size, limit, reply);
}

void bench_listen_anew(void)
{
    bench.heard_size = 0u;
    bench.heard[0] = '\0';
    bench.last[0] = '\0';
    bench.oks = 0u;
    bench.errors = 0u;
    bench.notices = 0u;
    bench.samples = 0u;
}

size_t bench_turn(const char *bytes, size_t size, size_t room, bool *is_busy)
{
    const size_t taken = console_receive(&bench.console, (const uint8_t *)bytes, size);

    *is_busy = console_poll(&bench.console);
    *is_busy = link_poll(&bench.link) || *is_busy;
    if (executive_has_order(&bench.executive)) {
        executive_tick(&bench.executive, false);
    }
    if (executive_wants_tick(&bench.executive)) {
        executive_tick(&bench.executive, true);
    }
    *is_busy = console_poll(&bench.console) || *is_busy;
    *is_busy = link_poll(&bench.link) || *is_busy;
    send(room);
    if (bench_link_is_read) {
        hear_link();
    }
    return taken;
}

const char *bench_say(const char *text)
{
    size_t size = 0u;
    bool is_busy = true;

    while (text[size] != '\0') {
        size++;
    }
    bench_listen_anew();
    while (size > 0u || is_busy || bench.console.task != CONSOLE_TASK_NONE || bench.text.head != bench.text.tail) {
        const size_t taken = bench_turn(text, size, SIZE_MAX, &is_busy);

        text += taken;
        size -= taken;
    }
    return bench.last;
}

void bench_wait(unsigned turns)
{
    bool is_busy;

    for (; turns > 0u; turns--) {
        (void)bench_turn("", 0u, SIZE_MAX, &is_busy);
    }
}

void bench_open(void)
{
    line_size = 0u;
    executive_init(&bench.executive, ARITH_F32);
    text_init(&bench.text, storage, sizeof storage);
    bench.turn = (struct turn){.holder = TURN_NOBODY};
    memset(&bench.work, 0, sizeof bench.work);
    console_init(&bench.console, &bench.executive, &bench.turn, &bench.work, &bench.text, &identity);
    text_init(&bench.link_text, link_storage, sizeof link_storage);
    link_init(&bench.link, &bench.executive, &bench.turn, &bench.work, &bench.link_text, &identity);
    frame_open(&bench.controller);
    bench_sample_count = 0u;
    bench_result_count = 0u;
    bench_link_is_read = true;
    (void)bench_say("echo off\r");
    bench_listen_anew();
}
