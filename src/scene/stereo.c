/* Computes the places of the two eyes of a stereo pair. */
#include "scene/scene.h"

#include "physics/math/angle.h"
#include "physics/spacetime/kerr.h"

#include <math.h>

struct vec { double x[3]; };

static struct vec mix(double a, struct vec p, double b, struct vec q)
{
    return (struct vec) { { a * p.x[0] + b * q.x[0], a * p.x[1] + b * q.x[1], a * p.x[2] + b * q.x[2] } };
}

static double dot(struct vec p, struct vec q) { return p.x[0] * q.x[0] + p.x[1] * q.x[1] + p.x[2] * q.x[2]; }

/* The local directions e_r, e_theta and e_phi in flat space, in Cartesian coordinates with the hole at the origin. */
struct basis { struct vec r, theta, phi; };

static struct basis basis_at(double u, double s, double azimuth)
{
    const double c = cos(azimuth), d = sin(azimuth);
    return (struct basis) { { { s * c, s * d, u } }, { { u * c, u * d, -s } }, { { -d, c, 0 } } };
}

static struct vec outwards(const struct basis *b, const double local[3])
{
    return mix(1, mix(local[0], b->r, local[1], b->theta), local[2], b->phi);
}

/* The camera's viewing direction, and the picture's right and up, as components along (e_r, e_theta, e_phi). They
 * must agree with render/view/camera.c. */
struct view { double ahead[3], right[3], up[3]; };

static struct view view_of(const struct kd_camera *c)
{
    const double cy = kd_cos_deg(c->yaw_deg), sy = kd_sin_deg(c->yaw_deg), cp = kd_cos_deg(c->pitch_deg),
                 sp = kd_sin_deg(c->pitch_deg), cr = kd_cos_deg(c->roll_deg), sr = kd_sin_deg(c->roll_deg);
    const double up[3] = { cy * sp, -cp, -sy * sp }, side[3] = { sy, 0, cy };
    struct view v = { .ahead = { -cp * cy, -sp, cp * sy } };
    for (int i = 0; i < 3; i++) {
        v.right[i] = cr * side[i] - sr * up[i];
        v.up[i] = sr * side[i] + cr * up[i];
    }
    return v;
}

/* Converts a unit length along a leg of the tetrad to coordinates: dr, r dtheta, r sin(theta) dphi. For a falling
 * observer the azimuth is that of ingoing Kerr-Schild coordinates. The conversion starts from p_mu and uses Sigma p^r,
 * Sigma p^theta = p_theta and Sigma p^phi = L/sin^2 - a E + a (P + w)/Delta. Here P = E (r^2 + a^2) - a L; w = Sigma
 * p^r for a falling observer, and w = 0 for others. At the horizon the last term is 0/0 for a falling observer; there
 * it is evaluated next to the horizon. */
static void along(const struct kd_vantage *at, const struct kd_covector *leg, bool falls, double out[3])
{
    const double a = at->hole.a, r = at->r, s = at->s, sigma = r * r + a * a * at->u * at->u, w2 = r * r + a * a;
    const double delta = kd_hole_delta(&at->hole, r);
    const double p = leg->energy * w2 - a * s * leg->momentum + (falls ? leg->radial : 0);
    out[0] += leg->radial / sigma;
    out[1] += r * leg->polar / sigma;
    out[2] += r * (leg->momentum - a * s * leg->energy + (a == 0 ? 0 : a * s * p / delta)) / sigma;
}

static void leave_background_render(const struct kd_scene *scene, const double local[3], double out[3])
{
    const struct kd_observer_motion motion = kd_scene_observer(scene);
    struct kd_vantage at = kd_scene_vantage(scene);
    const double horizon = at.hole.outer, beside = 1e-5;
    if (fabs(at.r - horizon) < beside * horizon)
        at.r = horizon * (1 + beside);
    const struct kd_tetrad f = kd_observer_tetrad(&motion, &at);
    const struct kd_covector *const legs[] = { &f.r, &f.theta, &f.phi };
    out[0] = out[1] = out[2] = 0;
    for (int i = 0; i < 3; i++) {
        double one[3] = { 0 };
        along(&at, legs[i], f.falls, one);
        for (int k = 0; k < 3; k++)
            out[k] += local[i] * one[k];
    }
}

static void aim(struct kd_camera *c, const struct basis *b, struct vec ahead, struct vec up)
{
    const double degrees = 180 / M_PI, r = dot(ahead, b->r), theta = dot(ahead, b->theta), phi = dot(ahead, b->phi);
    c->pitch_deg = degrees * atan2(-theta, hypot(r, phi));
    c->yaw_deg = degrees * atan2(phi, -r);
    c->roll_deg = 0;
    const struct view level = view_of(c);
    c->roll_deg = degrees * atan2(dot(up, outwards(b, level.right)), dot(up, outwards(b, level.up)));
}

struct kd_scene kd_scene_eye(const struct kd_scene *scene, int side)
{
    struct kd_scene eye = *scene;
    struct kd_camera *c = &eye.camera;
    const struct kd_vantage at = kd_scene_vantage(scene);
    const struct view v = view_of(&scene->camera);
    const struct basis here = basis_at(at.u, at.s, 0);
    double aside[3], local[3];
    for (int i = 0; i < 3; i++)
        local[i] = 0.5 * side * c->eye_distance * v.right[i];
    leave_background_render(scene, local, aside);
    aside[0] += at.r;
    const struct vec place = outwards(&here, aside);
    const double rho = hypot(place.x[0], place.x[1]), azimuth = atan2(place.x[1], place.x[0]);
    c->stereo = KD_STEREO_NONE;
    c->r = hypot(rho, place.x[2]);
    c->inclination_deg = atan2(rho, place.x[2]) * (180 / M_PI);
    c->azimuth_deg = remainder(c->azimuth_deg + azimuth * (180 / M_PI), 360);
    const struct basis there = basis_at(place.x[2] / c->r, rho / c->r, azimuth);
    aim(c, &there, outwards(&here, v.ahead), outwards(&here, v.up));
    return eye;
}
