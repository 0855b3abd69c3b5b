/* Limits the duration of submissions when this device is slow. The costs of passes are measured on an idle device. When
 * other programs use the same cores, or when the measured costs are too low, a submission takes longer than planned.
 * Everybody who waits for the device must then wait for the end of that submission. Pure. */
#ifndef KD_RENDER_DEVICE_SLICE_PACE_H
#define KD_RENDER_DEVICE_SLICE_PACE_H

#define KD_SLICE_MS 40.0 /* time of a submission: short enough for progress, fairness and a driver's watchdog */
/* largest factor by which submissions are shortened; there is a limit because each submission has a fixed cost */
#define KD_SLOWEST 16.0

struct kd_slice_pace { /* initialise to 0 */
    /* measured time of a submission divided by its estimated time, smoothed, 1 to KD_SLOWEST; 0: nothing was measured
     * yet */
    double slowness;
    double expected_ms; /* estimated time of the present submission; 0: unknown */
    double begun_ms;    /* time at which the present submission began */
};

/* Number of items, 1 to `most`, that one submission processes. The time of an item on an idle device is given in
 * nanoseconds. */
unsigned kd_slice_items(struct kd_slice_pace *pace, double ns, unsigned most);
/* Call when work begins, and when it begins again after others had the device. */
void kd_slice_begin(struct kd_slice_pace *pace, double now_ms);
/* Call when all work that was submitted since kd_slice_begin is done. */
void kd_slice_end(struct kd_slice_pace *pace, double now_ms);

#endif
