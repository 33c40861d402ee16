/* Figs. 3 and 4: the friction law as the device follows it, force and coefficient against slip speed. */
#include "squeal/paper/lab.h"

#include "squeal/plot/figure.h"

#include <math.h>

enum { SETTLE_PERIODS = 60, SHOWN_PERIODS = 40, TEXT_SIZE = 256 };
enum { COLUMN_F, COLUMN_SLIP, COLUMN_P, COLUMN_MODE };

/* Where the pad hardly touches, force by force says nothing. */
#define CONTACT_SHARE 1e-2

/* Of the largest friction that the contact could bear: a few roundings of single precision, or of q27. */
#define LIMIT_FORCE 1e-5
#define GOOD 1e-2

static const struct {
    const char *preset, *title;
} sets[] = {{"fig5-n5", "N = 5 N, α = -0.002 s/m"},
            {"fig6-a0.1", "N = 1 N, α = -0.1 s/m"},
            {"fig7-ke10000", "ke = 10000 N/m, α = -0.15 s/m"}};

enum { SETS = sizeof sets / sizeof sets[0] };

struct law {
    double mu_s, alpha;
};

static double law_ratio(const struct law *law, double slip)
{
    return (slip < 0.0 ? -1.0 : 1.0) * (law->mu_s + law->alpha * fabs(slip));
}

static double most(const struct lab_track *track, size_t column)
{
    double value = 0.0;

    for (size_t i = 0; i < track->count; i++) {
        value = fmax(value, fabs(track->value[column][i]));
    }
    return value;
}

/* Farthest that the force is from the law while it slips, and beyond the static friction while it sticks. */
/* Returns how far. */
static double compare(struct lab *lab, const char *title, const struct lab_track *track, const struct law *law)
{
    const double bearable = law->mu_s * most(track, COLUMN_P);
    double slipping = 0.0, sticking = 0.0;
    size_t stuck = 0;

    for (size_t i = 0; i < track->count; i++) {
        const double force = track->value[COLUMN_F][i], slip = track->value[COLUMN_SLIP][i];
        if (track->value[COLUMN_MODE][i] == 0.0) {
            sticking = fmax(sticking, (fabs(force) - law->mu_s * track->value[COLUMN_P][i]) / bearable);
            stuck++;
        } else {
            slipping = fmax(slipping, fabs(force - law_ratio(law, slip) * track->value[COLUMN_P][i]) / bearable);
        }
    }
    lab_compare(lab, title, "slipping, greatest distance from the law", slipping, "of greatest force", 0.0,
                LIMIT_FORCE);
    if (stuck > 0) {
        lab_compare(lab, title, "sticking, greatest force beyond static friction", sticking, "of greatest force", 0.0,
                    LIMIT_FORCE);
    }
    lab_number(lab, title, "greatest slip speed", most(track, COLUMN_SLIP), "m/s");
    return fmax(slipping, sticking);
}

static void write_ratio(FILE *script, const char *block, const struct lab_track *track)
{
    const double least_n = CONTACT_SHARE * most(track, COLUMN_P);

    (void)fprintf(script, "$%s << END\n", block);
    for (size_t i = 0; i < track->count; i++) {
        const double contact_n = track->value[COLUMN_P][i];
        if (contact_n > least_n) {
            (void)fprintf(script, "%.6g %.6g\n", track->value[COLUMN_SLIP][i], track->value[COLUMN_F][i] / contact_n);
        }
    }
    (void)fputs("END\n", script);
}

static void draw_ratio(struct lab *lab, const struct lab_track tracks[SETS], const struct law laws[SETS])
{
    FILE *script = lab_figure_open(lab);

    for (int i = 0; i < SETS; i++) {
        char block[TEXT_SIZE];
        (void)snprintf(block, sizeof block, "set%d", i);
        write_ratio(script, block, &tracks[i]);
        (void)fprintf(script, "law%d(v) = v == 0 ? NaN : sgn(v)*(%.9g + %.9g*abs(v))\ntitle%d = \"%s\"\n", i,
                      laws[i].mu_s, laws[i].alpha, i, sets[i].title);
    }
    lab_figure_close(
        lab, script, "fig3",
        "Fig. 3: friction coefficient F/P against slip speed. Dots: samples of the device; lines: the law as printed, "
        "sgn(vr) (mu_s + alpha |vr|). On the vertical part the pad sticks. Beyond mu_s/|alpha|, 2 m/s for the "
        "steepest, "
        "the printed law changes its sign and feeds the pad.",
        "set title 'Fig. 3: friction law' offset 0,1.3\nset xlabel 'slip speed vr = v0 - dx/dt  [m/s]'\n"
        "set ylabel 'friction coefficient F/P'\nset samples 1000\nset xzeroaxis lt 1 lc rgb '#606060'\n"
        "set key at graph 0.3,0.02 left bottom Left reverse vertical maxrows 4\n"
        "set offsets graph 0.02, graph 0.02, graph 0.05, graph 0.05\n"
        "plot $set0 with points pt 7 ps 0.7 lc rgb '" FIGURE_COLOUR_MOTION "' title title0, "
        "$set1 with points pt 7 ps 0.7 lc rgb '" FIGURE_COLOUR_DISC "' title title1, "
        "$set2 with points pt 7 ps 0.7 lc rgb '#2e7d32' title title2, "
        "law0(x) with lines lw 1 lc rgb '#303030' title 'law as printed', "
        "law1(x) with lines lw 1 lc rgb '#303030' notitle, law2(x) with lines lw 1 lc rgb '#303030' notitle");
}

/* The law by the contact force that the device tells, where the pad slips. */
static void write_law(FILE *script, const struct lab_track *track, const struct law *law)
{
    (void)fputs("$law << END\n", script);
    for (size_t i = 0; i < track->count; i++) {
        const double slip = track->value[COLUMN_SLIP][i];
        if (track->value[COLUMN_MODE][i] != 0.0) {
            (void)fprintf(script, "%.6g %.6g\n", slip, law_ratio(law, slip) * track->value[COLUMN_P][i]);
        }
    }
    (void)fputs("END\n", script);
}

static void draw_force(struct lab *lab, const struct lab_track *track, const struct law *law)
{
    FILE *script = lab_figure_open(lab);

    lab_figure_block(script, "force", track, COLUMN_SLIP, COLUMN_F);
    write_law(script, track, law);
    lab_figure_close(
        lab, script, "fig4",
        "Fig. 4: friction force against slip speed on the stick-slip orbit of Fig. 5, N = 5 N. The contact force P "
        "swings "
        "between 0 and twice N, so the force is a loop and not a line; at vr = 0 it is whatever keeps the pad on the "
        "disc.",
        "set title 'Fig. 4: friction force, N = 5 N' offset 0,1.3\nset xlabel 'slip speed vr = v0 - dx/dt  [m/s]'\n"
        "set ylabel 'friction force on the pad F  [N]'\nset xzeroaxis lt 1 lc rgb '#606060'\n"
        "set offsets graph 0.05, graph 0.05, graph 0.08, graph 0.08\n"
        "plot $force with lines lw 2 lc rgb '" FIGURE_COLOUR_MOTION "' title 'device', "
        "$law with points pt 6 ps 1.2 lc rgb '" FIGURE_COLOUR_DISC "' title 'law, mu(vr) P'");
}

void experiment_friction(struct lab *lab)
{
    struct lab_track tracks[SETS];
    struct law laws[SETS];
    double worst = 0.0;
    bool is_reversed = false;

    for (int i = 0; i < SETS; i++) {
        lab_preset(lab, sets[i].preset);
        laws[i] = (struct law){lab_get(lab, "mu_s"), lab_get(lab, "alpha")};
        (void)lab_settle(lab, SETTLE_PERIODS);
        tracks[i] = lab_record(lab, "F,vr,P,mode", SHOWN_PERIODS, 1);
    }
    draw_ratio(lab, tracks, laws);
    for (int i = 0; i < SETS; i++) {
        worst = fmax(worst, compare(lab, sets[i].title, &tracks[i], &laws[i]));
        is_reversed = is_reversed || law_ratio(&laws[i], most(&tracks[i], COLUMN_SLIP)) < 0.0;
    }
    lab_csv_tracks(lab, "fig3", tracks, SETS);
    lab_claim(lab, "friction-law",
              worst > GOOD  ? PAPER_REFUTED
              : is_reversed ? PAPER_IN_PART
                            : PAPER_HOLDS,
              "fig3", "the device follows the law to %.1g of the greatest force%s", worst,
              is_reversed
                  ? "; at ke = 10000 N/m the pad slips faster than mu_s/|alpha|, where the printed law pushes it on "
                    "instead of opposing it"
                  : "");
    draw_force(lab, &tracks[0], &laws[0]);
    lab_csv_tracks(lab, "fig4", tracks, 1);
}
