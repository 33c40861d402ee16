/* The fuzzer's way in: what the bytes of an input do to the two lines of one firmware.
 *
 *   00 .. 7f             typed on the console; a line end goes with a round of the main loop
 *   80 .. 8f             1 to 16 rounds
 *   90 T payload         a request of the T-th type, of its length, as a client would say it next; and a round
 *   91 T S S s s s s n payload   a frame of any type, sequence, step and length; and a round
 *   92 n patches         the run is fetched, gets up to 3 patches of a byte or a word, a right CRC, and is put back
 *   a0 .. af bytes       1 to 16 bytes as they are to the link
 *   b0 .. bf bytes       1 to 16 bytes as they are to the console
 *   c0 .. c7, c8 .. cf   1 to 8 bytes are lost on the console, on the link
 *   d0 .. df, e0 .. ef   the reader of the console, of the link: stopped, or takes 1, 2, 4 .. bytes a round, or all
 *   f0 .. f3             where in a round the interrupt comes
 *   f4 .. f7             how slow the clock makes the interrupt: not, a little, a period, ten
 *   f8                   the next tick is late
 *   f9                   the next tick comes a period too late
 *
 * An input gets so many rounds and steps of the plant, and no more. Then both readers read on, a stop is said on both
 * lines, and all must come to rest. */
#include "input.h"

#include <string.h>

#include "base/bytes.h"
#include "base/crc32.h"
#include "board.h"
#include "firmware.h"
#include "watch.h"

enum {
    ROUNDS_MAX = 32,
    STEPS_MAX = 640,
    LONG_ROUND = 24,
    ROUNDS_TO_REST = 4096,
    STOP_EVERY = 32,
    STEP_MAX = 1024,
    STEP_OBEYED_MAX = 1000000,
    RUN_ROUNDS = 20,
    ROUNDS_OF_PIECE = 8,
    PATCHES_MAX = 3,
    PATCH_BYTES = 128,
    WORD_SIZE = 4,
    SMALL = 16
};

static struct bytes_reader input;
static uint32_t rounds_left;

static const struct request {
    uint8_t type, size;
} requests[] = {
#define MESSAGE(type, field, name, request, reply, help) {type, request},
#include "protocol/messages.def"
#undef MESSAGE
};

static bool is_over(void) { return input.offset == input.size || input.is_short; }

static void go_round(void)
{
    board_begin_round();
    firmware_round();
    watch_round();
}

/* Studies, self-tests and analyses take many steps a round. */
static bool is_long(void)
{
    static const char analysis[] = "analyse";
    const struct link *link = firmware.link;

    return firmware.turn->studies != TURN_NOBODY || firmware.console->task == CONSOLE_TASK_SELFTEST ||
           (link->has_request && link->request.type == LINK_SELFTEST) ||
           memcmp(firmware.console->command, analysis, sizeof analysis - 1u) == 0;
}

static void spend_round(void)
{
    const uint32_t price = is_long() ? LONG_ROUND : 1u;

    if (rounds_left < price) {
        rounds_left = 0u;
        return;
    }
    rounds_left -= price;
    go_round();
}

/* --- What is said ------------------------------------------------------------------------------------------------- */

static void send_frame(const struct frame *frame)
{
    static uint8_t storage[512];
    struct text wire;

    text_init(&wire, storage, sizeof storage);
    (void)frame_write(&wire, frame);
    board_receive(HAL_UART_LINK, storage, wire.head);
}

static void say_frame(const struct frame *frame)
{
    send_frame(frame);
    spend_round();
}

static void take_bytes(uint8_t *bytes, size_t size)
{
    for (size_t i = 0u; i < size; i++) {
        bytes[i] = bytes_get_u8(&input);
    }
}

static void put_word(uint8_t *bytes, uint32_t word)
{
    struct bytes_writer writer = {.bytes = bytes, .capacity = WORD_SIZE};

    bytes_put_u32(&writer, word);
}

/* A console whose waiting lines fill their place cannot stop a STEP: one that is obeyed gets a length that can be
 * awaited. */
static void shorten_step(uint8_t *payload)
{
    struct bytes_reader reader = {.bytes = payload, .size = 4u};
    const uint32_t count = bytes_get_u32(&reader);

    put_word(payload, count <= STEP_OBEYED_MAX ? count % STEP_MAX : count);
}

static void say_request(void)
{
    const struct request *request = &requests[bytes_get_u8(&input) % BASE_COUNT(requests)];
    uint8_t payload[FRAME_PAYLOAD_MAX];
    struct frame frame = {.type = request->type, .payload = payload, .size = request->size};

    take_bytes(payload, request->size);
    if (request->type == LINK_STEP) {
        frame.step = watch_client.step;
        frame.sequence = (uint16_t)(watch_client.step_sequence + 1u);
        shorten_step(payload);
    } else if (request->type == LINK_COMMIT) {
        put_word(payload, watch_client.crc);
    }
    say_frame(&frame);
}

static void say_any_frame(void)
{
    uint8_t payload[FRAME_PAYLOAD_MAX] = {0};
    struct frame frame = {.type = bytes_get_u8(&input), .payload = payload};

    frame.sequence = bytes_get_u16(&input);
    frame.step = bytes_get_u32(&input);
    frame.size = bytes_get_u8(&input) % (FRAME_PAYLOAD_MAX + 1u);
    take_bytes(payload, frame.size);
    if (frame.type == LINK_STEP) {
        shorten_step(payload);
    }
    say_frame(&frame);
}

/* An image as the controller has it by now, with other bytes in some places. */
static void patch_image(uint8_t image[SNAPSHOT_SIZE])
{
    const uint8_t how = bytes_get_u8(&input);

    for (unsigned i = 0u; i < how % (PATCHES_MAX + 1u); i++) {
        const size_t at = bytes_get_u16(&input) % (SNAPSHOT_SIZE - 2u * WORD_SIZE);

        take_bytes(image + at, how < PATCH_BYTES ? WORD_SIZE : 1u);
    }
    put_word(image + SNAPSHOT_SIZE - WORD_SIZE, crc32_add(0u, image, SNAPSHOT_SIZE - WORD_SIZE));
}

static void say_restore(const uint8_t *image, uint16_t offset)
{
    const size_t left = (size_t)SNAPSHOT_SIZE - offset;
    uint8_t payload[4 + LINK_PIECE] = {0};
    struct bytes_writer writer = {.bytes = payload, .capacity = sizeof payload};

    bytes_put_u16(&writer, offset);
    bytes_put_u16(&writer, SNAPSHOT_SIZE);
    bytes_put_block(&writer, image + offset, left < LINK_PIECE ? left : LINK_PIECE);
    send_frame(&(struct frame){.type = LINK_RESTORE, .payload = payload, .size = sizeof payload});
    for (unsigned i = 0u; i < ROUNDS_OF_PIECE && board_has_input(); i++) {
        go_round();
    }
}

/* Its pieces are fetched by the harness, not over the line: only the first request makes them. The rounds that they
 * take on their way back are given on top, for a price that lets an input do it once. */
static void say_run(void)
{
    static const uint8_t first[2] = {0u, 0u};
    uint8_t image[SNAPSHOT_SIZE];

    if (rounds_left < RUN_ROUNDS || is_long()) {
        return;
    }
    rounds_left -= RUN_ROUNDS;
    say_frame(&(struct frame){.type = LINK_SNAPSHOT, .payload = first, .size = sizeof first});
    memcpy(image, firmware.executive->image, sizeof image);
    patch_image(image);
    for (uint16_t offset = 0u; offset < SNAPSHOT_SIZE; offset = (uint16_t)(offset + LINK_PIECE)) {
        say_restore(image, offset);
    }
}

static void say_bytes(enum hal_uart port, size_t size)
{
    uint8_t bytes[SMALL];

    size = size < input.size - input.offset ? size : input.size - input.offset;
    take_bytes(bytes, size);
    board_receive(port, bytes, size);
}

static void type(uint8_t byte)
{
    board_receive(HAL_UART_CONSOLE, &byte, 1u);
    if (byte == '\r' || byte == '\n') {
        spend_round();
    }
}

/* --- What happens ------------------------------------------------------------------------------------------------- */

static void set_reader(enum hal_uart port, unsigned low)
{
    board.lines[port].room = low == 0u ? 0u : low == SMALL - 1u ? BOARD_ALL : (size_t)1 << (low - 1u);
}

static void set_time(unsigned low)
{
    static const uint32_t busy[] = {0u, 1u, 125000u, 1250000u};

    if (low < BOARD_PLACES) {
        board.place = (enum board_place)low;
    } else if (low < BOARD_PLACES + BASE_COUNT(busy)) {
        board.busy = busy[low - BOARD_PLACES];
    } else if (low == BOARD_PLACES + BASE_COUNT(busy)) {
        board.is_late = true;
    } else {
        board.missed = 1u;
    }
}

static void do_next(void)
{
    const uint8_t byte = bytes_get_u8(&input);
    const unsigned low = byte & (SMALL - 1u);

    switch (byte >> 4u) {
    case 0x8:
        for (unsigned i = 0u; i <= low; i++) {
            spend_round();
        }
        break;
    case 0x9:
        if (low == 2u) {
            say_run();
        } else if ((low & 1u) == 0u) {
            say_request();
        } else {
            say_any_frame();
        }
        break;
    case 0xa:
        say_bytes(HAL_UART_LINK, low + 1u);
        break;
    case 0xb:
        say_bytes(HAL_UART_CONSOLE, low + 1u);
        break;
    case 0xc:
        board_lose(low < SMALL / 2u ? HAL_UART_CONSOLE : HAL_UART_LINK, low % (SMALL / 2u) + 1u);
        break;
    case 0xd:
        set_reader(HAL_UART_CONSOLE, low);
        break;
    case 0xe:
        set_reader(HAL_UART_LINK, low);
        break;
    case 0xf:
        set_time(low);
        break;
    default:
        type(byte);
    }
}

/* --- The end ------------------------------------------------------------------------------------------------------ */

static void say_stop(void)
{
    static const uint8_t delimiter[] = {0u};

    board_receive(HAL_UART_CONSOLE, "\rstop\r", 6u);
    board_receive(HAL_UART_LINK, delimiter, sizeof delimiter);
    say_frame(&(struct frame){.type = LINK_STOP});
}

static bool is_at_rest(void)
{
    return board.is_asleep && !board_has_input() && !firmware_has_input() && watch_unanswered() == 0u;
}

/* Whatever was under way ends. While one line is full of what waits, the other's stop makes room. */
static void come_to_rest(void)
{
    unsigned rounds = 0u;

    for (unsigned port = 0u; port < HAL_UART_COUNT; port++) {
        board_lose((enum hal_uart)port, 0u);
        board.lines[port].room = BOARD_ALL;
    }
    board.place = BOARD_BETWEEN_POLLS;
    board.busy = 0u;
    board.steps_left = UINT32_MAX;
    do {
        if (rounds % STOP_EVERY == 0u) {
            say_stop();
        }
        go_round();
        WATCH(++rounds < ROUNDS_TO_REST);
    } while (!is_at_rest());
}

/* Without echo what comes out can be told from what went in. */
static void begin(void)
{
    board_reset();
    firmware_start();
    watch_reset();
    board_receive(HAL_UART_CONSOLE, "echo off\r\n", 10u);
    go_round();
    watch_reset();
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    begin();
    board.steps_left = STEPS_MAX;
    rounds_left = ROUNDS_MAX;
    input = (struct bytes_reader){.bytes = bytes, .size = size};
    while (!is_over()) {
        do_next();
    }
    come_to_rest();
    watch_end();
    return 0;
}
