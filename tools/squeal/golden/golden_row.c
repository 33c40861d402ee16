/* One case of the table: its parameters go to the firmware as the table's own text, the answers come back as text, so
 * no digit is lost on the way. */
#include "squeal/golden/golden.h"

#include "squeal/support/fields.h"

#include <math.h>
#include <string.h>

/* One command grants at most so many steps, so that the limit for an answer does not depend on the length of a case. */
enum { STEPS_A_COMMAND = 200000, PERIODS_FIRST = 20, PERIODS_SECOND = 80 };

struct pair {
    const char *column, *symbol;
};

/* Mechanics and options first, still under the default load, because they decide whether the set is served at all. Then
 * load and friction together: they set the scale. Then the initial state, which has to fit that scale. Each of these is
 * a whole valid set, since the firmware accepts only such. */
static const struct pair mechanics[] = {{"m", "m"}, {"c", "c"},   {"ke", "ke"}, {"kt", "kt"},
                                        {"k", "k"}, {"cn", "cn"}, {"v0", "v0"}};
static const struct pair friction[] = {{"mus", "mu_s"}, {"alpha", "alpha"}, {"mumin", "mu_floor"}};
static const struct pair initial[] = {{"x0", "x0"}, {"xd0", "xd0"}, {"y0", "y0"}, {"yd0", "yd0"}};

/* Per load profile: which column feeds which symbol. A sine keeps its frequency in the column t2. */
static const struct pair load_constant[] = {{"N0", "N0"}};
static const struct pair load_step[] = {{"N0", "N0"}, {"N1", "N1"}, {"t1", "t1"}};
static const struct pair load_ramp[] = {{"N0", "N0"}, {"N1", "N1"}, {"t1", "t1"}, {"t2", "t2"}};
static const struct pair load_sine[] = {{"N0", "N0"}, {"N1", "N1"}, {"t1", "t1"}, {"t2", "fN"}};
static const struct {
    const char *name;
    const struct pair *pairs;
    size_t count;
} loads[] = {{"constant", load_constant, 1}, {"step", load_step, 3}, {"ramp", load_ramp, 4}, {"sine", load_sine, 4}};
static const char *const contacts[] = {"bilateral", "no_pull", "lift"};

/* What a row needs at hand while it runs. */
struct row {
    struct session *session;
    const struct golden_plan *plan;
    struct golden_result *result;
    size_t index;
    bool has_failed;  /* the reason is in the result */
    bool has_faulted; /* the plant diverged; no group can be measured any more */
    enum session_result last;
};

static void row_fail(struct row *row, const char *reason, const char *detail)
{
    if (!row->has_failed) {
        (void)snprintf(row->result->reason, sizeof row->result->reason, "%.200s%.280s", reason, detail);
        row->has_failed = true;
    }
}

/* Sends one line; true if it was answered ok. A plant in fault is an answer about the case, not a failure of the row.
 */
static bool row_send(struct row *row, const char *line)
{
    if (row->has_failed) {
        return false;
    }
    row->last = session_command(row->session, row->plan->limit_s, "%s", line);
    if (row->last == SESSION_LOST) {
        row_fail(row, "", row->session->failure);
    } else if (row->last == SESSION_REFUSED && strncmp(row->session->answer, "error in-fault", 14) == 0) {
        row->has_faulted = true;
    } else if (row->last == SESSION_REFUSED) {
        row_fail(row, row->session->answer, "");
    }
    return row->last == SESSION_OK;
}

static void line_append(struct row *row, char line[SESSION_COMMAND_MAX + 2], const char *symbol, const char *value)
{
    const size_t used = strlen(line);
    const int count = snprintf(line + used, SESSION_COMMAND_MAX + 2 - used, " %s %s", symbol, value);

    if (count < 0 || used + (size_t)count > SESSION_COMMAND_MAX) {
        row_fail(row, "the line with these values is too long for the console: ", symbol);
    }
}

/* Appends the cells of a row; a column that the table lacks leaves the firmware's default. */
static void line_append_cells(struct row *row, char line[SESSION_COMMAND_MAX + 2], const struct pair *pairs,
                              size_t count)
{
    for (size_t i = 0; i < count; i++) {
        const char *text = csv_cell(&row->plan->cases, row->index, csv_column(&row->plan->cases, pairs[i].column));
        double value;
        if (text == NULL) {
            continue;
        }
        if (!fields_parse(text, &value)) {
            row_fail(row, "no number in column ", pairs[i].column);
            return;
        }
        line_append(row, line, pairs[i].symbol, text);
    }
}

/* The choice that a column holds as a whole number from 0; 0 where the table lacks the column. */
static size_t cell_choice(struct row *row, const char *column, size_t count)
{
    const int place = csv_column(&row->plan->cases, column);
    const double value = place < 0 ? 0.0 : csv_number(&row->plan->cases, row->index, place);

    if (!(value >= 0.0 && value < (double)count && floor(value) >= value)) {
        row_fail(row, "no such choice in column ", column);
        return 0;
    }
    return (size_t)value;
}

#define PAIRS(table) table, sizeof(table) / sizeof(table)[0]

static void row_set(struct row *row)
{
    char line[SESSION_COMMAND_MAX + 2] = "set";
    const size_t load = cell_choice(row, "ntype", sizeof loads / sizeof loads[0]);

    (void)row_send(row, "defaults");
    line_append_cells(row, line, PAIRS(mechanics));
    line_append(row, line, "alpha", "0"); /* the default slope may be too steep for these mechanics */
    line_append(row, line, "contact", contacts[cell_choice(row, "contact", sizeof contacts / sizeof contacts[0])]);
    line_append(row, line, "spp", row->plan->spp);
    line_append(row, line, "normal", row->plan->normal);
    line_append(row, line, "method", row->plan->method);
    line_append(row, line, "arith", row->plan->arith);
    (void)row_send(row, line);

    (void)strcpy(line, "set");
    line_append(row, line, "load", loads[load].name);
    line_append_cells(row, line, loads[load].pairs, loads[load].count);
    line_append_cells(row, line, PAIRS(friction));
    (void)row_send(row, line);

    (void)strcpy(line, "set");
    line_append_cells(row, line, PAIRS(initial));
    line_append(row, line, "substeps", "64");
    line_append(row, line, "tick", "200");
    (void)row_send(row, line);
}

/* Copies a field of the answer into the row's cell; an answer without it is no answer of this protocol. */
static void row_keep(struct row *row, const char *key, enum golden_column column)
{
    if (!row->has_failed && !fields_text(row->session->answer, key, row->result->cells[column], GOLDEN_CELL_SIZE)) {
        row_fail(row, "the answer lacks the field ", key);
    }
}

/* Measures over so many periods. True if it could; then *end_s is the physical time at its end. */
static bool row_measure(struct row *row, long periods, double *end_s)
{
    char line[SESSION_COMMAND_MAX + 2];

    (void)snprintf(line, sizeof line, "measure %ld", periods);
    if (row->has_faulted || !row_send(row, line)) {
        return false;
    }
    *end_s = fields_number(row->session->answer, "t");
    return true;
}

static void row_to_attractor(struct row *row)
{
    const struct csv *cases = &row->plan->cases;
    const double periods = csv_number(cases, row->index, csv_column(cases, "ntrans")) - PERIODS_FIRST - PERIODS_SECOND;
    char line[SESSION_COMMAND_MAX + 2];

    long left = periods > 0.0 ? (long)periods * row->plan->steps_per_period : 0;
    while (left > 0 && !row->has_faulted) {
        const long count = left < STEPS_A_COMMAND ? left : STEPS_A_COMMAND;
        (void)snprintf(line, sizeof line, "step %ld", count);
        if (!row_send(row, line)) {
            return;
        }
        left -= count;
    }
}

static void cells_forget(struct golden_result *result, int first, int last)
{
    for (int column = first; column <= last; column++) {
        (void)strcpy(result->cells[column], "nan");
    }
}

static void row_measure_all(struct row *row)
{
    const struct csv *cases = &row->plan->cases;
    double end_s[3] = {(double)INFINITY, (double)INFINITY, (double)INFINITY};

    if (row_measure(row, PERIODS_FIRST, &end_s[0])) {
        row_keep(row, "x", GOLDEN_X_20);
        row_keep(row, "xd", GOLDEN_V_20);
        row_keep(row, "xmax", GOLDEN_XMAX_20);
        row_keep(row, "xmin", GOLDEN_XMIN_20);
        row_keep(row, "vmax", GOLDEN_VMAX_20);
        row_keep(row, "vmin", GOLDEN_VMIN_20);
        row_keep(row, "stick", GOLDEN_STICK_20);
    }
    if (row_measure(row, PERIODS_SECOND, &end_s[1])) {
        row_keep(row, "x", GOLDEN_X_100);
        row_keep(row, "xd", GOLDEN_V_100);
    }
    if (row->plan->is_asymptotic) {
        row_to_attractor(row);
        if (row_measure(row, (long)csv_number(cases, row->index, csv_column(cases, "nwin")), &end_s[2])) {
            row_keep(row, "xpp", GOLDEN_XPP);
            row_keep(row, "stick", GOLDEN_STICK);
            row_keep(row, "f_up", GOLDEN_F_UP);
        }
    }
    if (row_send(row, "verdict")) {
        row_keep(row, "class", GOLDEN_CLASS);
        row_keep(row, "period", GOLDEN_PERIOD);
        row_keep(row, "propensity", GOLDEN_VERDICT);
        row_keep(row, "predicted", GOLDEN_PREDICTED);
        row_keep(row, "t_v10", GOLDEN_T_V10);
        /* Once it runs away the numbers mean nothing, also where the plant has not left its domain yet. */
        const double t_v10 = fields_number(row->session->answer, "t_v10");
        if (strcmp(row->result->cells[GOLDEN_CLASS], "diverging") == 0) {
            cells_forget(row->result, GOLDEN_X_20, end_s[0] >= t_v10 ? GOLDEN_STICK_20 : GOLDEN_X_20 - 1);
            cells_forget(row->result, GOLDEN_X_100, end_s[1] >= t_v10 ? GOLDEN_V_100 : GOLDEN_X_100 - 1);
            cells_forget(row->result, GOLDEN_XPP, end_s[2] >= t_v10 ? GOLDEN_F_UP : GOLDEN_XPP - 1);
        }
    }
    if (row_send(row, "status")) {
        row_keep(row, "step", GOLDEN_STEPS);
        row_keep(row, "overruns", GOLDEN_OVERRUNS);
        row_keep(row, "caps", GOLDEN_CAPS);
        row_keep(row, "saturations", GOLDEN_SATURATIONS);
    }
}

enum session_result golden_row_run(struct session *session, const struct golden_plan *plan, size_t index,
                                   struct golden_result *result)
{
    struct row row = {.session = session, .plan = plan, .result = result, .index = index};

    memset(result, 0, sizeof *result);
    result->row = index;
    result->is_done = true;
    cells_forget(result, 0, GOLDEN_COLUMNS - 1);
    row_set(&row);
    if (!row.has_failed) {
        row_measure_all(&row);
    }
    if (row.has_failed) {
        cells_forget(result, 0, GOLDEN_COLUMNS - 1);
        (void)strcpy(result->cells[GOLDEN_CLASS], row.last == SESSION_LOST ? "lost" : "refused");
    }
    return row.last == SESSION_LOST ? SESSION_LOST : SESSION_OK;
}
