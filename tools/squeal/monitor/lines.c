/* Words in the order of the screen, two blanks between them. */
#include "squeal/monitor/lines.h"

#include <math.h>
#include <string.h>

enum { VALUE_SIZE = 64 };

/* The micro sign is the only character of a quantity beyond ASCII. */
static void print_quantity(FILE *out, double value, const char *unit)
{
    char text[VALUE_SIZE];

    picture_quantity(text, sizeof text, value, unit);
    (void)fputs("  ", out);
    for (const char *at = text; *at != '\0'; at++) {
        if ((unsigned char)*at < 128u) {
            (void)fputc(*at, out);
        } else if ((unsigned char)*at == 0xb5u) {
            (void)fputc('u', out);
        }
    }
}

bool lines_print(FILE *out, const struct picture *picture)
{
    const struct picture_severity *severity = &picture->severity;
    char t[VALUE_SIZE];

    picture_quantity(t, sizeof t, (double)picture->step * picture->trace.step_s, "s");
    for (char *at = t; *at != '\0'; at++) {
        *at = (unsigned char)*at < 128u ? *at : (unsigned char)*at == 0xb5u ? 'u' : ' ';
    }
    fprintf(out, "t %s  %s", t, picture->state == 2u ? "fault" : picture_propensity(picture->propensity));
    if (isfinite(severity->level_db)) {
        fprintf(out, "  %.1f dB", severity->level_db);
        print_quantity(out, severity->velocity_m_per_s, "m/s rms");
        print_quantity(out, severity->amplitude_m, "m");
        print_quantity(out, severity->frequency_hz, "Hz");
    }
    for (size_t i = 0u; i < PICTURE_INPUTS; i++) {
        fprintf(out, "  %s %.5g %s", picture->input[i].name, picture->input[i].set, picture->input[i].unit);
    }
    fprintf(out, "  %s  dropped %u  lost %llu  %s\n", picture->state == 1u ? "running" : "stopped",
            picture->counters.dropped, (unsigned long long)picture->trace.lost, picture->motion);
    if (picture->message[0] != '\0' && picture->is_refusal) {
        fprintf(out, "# %s\n", picture->message);
    }
    return fflush(out) == 0 && ferror(out) == 0;
}
