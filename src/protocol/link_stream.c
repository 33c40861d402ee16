/* Samples that come by themselves while the plant steps. */
#include "protocol/link_parts.h"
#include "protocol/signals.h"
#include "protocol/stream.h"

enum { BITS_PER_BYTE = 10 /* 8N1 on the wire */, WORD_SIZE = 4, FRAME_STUFFING = 2 /* code and delimiter */ };

bool link_has_room(const struct link *link) { return text_room(link->text) >= 2u * FRAME_WIRE_MAX; }

bool link_has_sample(const struct link *link)
{
    return link->turn->streams == TURN_LINK && stream_has_sample(link->executive);
}

uint32_t link_dropped(const struct link *link)
{
    const struct link_stream *stream = &link->stream;

    return stream->every == 0u ? stream->dropped
                               : stream->without_scale + link->executive->samples.dropped - stream->dropped_before;
}

static uint32_t count_signals(uint32_t signals)
{
    uint32_t count = 0u;

    for (; signals != 0u; signals &= signals - 1u) {
        count++;
    }
    return count;
}

static void write_sample(struct link *link, const struct sample *sample, const struct scale *scale)
{
    uint8_t bytes[SIGNAL_COUNT * WORD_SIZE];
    struct bytes_writer payload = {.bytes = bytes, .capacity = sizeof bytes};

    for (unsigned i = 0u; i < SIGNAL_COUNT; i++) {
        if ((link->stream.signals >> i & 1u) != 0u) {
            bytes_put_u32(&payload, signals_word((enum signal)i, sample, scale));
        }
    }
    (void)frame_write(link->text, &(struct frame){.type = LINK_SAMPLE,
                                                  .sequence = (uint16_t)(sample->number - link->stream.first),
                                                  .step = (uint32_t)sample->step,
                                                  .payload = bytes,
                                                  .size = payload.size}); /* there is room */
    link->stream.sent++;
}

bool link_write_samples(struct link *link)
{
    const bool has_any = link_has_sample(link);
    struct sample sample;

    while (link_has_sample(link) && link_has_room(link)) {
        const struct scale *scale;

        (void)ring_pop(&link->executive->samples, &sample);
        scale = executive_scale(link->executive, sample.epoch);
        if (scale != NULL) {
            write_sample(link, &sample, scale);
        } else {
            link->stream.without_scale++;
        }
    }
    return has_any;
}

/* The stream before has ended and its samples are out. Nothing is being made, so the ring's numbers stand still. */
static void begin(struct link *link, uint32_t signals, uint32_t every)
{
    const struct ring *samples = &link->executive->samples;

    link->stream = (struct link_stream){.signals = signals,
                                        .every = every,
                                        .first = (uint16_t)(samples->head + samples->dropped),
                                        .dropped_before = samples->dropped};
    executive_stream(link->executive, every);
}

static void end(struct link *link)
{
    link->stream.dropped = link_dropped(link);
    link->stream.every = 0u;
    turn_leave_stream(link->turn, TURN_LINK);
}

static enum link_progress answer(struct link *link, uint32_t signals, uint32_t every)
{
    const struct params *params = executive_params(link->executive);
    const uint32_t bytes = FRAME_SIZE_MIN + FRAME_STUFFING + WORD_SIZE * count_signals(signals);
    const float least = (float)(bytes * BITS_PER_BYTE) * params->tick_hz * params->steps_per_tick /
                        (float)link->identity->baud * (100.0f / (float)STREAM_LOAD_MAX_PERCENT);
    uint32_t smallest = (uint32_t)least;

    smallest += (float)smallest < least || smallest == 0u ? 1u : 0u;
    bytes_put_u32(&link->reply, every);
    bytes_put_u32(&link->reply, smallest);
    bytes_put_u16(&link->reply, (uint16_t)bytes);
    return link_answer(link);
}

enum link_progress link_stream(struct link *link)
{
    const uint32_t signals = bytes_get_u32(&link->arguments);
    const uint32_t every = bytes_get_u32(&link->arguments);

    if (signals >> SIGNAL_COUNT != 0u) {
        return link_refuse_field(link, 0u, 0.0f, (float)((1u << SIGNAL_COUNT) - 1u));
    }
    if (every > STREAM_EVERY_MAX) {
        return link_refuse_field(link, 1u, 0.0f, (float)STREAM_EVERY_MAX);
    }
    if (link->phase != 0u) {
        turn_leave(link->turn, TURN_LINK); /* a reader that has stopped must not keep it */
        if (link_has_sample(link)) {
            return LINK_WAITS;
        }
        if (every == 0u) {
            end(link);
        } else {
            begin(link, signals, every);
        }
        return answer(link, signals, every);
    }
    if (every == 0u && link->stream.every == 0u) {
        return answer(link, signals, every);
    }
    if (!turn_take(link->turn, TURN_LINK) || !turn_take_stream(link->turn, TURN_LINK)) {
        return link_refuse_plain(link, ERROR_BUSY);
    }
    executive_stream(link->executive, 0u);
    link->phase = 1u;
    return LINK_ADVANCES;
}
