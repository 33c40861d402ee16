/* Two ways to share a record larger than a word between an interrupt and main without stopping either.
 *
 * handoff: the latest value. One writer, one reader; the writer may pre-empt the reader at any instant, never the other
 * way round. The writer counts before and after; the reader copies again if the count has moved.
 *
 *     sequence   2n     2n+1            2n+2        odd while the writer is at work; 0 until the first value
 *     writer     rest   copies record   rest
 *
 * publish: a whole configuration, from main to an interrupt. Two buffers; main fills the one that the interrupt does
 * not read, then counts the generation up. The interrupt switches where it likes and echoes what it took; only then
 * does main get the other buffer back. Generation g lies in buffer g & 1.
 *
 *     main       publish_back -> fill -> publish_commit                     publish_back ...
 *     interrupt                                   publish_take (echoes)
 */
#ifndef BASE_HANDOFF_H
#define BASE_HANDOFF_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct handoff {
    void *record;               /* size bytes, owned by the caller */
    size_t size;                /* bytes */
    volatile uint32_t sequence; /* owned by the writer */
};

/* Binds to storage of size bytes; no value yet. [INIT] */
void handoff_init(struct handoff *handoff, void *storage, size_t size);

/* Makes the value at value the latest. Cost: one record copy. [writer, may be an ISR] */
void handoff_write(struct handoff *handoff, const void *value);

/* The same without the copy: the record, to be written into, all of it; then close. [writer] */
void *handoff_open(struct handoff *handoff);
void handoff_close(struct handoff *handoff);

/* Copies the latest value out, all of it from one write. False, and *value as it was, before the first write. Cost: one
 * copy, and one more for each write that came in between. [reader] */
bool handoff_read(const struct handoff *handoff, void *value);

/* Differs after each write: tells a reader whether there is anything new. [reader] */
uint32_t handoff_version(const struct handoff *handoff);

struct publish {
    uint8_t *records;             /* two of record_size bytes, owned by the caller */
    size_t record_size;           /* bytes */
    volatile uint32_t generation; /* committed last, owned by main; 0 before the first */
    volatile uint32_t taken;      /* taken last, owned by the interrupt */
};

/* Binds to storage of two records; nothing published yet. [INIT] */
void publish_init(struct publish *publish, void *storage, size_t record_size);

/* The record to fill, all of it: what it holds is two generations old. NULL while the last one has not been taken.
 * [MAIN] */
void *publish_back(struct publish *publish);

/* Publishes the record from publish_back() and returns its generation, counted from 1. [MAIN] */
uint32_t publish_commit(struct publish *publish);

/* Is there a record that has not been taken? [ANY] */
static inline bool publish_has_new(const struct publish *publish) { return publish->generation != publish->taken; }

/* The new record, which stays untouched until the next one is taken; NULL if there is nothing new. [ISR] */
const void *publish_take(struct publish *publish);

/* The generation that the interrupt took last. [ANY] */
uint32_t publish_taken(const struct publish *publish);

#endif
