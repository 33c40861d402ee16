/* The device's own measurements, which know every step. */
#include "squeal/monitor/feed_parts.h"

#include "analysis/predictor.h"

#include <math.h>
#include <stdio.h>

static void tell_forecast(struct picture *picture, const struct device_verdict *verdict)
{
    if (verdict->predicted > PREDICTION_SQUEAL || !isfinite(verdict->predicted_growth_per_s)) {
        picture->forecast[0] = '\0';
        return;
    }
    (void)snprintf(picture->forecast, sizeof picture->forecast, "closed form: %s, %+.3g 1/s%s",
                   predictor_verdict_name((enum predictor_verdict)verdict->predicted),
                   (double)verdict->predicted_growth_per_s, verdict->is_bistable ? ", unless kicked" : "");
}

/* Within its error it is none. */
static double growth(const struct device_verdict *verdict)
{
    return fabsf(verdict->growth_per_s) <= verdict->growth_error_per_s ? 0.0 : (double)verdict->growth_per_s;
}

enum device_result feed_look_at_verdict(struct feed *feed)
{
    struct picture *picture = feed->picture;
    struct device_verdict verdict;
    const enum device_result result = device_verdict(feed->device, &verdict);

    if (result == DEVICE_REFUSED && device_refusal(feed->device)->error == ERROR_UNKNOWN_TYPE) {
        feed->lacks_verdict = true;
        return DEVICE_OK;
    }
    if (result != DEVICE_OK) {
        return result;
    }
    picture->propensity = verdict.propensity;
    picture_motion(picture->motion, sizeof picture->motion, verdict.motion, verdict.period);
    tell_forecast(picture, &verdict);
    /* While it knows nothing yet, the samples do. */
    picture->is_measured = isfinite(verdict.level_db);
    if (picture->is_measured) {
        picture->severity = (struct picture_severity){.level_db = (double)verdict.level_db,
                                                      .velocity_m_per_s = 1e-3 * (double)verdict.velocity_mm_s_rms,
                                                      .amplitude_m = 1e-6 * (double)verdict.amplitude_um,
                                                      .frequency_hz = (double)verdict.frequency_hz,
                                                      .growth_per_s = growth(&verdict),
                                                      .stick_share = (double)verdict.stick,
                                                      .loudness_dba = (double)verdict.level_dba_estimate};
    } else {
        picture->severity.stick_share = picture->severity.loudness_dba = (double)NAN;
    }
    return DEVICE_OK;
}
