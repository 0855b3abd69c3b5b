#include "render/sky/frame.h"

#include "physics/math/angle.h"

#include <math.h>

#define DEGREE (M_PI / 180)

struct kd_vec kd_sky_direction(double longitude, double latitude)
{
    return (struct kd_vec) { cos(latitude) * cos(longitude), cos(latitude) * sin(longitude), sin(latitude) };
}

struct kd_vec kd_rotate(const struct kd_rotation *by, struct kd_vec v)
{
    const double (*m)[3] = by->m;
    return (struct kd_vec) { m[0][0] * v.x + m[0][1] * v.y + m[0][2] * v.z,
                             m[1][0] * v.x + m[1][1] * v.y + m[1][2] * v.z,
                             m[2][0] * v.x + m[2][1] * v.y + m[2][2] * v.z };
}

struct kd_rotation kd_rotation_then(const struct kd_rotation *first, const struct kd_rotation *then)
{
    struct kd_rotation o = { 0 };
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            for (int k = 0; k < 3; k++)
                o.m[i][j] += then->m[i][k] * first->m[k][j];
    return o;
}

static struct kd_vec cross(struct kd_vec a, struct kd_vec b)
{
    return (struct kd_vec) { a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x };
}

static struct kd_vec unit(struct kd_vec v)
{
    double n = 1 / sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
    return (struct kd_vec) { n * v.x, n * v.y, n * v.z };
}

/* Axes of an observer who looks along `forward` with `up` above. */
struct axes { struct kd_vec forward, up, right; };

static struct axes axes(struct kd_vec forward, struct kd_vec pole)
{
    struct kd_vec right = unit(cross(forward, pole));
    return (struct axes) { forward, cross(right, forward), right };
}

/* The rotation that takes the axes `from` to the axes `to`. */
static struct kd_rotation between(struct axes from, struct axes to)
{
    const double f[3][3] = { { from.forward.x, from.forward.y, from.forward.z },
                             { from.up.x, from.up.y, from.up.z },
                             { from.right.x, from.right.y, from.right.z } };
    const double t[3][3] = { { to.forward.x, to.forward.y, to.forward.z },
                             { to.up.x, to.up.y, to.up.z },
                             { to.right.x, to.right.y, to.right.z } };
    struct kd_rotation o = { 0 };
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            for (int k = 0; k < 3; k++)
                o.m[i][j] += t[k][i] * f[k][j];
    return o;
}

static struct kd_rotation about_z(double degrees)
{
    double c = kd_cos_deg(degrees), s = kd_sin_deg(degrees);
    return (struct kd_rotation) { { { c, -s, 0 }, { s, c, 0 }, { 0, 0, 1 } } };
}

static struct kd_rotation about_y(double degrees)
{
    double c = kd_cos_deg(degrees), s = kd_sin_deg(degrees);
    return (struct kd_rotation) { { { c, 0, s }, { 0, 1, 0 }, { -s, 0, c } } };
}

struct kd_rotation kd_rotation_galactic(void)
{
    /* Turns the galactic pole to z, then the equatorial pole to its galactic longitude. */
    const struct kd_rotation turned = about_z(180 - 192.85948), tilted = about_y(90 - 27.12825),
                             both = kd_rotation_then(&turned, &tilted);
    const struct kd_rotation last = about_z(122.93192);
    return kd_rotation_then(&both, &last);
}

/* The rotation from the hole's frame to the galactic one, for a camera at azimuth 0. */
static struct kd_rotation oriented(const struct kd_scene *scene)
{
    const struct kd_vec pole = { 0, 0, 1 };
    const struct kd_rotation galactic = kd_rotation_galactic();
    const double s = kd_sin_deg(scene->camera.inclination_deg), c = kd_cos_deg(scene->camera.inclination_deg);
    struct axes to;
    switch (scene->sky.orientation) {
    case KD_SKY_GALACTIC: return (struct kd_rotation) { { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } } };
    case KD_SKY_EQUATORIAL: return galactic;
    case KD_SKY_SGRA: to = axes(kd_sky_direction(359.94423 * DEGREE, -0.04616 * DEGREE), pole); break;
    default:
        to = axes(kd_rotate(&galactic, kd_sky_direction(187.70593 * DEGREE, 12.39112 * DEGREE)),
                  kd_rotate(&galactic, pole));
        break;
    }
    /* Directions behind the hole, above it and to the right of it, as seen by a camera that is not turned
     * (render/view/camera.c). */
    const struct axes from = { { -s, 0, -c }, { -c, 0, s }, { 0, 1, 0 } };
    return between(from, to);
}

struct kd_rotation kd_sky_rotation(const struct kd_scene *scene)
{
    const struct kd_rotation turned = about_z(scene->sky.turn_deg + scene->camera.azimuth_deg),
                             tilted = about_y(scene->sky.tilt_deg);
    const struct kd_rotation both = kd_rotation_then(&turned, &tilted), sky = oriented(scene);
    return kd_rotation_then(&both, &sky);
}
