/* Result of the self-test: whether a device computes correctly, and how fast it is. The test runs at the first start
 * (selftest/first_start.h), and its result is cached on disk. Only the renderer's thread. */
#ifndef KD_RENDER_DEVICE_VERDICT_H
#define KD_RENDER_DEVICE_VERDICT_H

#include <stdbool.h>

struct kd_capacity;
struct kd_renderer;

struct kd_verdict {
    enum { KD_UNTESTED, KD_PASSED, KD_FAILED } result;
    bool now; /* true: this process ran the test; false: an earlier process did */
    unsigned checks, failed;
    double seconds;  /* duration of the test */
    char worst[160]; /* the first check that failed; "" if none failed */
};

/* Loads the cached verdict on a new renderer's device, and the costs of passes on that device. */
void kd_verdict_recall(struct kd_renderer *renderer);
/* Writes the renderer's verdict. Also writes the costs of passes in `capacity`, if they were measured. */
void kd_verdict_save(const struct kd_renderer *renderer, struct kd_capacity capacity);
/* Stores the present costs of passes for the next start, if the test has passed and a cost has changed by a quarter. */
void kd_verdict_keep(struct kd_renderer *renderer);

/* The verdict on a renderer's device. Belongs to the renderer. */
const struct kd_verdict *kd_renderer_verdict(const struct kd_renderer *renderer);
/* "passed", "failed" or "not run". */
const char *kd_verdict_word(const struct kd_verdict *verdict);

#endif
