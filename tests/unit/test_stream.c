/* Streams: what is refused, what is sent, what gets lost. */
#include "protocol/stream.h"

#include "base/decimal.h"
#include "bench.h"
#include "tap.h"
#include "tests.h"

static enum error parse(const char *words, struct stream_setup *setup)
{
    struct token bad;

    return stream_parse(words, setup, &bad);
}

static void check_parse(void)
{
    struct stream_setup setup;

    tap_check(parse("csv", &setup) == ERROR_OK && setup.form == STREAM_CSV && setup.count == SIGNALS_DEFAULT &&
                  setup.signals[10] == SIGNAL_PROPENSITY && setup.every == 0u && !setup.is_forced,
              "csv alone means the first eleven signals");
    tap_check(parse("teleplot xd,N,hash every 7 force", &setup) == ERROR_OK && setup.form == STREAM_TELEPLOT &&
                  setup.count == 3u && setup.signals[0] == SIGNAL_XD && setup.signals[2] == SIGNAL_HASH &&
                  setup.every == 7u && setup.is_forced,
              "all that can be said");
    tap_check(parse("csv xd,t,x", &setup) == ERROR_OK && setup.count == 4u && setup.signals[0] == SIGNAL_STEP &&
                  setup.signals[1] == SIGNAL_T && setup.signals[2] == SIGNAL_XD && setup.signals[3] == SIGNAL_X,
              "step and t lead every csv stream");
    tap_check(parse("csv force", &setup) == ERROR_OK && setup.is_forced, "force alone");
    tap_check(parse("csv x,y,bogus", &setup) == ERROR_UNKNOWN_NAME && parse("csv x,", &setup) == ERROR_UNKNOWN_NAME,
              "a name that is none");
    tap_check(parse("csv x,y,x", &setup) == ERROR_USAGE && parse("csv t,t", &setup) == ERROR_USAGE, "a name twice");
    tap_check(parse("json", &setup) == ERROR_USAGE && parse("csv x every", &setup) == ERROR_USAGE &&
                  parse("csv every 0", &setup) == ERROR_OUT_OF_RANGE &&
                  parse("csv every 1e3", &setup) == ERROR_OUT_OF_RANGE &&
                  parse("csv every 2 now", &setup) == ERROR_USAGE,
              "anything else");
}

static void check_load(void)
{
    struct stream_setup setup;
    struct stream_load load;

    (void)parse("csv step,x", &setup);
    load = stream_load(&setup, 1000.0f, 115200u);
    tap_check(load.sample_bytes == 20u + 1u + 16u + 1u + 16u + 2u, "a line is its signals, commas and end");
    tap_check(load.smallest == 7u && load.percent == 69u, "56 bytes at 1 kHz fit 115200 baud each seventh step");
    load = stream_load(&setup, 0.01f, 115200u);
    tap_check(load.smallest == 1u && load.percent == 0u, "slow ones each step");
    setup.every = 1u;
    tap_check(stream_load(&setup, 1000.0f, 115200u).percent == 486u, "and what does not fit says by how much");
}

static void check_refusals(void)
{
    bench_open();
    tap_check(bench_starts(bench_say("stream csv every 1\r"),
                           "error line-overload every=1 line_bytes=172 load=1493% smallest=19: "),
              "an overload is refused, and the answer says what would fit");
    tap_check_text(bench_say("stream\r"), "ok stream off", "and nothing streams");
    tap_check_text(bench_say("stream csv\r"), "ok stream csv every=19 line_bytes=172 load=79% smallest=19",
                   "without a number the smallest that fits is taken");
    tap_check(bench_holds(bench.heard,
                          "smallest=19\r\n#step,t[s],x[m],xd[m/s],y[m],yd[m/s],N[N],F[N],vr[m/s],mode,propensity\r\n"),
              "the header follows the answer");
    tap_check_text(bench_say("stream csv every 1 force\r"),
                   "ok stream csv every=1 line_bytes=172 load=1493% smallest=19", "force overloads");
    tap_check_text(bench_say("stream csv x every 1\r"),
                   "error line-overload every=1 line_bytes=56 load=486% smallest=7: the "
                   "stream needs more than 80 % of the line: every N or force",
                   "fewer columns");
    tap_check_text(bench_say("stream\r"), "ok stream csv every=1 line_bytes=172 load=1493% smallest=19",
                   "a refusal leaves the stream as it was");
    tap_check_text(bench_say("stream csv x,bogus\r"),
                   "error unknown-name bogus: no signal has this name; help stream lists them", "an unknown signal");
    tap_check(bench_starts(bench_say("stream xml\r"), "error usage stream [off|header|csv|teleplot "),
              "an unknown form");
    tap_check_text(bench_say("stream off\r"), "ok stream off", "off");
}

/* The line must carry the stream at any pace that is set while it goes on. */
static void check_pace(void)
{
    bench_open();
    (void)bench_say("stream csv every 19\r");
    tap_check_text(
        bench_say("set tick 2000\r"),
        "error line-overload every=19 line_bytes=172 load=157% smallest=38: at this pace; stream off, or stream "
        "anew with a larger every or force",
        "a faster tick that overloads the line is refused");
    tap_check(bench_starts(bench_say("set substeps 2\r"), "error line-overload ") &&
                  executive_params(&bench.executive)->tick_hz == 1000.0f &&
                  executive_params(&bench.executive)->steps_per_tick == 1.0f,
              "so are more substeps, and the set stays");
    tap_check(bench_starts(bench_say("set tick 500 substeps 2\r"), "ok "), "the same pace in other parts is not");
    (void)bench_say("stream off\rset tick 10 substeps 1\rstream csv every 1\r");
    tap_check(bench_starts(bench_say("defaults\r"), "error line-overload ") &&
                  bench_starts(bench_say("preset brake\r"), "error line-overload ") &&
                  bench_starts(bench_say("reset\r"), "ok "),
              "nor do presets and defaults, which set the pace too, get past it");
    tap_check(bench_starts(bench_say("stream csv every 1 force\r"), "ok ") &&
                  bench_starts(bench_say("defaults\r"), "ok "),
              "force does");
}

static void check_csv(void)
{
    bench_open();
    (void)bench_say("stream csv step,t,v0 every 4 force\r");
    (void)bench_say("step 11\r");
    tap_check(bench_starts(bench.heard, "4,0.215090141,1\r\n8,0.430180281,1\r\nok step done=11 step=11 "),
              "each fourth step is sent, before the answer");
    (void)bench_say("step 1\r");
    tap_check(bench_starts(bench.heard, "12,0.645270422,1\r\nok step "), "and the count goes on");
    (void)bench_say("reset\rstep 4\r");
    tap_check(bench.samples == 1u && bench_holds(bench.heard, "\r\n4,0.215090141,1\r\n"),
              "a reset counts from the start");
    (void)bench_say("preset brake\rstep 4\r");
    tap_check(bench.samples == 1u, "a preset leaves the stream on");
    (void)bench_say("stream header\r");
    tap_check_text(bench.heard, "ok stream header\r\n#step,t[s],v0[m/s]\r\n", "the header can be had again");
    (void)bench_say("stream csv step every 2 force\rstep 4\rstream off\rstep 4\r");
    tap_check(bench.samples == 2u && bench.oks == 4u, "a new stream takes the place of the old one, off ends it");
}

static void check_teleplot(void)
{
    bench_open();
    (void)bench_say("stream teleplot step,t,x,N,xd,mu,mode every 1000\rstep 1000\r");
    tap_check(bench_holds(bench.heard, "\r\n>step:53772.5352:1000\r\n>phase:") &&
                  bench_holds(bench.heard, ":53772.5352|xy\r\n>N:53772.5352:1\xc2\xa7N\r\n>mu:"),
              "the step, x and xd as the phase portrait, other numbers series with their unit");
    tap_check(bench_holds(bench.heard, "\r\n>mode:53772.5352:slip+|t\r\n") && !bench_holds(bench.heard, ">t:") &&
                  !bench_holds(bench.heard, ">x:"),
              "words are text, time is no series of its own");
    (void)bench_say("stream teleplot x every 1000\rstep 1000\r");
    tap_check(bench_holds(bench.heard, "\r\n>x:") && !bench_holds(bench.heard, ">phase"), "x alone is a series");
}

/* The load is an upper bound: no sample may be longer than was said. */
static void check_sample_bytes(void)
{
    static const char *const setups[] = {"stream csv every 100\r", "stream teleplot every 100\r",
                                         "stream teleplot x,N,F,vr,mode,mu,hash,P every 100\r"};

    for (unsigned i = 0u; i < sizeof setups / sizeof setups[0]; i++) {
        uint32_t bytes;

        bench_open();
        (void)bench_say("set N0 10 alpha -0.02\r");
        (void)bench_say(setups[i]);
        bytes = stream_load(&bench.console.stream.setup, 1.0f, 9600u).sample_bytes;
        (void)bench_say("step 2000\r");
        tap_check(bench.heard_size > 20u * 40u && bench.heard_size < 20u * bytes + 300u, setups[i]);
    }
    tap_check(stream_load(&bench.console.stream.setup, 1.0f, 9600u).sample_bytes <= STREAM_SAMPLE_MAX,
              "and fits its room");
}

static uint32_t field(const char *answer, const char *key)
{
    uint64_t value = 0u;

    for (; *answer != '\0'; answer++) {
        if (bench_starts(answer, key)) {
            size_t length = 0u;

            for (; *answer != '='; answer++) {
            }
            answer++;
            while (answer[length] >= '0' && answer[length] <= '9') {
                length++;
            }
            (void)decimal_parse_u64(answer, length, &value);
            break;
        }
    }
    return (uint32_t)value;
}

/* A line that takes nothing while the plant goes on: what the ring could not hold is counted, the rest arrives in
 * order. */
static void check_gap(void)
{
    const uint32_t steps = 2000u;
    bool is_busy;
    uint32_t sent = 0u;

    bench_open();
    (void)bench_say("stream csv step every 1 force\rrun\r");
    while (bench.executive.sim.step < steps) {
        (void)bench_turn("", 0u, 0u, &is_busy);
    }
    (void)bench_turn("stop\r", 5u, 0u, &is_busy);
    bench_wait(2000u);
    sent = bench.samples;
    tap_check_text(bench.last, "ok stop step=2000", "a full line keeps no stop out");
    tap_check(sent >= EXECUTIVE_SAMPLES && sent < steps, "some samples were lost, the others came before the answer");
    (void)bench_say("status\r");
    tap_check(field(bench.last, " drops=") == steps - sent, "and every loss is counted");
    (void)bench_say("reset\rstatus\r");
    tap_check(field(bench.last, " drops=") == 0u, "from the last reset");
}

/* Steps that are granted wait for their samples, so a slow line loses none. */
static void check_slow_line(void)
{
    bool is_busy;

    bench_open();
    (void)bench_say("set substeps 64\rstream csv step every 1 force\r");
    bench_listen_anew();
    (void)bench_turn("step 3000\r", 10u, 0u, &is_busy);
    while (bench.oks == 0u) {
        (void)bench_turn("", 0u, 64u, &is_busy);
    }
    tap_check(bench.samples == 3000u, "steps that are granted wait for the line, and lose no sample");
    (void)bench_say("status\r");
    tap_check(field(bench.last, " drops=") == 0u, "nor count one");
}

/* A line that takes all at once leaves nothing to send, and nobody would come back for the samples behind it. */
static void check_sudden_room(void)
{
    bool is_busy = true;

    bench_open();
    (void)bench_say("stream csv every 1 force\r");
    bench_listen_anew();
    (void)bench_turn("step 500\r", 9u, 0u, &is_busy);
    for (unsigned i = 0u; i < 500u; i++) {
        (void)bench_turn("", 0u, 0u, &is_busy);
    }
    tap_check(ring_fill(&bench.executive.samples) > 0u, "a reader that has stopped leaves samples behind");
    is_busy = true;
    while (is_busy) {
        (void)bench_turn("", 0u, SIZE_MAX, &is_busy);
    }
    tap_check(bench.samples == 500u && bench.oks == 1u, "one that then takes all at once gets them and the answer");
}

/* Samples that a reset has overtaken are of the set that they were made with. */
static void check_contact(void)
{
    bool is_busy;

    bench_open();
    (void)bench_say("set contact no_pull N0 0 N_max 1 y0 -0.5\rstream csv P every 1 force\rrun\r");
    while (ring_fill(&bench.executive.samples) < 64u) {
        (void)bench_turn("", 0u, 0u, &is_busy);
    }
    bench_listen_anew();
    (void)bench_turn("defaults\r", 9u, 0u, &is_busy);
    tap_check(ring_fill(&bench.executive.samples) >= 64u && executive_params(&bench.executive)->contact == 0.0f,
              "a reset overtakes samples on their way");
    bench_wait(50u);
    tap_check(bench.samples > 64u && bench.oks == 1u && !bench_holds(bench.heard, ",-"),
              "which pull as little as the contact of their set did");
}

/* A change of the stream while samples of the old one still wait. */
static void check_change(void)
{
    static const char line[] = "stream csv N,step every 9 force\r";
    size_t lines = 0u;
    bool is_busy;

    bench_open();
    (void)bench_say("stream csv step every 1 force\rrun\r");
    while (bench.executive.sim.step < 2000u) {
        (void)bench_turn("", 0u, 0u, &is_busy);
    }
    bench_listen_anew();
    (void)bench_turn(line, sizeof line - 1u, 0u, &is_busy);
    bench_wait(30u);
    for (const char *c = bench.heard; *c != '\0' && !bench_starts(c, "ok stream"); c++) {
        lines += *c == '\n' ? 1u : 0u;
    }
    tap_check(lines > EXECUTIVE_SAMPLES, "the old stream's samples come before the new one's answer");
    tap_check(bench_holds(bench.heard, "\r\n#step,t[s],N[N]\r\n20"), "then its header, and samples taken since");
    (void)bench_say("stop\r");
    (void)bench_say("step 9\r");
    tap_check(bench.samples == 1u && bench_starts(bench.heard, "20"), "and it outlasts a stop");
}

void test_stream(void)
{
    check_parse();
    check_load();
    check_refusals();
    check_pace();
    check_csv();
    check_teleplot();
    check_sample_bytes();
    check_gap();
    check_slow_line();
    check_sudden_room();
    check_contact();
    check_change();
}
