#include "cli/selftest.h"

#include "cli/cli.h"
#include "cli/progress.h"
#include "render/selftest.h"

#include <cJSON.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

struct report {
    cJSON *rows; /* NULL: print */
    unsigned checks, failed, compared;
    double nearest; /* largest error over bound of those that have passed */
    char nearest_what[128];
};

static void print_row(const struct kd_selftest_row *row)
{
    printf("%-4s  %-60s %-17s %8.1e %8.1e  %s\n", row->ok ? "ok" : "FAIL", row->what, row->by, row->error, row->bound, row->source);
}

static void add_row(cJSON *rows, const struct kd_selftest_row *row)
{
    cJSON *o = cJSON_CreateObject();
    cJSON_AddStringToObject(o, "what", row->what);
    cJSON_AddStringToObject(o, "by", row->by);
    cJSON_AddNumberToObject(o, "compared", row->compared);
    if (isfinite(row->error)) /* a number that does not exist is left out, as everywhere */
        cJSON_AddNumberToObject(o, "error", row->error);
    cJSON_AddNumberToObject(o, "bound", row->bound);
    cJSON_AddBoolToObject(o, "ok", row->ok);
    cJSON_AddStringToObject(o, "source", row->source);
    cJSON_AddItemToArray(rows, o);
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
    fflush(stdout);
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
        printf("all ok; nearest to its bound, at %.0f %%: %s\n", 100 * r->nearest, r->nearest_what);
}

static enum kd_status print_json(cJSON *rows, const struct report *r, const char *device, bool float64, double seconds,
                                 struct kd_error *error)
{
    cJSON *root = cJSON_CreateObject();
    cJSON_AddStringToObject(root, "kerrd", KD_VERSION);
    cJSON_AddStringToObject(root, "device", device);
    cJSON_AddBoolToObject(root, "ok", r->failed == 0);
    cJSON_AddNumberToObject(root, "checks", r->checks);
    cJSON_AddNumberToObject(root, "failed", r->failed);
    cJSON_AddNumberToObject(root, "compared", r->compared);
    cJSON_AddNumberToObject(root, "seconds", seconds);
    cJSON_AddBoolToObject(root, "float64", float64);
    cJSON_AddItemToObject(root, "rows", rows);
    char *text = cJSON_PrintUnformatted(root);
    cJSON_Delete(root);
    if (!text)
        return kd_error_set(error, KD_ENOMEM, "out of memory for the table");
    printf("%s\n", text);
    free(text);
    return KD_OK;
}

enum kd_status kd_cli_selftest(const char *device, bool json, unsigned *failed, struct kd_error *error)
{
    struct report r = { .rows = json ? cJSON_CreateArray() : NULL };
    struct kd_renderer *renderer = NULL;
    struct kd_capacity capacity = { 0 };
    double started = kd_progress_clock();
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
        status = print_json(r.rows, &r, kd_renderer_device_name(renderer), capacity.float64, seconds, error);
    else if (!status)
        print_summary(&r, kd_renderer_device_name(renderer), capacity.float64, seconds);
    else
        cJSON_Delete(r.rows);
    kd_renderer_destroy(renderer);
    *failed = r.failed;
    return status;
}
