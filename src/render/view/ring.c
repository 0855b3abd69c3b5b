#include "render/view/ring.h"

#include "scene/hole.h"

#include <math.h>

struct kd_ring kd_ring_of(const struct kd_scene *scene)
{
    const struct kd_camera *c = &scene->camera;
    const struct kd_camera_exact camera = kd_camera_exact(scene);
    const struct kd_critical_observer observer = {
        .hole = *kd_scene_hole(scene),
        .radius = INFINITY,
        .cos_theta = camera.u,
        .sin_theta = camera.s,
    };
    return (struct kd_ring) {
        .curve = kd_critical_of(&observer),
        .middle = c->roll_deg * (M_PI / 180),
        .most = c->ring_decades_max,
        .least = c->ring_decades_min,
        .width = (uint32_t)(scene->image.width * kd_scene_side(scene)),
        .height = (uint32_t)(scene->image.height * kd_scene_side(scene)),
    };
}

struct kd_critical_point kd_ring_column(const struct kd_ring *ring, uint32_t x)
{
    double turn = (x + 0.5) / ring->width - 0.5;
    return kd_critical_at(&ring->curve, ring->middle + 2 * M_PI * turn);
}

double kd_ring_distance(const struct kd_ring *ring, uint32_t y)
{
    double up = 1 - 2 * (y + 0.5) / ring->height; /* 1 at the top, -1 at the bottom */
    double decades = ring->least + fabs(up) * (ring->most - ring->least);
    return up >= 0 ? pow(10, decades) : -pow(10, decades);
}

struct kd_camera_label kd_ring_label(const struct kd_ring *ring, const struct kd_critical_point *p, uint32_t y)
{
    double d = kd_ring_distance(ring, y);
    return (struct kd_camera_label) {
        .alpha = p->alpha + d * (p->alpha - ring->curve.centre),
        .beta = p->beta + d * p->beta,
        .energy = 1,
    };
}
