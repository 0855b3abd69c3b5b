#include "render/device/slice_pace.h"

#include <math.h>

/* Weights of a new measurement in the smoothed slowness. When the device becomes slower, submissions are shortened
 * within one or two submissions. When the device becomes faster, submissions are lengthened over some ten of them.
 * This is slow because a submission that is too long does more harm than one that is too short. */
#define FALLS 0.5
#define RISES 0.1

unsigned kd_slice_items(struct kd_slice_pace *pace, double ns, unsigned most)
{
    const double n = KD_SLICE_MS * 1e6 / fmax(pace->slowness, 1) / fmax(ns, 1);
    const unsigned items = n < 1 ? 1 : n > most ? most : (unsigned)n;
    pace->expected_ms = items * ns * 1e-6;
    return items;
}

void kd_slice_begin(struct kd_slice_pace *pace, double now_ms)
{
    pace->begun_ms = now_ms;
    pace->expected_ms = 0;
}

void kd_slice_end(struct kd_slice_pace *pace, double now_ms)
{
    /* submissions with a shorter expected time are not measured: most of it is the cost of the submission itself */
    const double LEAST_MS = 1;
    const double known = fmax(pace->slowness, 1);
    if (!(pace->expected_ms >= LEAST_MS))
        return;
    const double ratio = fmin(fmax((now_ms - pace->begun_ms) / pace->expected_ms, 1), KD_SLOWEST);
    pace->slowness = known + (ratio > known ? FALLS : RISES) * (ratio - known);
}
