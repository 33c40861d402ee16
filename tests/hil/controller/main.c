/* A controller to start from: it stops a vehicle with the brake at the other end of its UART 1, and keeps it from
 * squealing.
 *
 *     console (UART 0): orders in, journal out          link (UART 1): the plant
 *              \            main           /
 *               stop ---- law ---- conversation
 *
 * A turn: the plant's state gives the vehicle's new speed and the law's new pressure, and these are the next STEP. The
 * plant stands while the controller thinks, so nothing depends on how fast either of them is. */
#include "base/bytes.h"
#include "base/decimal.h"
#include "base/text.h"
#include "base/word.h"
#include "conversation.h"
#include "hal_board.h"
#include "hal_tick.h"
#include "hal_uart.h"
#include "journal.h"
#include "law.h"
#include "model/params.h"
#include "protocol/line.h"
#include "protocol/token.h"
#include "stop.h"

enum { CONSOLE_OUTPUT = 4096, INPUT_CHUNK = 64, LINES_A_TURN = 4 };

static struct text console_output, link_output;
static uint8_t console_bytes[CONSOLE_OUTPUT], link_bytes[CONVERSATION_OUTPUT];
static struct line line;
static struct conversation conversation;
static struct word ticks; /* the interrupt counts, main reads */
static uint32_t ticks_seen;

/* The stop under way. */
static struct {
    bool is_under_way, is_opened, has_turned;
    bool has_law;
    struct stop_settings settings;
    struct law_settings law_settings;
    struct stop stop;
    struct law law;
    float demand_pa, pressure_pa; /* of the turn under way */
} drive;

void app_tick(void)
{
    (void)hal_tick_take();
    word_write(&ticks, word_read(&ticks) + 1u);
}

/* --- Orders ------------------------------------------------------------------------------------------------------- */

static bool read_arithmetic(struct token word, float *arithmetic)
{
    *arithmetic = token_is(word, "f32") ? (float)ARITH_F32 : token_is(word, "q27") ? (float)ARITH_Q27 : -1.0f;
    return word.length == 0u || *arithmetic >= 0.0f;
}

static void obey(const char *order)
{
    const struct token stop = token_first(order), speed = token_next(stop), law = token_next(speed);
    const struct token arithmetic_name = token_next(law);
    float speed_m_per_s, arithmetic;

    if (!token_is(stop, "stop") || !decimal_parse_f32(speed.start, speed.length, &speed_m_per_s) ||
        !(token_is(law, "law") || token_is(law, "free")) || !read_arithmetic(arithmetic_name, &arithmetic) ||
        token_next(arithmetic_name).length != 0u) {
        (void)journal_error(&console_output, "not an order");
        return;
    }
    if (drive.is_under_way) {
        (void)journal_error(&console_output, "a stop is under way");
        return;
    }
    drive.is_under_way = true;
    drive.is_opened = false;
    drive.has_law = token_is(law, "law");
    drive.settings = stop_usual(speed_m_per_s);
    drive.stop = (struct stop){.speed_m_per_s = speed_m_per_s};
    drive.law = (struct law){.phase = LAW_BUILD};
    conversation_open(&conversation, arithmetic);
    hal_tick_start(CONVERSATION_TICK_HZ);
}

/* --- The stop ----------------------------------------------------------------------------------------------------- */

static void begin_drive(void)
{
    drive.is_opened = true;
    drive.has_turned = false;
    drive.stop = stop_start(&drive.settings, &conversation.brake);
    drive.law_settings = law_usual(brake_turn_s(&conversation.brake));
    drive.law = law_start(&drive.law_settings);
    (void)journal_opened(&console_output, &conversation.brake);
    (void)journal_header(&console_output);
}

static bool is_sound(void) { return (conversation.state.flags & LINK_IS_FAULT) == 0; }

/* What the last turn has brought. */
static void take_turn(void)
{
    const struct journal_turn turn = {&drive.stop,     &conversation.brake, &conversation.state,
                                      drive.demand_pa, drive.pressure_pa,   drive.law.phase};

    drive.stop = stop_next(&drive.settings, &drive.stop, &conversation.brake, &conversation.state);
    (void)journal_turn(&console_output, &turn);
}

static void make_turn(void)
{
    const enum law_phase before = drive.law.phase;

    drive.demand_pa = stop_demand_pa(&drive.settings, &drive.stop, &conversation.brake);
    if (drive.has_law) {
        const struct law_inputs inputs = {drive.demand_pa, conversation.state.propensity, is_sound()};

        drive.law = law_next(&drive.law_settings, &drive.law, &inputs);
    }
    drive.pressure_pa = drive.has_law ? drive.law.pressure_pa : drive.demand_pa;
    if (drive.law.phase != before) {
        (void)journal_phase(&console_output, stop_time_s(&drive.stop, &conversation.brake), &drive.law);
    }
    drive.has_turned = true;
    conversation_turn(&conversation, drive.pressure_pa, drive.stop.speed_m_per_s);
}

/* The law's last word. */
static void make_safe(void)
{
    drive.law = law_next(&drive.law_settings, &drive.law, &(struct law_inputs){.is_sound = false});
    (void)journal_phase(&console_output, stop_time_s(&drive.stop, &conversation.brake), &drive.law);
}

static void go_on(void)
{
    if (!drive.is_opened) {
        begin_drive();
    }
    if (drive.has_turned) {
        take_turn();
    }
    if (!is_sound()) {
        make_safe();
        conversation_release(&conversation);
    } else if (stop_is_over(&drive.settings, &drive.stop, &conversation.brake)) {
        conversation_release(&conversation);
    } else {
        make_turn();
    }
}

/* The talk is over: well, or not. */
static void end_drive(void)
{
    drive.is_under_way = false;
    hal_tick_stop();
    if (conversation.end != CONVERSATION_WELL) {
        make_safe();
    }
    if (conversation.end == CONVERSATION_REFUSED) {
        (void)journal_refused(&console_output, &conversation.refusal);
    } else if (conversation.end == CONVERSATION_LOST) {
        (void)journal_lost(&console_output, &conversation);
    } else {
        (void)journal_score(&console_output, drive.has_law, &drive.stop, &drive.law, &conversation);
    }
}

/* A turn begins when the console has room for all that may be said of it. */
static bool has_room(void) { return text_room(&console_output) >= LINES_A_TURN * JOURNAL_LINE_MAX; }

/* Returns true if there is more to do at once. */
static bool poll(void)
{
    if (!drive.is_under_way || !has_room()) {
        return false;
    }
    if (conversation.phase == CONVERSATION_CLOSED) {
        end_drive();
        return true;
    }
    if (conversation.phase == CONVERSATION_READY) {
        go_on();
        return true;
    }
    return false;
}

/* --- Lines and time ----------------------------------------------------------------------------------------------- */

static void pump_console(void)
{
    uint8_t bytes[INPUT_CHUNK];
    const size_t size = has_room() ? hal_uart_read(HAL_UART_CONSOLE, bytes, sizeof bytes) : 0u;

    for (size_t i = 0u; i < size; i++) {
        const enum line_state state = line_take(&line, bytes[i], &console_output);

        if (state == LINE_DONE) {
            obey(line.bytes);
        } else if (state == LINE_TOO_LONG || state == LINE_DAMAGED) {
            (void)journal_error(&console_output, "damaged line");
        }
    }
}

static bool pump_link(void)
{
    uint8_t bytes[INPUT_CHUNK];
    const size_t size = hal_uart_read(HAL_UART_LINK, bytes, sizeof bytes);

    for (size_t i = 0u; i < size; i++) {
        conversation_take(&conversation, bytes[i]);
    }
    return size > 0u;
}

static void pump_time(void)
{
    for (const uint32_t now = word_read(&ticks); ticks_seen != now; ticks_seen++) {
        conversation_pass(&conversation);
    }
}

/* Returns true when all is sent. */
static bool pump_output(enum hal_uart port, struct text *output)
{
    size_t size;
    const uint8_t *bytes = text_peek(output, &size);

    if (size > 0u) {
        text_drop(output, hal_uart_write(port, bytes, size));
    }
    (void)text_peek(output, &size);
    return size == 0u;
}

int main(void)
{
    text_init(&console_output, console_bytes, sizeof console_bytes);
    text_init(&link_output, link_bytes, sizeof link_bytes);
    line_init(&line);
    line.has_echo = false;
    conversation_init(&conversation, &link_output);
    (void)journal_greeting(&console_output, hal_board_name());
    for (;;) {
        bool is_busy;

        pump_console();
        is_busy = pump_link();
        pump_time();
        is_busy = poll() || is_busy;
        is_busy = !pump_output(HAL_UART_LINK, &link_output) || is_busy;
        is_busy = !pump_output(HAL_UART_CONSOLE, &console_output) || is_busy;
        if (!is_busy) {
            hal_idle();
        }
    }
}
