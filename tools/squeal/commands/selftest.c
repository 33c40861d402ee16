/* selftest: does the device at the port do what PROTOCOL.md says, and is its brake the one that this tool was built
 * with? */
#include "squeal/commands/linked.h"

#include "base/random.h"
#include "model/presets.h"
#include "protocol/signals.h"
#include "sim/executive.h"
#include "squeal/record/recording.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define OWN_LIMIT_S 300.0

enum {
    STEPS = 4000,
    TURN_MAX = 40,
    DETAIL_SIZE = 256,
};

struct selftest {
    struct device *device;
    unsigned passed, failed;
};

__attribute__((format(printf, 3, 4))) static void check(struct selftest *test, bool holds, const char *format, ...)
{
    char detail[DETAIL_SIZE];
    va_list arguments;

    va_start(arguments, format);
    (void)vsnprintf(detail, sizeof detail, format, arguments);
    va_end(arguments);
    printf("%s %s\n", holds ? "pass" : "fail", detail);
    test->passed += holds ? 1u : 0u;
    test->failed += holds ? 0u : 1u;
}

/* Words of every byte, 0 among them, come back as they went. */
static enum device_result test_echo(struct selftest *test)
{
    static const uint64_t words[] = {0, UINT64_MAX, UINT64_C(0x0100000000000000), UINT64_C(0x0123456789abcdef)};
    enum device_result result = DEVICE_OK;
    unsigned wrong = 0;

    for (size_t i = 0; i < sizeof words / sizeof words[0] && result == DEVICE_OK; i++) {
        uint64_t echo = 0;
        result = device_ping(test->device, words[i], &echo);
        wrong += echo != words[i] ? 1u : 0u;
    }
    check(test, result == DEVICE_OK && wrong == 0, "echo: what PING sends comes back");
    return result;
}

/* A parameter of the device against the row of our own table. */
static bool is_ours(const struct device_row *row, const struct params_info *info)
{
    return row->id == info->id && strcmp(row->symbol, info->symbol) == 0 && row->standard == info->standard &&
           row->low == info->low && row->high == info->high && strcmp(row->unit, info->unit) == 0 &&
           strcmp(row->help, info->help) == 0 && (row->change == LINK_RESTART) == (info->change == PARAMS_RESTART);
}

static void test_params(struct selftest *test)
{
    const size_t count = device_count(test->device, DEVICE_PARAMS);
    const bool is_same = device_identity(test->device)->params_version == PARAMS_VERSION;
    size_t sound = 0, ours = 0;

    for (size_t i = 0; i < count; i++) {
        const struct device_row *row = device_row(test->device, DEVICE_PARAMS, i);
        sound +=
            row->symbol[0] != '\0' && row->help[0] != '\0' && row->low <= row->standard && row->standard <= row->high;
        ours += is_same && i < params_count && is_ours(row, &params_table[i]) ? 1u : 0u;
    }
    check(test, count > 0 && sound == count, "parameters: %zu, each with a name, a meaning and a default in its range",
          count);
    check(test, !is_same || (count == params_count && ours == count), "parameters: %s",
          is_same ? "of the version that this tool knows, row by row the same" : "of another version than this tool's");
}

static void test_others(struct selftest *test)
{
    const size_t signals = device_count(test->device, DEVICE_SIGNALS);
    const bool is_same = device_identity(test->device)->signals_version == SIGNALS_VERSION;
    size_t ours = 0;

    for (size_t i = 0; i < signals && i < SIGNAL_COUNT; i++) {
        const struct device_row *row = device_row(test->device, DEVICE_SIGNALS, i);
        ours +=
            strcmp(row->symbol, signals_table[i].name) == 0 && strcmp(row->unit, signals_table[i].unit) == 0 ? 1u : 0u;
    }
    check(test, signals > 0 && (!is_same || (ours == signals && signals == SIGNAL_COUNT)), "signals: %zu%s", signals,
          is_same ? ", those that this tool knows" : "");
    const size_t presets = device_count(test->device, DEVICE_PRESETS);
    check(test, presets > 0, "presets: %zu", presets);
}

/* The set that the device runs, in our own struct; false if one of its parameters has no place there. */
static bool set_of(struct selftest *test, const struct recording *recording, struct params *params)
{
    params_default(params);
    for (size_t i = 0; i < recording->set_count; i++) {
        const char *symbol = device_row(test->device, DEVICE_PARAMS, i)->symbol;
        const struct params_info *info = params_find(symbol, strlen(symbol));
        if (info == NULL) {
            return false;
        }
        params_set(params, info, recording->set[i].value);
    }
    return true;
}

/* Force and speed that a restless controller might ask for; the same each time. */
static void draw(uint64_t turn, struct input_demand *demand, uint32_t *count)
{
    const struct random_words kinds = random_words(1u, 0u, turn), values = random_words(1u, 1u, turn);
    const float load = (float)(values.first >> 16) / 65536.0f, speed = (float)(values.second >> 16) / 65536.0f;

    *count = 1u + (kinds.first >> 8) % TURN_MAX;
    *demand = (struct input_demand){.load = (enum input_load)(kinds.first % (INPUT_LOAD_PRESSURE + 1u)),
                                    .speed = (enum input_speed)(kinds.second % (INPUT_SPEED_VEHICLE + 1u))};
    demand->load_value = demand->load == INPUT_LOAD_PRESSURE ? 2e6f * load : 6000.0f * load;
    demand->speed_value = demand->speed == INPUT_SPEED_VEHICLE ? 2.0f * speed : 0.5f * speed;
}

/* The twin: the same executive that the firmware has, turned here. */
static uint32_t twin_step(struct executive *twin, uint32_t count, const struct input_demand *demand)
{
    struct executive_report report;

    if (demand->load != INPUT_LOAD_KEEP || demand->speed != INPUT_SPEED_KEEP) {
        (void)executive_input(twin, demand, NULL);
    }
    executive_grant(twin, count);
    while (executive_credit(twin) > 0) {
        (void)executive_tick(twin, true);
    }
    executive_report(twin, &report);
    return report.now.hash;
}

static enum device_result lockstep(struct selftest *test, struct executive *twin)
{
    struct master_state state = {0};
    enum device_result result = DEVICE_OK;
    uint32_t hash = 0, turns = 0;

    do {
        struct input_demand demand;
        uint32_t count;
        draw(turns, &demand, &count);
        result = device_step(test->device, count, &demand, &state);
        hash = result == DEVICE_OK ? twin_step(twin, count, &demand) : hash;
        turns++;
    } while (result == DEVICE_OK && state.hash == hash && state.step < STEPS && (state.flags & LINK_IS_FAULT) == 0);
    check(test, result == DEVICE_OK && state.hash == hash && state.step >= STEPS,
          "lockstep: %u turns, %llu steps with inputs, hash %08x%s", turns, (unsigned long long)state.step, state.hash,
          state.hash == hash ? ", as computed here" : "; computed here it is another");
    return result;
}

/* The preset brake, in the number format that the device has now, with the device's own set read back from it. */
static enum device_result test_lockstep(struct selftest *test)
{
    struct executive *twin = calloc(1, sizeof *twin);
    struct recording brake = {0};
    struct params params;
    const int preset = device_find(test->device, DEVICE_PRESETS, "brake");
    enum device_result result =
        twin != NULL && preset >= 0 ? device_preset(test->device, preset, NULL) : DEVICE_REFUSED;

    result = result == DEVICE_OK ? recording_read_set(&brake, test->device) : result;
    if (result == DEVICE_OK && set_of(test, &brake, &params)) {
        executive_init(twin, (int)params.arithmetic);
        (void)executive_tick(twin, false);
        const struct params_problem problem = executive_reset(twin, &params);
        (void)executive_tick(twin, false);
        result = problem.error == ERROR_OK ? lockstep(test, twin) : DEVICE_REFUSED;
    } else if (result == DEVICE_OK) {
        check(test, false, "lockstep: the set has a parameter that this tool does not know: use that of the firmware");
    }
    recording_free(&brake);
    free(twin);
    return result;
}

/* The device's own checks, where it has any. A test must not be told for one that this tool does not know. */
static enum device_result test_own(struct selftest *test)
{
    const size_t count = device_count(test->device, DEVICE_SELFTESTS);
    unsigned passed = 0, failed = 0;
    uint32_t failures = 0;

    if (count == 0) {
        printf("note the device has no checks of its own over the link\n");
        return DEVICE_OK;
    }
    const enum device_result result = device_selftest(test->device, OWN_LIMIT_S, &passed, &failed, &failures);
    for (size_t i = 0; i < count && i < 32 && result == DEVICE_OK; i++) {
        const struct device_row *row = device_row(test->device, DEVICE_SELFTESTS, i);
        check(test, (failures >> i & 1u) == 0, "on the device: %s: %s", row->symbol, row->help);
    }
    check(test, result == DEVICE_OK && passed + failed == count, "on the device: %u passed, %u failed", passed, failed);
    return result;
}

static int run_all(struct selftest *test)
{
    struct recording before = {0};
    enum device_result result = device_read_table(test->device, DEVICE_TABLES);

    check(test, result == DEVICE_OK, "dictionary: every row of every table could be read");
    result = result == DEVICE_OK ? recording_read_set(&before, test->device) : result;
    result = result == DEVICE_OK ? test_echo(test) : result;
    if (result == DEVICE_OK) {
        test_params(test);
        test_others(test);
        result = test_lockstep(test);
        result = result == DEVICE_OK ? test_own(test) : result;
    }
    /* The set that was in force before comes back, at step 0. */
    result = result == DEVICE_OK ? recording_load(&before, test->device) : result;
    recording_free(&before);
    if (result != DEVICE_OK) {
        return linked_fail(test->device, result);
    }
    printf("%u passed, %u failed\n", test->passed, test->failed);
    return test->failed == 0 ? EXIT_OK : EXIT_FAILED;
}

int command_selftest(const struct arguments *arguments)
{
    struct selftest test = {0};

    if (!arguments_has_operands(arguments, 0, 0)) {
        return EXIT_USAGE;
    }
    int code = linked_open(arguments, &test.device);
    if (code == EXIT_OK) {
        code = run_all(&test);
    }
    device_close(test.device);
    return code;
}
