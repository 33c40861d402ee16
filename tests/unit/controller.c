/* The controller of the bench. */
#include "controller.h"

#include "model/presets.h"
#include "protocol/report.h"

enum { LIMIT = 20000 };

struct bench_frame request, reply;
struct bytes_writer fields;
struct bytes_reader answer;

void say(enum link_message type, uint16_t sequence, uint32_t step)
{
    request = (struct bench_frame){.type = (uint8_t)type, .sequence = sequence, .step = step};
    fields = (struct bytes_writer){.bytes = request.payload, .capacity = sizeof request.payload};
}

bool is_answered(void)
{
    request.size = fields.size;
    if (!bench_ask(&request, &reply, LIMIT)) {
        return false;
    }
    answer = (struct bytes_reader){.bytes = reply.payload, .size = reply.size};
    return reply.type == request.type + LINK_REPLY && reply.sequence == request.sequence;
}

bool is_refused(enum error error, uint8_t index, uint32_t expected)
{
    return !is_answered() && reply.type == LINK_ERROR && reply.sequence == request.sequence &&
           reply.size == LINK_ERROR_SIZE && bytes_get_u8(&answer) == request.type &&
           bytes_get_u8(&answer) == (uint8_t)error && bytes_get_u8(&answer) == index &&
           bytes_get_u32(&answer) == expected;
}

bool has_range(float low, float high)
{
    const bool low_is_it = bytes_get_f32(&answer) == low;

    return bytes_get_f32(&answer) == high && low_is_it;
}

bool is_done(enum link_message type)
{
    say(type, 1u, 0u);
    return is_answered();
}

static bool holds(const char *text, const char *key, float value, void (*write)(struct text *, const char *, float))
{
    uint8_t storage[64];
    struct text field;

    text_init(&field, storage, sizeof storage);
    write(&field, key, value);
    text_put(&field, '\0');
    return bench_holds(text, (const char *)storage);
}

bool holds_value(const char *text, const char *key, float value) { return holds(text, key, value, report_field); }

bool holds_setting(const char *text, const char *key, float value)
{
    return holds(text, key, value, text_key_shortest);
}

uint8_t index_of(const char *symbol, size_t length) { return (uint8_t)(params_find(symbol, length) - params_table); }

static uint8_t preset_index(const char *name, size_t length)
{
    return (uint8_t)(presets_find(name, length) - presets_table);
}

bool load_preset(const char *name, size_t length)
{
    say(LINK_PRESET, 3u, 0u);
    bytes_put_u8(&fields, preset_index(name, length));
    return is_answered();
}
