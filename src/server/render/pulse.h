/* Watchdog: tells a thread that is working from one that hangs in a call. The worker beats when it makes progress; an
 * observer checks the age of the last beat several times a second. A period in which the observer itself did not run,
 * as when the process was stopped or the machine slept, counts as one submission deadline at most. Any thread may
 * beat. */
#ifndef KD_SERVER_RENDER_PULSE_H
#define KD_SERVER_RENDER_PULSE_H

#include "base/clock.h"

#include <stdatomic.h>
#include <stdint.h>

#define KD_DEADLINE_MS 60000u /* of a submission, if none is set (vk/vk.h) */
/* deadlines without a beat after which a thread counts as hanging: eight for a submission on a busy machine, and one
 * more */
#define KD_PULSE_DEADLINES 9

struct kd_pulse {
    _Atomic int64_t beat_ms; /* 0: the thread is idle */
    /* the observer's: last beat seen, time of the last check, and how long the beat has not changed */
    int64_t seen_ms, looked_ms, missing_ms;
};

static inline void kd_pulse_beat(struct kd_pulse *pulse) { atomic_store(&pulse->beat_ms, (int64_t)kd_clock_ms() + 1); }
static inline void kd_pulse_rest(struct kd_pulse *pulse) { atomic_store(&pulse->beat_ms, 0); }

/* Returns the seconds since the last beat if they exceed KD_PULSE_DEADLINES submission deadlines (0: KD_DEADLINE_MS);
 * else 0. */
static inline double kd_pulse_missing_s(struct kd_pulse *pulse, uint32_t deadline_ms)
{
    const int64_t beat = atomic_load(&pulse->beat_ms), now = (int64_t)kd_clock_ms(),
                  deadline = deadline_ms ? deadline_ms : KD_DEADLINE_MS;
    const int64_t since = now - pulse->looked_ms;
    pulse->missing_ms = beat && beat == pulse->seen_ms ? pulse->missing_ms + (since < deadline ? since : deadline) : 0;
    pulse->seen_ms = beat;
    pulse->looked_ms = now;
    return pulse->missing_ms > KD_PULSE_DEADLINES * deadline ? 1e-3 * (double)pulse->missing_ms : 0;
}

#endif
