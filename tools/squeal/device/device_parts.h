/* What the parts of a device share. Not for anybody else. */
#ifndef SQUEAL_DEVICE_PARTS_H
#define SQUEAL_DEVICE_PARTS_H

#include "base/bytes.h"
#include "squeal/device/device.h"
#include "squeal/port/port.h"

enum { DEVICE_OUT_SIZE = 2048 /* a power of two, some frames */ };

struct device {
    struct port port;
    struct master master;
    struct text out;
    uint8_t out_bytes[DEVICE_OUT_SIZE];
    uint8_t reply[FRAME_PAYLOAD_MAX];
    double limit_s;
    double heard_s;       /* when the last frame came */
    size_t heard;         /* bytes that came, frames or not */
    uint64_t step;        /* where the plant was, in the last answer that said so in full */
    uint64_t steps_a_ask; /* what the device makes in a moment, so that a long STEP is cut into parts */

    struct device_identity identity;
    size_t counts[LINK_TABLE_COUNT];             /* of rows, by HELLO or by the table's first row */
    struct device_row *tables[LINK_TABLE_COUNT]; /* NULL: not read yet */

    int signals[DEVICE_SIGNALS_MAX]; /* of the stream, in the order of their bits */
    size_t signal_count;             /* 0: no stream */
    uint16_t sample_sequence;        /* of the next one, if none gets lost */
    device_listener listener;
    void *context;

    struct device_study study;
    bool is_studying;
    uint16_t study_sequence; /* of its request, and of all that comes of it */

    struct master_refusal refusal;
    char problem[DEVICE_PROBLEM_MAX];
    bool is_lost;
};

/* Asks and waits. The fields of the reply, whose length has been checked, are in *reply; it may be NULL. */
enum device_result device_ask(struct device *device, enum link_message type, const struct bytes_writer *request,
                              struct bytes_reader *reply);

/* The same for STEP. */
enum device_result device_ask_step(struct device *device, uint32_t count, const struct input_demand *demand,
                                   struct master_state *state);

/* "<port>: <words>" into the problem. */
void device_fail(struct device *device, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* The refusal into words. */
void device_tell_refusal(struct device *device);

/* A text of width bytes, made printable. */
void device_get_text(struct bytes_reader *reader, char *out, size_t width);

/* What a word means as a signal: a float, or bits as a whole number. */
double device_number(const struct device *device, int signal, uint32_t word);

/* A frame that came by itself. */
void device_take_sample(struct device *device, const struct frame *frame);

void device_take_result(struct device *device, const struct frame *frame);

/* The whole step counter behind its low word: the one nearest to where the plant was last. */
uint64_t device_step_of(const struct device *device, uint32_t low);

#endif
