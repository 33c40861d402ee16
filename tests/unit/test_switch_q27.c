/* A step with one switch of regime, made by the short way, against the one that finds any number of them. */
#include "model/event_q27.h"
#include "model/switch_q27.h"
#include "plants.h"
#include "tap.h"
#include "tests.h"

static struct plant plant;

struct tally {
    uint32_t crossings, releases, passages; /* to sticking, from it, through */
    bool are_same;
};

/* Ahead over the whole step without looking for events, as the usual step does. */
static void try_whole(const struct step_q27 *s, const struct step_q27_coeffs *c, struct normal_q27_piece *piece,
                      struct slip_q27_end *end)
{
    const int32_t side = s->mode;
    struct slip_q27_view view = {side * s->x, side * s->v, side * s->disc, 0};

    normal_q27_look(&s->normal, &c->normal, piece, NULL);
    if (side != PLANT_STICK) {
        view.drive = slip_q27_drive(&c->fine, view.disc, NULL);
        slip_q27_any_go(&c->fine, &view, &s->rest, piece, end, false, NULL);
    }
}

static bool are_equal(const struct step_q27 *one, const struct step_q27 *other, const struct plant_notes *notes)
{
    const struct plant_notes noted = one->output.noted;

    return one->x == other->x && one->v == other->v && one->rest.x == other->rest.x && one->rest.v == other->rest.v &&
           one->mode == other->mode && one->normal.y == other->normal.y && one->normal.w == other->normal.w &&
           noted.stick == notes->stick && noted.slip_minus == notes->slip_minus && noted.events == notes->events &&
           noted.is_capped == notes->is_capped && noted.is_lifted == notes->is_lifted;
}

/* Makes the step to come both ways, where the short one serves. */
static void compare(struct tally *tally)
{
    const struct step_q27_coeffs *c = &plant.plan.q27;
    struct step_q27 by_switch = plant.sim.q27;
    struct step_q27 by_events;
    struct event_q27_progress progress = {.contacts = 0u};
    const int8_t before = by_switch.mode;
    struct normal_q27_piece piece;
    struct slip_q27_end end;
    bool is_switch;

    normal_q27_open_step(&by_switch.normal, &c->normal);
    by_events = by_switch;
    try_whole(&by_switch, c, &piece, &end);
    is_switch = before == PLANT_STICK ? switch_q27_release(&by_switch, c, piece.y, piece.w)
                                      : switch_q27_cross(&by_switch, c, piece.y, piece.w, &end);
    if (is_switch) {
        const struct event_q27_attempt attempt = {piece.y, piece.w, before == PLANT_STICK ? NULL : &end};

        event_q27_step(&by_events, c, &progress, &attempt);
        tally->are_same = tally->are_same && are_equal(&by_switch, &by_events, &progress.notes);
        tally->releases += before == PLANT_STICK ? 1u : 0u;
        tally->crossings += by_switch.mode == PLANT_STICK ? 1u : 0u;
        tally->passages += before != PLANT_STICK && by_switch.mode != PLANT_STICK ? 1u : 0u;
    }
}

static struct tally run(const char *assignments)
{
    struct tally tally = {.are_same = true};

    plants_start(&plant, assignments);
    tap_check(plant.plan.q27.reach_max > 0, assignments); /* else the fine arithmetic does not serve it */
    for (uint32_t i = 0u; i < plants_scaled(20000u, 1500u); i++) {
        compare(&tally);
        plants_run_steps(&plant, 1u);
    }
    tap_note_number("events", (float)plant.sim.counters.events);
    return tally;
}

void test_switch_q27(void)
{
    const uint32_t many = plants_scaled(40u, 10u);
    struct tally tally = run("arith q27 N0 10 alpha -0.02 normal exact");

    tap_check(tally.are_same && tally.crossings > many && tally.releases > many, "stick and slip to the bit");
    tally = run("arith q27 N0 5 alpha -0.01 normal rk4 spp 32");
    tap_check(tally.are_same && tally.crossings > many && tally.releases > many, "with few steps too");
    tally = run("arith q27 N0 5 normal exact");
    tap_check(tally.are_same && tally.passages > many / 2u, "a pad that overtakes the disc and falls back");
    tally = run("arith q27 N0 4 v0 0.3 alpha -0.02 load ramp N1 2 t2 30 contact lift normal rk4 xd0 0.9");
    tap_check(tally.are_same && tally.crossings > 0u, "under a falling force");
}
