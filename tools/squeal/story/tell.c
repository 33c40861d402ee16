/* The printed side of the story. The device says everything; here it is only set in columns. */
#include "squeal/story/tell.h"

#include "squeal/support/fields.h"

#include <string.h>

/* Field of the verdict, what a person calls it, its unit. A field that the device does not send is left out, so is nan.
 */
static const struct {
    const char *key, *label, *unit;
} rows[] = {
    {"propensity", "verdict", ""},
    {"class", "motion", ""},
    {"amplitude_um", "amplitude", "um"},
    {"velocity_mm_s_rms", "velocity", "mm/s rms"},
    {"level_db", "level", "dB re 1 nm/s"},
    {"acceleration_g", "acceleration", "g"},
    {"frequency_hz", "frequency", "Hz"},
    {"band", "band", ""},
    {"audible", "audible", ""},
    {"level_dba_estimate", "loudness, estimate", "dB(A)"},
    {"stick", "stick share", "of the time"},
    {"t_v10", "ten times v0 after", "s"},
    {"predicted", "predicted", ""},
    {"predicted_growth_per_s", "predicted growth", "1/s"},
    {"bistable", "bistable", ""},
    {"sigma", "time scale", "physical s per s of ticks"},
};

void tell_title(const struct story *story)
{
    char version[64], build[64], core[64], emulated[16];

    (void)fields_text(story->id, "version", version, sizeof version);
    (void)fields_text(story->id, "build", build, sizeof build);
    (void)fields_text(story->id, "core", core, sizeof core);
    (void)fields_text(story->id, "emulated", emulated, sizeof emulated);
    printf("squeal %s (%s) on %s%s%s%s%s\n", version, build, story->board, core[0] != '\0' ? ", " : "", core,
           story->emulator[0] != '\0' ? ", under " : (strcmp(emulated, "yes") == 0 ? ", emulated" : ""),
           story->emulator);
}

static void heading_print(const char *title)
{
    printf("\n%s\n", title);
    for (size_t i = strlen(title); i > 0; i--) {
        (void)putchar('-');
    }
    (void)putchar('\n');
}

void tell_act(const char *title) { heading_print(title); }

void tell_words(const char *text) { printf("%s\n", text); }

void tell_notice(const char *text)
{
    char propensity[16];
    const double t_s = fields_number(text, "t");

    if (fields_text(text, "propensity", propensity, sizeof propensity) && t_s >= 0.0) {
        printf("  %10.4g s  %s\n", t_s, propensity);
    } else {
        printf("  %s\n", text);
    }
}

/* A length in a unit that suits it; the device sends micrometres for brakes and models alike. */
static void length_print(double length_um)
{
    if (length_um < 1e3) {
        printf("%.4g um\n", length_um);
    } else if (length_um < 1e6) {
        printf("%.4g mm\n", length_um / 1e3);
    } else {
        printf("%.4g m\n", length_um / 1e6);
    }
}

void tell_verdict(const char *fields)
{
    char text[64];
    double value = 0.0;

    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        if (!fields_text(fields, rows[i].key, text, sizeof text) || strcmp(text, "nan") == 0) {
            continue;
        }
        printf("    %-20s ", rows[i].label);
        if (!fields_parse(text, &value)) {
            printf("%s\n", text);
        } else if (strcmp(rows[i].unit, "um") == 0) {
            length_print(value);
        } else {
            printf("%.4g%s%s\n", value, rows[i].unit[0] != '\0' ? " " : "", rows[i].unit);
        }
    }
}

void tell_map_start(const struct story *story)
{
    const struct map *map = &story->map;
    const struct map_axis *force = &map_plan.axes[MAP_FORCE], *slope = &map_plan.axes[MAP_SLOPE];

    heading_print("map: where does this brake squeal?");
    printf("preset %s, N = %g to %g N, alpha = %g to %g s/m: %zu x %zu trials on the device,\n", map_plan.preset,
           force->from, force->to, slope->from, slope->to, map->side, map->side);
    printf("each from its start, up to %d normal periods and what it takes to measure the end\n",
           map_plan.transient_periods);
    (void)fflush(stdout);
}

static void points_print(const char *label, size_t points, const char *what)
{
    if (points > 0) {
        printf("    %-20s %zu point%s%s\n", label, points, points == 1 ? "" : "s", what);
    }
}

static void rule_print(const char *label, const struct map_rule *rule)
{
    printf("    %-20s right at %zu point%s, wrong at %zu\n", label, rule->agree, rule->agree == 1 ? "" : "s",
           rule->differ);
}

/* What should be nothing, and is told where it is not. */
static void troubles_print(const char *answer)
{
    static const struct {
        const char *key, *label;
    } troubles[] = {{"refused", "refused"},
                    {"diverged", "diverged"},
                    {"caps", "events beyond a step's three"},
                    {"saturations", "saturations"}};

    for (size_t i = 0; i < sizeof troubles / sizeof troubles[0]; i++) {
        const double count = fields_number(answer, troubles[i].key);
        if (count > 0.0) {
            printf("    %-20s %.0f\n", troubles[i].label, count);
        }
    }
}

void tell_map(const struct story *story)
{
    const struct map *map = &story->map;
    const struct map_counts counts = map_count(map);
    char what[96] = ", all of them still growing";

    if (map->came == 0) {
        return;
    }
    if (counts.most_um >= counts.least_um) {
        (void)snprintf(what, sizeof what, ", amplitude %.3g to %.3g um", counts.least_um, counts.most_um);
    }
    points_print("squeal", counts.by_propensity[PROPENSITY_SQUEAL], what);
    points_print("watch", counts.by_propensity[PROPENSITY_WATCH], ", too little growth to tell yet");
    points_print("quiet", counts.by_propensity[PROPENSITY_QUIET], "");
    points_print("unknown", counts.by_propensity[PROPENSITY_UNKNOWN], "");
    points_print("still growing", counts.growing, ", of squeal and watch");
    rule_print("|alpha| N = c", &counts.line);
    rule_print("prediction", &counts.predictor);
    troubles_print(map->answer);
    printf("    %-20s %.3g s, %.3g s a point\n", "time", map->wall_s, map->wall_s / (double)map->came);
}

void tell_files(const struct story *story)
{
    if (story->file_count > 0) {
        printf("\nwritten\n");
    }
    for (size_t i = 0; i < story->file_count; i++) {
        printf("  %-36s %s\n", story->files[i].path, story->files[i].what);
    }
}
