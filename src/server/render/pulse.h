/* A watchdog, which distinguishes a thread that works from one that hangs in a call. The thread beats when it makes
 * progress. An observer checks the age of the last beat several times a second. If the observer itself did not run
 * for a while, because the process was stopped or the machine was suspended, that time counts as at most one
 * submission deadline. Any thread may beat. */
#ifndef KD_SERVER_RENDER_PULSE_H
#define KD_SERVER_RENDER_PULSE_H

#include "base/clock.h"

#include <stdatomic.h>
#include <stdint.h>

#define KD_DEADLINE_MS 60000u /* default deadline of a submission to the device, in ms (vk/vk.h) */
/* A thread counts as hanging after this number of submission deadlines without a beat. On a busy machine a
 * submission may take eight of them; the ninth is a margin. */
#define KD_PULSE_DEADLINES 9

struct kd_pulse {
    _Atomic int64_t beat_ms; /* time of the last beat; 0: the thread is idle */
    /* for the observer: the last beat that it has seen, the time of its last check, and the time for which the beat
     * has not changed */
    int64_t seen_ms, looked_ms, missing_ms;
};

static inline void kd_pulse_beat(struct kd_pulse *pulse) { atomic_store(&pulse->beat_ms, (int64_t)kd_clock_ms() + 1); }
static inline void kd_pulse_rest(struct kd_pulse *pulse) { atomic_store(&pulse->beat_ms, 0); }

/* Returns the number of seconds since the last beat if this exceeds KD_PULSE_DEADLINES submission deadlines, and
 * otherwise 0. deadline_ms 0 stands for KD_DEADLINE_MS. */
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
