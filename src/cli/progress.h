/* Progress bar on stderr, and cancellation by Ctrl-C. Main thread only.
 *
 * The bar appears if stderr is a terminal, once the render has lasted half a second. */
#ifndef KD_CLI_PROGRESS_H
#define KD_CLI_PROGRESS_H

#include "base/error.h"

#include <stdbool.h>

struct kd_progress {
    double started, drawn; /* monotonic clock, in s */
    bool terminal, visible;
    unsigned n, done; /* number of parts; number of parts that the caller has finished */
};

/* Begins n parts, such as pictures. From here on the first SIGINT or SIGTERM stops the work through
 * kd_progress_update. A second one kills the process. */
void kd_progress_begin(struct kd_progress *progress, unsigned n);
/* fraction: finished fraction of the current part. May be used as a kd_progress_fn: returns false after a signal. */
bool kd_progress_update(void *progress, double fraction);
void kd_progress_finish(struct kd_progress *progress); /* clears the bar */
/* Clears the bar; exits if the device is lost. Returns the status. */
enum kd_status kd_progress_end(struct kd_progress *progress, enum kd_status status, const struct kd_error *error);

double kd_progress_clock(void); /* monotonic clock, in s */

/* If a signal was caught, kills the process by that signal, as shells expect; otherwise returns. */
void kd_progress_reraise(void);
/* Ends a command. Reports the error and returns the exit code, or kills the process by the signal that stopped the
 * command. */
int kd_progress_exit(enum kd_status status, const struct kd_error *error);

#endif
