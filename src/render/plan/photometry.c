#include "render/plan/photometry.h"

#include "render/view/camera.h"
#include "render/plan/plan.h"

#include <math.h>

uint32_t kd_light_groups(uint32_t pixels)
{
    const uint32_t each = KD_GROUP_SIZE * KD_LIGHT_PIXELS;
    return (pixels + each - 1) / each;
}

uint64_t kd_light_bytes(const struct kd_plan *plan)
{
    return 4ull * KD_LIGHT_SUMS * KD_GROUP_SIZE * kd_light_groups(plan->width * plan->band_rows) * plan->bands;
}

struct sums {
    double solid, weight, x, y; /* photometry.comp's four */
};

static void add(struct sums *s, const float *part)
{
    s->solid += (double)part[0];
    s->weight += (double)part[1];
    s->x += (double)part[2];
    s->y += (double)part[3];
}

static struct kd_light light_of(const struct kd_camera_exact *c, double side, double area, const struct sums *s)
{
    double x = s->x * side, y = s->y * side, w = s->weight; /* steps of rays */
    double k0 = c->c0x * w + c->cxx * x + c->cyx * y, k1 = c->c0y * w + c->cxy * x + c->cyy * y;
    if (!(w > 0))
        return (struct kd_light) { 0, NAN, NAN };
    if (c->w0 == 0)
        return (struct kd_light) { s->solid * area, k0 / w, k1 / w };
    double k2 = c->c0z * w + c->cxz * x + c->cyz * y, degrees = 180 / M_PI; /* (k_r, k_theta, k_phi): the hole is at -k_r */
    return (struct kd_light) { s->solid * area, degrees * atan2(k2, -k0), degrees * atan2(-k1, hypot(k0, k2)) };
}

struct kd_light_report kd_light_of(const struct kd_scene *scene, const float *sums, size_t n)
{
    const struct kd_camera_exact camera = kd_camera_exact(scene);
    double side = kd_scene_side(scene), pixel = kd_camera_pixel(scene), area = pixel * pixel;
    struct sums all = { 0 }, spots = { 0 };
    for (size_t i = 0; i < n; i++) {
        add(&all, sums + KD_LIGHT_SUMS * i);
        add(&spots, sums + KD_LIGHT_SUMS * i + KD_LIGHT_SUMS / 2);
    }
    return (struct kd_light_report) { true, light_of(&camera, side, area, &all), light_of(&camera, side, area, &spots) };
}
