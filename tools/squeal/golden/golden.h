/* The subcommand golden: drives a firmware through a table of cases and compares what it measures with the table. */
#ifndef SQUEAL_GOLDEN_H
#define SQUEAL_GOLDEN_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

#include "squeal/console/session.h"
#include "squeal/support/csv.h"

/* What is written for a case, in this order, after its name. */
enum golden_column {
    GOLDEN_X_20,
    GOLDEN_V_20,
    GOLDEN_XMAX_20,
    GOLDEN_XMIN_20,
    GOLDEN_VMAX_20,
    GOLDEN_VMIN_20,
    GOLDEN_STICK_20,
    GOLDEN_X_100,
    GOLDEN_V_100,
    GOLDEN_XPP,
    GOLDEN_STICK,
    GOLDEN_F_UP,
    GOLDEN_CLASS,
    GOLDEN_PERIOD,
    GOLDEN_VERDICT,
    GOLDEN_PREDICTED,
    GOLDEN_T_V10,
    GOLDEN_STEPS,
    GOLDEN_OVERRUNS,
    GOLDEN_CAPS,
    GOLDEN_SATURATIONS,
    GOLDEN_COLUMNS
};

enum { GOLDEN_CELL_SIZE = 32, GOLDEN_REASON_SIZE = 512 };

extern const char *const golden_names[GOLDEN_COLUMNS];

struct golden_plan {
    struct csv cases;
    const char *spp, *normal, *method, *arith; /* as the firmware's parameters of these symbols */
    long steps_per_period;
    bool is_asymptotic; /* also runs to the attractor and measures there */
    long jobs;
    double limit_s; /* for one answer of the firmware */
    char **command;
};

/* What the firmware said of one case. A plain record, small enough to pass through a pipe in one piece. */
struct golden_result {
    size_t row;
    bool is_done;                    /* false: never tried */
    char reason[GOLDEN_REASON_SIZE]; /* why there is nothing to compare; empty if all went well */
    char cells[GOLDEN_COLUMNS][GOLDEN_CELL_SIZE];
};

enum golden_kind { GOLDEN_UNKNOWN, GOLDEN_QUIET, GOLDEN_LOUD, GOLDEN_MARGINAL };

/* Load profiles as the column ntype counts them. */
enum golden_load { GOLDEN_LOAD_CONSTANT, GOLDEN_LOAD_STEP, GOLDEN_LOAD_RAMP, GOLDEN_LOAD_SINE };

/* What the table itself says of a case. */
struct golden_reference {
    size_t row;
    const char *class;     /* NULL where the table has none */
    enum golden_kind kind; /* marginal cases sit on a threshold: neither verdict is wrong */
    bool is_diverging;
    enum golden_load profile;
    double period_s; /* of the normal oscillation */
    double length_m; /* unit of the dimensionless model */
    double t_v10_s;  /* NaN if it never exceeds ten times the disc speed */
};

/* How all rows together compare with the reference. */
struct golden_score {
    size_t passed, failed;
    double caps, overruns;
};

/* Runs one case. SESSION_LOST means that the session is of no further use; the result has the reason in any case. */
enum session_result golden_row_run(struct session *session, const struct golden_plan *plan, size_t row,
                                   struct golden_result *result);

/* Runs every case over plan->jobs firmware processes; results has a place for each row. */
void golden_jobs_run(const struct golden_plan *plan, struct golden_result *results);

struct golden_reference golden_reference_of(const struct csv *cases, size_t row);

/* Prints each difference beyond its tolerance and the worst error of each column. */
struct golden_score golden_check(const struct golden_plan *plan, const struct golden_result *results);

#endif
