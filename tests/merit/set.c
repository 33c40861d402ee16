/* From the oracle's columns to the firmware's parameters. */
#include "set.h"

enum { SPP_64 = 2 /* the choice of params.def */ };

struct set set_of_row(const struct csv *table, size_t row)
{
    struct set set;

#define INPUT(field, name) set.name = csv_number(table, row, csv_column(table, #name));
#define OUTPUT(name)
#include "tests/oracle/columns.def"
#undef INPUT
#undef OUTPUT
    set.ntrans = csv_number(table, row, csv_column(table, "ntrans"));
    set.nwin = csv_number(table, row, csv_column(table, "nwin"));
    return set;
}

struct params set_params(const struct set *set, int arith)
{
    struct params params;

    params_default(&params);
    params.mass_kg = (float)set->m;
    params.damping_n_s_per_m = (float)set->c;
    params.stiffness_normal_n_per_m = (float)set->ke;
    params.stiffness_contact_n_per_m = (float)set->kt;
    params.stiffness_caliper_n_per_m = (float)set->k;
    params.damping_normal_n_s_per_m = (float)set->cn;
    params.friction_static_ratio = (float)set->mus;
    params.friction_slope_s_per_m = (float)set->alpha;
    params.friction_floor_ratio = (float)set->mumin;
    params.contact = (float)set->contact;
    params.load_profile = (float)set->ntype;
    params.load_n = (float)set->N0;
    params.load_end_n = (float)set->N1;
    params.load_start_s = (float)set->t1;
    if ((int)params.load_profile == LOAD_SINE) {
        params.load_frequency_hz = (float)set->t2; /* the table keeps a sine's frequency there */
    } else {
        params.load_end_s = (float)set->t2;
    }
    params.speed_m_per_s = (float)set->v0;
    params.x_initial_m = (float)set->x0;
    params.xd_initial_m_per_s = (float)set->xd0;
    params.y_initial_m = (float)set->y0;
    params.yd_initial_m_per_s = (float)set->yd0;
    params.steps_per_period = (float)SPP_64;
    params.arithmetic = (float)arith;
    params.normal_method = (float)NORMAL_EXACT;
    return params;
}
