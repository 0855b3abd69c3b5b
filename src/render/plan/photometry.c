#include "render/plan/photometry.h"

#include "render/emit/emitter.h"
#include "render/view/camera.h"
#include "render/plan/plan.h"

#include <math.h>

uint32_t kd_light_groups(uint32_t pixels)
{
    const uint32_t each = KD_GROUP_SIZE * KD_LIGHT_PIXELS;
    return (pixels + each - 1) / each;
}

uint32_t kd_light_sums(const struct kd_plan_light *light)
{
    return light->stokes_words ? KD_LIGHT_SUMS_STOKES : KD_LIGHT_SUMS;
}

uint64_t kd_light_bytes(const struct kd_plan *plan)
{
    return 4ull * kd_light_sums(&plan->light) * KD_GROUP_SIZE *
           kd_light_groups(plan->picture.width * plan->picture.band_rows) * plan->picture.bands;
}

struct sums {
    double solid, weight, x, y; /* the four sums of photometry.comp */
    double q, u, v;
};

static void add(struct sums *s, const float *part)
{
    s->solid += (double)part[0];
    s->weight += (double)part[1];
    s->x += (double)part[2];
    s->y += (double)part[3];
}

static void add_stokes(struct sums *s, const float *part)
{
    s->q += (double)part[0];
    s->u += (double)part[1];
    s->v += (double)part[2];
}

static struct kd_light centred(const struct kd_camera_exact *c, double side, double area, const struct sums *s)
{
    double x = s->x * side, y = s->y * side, w = s->weight; /* the centroid in units of the distance between rays */
    double k0 = c->c0x * w + c->cxx * x + c->cyx * y, k1 = c->c0y * w + c->cxy * x + c->cyy * y;
    if (!(w > 0))
        return (struct kd_light) { .x = NAN, .y = NAN };
    if (c->w0 == 0)
        return (struct kd_light) { .flux = s->solid * area, .x = k0 / w, .y = k1 / w };
    double k2 = c->c0z * w + c->cxz * x + c->cyz * y,
           degrees = 180 / M_PI; /* (k_r, k_theta, k_phi): the hole is at -k_r */
    return (struct kd_light) { .flux = s->solid * area,
                               .x = degrees * atan2(k2, -k0),
                               .y = degrees * atan2(-k1, hypot(k0, k2)) };
}

static struct kd_light light_of(const struct kd_camera_exact *c, double side, double area, const struct sums *s)
{
    struct kd_light light = centred(c, side, area, s);
    light.q = s->q * area;
    light.u = s->u * area;
    light.v = s->v * area;
    return light;
}

double kd_light_fraction(const struct kd_light *light)
{
    return light->flux > 0 ? hypot(light->q, light->u) / light->flux : NAN;
}
double kd_light_evpa(const struct kd_light *light)
{
    return light->q != 0 || light->u != 0 ? 0.5 * atan2(light->u, light->q) : NAN;
}

struct kd_light_report kd_light_of(const struct kd_scene *scene, const struct kd_plan *plan, const float *sums)
{
    const uint32_t each = kd_light_sums(&plan->light);
    const size_t n = kd_light_bytes(plan) / (4 * each);
    const bool plane = plan->light.traits[KD_EMITTER_polarization] & KD_TRAIT_PRESENT,
               volume = plan->light.traits[KD_EMITTER_stokes] & KD_TRAIT_PRESENT;
    const struct kd_camera_exact camera = kd_camera_exact(scene);
    double side = kd_scene_side(scene), pixel = kd_camera_pixel(scene), area = pixel * pixel;
    struct sums all = { 0 }, spots = { 0 };
    for (size_t i = 0; i < n; i++) {
        const float *from = sums + each * i;
        add(&all, from);
        add(&spots, from + 4);
        if (each == KD_LIGHT_SUMS_STOKES) {
            add_stokes(&all, from + 8);
            add_stokes(&spots, from + 12);
        }
    }
    return (struct kd_light_report) {
        .measured = true,
        .polarized = plane || volume,
        .circular = volume,
        .all = light_of(&camera, side, area, &all),
        .spots = light_of(&camera, side, area, &spots),
    };
}
