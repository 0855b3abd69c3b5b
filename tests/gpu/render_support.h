/* Shared by the tests of src/render: one renderer with Vulkan's validation layer, which must have reported no error at
 * the end. */
#ifndef KD_TEST_RENDER_SUPPORT_H
#define KD_TEST_RENDER_SUPPORT_H

#include "support.h"

#include "render/render.h"

#include <math.h>

static struct kd_renderer *renderer;
/* provider of the scenes' assets, which a test sets before it opens the renderer */
static const struct kd_assets *renderer_assets;

/* Opens the renderer. Returns 0, or the exit status for a skipped or failed test. */
static inline int open_renderer(void)
{
    int skip = skip_without_device();
    if (skip)
        return skip;
    struct kd_error error = { 0 };
    const char *device = getenv("KERRD_TEST_DEVICE");
    struct kd_renderer_params params = {
        .device = device ? device : "auto", .validate = true, .assets = renderer_assets, .passing = true
    }; /* learned costs are not stored, so that other programs do not use those of a test */
    if (!kd_renderer_create(&params, &renderer, &error))
        return 0;
    fprintf(stderr, "%s\n", error.message);
    return 1;
}

/* True if kernels can compute in double precision on this device; otherwise prints the name of the skipped case. */
static inline bool has_float64(const char *what)
{
    struct kd_capacity capacity;
    kd_renderer_capacity(renderer, &capacity);
    if (!capacity.float64)
        printf("SKIP: %s: the device has no double precision\n", what);
    return capacity.float64;
}

/* Renders a frame of the scene, by a plan for this device. */
static inline struct kd_frame rendered(const struct kd_scene *scene)
{
    struct kd_capacity c;
    struct kd_plan plan;
    struct kd_frame frame;
    kd_renderer_capacity(renderer, &c);
    OK(kd_scene_validate(scene, &error));
    OK(kd_plan_make(scene, &c, &plan, &error));
    OK(kd_render(renderer, scene, &plan, NULL, NULL, &frame, &error));
    return frame;
}

/* Time of a pass of a frame in ms; NAN if the pass did not run. */
static inline double timing_of(const struct kd_frame *frame, const char *pass)
{
    for (size_t i = 0; i < frame->n_timings; i++)
        if (!strcmp(frame->timings[i].name, pass))
            return frame->timings[i].ms;
    return NAN;
}

static inline bool ran(const struct kd_frame *frame, const char *pass) { return !isnan(timing_of(frame, pass)); }

/* Linear light of an sRGB value in [0, 1] (IEC 61966-2-1), and of a sample of 16 bits. */
static inline double decode(double v) { return v <= 0.04045 ? v / 12.92 : pow((v + 0.055) / 1.055, 2.4); }
static inline double shown(const uint16_t *picture, size_t i) { return decode(picture[i] / 65535.0); }

/* Compares two doubles for qsort. */
static inline int by_value(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* The exit status of a group with this number of failed tests. */
static inline int close_renderer(int failed)
{
    if (kd_renderer_validation_messages(renderer)) {
        fprintf(stderr, "the validation layer spoke\n");
        failed++;
    }
    kd_renderer_destroy(renderer);
    return failed;
}

#endif
