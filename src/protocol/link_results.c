/* Results of a study, which come by themselves while it is under way, and its end. */
#include "base/assert.h"
#include "base/fmath.h"
#include "protocol/link_parts.h"
#include "protocol/report.h"

enum { RESULT_MAX = 80 /* bytes of payload */ };

/* All of them have the sequence of the request that began the study. There is room. */
static void send(struct link *link, uint8_t type, const struct bytes_writer *payload)
{
    struct executive_report report;

    BASE_ASSERT(!payload->overflowed);
    executive_report(link->executive, &report);
    (void)frame_write(link->text, &(struct frame){.type = type,
                                                  .sequence = link->study,
                                                  .step = (uint32_t)report.now.step,
                                                  .payload = payload->bytes,
                                                  .size = payload->size});
}

static float nothing(void) { return fmath_from_bits(0x7fc00000u); }

/* --- POINT -------------------------------------------------------------------------------------------------------- */

static void put_trial(struct bytes_writer *writer, const struct trial *trial)
{
    const struct report_trial report = report_trial(trial);

    bytes_put_u8(writer, report.judged.propensity);
    bytes_put_u8(writer, report.judged.motion);
    bytes_put_u8(writer, report.judged.period);
    bytes_put_u8(writer, report.predicted);
    bytes_put_u8(writer, trial->end);
    bytes_put_u8(writer, (uint8_t)((trial_is_loud(trial) ? LINK_IS_LOUD : 0) |
                                   (trial_is_undecided(trial) ? LINK_IS_UNDECIDED : 0)));
    link_put_value(writer, report.motion.amplitude_um);
    link_put_value(writer, report.motion.velocity_mm_s);
    link_put_value(writer, report.motion.frequency_hz);
    link_put_value(writer, report.judged.level_db);
    link_put_value(writer, report.judged.growth_per_s);
    link_put_value(writer, report.judged.growth_error_per_s);
    link_put_value(writer, report.predicted_growth_per_s);
    link_put_value(writer, report.periods);
}

/* A set that the model cannot hold has been nowhere. */
static void put_no_trial(struct bytes_writer *writer)
{
    bytes_put_u32(writer, 0u); /* the six words */
    bytes_put_u16(writer, 0u);
    for (unsigned i = 0u; i < 8u; i++) {
        link_put_value(writer, nothing());
    }
}

static void put_point(struct bytes_writer *writer, const struct study *study)
{
    const struct scan *scan = &study->its.scan;

    bytes_put_u32(writer, study->done - 1u);
    for (unsigned i = 0u; i < SCAN_AXES; i++) {
        link_put_value(writer, i < scan->axis_count ? params_value(&study->wanted, scan->axes[i].info) : nothing());
    }
    bytes_put_u8(writer, (uint8_t)study->problem.error);
    if (study->problem.error == ERROR_OK) {
        put_trial(writer, &study->trial);
    } else {
        put_no_trial(writer);
    }
}

/* --- BORDER ------------------------------------------------------------------------------------------------------- */

static void put_side(struct bytes_writer *writer, const struct margin_side *side)
{
    link_put_value(writer, side->has_border ? margin_border(side) : nothing());
    link_put_value(writer, side->has_border ? side->quiet : nothing());
    link_put_value(writer, side->has_border ? side->loud : nothing());
    link_put_value(writer, side->has_border ? nothing() : side->searched);
}

static void put_borders(struct bytes_writer *writer, const struct margin *margin)
{
    bytes_put_u8(writer, (uint8_t)(margin->info - params_table));
    bytes_put_u8(writer, margin->is_loud ? 1u : 0u);
    bytes_put_u8(writer, (uint8_t)margin_quiets(margin));
    link_put_value(writer, margin->value);
    put_side(writer, &margin->sides[0]);
    put_side(writer, &margin->sides[1]);
}

static void send_result(struct link *link)
{
    const struct study *study = &link->work->study;
    uint8_t bytes[RESULT_MAX];
    struct bytes_writer payload = {.bytes = bytes, .capacity = sizeof bytes};

    if (study->kind == STUDY_SCAN) {
        put_point(&payload, study);
        send(link, LINK_POINT, &payload);
    } else if (study->kind == STUDY_MARGIN) {
        put_borders(&payload, &study->its.margin.margin);
        send(link, LINK_BORDER, &payload);
    }
}

/* --- STUDY_END ---------------------------------------------------------------------------------------------------- */

static uint8_t request_of(const struct study *study)
{
    switch ((enum study_kind)study->kind) {
    case STUDY_MARGIN:
        return LINK_MARGIN;
    case STUDY_OCCURRENCE:
        return LINK_OCCURRENCE;
    case STUDY_SCAN:
    default:
        return LINK_SCAN;
    }
}

static void put_tally(struct bytes_writer *writer, const struct study_tally *tally)
{
    bytes_put_u32(writer, tally->trials);
    for (unsigned i = 0u; i < 4u; i++) {
        bytes_put_u32(writer, tally->by_propensity[i]);
    }
    bytes_put_u32(writer, tally->loud);
    bytes_put_u32(writer, tally->undecided);
    bytes_put_u32(writer, tally->refused);
    bytes_put_u32(writer, tally->diverged);
    bytes_put_u32(writer, tally->caps);
    bytes_put_u32(writer, tally->saturations);
    bytes_put_u32(writer, tally->gap_held);
    bytes_put_u64(writer, tally->steps);
}

static void put_share(struct bytes_writer *writer, const struct study *study)
{
    const struct study_share share = study_share(study);
    const bool has_share = study->kind == STUDY_OCCURRENCE;

    link_put_value(writer, has_share ? share.share : nothing());
    link_put_value(writer, has_share ? share.low : nothing());
    link_put_value(writer, has_share ? share.high : nothing());
    bytes_put_u32(writer, has_share ? study->its.occurrence.clamped : 0u);
}

static void end(struct link *link, enum error reason)
{
    const struct study *study = &link->work->study;
    uint8_t bytes[RESULT_MAX];
    struct bytes_writer payload = {.bytes = bytes, .capacity = sizeof bytes};

    bytes_put_u8(&payload, request_of(study));
    bytes_put_u8(&payload, (uint8_t)reason);
    bytes_put_u32(&payload, study->done);
    put_tally(&payload, &study->tally);
    put_share(&payload, study);
    send(link, LINK_STUDY_END, &payload);
    turn_leave_study(link->turn, TURN_LINK);
}

bool link_end_study(struct link *link)
{
    if (link->turn->studies != TURN_LINK) {
        return true;
    }
    if (!link_has_room(link)) {
        return false;
    }
    end(link, ERROR_STOPPED);
    return true;
}

bool link_continue_study(struct link *link)
{
    const struct study *study = &link->work->study;

    if (link->turn->studies != TURN_LINK || !link_has_room(link)) {
        return false;
    }
    switch (study_go_on(&link->work->study)) {
    case STUDY_HAS_RESULT:
        send_result(link);
        break;
    case STUDY_IS_DONE:
        end(link, ERROR_OK);
        break;
    case STUDY_IS_REFUSED:
        end(link, study->problem.error);
        break;
    case STUDY_TRIES:
    default:
        break;
    }
    return true;
}
