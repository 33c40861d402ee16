/* From set to set. */
#include "sim/study.h"

#include "base/fmath.h"

/* --- Trials ------------------------------------------------------------------------------------------------------- */

static void book_trial(struct study_tally *tally, const struct trial *trial)
{
    const struct sim *sim = &trial->sim;

    tally->by_propensity[sim->detector.verdict.propensity]++;
    tally->loud += trial_is_loud(trial) ? 1u : 0u;
    tally->undecided += trial_is_undecided(trial) ? 1u : 0u;
    tally->diverged += trial->end == TRIAL_DIVERGED ? 1u : 0u;
    tally->caps += sim->counters.caps;
    tally->saturations += sim->counters.saturations;
    tally->gap_held += sim->counters.gap_held;
    tally->steps += sim->step;
}

/* Goes on with the trial of a set, one slice; true when it is over, or could not be begun. */
static bool try(struct study *study, const struct params *params)
{
    if (!study->is_trying) {
        study->tally.trials++;
        study->problem = trial_begin(&study->trial, params, &study->span);
        if (study->problem.error != ERROR_OK) {
            study->tally.refused++;
            return true;
        }
        study->is_trying = true;
    }
    if (!trial_go_on(&study->trial, STUDY_SLICE_STEPS)) {
        return false;
    }
    study->is_trying = false;
    book_trial(&study->tally, &study->trial);
    return true;
}

static void begin(struct study *study, enum study_kind kind, uint32_t of, const struct trial_span *span)
{
    study->kind = (uint8_t)kind;
    study->done = 0u;
    study->of = of;
    study->tally = (struct study_tally){0};
    study->span = *span;
    study->is_trying = false;
}

static enum study_news tell(struct study *study)
{
    study->done++;
    return STUDY_HAS_RESULT;
}

/* --- Scan --------------------------------------------------------------------------------------------------------- */

void study_begin_scan(struct study *study, const struct scan *scan, const struct trial_span *span)
{
    begin(study, STUDY_SCAN, scan_points(scan), span);
    study->its.scan = *scan;
}

static enum study_news go_on_with_scan(struct study *study)
{
    if (!study->is_trying) {
        scan_params(&study->its.scan, study->done, &study->wanted);
    }
    return try(study, &study->wanted) ? tell(study) : STUDY_TRIES;
}

/* --- Occurrence --------------------------------------------------------------------------------------------------- */

void study_begin_occurrence(struct study *study, const struct occurrence *occurrence, uint32_t trials,
                            const struct trial_span *span)
{
    begin(study, STUDY_OCCURRENCE, trials, span);
    study->its.occurrence.occurrence = *occurrence;
    study->its.occurrence.clamped = 0u;
}

static enum study_news go_on_with_occurrence(struct study *study)
{
    struct study_occurrence *occurrence = &study->its.occurrence;

    if (!study->is_trying) {
        occurrence_draw(&occurrence->occurrence, study->done, &occurrence->draw);
    }
    if (!try(study, &occurrence->draw.params)) {
        return STUDY_TRIES;
    }
    occurrence->clamped += occurrence->draw.clamped;
    return tell(study);
}

struct study_share study_share(const struct study *study)
{
    const uint32_t tried = study->tally.trials - study->tally.refused;
    struct study_share share = {(float)study->tally.loud / (float)tried, 0.0f, 1.0f};

    if (tried > 0u) {
        occurrence_interval(study->tally.loud, tried, &share.low, &share.high);
    }
    return share;
}

/* --- Margin ------------------------------------------------------------------------------------------------------- */

/* The parameter after the given one whose border is asked for, NULL if there is none. */
static const struct params_info *next_parameter(const struct params *params, const struct params_info *info)
{
    for (info = info == NULL ? params_table : info + 1; info < params_table + params_count; info++) {
        if (margin_covers(params, info)) {
            return info;
        }
    }
    return NULL;
}

void study_begin_margin(struct study *study, const struct params *base, const struct params_info *only, float factor,
                        const struct trial_span *span)
{
    uint32_t count = 0u;

    for (const struct params_info *info = NULL; (info = next_parameter(base, info)) != NULL;) {
        count++;
    }
    begin(study, STUDY_MARGIN, only != NULL ? 1u : count, span);
    study->its.margin.base = *base;
    study->its.margin.only = only;
    study->its.margin.factor = factor;
    study->its.margin.has_base = false;
    study->its.margin.is_searching = false;
}

/* The set itself comes first; if it cannot be had, nothing can. */
static enum study_news try_base(struct study *study)
{
    if (!try(study, &study->its.margin.base)) {
        return STUDY_TRIES;
    }
    if (study->problem.error != ERROR_OK) {
        return STUDY_IS_REFUSED;
    }
    study->its.margin.has_base = true;
    study->its.margin.is_loud = trial_is_loud(&study->trial);
    return STUDY_TRIES;
}

/* Goes on to the next set to try, or there is none and the borders are known. */
static enum study_news search(struct study *study)
{
    study->its.margin.is_searching = margin_next(&study->its.margin.margin, &study->wanted);
    return study->its.margin.is_searching ? STUDY_TRIES : tell(study);
}

static enum study_news begin_next(struct study *study)
{
    struct study_margin *margin = &study->its.margin;
    const struct params_info *before = study->done == 0u ? NULL : margin->margin.info;
    const struct params_info *info = margin->only != NULL ? margin->only : next_parameter(&margin->base, before);

    margin_begin(&margin->margin, &margin->base, info, margin->factor, margin->is_loud);
    return search(study);
}

static enum margin_answer side_of_trial(const struct study *study)
{
    if (study->problem.error != ERROR_OK) {
        return MARGIN_REFUSED;
    }
    return trial_is_loud(&study->trial) ? MARGIN_LOUD : MARGIN_QUIET;
}

static enum study_news go_on_with_margin(struct study *study)
{
    if (!study->its.margin.has_base) {
        return try_base(study);
    }
    if (!study->its.margin.is_searching) {
        return begin_next(study);
    }
    if (!try(study, &study->wanted)) {
        return STUDY_TRIES;
    }
    margin_take(&study->its.margin.margin, side_of_trial(study));
    return search(study);
}

enum study_news study_go_on(struct study *study)
{
    if (study->done == study->of) {
        return STUDY_IS_DONE;
    }
    switch ((enum study_kind)study->kind) {
    case STUDY_MARGIN:
        return go_on_with_margin(study);
    case STUDY_OCCURRENCE:
        return go_on_with_occurrence(study);
    case STUDY_SCAN:
    default:
        return go_on_with_scan(study);
    }
}
