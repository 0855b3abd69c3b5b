/* How long a submission may be on this device at present. The costs of passes are those of an idle device. Where other
 * programs have the same cores, or the costs are too low, a submission takes longer, and whoever waits for the device
 * waits for its end. Pure. */
#ifndef KD_RENDER_DEVICE_SLICE_PACE_H
#define KD_RENDER_DEVICE_SLICE_PACE_H

#define KD_SLICE_MS 40.0 /* time of a submission: short enough for progress, fairness and a driver's watchdog */
#define KD_SLOWEST 16.0  /* submissions are not made shorter than by this factor, because each has a cost of its own */

struct kd_slice_pace {  /* initialise to 0 */
    double slowness;    /* time of a submission over its estimate, smoothed, 1 to KD_SLOWEST; 0: none yet */
    double expected_ms; /* estimated time of the present submission; 0: unknown */
    double begun_ms;    /* when that was begun */
};

/* The number of items, 1 to `most`, that one submission processes, given nanoseconds an item on an idle device. */
unsigned kd_slice_items(struct kd_slice_pace *pace, double ns, unsigned most);
/* Work begins, or begins again after others had the device. */
void kd_slice_begin(struct kd_slice_pace *pace, double now_ms);
/* All that was submitted since kd_slice_begin is done. */
void kd_slice_end(struct kd_slice_pace *pace, double now_ms);

#endif
