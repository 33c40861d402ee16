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
    {"period", "repeats after", "normal periods"},
    {"amplitude_um", "amplitude", "um"},
    {"velocity_mm_s_rms", "velocity", "mm/s rms"},
    {"level_db", "level", "dB re 1 nm/s"},
    {"acceleration_g", "acceleration", "g"},
    {"frequency_hz", "frequency", "Hz"},
    {"band", "band", ""},
    {"audible", "audible", ""},
    {"level_dba_estimate", "loudness, estimate", "dB(A)"},
    {"stick", "stick share", "of the time"},
    {"growth_per_s", "growth", "1/s"},
    {"t_v10", "ten times v0 after", "s"},
    {"predicted", "predicted", ""},
    {"predicted_growth_per_s", "predicted growth", "1/s"},
    {"bistable", "bistable", ""},
    {"sigma", "time scale", "physical s per s"},
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

void tell_words(const char *text) { printf("  %s\n", text); }

void tell_verdict(const char *fields)
{
    char value[64];

    printf("\n");
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        if (fields_text(fields, rows[i].key, value, sizeof value) && strcmp(value, "nan") != 0) {
            printf("    %-20s %s%s%s\n", rows[i].label, value, rows[i].unit[0] != '\0' ? " " : "", rows[i].unit);
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
