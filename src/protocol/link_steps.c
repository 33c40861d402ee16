/* What moves the plant: free run, and steps with a controller's inputs. */
#include "base/fmath.h"
#include "base/mem.h"
#include "protocol/link_parts.h"
#include "protocol/signals.h"

enum { STEPS_MAX = 1000000 };

enum { FIELD_COUNT, FIELD_STEP_DEMAND }; /* of STEP */
enum { FIELD_AT, FIELD_INPUT_DEMAND };   /* of INPUT; a demand has the four that follow */
enum { DEMAND_LOAD_KIND, DEMAND_SPEED_KIND, DEMAND_LOAD, DEMAND_SPEED };

static enum link_progress answer_where(struct link *link)
{
    struct executive_report report;

    executive_report(link->executive, &report);
    bytes_put_u64(&link->reply, report.now.step);
    return link_answer(link);
}

enum link_progress link_run(struct link *link)
{
    struct executive_report report;
    enum error error;

    executive_report(link->executive, &report);
    if (report.now.is_fault != 0u) {
        return link_refuse_plain(link, ERROR_IN_FAULT);
    }
    if (!turn_take(link->turn, TURN_LINK)) {
        return link_refuse_plain(link, ERROR_BUSY);
    }
    error = executive_free_run(link->executive);
    return error == ERROR_OK ? answer_where(link) : link_refuse_plain(link, error);
}

enum link_progress link_stop(struct link *link)
{
    if (link->phase != 0u) {
        return link_has_sample(link) ? LINK_WAITS : answer_where(link);
    }
    if (link->turn->studies == TURN_LINK) {
        return link_end_study(link) ? answer_where(link) : LINK_WAITS;
    }
    turn_want(link->turn, TURN_LINK);
    executive_halt(link->executive);
    link->phase = 1u;
    return LINK_ADVANCES;
}

/* Reads a demand whose fields begin at the given one; false if it was refused. */
static bool read_demand(struct link *link, uint8_t first, bool may_start, struct input_demand *demand)
{
    const uint8_t byte = bytes_get_u8(&link->arguments);
    const uint8_t load = may_start ? byte & (uint8_t)~LINK_STARTS : byte;
    const uint8_t speed = bytes_get_u8(&link->arguments);

    demand->starts = load != byte;
    demand->load = (enum input_load)load;
    demand->speed = (enum input_speed)speed;
    demand->load_value = bytes_get_f32(&link->arguments);
    demand->speed_value = bytes_get_f32(&link->arguments);
    if (load > INPUT_LOAD_PRESSURE) {
        (void)link_refuse_field(link, first + DEMAND_LOAD_KIND, 0.0f, (float)INPUT_LOAD_PRESSURE);
        return false;
    }
    if (speed > INPUT_SPEED_VEHICLE) {
        (void)link_refuse_field(link, first + DEMAND_SPEED_KIND, 0.0f, (float)INPUT_SPEED_VEHICLE);
        return false;
    }
    if (load >= INPUT_LOAD_FORCE && !fmath_is_finite(demand->load_value)) {
        (void)link_refuse(
            link, &(struct link_refusal){.error = ERROR_BAD_NUMBER, .has_index = true, .index = first + DEMAND_LOAD});
        return false;
    }
    if (speed >= INPUT_SPEED_DISC && !fmath_is_finite(demand->speed_value)) {
        (void)link_refuse(
            link, &(struct link_refusal){.error = ERROR_BAD_NUMBER, .has_index = true, .index = first + DEMAND_SPEED});
        return false;
    }
    return true;
}

static bool is_idle_demand(const struct input_demand *demand)
{
    return demand->load == INPUT_LOAD_KEEP && demand->speed == INPUT_SPEED_KEEP;
}

enum link_progress link_input(struct link *link)
{
    struct input_demand demand = {.step = bytes_get_u64(&link->arguments)};
    struct executive_report report;
    enum error error;
    bool was_clamped;

    if (!read_demand(link, FIELD_INPUT_DEMAND, false, &demand)) {
        return LINK_ANSWERED;
    }
    executive_report(link->executive, &report);
    if (is_idle_demand(&demand)) {
        return link_refuse_plain(link, ERROR_USAGE);
    }
    if (report.now.is_fault != 0u) {
        return link_refuse_plain(link, ERROR_IN_FAULT);
    }
    error = executive_input(link->executive, &demand, &was_clamped);
    if (error != ERROR_OK) {
        return link_refuse_plain(link, error);
    }
    bytes_put_u8(&link->reply, was_clamped ? 1u : 0u);
    return link_answer(link);
}

/* --- STEP --------------------------------------------------------------------------------------------------------- */

static bool has_last(const struct link *link)
{
    return link->steps.has_last && link->steps.resets == link->executive->resets;
}

static bool is_repeated(const struct link *link)
{
    const struct link_request *now = &link->request;
    const struct link_steps *steps = &link->steps;

    return has_last(link) && now->sequence == steps->last_sequence && now->step == steps->last_at &&
           memcmp(now->payload, steps->last_payload, sizeof steps->last_payload) == 0;
}

static enum link_progress answer_again(struct link *link)
{
    bytes_put_block(&link->reply, link->steps.last_reply, LINK_STEP_REPLY);
    return link_answer_from(link, link->steps.last_step);
}

static void put_signal(struct link *link, enum signal signal, const struct sample *now)
{
    bytes_put_u32(&link->reply, signals_word(signal, now, &executive_plan(link->executive)->scale));
}

static enum link_progress answer_step(struct link *link, const struct executive_report *report)
{
    struct link_steps *steps = &link->steps;
    const struct sample *now = &report->now;
    const bool is_fault = now->is_fault != 0u;
    const bool is_cut = !is_fault && now->step != steps->target;
    const int flags = (is_fault ? LINK_IS_FAULT : 0) | (steps->was_clamped ? LINK_WAS_CLAMPED : 0) |
                      (is_cut ? LINK_WAS_CUT : 0) | (now->watch == WATCH_STALE ? LINK_IS_STALE : 0) |
                      (now->watch == WATCH_SAFE ? LINK_IS_SAFE : 0);

    bytes_put_u64(&link->reply, now->step);
    bytes_put_u32(&link->reply, now->hash);
    put_signal(link, SIGNAL_X, now);
    put_signal(link, SIGNAL_XD, now);
    put_signal(link, SIGNAL_Y, now);
    put_signal(link, SIGNAL_YD, now);
    put_signal(link, SIGNAL_N, now);
    put_signal(link, SIGNAL_F, now);
    put_signal(link, SIGNAL_V0, now);
    bytes_put_u8(&link->reply, (uint8_t)now->mode);
    bytes_put_u8(&link->reply, now->propensity);
    bytes_put_u8(&link->reply, report->verdict.motion);
    bytes_put_u8(&link->reply, report->verdict.period);
    bytes_put_u8(&link->reply, (uint8_t)flags);
    steps->has_last = true;
    steps->resets = link->executive->resets;
    steps->last_sequence = link->request.sequence;
    steps->last_at = link->request.step;
    memcpy(steps->last_payload, link->request.payload, LINK_STEP_REQUEST);
    steps->last_step = (uint32_t)now->step;
    memcpy(steps->last_reply, link->reply_bytes, LINK_STEP_REPLY);
    return link_answer_from(link, steps->last_step);
}

/* No more at a time than the samples of which fit between interrupt and main: whoever grants steps loses none. */
static enum link_progress grant(struct link *link)
{
    struct link_steps *steps = &link->steps;
    const uint64_t sampled = (uint64_t)link->stream.every * EXECUTIVE_SAMPLES;
    uint64_t count = steps->target - steps->reached;

    count = sampled != 0u && sampled < count ? sampled : count;
    steps->reached += count;
    executive_grant(link->executive, (uint32_t)count);
    return LINK_ADVANCES;
}

/* Cut short, it is answered at once: a reader that has stopped must not keep the turn. */
static enum link_progress go_on(struct link *link)
{
    struct link_steps *steps = &link->steps;
    struct executive_report report;

    link->turn->is_stuck = link_has_sample(link) && !link_has_room(link);
    if (link->turn->is_wanted && !steps->was_cut) {
        steps->was_cut = true;
        executive_halt(link->executive);
        return LINK_ADVANCES;
    }
    executive_report(link->executive, &report);
    if (report.now.is_fault != 0u) {
        executive_stop(link->executive);
    } else if (!steps->was_cut && (executive_credit(link->executive) != 0u || report.now.step != steps->reached)) {
        return LINK_WAITS;
    }
    if (link_has_sample(link) && !steps->was_cut) {
        return LINK_WAITS;
    }
    if (steps->reached != steps->target && !steps->was_cut && report.now.is_fault == 0u) {
        return grant(link);
    }
    return answer_step(link, &report);
}

enum error link_find_obstacle(struct link *link, const struct executive_report *report)
{
    if (report->now.is_fault != 0u) {
        return ERROR_IN_FAULT;
    }
    if (!turn_take(link->turn, TURN_LINK)) {
        return ERROR_BUSY;
    }
    return executive_wants_tick(link->executive) ? ERROR_IS_RUNNING : ERROR_OK;
}

static enum link_progress begin(struct link *link, const struct executive_report *report)
{
    struct link_steps *steps = &link->steps;
    const uint32_t count = bytes_get_u32(&link->arguments);
    struct input_demand demand = {.step = INPUT_NOW};
    enum error error = ERROR_OK;

    if (count == 0u || count > STEPS_MAX) {
        return link_refuse_field(link, FIELD_COUNT, 1.0f, (float)STEPS_MAX);
    }
    if (!read_demand(link, FIELD_STEP_DEMAND, true, &demand)) {
        return LINK_ANSWERED;
    }
    steps->was_clamped = false;
    steps->was_cut = false;
    if (demand.starts || !is_idle_demand(&demand)) {
        error = executive_input(link->executive, &demand, &steps->was_clamped);
    }
    if (error != ERROR_OK) {
        return link_refuse_plain(link, error);
    }
    steps->reached = report->now.step;
    steps->target = report->now.step + count;
    executive_stop(link->executive); /* takes back what an earlier stop may have left open */
    link->phase = 1u;
    return grant(link);
}

enum link_progress link_step(struct link *link)
{
    const uint16_t next = (uint16_t)(link->steps.last_sequence + 1u);
    struct executive_report report;
    enum error obstacle;

    if (link->phase != 0u) {
        return go_on(link);
    }
    if (is_repeated(link)) {
        return answer_again(link);
    }
    if (has_last(link) && link->request.sequence != next) {
        return link_refuse(link, &(struct link_refusal){.error = ERROR_BAD_SEQUENCE, .expected = next});
    }
    executive_report(link->executive, &report);
    obstacle = link_find_obstacle(link, &report);
    if (obstacle != ERROR_OK) {
        return link_refuse_plain(link, obstacle);
    }
    if (link->request.step != (uint32_t)report.now.step) {
        return link_refuse(link,
                           &(struct link_refusal){.error = ERROR_BAD_STEP, .expected = (uint32_t)report.now.step});
    }
    return begin(link, &report);
}
