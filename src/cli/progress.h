/* Progress bar on stderr, and cancellation by Ctrl-C. Main thread only. The bar appears when the render has lasted
 * half a second, if stderr is a terminal. */
#ifndef KD_CLI_PROGRESS_H
#define KD_CLI_PROGRESS_H

#include "base/error.h"

#include <stdbool.h>

struct kd_progress {
    double started, drawn; /* started: time of the start; drawn: time of the last redraw; in s on the monotonic clock */
    bool terminal, visible;
    unsigned n, done; /* n: number of parts; done: number of finished parts */
};

/* Begins work of n parts, such as pictures. From this call on, the first SIGINT or SIGTERM stops the work through
 * kd_progress_update, and a second signal kills the process. */
void kd_progress_begin(struct kd_progress *progress, unsigned n);
/* fraction: finished fraction of the current part. The function has the type kd_progress_fn and returns false after
 * a signal. */
bool kd_progress_update(void *progress, double fraction);
void kd_progress_finish(struct kd_progress *progress); /* clears the bar */
/* Clears the bar. If the device is lost, exits; otherwise returns the status. */
enum kd_status kd_progress_end(struct kd_progress *progress, enum kd_status status, const struct kd_error *error);

double kd_progress_clock(void); /* monotonic clock, in s */

/* If a signal was caught, kills the process by the same signal, as shells expect. Otherwise returns. */
void kd_progress_reraise(void);
/* Ends a command. If a signal stopped the command, kills the process by this signal. Otherwise reports the error and
 * returns the exit code. */
int kd_progress_exit(enum kd_status status, const struct kd_error *error);

#endif
