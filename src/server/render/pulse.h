/* A pulse tells a thread that works from one that hangs in a call which does not return: it beats whenever the work has come on, and somebody else looks
 * how long ago that was. Any thread. */
#ifndef KD_SERVER_RENDER_PULSE_H
#define KD_SERVER_RENDER_PULSE_H

#include "base/clock.h"

#include <stdatomic.h>
#include <stdint.h>

#define KD_DEADLINE_MS 60000u /* of a submission, where none is given (vk/vk.h) */
#define KD_PULSE_DEADLINES 9  /* without a beat, and a thread counts as hanging: what a submission may take on a busy machine, and one more */

struct kd_pulse { _Atomic int64_t beat_ms; }; /* 0: it rests */

static inline void kd_pulse_beat(struct kd_pulse *pulse) { atomic_store(&pulse->beat_ms, (int64_t)kd_clock_ms() + 1); }
static inline void kd_pulse_rest(struct kd_pulse *pulse) { atomic_store(&pulse->beat_ms, 0); }

/* Seconds since the last beat, once they are too many by the deadline of submissions (0: KD_DEADLINE_MS); else 0. */
static inline double kd_pulse_missing_s(struct kd_pulse *pulse, uint32_t deadline_ms)
{
    const int64_t beat = atomic_load(&pulse->beat_ms), most = (int64_t)KD_PULSE_DEADLINES * (deadline_ms ? deadline_ms : KD_DEADLINE_MS);
    const double since = kd_clock_ms() - (double)beat;
    return beat && since > (double)most ? 1e-3 * since : 0;
}

#endif
