/* Draws a progress bar on stderr, and stops a render on Ctrl-C. Main thread only.
 *
 * The bar appears when stderr is a terminal and the render has lasted half a second; a quick render
 * prints nothing. */
#ifndef KD_CLI_PROGRESS_H
#define KD_CLI_PROGRESS_H

#include "base/error.h"

#include <stdbool.h>

struct kd_progress {
    double started, drawn; /* seconds of the monotonic clock */
    bool terminal, visible;
};

void kd_progress_init(struct kd_progress *progress);
bool kd_progress_update(void *progress, double fraction); /* a kd_progress_fn: false after a signal */
void kd_progress_finish(struct kd_progress *progress);    /* clears the bar */

double kd_progress_clock(void); /* seconds, monotonic */

/* From now on the first SIGINT or SIGTERM stops the render through kd_progress_update; a second one kills. */
void kd_progress_catch_signals(void);
/* Die of the signal that was caught, as the shell expects; returns if there was none. */
void kd_progress_reraise(void);
/* The exit code of a command that a signal may have stopped: it has said what failed, and dies of the signal if that
 * was it. */
int kd_progress_exit(enum kd_status status, const struct kd_error *error);

#endif
