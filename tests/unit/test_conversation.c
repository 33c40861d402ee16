/* The controller's conversation, with the real link at the other end of a line that loses what it is told to lose. */
#include "hil/controller/conversation.h"

#include "base/fmath.h"
#include "bench.h"
#include "hil/controller/journal.h"
#include "tap.h"
#include "tests.h"

enum { ROUNDS = 20000 };

static struct conversation conversation;
static struct text sent;
static uint8_t sent_bytes[CONVERSATION_OUTPUT];
static struct text console;
static uint8_t console_bytes[2048];

/* Requests from here to there; replies back, unless they are lost. */
static void exchange(bool loses_replies)
{
    size_t size;
    bool is_busy;
    const uint8_t *bytes = text_peek(&sent, &size);

    text_drop(&sent, link_receive(&bench.link, bytes, size));
    (void)bench_turn("", 0u, SIZE_MAX, &is_busy);
    for (bytes = text_peek(&bench.link_text, &size); size > 0u; bytes = text_peek(&bench.link_text, &size)) {
        for (size_t i = 0u; i < size && !loses_replies; i++) {
            conversation_take(&conversation, bytes[i]);
        }
        text_drop(&bench.link_text, size);
    }
}

static bool reaches(enum conversation_phase phase)
{
    for (unsigned i = 0u; i < ROUNDS && conversation.phase != phase; i++) {
        exchange(false);
    }
    return conversation.phase == phase;
}

static void open(float arithmetic)
{
    bench_open();
    bench_link_is_read = false; /* here it is read */
    text_init(&sent, sent_bytes, sizeof sent_bytes);
    text_init(&console, console_bytes, sizeof console_bytes);
    conversation_init(&conversation, &sent);
    conversation_open(&conversation, arithmetic);
}

static bool tells(const char *part)
{
    size_t size;
    static char line[JOURNAL_LINE_MAX + 1];
    const uint8_t *bytes = text_peek(&console, &size);

    for (size_t i = 0u; i < size && i < JOURNAL_LINE_MAX; i++) {
        line[i] = (char)bytes[i];
        line[i + 1u] = '\0';
    }
    text_drop(&console, size);
    return size > 0u && bench_holds(line, part);
}

static void check_opening(void)
{
    const struct params *params = executive_params(&bench.executive);

    open(-1.0f);
    tap_check(conversation.phase == CONVERSATION_OPENING && reaches(CONVERSATION_READY), "it opens");
    tap_check(params->load_end_n == 3000.0f && params->load_max_n == 6000.0f && params->safe_s == 0.05f &&
                  params->arithmetic == (float)ARITH_F32,
              "the preset and what the controller wants otherwise are in force");
    tap_check(conversation.brake.pad_kg == 0.3f && conversation.brake.contact_n_per_m == 4e7f &&
                  conversation.brake.caliper_n_per_m == 7.5e6f && conversation.brake.friction_ratio == 0.42f &&
                  conversation.brake.piston_area_m2 == 0.00229f && conversation.brake.radius_m == 0.11f &&
                  conversation.brake.tyre_radius_m == 0.31f,
              "the brake is known");
    tap_check_close(brake_turn_s(&conversation.brake), CONVERSATION_TURN_S, 5e-6f, "a turn is as long as it should be");
    tap_check(journal_opened(&console, &conversation.brake) && tells(" turn_steps=232 "), "which is told");
    open((float)ARITH_Q27);
    tap_check(reaches(CONVERSATION_READY) && params->arithmetic == (float)ARITH_Q27,
              "in the arithmetic that is asked for");
}

static void check_turns(void)
{
    uint32_t hash;

    open(-1.0f);
    (void)reaches(CONVERSATION_READY);
    conversation_turn(&conversation, 1e6f, 1.0f);
    tap_check(conversation.phase == CONVERSATION_TURNING && reaches(CONVERSATION_READY), "a turn is made");
    tap_check(conversation.state.step == 232u && fmath_abs(conversation.state.load_n - 2290.0f) < 1.0f &&
                  fmath_abs(conversation.state.disc_m_per_s - 0.11f / 0.31f) < 1e-6f,
              "of its length, with its pressure and speed");
    conversation_turn(&conversation, 1e6f, 1.0f);
    (void)reaches(CONVERSATION_READY);
    hash = conversation.state.hash;
    tap_check(conversation.state.step == 464u, "and the next");
    conversation_release(&conversation);
    tap_check(reaches(CONVERSATION_CLOSED) && conversation.end == CONVERSATION_WELL, "it closes");
    conversation_open(&conversation, -1.0f);
    tap_check(reaches(CONVERSATION_READY), "and opens again");
    for (unsigned i = 0u; i < 2u; i++) {
        conversation_turn(&conversation, 1e6f, 1.0f);
        (void)reaches(CONVERSATION_READY);
    }
    tap_check(conversation.state.step == 464u && conversation.state.hash == hash,
              "on the same plant, from its beginning");
}

static void pass(unsigned ticks)
{
    for (; ticks > 0u; ticks--) {
        conversation_pass(&conversation);
    }
}

static void check_silence(void)
{
    uint32_t made;

    open(-1.0f);
    (void)reaches(CONVERSATION_READY);
    pass(10u * CONVERSATION_REPEAT_TICKS);
    tap_check(conversation.phase == CONVERSATION_READY && conversation.repeated == 0u,
              "who asks nothing waits for nothing");
    conversation_turn(&conversation, 1e6f, 1.0f);
    for (unsigned i = 0u; i < 1000u; i++) {
        exchange(true);
    }
    made = bench.executive.report_store.now.step == 232u;
    pass(CONVERSATION_REPEAT_TICKS - 1u);
    tap_check(made && conversation.repeated == 0u && text_room(&sent) == CONVERSATION_OUTPUT, "a reply is lost");
    pass(1u);
    tap_check(conversation.repeated == 1u && reaches(CONVERSATION_READY) && conversation.state.step == 232u,
              "it asks again, and the turn is made once");
    conversation_turn(&conversation, 1e6f, 1.0f);
    pass(CONVERSATION_REPEAT_TICKS * CONVERSATION_REPEATS);
    tap_check(conversation.phase == CONVERSATION_TURNING, "a dead line is borne for long");
    pass(CONVERSATION_REPEAT_TICKS);
    tap_check(conversation.phase == CONVERSATION_CLOSED && conversation.end == CONVERSATION_LOST, "but not for ever");
    tap_check(journal_lost(&console, &conversation) && tells("lost step: no answer in 3.2 s"), "which is told");
    pass(100u * CONVERSATION_REPEAT_TICKS);
    tap_check(text_room(&sent) >= FRAME_WIRE_MAX + 1u && conversation.phase == CONVERSATION_CLOSED,
              "then it is silent");
    conversation_open(&conversation, -1.0f);
    tap_check(reaches(CONVERSATION_READY) && conversation.end == CONVERSATION_WELL, "until it is opened again");
}

static void check_refusal(void)
{
    open(-1.0f);
    (void)reaches(CONVERSATION_READY);
    conversation_turn(&conversation, 1e6f, 1.0f);
    (void)reaches(CONVERSATION_READY);
    executive_free_run(&bench.executive); /* somebody else has started the plant */
    conversation_turn(&conversation, 1e6f, 1.0f);
    tap_check(reaches(CONVERSATION_CLOSED) && conversation.end == CONVERSATION_REFUSED &&
                  conversation.refusal.type == LINK_STEP && conversation.refusal.error == ERROR_IS_RUNNING,
              "a refusal ends it");
    for (unsigned i = 0u; i < 100u; i++) {
        exchange(false);
    }
    tap_check(bench.executive.report_store.now.load == 0u, "and the brake is open");
    tap_check(journal_refused(&console, &conversation.refusal) && tells("refused step is-running index=255 "),
              "which is told");
}

void test_conversation(void)
{
    check_opening();
    check_turns();
    check_silence();
    check_refusal();
}
