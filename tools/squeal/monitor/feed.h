/* Between device and picture: what is seen goes into the picture, what a hand wants goes to the device. Every function
 * that asks the device says DEVICE_LOST if it is gone; a refusal becomes the picture's message. */
#ifndef SQUEAL_FEED_H
#define SQUEAL_FEED_H

#include "squeal/device/device.h"
#include "squeal/monitor/picture.h"

enum { FEED_STEPS_PER_S = 8000 /* where a preset is made to run: what an emulated board can, and an eye can follow */ };

struct feed {
    struct device *device;
    struct picture *picture;
    struct picture_choice *choices;
    bool is_as_is; /* tick and substeps as the sets have them */
    double tick_hz, substeps;
    double reference[PICTURE_INPUTS]; /* values of the inputs in the set that was loaded */
    uint32_t every_wanted;            /* steps between samples; 0: as many as make a good picture */
    uint32_t set_crc;                 /* of the set that the picture shows */
    uint32_t offered, dropped;        /* when it was last asked whether the link carries them all */
    int params[PICTURE_INPUTS];       /* behind the inputs */
    unsigned question;                /* which is next */
    bool lacks_verdict;               /* an older device, which measures nothing by itself */
    double pace_s;                    /* since when the pace is measured, and from which step */
    uint64_t pace_step;
    double message_s; /* when the message came */
};

/* Reads the tables, begins to stream. preset: to be loaded and run; NULL: if the device stands at step 0, the first
 * brake there is, unless as_is. */
enum device_result feed_open(struct feed *feed, struct device *device, struct picture *picture, const char *preset,
                             bool is_as_is);
void feed_close(struct feed *feed);

/* Looks at something of what does not come by itself; once a frame. One question at a time: a slow device keeps no
 * frame waiting for long. */
enum device_result feed_look(struct feed *feed);

enum device_result feed_run_or_stop(struct feed *feed);
enum device_result feed_reset(struct feed *feed);
enum device_result feed_preset(struct feed *feed, size_t preset);

/* Turns an input by so many clicks. */
enum device_result feed_turn(struct feed *feed, size_t input, int clicks);

/* Twice as many steps a second, or half as many. */
enum device_result feed_pace(struct feed *feed, bool is_faster);

/* Half as many samples, or twice as many. */
enum device_result feed_thin(struct feed *feed, bool is_thinner);

/* A refusal becomes the message; the rest is handed on. */
enum device_result feed_settle(struct feed *feed, enum device_result result);

/* A line for the person, for a while. */
void feed_say(struct feed *feed, bool is_refusal, const char *format, ...) __attribute__((format(printf, 3, 4)));

#endif
