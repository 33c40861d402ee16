/* Everything that can be set, in SI units: one struct, one default set, one range check, all expanded from params.def.
 * Values are single precision; a choice holds the index of its name. Beside them stand two tables of breakpoints. */
#ifndef MODEL_PARAMS_H
#define MODEL_PARAMS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/errors.h"

enum {
#define TABLE_VERSION(version) PARAMS_VERSION = version
#define PARAM(...)
#include "model/params.def"
#undef PARAM
};

enum { PARAMS_POINTS_MAX = 64 };

/* A profile by its breakpoints: straight lines between them, the first value before them, the last one after. Two
 * points of one time are a jump. Those beyond count are zeros. */
struct params_points {
    uint32_t count;
    struct params_point {
        float time_s; /* since reset, not before the point before; 0 to PARAMS_TIME_MAX */
        float value;  /* in the unit and range of N0, or of v0 */
    } points[PARAMS_POINTS_MAX];
};

#define PARAMS_TIME_MAX 1e6f

enum params_table_index { PARAMS_TABLE_LOAD, PARAMS_TABLE_SPEED, PARAMS_TABLES };

struct params {
#define PARAM(id, field, symbol, unit, standard, low, high, change, help) float field;
#include "model/params.def"
#undef PARAM
    struct params_points tables[PARAMS_TABLES];
};

/* Choices by name; their order is that of the names in params.def. */
enum { CONTACT_BILATERAL, CONTACT_NO_PULL, CONTACT_LIFT };
enum { LOAD_CONSTANT, LOAD_STEP, LOAD_RAMP, LOAD_SINE, LOAD_PULSES, LOAD_TABLE };
enum { SPEED_CONSTANT, SPEED_STEP, SPEED_RAMP, SPEED_SINE, SPEED_PULSES, SPEED_TABLE, SPEED_INERTIA };
enum { ARITH_F32, ARITH_Q27 };
enum { NORMAL_RK4, NORMAL_EXACT };
enum { METHOD_EVENT, METHOD_NAIVE };

enum params_change { PARAMS_LIVE, PARAMS_RESTART };

struct params_info {
    uint16_t id;
    uint16_t offset; /* of the field in struct params, bytes */
    const char *field, *symbol, *unit, *help;
    float standard, low, high; /* default and inclusive range */
    enum params_change change;
};

/* Why a set was refused: the parameter, and where it applies the range that would have been accepted. */
struct params_problem {
    enum error error;
    const struct params_info *info; /* NULL if no single parameter is to blame */
    float low, high;                /* meaningful for OUT_OF_RANGE and OUT_OF_SCALE */
};

extern const struct params_info params_table[];
extern const size_t params_count;

/* Sets every field to its default; the tables are empty. [ANY] */
void params_default(struct params *params);

/* Finds a parameter by symbol or field name of the given length; NULL if there is none. [MAIN] */
const struct params_info *params_find(const char *name, size_t length);

/* The value that info describes, and its change. Setting checks nothing. [ANY] */
float params_value(const struct params *params, const struct params_info *info);
void params_set(struct params *params, const struct params_info *info, float value);

/* Is the parameter a choice? Then its unit is the list of names. [ANY] */
bool params_is_choice(const struct params_info *info);

/* Does it hold whole numbers only: a choice, or what says so in its unit? [ANY] */
bool params_is_whole(const struct params_info *info);

/* Does a value lie in its range, and is it whole where it has to be? NaN lies in no range. [ANY] */
bool params_accepts(const struct params_info *info, float value);

/* Start and length of a choice's name; length 0 if there is no such index. [ANY] */
const char *params_choice_name(const struct params_info *info, unsigned index, size_t *length);

/* Reads a value as typed: a name for a choice, else a number. BAD_NUMBER leaves *value as it was; the range is not
 * checked here. [MAIN] */
enum error params_parse(const struct params_info *info, const char *text, size_t length, float *value);

/* A problem of the parameter with this symbol. [MAIN] */
struct params_problem params_blame(enum error error, const char *symbol, float low, float high);

/* The parameter whose unit and range a table's values have: N0 or v0. [ANY] */
const struct params_info *params_table_values(enum params_table_index index);

/* Time of a table's last point, 0 if it is empty. [ANY] */
float params_table_end_s(const struct params_points *table);

/* May a table whose last point has this time go on with that one? Else what is wrong: the value, with N0 or v0 to
 * blame; or the time, with t1 or tv1. [MAIN] */
struct params_problem params_check_point(enum params_table_index index, float end_s, const struct params_point *point);

/* Checks every field against its range, and every point; a choice must be a whole number. NaN lies in no range.
 * [MAIN] */
struct params_problem params_check(const struct params *params);

/* Do two sets differ in a parameter that needs a restart? Tables never do. Returns the first, or NULL. [MAIN] */
const struct params_info *params_restart_change(const struct params *from, const struct params *to);

#endif
