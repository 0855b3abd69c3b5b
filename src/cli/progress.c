#include "cli/progress.h"

#include "base/clock.h"
#include "cli/cli.h"

#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#define QUIET_S 0.5 /* time in s after which the bar appears */
#define REDRAW_S 0.1
#define CELLS 30

static volatile sig_atomic_t caught;

double kd_progress_clock(void) { return 1e-3 * kd_clock_ms(); }

static void draw(double fraction, double elapsed)
{
    char bar[CELLS + 1];
    int full = (int)(fraction * CELLS);
    memset(bar, '.', CELLS);
    memset(bar, '#', (size_t)full);
    bar[CELLS] = 0;
    fprintf(stderr, "\r\033[K[%s] %3.0f %%", bar, 100 * fraction);
    if (fraction > 0.05) /* for smaller fractions, the estimate of the remaining time is too inaccurate */
        fprintf(stderr, "  %.0f s left", elapsed * (1 - fraction) / fraction);
    fflush(stderr);
}

bool kd_progress_update(void *user, double fraction)
{
    struct kd_progress *progress = user;
    double now = kd_progress_clock();
    fraction = (progress->done + fraction) / progress->n;
    if (progress->terminal && now - progress->started > QUIET_S && now - progress->drawn > REDRAW_S) {
        draw(fraction < 0 ? 0 : fraction > 1 ? 1 : fraction, now - progress->started);
        progress->drawn = now;
        progress->visible = true;
    }
    return !caught;
}

void kd_progress_finish(struct kd_progress *progress)
{
    if (progress->visible)
        fputs("\r\033[K", stderr);
    progress->visible = false;
}

enum kd_status kd_progress_end(struct kd_progress *progress, enum kd_status status, const struct kd_error *error)
{
    kd_progress_finish(progress);
    if (status == KD_EDEVICE)
        kd_cli_device_lost(error);
    return status;
}

static void on_signal(int number) { caught = number; }

void kd_progress_begin(struct kd_progress *progress, unsigned n)
{
    struct sigaction action = { .sa_handler = on_signal, .sa_flags = (int)SA_RESETHAND };
    *progress = (struct kd_progress) { .started = kd_progress_clock(), .terminal = isatty(STDERR_FILENO), .n = n };
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
}

void kd_progress_reraise(void)
{
    if (caught) {
        signal(caught, SIG_DFL);
        raise(caught);
    }
}

int kd_progress_exit(enum kd_status status, const struct kd_error *error)
{
    int code = status ? kd_cli_fail(error) : KD_EXIT_OK;
    if (status == KD_ECANCELLED)
        kd_progress_reraise();
    return code;
}
