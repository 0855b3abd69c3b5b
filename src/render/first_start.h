/* Whether this device computes what it should, and how fast: found out by the self-test (selftest.h) when kerrd meets a device, a
 * version of its driver or one of its own that it has not met before, and kept in the cache folder. Render thread. */
#ifndef KD_RENDER_FIRST_START_H
#define KD_RENDER_FIRST_START_H

#include "base/error.h"

#include <stdbool.h>

struct kd_renderer;

struct kd_first_start {
    enum { KD_UNTESTED, KD_PASSED, KD_FAILED } verdict;
    bool now;                 /* in this process, not in one before */
    unsigned checks, failed;
    double seconds;           /* that it took */
    char worst[160];          /* the first check that failed, "" if none has */
};

/* Of a new renderer: what is known of its device, and what its passes cost when it was last used. */
void kd_first_start_recall(struct kd_renderer *renderer);
/* If nothing is known: test it and measure what passes cost. A check that fails is logged as an error, and tested again at the next
 * start; KD_OK all the same, since the user may know better. An error only where the device is lost. */
enum kd_status kd_first_start(struct kd_renderer *renderer, struct kd_error *error);
/* Keep what a pass costs by now, for the next start. Nothing where nothing is kept. */
void kd_first_start_keep(struct kd_renderer *renderer);

/* What is known of a renderer's device. Belongs to the renderer. */
const struct kd_first_start *kd_renderer_first_start(const struct kd_renderer *renderer);
/* "passed", "failed" or "not run". */
const char *kd_first_start_word(const struct kd_first_start *start);

#endif
