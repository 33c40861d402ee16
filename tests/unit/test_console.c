/* The console as a whole: every command, every refusal, any input. */
#include "protocol/console.h"

#include "base/decimal.h"
#include "base/mem.h"
#include "bench.h"
#include "model/presets.h"
#include "protocol/signals.h"
#include "tap.h"
#include "tests.h"

/* One answer a line, whatever the line says; no answer longer than what the console keeps free for it. */
static void check_answers(void)
{
    static const char *const lines[] = {
#define COMMAND(id, name, arguments, help) #name "\r", #name " bogus\r", #name " 1 2 3\r", "help " #name "\r",
#include "protocol/commands.def"
#undef COMMAND
        "echo on\r",      "echo off\r",        "list m\r",
        "list nothing\r", "get m\r",           "set m 1\r",
        "set m\r",        "preset brake\r",    "step 3\r",
        "step 0\r",       "step 1000000001\r", "measure 1\r",
        "stream csv\r",   "stream header\r",   "stream teleplot x,xd every 1000\r",
        "stream off\r",   "demo 9\r",          "  id  \r",
        "Help\r",         "stop stop\r",       "\x01\r",
    };
    bool has_one_each = true;
    size_t longest = 0u;

    bench_open();
    for (size_t i = 0u; i < sizeof lines / sizeof lines[0]; i++) {
        if (bench_starts(lines[i], "demo\r")) {
            continue; /* a test of its own */
        }
        (void)bench_say(lines[i]);
        longest = bench.heard_size > longest ? bench.heard_size : longest;
        if (bench.oks + bench.errors != 1u) {
            has_one_each = false;
            tap_note(lines[i]);
            tap_note(bench.heard);
        }
        (void)bench_say("stop\r");
    }
    tap_check(has_one_each, "every line has exactly one answer");
    tap_check(longest > 2000u && longest <= CONSOLE_ANSWER_MAX - 512u, "no answer needs more room than is kept for it");
    tap_note_number("longest answer, bytes", (float)longest);
}

/* get prints what set reads: every parameter, many values. */
static void check_round_trips(void)
{
    uint32_t random = 99u;
    bool ok = true;

    bench_open();
    for (size_t i = 0u; i < params_count; i++) {
        const struct params_info *info = &params_table[i];
        char line[200] = "set ";
        size_t length = 4u;
        const char *value;
        const struct params before = *executive_params(&bench.executive);

        (void)bench_say("get ");
        for (const char *c = info->symbol; *c != '\0'; c++) {
            line[length++] = *c;
        }
        line[length] = '\r';
        line[length + 1u] = '\0';
        (void)bench_say(line + 4);
        ok = ok && bench_starts(bench.last, "ok get ");
        for (value = bench.last; *value != '='; value++) {
        }
        line[length++] = ' ';
        for (value++; *value != ' '; value++) {
            line[length++] = *value;
        }
        line[length++] = '\r';
        line[length] = '\0';
        ok = ok && bench_starts(bench_say(line), "ok set ");
        ok = ok && memcmp(&before, executive_params(&bench.executive), sizeof before) == 0;
    }
    tap_check(ok, "what get says, set takes, and nothing has changed");

    ok = true;
    for (unsigned i = 0u; i < 200u && ok; i++) {
        const float wanted = -0.3f * (float)(tap_random(&random) >> 8) / 16777216.0f;
        char line[64] = "set alpha ";
        size_t length = 10u;

        length += decimal_format_f32(wanted, DECIMAL_DIGITS_EXACT, line + length);
        line[length++] = '\r';
        line[length] = '\0';
        ok = bench_starts(bench_say(line), "ok set alpha=");
        ok = ok && executive_params(&bench.executive)->friction_slope_s_per_m == wanted;
    }
    tap_check(ok, "nine digits carry any value, to the last bit");
}

struct refusal {
    const char *line, *answer;
};

/* A refused line leaves the set, the plan and the plant as they were. */
static bool is_refused(const struct refusal *refusal)
{
    const struct executive_order draft = bench.executive.draft;
    const uint32_t generation = bench.executive.publish.generation;
    const uint32_t hash = bench.executive.sim.hash;
    const bool ok = bench_starts(bench_say(refusal->line), refusal->answer) &&
                    memcmp(&draft, &bench.executive.draft, sizeof draft) == 0 &&
                    bench.executive.publish.generation == generation && bench.executive.sim.hash == hash;

    if (!ok) {
        tap_note(refusal->line);
        tap_note(bench.last);
    }
    return ok;
}

static void check_refusals(void)
{
    static const struct refusal refusals[] = {
        {"set m -1\r", "error out-of-range m=-1: 1e-06 .. 1000000 kg"},
        {"set m 0\r", "error out-of-range m=0: 1e-06 .. 1000000 kg"},
        {"set c 5 m nan\r", "error bad-number m=nan: not a decimal number, or too large for single precision; "
                            "1e-06 .. 1000000 kg"},
        {"set c 1e39\r", "error bad-number c=1e39: not a decimal number, or too large for single precision; "
                         "0 .. 1000000000 N s/m"},
        {"set v0 1x\r", "error bad-number v0=1x: "},
        {"set m 1e-50\r", "error out-of-range m=1e-50: 1e-06 .. 1000000 kg"},
        {"set m 1 m 2\r", "error usage m: named twice; once is enough"},
        {"set c 1 m 2 mass_kg 3\r", "error usage m: named twice; "},
        {"set tick 1000.5\r", "error out-of-range tick=1000.5: 1 .. 100000 Hz, whole"},
        {"set tick 1e30\r", "error out-of-range tick=1e30: 1 .. 100000 Hz, whole"},
        {"set substeps -6\r", "error out-of-range substeps=-6: 1 .. 64, a whole number"},
        {"stream csv every 0\r", "error out-of-range every=0: 1 .. 1000000000, a whole number"},
        {"stream csv x every 1000000000000 force\r", "error out-of-range every=1000000000000: 1 .. "},
        {"set spp 63\r", "error out-of-range spp=63: 16|32|64|128|256|512|1024"},
        {"set arith f64\r", "error out-of-range arith=f64: f32|q27"},
        {"set substeps 1.5\r", "error out-of-range substeps=1.5: 1 .. 64, a whole number"},
        {"set c 0.02 bogus 1\r", "error unknown-name bogus: no parameter has this name; list shows them"},
        {"set c 0.02 k\r", "error usage set <symbol> <value> [<symbol> <value> ...]"},
        {"set\r", "error usage set "},
        {"set load ramp t1 2 t2 1\r", "error out-of-range t2=1: 2 .. 1000000 s; the ramp ends after its start t1"},
        {"set N0 5\r", "error out-of-scale N0=5: 0 .. 4 N, latched at reset; raise N_max"},
        {"set v0 -5\r", "error out-of-scale v0=-5: -4 .. 4 m/s, latched at reset; raise v_max"},
        {"set kt 20\r", "error out-of-scale kt=20: 0 .. 14 N/m; raise ke"},
        {"set spp 16 kt 3\r", "error step-too-large spp=16: z = 0.7854 exceeds 0.4; raise spp or ke"},
        {"set method naive normal exact\r", "error not-served method=naive: "},
        {"preset nobody\r", "error unknown-name nobody: no preset has this name; preset lists them"},
        {"get bogus\r", "error unknown-name bogus: "},
        {"step 0\r", "error out-of-range n=0: 1 .. 1000000000, a whole number"},
        {"step -5\r", "error out-of-range n=-5: "},
        {"measure 1000001\r", "error out-of-range periods=1000001: 1 .. 1000000, a whole number"},
        {"step\r", "error usage step <n>"},
        {"status now\r", "error usage status: takes no arguments"},
        {"demo 6\r", "error out-of-range act=6: 1 .. 5, a whole number"},
        {"demo 1 2\r", "error usage demo [act]"},
        {"launch\r", "error unknown-command launch: no command has this name; help lists them"},
    };
    static const struct refusal while_running[] = {
        {"set m 1\r", "error needs-restart m=1: "},
        {"set c 0.02 spp 128\r", "error needs-restart spp=128: "},
        {"step 5\r", "error is-running step: only while the plant is stopped"},
        {"measure 5\r", "error is-running measure: "},
    };
    bool ok = true;

    bench_open();
    (void)bench_say("step 100\r");
    for (size_t i = 0u; i < sizeof refusals / sizeof refusals[0]; i++) {
        ok = is_refused(&refusals[i]) && ok;
    }
    tap_check(ok, "a refusal says why, and changes no bit");
    ok = true;
    (void)bench_say("run\r");
    for (size_t i = 0u; i < sizeof while_running / sizeof while_running[0]; i++) {
        const struct params before = *executive_params(&bench.executive);

        ok = bench_starts(bench_say(while_running[i].line), while_running[i].answer) && ok;
        ok = memcmp(&before, executive_params(&bench.executive), sizeof before) == 0 && ok;
    }
    tap_check(ok, "while running, what needs a standstill is refused");
}

static void check_set(void)
{
    bench_open();
    tap_check_text(bench_say("set N0 50 alpha -0.02\r"), "ok set N0=50 alpha=-0.02 generation=2 reset=yes",
                   "at the first step the scale follows the set");
    (void)bench_say("step 10\r");
    tap_check_text(bench_say("set friction_static_ratio 0.4 c 0.02\r"), "ok set mu_s=0.4 c=0.02 generation=3 reset=no",
                   "later a live parameter takes effect between two steps, by either name");
    tap_check(bench.executive.sim.step == 10u, "and the plant stays where it is");
    tap_check_text(bench_say("set spp 128\r"), "ok set spp=128 generation=4 reset=yes", "a restart parameter resets");
    tap_check(bench.executive.sim.step == 0u, "to the first step");
    tap_check_text(bench_say("preset groan\r"), "ok preset groan generation=5", "a preset");
    tap_check(executive_params(&bench.executive)->mass_kg == 12.0f, "is loaded");
    tap_check_text(bench_say("defaults\r"), "ok defaults generation=6", "the defaults");
    tap_check(executive_params(&bench.executive)->mass_kg == 0.3f, "are loaded");
    (void)bench_say("run\r");
    tap_check_text(bench_say("set mu_s 0.5\r"), "ok set mu_s=0.5 generation=7 reset=no",
                   "a plant that runs is not reset");
    (void)bench_say("stop\r");
    tap_check_text(bench_say("reset\r"), "ok reset generation=9", "a reset");
    tap_check(bench.executive.sim.step == 0u, "goes to the first step");
}

/* The end of all input: what was said is done, what would go on for ever ends. */
static void check_end(void)
{
    bench_open();
    (void)bench_say("run\r\x04");
    tap_check(bench.oks == 1u && bench.errors == 0u && !executive_wants_tick(&bench.executive),
              "the end of input ends a free run, and is not answered");
    tap_check(bench_starts(bench_say("defaults\rstep 500\r\x04"), "ok step done=500 "), "but no step under way");
}

/* Noise of any kind, then a good line. */
static void check_garbage(void)
{
    uint32_t random = 7u;
    bool ok = true;
    bool is_busy;

    bench_open();
    for (unsigned i = 0u; i < (tap_is_hosted() ? 300u : 30u) && ok; i++) {
        char noise[64];

        for (unsigned j = 0u; j < sizeof noise; j++) {
            noise[j] = (char)tap_random(&random);
        }
        for (size_t sent = 0u; sent < sizeof noise;) {
            sent += bench_turn(noise + sent, sizeof noise - sent, SIZE_MAX, &is_busy);
        }
        (void)bench_say("\rstop\r");
        ok = bench_starts(bench_say("get m\r"), "ok get m=");
    }
    tap_check(ok, "after any noise the next good line is obeyed");
    tap_check(bench.console.line.garbage > 0u && bench.console.rejected > 0u, "and the noise is counted");
    (void)bench_say("get ");
    console_lost(&bench.console, 3u);
    tap_check(bench_starts(bench_say("m\r"), "error line-damaged: bytes of this line were lost"),
              "a line that lost bytes is not obeyed");
    tap_check(bench.console.uart_lost == 3u && bench_starts(bench_say("get m\r"), "ok "), "the next one is");
    for (unsigned i = 0u; i < 300u; i++) {
        (void)bench_say("x");
    }
    tap_check_text(bench_say("\r"), "error line-too-long: a line holds at most 240 characters", "an endless line ends");
}

/* A program that does not wait for answers, over a line that is slower than it. */
static void check_paste(void)
{
    static const char line[] = "set mu_s 0.25 c 0.02\n";
    const uint32_t lines = tap_is_hosted() ? 10000u : 500u;
    uint32_t random = 3u;
    uint32_t begun = 0u;
    size_t offset = 0u;
    bool is_busy = true;

    bench_open();
    (void)bench_say("step 3\r");
    bench_listen_anew();
    while (begun < lines || is_busy || bench.console.waiting_size > 0u || bench.text.head != bench.text.tail) {
        const size_t offered = begun < lines ? 1u + tap_random(&random) % (sizeof line - 1u - offset) : 0u;

        offset += bench_turn(line + offset, offered, tap_random(&random) % 100u, &is_busy);
        if (offset == sizeof line - 1u) {
            offset = 0u;
            begun++;
        }
    }
    tap_check(bench.oks == lines && bench.errors == 0u, "none of many pasted lines is lost");
}

static void check_echo(void)
{
    bench_open();
    (void)bench_say("echo on\r");
    (void)bench_say("get m\rget c\r");
    tap_check_text(bench.heard, "get m\r\nok get m=0.3 unit=kg\r\nget c\r\nok get c=0.01 unit=N.s/m\r\n",
                   "echo and answers follow each other");
    (void)bench_say("stream csv step every 100 force\rrun\rget");
    bench_wait(100u);
    tap_check(bench_holds(bench.heard, "get\r\n100,5.37725352\r\n"), "a sample never joins a line that is being typed");
    (void)bench_say(" m\r");
    tap_check(bench_starts(bench.last, "ok get m="), "which goes on");
}

static void check_banner(void)
{
    bench_open();
    console_banner(&bench.console);
    (void)bench_say("");
    tap_check(bench_starts(bench.heard, "squeal 0.0.0 (test) on bench, none: "), "the banner says who is speaking");
    tap_check_text(bench_say("id\r"),
                   "ok id name=squeal version=0.0.0 build=test board=bench core=none emulated=no fpu=yes link=yes "
                   "params=6 signals=3 "
                   "commands=7 arith=f32 normal=rk4 method=event states=4 spp=64",
                   "and so does id");
}

static void check_table(void)
{
    bench_open();
    tap_check_text(bench_say("table load\r"), "ok table load points=0", "a table is empty at first");
    tap_check_text(bench_say("set load table\r"),
                   "error no-table load=table: load or speed is a table, and that table is "
                   "empty: table fills it",
                   "and then no profile");
    tap_check_text(bench_say("table load 0 0 0.5 3 0.5 2.5\r"), "ok table load points=3 generation=2 reset=yes",
                   "its points");
    tap_check_text(bench_say("table load more 1e3 1.5\r"), "ok table load points=4 generation=3 reset=yes", "more");
    tap_check_text(bench_say("table load more 999 1\r"), "error out-of-range t=999: 1000 .. 1000000 s", "none before");
    tap_check_text(bench_say("table load 1 2 1.5 -1\r"), "error out-of-range N0=-1: 0 .. 1000000000 N",
                   "no force below 0");
    tap_check_text(bench_say("table load 1 2 x 1\r"),
                   "error bad-number t=x: not a decimal number, or too large for single precision", "no word");
    tap_check(bench_starts(bench_say("table load 1 2 3\r"), "error usage ") &&
                  bench_starts(bench_say("table\r"), "error usage ") &&
                  bench_starts(bench_say("table load more\r"), "error usage ") &&
                  bench_starts(bench_say("table load clear 1 2\r"), "error usage ") &&
                  bench_starts(bench_say("table brake 1 2\r"), "error usage "),
              "times and values in pairs, for one of the two");
    (void)bench_say("table load\r");
    tap_check(bench_holds(bench.heard, "0.5 2.5\r\n") && bench_holds(bench.heard, "ok table load points=4"),
              "what was refused has changed nothing");
    tap_check(bench_starts(bench_say("set load table\r"), "ok set load=table"), "now the profile can be it");
    tap_check(bench_starts(bench_say("table load clear\r"), "error no-table "), "which then cannot be cleared");
    tap_check_text(bench_say("table speed 0 1 2 -1\r"), "ok table speed points=2 generation=5 reset=yes",
                   "the other one");
    (void)bench_say("step 10\r");
    tap_check(bench_holds(bench_say("table load 0 1\r"), "reset=no") &&
                  bench_holds(bench.heard, "ok table load points=1 "),
              "a running plant takes it between two steps");
}

static void check_full_table(void)
{
    bench_open();
    (void)bench_say("table load 1 1\r");
    for (unsigned i = 0u; i < 21u; i++) {
        (void)bench_say("table load more 1 1 1 2 1 3\r");
    }
    tap_check(bench_holds(bench.heard, "points=64"), "64 points");
    tap_check_text(bench_say("table load more 2 1\r"), "error table-full 2: a table holds at most 64 points",
                   "no more");
}

void test_console(void)
{
    check_banner();
    check_answers();
    check_round_trips();
    check_refusals();
    check_set();
    check_end();
    check_garbage();
    check_paste();
    check_echo();
    check_table();
    check_full_table();
}
