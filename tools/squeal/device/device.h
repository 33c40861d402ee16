/* A device at the other end of a port: questions that wait for their answer, what it can do as it says itself, and the
 * samples that it sends.
 *
 *     struct device *device = device_open("qemu:mps2-an386", 5.0, problem);
 *     const int n1 = device_find(device, DEVICE_PARAMS, "N1");
 *     if (device_set(device, &(struct device_value){n1, 3000.0f}, 1, NULL, true, NULL) != DEVICE_OK) {
 *         puts(device_problem(device));
 *     }
 *
 * A question without an answer is asked again, about once a second, until the limit has passed; the link bears that.
 * All text that comes from the device is printable ASCII when it gets out of here. Numbers of rows are those of the
 * device's own tables, which a newer firmware may have more of than this program. */
#ifndef SQUEAL_DEVICE_H
#define SQUEAL_DEVICE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "protocol/master.h"
#include "protocol/messages.h"
#include "sim/input.h"
#include "squeal/support/printable.h"

struct device;
struct port;

enum { DEVICE_PROBLEM_MAX = 512, DEVICE_SIGNALS_MAX = 32 };

enum device_result {
    DEVICE_OK,
    DEVICE_REFUSED, /* the device said no: device_problem() in words, device_refusal() in numbers; all goes on */
    DEVICE_LOST     /* the port is gone or silent: device_problem() says so; only device_close() is left */
};

/* --- The connection ----------------------------------------------------------------------------------------------- */

/* Opens the port and says HELLO, both within limit_s, which also holds for every question after it. NULL with the
 * problem: the port cannot be opened, nobody answers there, or what answers speaks another major version. */
struct device *device_open(const char *port, double limit_s, char problem[DEVICE_PROBLEM_MAX]);
void device_close(struct device *device);

/* Why the last question failed, one line that names the port. */
const char *device_problem(const struct device *device);
const struct master_refusal *device_refusal(const struct device *device);

/* The name of an error's number; "unknown-error" of one that only a newer device knows. */
const char *device_error_name(unsigned error);

/* Has the port gone, or fallen silent? Where a function gives no result but a row, this tells what kind of problem it
 * was. */
bool device_is_lost(const struct device *device);

/* For poll() and its like: when its fd is readable, device_listen(device, 0.0) takes what came. */
const struct port *device_port(const struct device *device);

/* Characters that a text of so many bytes may take. */
#define DEVICE_TEXT(width) (PRINTABLE_GROWTH * (width) + 1)

struct device_identity {
    unsigned major, minor;                                      /* of the link */
    unsigned params_version, signals_version, commands_version; /* of the tables */
    bool is_emulated, has_fpu;
    char version[DEVICE_TEXT(LINK_VERSION_WIDTH)], build[DEVICE_TEXT(LINK_BUILD_WIDTH)];
    char board[DEVICE_TEXT(LINK_BOARD_WIDTH)], core[DEVICE_TEXT(LINK_CORE_WIDTH)];
};

const struct device_identity *device_identity(const struct device *device);

/* --- What it can do: the dictionary ------------------------------------------------------------------------------- */

enum device_table {
    DEVICE_PARAMS = LINK_PARAMS,
    DEVICE_SIGNALS = LINK_SIGNALS,
    DEVICE_PRESETS = LINK_PRESETS,
    DEVICE_SELFTESTS = LINK_SELFTESTS, /* empty where the device has no such table */
    DEVICE_TABLES = LINK_TABLE_COUNT
};

struct device_row {
    unsigned id;
    unsigned kind;   /* enum link_kind */
    unsigned change; /* enum link_change */
    float standard, low, high;
    char symbol[DEVICE_TEXT(LINK_SYMBOL_WIDTH)];
    char unit[DEVICE_TEXT(LINK_UNIT_WIDTH)]; /* of a choice: its names, bars between */
    char help[DEVICE_TEXT(LINK_HELP_WIDTH)];
};

/* Reads a table, or all of them with DEVICE_TABLES, that have not been read. What needs a table reads it by itself. */
enum device_result device_read_table(struct device *device, enum device_table table);

/* Rows of a table, 0 if it could not be read; a row of it, NULL beyond the last one. */
size_t device_count(struct device *device, enum device_table table);
const struct device_row *device_row(struct device *device, enum device_table table, size_t index);

/* The number of the row with that symbol; -1 if there is none, which is then the problem, with names that are like
 * it. */
int device_find(struct device *device, enum device_table table, const char *symbol);

/* Text to a value of a parameter and back: a name for a choice, else a number. Parsing gives false with the problem if
 * it is no such, or outside the row's range. A formatted float reads back as the same bits. */
bool device_parse(struct device *device, size_t param, const char *text, float *value);
enum { DEVICE_TEXT_MAX = 64 };
void device_format(const struct device_row *row, float value, char out[DEVICE_TEXT_MAX]);

/* --- The set ------------------------------------------------------------------------------------------------------ */

struct device_value {
    int index; /* of the parameter */
    float value;
};

struct device_commit {
    uint32_t crc; /* of the set now in force */
    uint32_t generation;
    bool was_reset; /* back to step 0 */
};

/* A parameter in force; a signal as it is now, a hash as the number that it is. */
enum device_result device_get(struct device *device, int param, float *value);
enum device_result device_look(struct device *device, int signal, double *value);

/* A table of breakpoints in force; empty on a device that has none. */
enum device_result device_get_table(struct device *device, enum params_table_index index, struct params_points *table);

/* Tables that go with a set; NULL: that one stays as it is. */
struct device_tables {
    const struct params_points *table[PARAMS_TABLES];
};

/* Puts all the values and tables into force or none. Without may_reset a change that needs a restart is refused. tables
 * and commit may be NULL. */
enum device_result device_set(struct device *device, const struct device_value *values, size_t count,
                              const struct device_tables *tables, bool may_reset, struct device_commit *commit);

/* A named set into force: stops and resets. */
enum device_result device_preset(struct device *device, int preset, struct device_commit *commit);

/* --- Stepping ----------------------------------------------------------------------------------------------------- */

/* Free run; stop; back to step 0 with the same set. step: where the plant stands. */
enum device_result device_run(struct device *device, uint64_t *step);
enum device_result device_stop(struct device *device, uint64_t *step);
enum device_result device_reset(struct device *device, uint64_t *step);

/* Makes count steps from where the plant stands, with the demand held from here on; NULL: all as it was. The limit is
 * that of one reply. More than a request may carry are made by several, the demand with the first. */
enum device_result device_step(struct device *device, uint64_t count, const struct input_demand *demand,
                               struct master_state *state);

/* Holds a demand from its step on, ahead of time. */
enum device_result device_input(struct device *device, const struct input_demand *demand, bool *was_clamped);

struct device_status {
    unsigned state; /* 0 ready, 1 run, 2 fault */
    uint64_t step;
    uint32_t generation, hash, set_crc;
    float step_s, sigma;
    uint32_t events, caps, saturations, lifted, gap_held, ticks, overruns, shed;
    uint32_t inputs, inputs_late, inputs_clamped, inputs_refused;
    uint32_t offered, sent, dropped, waiting; /* samples */
    uint32_t frames, damaged, too_long, bad_cobs, too_short, bad_crc, garbage_bytes, refused;
    uint8_t input_state; /* enum watch_state */
    uint32_t times_stale, times_safe;
};

enum device_result device_status(struct device *device, struct device_status *status);

enum device_result device_ping(struct device *device, uint64_t word, uint64_t *echo);

struct device_verdict {
    uint8_t propensity, motion, period; /* as in struct master_state */
    uint8_t band;                       /* 0 none, 1 groan, 2 squeal */
    uint8_t predicted;                  /* the same names */
    bool is_audible, is_bistable;
    float amplitude_um, velocity_mm_s, velocity_mm_s_rms, level_db, acceleration_g, frequency_hz, level_dba_estimate;
    float growth_per_s, growth_error_per_s, stick, slip_minus; /* shares of the time */
    float predicted_growth_per_s, predicted_touch_ratio, onset_touch_ratio, t_v10_s, sigma;
};

/* What the device says of the motion; NaN where something makes no sense. */
enum device_result device_verdict(struct device *device, struct device_verdict *verdict);

/* The device's own checks, by rows of its table of self-tests: bit i of failures says that test i failed. It takes as
 * long as limit_s. */
enum device_result device_selftest(struct device *device, double limit_s, unsigned *passed, unsigned *failed,
                                   uint32_t *failures);

/* --- Samples ------------------------------------------------------------------------------------------------------ */

struct device_sample {
    uint64_t step;
    uint32_t missing;                 /* samples lost since the one before */
    size_t count;                     /* of signals */
    const int *signal;                /* which they are */
    double value[DEVICE_SIGNALS_MAX]; /* numbers for names; a hash as the number that it is */
};

typedef void (*device_listener)(void *context, const struct device_sample *sample);

/* Who is told of every sample, whatever the device is asked meanwhile. NULL: nobody. */
void device_on_sample(struct device *device, device_listener listener, void *context);

struct device_stream {
    uint32_t every, smallest; /* steps: as asked, and the least that the line can carry in free run */
    uint32_t bytes;           /* of a sample on the line */
};

/* Samples of these signals each every-th step; every 0 ends them, after the last one. reply may be NULL. */
enum device_result device_stream(struct device *device, const int *signals, size_t count, uint32_t every,
                                 struct device_stream *reply);

/* --- Studies: trials beside the plant, which goes on undisturbed -------------------------------------------------- */

struct device_axis {
    int param;
    bool is_log; /* equal ratios instead of equal steps */
    float from, to;
    unsigned points;
};

/* Normal periods of a trial: to settle, and to measure over; is_whole: never cut short. */
struct device_span {
    unsigned transient, window;
    bool is_whole;
};

struct device_point {
    uint32_t index; /* the first axis fastest */
    float at[2];    /* on the axes */
    uint8_t error;  /* enum error: why the model cannot hold this set; then nothing that follows means anything */
    uint8_t propensity, motion, period, predicted, end;
    bool is_loud, is_undecided;
    float amplitude_um, velocity_mm_s, frequency_hz, level_db, growth_per_s, growth_error_per_s, predicted_growth_per_s;
    float periods;
};

/* NaN where there is none. */
struct device_side {
    float border, quiet, squeal; /* and the values of both kinds between which it lies */
    float searched;              /* the farthest value tried where there is none */
};

struct device_border {
    uint8_t param;
    bool is_squeal; /* at the value itself */
    uint8_t quiets; /* 0 none, 1 down, 2 up, 3 any */
    float value;
    struct device_side below, above;
};

struct device_tally {
    uint8_t reason; /* ERROR_OK done, ERROR_STOPPED, or why the set itself cannot be tried */
    uint32_t results;
    uint32_t trials, unknown, quiet, watch, squeal, loud, undecided, refused, diverged, caps, saturations, gap_held;
    uint64_t steps;
};

/* Who is told what comes of a study. */
struct device_study {
    void *context;
    void (*on_point)(void *context, const struct device_point *point);    /* of a scan */
    void (*on_border)(void *context, const struct device_border *border); /* of a margin */
    void (*on_end)(void *context, const struct device_tally *tally);
};

/* Begin a study: a map over one axis or two; the borders of one parameter, or of all with -1. results: so many are to
 * come, by themselves, see device_listen(). */
enum device_result device_scan(struct device *device, const struct device_axis *axes, size_t count,
                               const struct device_span *span, const struct device_study *study, uint32_t *results);
enum device_result device_margin(struct device *device, int param, float within, const struct device_span *span,
                                 const struct device_study *study, uint32_t *results);

/* Takes what comes until the study has ended, looking now and then whether the device is still there, or until
 * is_unwanted(), which ends the study. */
enum device_result device_await_study(struct device *device, bool (*is_unwanted)(void));

/* Takes what comes by itself for so long; 0.0: what is there already. */
enum device_result device_listen(struct device *device, double seconds);

#endif
