#include "render/selftest/first_start.h"

#include "base/clock.h"
#include "base/log.h"
#include "render/device/device_internal.h"
#include "render/frame/frame.h"
#include "render/selftest/selftest.h"

#include <math.h>
#include <stdio.h>

static bool judge(void *user, const struct kd_selftest_row *row)
{
    struct kd_verdict *s = user;
    s->checks++;
    if (!row->ok && !s->failed++)
        snprintf(s->worst, sizeof s->worst, "%s, compared with %s: error %.2g, limit %.2g", row->what, row->by,
                 row->error, row->bound);
    return true;
}

static void restore(struct kd_renderer *r, const struct kd_capacity *capacity)
{
    pthread_mutex_lock(&r->lock);
    r->capacity = *capacity;
    pthread_mutex_unlock(&r->lock);
}

/* Measures the cost of a ray and a pixel, which replaces the guess for this type of device. The cost is the least of
 * several small pictures, for two reasons: a driver may compile a kernel when it first runs, and a busy machine may
 * slow any of the pictures. */
static enum kd_status measure(struct kd_renderer *r, struct kd_error *error)
{
    enum kd_status status = KD_OK;
    struct kd_capacity *c = &r->capacity;
    const struct kd_capacity guess = *c;
    for (int i = 0; i < KD_FIGURE_COUNT; i++)
        c->ns[i] = INFINITY;
    r->probing = true;
    for (int k = 0; k < 8 && !status; k++) {
        struct kd_scene scene;
        struct kd_plan plan;
        struct kd_frame frame = { 0 };
        kd_scene_smooth(&scene);
        scene.image.width = 256;
        scene.image.height = 144 + k; /* another height, so that a new lens map is needed */
        scene.camera.r = k < 4 ? INFINITY : 30;
        status = kd_plan_make(&scene, &guess, &plan, error);
        if (!status)
            status = kd_render(r, &scene, &plan, NULL, NULL, &frame, error);
        kd_frame_finish(&frame);
    }
    r->probing = false;
    /* costs that are not measured here keep their value: those of particles, and all costs if the device has no
     * timestamps */
    for (int i = 0; i < KD_FIGURE_COUNT; i++)
        c->ns[i] = isfinite(c->ns[i]) ? c->ns[i] : guess.ns[i];
    return status;
}

static void tell(const struct kd_renderer *r, enum kd_status status, const struct kd_error *why)
{
    const struct kd_verdict *s = &r->verdict;
    if (status)
        kd_log(KD_LOG_ERROR, "the self-test of %s could not run: %s", r->name, why->message);
    else if (s->failed)
        kd_log(KD_LOG_ERROR,
               "%u of %u checks of the self-test FAILED on %s; its results may be wrong (%s); `kerrd doctor "
               "--selftest` shows all checks",
               s->failed, s->checks, r->name, s->worst);
    else
        kd_log(KD_LOG_INFO, "the self-test at the first start on %s passed: %u checks in %.1f s", r->name, s->checks,
               s->seconds);
}

enum kd_status kd_first_start(struct kd_renderer *r, struct kd_error *error)
{
    struct kd_verdict *s = &r->verdict;
    if (s->result == KD_PASSED)
        return KD_OK;
    struct kd_error why = { 0 };
    /* restored afterwards, because the self-test's pictures are too small to measure costs */
    const struct kd_capacity before = r->capacity;
    double begun = kd_clock_ms();
    *s = (struct kd_verdict) { .now = true };
    enum kd_status status = kd_selftest_run(r, &kd_selftest_reference, judge, s, &why);
    s->seconds = 1e-3 * (kd_clock_ms() - begun);
    restore(r, &before);
    s->result = status || !s->checks ? KD_UNTESTED : s->failed ? KD_FAILED : KD_PASSED;
    if (status != KD_EDEVICE)
        tell(r, status, &why);
    if (!status)
        status = measure(r, &why);
    if (status == KD_EDEVICE)
        return kd_error_set(error, status, "%s", why.message);
    if (s->result == KD_PASSED)
        kd_verdict_save(r, r->capacity);
    return KD_OK;
}
