/* One stiffness at a time from the quiet Table 1: where does squeal begin? */
#include "squeal/paper/lab_live.h"
#include "squeal/paper/table.h"

#include "squeal/plot/figure.h"

#include <math.h>

enum { SETTLE_PERIODS = 600, WINDOW_PERIODS = 40, WHICH = 3, TEXT_SIZE = 96 };

#define LOW 0.2 /* ke lower than that would be more than the model holds */
#define HIGH 10.0

static const char *const symbols[WHICH] = {"ke", "kt", "k"};

static void sweep(struct lab *lab, int which, struct table *table)
{
    const int points = lab_options(lab)->is_small ? 9 : 61;

    for (int i = 0; i < points; i++) {
        const double stiffness = LOW * pow(HIGH / LOW, (double)i / (points - 1));
        lab_table1(lab, "%s %.9g", symbols[which], stiffness);
        const struct device_point point = lab_trial(lab, SETTLE_PERIODS, WINDOW_PERIODS);
        table_add(lab, table, (const double[]){stiffness, which, lab_point_xpp_m(&point), point.is_loud ? 1.0 : 0.0});
    }
    table_add(lab, table, (const double[]){(double)NAN, which, (double)NAN, (double)NAN});
}

static const char commands[] =
    "set title 'One stiffness at a time, the others 1 N/m, Table 1' offset 0,1.3\nset logscale xy\nset format '%g'\n"
    "set xlabel 'the stiffness  [N/m]'\nset ylabel 'x, peak to peak  [m]'\nset xrange [0.2:10]\n"
    "colours = '" FIGURE_COLOUR_MOTION " #b02020 " FIGURE_COLOUR_DISC "'\nnames = 'ke kt k'\n"
    "do for [i=1:words(borders)] { set arrow i from first real(word(borders, i)), graph 0 to first real(word(borders, "
    "i)), "
    "graph 1 nohead dt 3 lw 1.5 lc rgb word(colours, int(word(owners, i))) }\n"
    "plot for [i=1:3] $size using 1:($4 < 0.5 ? $3 : NaN) every :::(i-1)::(i-1) with points pt (i == 2 ? 4 : 6) ps (i "
    "== 3 ? 0.7 "
    ": 1.2) lc rgb word(colours, i) title word(names, i).' quiet', "
    "for [i=1:3] $size using 1:($4 > 0.5 ? $3 : NaN) every :::(i-1)::(i-1) with points pt (i == 2 ? 5 : 7) ps (i == 3 "
    "? 0.7 : "
    "1.2) lc rgb word(colours, i) title word(names, i).' squeals'\n";

/* Borders of each, as the device's own search finds them. Returns how many stiffnesses have one. */
static unsigned borders(struct lab *lab, FILE *script, char text[TEXT_SIZE * WHICH])
{
    double found[2 * WHICH];
    int owner[2 * WHICH];
    unsigned count = 0, owners = 0;
    size_t length = 0;

    for (int i = 0; i < WHICH; i++) {
        lab_preset(lab, "table1");
        const struct device_border border = lab_border(lab, symbols[i]);
        const double sides[2] = {(double)border.below.border, (double)border.above.border};
        owners += isnan(sides[0]) && isnan(sides[1]) ? 0 : 1;
        for (int side = 0; side < 2; side++) {
            lab_number(lab, symbols[i], side == 0 ? "squeal begins below" : "squeal begins above", sides[side], "N/m");
            if (!isnan(sides[side])) {
                length += (size_t)snprintf(text + length, TEXT_SIZE, "%s%s %s %.3g N/m", length > 0 ? ", " : "",
                                           symbols[i], side == 0 ? "below" : "above", sides[side]);
                found[count] = sides[side];
                owner[count++] = i + 1;
            }
        }
    }
    (void)fputs("borders = '", script);
    for (unsigned i = 0; i < count; i++) {
        (void)fprintf(script, "%.6g ", found[i]);
    }
    (void)fputs("'\nowners = '", script);
    for (unsigned i = 0; i < count; i++) {
        (void)fprintf(script, "%d ", owner[i]);
    }
    (void)fputs("'\n", script);
    return owners;
}

void experiment_onset(struct lab *lab)
{
    struct table table = table_begin("stiffness[N/m],which,xpp[m],loud");
    char text[TEXT_SIZE * WHICH] = "";

    for (int i = 0; i < WHICH; i++) {
        sweep(lab, i, &table);
    }
    FILE *script = lab_figure_open(lab);
    table_block(script, &table, "size");
    const unsigned owners = borders(lab, script, text);
    lab_figure_close(
        lab, script, "onset-size",
        "From the quiet Table 1 one stiffness at a time. Filled: the device calls it squeal; dotted: the border that "
        "it finds. kt and k are one curve, since only their sum acts.",
        commands);
    table_save(lab, &table, "onset-size",
               "range of x over one stiffness, the others being 1 N/m; which: 0 ke, 1 kt, 2 k");
    lab_claim(lab, "each-stiffness",
              owners == WHICH ? PAPER_HOLDS
              : owners > 0    ? PAPER_IN_PART
                              : PAPER_REFUTED,
              "onset-size", "from the quiet Table 1 squeal begins with %s; what matters is (kt + k)/ke alone", text);
}
