/* Random cameras with all kinds of observers, spins, radii, motions and projections. */
#ifndef KD_TEST_RANDOM_CAMERA_H
#define KD_TEST_RANDOM_CAMERA_H

#include "base/random.h"
#include "physics/spacetime/kerr.h"
#include "physics/spacetime/observer.h"
#include "scene/scene.h"

#include <math.h>

static double between(struct kd_random *random, double low, double high)
{
    return low + (high - low) * kd_random(random);
}
static double decades(struct kd_random *random, double low, double high) { return pow(10, between(random, low, high)); }
static uint32_t below(struct kd_random *random, uint32_t n) { return (uint32_t)(kd_random(random) * n); }

static double random_spin(struct kd_random *random)
{
    const double size = below(random, 2) ? kd_random(random) : 1 - decades(random, -12, -0.3);
    return below(random, 3) ? size : -size;
}

/* A radius between the smallest one at which the observer exists and 1e7 M. An infalling observer is sometimes within
 * the outer horizon. */
static double random_radius(struct kd_random *random, enum kd_observer observer, double spin, double inclination_deg)
{
    const double u = cos(inclination_deg * (M_PI / 180)), horizon = kd_hole(spin)->outer, inner = kd_hole(spin)->inner;
    if (observer == KD_OBSERVER_INFALL && !below(random, 3))
        return fmax(inner + (horizon - inner) * between(random, 0.05, 1), 0.02);
    const double edge = observer == KD_OBSERVER_INFALL ? horizon : kd_observers[observer].outside(kd_hole(spin), u);
    return fmin(edge * (1 + decades(random, -6, below(random, 2) ? 1.5 : 7)), 1e7);
}

static void random_motion(struct kd_random *random, struct kd_camera *c)
{
    const double speed = fmin(1 - decades(random, -6, 0), 0.999999), u = between(random, -1, 1),
                 phi = between(random, 0, 2 * M_PI);
    const bool along = below(random, 2); /* true: the direction is along an axis; false: it may be any direction */
    c->velocity_r = along ? 0 : speed * u;
    c->velocity_theta = along ? 0 : speed * sqrt(1 - u * u) * cos(phi);
    c->velocity_phi = along ? (below(random, 2) ? speed : -speed) : speed * sqrt(1 - u * u) * sin(phi);
}

/* Makes a random camera. side: width of the picture in pixels. */
static void random_camera(struct kd_random *random, int side, struct kd_scene *s)
{
    static const double angles[] = { 0, 90, 180, 1e-4, 60 };
    struct kd_camera *c = &s->camera;
    kd_scene_smooth(s);
    s->spacetime.spin = random_spin(random);
    c->inclination_deg = below(random, 3) ? between(random, 0, 180) : angles[below(random, 5)];
    s->image.width = s->image.height = side;
    s->image.critical_factor = 1;
    s->accuracy.orders = below(random, 2) ? 1 : 3; /* one of two values, so that few kernels have to be compiled */
    s->sky.model = KD_SKY_GRID;
    if (!below(random, 8)) {
        c->r = INFINITY;
        c->field_m = decades(random, 0, 3);
        return;
    }
    c->observer = (enum kd_observer)below(random, KD_OBSERVER_COUNT);
    c->r = random_radius(random, c->observer, s->spacetime.spin, c->inclination_deg);
    if (c->observer == KD_OBSERVER_VELOCITY)
        random_motion(random, c);
    c->projection =
        (int[]) { KD_PROJECTION_PINHOLE, KD_PROJECTION_EQUIRECTANGULAR, KD_PROJECTION_FULLDOME }[below(random, 3)];
    c->fov_deg = below(random, 2) ? between(random, 10, 150) : fmin(150, 600 / c->r);
    if (below(random, 2)) {
        c->yaw_deg = below(random, 2) ? between(random, -180, 180) : 90 * (double)below(random, 4) - 180;
        c->pitch_deg = below(random, 2) ? between(random, -90, 90) : 90 * (double)below(random, 3) - 90;
        c->roll_deg = between(random, -180, 180);
    }
}

/* Makes a random camera for a spin close to 1, at a radius close to the horizon. There image orders have small islands.
 * An infalling observer is sometimes within the horizon. */
static void random_camera_near_horizon(struct kd_random *random, int side, struct kd_scene *s)
{
    struct kd_camera *c = &s->camera;
    random_camera(random, side, s);
    if (isinf(c->r))
        return;
    s->spacetime.spin = (below(random, 4) ? 1 : -1) * (1 - decades(random, -12, -1));
    const struct kd_hole *hole = kd_hole(s->spacetime.spin);
    const bool falls = c->observer == KD_OBSERVER_INFALL;
    const double u = cos(c->inclination_deg * (M_PI / 180)), part = decades(random, -6, 0.5);
    if (falls && below(random, 2))
        c->r = hole->outer - fmin(part, 0.9) * (hole->outer - hole->inner);
    else
        c->r = (falls ? hole->outer : kd_observers[c->observer].outside(hole, u)) * (1 + part);
}

#endif
