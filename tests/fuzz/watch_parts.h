/* What the parts of the watch share. Not for anybody else. */
#ifndef FUZZ_WATCH_PARTS_H
#define FUZZ_WATCH_PARTS_H

#include "watch.h"

/* The line of frames, watch_link.c. */
void watch_link_reset(void);
void watch_link_lost(void);
void watch_link_sent(const uint8_t *bytes, size_t size);
uint32_t watch_link_samples(void); /* heard */

/* The line of text, watch_console.c. */
void watch_console_reset(void);
void watch_console_lost(void);
void watch_console_sent(const uint8_t *bytes, size_t size);

/* Nothing is under way. *samples are those heard since the reset; false: an echo made them impossible to tell. */
bool watch_console_end(uint32_t *samples);

#endif
