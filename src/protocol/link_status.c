/* STATUS: state and every counter. */
#include "protocol/link_parts.h"

enum { STATE_READY, STATE_RUN, STATE_FAULT };

static void put_state(struct link *link, const struct executive_report *report)
{
    const struct sim_plan *plan = executive_plan(link->executive);
    const struct params *params = &plan->params;
    const bool is_running = executive_wants_tick(link->executive);

    bytes_put_u8(&link->reply, report->now.is_fault != 0u ? STATE_FAULT : is_running ? STATE_RUN : STATE_READY);
    bytes_put_u64(&link->reply, report->now.step);
    bytes_put_u32(&link->reply, report->generation);
    bytes_put_u32(&link->reply, report->now.hash);
    bytes_put_u32(&link->reply, link_crc(params));
    bytes_put_f32(&link->reply, plan->scale.step_s);
    bytes_put_f32(&link->reply, params->tick_hz * params->steps_per_tick * plan->scale.step_s);
}

static void put_counters(struct link *link, const struct executive_report *report)
{
    struct bytes_writer *reply = &link->reply;

    bytes_put_u32(reply, report->counters.events);
    bytes_put_u32(reply, report->counters.caps);
    bytes_put_u32(reply, report->counters.saturations);
    bytes_put_u32(reply, report->counters.lifted);
    bytes_put_u32(reply, report->counters.gap_held);
    bytes_put_u32(reply, report->load.ticks);
    bytes_put_u32(reply, report->load.overruns);
    bytes_put_u32(reply, report->load.shed);
    bytes_put_u32(reply, report->counters.inputs);
    bytes_put_u32(reply, report->counters.inputs_late);
    bytes_put_u32(reply, link->executive->inputs_clamped + report->counters.lowered);
    bytes_put_u32(reply, link->executive->inputs_refused + report->counters.inputs_void);
}

/* Offered is the sum of the rest, so that it is exact while the plant runs. */
static void put_samples(struct link *link)
{
    const uint32_t dropped = link_dropped(link);
    const uint32_t waiting = link_has_sample(link) ? ring_fill(&link->executive->samples) : 0u;

    bytes_put_u32(&link->reply, link->stream.sent + dropped + waiting);
    bytes_put_u32(&link->reply, link->stream.sent);
    bytes_put_u32(&link->reply, dropped);
    bytes_put_u32(&link->reply, waiting);
}

static void put_receiver(struct link *link)
{
    const struct frame_receiver *receiver = &link->receiver;

    bytes_put_u32(&link->reply, receiver->accepted);
    bytes_put_u32(&link->reply, receiver->damaged);
    bytes_put_u32(&link->reply, receiver->too_long);
    bytes_put_u32(&link->reply, receiver->bad_cobs);
    bytes_put_u32(&link->reply, receiver->too_short);
    bytes_put_u32(&link->reply, receiver->bad_crc);
    bytes_put_u32(&link->reply, receiver->garbage_bytes);
    bytes_put_u32(&link->reply, link->refused);
}

static void put_watch(struct link *link, const struct executive_report *report)
{
    bytes_put_u8(&link->reply, report->now.watch);
    bytes_put_u32(&link->reply, report->stales);
    bytes_put_u32(&link->reply, report->safes);
}

enum link_progress link_status(struct link *link)
{
    struct executive_report report;

    executive_report(link->executive, &report);
    put_state(link, &report);
    put_counters(link, &report);
    put_samples(link);
    put_receiver(link);
    put_watch(link, &report);
    return link_answer(link);
}
