/* The steering end of the link, against a line that answers well, late, twice, with refusals, or not at all. */
#include "protocol/master.h"

#include "base/bytes.h"
#include "base/mem.h"
#include "controller.h"
#include "tap.h"
#include "tests.h"

enum { LINE_SIZE = 1024 };

static struct master master;
static struct text sent;
static uint8_t sent_bytes[LINE_SIZE];
static struct frame_receiver device;
static struct frame heard; /* by the device, or from it */

static void open(void)
{
    master_init(&master);
    text_init(&sent, sent_bytes, sizeof sent_bytes);
    frame_open(&device);
}

/* What the device hears of all that was sent: how many frames, the last in heard. */
static unsigned hear(unsigned *zeros)
{
    unsigned frames = 0u;
    size_t size;

    *zeros = 0u;
    for (const uint8_t *bytes = text_peek(&sent, &size); size > 0u; bytes = text_peek(&sent, &size)) {
        *zeros += bytes[0] == 0u ? 1u : 0u;
        frames += frame_take(&device, bytes[0], &heard) ? 1u : 0u;
        text_drop(&sent, 1u);
    }
    return frames;
}

/* What the master makes of a frame from the device. */
static enum master_event tell(uint8_t type, uint16_t sequence, uint32_t step, const void *payload, size_t size)
{
    static uint8_t storage[LINE_SIZE];
    struct text line;
    enum master_event event = MASTER_NOTHING;
    const uint8_t *bytes;
    size_t count;

    text_init(&line, storage, sizeof storage);
    (void)frame_write(&line, &(struct frame){type, sequence, step, payload, size});
    bytes = text_peek(&line, &count);
    for (size_t i = 0u; i < count && event == MASTER_NOTHING; i++) {
        event = master_take(&master, bytes[i], &heard);
    }
    return event;
}

static void check_asking(void)
{
    static const uint8_t eight[8] = {1, 2, 3, 4, 5, 6, 7, 8};
    unsigned zeros;

    open();
    tap_check(master_ask(&master, &sent, LINK_PING, eight, sizeof eight) && hear(&zeros) == 1u && zeros == 2u &&
                  heard.type == LINK_PING && heard.sequence == 1u && heard.size == 8u &&
                  memcmp(heard.payload, eight, 8u) == 0,
              "a first request comes behind a 00 that clears the line");
    tap_check(tell(LINK_PING + LINK_REPLY, 1u, 7u, eight, 8u) == MASTER_ANSWERED && heard.size == 8u, "its reply");
    tap_check(master_ask(&master, &sent, LINK_STATUS, NULL, 0u) && hear(&zeros) == 1u && zeros == 1u &&
                  heard.sequence == 2u,
              "the next needs no clearing");
    tap_check(master_ask_again(&master, &sent) && hear(&zeros) == 1u && zeros == 2u && heard.type == LINK_STATUS &&
                  heard.sequence == 2u,
              "once more, the same, behind a 00");
    tap_check(tell(LINK_STATUS + LINK_REPLY, 2u, 7u, NULL, 0u) == MASTER_ANSWERED &&
                  tell(LINK_STATUS + LINK_REPLY, 2u, 7u, NULL, 0u) == MASTER_STRAY && master.strays == 1u,
              "answered twice: the second one is a stray");
    tap_check(!master_ask_again(&master, &sent), "nothing waits: nothing to repeat");
}

static void check_sorting(void)
{
    static const uint8_t error[LINK_ERROR_SIZE] = {LINK_PING, ERROR_BUSY, 3, 4, 0, 0, 0, 0, 0, 0x80, 0x3f};
    struct master_refusal refusal;

    open();
    (void)master_ask(&master, &sent, LINK_PING, "12345678", 8u);
    tap_check(tell(LINK_SAMPLE, 1u, 3u, "abcd", 4u) == MASTER_UNASKED && master.is_waiting,
              "a sample comes by itself, whatever its number");
    tap_check(tell(LINK_PING + LINK_REPLY, 2u, 3u, NULL, 0u) == MASTER_STRAY &&
                  tell(LINK_STATUS + LINK_REPLY, 1u, 3u, NULL, 0u) == MASTER_STRAY && master.is_waiting,
              "replies to something else");
    tap_check(tell(LINK_ERROR, 1u, 3u, error, 14u) == MASTER_STRAY, "an ERROR of another length is none");
    tap_check(tell(LINK_ERROR, 1u, 3u, error, sizeof error) == MASTER_REFUSED && !master.is_waiting, "refused");
    master_read_refusal(&heard, &refusal);
    tap_check(refusal.type == LINK_PING && refusal.error == ERROR_BUSY && refusal.index == 3u &&
                  refusal.expected == 4u && refusal.low == 1.0f && refusal.high == 0.0f,
              "and why");
}

static void check_steps(void)
{
    const struct input_demand demand = {.load = INPUT_LOAD_FORCE, .load_value = 2.0f};
    static const uint8_t error[LINK_ERROR_SIZE] = {LINK_STEP, ERROR_BAD_STEP};
    struct bytes_reader reader;
    unsigned zeros;

    open();
    tap_check(master_step(&master, &sent, 10u, &demand) && hear(&zeros) == 1u && heard.sequence == 1u &&
                  heard.step == 0u && heard.size == 14u,
              "STEP from step 0");
    reader = (struct bytes_reader){.bytes = heard.payload, .size = heard.size};
    tap_check(bytes_get_u32(&reader) == 10u && bytes_get_u8(&reader) == INPUT_LOAD_FORCE &&
                  bytes_get_u8(&reader) == INPUT_SPEED_KEEP && bytes_get_f32(&reader) == 2.0f,
              "with its demand");
    tap_check(tell(LINK_ERROR, 1u, 5u, error, sizeof error) == MASTER_REFUSED, "refused, for the plant stands at 5");
    (void)master_step(&master, &sent, 10u, &demand);
    (void)hear(&zeros);
    tap_check(heard.sequence == 1u && heard.step == 5u, "does not count; the next is from there");
    tap_check(tell(LINK_STEP + LINK_REPLY, 1u, 15u, NULL, 0u) == MASTER_ANSWERED, "answered");
    (void)master_ask(&master, &sent, LINK_STATUS, NULL, 0u);
    (void)tell(LINK_STATUS + LINK_REPLY, 1u, 15u, NULL, 0u);
    (void)master_step(&master, &sent, 10u, &demand);
    (void)hear(&zeros);
    tap_check(heard.sequence == 2u && heard.step == 15u, "steps count by themselves, beside other requests");
    (void)tell(LINK_STEP + LINK_REPLY, 2u, 25u, NULL, 0u);
    (void)master_step(&master, &sent, 1u, &(struct input_demand){.starts = true});
    (void)hear(&zeros);
    tap_check(heard.payload[4] == INPUT_LOAD_KEEP + LINK_STARTS, "an explicit start is said with the kind of load");
}

/* Refused, but asked twice for want of an answer: the second refusal comes when the next STEP already waits. */
static void check_echo(void)
{
    const struct input_demand demand = {.load = INPUT_LOAD_KEEP};
    static const uint8_t error[LINK_ERROR_SIZE] = {LINK_STEP, ERROR_BUSY};
    unsigned zeros;

    open();
    (void)master_step(&master, &sent, 10u, &demand);
    (void)master_ask_again(&master, &sent);
    (void)hear(&zeros);
    tap_check(tell(LINK_ERROR, 1u, 0u, error, sizeof error) == MASTER_REFUSED, "a STEP asked twice is refused");
    (void)master_step(&master, &sent, 10u, &demand);
    tap_check(tell(LINK_ERROR, 1u, 0u, error, sizeof error) == MASTER_STRAY && master.is_waiting,
              "its second refusal is no answer to the next STEP");
    tap_check(tell(LINK_ERROR, 1u, 0u, error, sizeof error) == MASTER_REFUSED, "a third one is");
}

static void check_room(void)
{
    struct text narrow;
    uint8_t bytes[128];

    open();
    text_init(&narrow, bytes, sizeof bytes);
    tap_check(!master_ask(&master, &narrow, LINK_PING, "12345678", 8u) && !master.is_waiting && master.sequence == 0u,
              "without room nothing is asked");
}

/* Against the real thing: what link_steps.c writes is what is read here. */
static void check_state(void)
{
    const struct sample *now = &bench.executive.report_store.now;
    struct master_state state;
    struct frame frame;

    bench_open();
    (void)load_preset("brake", 5u);
    say(LINK_STEP, 1u, 0u);
    bytes_put_u32(&fields, 300u);
    bytes_put_u8(&fields, INPUT_LOAD_FORCE);
    bytes_put_u8(&fields, INPUT_SPEED_DISC);
    bytes_put_f32(&fields, 1500.0f);
    bytes_put_f32(&fields, 0.0625f);
    tap_check(is_answered(), "a device steps");
    frame = (struct frame){.payload = reply.payload, .size = reply.size};
    master_read_state(&frame, &state);
    tap_check(state.step == 300u && state.hash == now->hash && state.disc_m_per_s == 0.0625f &&
                  state.load_n > 1499.0f && state.load_n < 1501.0f && state.mode == now->mode &&
                  state.propensity == now->propensity && state.flags == 0u && state.x_m > 0.0f &&
                  state.friction_n > 0.0f,
              "its state, field by field");
}

void test_master(void)
{
    check_asking();
    check_sorting();
    check_steps();
    check_echo();
    check_room();
    check_state();
}
