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
};

void kd_progress_init(struct kd_progress *progress);
bool kd_progress_update(void *progress, double fraction); /* a kd_progress_fn: returns false after a signal */
void kd_progress_finish(struct kd_progress *progress);    /* clears the bar */

double kd_progress_clock(void); /* monotonic clock, in s */

/* After this call the first SIGINT or SIGTERM stops the render through kd_progress_update. A second one kills the
 * process. */
void kd_progress_catch_signals(void);
/* If a signal was caught, kills the process by that signal, as shells expect; otherwise returns. */
void kd_progress_reraise(void);
/* Ends a command. Reports the error and returns the exit code, or kills the process by the signal that stopped it. */
int kd_progress_exit(enum kd_status status, const struct kd_error *error);

#endif
