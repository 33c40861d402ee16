/* Counts the instructions of the firmware's functions on the device, by the free-running clock under an emulator that
 * takes the same time for every instruction. What a count of the clock is worth is for the runner to say:
 * tests/bench/target.py.
 *
 * Lines, blanks between:
 *   clock HZ
 *   count VARIANT ARITH PART CALLS COUNTS WORST    PART: all, slip, stick, or so many events in the step
 *   memory VARIANT ARITH FUNCTION STACK_BYTES
 *   place VARIANT ARITH X_M                        of the pad after the last call
 *   end */
#include "app/isr.h"
#include "base/compiler.h"
#include "base/decimal.h"
#include "base/mem.h"
#include "hal_board.h"
#include "hal_tick.h"
#include "sim/executive.h"
#include "subjects.h"

enum {
    CALLS_TO_NOTHING = 16,
    PAINT = 0xA5,
    TICK_HZ = 100,       /* slow beside any handler, whatever an instruction takes */
    TICKS_AT_ONCE = 256, /* fit the ring of samples */
    TICKS = 8 * TICKS_AT_ONCE
};

enum part { PART_ALL, PART_SLIP, PART_STICK, PART_ONE, PART_TWO, PART_THREE, PART_COUNT };

static const char *const part_names[PART_COUNT] = {"all", "slip", "stick", "1", "2", "3"};

struct tally {
    uint32_t calls, worst;
    uint64_t sum;
};

static struct tally tallies[PART_COUNT];

/* --- Words -------------------------------------------------------------------------------------------------------- */

static void write_text(const char *text)
{
    while (*text != '\0') {
        hal_board_panic_write(*text++);
    }
}

static void write_number(uint64_t value)
{
    char digits[DECIMAL_SIZE_MAX];

    (void)decimal_format_u64(value, digits);
    write_text(" ");
    write_text(digits);
}

static void begin_line(const char *kind, const char *name, const char *arith)
{
    write_text(kind);
    write_text(" ");
    write_text(name);
    write_text(" ");
    write_text(arith);
}

static void write_tallies(const char *name, const char *arith)
{
    for (int part = 0; part < PART_COUNT; part++) {
        const struct tally *tally = &tallies[part];

        if (tally->calls != 0u) {
            begin_line("count", name, arith);
            write_text(" ");
            write_text(part_names[part]);
            write_number(tally->calls);
            write_number(tally->sum);
            write_number(tally->worst);
            write_text("\r\n");
        }
    }
}

static void write_memory(const char *name, const char *arith, const char *function, uint32_t stack)
{
    begin_line("memory", name, arith);
    write_text(" ");
    write_text(function);
    write_number(stack);
    write_text("\r\n");
}

/* --- Counting ----------------------------------------------------------------------------------------------------- */

static void book(enum part part, uint32_t counts)
{
    struct tally *tally = &tallies[part];

    tally->calls++;
    tally->sum += counts;
    tally->worst = counts > tally->worst ? counts : tally->worst;
}

static uint32_t time_call(const struct subject *subject)
{
    const uint32_t start = hal_clock_now();

    subject->call();
    return hal_clock_now() - start;
}

/* The clock's own reading and the way to the function. */
static uint32_t time_nothing(const struct subject *subject)
{
    uint32_t least = UINT32_MAX;

    subject->aim(true);
    for (int i = 0; i < CALLS_TO_NOTHING; i++) {
        const uint32_t counts = time_call(subject);

        least = counts < least ? counts : least;
    }
    return least;
}

static enum part part_of(const struct plant_output *output)
{
    const unsigned events = plant_notes(output).events;

    return events != 0u                  ? (enum part)(PART_ONE + (events < 3u ? events : 3u) - 1u)
           : output->mode == PLANT_STICK ? PART_STICK
                                         : PART_SLIP;
}

/* --- Stack -------------------------------------------------------------------------------------------------------- */

extern uint8_t ld_stack_bottom[];

/* Marks all of the stack below the caller's frame, and returns where that ends. */
static BASE_NOINLINE uintptr_t paint(void)
{
    const uintptr_t top = (uintptr_t)__builtin_frame_address(0) - 4u * sizeof(uintptr_t);

    for (volatile uint8_t *at = ld_stack_bottom; (uintptr_t)at < top; at++) {
        *at = PAINT;
    }
    return top;
}

/* How far below it something has been written since. */
static uint32_t depth(uintptr_t top)
{
    const uint8_t *at = ld_stack_bottom;

    while ((uintptr_t)at < top && *at == PAINT) {
        at++;
    }
    return (uint32_t)(top - (uintptr_t)at);
}

/* --- Subjects ----------------------------------------------------------------------------------------------------- */

static void measure(const struct subject *subject)
{
    uint32_t nothing;
    char digits[DECIMAL_SIZE_MAX];
    uintptr_t top;

    memset(tallies, 0, sizeof tallies);
    subject->start(subject);
    nothing = time_nothing(subject);
    subject->aim(false);
    top = paint();
    for (uint32_t i = 0u; i < subject->calls; i++) {
        uint32_t counts;

        if (subject->prepare != NULL) {
            subject->prepare();
        }
        counts = time_call(subject) - nothing;
        book(PART_ALL, counts);
        if (subject->displacement != NULL) {
            book(part_of(subjects_output()), counts);
        }
    }
    write_memory(subject->name, subject->arith, subject->function, depth(top));
    write_tallies(subject->name, subject->arith);
    if (subject->displacement != NULL) {
        (void)decimal_format_f32(subject->displacement(), 9u, digits);
        begin_line("place", subject->name, subject->arith);
        write_text(" ");
        write_text(digits);
        write_text("\r\n");
    }
}

/* --- The interrupt as a whole ------------------------------------------------------------------------------------- */

/* Main does nothing but look at the clock: what is missing between two looks went to the interrupt. */
static void watch(uint32_t ticks)
{
    uint32_t last = hal_clock_now();
    uint32_t quiet = 0u;

    while (ticks > 0u) {
        const uint32_t now = hal_clock_now();
        const uint32_t passed = now - last;

        last = now;
        if (quiet != 0u && passed > 2u * quiet) {
            book(PART_ALL, passed - quiet);
            ticks--;
            last = hal_clock_now();
        } else {
            quiet = passed;
        }
    }
}

static void measure_interrupt(const char *arith, const char *name, uint32_t sample_every)
{
    struct executive *executive = subjects_executive("N0 10 alpha -0.02 normal exact tick 100", arith, sample_every);
    struct sample sample;
    uintptr_t top;

    memset(tallies, 0, sizeof tallies);
    isr_init(executive);
    top = paint();
    isr_follow();
    for (int i = 0; i < TICKS / TICKS_AT_ONCE; i++) {
        watch(TICKS_AT_ONCE);
        while (ring_pop(&executive->samples, &sample)) {
        }
    }
    hal_tick_stop();
    write_memory(name, arith, "app_tick", depth(top));
    write_tallies(name, arith);
}

int main(void)
{
    write_text("clock");
    write_number(hal_clock_hz());
    write_text("\r\n");
    for (uint32_t i = 0u; i < subjects_count; i++) {
        measure(&subjects[i]);
    }
    for (int i = 0; i < 2; i++) {
        const char *const arith = i == 0 ? "f32" : "q27";

        measure_interrupt(arith, "isr-total", 1u);
        measure_interrupt(arith, "isr-unsampled", 0u);
    }
    write_text("end\r\n");
    return 0;
}
