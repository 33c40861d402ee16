/* Studies over the link: the console's numbers, beside a controller that steers on as if nothing were. */
#include "base/fmath.h"
#include "base/mem.h"
#include "controller.h"
#include "tap.h"
#include "tests.h"

enum { LIMIT = 200000 };

#define PLACE(symbol) index_of(symbol, sizeof(symbol) - 1u)

/* --- Asking ------------------------------------------------------------------------------------------------------- */

static void put_axis(uint8_t parameter, bool is_log, float from, float to, uint16_t points)
{
    bytes_put_u8(&fields, parameter);
    bytes_put_u8(&fields, is_log ? 1u : 0u);
    bytes_put_f32(&fields, from);
    bytes_put_f32(&fields, to);
    bytes_put_u16(&fields, points);
}

static void put_span(uint16_t transient, uint16_t window, uint8_t flags)
{
    bytes_put_u16(&fields, transient);
    bytes_put_u16(&fields, window);
    bytes_put_u8(&fields, flags);
}

/* A map over one parameter. */
static void say_scan(uint8_t parameter, bool is_log, float from, float to, uint16_t points, uint16_t transient,
                     uint8_t flags)
{
    say(LINK_SCAN, 77u, 0u);
    put_axis(parameter, is_log, from, to, points);
    put_axis(LINK_NO_INDEX, false, 0.0f, 0.0f, 0u);
    put_span(transient, 40u, flags);
}

static void say_margin(uint8_t parameter, float factor, uint16_t transient)
{
    say(LINK_MARGIN, 78u, 0u);
    bytes_put_u8(&fields, parameter);
    bytes_put_f32(&fields, factor);
    put_span(transient, 40u, 0u);
}

static void say_occurrence(uint32_t trials, uint32_t seed, bool is_uniform, float load)
{
    say(LINK_OCCURRENCE, 79u, 0u);
    bytes_put_u32(&fields, trials);
    bytes_put_u32(&fields, seed);
    bytes_put_u8(&fields, is_uniform ? 1u : 0u);
    for (unsigned i = 0u; i < 3u; i++) {
        bytes_put_f32(&fields, 0.0f);
    }
    bytes_put_f32(&fields, load);
    put_span(1600u, 40u, 0u);
}

/* A map that takes long. */
static bool begin_long(void)
{
    say_scan(PLACE("N0"), false, 1.0f, 10.0f, 100u, 360u, LINK_IS_WHOLE);
    return is_answered() && bytes_get_u32(&answer) == 100u;
}

/* Sends the request; true if so many results are promised. */
static bool is_begun(uint32_t results)
{
    bench_result_count = 0u;
    return is_answered() && bytes_get_u32(&answer) == results && bytes_is_spent(&answer) &&
           bench.turn.studies == TURN_LINK;
}

static struct bytes_reader reader_of(const struct bench_frame *frame)
{
    return (struct bytes_reader){.bytes = frame->payload, .size = frame->size};
}

static const struct bench_frame *last_result(void)
{
    static const struct bench_frame none;

    return bench_result_count > 0u ? &bench_results[bench_result_count - 1u] : &none;
}

/* Waits for the end of the study; true if it came for this reason, with so many results. */
static bool is_ended(uint8_t type, enum error reason, uint32_t results)
{
    struct bytes_reader reader;

    for (unsigned i = 0u; i < LIMIT && last_result()->type != LINK_STUDY_END; i++) {
        bench_wait(1u);
    }
    reader = reader_of(last_result());
    return last_result()->type == LINK_STUDY_END && bytes_get_u8(&reader) == type &&
           bytes_get_u8(&reader) == (uint8_t)reason && bytes_get_u32(&reader) == results &&
           bench.turn.studies == TURN_NOBODY;
}

/* Is the tally of the last STUDY_END that of the console's last answer? */
static bool is_tally_said(void)
{
    static const char *const keys[] = {"trials",    "unknown", "quiet",    "watch", "squeal",      "loud",
                                       "undecided", "refused", "diverged", "caps",  "saturations", "gap_held"};
    struct bytes_reader reader = reader_of(last_result());
    bool ok = true;

    (void)bytes_get_block(&reader, 6u);
    for (size_t i = 0u; i < sizeof keys / sizeof keys[0]; i++) {
        ok = holds_value(bench.last, keys[i], (float)bytes_get_u32(&reader)) && ok;
    }
    return holds_value(bench.last, "steps", (float)bytes_get_u64(&reader)) && ok;
}

/* The console's line of this number, or "". */
static const char *said_line(const char *start, uint32_t number)
{
    static char line[512];
    const char *from = bench.heard;
    size_t length = 0u;

    for (; *from != '\0' && (!bench_starts(from, start) || number > 0u); from++) {
        number -= bench_starts(from, start) ? 1u : 0u;
    }
    while (length < sizeof line - 1u && from[length] != '\0' && from[length] != '\r') {
        line[length] = from[length];
        length++;
    }
    line[length] = '\0';
    return line;
}

/* --- Results ------------------------------------------------------------------------------------------------------ */

static bool is_point_said(const struct bench_frame *frame, uint32_t number, const char *first, const char *second)
{
    struct bytes_reader reader = reader_of(frame);
    const char *line = said_line("- point ", number);
    bool ok =
        frame->type == LINK_POINT && frame->sequence == 77u && frame->size == 51u && bytes_get_u32(&reader) == number;
    uint8_t words[7];

    ok = holds_setting(line, first, bytes_get_f32(&reader)) && ok;
    ok = (second == NULL) == !fmath_is_finite(bytes_get_f32(&reader)) && ok;
    reader.offset -= 4u;
    ok = (second == NULL || holds_setting(line, second, bytes_get_f32(&reader))) && ok;
    reader.offset = 12u;
    memcpy(words, bytes_get_block(&reader, sizeof words), sizeof words);
    if (words[0] != ERROR_OK) {
        return bench_holds(line, error_name((enum error)words[0])) && ok && !fmath_is_finite(bytes_get_f32(&reader));
    }
    ok =
        bench_holds(line, detector_propensity_name(words[1])) && bench_holds(line, detector_class_name(words[2])) && ok;
    ok = holds_value(line, "period", (float)words[3]) && ok;
    ok = bench_holds(line, predictor_verdict_name((enum predictor_verdict)words[4])) && ok;
    ok = bench_holds(line, trial_end_name(words[5])) && ok;
    ok = ((words[6] & 1u) != 0u) == (words[1] == PROPENSITY_SQUEAL) && ok;
    ok = holds_value(line, "amplitude_um", bytes_get_f32(&reader)) && ok;
    ok = holds_value(line, "velocity_mm_s", bytes_get_f32(&reader)) && ok;
    ok = holds_value(line, "frequency_hz", bytes_get_f32(&reader)) && ok;
    (void)bytes_get_f32(&reader);
    ok = holds_value(line, "growth_per_s", bytes_get_f32(&reader)) && ok;
    (void)bytes_get_f32(&reader);
    ok = holds_value(line, "predicted_growth_per_s", bytes_get_f32(&reader)) && ok;
    return holds_value(line, "periods", bytes_get_f32(&reader)) && bytes_is_spent(&reader) && ok;
}

static void check_scan(void)
{
    bool ok = true;

    bench_open();
    (void)bench_say("preset brake\r");
    (void)bench_say("scan N1 1000 3000 3 alpha -0.05 -0.03 2 transient 200\r");
    say(LINK_SCAN, 77u, 0u);
    put_axis(PLACE("N1"), false, 1000.0f, 3000.0f, 3u);
    put_axis(PLACE("alpha"), false, -0.05f, -0.03f, 2u);
    put_span(200u, 40u, 0u);
    tap_check(is_begun(6u) && bench_result_count == 0u, "a map is promised at once");
    tap_check(is_ended(LINK_SCAN, ERROR_OK, 6u) && bench_result_count == 7u,
              "six points and an end come by themselves");
    for (uint32_t i = 0u; i < 6u; i++) {
        ok = is_point_said(&bench_results[i], i, "N1", "alpha") && ok;
    }
    tap_check(ok, "each with the console's numbers");
    tap_check(is_tally_said() && last_result()->sequence == 77u && last_result()->size == 78u, "and with its tally");
    (void)bench_say("scan N1 30000 3000 2 log transient 50\r");
    say_scan(PLACE("N1"), true, 30000.0f, 3000.0f, 2u, 50u, 0u);
    tap_check(is_begun(2u) && is_ended(LINK_SCAN, ERROR_OK, 2u), "downwards is a way as well");
    tap_check(bench_results[0].payload[12] == ERROR_OUT_OF_SCALE && is_point_said(&bench_results[0], 0u, "N1", NULL) &&
                  is_point_said(&bench_results[1], 1u, "N1", NULL),
              "a point that the model cannot hold is told with its error");
    tap_check(is_tally_said(), "and counted");
}

static bool is_border_said(const struct bench_frame *frame, uint32_t number, const char *symbol)
{
    static const char *const ways[] = {"none", "down", "up", "any"};
    static const char *const keys[] = {"below", "below_quiet", "below_squeal", "below_searched",
                                       "above", "above_quiet", "above_squeal", "above_searched"};
    struct bytes_reader reader = reader_of(frame);
    const char *line = said_line("- margin ", number);
    bool ok = frame->type == LINK_BORDER && frame->sequence == 78u && frame->size == 39u &&
              bytes_get_u8(&reader) == index_of(symbol, 2u);

    ok = bench_holds(line, bytes_get_u8(&reader) == 1u ? " now=squeal" : " now=quiet") && ok;
    ok = bench_holds(line, ways[bytes_get_u8(&reader)]) && ok;
    ok = holds_setting(line, symbol, bytes_get_f32(&reader)) && ok;
    for (unsigned i = 0u; i < 8u; i++) {
        const float value = bytes_get_f32(&reader);

        if (i % 4u == 0u) { /* written with six digits there */
            ok = fmath_is_finite(value) != bench_holds(line, i == 0u ? " below=none" : " above=none") && ok;
        } else {
            ok = (!fmath_is_finite(value) || bench_holds(line, keys[i])) && ok;
            ok = (fmath_is_finite(value) || !bench_holds(line, keys[i])) && ok;
        }
    }
    return ok && bytes_is_spent(&reader);
}

static void check_margin(void)
{
    struct bytes_reader reader;
    float border, quiet, loud;

    bench_open();
    (void)bench_say("preset brake\r");
    (void)bench_say("margin N1\r");
    say_margin(PLACE("N1"), 16.0f, 1600u);
    tap_check(is_begun(1u) && is_ended(LINK_MARGIN, ERROR_OK, 1u) && bench_result_count == 2u, "the border of one");
    tap_check(is_border_said(&bench_results[0], 0u, "N1") && is_tally_said(), "is the console's");
    reader = reader_of(&bench_results[0]);
    reader.offset = 7u;
    border = bytes_get_f32(&reader);
    quiet = bytes_get_f32(&reader);
    loud = bytes_get_f32(&reader);
    tap_check(border > quiet && border < loud && loud - quiet < 3.0f && quiet < 2000.5f && loud > 1998.0f,
              "N |alpha| = c, in its bracket");
    (void)bench_say("margin within 1.01 transient 20\r");
    say_margin(LINK_NO_INDEX, 1.01f, 20u);
    tap_check(is_begun(11u) && is_ended(LINK_MARGIN, ERROR_OK, 11u) && bench_result_count == 12u &&
                  is_border_said(&bench_results[10], 10u, "v0") && is_tally_said(),
              "all of them, one frame each");
    (void)bench_say("defaults\rset N0 10 alpha -0.02\rstep 64\rset N0 0 v0 0\r");
    say_margin(LINK_NO_INDEX, 2.0f, 0u);
    tap_check(is_answered() && is_ended(LINK_MARGIN, ERROR_NO_SCALE, 0u), "a set that cannot be tried is the reason");
}

static void check_occurrence(void)
{
    struct bytes_reader reader;
    bool ok;

    bench_open();
    (void)bench_say("preset brake\rset N1 2000\r");
    (void)bench_say("occurrence 6 uniform N 0.2 seed 3\r");
    say_occurrence(6u, 3u, true, 0.2f);
    tap_check(is_begun(6u) && is_ended(LINK_OCCURRENCE, ERROR_OK, 6u) && bench_result_count == 1u && is_tally_said(),
              "of a share only the end is told");
    reader = reader_of(last_result());
    reader.offset = 62u;
    ok = holds_value(bench.last, "share", bytes_get_f32(&reader));
    ok = holds_value(bench.last, "low", bytes_get_f32(&reader)) && ok;
    ok = holds_value(bench.last, "high", bytes_get_f32(&reader)) && ok;
    tap_check(ok && bytes_get_u32(&reader) == 0u && bytes_is_spent(&reader), "with its interval");
    (void)bench_say("defaults\rset N0 10 alpha -0.02\rstep 64\rset N0 0 v0 0\r");
    say_occurrence(2u, 3u, true, 0.2f);
    ok = is_begun(2u) && is_ended(LINK_OCCURRENCE, ERROR_OK, 2u);
    reader = reader_of(last_result());
    reader.offset = 62u;
    tap_check(ok && bytes_get_u32(&reader) == 0x7fc00000u && bytes_get_f32(&reader) == 0.0f,
              "the share of nothing tried is the NaN that is always the same");
}

/* --- Refusals ----------------------------------------------------------------------------------------------------- */

static bool scan_is_refused(uint8_t at, uint8_t byte, enum error error)
{
    say_scan(PLACE("N0"), true, 1.0f, 2.0f, 3u, 0u, 0u);
    request.payload[at] = byte;
    return is_refused(error, at == 0u ? 0u : at == 1u ? 1u : at < 12u ? 4u : at, 0u);
}

static void check_refused_scans(void)
{
    const float nan = fmath_from_bits(0x7fc00000u);

    tap_check(scan_is_refused(0u, (uint8_t)params_count, ERROR_UNKNOWN_NAME) &&
                  has_range(0.0f, (float)(params_count - 1u)),
              "a parameter that does not exist");
    tap_check(scan_is_refused(0u, LINK_NO_INDEX, ERROR_UNKNOWN_NAME), "there is a first axis");
    tap_check(scan_is_refused(1u, 2u, ERROR_OUT_OF_RANGE) && has_range(0.0f, 1.0f), "log or not");
    tap_check(scan_is_refused(10u, 0u, ERROR_OUT_OF_RANGE) && has_range(1.0f, 256.0f), "no points");
    say_scan(PLACE("N0"), false, 1.0f, 2.0f, 257u, 0u, 0u);
    tap_check(is_refused(ERROR_OUT_OF_RANGE, 4u, 0u), "too many points");
    say_scan(PLACE("N0"), false, nan, 2.0f, 3u, 0u, 0u);
    tap_check(is_refused(ERROR_OUT_OF_RANGE, 2u, 0u) && has_range(0.0f, 1e9f), "from NaN");
    say_scan(PLACE("N0"), false, 1.0f, -1.0f, 3u, 0u, 0u);
    tap_check(is_refused(ERROR_OUT_OF_RANGE, 3u, 0u) && has_range(0.0f, 1e9f), "to what no force is");
    say_scan(PLACE("N0"), true, 0.0f, 1.0f, 3u, 0u, 0u);
    tap_check(is_refused(ERROR_USAGE, 1u, 0u), "equal ratios from 0");
    say(LINK_SCAN, 1u, 0u);
    put_axis(PLACE("N0"), false, 1.0f, 2.0f, 3u);
    put_axis(PLACE("alpha"), true, -1.0f, 1.0f, 3u);
    put_span(0u, 40u, 0u);
    tap_check(is_refused(ERROR_USAGE, 6u, 0u), "or past it, on the second axis");
    say(LINK_SCAN, 1u, 0u);
    put_axis(PLACE("N0"), false, 1.0f, 2.0f, 3u);
    put_axis(PLACE("N0"), false, 1.0f, 2.0f, 3u);
    put_span(0u, 40u, 0u);
    tap_check(is_refused(ERROR_USAGE, 5u, 0u), "twice the same parameter");
    say_scan(PLACE("N0"), false, 1.0f, 2.0f, 3u, 0u, 2u);
    tap_check(is_refused(ERROR_OUT_OF_RANGE, 12u, 0u) && has_range(0.0f, 1.0f), "a flag that there is not");
    say(LINK_SCAN, 1u, 0u);
    put_axis(PLACE("N0"), false, 1.0f, 2.0f, 3u);
    put_axis(LINK_NO_INDEX, false, nan, nan, 0u);
    put_span(0u, 7u, 0u);
    tap_check(is_refused(ERROR_OUT_OF_RANGE, 11u, 0u) && has_range(8.0f, 65535.0f), "a window that is too short");
}

static void check_refused_others(void)
{
    say_margin((uint8_t)params_count, 16.0f, 0u);
    tap_check(is_refused(ERROR_UNKNOWN_NAME, 0u, 0u), "a border of nothing");
    say_margin(PLACE("spp"), 16.0f, 0u);
    tap_check(is_refused(ERROR_NOT_SERVED, 0u, 0u), "of what has none");
    say_margin(PLACE("N0"), 1.0f, 0u);
    tap_check(is_refused(ERROR_OUT_OF_RANGE, 1u, 0u) && has_range(1.001f, 1e6f), "within nothing");
    say_margin(PLACE("N0"), fmath_from_bits(0x7fc00000u), 0u);
    tap_check(is_refused(ERROR_OUT_OF_RANGE, 1u, 0u), "within NaN");
    say_occurrence(0u, 0u, false, 0.1f);
    tap_check(is_refused(ERROR_OUT_OF_RANGE, 0u, 0u) && has_range(1.0f, 100000.0f), "a share of none");
    say_occurrence(1u, 1u << 24, false, 0.1f);
    tap_check(is_refused(ERROR_OUT_OF_RANGE, 1u, 0u), "a seed that no parameter holds");
    say_occurrence(1u, 0u, false, 1.5f);
    tap_check(is_refused(ERROR_OUT_OF_RANGE, 6u, 0u) && has_range(0.0f, 1.0f), "too wide a scatter");
    say_occurrence(1u, 0u, false, 0.1f);
    request.payload[8] = 2u;
    tap_check(is_refused(ERROR_OUT_OF_RANGE, 2u, 0u), "of no kind");
}

static void check_refusals(void)
{
    struct study before;

    bench_open();
    bench_result_count = 0u;
    before = bench.work.study;
    check_refused_scans();
    check_refused_others();
    bench_wait(10u);
    tap_check(bench.turn.studies == TURN_NOBODY && bench_result_count == 0u &&
                  memcmp(&before, &bench.work.study, sizeof before) == 0,
              "nothing is tried after a refusal");
}

/* --- Side by side ------------------------------------------------------------------------------------------------- */

/* Where a controller gets in lockstep: the hash after 200 turns. */
static uint32_t lockstep(bool has_study)
{
    bool ok = true;

    bench_open();
    ok = load_preset("fig5-n10", 8u) && (!has_study || begin_long());
    for (uint16_t i = 0u; i < 200u; i++) {
        say(LINK_STEP, i, bench.link.steps.last_step);
        request.step = i * 5u;
        bytes_put_u32(&fields, 5u);
        bytes_put_u8(&fields, INPUT_LOAD_FORCE);
        bytes_put_u8(&fields, INPUT_SPEED_KEEP);
        bytes_put_f32(&fields, 8.0f + 0.01f * (float)i);
        bytes_put_f32(&fields, 0.0f);
        ok = is_answered() && ok;
    }
    tap_check(ok && (bench.work.study.tally.steps + bench.work.study.trial.sim.step > 0u) == has_study,
              has_study ? "a controller steers beside a map" : "and without one");
    return bench.executive.sim.hash;
}

static void check_lockstep(void)
{
    const uint32_t with = lockstep(true);

    tap_check(lockstep(false) == with, "with the same bits");
}

static void check_stop(void)
{
    uint32_t done;

    bench_open();
    tap_check(load_preset("fig5-n10", 8u) && begin_long() && is_done(LINK_RUN), "a map beside a free run");
    for (unsigned i = 0u; i < LIMIT && bench.work.study.done == 0u; i++) {
        bench_wait(1u);
    }
    done = bench.work.study.done;
    tap_check(done == 1u && is_done(LINK_STATUS) && is_done(LINK_VERDICT), "which answers whatever is asked");
    tap_check(is_done(LINK_STOP) && bytes_get_u64(&answer) > 0u &&
                  is_ended(LINK_SCAN, ERROR_STOPPED, bench.work.study.done),
              "a STOP ends the map");
    tap_check(executive_wants_tick(&bench.executive), "and not the plant");
    tap_check(is_done(LINK_STOP) && !executive_wants_tick(&bench.executive), "which the next one halts");
    bench_result_count = 0u;
    bench_wait(100u);
    tap_check(bench_result_count == 0u, "nothing comes after the end");
    tap_check(begin_long(), "another one");
    say(LINK_HELLO, 1u, 0u);
    bytes_put_u8(&fields, LINK_MAJOR);
    bytes_put_u8(&fields, LINK_MINOR);
    tap_check(is_answered() && is_ended(LINK_SCAN, ERROR_STOPPED, 0u), "is ended by a new controller's HELLO");
}

static void check_busy(void)
{
    bool is_busy;

    bench_open();
    tap_check(begin_long() && !begin_long() && reply.payload[1] == ERROR_BUSY, "one map at a time");
    say_margin(LINK_NO_INDEX, 16.0f, 0u);
    tap_check(is_refused(ERROR_BUSY, LINK_NO_INDEX, 0u), "or anything like it");
    bench_listen_anew();
    (void)bench_turn("scan N0 1 2 2\r", 14u, SIZE_MAX, &is_busy);
    (void)bench_turn("get N0\r", 7u, SIZE_MAX, &is_busy);
    tap_check(bench_holds(bench.heard, "error busy scan: a study of the link is under way") &&
                  bench_holds(bench.heard, "ok get N0=1 "),
              "on the console as well, which obeys all else");
    tap_check(is_done(LINK_STOP), "when it has ended");
    (void)bench_turn("scan N0 1 2 100 whole\r", 22u, SIZE_MAX, &is_busy);
    bench_wait(10u);
    tap_check(bench.console.task == CONSOLE_TASK_STUDY && !begin_long() && reply.payload[1] == ERROR_BUSY,
              "the console's turn, and the link has none");
    tap_check(is_done(LINK_STOP) && bench.console.task == CONSOLE_TASK_STUDY, "which a STOP of the link leaves alone");
    tap_check(bench_starts(bench_say("stop\r"), "ok stop ") && begin_long(), "until it has ended");
}

/* What nobody reads waits; the plant does not. */
static void check_slow_reader(void)
{
    struct study before;
    uint64_t step;
    bool ok;

    bench_open();
    tap_check(load_preset("fig5-n10", 8u), "a reader that stops");
    say_scan(PLACE("N0"), false, 1.0f, 10.0f, 12u, 0u, 0u);
    ok = is_begun(12u) && is_done(LINK_RUN);
    bench_link_is_read = false;
    bench_wait(1000u);
    before = bench.work.study;
    step = bench.executive.sim.step;
    bench_wait(100u);
    tap_check(ok && memcmp(&before, &bench.work.study, sizeof before) == 0 && before.done < 12u, "makes the map wait");
    tap_check(bench.executive.sim.step == step + 100u, "and not the plant");
    bench_link_is_read = true;
    tap_check(is_ended(LINK_SCAN, ERROR_OK, 12u) && bench_result_count == 13u, "and nothing is lost");
    for (uint32_t i = 0u; i < 12u; i++) {
        struct bytes_reader reader = reader_of(&bench_results[i]);

        ok = bytes_get_u32(&reader) == i && ok;
    }
    tap_check(ok, "or out of order");
}

void test_link_study(void)
{
    check_scan();
    check_margin();
    check_occurrence();
    check_refusals();
    check_lockstep();
    check_stop();
    check_busy();
    check_slow_reader();
}
