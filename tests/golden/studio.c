#include "studio.h"

#include "image/png.h"
#include "vk/instance.h"
#include "vk/vk.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static struct kd_renderer *renderer;
static struct kd_buffer sky;

static _Noreturn void stop(const char *what, const struct kd_error *error)
{
    fprintf(stderr, "%s: %s %s\n", what, error->pointer, error->message);
    exit(1);
}

enum { ROWS = 256 };

static void sky_pixel(double l, double b, uint8_t rgb[3])
{
    static const struct {
        double l, b;
        uint8_t rgb[3];
    } discs[] = {
        { 0, 0, { 255, 150, 30 } },  { 90, 0, { 230, 20, 20 } },   { 180, 0, { 20, 200, 40 } },
        { 270, 0, { 30, 60, 255 } }, { 0, 90, { 255, 255, 255 } },
    };
    const double degree = M_PI / 180;
    const bool line = fabs(remainder(l, 30)) * cos(b * degree) < 0.7 || fabs(remainder(b, 30)) < 0.7;
    for (int c = 0; c < 3; c++)
        rgb[c] = (uint8_t)(line ? 150 : 60 + 40 * cos((l - 120 * c) * degree));
    for (size_t i = 0; i < sizeof discs / sizeof *discs; i++)
        if (sin(b * degree) * sin(discs[i].b * degree) +
                cos(b * degree) * cos(discs[i].b * degree) * cos((l - discs[i].l) * degree) >
            cos(12 * degree))
            memcpy(rgb, discs[i].rgb, 3);
}

static bool take(void *user, const char *hash, struct kd_asset_bytes *out)
{
    static uint8_t pixels[3 * 2 * ROWS * ROWS];
    struct kd_error error;
    (void)user;
    if (strcmp(hash, STUDIO_SKY))
        return false;
    for (size_t i = 0; i < (size_t)2 * ROWS * ROWS && !sky.size; i++)
        sky_pixel(180 - 180 * ((double)(i % (2 * ROWS)) + 0.5) / ROWS,
                  90 - 180 * ((double)(i / (2 * ROWS)) + 0.5) / ROWS, &pixels[3 * i]);
    if (!sky.size &&
        kd_png_encode(&(struct kd_png_params) { .width = 2 * ROWS, .height = ROWS, .bit_depth = 8, .pixels = pixels },
                      &sky, &error))
        stop("the sky", &error);
    *out = (struct kd_asset_bytes) { sky.data, sky.size, NULL };
    return true;
}
static void give_back(void *user, struct kd_asset_bytes *bytes) { (void)user, (void)bytes; }
static const struct kd_assets assets = { NULL, take, give_back, "STUDIO_SKY", NULL };

int studio_open(void)
{
    /* keeps the driver loaded, so that a leak checker can report the driver's name */
    static struct kd_vk_instance keeper;
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
    const struct kd_renderer_params params = { .device = device ? device : "auto", .cache_dir = "", .assets = &assets };
    if (!kd_renderer_create(&params, &renderer, &error))
        return 0;
    fprintf(stderr, "%s\n", error.message);
    return 1;
}

void studio_close(void)
{
    kd_renderer_destroy(renderer);
    renderer = NULL;
    kd_buffer_finish(&sky);
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
    if ((preset && kd_scene_preset(&scene, preset, &error)) || kd_scene_from_json(&scene, json, strlen(json), &error) ||
        kd_scene_validate(&scene, &error))
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
    if (kd_plan_make(scene, &capacity, &plan, &error) || kd_render(renderer, scene, &plan, NULL, NULL, &frame, &error))
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
