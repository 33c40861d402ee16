/* The printed side of the story. The device says everything; here it is only set in columns. */
#include "tell.h"

#include "fields.h"

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

void tell_act(const char *title)
{
    printf("\n%s\n", title);
    for (size_t i = strlen(title); i > 0; i--) {
        (void)putchar('-');
    }
    (void)putchar('\n');
}

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

void tell_files(const struct story *story)
{
    if (story->file_count > 0) {
        printf("\nwritten\n");
    }
    for (size_t i = 0; i < story->file_count; i++) {
        printf("  %-36s %s\n", story->files[i].path, story->files[i].what);
    }
}
