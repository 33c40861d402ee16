/* Lines for the console. */
#include "journal.h"

static const char orders[] = "stop SPEED law|free [f32|q27]";

bool journal_greeting(struct text *text, const char *board)
{
    const size_t mark = text_mark(text);

    text_write(text, "controller on ");
    text_write(text, board);
    text_write(text, ": ");
    text_write(text, orders);
    return text_end_or_rollback(text, mark);
}

bool journal_opened(struct text *text, const struct brake *brake)
{
    const size_t mark = text_mark(text);

    text_write(text, "opened");
    text_key_shortest(text, "step_s", brake->step_s);
    text_key_u64(text, "turn_steps", brake->turn_steps);
    text_key_shortest(text, "pad_kg", brake->pad_kg);
    text_key_shortest(text, "stiffness_n_per_m", brake->contact_n_per_m + brake->caliper_n_per_m);
    text_key_shortest(text, "friction_ratio", brake->friction_ratio);
    text_key_shortest(text, "piston_area_m2", brake->piston_area_m2);
    text_key_shortest(text, "radius_m", brake->radius_m);
    text_key_shortest(text, "tyre_radius_m", brake->tyre_radius_m);
    return text_end_or_rollback(text, mark);
}

bool journal_header(struct text *text)
{
    const size_t mark = text_mark(text);

    text_write(text, "#turn,step,hash,t_s,speed_m_per_s,demand_pa,pressure_pa,load_n,friction_n,amplitude_m,propensity,"
                     "flags,phase");
    return text_end_or_rollback(text, mark);
}

static void put_number(struct text *text, float value)
{
    text_put(text, ',');
    text_f32(text, value, 6u);
}

static void put_count(struct text *text, uint64_t value)
{
    text_put(text, ',');
    text_u64(text, value);
}

bool journal_turn(struct text *text, const struct journal_turn *turn)
{
    const struct master_state *state = turn->state;
    const size_t mark = text_mark(text);

    text_u64(text, turn->stop->turns);
    put_count(text, state->step);
    text_put(text, ',');
    text_hex32(text, state->hash);
    put_number(text, stop_time_s(turn->stop, turn->brake));
    put_number(text, turn->stop->speed_m_per_s);
    put_number(text, turn->demand_pa);
    put_number(text, turn->pressure_pa);
    put_number(text, state->load_n);
    put_number(text, state->friction_n);
    put_number(text, stop_amplitude_m(turn->brake, state));
    put_count(text, state->propensity);
    put_count(text, state->flags);
    put_count(text, (uint64_t)turn->phase);
    return text_end_or_rollback(text, mark);
}

bool journal_phase(struct text *text, float time_s, const struct law *law)
{
    const size_t mark = text_mark(text);

    text_write(text, "phase");
    text_key_f32(text, "t_s", time_s, 6u);
    text_key_text(text, "now", law_phase_name(law->phase));
    text_key_f32(text, "pressure_pa", law->pressure_pa, 6u);
    text_key_f32(text, "build_pa_per_s", law->build_pa_per_s, 6u);
    return text_end_or_rollback(text, mark);
}

bool journal_score(struct text *text, bool has_law, const struct stop *stop, const struct law *law,
                   const struct conversation *conversation)
{
    const size_t mark = text_mark(text);

    text_write(text, "score");
    text_key_u64(text, "law", has_law ? 1u : 0u);
    text_key_f32(text, "kept", stop_kept_ratio(stop), 6u);
    text_key_f32(text, "squeal", stop_squeal_ratio(stop), 6u);
    text_key_f32(text, "t_s", stop_time_s(stop, &conversation->brake), 6u);
    text_key_f32(text, "speed_m_per_s", stop->speed_m_per_s, 6u);
    text_key_u64(text, "turns", stop->turns);
    text_key_u64(text, "squeals", law->squeals);
    text_key_u64(text, "repeated", conversation->repeated);
    text_key_u64(text, "fault", (conversation->state.flags & LINK_IS_FAULT) != 0 ? 1u : 0u);
    return text_end_or_rollback(text, mark);
}

static const char *request_name(uint8_t type)
{
    switch (type) {
#define MESSAGE(number, field, name, request, reply, help) \
    case number:                                           \
        return #name;
#include "protocol/messages.def"
#undef MESSAGE
    default:
        return "request";
    }
}

bool journal_refused(struct text *text, const struct master_refusal *refusal)
{
    const size_t mark = text_mark(text);

    text_write(text, "refused ");
    text_write(text, request_name(refusal->type));
    text_put(text, ' ');
    text_write(text, error_name((enum error)refusal->error));
    text_key_u64(text, "index", refusal->index);
    text_key_u64(text, "expected", refusal->expected);
    text_key_shortest(text, "low", refusal->low);
    text_key_shortest(text, "high", refusal->high);
    text_write(text, ": ");
    text_write(text, error_text((enum error)refusal->error));
    return text_end_or_rollback(text, mark);
}

bool journal_lost(struct text *text, const struct conversation *conversation)
{
    const float silence_s =
        (float)(CONVERSATION_REPEAT_TICKS * (CONVERSATION_REPEATS + 1)) / (float)CONVERSATION_TICK_HZ;
    const size_t mark = text_mark(text);

    text_write(text, "lost ");
    text_write(text, request_name(conversation->master.request.type));
    text_write(text, ": no answer in ");
    text_f32(text, silence_s, 3u);
    text_write(text, " s");
    return text_end_or_rollback(text, mark);
}

bool journal_error(struct text *text, const char *what)
{
    const size_t mark = text_mark(text);

    text_write(text, "error ");
    text_write(text, what);
    text_write(text, ": ");
    text_write(text, orders);
    return text_end_or_rollback(text, mark);
}
