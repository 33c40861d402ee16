/* Studies: requests that begin one. What comes of it is told by link_results.c. */
#include "protocol/link_parts.h"

enum { SPAN_MAX = 0xffff };

/* Fields, counted from 0: of an axis or span after its first, */
enum { AXIS_PARAMETER, AXIS_LOG, AXIS_FROM, AXIS_TO, AXIS_POINTS, AXIS_FIELDS };
enum { SPAN_TRANSIENT, SPAN_WINDOW, SPAN_FLAGS };

/* and of the requests. */
enum { SCAN_FIRST_AXIS = 0, SCAN_SECOND_AXIS = AXIS_FIELDS, SCAN_SPAN = 2 * AXIS_FIELDS };
enum { MARGIN_PARAMETER, MARGIN_FACTOR, MARGIN_SPAN };
enum {
    OCCURRENCE_TRIALS,
    OCCURRENCE_SEED,
    OCCURRENCE_SCATTER,
    OCCURRENCE_SPREAD,
    OCCURRENCE_SPAN = OCCURRENCE_SPREAD + OCCURRENCE_AMOUNTS
};

static bool refuse_at(struct link *link, enum error error, uint8_t field, float high)
{
    (void)link_refuse(link, &(struct link_refusal){.error = error, .has_index = true, .index = field, .high = high});
    return false;
}

static bool refuse_range(struct link *link, uint8_t field, float low, float high)
{
    (void)link_refuse_field(link, field, low, high);
    return false;
}

/* A number in low .. high, which NaN is not; false if it was refused. */
static bool read_number(struct link *link, uint8_t field, float low, float high, float *value)
{
    *value = bytes_get_f32(&link->arguments);
    return (*value >= low && *value <= high) || refuse_range(link, field, low, high);
}

/* How long to look, the last fields of a request; false if it was refused. */
static bool read_span(struct link *link, uint8_t field, struct trial_span *span)
{
    uint8_t flags;

    span->transient = bytes_get_u16(&link->arguments);
    span->window = bytes_get_u16(&link->arguments);
    flags = bytes_get_u8(&link->arguments);
    span->is_whole = flags == LINK_IS_WHOLE;
    if (span->window < TRIAL_WINDOW_MIN) {
        return refuse_range(link, field + SPAN_WINDOW, (float)TRIAL_WINDOW_MIN, (float)SPAN_MAX);
    }
    return flags <= LINK_IS_WHOLE || refuse_range(link, field + SPAN_FLAGS, 0.0f, (float)LINK_IS_WHOLE);
}

/* One study at a time: true if this one may begin. */
static bool may_begin(struct link *link)
{
    if (!turn_take_study(link->turn, TURN_LINK)) {
        (void)link_refuse_plain(link, ERROR_BUSY);
        return false;
    }
    link->study = link->request.sequence;
    return true;
}

static enum link_progress answer(struct link *link)
{
    bytes_put_u32(&link->reply, link->work->study.of);
    return link_answer(link);
}

/* --- SCAN --------------------------------------------------------------------------------------------------------- */

/* False if it was refused; without a parameter info is NULL. */
static bool read_axis(struct link *link, uint8_t field, struct scan_axis *axis)
{
    const uint8_t index = bytes_get_u8(&link->arguments);
    const uint8_t is_log = bytes_get_u8(&link->arguments);

    axis->from = bytes_get_f32(&link->arguments);
    axis->to = bytes_get_f32(&link->arguments);
    axis->points = bytes_get_u16(&link->arguments);
    axis->is_log = is_log != 0u;
    axis->info = index < params_count ? &params_table[index] : NULL;
    if (index == LINK_NO_INDEX && field != SCAN_FIRST_AXIS) {
        return true;
    }
    if (axis->info == NULL) {
        return refuse_at(link, ERROR_UNKNOWN_NAME, field + AXIS_PARAMETER, (float)(params_count - 1u));
    }
    if (is_log > 1u) {
        return refuse_range(link, field + AXIS_LOG, 0.0f, 1.0f);
    }
    if (!params_accepts(axis->info, axis->from)) {
        return refuse_range(link, field + AXIS_FROM, axis->info->low, axis->info->high);
    }
    if (!params_accepts(axis->info, axis->to)) {
        return refuse_range(link, field + AXIS_TO, axis->info->low, axis->info->high);
    }
    if (axis->points == 0u || axis->points > SCAN_POINTS_MAX) {
        return refuse_range(link, field + AXIS_POINTS, 1.0f, (float)SCAN_POINTS_MAX);
    }
    return scan_axis_check(axis) == ERROR_OK || refuse_at(link, ERROR_USAGE, field + AXIS_LOG, 0.0f);
}

enum link_progress link_scan(struct link *link)
{
    struct scan scan = {.base = *executive_params(link->executive)};
    struct trial_span span = {0};

    if (!read_axis(link, SCAN_FIRST_AXIS, &scan.axes[0]) || !read_axis(link, SCAN_SECOND_AXIS, &scan.axes[1])) {
        return LINK_ANSWERED;
    }
    if (scan.axes[0].info == scan.axes[1].info) {
        (void)refuse_at(link, ERROR_USAGE, SCAN_SECOND_AXIS + AXIS_PARAMETER, 0.0f);
        return LINK_ANSWERED;
    }
    scan.axis_count = scan.axes[1].info != NULL ? 2u : 1u;
    if (!read_span(link, SCAN_SPAN, &span) || !may_begin(link)) {
        return LINK_ANSWERED;
    }
    study_begin_scan(&link->work->study, &scan, &span);
    return answer(link);
}

/* --- MARGIN ------------------------------------------------------------------------------------------------------- */

/* The parameter that was asked for; NULL for all. False if it was refused. */
static bool read_parameter(struct link *link, const struct params_info **info)
{
    const uint8_t index = bytes_get_u8(&link->arguments);

    *info = index < params_count ? &params_table[index] : NULL;
    if (*info == NULL && index != LINK_NO_INDEX) {
        return refuse_at(link, ERROR_UNKNOWN_NAME, MARGIN_PARAMETER, (float)(params_count - 1u));
    }
    if (*info != NULL && !margin_covers(executive_params(link->executive), *info)) {
        return refuse_at(link, ERROR_NOT_SERVED, MARGIN_PARAMETER, 0.0f);
    }
    return true;
}

enum link_progress link_margin(struct link *link)
{
    struct trial_span span = {.is_brief = true};
    const struct params_info *only;
    float factor;

    if (!read_parameter(link, &only) ||
        !read_number(link, MARGIN_FACTOR, MARGIN_FACTOR_LOW, MARGIN_FACTOR_HIGH, &factor) ||
        !read_span(link, MARGIN_SPAN, &span) || !may_begin(link)) {
        return LINK_ANSWERED;
    }
    study_begin_margin(&link->work->study, executive_params(link->executive), only, factor, &span);
    return answer(link);
}

/* --- OCCURRENCE --------------------------------------------------------------------------------------------------- */

enum link_progress link_occurrence(struct link *link)
{
    struct occurrence occurrence = {.base = *executive_params(link->executive)};
    struct trial_span span = {.is_brief = true};
    const uint32_t trials = bytes_get_u32(&link->arguments);
    uint8_t is_uniform;

    occurrence.seed = bytes_get_u32(&link->arguments);
    is_uniform = bytes_get_u8(&link->arguments);
    occurrence.is_uniform = is_uniform != 0u;
    if (trials == 0u || trials > OCCURRENCE_TRIALS_MAX) {
        return link_refuse_field(link, OCCURRENCE_TRIALS, 1.0f, (float)OCCURRENCE_TRIALS_MAX);
    }
    if (occurrence.seed > OCCURRENCE_SEED_MAX) {
        return link_refuse_field(link, OCCURRENCE_SEED, 0.0f, (float)OCCURRENCE_SEED_MAX);
    }
    if (is_uniform > 1u) {
        return link_refuse_field(link, OCCURRENCE_SCATTER, 0.0f, 1.0f);
    }
    for (uint8_t i = 0u; i < OCCURRENCE_AMOUNTS; i++) {
        if (!read_number(link, OCCURRENCE_SPREAD + i, 0.0f, OCCURRENCE_SPREAD_MAX, &occurrence.spread[i])) {
            return LINK_ANSWERED;
        }
    }
    if (!read_span(link, OCCURRENCE_SPAN, &span) || !may_begin(link)) {
        return LINK_ANSWERED;
    }
    study_begin_occurrence(&link->work->study, &occurrence, trials, &span);
    return answer(link);
}
