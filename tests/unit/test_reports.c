/* What the executive tells: late ticks, the stream of samples, a fault, and the scale that a sample belongs to. */
#include "plants.h"
#include "sim/executive.h"
#include "tap.h"
#include "tests.h"

static struct executive executive;
static struct executive_report report;

static const struct executive_report *look(void)
{
    executive_report(&executive, &report);
    return &report;
}

static void check_overrun(void)
{
    plants_executive(&executive, "N0 1");
    executive_begin_rate(&executive, 1000u);
    executive_free_run(&executive);
    plants_ticks(&executive, 10u);
    (void)executive_book(&executive, 700u, 1000u, false);
    (void)executive_book(&executive, 1200u, 1000u, true);
    (void)executive_book(&executive, 100u, 2000u, false);
    plants_ticks(&executive, 2u);
    tap_check(executive.sim.step == 10u && executive.load.shed == 2u && executive.load.ticks == 10u,
              "after a tick of 1.2 periods two are shed");
    plants_ticks(&executive, 1u);
    tap_check(executive.sim.step == 11u && executive.load.shed == 2u, "and only those");
    tap_check(executive.load.overruns == 1u && executive.load.busy_max == 1200u && executive.load.busy_sum == 2000u &&
                  executive.load.elapsed == 4000u && executive.load.period == 1000u,
              "what ticks took is booked");
    (void)executive_book(&executive, 250000u, 250000u, true);
    tap_check(executive.to_shed == 251u, "a tick of 250 periods is followed by 251 that leave the time to main");
    (void)plants_order(&executive, "N0 2", false, NULL);
    executive_tick(&executive, true);
    tap_check(!executive_has_order(&executive) && executive.sim.step == 11u, "a shed tick still takes its order");
}

/* Orders that change neither set nor measurement leave detector and measurement alone. */
static void check_side_orders(void)
{
    plants_executive(&executive, "N0 1");
    executive_free_run(&executive);
    plants_ticks(&executive, 64u * 40u);
    tap_check(executive.sim.detector.verdict.propensity == PROPENSITY_QUIET, "a quiet brake");
    executive_measure(&executive, 1000u);
    plants_ticks(&executive, 10u);
    executive_stream(&executive, 0u);
    plants_ticks(&executive, 10u);
    tap_check(executive.sim.detector.verdict.propensity == PROPENSITY_QUIET && executive.sim.measure.done == 20u,
              "is not asked anew for a measurement or a stream");
    (void)plants_order(&executive, "N0 1.1", false, NULL);
    plants_ticks(&executive, 64u * 34u);
    executive_stream(&executive, 0u);
    plants_ticks(&executive, 10u);
    tap_check(executive.sim.detector.verdict.propensity == PROPENSITY_QUIET && executive.sim.measure.done == 1000u,
              "nor is it after a set");
    plants_ticks(&executive, 100u);
    tap_check(executive.sim.step - look()->now.step < 32u, "a free run reports every 32 ticks");
    (void)plants_order(&executive, "N0 1 spp 128", true, NULL);
    executive_tick(&executive, false);
    tap_check(executive.load.ticks == 0u && look()->load.ticks == 0u, "a reset starts the books again");
}

/* Samples keep their distance over orders that do not concern them. */
static void check_stream_phase(void)
{
    struct sample sample = {0};

    plants_executive(&executive, "N0 1");
    executive_stream(&executive, 10u);
    executive_grant(&executive, 100u);
    plants_ticks(&executive, 5u);
    (void)plants_order(&executive, "N0 1.5", false, NULL);
    plants_ticks(&executive, 5u);
    tap_check(ring_pop(&executive.samples, &sample) && sample.step == 10u, "a set does not shift the stream");
    plants_ticks(&executive, 5u);
    (void)plants_order(&executive, "N0 1.5 spp 128", true, NULL);
    executive_grant(&executive, 100u);
    plants_ticks(&executive, 10u);
    tap_check(ring_pop(&executive.samples, &sample) && sample.step == 10u, "a reset starts it again");
}

static void check_stream(void)
{
    struct sample sample;
    uint64_t expected = 10u;
    bool is_even = true;

    plants_executive(&executive, "N0 5");
    executive_stream(&executive, 10u);
    executive_grant(&executive, 95u);
    plants_spend(&executive);
    while (ring_pop(&executive.samples, &sample)) {
        is_even = is_even && sample.step == expected;
        expected += 10u;
    }
    tap_check(is_even && expected == 100u, "a sample every so many steps, from the order on");
    executive_stream(&executive, 1u);
    executive_grant(&executive, EXECUTIVE_SAMPLES + 88u);
    plants_spend(&executive);
    tap_check(executive.samples.dropped == 88u && ring_fill(&executive.samples) == EXECUTIVE_SAMPLES,
              "a reader that sleeps loses the newest, counted");
    executive_stream(&executive, 0u);
    executive_tick(&executive, false);
    while (ring_pop(&executive.samples, &sample)) {
    }
    executive_grant(&executive, 20u);
    plants_spend(&executive);
    tap_check(!ring_pop(&executive.samples, &sample), "0 ends the stream");
}

static void check_fault(void)
{
    const struct params params = plants_preset("fig7-ke5000", "normal exact");
    struct sample sample = {0};
    uint32_t samples = 0u;
    uint64_t step;
    uint32_t hash;

    plants_executive(&executive, "");
    (void)executive_reset(&executive, &params);
    executive_tick(&executive, false);
    executive_free_run(&executive);
    for (uint32_t i = 0u; i < 100000u && executive.sim.fault == SIM_FAULT_NONE; i++) {
        plants_ticks(&executive, 1u);
    }
    step = executive.sim.step;
    hash = executive.sim.hash;
    tap_check(executive.sim.fault == SIM_FAULT_DOMAIN && look()->now.is_fault == 1u &&
                  executive_propensity(&executive) == PROPENSITY_SQUEAL,
              "a plant that diverges ends in a fault, which is reported at once");
    executive_stream(&executive, 5u);
    plants_ticks(&executive, 50u);
    while (ring_pop(&executive.samples, &sample)) {
        samples += sample.is_fault == 1u && sample.step == step ? 1u : 0u;
    }
    tap_check(samples == 10u && executive.sim.step == step && executive.sim.hash == hash, "it stands, and streams on");
    (void)executive_set(&executive, &params, false, NULL);
    plants_ticks(&executive, 10u);
    tap_check(executive.sim.fault == SIM_FAULT_DOMAIN, "a live set does not leave it");
    plants_executive(&executive, "N0 1");
    executive_grant(&executive, 5u);
    plants_spend(&executive);
    tap_check(executive.sim.fault == SIM_FAULT_NONE && executive.sim.step == 5u &&
                  executive_propensity(&executive) != PROPENSITY_SQUEAL,
              "a reset does");
}

static void check_epochs(void)
{
    struct params params = plants_params("N0 2 normal exact");
    struct sample sample = {0};
    uint8_t first;

    plants_executive(&executive, "N0 1");
    executive_stream(&executive, 1u);
    executive_grant(&executive, 3u);
    plants_spend(&executive);
    (void)executive_reset(&executive, &params);
    executive_grant(&executive, 2u);
    plants_spend(&executive);
    (void)ring_pop(&executive.samples, &sample);
    first = sample.epoch;
    tap_check(executive_scale(&executive, first) != NULL && executive_scale(&executive, first)->load_n == 4.0f,
              "a sample from before a reset finds its scale");
    for (uint32_t i = 0u; i < 3u; i++) {
        (void)ring_pop(&executive.samples, &sample);
    }
    tap_check(sample.epoch == (uint8_t)(first + 1u) && sample.step == 1u && look()->now.epoch == sample.epoch &&
                  executive_scale(&executive, sample.epoch)->load_n == 8.0f,
              "one from after it another");
    params.load_n = 3.0f;
    (void)executive_reset(&executive, &params);
    executive_tick(&executive, false);
    tap_check(executive_scale(&executive, first) == NULL && executive_scale(&executive, sample.epoch)->load_n == 8.0f,
              "older than the reset before last it finds none");
    for (uint32_t i = 0u; i < 256u; i++) {
        (void)executive_reset(&executive, &params);
        executive_tick(&executive, false);
    }
    tap_check(executive_scale(&executive, executive.in_force.epoch)->load_n == 12.0f, "epochs wrap at 256");
}

void test_reports(void)
{
    check_overrun();
    check_side_orders();
    check_stream_phase();
    check_stream();
    check_fault();
    check_epochs();
}
