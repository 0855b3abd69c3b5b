#include "render/emit/sky_noise.h"

#include "physics/null/null_geodesic.h"
#include "physics/spacetime/kerr.h"
#include "render/view/camera.h"
#include "scene/hole.h"

#include <float.h>
#include <math.h>

enum { COLUMNS = 12, ROWS = 8 };

static struct kd_null_path path_of(const struct kd_camera_exact *c, const struct kd_scene *scene,
                                   const struct kd_camera_label *label, double rounding)
{
    return kd_null_trace_fast(&(struct kd_null_ray) { .hole = *kd_scene_hole(scene),
                                                      .radius = scene->camera.r,
                                                      .cos_theta = c->u,
                                                      .sin_theta = c->s,
                                                      .alpha = label->alpha * (1 + rounding),
                                                      .beta = label->beta * (1 - rounding),
                                                      .outward = label->outward });
}

static bool sees_the_sky(const struct kd_null_path *p) { return p->status == KD_NULL_OK && p->fate == KD_NULL_ESCAPED; }

/* True if two rays end at unrelated places. Rays with different fates always do. */
static bool elsewhere(const struct kd_null_path *a, const struct kd_null_path *b)
{
    if (!sees_the_sky(b))
        return true;
    double s = sqrt(fmax(0, (1 - a->sky_u * a->sky_u) * (1 - b->sky_u * b->sky_u)));
    return a->sky_u * b->sky_u + s * cos(a->sky_phi - b->sky_phi) < cos(KD_SKY_STEP);
}

bool kd_sky_is_noise(const struct kd_scene *scene, enum kd_precision precision)
{
    double r = scene->camera.r, rounding = precision == KD_PRECISION_F32 ? FLT_EPSILON / 2 : DBL_EPSILON / 2;
    /* For a falling observer the sky is not narrowed to a cone: it looks as large as from further out. */
    if (!(r < KD_SKY_NEAR * kd_scene_hole(scene)->outer) || scene->camera.observer == KD_OBSERVER_INFALL)
        return false;
    const struct kd_scene whole = kd_scene_whole(scene);
    const struct kd_camera_exact camera = kd_camera_exact(&whole);
    uint32_t width = (uint32_t)(scene->image.width * kd_scene_side(scene)),
             height = (uint32_t)(scene->image.height * kd_scene_side(scene));
    unsigned seen = 0, lost = 0;
    for (uint32_t k = 0; k < COLUMNS * ROWS; k++) {
        uint32_t x = (uint32_t)((k % COLUMNS + 0.5) / COLUMNS * width),
                 y = (uint32_t)((double)(k / COLUMNS + 0.5) / ROWS * height);
        struct kd_camera_label here, next;
        kd_camera_label(&camera, x, y, &here);
        kd_camera_label(&camera, x + 1 < width ? x + 1 : x, y, &next);
        const struct kd_null_path path = path_of(&camera, scene, &here, 0);
        if (!sees_the_sky(&path))
            continue;
        const struct kd_null_path beside = path_of(&camera, scene, &next, 0),
                                  rounded = path_of(&camera, scene, &here, rounding);
        seen++;
        lost += elsewhere(&path, &beside) || elsewhere(&path, &rounded);
    }
    return 2 * lost > seen;
}
