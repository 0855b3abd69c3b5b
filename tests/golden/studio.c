#include "studio.h"

#include "vk/instance.h"
#include "vk/vk.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static struct kd_renderer *renderer;

static _Noreturn void stop(const char *what, const struct kd_error *error)
{
    fprintf(stderr, "%s: %s %s\n", what, error->pointer, error->message);
    exit(1);
}

int studio_open(void)
{
    static struct kd_vk_instance keeper; /* a driver that stays loaded can be named by a leak checker */
    struct kd_vk_info *infos;
    struct kd_error error = { 0 };
    size_t n;
    kd_vk_instance_init(&keeper, false, NULL);
    if (kd_vk_list(&infos, &n, &error)) {
        printf("SKIP: %s\n", error.message);
        return SKIPPED;
    }
    free(infos);
    const char *device = getenv("KERRD_TEST_DEVICE");
    const struct kd_renderer_params params = { .device = device ? device : "auto", .cache_dir = "" };
    if (!kd_renderer_create(&params, &renderer, &error))
        return 0;
    fprintf(stderr, "%s\n", error.message);
    return 1;
}

void studio_close(void)
{
    kd_renderer_destroy(renderer);
    renderer = NULL;
}

bool studio_has_float64(const char *what)
{
    struct kd_capacity capacity;
    kd_renderer_capacity(renderer, &capacity);
    if (!capacity.float64)
        printf("SKIP: %s: the device has no double precision\n", what);
    return capacity.float64;
}

struct kd_scene studio_scene(const char *preset, const char *json)
{
    struct kd_scene scene;
    struct kd_error error = { 0 };
    kd_scene_smooth(&scene);
    if ((preset && kd_scene_preset(&scene, preset, &error)) ||
        kd_scene_from_json(&scene, json, strlen(json), &error) || kd_scene_validate(&scene, &error))
        stop(json, &error);
    return scene;
}

struct kd_frame studio_render(const struct kd_scene *scene)
{
    struct kd_capacity capacity;
    struct kd_plan plan;
    struct kd_frame frame;
    struct kd_error error = { 0 };
    kd_renderer_capacity(renderer, &capacity);
    if (kd_plan_make(scene, &capacity, &plan, &error) ||
        kd_render(renderer, scene, &plan, NULL, NULL, &frame, &error))
        stop("render", &error);
    return frame;
}

struct kd_frame studio_shoot(const char *format, ...)
{
    char json[1024];
    va_list list;
    va_start(list, format);
    vsnprintf(json, sizeof json, format, list);
    va_end(list);
    struct kd_scene scene = studio_scene(NULL, json);
    return studio_render(&scene);
}

double studio_value(const struct kd_frame *f, uint32_t x, uint32_t y, int c)
{
    size_t at = 3 * ((size_t)y * f->width + x) + (size_t)c;
    return kd_frame_bit_depth(f) == 16 ? ((const uint16_t *)kd_frame_pixels(f))[at] / 65535.0
                              : ((const uint8_t *)kd_frame_pixels(f))[at] / 255.0;
}

double studio_light(const struct kd_frame *f, uint32_t x, uint32_t y, int c)
{
    double v = studio_value(f, x, y, c);
    return v <= 0.04045 ? v / 12.92 : pow((v + 0.055) / 1.055, 2.4);
}

double studio_luminance(const struct kd_frame *f, uint32_t x, uint32_t y)
{
    static const double weights[] = { 0.2126, 0.7152, 0.0722 };
    double sum = 0;
    for (int c = 0; c < 3; c++) {
        double light = studio_light(f, x, y, c);
        if (light > 0.98)
            return -1;
        sum += weights[c] * light;
    }
    return sum;
}

bool studio_black(const struct kd_frame *f, uint32_t x, uint32_t y)
{
    return studio_value(f, x, y, 0) == 0 && studio_value(f, x, y, 1) == 0 && studio_value(f, x, y, 2) == 0;
}
