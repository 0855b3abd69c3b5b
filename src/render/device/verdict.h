/* Result of the self-test: whether a device computes correctly, and how fast it is. It runs at the first start
 * (selftest/first_start.h) and is cached on disk. Thread of the renderer. */
#ifndef KD_RENDER_DEVICE_VERDICT_H
#define KD_RENDER_DEVICE_VERDICT_H

#include <stdbool.h>

struct kd_capacity;
struct kd_renderer;

struct kd_verdict {
    enum { KD_UNTESTED, KD_PASSED, KD_FAILED } result;
    bool now; /* in this process, not in one before */
    unsigned checks, failed;
    double seconds;  /* that it took */
    char worst[160]; /* the first check that failed, "" if none has */
};

/* A new renderer is told what is known of its device, and what its passes cost when it was last used. */
void kd_verdict_recall(struct kd_renderer *renderer);
/* Write the renderer's verdict, with the costs of this capacity if they were measured. */
void kd_verdict_save(const struct kd_renderer *renderer, struct kd_capacity capacity);
/* Keep what a pass costs by now, for the next start. Nothing where nothing is kept. */
void kd_verdict_keep(struct kd_renderer *renderer);

/* What is known of a renderer's device. Belongs to the renderer. */
const struct kd_verdict *kd_renderer_verdict(const struct kd_renderer *renderer);
/* "passed", "failed" or "not run". */
const char *kd_verdict_word(const struct kd_verdict *verdict);

#endif
