/* What the files of the feed share. Not for anybody else. */
#ifndef SQUEAL_FEED_PARTS_H
#define SQUEAL_FEED_PARTS_H

#include "squeal/monitor/feed.h"

/* Streams what the picture needs, as the picture's trace has it. */
enum device_result feed_stream(struct feed *feed);

/* What the set in force says about the inputs and about time. */
enum device_result feed_read_set(struct feed *feed, const struct device_status *status);

/* What the device itself says of the motion. One that cannot leaves it to the samples. */
enum device_result feed_look_at_verdict(struct feed *feed);

enum device_result feed_list_presets(struct feed *feed);

#endif
