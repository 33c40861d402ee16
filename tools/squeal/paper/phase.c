/* Figs. 5 to 9: phase portraits, and the numbers of their attractors beside those of the reference solution. */
#include "squeal/paper/lab.h"

#include "squeal/plot/figure.h"

#include <math.h>
#include <string.h>

struct panel {
    int figure;
    const char *name, *title, *preset, *assignments, *reference;
    bool is_small;
};

static const struct panel panels[] = {
#define PANEL(figure, name, title, preset, assignments, reference, is_small) \
    {figure, name, title, preset, assignments, reference, is_small},
#include "squeal/paper/panels.def"
#undef PANEL
};

/* Shares of the range, except of the frequency and the stick share. A motion without a period depends on where one
 * looks. */
#define LIMIT_XPP 2e-3
#define LIMIT_V 5e-3
#define LIMIT_F 1e-4
#define LIMIT_F_SUBHARMONIC 1e-3
#define LIMIT_APERIODIC 2e-2
#define LIMIT_STICK 5e-3
#define LIMIT_T_V10 1e-2

enum { START_PERIODS = 60, WINDOW_PERIODS = 400, SHOWN_PERIODS = 100, PARTS = 4, TEXT_SIZE = 256 };
enum { COLUMN_X, COLUMN_V, COLUMN_MODE };

/* The reference's word for what the device calls the same: it has three words for motion without a short period. */
static const char *class_expected(const char *reference)
{
    static const char *const aperiodic[] = {"quasiperiodic", "longperiod", "beating"};

    for (size_t i = 0; i < sizeof aperiodic / sizeof aperiodic[0]; i++) {
        if (strcmp(reference, aperiodic[i]) == 0) {
            return "aperiodic";
        }
    }
    return reference;
}

static void compare(struct lab *lab, const struct panel *panel, const struct lab_motion *motion)
{
    const char *class = class_expected(lab_reference_text(lab, panel->reference, "class"));
    const bool is_aperiodic = strcmp(class, "aperiodic") == 0;
    const double range = lab_reference(lab, panel->reference, "xpp");
    const double speeds = lab_reference(lab, panel->reference, "vmax") - lab_reference(lab, panel->reference, "vmin");
    const double f_up = lab_reference(lab, panel->reference, "f_up") * lab_period_s(lab);

    lab_compare_words(lab, panel->title, "motion", motion->class, class);
    if (motion->is_diverging) {
        const double t_v10_s = lab_reference(lab, panel->reference, "t_v10");
        lab_compare(lab, panel->title, "|v| > 10 m/s at", motion->t_v10_s, "s", t_v10_s, LIMIT_T_V10 * t_v10_s);
        return;
    }
    lab_compare(lab, panel->title, "x, peak to peak", motion->xpp_m, "m", range,
                (is_aperiodic ? LIMIT_APERIODIC : LIMIT_XPP) * range);
    lab_compare(lab, panel->title, "greatest velocity", motion->vmax_m_per_s, "m/s",
                lab_reference(lab, panel->reference, "vmax"), (is_aperiodic ? LIMIT_APERIODIC : LIMIT_V) * speeds);
    lab_compare(lab, panel->title, "least velocity", motion->vmin_m_per_s, "m/s",
                lab_reference(lab, panel->reference, "vmin"), (is_aperiodic ? LIMIT_APERIODIC : LIMIT_V) * speeds);
    lab_compare(lab, panel->title, "share of stick", motion->stick, "1", lab_reference(lab, panel->reference, "stick"),
                LIMIT_STICK);
    lab_compare(lab, panel->title, "f / fn", motion->frequency_ratio, "1", f_up,
                (is_aperiodic         ? LIMIT_APERIODIC
                 : motion->period > 1 ? LIMIT_F_SUBHARMONIC
                                      : LIMIT_F) *
                    f_up);
}

/* The orbit between samples as well: x by the cubic through both ends and their velocities, and its derivative; not
 * where the pad begins or ends to stick in between, since its velocity has a kink there. */
static void write_orbit(FILE *script, const struct lab_track *track)
{
    const double *x = track->value[COLUMN_X], *v = track->value[COLUMN_V];
    const double *mode = track->value[COLUMN_MODE];

    (void)fputs("$orbit << END\n", script);
    for (size_t i = 1; i < track->count; i++) {
        const double step_s = track->t_s[i] - track->t_s[i - 1], mean = (x[i] - x[i - 1]) / step_s;
        const double b = 6.0 * mean - 4.0 * v[i - 1] - 2.0 * v[i], a = 3.0 * (v[i - 1] + v[i]) - 6.0 * mean;
        const int parts = mode[i] == mode[i - 1] ? PARTS : 1;
        for (int part = 0; part < parts; part++) {
            const double s = (double)part / PARTS;
            (void)fprintf(script, "%.6g %.6g\n", x[i - 1] + step_s * s * (v[i - 1] + s * (b / 2.0 + s * a / 3.0)),
                          v[i - 1] + s * (b + s * a));
        }
    }
    (void)fprintf(script, "%.6g %.6g\nEND\n", x[track->count - 1], v[track->count - 1]);
}

static void write_strobes(struct lab *lab, FILE *script, const struct lab_track *track)
{
    (void)fputs("$strobes << END\n", script);
    for (size_t i = 0; i < track->count; i++) {
        if (lab_is_strobe(lab, track, i)) {
            (void)fprintf(script, "%.6g %.6g\n", track->value[COLUMN_X][i], track->value[COLUMN_V][i]);
        }
    }
    (void)fputs("END\n", script);
}

static const char commands[] =
    "set title headline offset 0,1.3\nset xlabel 'displacement x  [m]'\nset ylabel 'velocity dx/dt  [m/s]'\n"
    "set format '%g'\nset xtics autofreq\nset offsets graph 0.04, graph 0.04, graph 0.06, graph 0.04\n"
    "set arrow from graph 0, first v0 to graph 1, first v0 nohead lw 1.5 dt 2 lc rgb '" FIGURE_COLOUR_DISC "'\n"
    "set label 'v0' at graph 1.005, first v0 tc rgb '" FIGURE_COLOUR_DISC "'\n"
    "if (has_orbit) {\n"
    "plot $start with lines lw 1 lc rgb '" FIGURE_COLOUR_PATH "' title 'from rest', "
    "$orbit with lines lw orbit_width lc rgb orbit_colour title 'attractor', "
    "$strobes with points pt 7 ps strobe_size lc rgb '#b02020' title 'once a period Tn'\n"
    "} else {\n"
    "plot $start with lines lw 1.5 lc rgb '" FIGURE_COLOUR_MOTION "' title 'from rest'\n"
    "}\n";

/* tracks: from rest, and the end of what was measured, which is whole. */
static void draw(struct lab *lab, const struct panel *panel, const struct lab_motion *motion,
                 const struct lab_track tracks[2], const struct lab_track *whole)
{
    char caption[TEXT_SIZE], class[LAB_CLASS_MAX], size[TEXT_SIZE] = "";
    FILE *script = lab_figure_open(lab);

    (void)figure_plain(motion->class, class, sizeof class);
    if (!motion->is_diverging) {
        (void)snprintf(size, sizeof size, ", %.4g m peak to peak, sticks %.3g %% of the time", motion->xpp_m,
                       100.0 * motion->stick);
    }
    (void)fprintf(script, "headline = \"Fig. %d, %s\\n{/*0.8 %s%s}\"\nv0 = %.9g\nhas_orbit = %d\n", panel->figure,
                  panel->title, class, size, lab_get(lab, "v0"), motion->is_diverging ? 0 : 1);
    /* Many turns of a torus are drawn finer, so that the strobes are seen on them. */
    (void)fprintf(script, "orbit_width = %g\nstrobe_size = %g\norbit_colour = '%s'\n", motion->period > 0 ? 2.5 : 0.6,
                  motion->period > 0 ? 1.6 : 0.7, motion->period > 0 ? FIGURE_COLOUR_MOTION : "#7f9fc4");
    lab_figure_block(script, "start", &tracks[0], COLUMN_X, COLUMN_V);
    if (motion->period > 0) {
        write_orbit(script, &tracks[1]);
    } else {
        lab_figure_block(script, "orbit", &tracks[1], COLUMN_X, COLUMN_V);
    }
    write_strobes(lab, script, whole);
    (void)snprintf(caption, sizeof caption, "Fig. %d, %s: %s%s.", panel->figure, panel->title, motion->class, size);
    lab_figure_close(lab, script, panel->name, caption, commands);
}

static void run_panel(struct lab *lab, const struct panel *panel)
{
    const unsigned settle = (unsigned)lab_reference(lab, panel->reference, "ntrans");
    struct lab_track tracks[2], track;

    lab_preset(lab, panel->preset);
    lab_set(lab, panel->assignments);
    tracks[0] = lab_record(lab, "x,xd,mode", START_PERIODS, 1);
    (void)lab_settle(lab, settle - START_PERIODS);
    const struct lab_motion motion = lab_measure(lab, WINDOW_PERIODS, &track);
    /* An orbit that closes is shown once. */
    const unsigned shown = motion.period > 0 ? motion.period : SHOWN_PERIODS;
    const size_t samples = (size_t)shown * lab_steps_per_period(lab) + 1;
    tracks[1] = lab_part(&track, track.count > samples ? track.count - samples : 0);
    draw(lab, panel, &motion, tracks, &track);
    compare(lab, panel, &motion);
    lab_csv_tracks(lab, panel->name, tracks, 2);
}

static void run_panels(struct lab *lab, int figure)
{
    lab_note(
        lab,
        "Faint: the first %d normal periods from rest. Strong: the attractor, its period or the last %d. Red: once a "
        "normal period. Numbers are taken over %d periods after as many as the reference waited; the device has the "
        "word aperiodic for what the reference calls quasi-periodic, long-period or beating.",
        START_PERIODS, SHOWN_PERIODS, WINDOW_PERIODS);
    for (size_t i = 0; i < sizeof panels / sizeof panels[0]; i++) {
        if (panels[i].figure == figure && (panels[i].is_small || !lab_options(lab)->is_small)) {
            run_panel(lab, &panels[i]);
        }
    }
}

void experiment_fig5(struct lab *lab) { run_panels(lab, 5); }
void experiment_fig6(struct lab *lab) { run_panels(lab, 6); }
void experiment_fig7(struct lab *lab) { run_panels(lab, 7); }
void experiment_fig8(struct lab *lab) { run_panels(lab, 8); }
void experiment_fig9(struct lab *lab) { run_panels(lab, 9); }
