/* The link: every message, every refusal, and what stands between console and link. */
#include "protocol/link.h"

#include "base/bytes.h"
#include "base/fmath.h"
#include "base/mem.h"
#include "bench.h"
#include "controller.h"
#include "model/presets.h"
#include "protocol/link_parts.h"
#include "protocol/signals.h"
#include "tap.h"
#include "tests.h"

/* --- Looking ------------------------------------------------------------------------------------------------------ */

static void check_hello(void)
{
    char text[33];

    say(LINK_HELLO, 9u, 77u);
    bytes_put_u8(&fields, LINK_MAJOR);
    bytes_put_u8(&fields, 200u);
    tap_check(is_answered() && reply.step == 0u, "a client of any minor version is welcome");
    tap_check(bytes_get_u8(&answer) == LINK_MAJOR && bytes_get_u8(&answer) == LINK_MINOR &&
                  bytes_get_u16(&answer) == PARAMS_VERSION && bytes_get_u16(&answer) == SIGNALS_VERSION,
              "and told ours");
    (void)bytes_get_u16(&answer);
    tap_check(bytes_get_u8(&answer) == params_count && bytes_get_u8(&answer) == SIGNAL_COUNT &&
                  bytes_get_u8(&answer) == presets_count && bytes_get_u8(&answer) == 2u &&
                  bytes_get_u16(&answer) == FRAME_PAYLOAD_MAX,
              "how much there is, and that there is an FPU");
    bytes_get_text(&answer, text, 16u);
    tap_check_text(text, "0.0.0", "its version");
    bytes_get_text(&answer, text, 32u);
    tap_check_text(text, "test", "its build");
    bytes_get_text(&answer, text, 24u);
    tap_check_text(text, "bench", "its board");
    bytes_get_text(&answer, text, 16u);
    tap_check(bytes_is_spent(&answer), "and its core");
    say(LINK_HELLO, 10u, 0u);
    bytes_put_u8(&fields, LINK_MAJOR + 1u);
    bytes_put_u8(&fields, 0u);
    tap_check(is_refused(ERROR_WRONG_VERSION, LINK_NO_INDEX, LINK_MAJOR), "another major version is refused");
}

static void check_ping(void)
{
    say(LINK_PING, 0xffffu, 0u);
    bytes_put_u64(&fields, 0x0102030405060708u);
    tap_check(is_answered() && bytes_get_u64(&answer) == 0x0102030405060708u, "the same eight bytes come back");
}

static void check_strangers(void)
{
    say(LINK_PING, 5u, 0u);
    bytes_put_u32(&fields, 1u);
    tap_check(is_refused(ERROR_BAD_LENGTH, LINK_NO_INDEX, 8u), "a request that is too short");
    say(LINK_STATUS, 5u, 0u);
    fields.size = FRAME_PAYLOAD_MAX;
    tap_check(is_refused(ERROR_BAD_LENGTH, LINK_NO_INDEX, 0u), "or too long");
    say((enum link_message)0x33, 6u, 0u);
    tap_check(is_refused(ERROR_UNKNOWN_TYPE, LINK_NO_INDEX, 0u), "an unknown type");
    say((enum link_message)0x81, 6u, 0u);
    tap_check(is_refused(ERROR_UNKNOWN_TYPE, LINK_NO_INDEX, 0u), "and a reply are no requests");
    tap_check(bench.link.refused == 5u, "refusals are counted");
}

static void check_silence(void)
{
    static uint8_t garbage[5000];
    uint32_t state = 5u;
    uint32_t before = bench.link.receiver.accepted;

    for (size_t i = 0u; i < sizeof garbage; i++) {
        garbage[i] = (uint8_t)(tap_random(&state) >> 24);
    }
    garbage[sizeof garbage - 1u] = 0u;
    tap_check(!bench_link_turns(garbage, sizeof garbage, 200u, &reply), "what is no frame gets silence");
    tap_check(bench.link.receiver.accepted == before && bench.link.receiver.garbage_bytes > 4800u, "and is counted");
    tap_check(is_done(LINK_STATUS), "the next frame is answered");
    link_lost(&bench.link, 1u);
    say(LINK_STATUS, 1u, 0u);
    request.size = 0u;
    tap_check(!bench_ask(&request, &reply, 50u) && bench.link.receiver.damaged == 1u,
              "a frame of which the UART has lost a byte is none");
    tap_check(is_done(LINK_STATUS), "and the one after it is");
}

static bool look_up(uint8_t table, uint8_t index)
{
    say(LINK_DICTIONARY, 2u, 0u);
    bytes_put_u8(&fields, table);
    bytes_put_u8(&fields, index);
    return is_answered();
}

static bool row_is(uint8_t table, uint8_t index, const char *symbol)
{
    char text[25];

    if (!look_up(table, index) || bytes_get_u8(&answer) != table || bytes_get_u8(&answer) != index) {
        return false;
    }
    (void)bytes_get_block(&answer, 17u);
    bytes_get_text(&answer, text, 24u);
    return bench_starts(text, symbol) && bench_starts(symbol, text);
}

static void check_dictionary(void)
{
    char text[150];
    bool ok = true;

    for (size_t i = 0u; i < params_count; i++) {
        ok = ok && row_is(0u, (uint8_t)i, params_table[i].symbol);
    }
    for (unsigned i = 0u; i < SIGNAL_COUNT; i++) {
        ok = ok && row_is(1u, (uint8_t)i, signals_table[i].name);
    }
    for (size_t i = 0u; i < presets_count; i++) {
        ok = ok && row_is(2u, (uint8_t)i, presets_table[i].name);
    }
    for (unsigned i = 0u; i < SELFTEST_COUNT; i++) {
        ok = ok && row_is(3u, (uint8_t)i, selftest_table[i].name);
    }
    tap_check(ok, "every row of every table, its name whole");
    ok = look_up(0u, index_of("contact", 7u)) && bytes_get_u16(&answer) == index_of("contact", 7u) * 256u &&
         bytes_get_u8(&answer) == params_count && bytes_get_u16(&answer) == 10u && bytes_get_u8(&answer) == 2u &&
         bytes_get_u8(&answer) == 1u && bytes_get_f32(&answer) == 0.0f && has_range(0.0f, 2.0f);
    (void)bytes_get_block(&answer, 24u);
    bytes_get_text(&answer, text, 48u);
    tap_check(ok, "a choice: its id, kind, change and range");
    tap_check_text(text, "bilateral|no_pull|lift", "and its names");
    bytes_get_text(&answer, text, 149u);
    tap_check(bench_starts(text, "negative contact force") && bytes_is_spent(&answer), "and what it is");
    say(LINK_DICTIONARY, 2u, 0u);
    bytes_put_u16(&fields, 4u);
    tap_check(is_refused(ERROR_OUT_OF_RANGE, 0u, 0u) && has_range(0.0f, 3.0f), "there are four tables");
    say(LINK_DICTIONARY, 2u, 0u);
    bytes_put_u16(&fields, 0xff01u);
    tap_check(is_refused(ERROR_OUT_OF_RANGE, 1u, 0u) && has_range(0.0f, (float)(SIGNAL_COUNT - 1)), "each with an end");
}

static bool is_read(uint8_t table, uint8_t index)
{
    say(LINK_READ, 2u, 0u);
    bytes_put_u8(&fields, table);
    bytes_put_u8(&fields, index);
    return is_answered() && bytes_get_u8(&answer) == table && bytes_get_u8(&answer) == index;
}

static void check_read(void)
{
    (void)bench_say("set N0 3 v0 0.5\r");
    tap_check(is_read(0u, index_of("N0", 2u)) && bytes_get_f32(&answer) == 3.0f, "a parameter in force");
    tap_check(is_read(1u, index_of("v0", 2u)) && bytes_get_f32(&answer) == 0.5f, "and staged, as the console left it");
    (void)bench_say("step 10\r");
    tap_check(is_read(2u, SIGNAL_STEP) && bytes_get_f32(&answer) == 10.0f, "a signal now");
    tap_check(is_read(2u, SIGNAL_HASH) && bytes_get_u32(&answer) == bench.executive.sim.hash, "a hash as it is");
    tap_check(is_read(2u, SIGNAL_MODE) && bytes_get_f32(&answer) == 1.0f, "a mode as a number");
    say(LINK_READ, 2u, 0u);
    bytes_put_u16(&fields, 3u);
    tap_check(is_refused(ERROR_OUT_OF_RANGE, 0u, 0u), "of nothing else");
    say(LINK_READ, 2u, 0u);
    bytes_put_u16(&fields, 0xff00u);
    tap_check(is_refused(ERROR_OUT_OF_RANGE, 1u, 0u) && has_range(0.0f, (float)(params_count - 1u)), "and not beyond");
}

static void check_status(void)
{
    struct executive_report report;

    executive_report(&bench.executive, &report);
    tap_check(is_done(LINK_STATUS) && bytes_get_u8(&answer) == 0u && bytes_get_u64(&answer) == 10u &&
                  bytes_get_u32(&answer) == report.generation && bytes_get_u32(&answer) == report.now.hash,
              "the state");
    (void)bytes_get_u32(&answer);
    tap_check(bytes_get_f32(&answer) == executive_plan(&bench.executive)->scale.step_s, "the time of a step");
    (void)bytes_get_block(&answer, 4u + 5u * 4u);
    tap_check(bytes_get_u32(&answer) == report.load.ticks, "the counters");
    (void)bytes_get_block(&answer, 10u * 4u);
    tap_check(bytes_get_u32(&answer) == bench.link.receiver.accepted, "those of the receiver too");
    (void)bytes_get_block(&answer, 6u * 4u);
    tap_check(bytes_get_u32(&answer) == bench.link.refused, "and the refusals");
    tap_check(bytes_get_u8(&answer) == WATCH_OFF && bytes_get_u32(&answer) == 0u && bytes_get_u32(&answer) == 0u &&
                  bytes_is_spent(&answer),
              "and nobody steers");
}

/* --- Settings ----------------------------------------------------------------------------------------------------- */

/* Stages a value; the CRC of the staged set, or 0. */
static uint32_t stage(uint8_t index, float value)
{
    say(LINK_STAGE, 4u, 0u);
    bytes_put_u8(&fields, index);
    bytes_put_f32(&fields, value);
    if (!is_answered() || bytes_get_u8(&answer) != index || bytes_get_f32(&answer) != value) {
        return 0u;
    }
    return bytes_get_u32(&answer);
}

static void say_commit(uint32_t crc, uint8_t may_reset)
{
    say(LINK_COMMIT, 5u, 0u);
    bytes_put_u32(&fields, crc);
    bytes_put_u8(&fields, may_reset);
}

static bool is_committed(uint32_t crc, uint8_t may_reset, uint8_t was_reset)
{
    say_commit(crc, may_reset);
    return is_answered() && bytes_get_u32(&answer) == crc && bytes_get_u8(&answer) == was_reset;
}

static uint32_t revert(void) { return is_done(LINK_REVERT) ? bytes_get_u32(&answer) : 0u; }

static void check_settings(void)
{
    const uint8_t n0 = index_of("N0", 2u);
    const uint8_t spp = index_of("spp", 3u);
    uint32_t crc;

    bench_open();
    crc = revert();
    tap_check(crc == 0x4ab81da5u, "the CRC of the defaults is that of a program of its own");
    tap_check(stage(n0, 2.0f) != crc && params_value(executive_params(&bench.executive), &params_table[n0]) == 1.0f,
              "staged is not in force");
    tap_check(is_committed(stage(n0, 2.0f), 0u, 1u) && executive_params(&bench.executive)->load_n == 2.0f,
              "committed it is; at step 0 with a reset");
    (void)bench_say("step 100\r");
    tap_check(is_committed(stage(n0, 1.5f), 0u, 0u) && bench.executive.sim.step == 100u, "later between two steps");
    crc = stage(spp, 3.0f);
    say_commit(crc, 0u);
    tap_check(is_refused(ERROR_NEEDS_RESTART, spp, 0u), "a restart is asked for");
    tap_check(is_done(LINK_RUN), "running");
    say_commit(crc, 1u);
    tap_check(is_refused(ERROR_NEEDS_RESTART, spp, 0u), "and not made while the plant runs");
    tap_check(is_done(LINK_STOP) && is_committed(crc, 1u, 1u) && bench.executive.sim.step == 0u, "stopped it is");
}

static void check_refused_settings(void)
{
    const uint8_t v0 = index_of("v0", 2u);
    const uint32_t crc = revert();

    say(LINK_STAGE, 4u, 0u);
    bytes_put_u8(&fields, v0);
    bytes_put_u32(&fields, 0x7fc00000u);
    tap_check(is_refused(ERROR_OUT_OF_RANGE, v0, 0u) && has_range(-1000.0f, 1000.0f), "NaN is out of range");
    say(LINK_STAGE, 4u, 0u);
    bytes_put_u8(&fields, 255u);
    bytes_put_f32(&fields, 1.0f);
    tap_check(is_refused(ERROR_UNKNOWN_NAME, LINK_NO_INDEX, 0u), "a parameter that does not exist");
    tap_check(revert() == crc, "nothing of it is staged");
    say_commit(crc + 1u, 1u);
    tap_check(is_refused(ERROR_WRONG_CRC, LINK_NO_INDEX, crc), "what is not the staged set");
    say_commit(crc, 2u);
    tap_check(is_refused(ERROR_OUT_OF_RANGE, LINK_NO_INDEX, 0u) && has_range(0.0f, 1.0f), "yes or no");
    (void)bench_say("set alpha -0.003\r");
    say_commit(crc, 1u);
    tap_check(!is_answered() && bytes_get_u8(&answer) == LINK_COMMIT && bytes_get_u8(&answer) == ERROR_WRONG_CRC,
              "a change by the console is one of the staged set");
    (void)bench_say("step 10\r");
    say_commit(stage(v0, 900.0f), 1u);
    tap_check(is_refused(ERROR_OUT_OF_SCALE, v0, 0u), "what does not fit the scale");
    (void)revert();
    say(LINK_PRESET, 4u, 0u);
    bytes_put_u8(&fields, (uint8_t)presets_count);
    tap_check(is_refused(ERROR_UNKNOWN_NAME, LINK_NO_INDEX, 0u) && has_range(0.0f, (float)(presets_count - 1u)),
              "no such preset");
    tap_check(load_preset("brake", 5u) && bench.executive.sim.step == 0u && bytes_get_u32(&answer) == revert(),
              "a preset is a set and a reset");
}

/* Points of this many steps of 0.5 s and 1 N, from the first on. */
static void say_points(uint8_t first, uint8_t count)
{
    say(LINK_TABLE, LINK_TABLE_REQUEST, 0u);
    bytes_put_u8(&fields, LINK_TABLE_PUT);
    bytes_put_u8(&fields, PARAMS_TABLE_LOAD);
    bytes_put_u8(&fields, first);
    bytes_put_u8(&fields, count);
    for (uint32_t i = 0u; i < LINK_TABLE_PIECE; i++) {
        bytes_put_f32(&fields, 0.5f * (float)(first + i));
        bytes_put_f32(&fields, (float)(first + i));
    }
}

static bool says_table(uint8_t first, uint8_t count, uint8_t length)
{
    bool ok = is_answered() && bytes_get_u8(&answer) == PARAMS_TABLE_LOAD && bytes_get_u8(&answer) == first &&
              bytes_get_u8(&answer) == count && bytes_get_u8(&answer) == length &&
              bytes_get_u32(&answer) == link_crc(&bench.link.staged);

    for (uint32_t i = 0u; i < LINK_TABLE_PIECE; i++) {
        ok = bytes_get_f32(&answer) == (i < count ? 0.5f * (float)(first + i) : 0.0f) &&
             bytes_get_f32(&answer) == (i < count ? (float)(first + i) : 0.0f) && ok;
    }
    return ok && bytes_is_spent(&answer);
}

static void ask_points(uint8_t act, uint8_t table, uint8_t first)
{
    say(LINK_TABLE, LINK_TABLE_REQUEST, 0u);
    bytes_put_u8(&fields, act);
    bytes_put_u8(&fields, table);
    bytes_put_u8(&fields, first);
    for (uint32_t i = 3u; i < LINK_TABLE_REQUEST; i++) {
        bytes_put_u8(&fields, 0u);
    }
}

static void check_tables(void)
{
    const uint8_t load = index_of("load", 4u);
    uint32_t empty;
    uint32_t crc;

    bench_open();
    empty = revert();
    for (uint8_t first = 0u; first < PARAMS_POINTS_MAX; first = (uint8_t)(first + LINK_TABLE_PIECE)) {
        say_points(first, LINK_TABLE_PIECE);
        tap_check(says_table(first, LINK_TABLE_PIECE, (uint8_t)(first + LINK_TABLE_PIECE)), "a piece of a table");
    }
    ask_points(LINK_TABLE_IN_FORCE, PARAMS_TABLE_LOAD, 0u);
    tap_check(says_table(0u, 0u, 0u), "staged is not in force");
    ask_points(LINK_TABLE_STAGED, PARAMS_TABLE_LOAD, 60u);
    tap_check(says_table(60u, 4u, 64u), "but can be read");
    crc = link_crc(&bench.link.staged);
    tap_check(crc != empty && is_committed(stage(load, (float)LOAD_TABLE), 1u, 1u), "committed it is");
    ask_points(LINK_TABLE_IN_FORCE, PARAMS_TABLE_LOAD, 48u);
    tap_check(says_table(48u, 16u, 64u), "all of it");
    say_points(2u, 1u);
    tap_check(says_table(2u, 1u, 3u) && link_crc(&bench.link.staged) != crc, "what came behind is gone");
    say_points(4u, 1u);
    tap_check(is_refused(ERROR_OUT_OF_RANGE, 2u, 0u) && has_range(0.0f, 3.0f), "no gap is left");
    say_points(3u, 17u);
    tap_check(is_refused(ERROR_OUT_OF_RANGE, 3u, 0u) && has_range(0.0f, 16.0f), "no more than a piece holds");
    ask_points(LINK_TABLE_ACTS, PARAMS_TABLE_LOAD, 0u);
    tap_check(is_refused(ERROR_OUT_OF_RANGE, 0u, 0u), "nothing else is done");
    ask_points(LINK_TABLE_STAGED, PARAMS_TABLES, 0u);
    tap_check(is_refused(ERROR_OUT_OF_RANGE, 1u, 0u), "there are two tables");
    say_points(0u, 1u);
    (void)says_table(0u, 1u, 1u);
    crc = link_crc(&bench.link.staged);
    say(LINK_TABLE, LINK_TABLE_REQUEST, 0u);
    bytes_put_u32(&fields, (uint32_t)LINK_TABLE_PUT | 1u << 16 | 2u << 24); /* from point 1 two */
    bytes_put_f32(&fields, 2.0f);
    bytes_put_f32(&fields, 3.0f);
    bytes_put_f32(&fields, 1.5f);
    for (uint32_t i = 0u; i < 29u; i++) {
        bytes_put_f32(&fields, 0.0f);
    }
    tap_check(is_refused(ERROR_OUT_OF_RANGE, 6u, 0u) && has_range(2.0f, 1e6f), "time does not go back");
    tap_check(link_crc(&bench.link.staged) == crc, "and nothing of it is staged");
    (void)revert();
    ask_points(LINK_TABLE_PUT, PARAMS_TABLE_LOAD, 0u);
    tap_check(says_table(0u, 0u, 0u), "none clears it");
    say_commit(link_crc(&bench.link.staged), 1u);
    tap_check(is_refused(ERROR_NO_TABLE, load, 0u), "which a profile that is a table does not allow");
}

void test_link(void)
{
    bench_open();
    check_hello();
    check_ping();
    check_strangers();
    check_silence();
    check_dictionary();
    check_read();
    check_status();
    check_settings();
    check_refused_settings();
    check_tables();
}
