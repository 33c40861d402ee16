/* The opening is a list of requests, one after the other; then STEP after STEP. */
#include "conversation.h"

#include "base/assert.h"
#include "base/bytes.h"
#include "base/compiler.h"
#include "base/fmath.h"
#include "base/mem.h"
#include "model/params.h"
#include "model/presets.h"

/* Places in the dictionary. Rows are only ever added, so that they may be compiled in. */
enum {
#define PARAM(id, field, symbol, unit, standard, low, high, change, help) INDEX_##field,
#include "model/params.def"
#undef PARAM
};

static const char preset[] = "brake";

/* What the controller wants otherwise than the preset has it. */
static const struct setting {
    uint8_t index;
    float value;
} settings[] = {
    {INDEX_load_max_n, 6000.0f},      /* twice what the driver can ask for */
    {INDEX_piston_area_m2, 0.00229f}, /* of this vehicle */
    {INDEX_tyre_radius_m, 0.31f},     /* the same */
    {INDEX_stale_s, 0.01f},           /* should the controller fall silent while the plant runs, ... */
    {INDEX_safe_s, 0.05f},            /* ... the plant opens the brake by itself ... */
    {INDEX_ramp_s, 0.05f},            /* ... in this time */
    {INDEX_steps_per_tick, 16.0f},    /* no bit depends on these two, */
    {INDEX_tick_hz, 1000.0f},         /* which make the plant quick */
};

static const struct reading {
    uint8_t index;
    uint8_t offset; /* of a float in struct brake */
} readings[] = {
    {INDEX_mass_kg, offsetof(struct brake, pad_kg)},
    {INDEX_stiffness_contact_n_per_m, offsetof(struct brake, contact_n_per_m)},
    {INDEX_stiffness_caliper_n_per_m, offsetof(struct brake, caliper_n_per_m)},
    {INDEX_friction_static_ratio, offsetof(struct brake, friction_ratio)},
    {INDEX_piston_area_m2, offsetof(struct brake, piston_area_m2)},
    {INDEX_radius_m, offsetof(struct brake, radius_m)},
    {INDEX_tyre_radius_m, offsetof(struct brake, tyre_radius_m)},
};

/* The opening's requests in their order; of a list each row is one. */
enum {
    AT_HELLO,
    AT_PRESET,
    AT_SETTINGS,
    AT_ARITHMETIC = AT_SETTINGS + BASE_COUNT(settings),
    AT_COMMIT,
    AT_READINGS,
    AT_STATUS = AT_READINGS + BASE_COUNT(readings),
    AT_END
};

enum { STAGE_CRC = 5, READ_VALUE = 2, STATUS_STEP_S = 21 }; /* where these stand in their replies */

void conversation_init(struct conversation *conversation, struct text *output)
{
    memset(conversation, 0, sizeof *conversation);
    conversation->output = output;
    master_init(&conversation->master);
}

/* --- Requests ----------------------------------------------------------------------------------------------------- */

/* A request is on its way, or never will be: there is room for two frames, and no more than one waits. */
static void wait(struct conversation *conversation, bool is_asked)
{
    BASE_ASSERT(is_asked);
    conversation->ticks = 0u;
    conversation->repeats = 0u;
}

static void ask(struct conversation *conversation, enum link_message type, const struct bytes_writer *fields)
{
    BASE_ASSERT(!fields->overflowed);
    wait(conversation, master_ask(&conversation->master, conversation->output, type, fields->bytes, fields->size));
}

static void put_setting(struct bytes_writer *fields, uint8_t index, float value)
{
    bytes_put_u8(fields, index);
    bytes_put_f32(fields, value);
}

static void ask_of_opening(struct conversation *conversation)
{
    const uint32_t at = conversation->at;
    uint8_t bytes[8];
    struct bytes_writer fields = {.bytes = bytes, .capacity = sizeof bytes};

    if (at == AT_HELLO) {
        bytes_put_u8(&fields, LINK_MAJOR);
        bytes_put_u8(&fields, LINK_MINOR);
        ask(conversation, LINK_HELLO, &fields);
    } else if (at == AT_PRESET) {
        bytes_put_u8(&fields, (uint8_t)(presets_find(preset, sizeof preset - 1u) - presets_table));
        ask(conversation, LINK_PRESET, &fields);
    } else if (at < AT_ARITHMETIC) {
        put_setting(&fields, settings[at - AT_SETTINGS].index, settings[at - AT_SETTINGS].value);
        ask(conversation, LINK_STAGE, &fields);
    } else if (at == AT_ARITHMETIC) {
        put_setting(&fields, INDEX_arithmetic, conversation->arithmetic);
        ask(conversation, LINK_STAGE, &fields);
    } else if (at == AT_COMMIT) {
        bytes_put_u32(&fields, conversation->staged_crc);
        bytes_put_u8(&fields, 1u); /* the plant may reset for it */
        ask(conversation, LINK_COMMIT, &fields);
    } else if (at < AT_STATUS) {
        bytes_put_u8(&fields, LINK_IN_FORCE);
        bytes_put_u8(&fields, readings[at - AT_READINGS].index);
        ask(conversation, LINK_READ, &fields);
    } else {
        ask(conversation, LINK_STATUS, &fields);
    }
}

void conversation_open(struct conversation *conversation, float arithmetic)
{
    struct text *const output = conversation->output;

    text_init(output, output->bytes, output->capacity); /* what an earlier one left unsent */
    conversation_init(conversation, output);
    conversation->arithmetic = arithmetic;
    conversation->phase = CONVERSATION_OPENING;
    ask_of_opening(conversation);
}

void conversation_turn(struct conversation *conversation, float pressure_pa, float speed_m_per_s)
{
    const struct input_demand demand = {.load = INPUT_LOAD_PRESSURE,
                                        .speed = INPUT_SPEED_VEHICLE,
                                        .load_value = pressure_pa,
                                        .speed_value = speed_m_per_s};

    BASE_ASSERT(conversation->phase == CONVERSATION_READY);
    conversation->phase = CONVERSATION_TURNING;
    wait(conversation,
         master_step(&conversation->master, conversation->output, conversation->brake.turn_steps, &demand));
}

/* INPUT, not STEP: a plant that refuses to step takes it all the same. */
void conversation_release(struct conversation *conversation)
{
    uint8_t bytes[18];
    struct bytes_writer fields = {.bytes = bytes, .capacity = sizeof bytes};

    bytes_put_u64(&fields, INPUT_NOW);
    bytes_put_u8(&fields, INPUT_LOAD_PRESSURE);
    bytes_put_u8(&fields, INPUT_SPEED_KEEP);
    bytes_put_f32(&fields, 0.0f);
    bytes_put_f32(&fields, 0.0f);
    conversation->phase = CONVERSATION_RELEASING;
    ask(conversation, LINK_INPUT, &fields);
}

/* --- Answers ------------------------------------------------------------------------------------------------------ */

static float read_f32(const struct frame *frame, size_t offset)
{
    struct bytes_reader fields = {.bytes = frame->payload, .size = frame->size, .offset = offset};

    return bytes_get_f32(&fields);
}

static void read_answer_of_opening(struct conversation *conversation, const struct frame *frame)
{
    const uint32_t at = conversation->at;
    struct brake *brake = &conversation->brake;

    if (at >= AT_SETTINGS && at <= AT_ARITHMETIC) {
        struct bytes_reader fields = {.bytes = frame->payload, .size = frame->size, .offset = STAGE_CRC};

        conversation->staged_crc = bytes_get_u32(&fields);
    } else if (at >= AT_READINGS && at < AT_STATUS) {
        const float value = read_f32(frame, READ_VALUE);

        memcpy((uint8_t *)brake + readings[at - AT_READINGS].offset, &value, sizeof value);
    } else if (at == AT_STATUS) {
        brake->step_s = read_f32(frame, STATUS_STEP_S);
        brake->turn_steps = (uint32_t)fmath_round_i32(CONVERSATION_TURN_S / brake->step_s);
    }
}

static void go_on_with_opening(struct conversation *conversation, const struct frame *frame)
{
    read_answer_of_opening(conversation, frame);
    conversation->at++;
    if (conversation->at == AT_ARITHMETIC && conversation->arithmetic < 0.0f) {
        conversation->at++;
    }
    if (conversation->at == AT_END) {
        conversation->phase = CONVERSATION_READY;
    } else {
        ask_of_opening(conversation);
    }
}

static void take_answer(struct conversation *conversation, const struct frame *frame)
{
    switch (conversation->phase) {
    case CONVERSATION_OPENING:
        go_on_with_opening(conversation, frame);
        break;
    case CONVERSATION_TURNING:
        master_read_state(frame, &conversation->state);
        conversation->phase = CONVERSATION_READY;
        break;
    case CONVERSATION_RELEASING:
        conversation->phase = CONVERSATION_CLOSED;
        break;
    case CONVERSATION_CLOSED:
    case CONVERSATION_READY:
    default:
        break;
    }
}

/* The first refusal counts; that of the release itself changes nothing. */
static void take_refusal(struct conversation *conversation, const struct frame *frame)
{
    if (conversation->phase == CONVERSATION_RELEASING) {
        conversation->phase = CONVERSATION_CLOSED;
        return;
    }
    master_read_refusal(frame, &conversation->refusal);
    conversation->end = CONVERSATION_REFUSED;
    conversation_release(conversation);
}

void conversation_take(struct conversation *conversation, uint8_t byte)
{
    struct frame frame;

    switch (master_take(&conversation->master, byte, &frame)) {
    case MASTER_ANSWERED:
        take_answer(conversation, &frame);
        break;
    case MASTER_REFUSED:
        take_refusal(conversation, &frame);
        break;
    case MASTER_NOTHING:
    case MASTER_UNASKED: /* nothing is streamed to a controller that has not asked for it */
    case MASTER_STRAY:   /* the answer to a request that was repeated too soon */
    default:
        break;
    }
}

void conversation_pass(struct conversation *conversation)
{
    if (!conversation->master.is_waiting) {
        return;
    }
    conversation->ticks++;
    if (conversation->ticks < CONVERSATION_REPEAT_TICKS) {
        return;
    }
    if (conversation->repeats == CONVERSATION_REPEATS) {
        conversation->phase = CONVERSATION_CLOSED;
        conversation->end = conversation->end == CONVERSATION_WELL ? CONVERSATION_LOST : conversation->end;
        conversation->master.is_waiting = false;
        return;
    }
    conversation->ticks = 0u;
    conversation->repeats++;
    conversation->repeated += master_ask_again(&conversation->master, conversation->output) ? 1u : 0u;
}
