#include "cli/selftest.h"

#include "base/json.h"
#include "cli/cli.h"
#include "cli/progress.h"
#include "render/selftest/selftest.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

struct report {
    struct kd_json *rows; /* NULL if the output is text */
    unsigned checks, failed, compared;
    double nearest; /* largest ratio of error to bound of all checks that passed */
    char nearest_what[128];
};

static void print_row(const struct kd_selftest_row *row)
{
    printf("%-4s  %-60s %-17s %8.1e %8.1e  %s\n", row->ok ? "ok" : "FAIL", row->what, row->by, row->error, row->bound,
           row->source);
}

static void add_row(struct kd_json *rows, const struct kd_selftest_row *row)
{
    kd_json_object(rows, NULL);
    kd_json_string(rows, "what", row->what);
    kd_json_string(rows, "by", row->by);
    kd_json_number(rows, "compared", row->compared);
    if (isfinite(row->error)) /* left out if it is infinite or NaN, as in all JSON of kerrd */
        kd_json_number(rows, "error", row->error);
    kd_json_number(rows, "bound", row->bound);
    kd_json_bool(rows, "ok", row->ok);
    kd_json_string(rows, "source", row->source);
    kd_json_end(rows);
}

static bool report(void *user, const struct kd_selftest_row *row)
{
    struct report *r = user;
    r->checks++;
    r->failed += !row->ok;
    r->compared += row->compared;
    if (row->ok && row->bound > 0 && row->error / row->bound > r->nearest) {
        r->nearest = row->error / row->bound;
        snprintf(r->nearest_what, sizeof r->nearest_what, "%s, %s", row->what, row->by);
    }
    if (r->rows)
        add_row(r->rows, row);
    else
        print_row(row);
    if (fflush(stdout))
        kd_cli_stdout_failed(errno); /* the failure is reported here, while errno still holds the reason */
    return true;
}

static void print_summary(const struct report *r, const char *device, bool float64, double seconds)
{
    if (!float64)
        printf("skipped: %s has no double precision\n", device);
    printf("selftest: %u checks of %u numbers in %.1f s on %s: ", r->checks, r->compared, seconds, device);
    if (r->failed)
        printf("%u FAILED\n", r->failed);
    else
        printf("all ok; the closest to its bound, at %.0f %% of it, is %s\n", 100 * r->nearest, r->nearest_what);
}

static enum kd_status table_json(struct report *r, const char *device, bool float64, double seconds,
                                 struct kd_buffer *out)
{
    struct kd_json whole = kd_json_begin(out), *json = &whole;
    kd_json_end(r->rows);
    enum kd_status status = kd_json_finish(r->rows);
    if (status)
        return status;
    kd_json_object(json, NULL);
    kd_json_string(json, "kerrd", KD_VERSION);
    kd_json_string(json, "device", device);
    kd_json_bool(json, "ok", r->failed == 0);
    kd_json_number(json, "checks", r->checks);
    kd_json_number(json, "failed", r->failed);
    kd_json_number(json, "compared", r->compared);
    kd_json_number(json, "seconds", seconds);
    kd_json_bool(json, "float64", float64);
    kd_json_raw(json, "rows", (const char *)r->rows->out->data, r->rows->out->size);
    kd_json_end(json);
    return kd_json_finish_line(json);
}

static enum kd_status print_json(struct report *r, const char *device, bool float64, double seconds,
                                 struct kd_error *error)
{
    struct kd_buffer text = { 0 };
    enum kd_status status = table_json(r, device, float64, seconds, &text);
    if (status)
        kd_error_set(error, status, "out of memory for the table");
    else
        fwrite(text.data, 1, text.size, stdout);
    kd_buffer_finish(&text);
    return status;
}

enum kd_status kd_cli_selftest(const char *device, bool json, unsigned *failed, struct kd_error *error)
{
    struct kd_buffer text = { 0 };
    struct kd_json rows = kd_json_begin(&text);
    struct report r = { .rows = json ? &rows : NULL };
    struct kd_renderer *renderer = NULL;
    struct kd_capacity capacity = { 0 };
    double started = kd_progress_clock();
    kd_json_array(&rows, NULL);
    enum kd_status status = kd_renderer_create(&(struct kd_renderer_params) { .device = device }, &renderer, error);
    if (!status) {
        kd_renderer_capacity(renderer, &capacity);
        if (!json)
            printf("%-4s  %-60s %-17s %8s %8s  %s\n", "", "what", "by", "error", "bound", "reference");
        status = kd_selftest_run(renderer, &kd_selftest_reference, report, &r, error);
    }
    if (status == KD_EDEVICE && renderer)
        kd_cli_device_lost(error);
    double seconds = kd_progress_clock() - started;
    if (!status && json)
        status = print_json(&r, kd_renderer_device_name(renderer), capacity.float64, seconds, error);
    else if (!status)
        print_summary(&r, kd_renderer_device_name(renderer), capacity.float64, seconds);
    kd_buffer_finish(&text);
    kd_renderer_destroy(renderer);
    *failed = r.failed;
    return status;
}
