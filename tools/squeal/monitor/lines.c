/* Words in the order of the screen, two blanks between them. */
#include "squeal/monitor/lines.h"

#include <math.h>
#include <string.h>

enum { VALUE_SIZE = 64 };

/* The micro sign is the only character of a quantity beyond ASCII. */
static void print_plain(FILE *out, const char *text)
{
    for (; *text != '\0'; text++) {
        if ((unsigned char)*text < 128u) {
            (void)fputc(*text, out);
        } else if ((unsigned char)*text == 0xb5u) {
            (void)fputc('u', out);
        }
    }
}

static void print_quantity(FILE *out, const char *before, double value, const char *unit)
{
    char text[VALUE_SIZE];

    picture_quantity(text, sizeof text, value, unit);
    (void)fputs(before, out);
    print_plain(out, text);
}

static void print_severity(FILE *out, const struct picture_severity *severity)
{
    char text[VALUE_SIZE];

    if (isfinite(severity->level_db)) {
        fprintf(out, "  %.1f dB", severity->level_db);
        print_quantity(out, "  ", severity->velocity_m_per_s, "m/s rms");
        print_quantity(out, "  ", severity->amplitude_m, "m");
        picture_frequency(text, sizeof text, severity->frequency_hz);
        (void)fputs("  ", out);
        print_plain(out, text);
    }
}

bool lines_print(FILE *out, const struct picture *picture)
{
    const char *state = picture->state == 1u ? "running" : picture->state == 2u ? "fault" : "stopped";

    print_quantity(out, "t ", (double)picture->step * picture->trace.step_s, "s");
    fprintf(out, "  %s  %s", state, picture_propensity(picture->propensity));
    print_severity(out, &picture->severity);
    for (size_t i = 0u; i < PICTURE_INPUTS; i++) {
        const struct picture_input *input = &picture->input[i];

        fprintf(out, "  %s %.5g %s", input->name, input->set, input->unit);
    }
    fprintf(out, "  dropped %u  lost %llu%s%s\n", picture->counters.dropped, (unsigned long long)picture->trace.lost,
            picture->motion[0] != '\0' ? "  " : "", picture->motion);
    if (picture->message[0] != '\0' && picture->is_refusal) {
        fprintf(out, "# %s\n", picture->message);
    }
    return fflush(out) == 0 && ferror(out) == 0;
}
