/* The image: head, set, run, CRC. */
#include "sim/snapshot.h"

#include "base/assert.h"
#include "base/crc32.h"
#include "sim/snapshot_parts.h"

enum { CRC_SIZE = 4, CRC_AT = SNAPSHOT_SIZE - CRC_SIZE };

void snapshot_take(uint8_t image[SNAPSHOT_SIZE], const struct sim *sim, const struct input_queue *waiting)
{
    struct bytes_writer writer = {.bytes = image, .capacity = SNAPSHOT_SIZE};
    struct snapshot_walk walk = {.writer = &writer};
    struct params params = sim->plan->params;
    struct scale scale = sim->plan->scale;

    BASE_ASSERT(sim->fault == SIM_FAULT_NONE);
    bytes_put_u16(&writer, SNAPSHOT_LAYOUT);
    bytes_put_u16(&writer, PARAMS_VERSION);
    snapshot_walk_set(&walk, &params, &scale);
    /* A walk with a writer changes nothing. */
    snapshot_walk_run(&walk, (struct sim *)sim, (struct input_queue *)waiting);
    BASE_ASSERT(writer.size == CRC_AT);
    bytes_put_u32(&writer, crc32_add(0u, image, CRC_AT));
}

static struct bytes_reader reader_of(const uint8_t image[SNAPSHOT_SIZE])
{
    return (struct bytes_reader){.bytes = image, .size = CRC_AT};
}

/* Reads the head; false if it is not ours. */
static bool read_head(struct bytes_reader *reader)
{
    const uint16_t layout = bytes_get_u16(reader);

    return bytes_get_u16(reader) == PARAMS_VERSION && layout == SNAPSHOT_LAYOUT;
}

struct params_problem snapshot_check(const uint8_t image[SNAPSHOT_SIZE], struct sim_plan *plan)
{
    struct bytes_reader reader = reader_of(image);
    struct bytes_reader crc = {.bytes = image + CRC_AT, .size = CRC_SIZE};
    struct snapshot_walk walk = {.reader = &reader};
    struct params_problem problem = {ERROR_OK, NULL, 0.0f, 0.0f};
    struct input_queue waiting;
    struct sim sim = {0};
    struct params params = {0};
    struct scale latched;

    if (bytes_get_u32(&crc) != crc32_add(0u, image, CRC_AT)) {
        problem.error = ERROR_WRONG_CRC;
        return problem;
    }
    if (!read_head(&reader)) {
        problem.error = ERROR_WRONG_LAYOUT;
        return problem;
    }
    snapshot_walk_set(&walk, &params, &latched);
    snapshot_walk_run(&walk, &sim, &waiting);
    if (walk.is_bad || !bytes_is_spent(&reader) || !(latched.load_n > 0.0f) || !(latched.speed_m_per_s > 0.0f) ||
        latched.length_shift > SCALE_LENGTH_SHIFT_MAX) {
        problem.error = ERROR_OUT_OF_RANGE;
        return problem;
    }
    problem = sim_plan_make(plan, &params, &latched);
    if (problem.error == ERROR_OK && !snapshot_is_sound(&sim, &waiting, plan)) {
        problem.error = ERROR_OUT_OF_RANGE;
    }
    return problem;
}

void snapshot_restore(const uint8_t image[SNAPSHOT_SIZE], struct sim *sim, struct input_queue *waiting)
{
    struct bytes_reader reader = reader_of(image);
    struct snapshot_walk walk = {.reader = &reader};
    struct params params = {0};
    struct scale latched;

    (void)read_head(&reader);
    snapshot_walk_set(&walk, &params, &latched);
    snapshot_walk_run(&walk, sim, waiting);
}
