/* Waiting times of work, and durations of rendering passes, for /metrics. Any thread. */
#ifndef KD_SERVER_RENDER_MEASURES_H
#define KD_SERVER_RENDER_MEASURES_H

#include "render/frame/frame.h"
#include "server/http/histogram.h"
#include "server/http/shares.h"

/* Timings of a frame besides the passes of render/plan/pass.h: additional steps, encoding, and "other" for passes with
 * unknown names. */
#define KD_MEASURED_ALSO(M) M("kernels") M("upload") M("fill") M("total") M("encode") M("other")
#define KD_MEASURED_ONE(name) +1
enum { KD_MEASURED_PASSES = KD_PASS_COUNT KD_MEASURED_ALSO(KD_MEASURED_ONE) };

struct kd_render_measures { /* initialise to 0 */
    struct kd_histogram passes[KD_MEASURED_PASSES], waits[KD_N_CLASSES];
};

/* These functions record the duration of a rendered picture, the duration of an encoding, and the time for which
 * finished work had waited while others used the device. */
void kd_render_measures_frame(struct kd_render_measures *measures, const struct kd_frame *frame);
void kd_render_measures_encoded(struct kd_render_measures *measures, double ms);
void kd_render_measures_waited(struct kd_render_measures *measures, enum kd_class class, double ms);

/* Writes kerrd_pass_seconds and kerrd_queue_wait_seconds, without empty histograms. */
enum kd_status kd_render_measures_write(const struct kd_render_measures *measures, struct kd_buffer *out);

#endif
