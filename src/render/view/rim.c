#include "render/view/rim.h"

#include "physics/spacetime/kerr.h"
#include "render/view/sky_ray.h"
#include "scene/hole.h"

#include <math.h>
#include <string.h>

static double dot(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

static void scale(double a[3], double by)
{
    for (int i = 0; i < 3; i++)
        a[i] *= by;
}

/* fraction of half the curve. Within this distance of the curve's ends, `up` loses digits, and a parabola replaces the
 * curve */
#define ENDS 3e-4
/* No point is nearer to an end of the curve than this fraction of ENDS. Light that arrives at an end stays in the
 * observer's plane, which null_bend.h does not cover. */
#define MIDST 1e-9

/* A point of the upper half of the curve, along = 0 to 1. Near both ends all components are even functions of the
 * distance to the end, except up and beta, which are odd. */
static struct kd_critical_point upper(const struct kd_critical *curve, double along)
{
    const double end = along < 0.5 ? 0 : 1, t = fmax(fabs(along - end) / ENDS, MIDST);
    if (t >= 1)
        return kd_critical_round(curve, along);
    struct kd_critical_point p = kd_critical_round(curve, fabs(end - ENDS));
    const struct kd_critical_point last = kd_critical_round(curve, end);
    p.right = last.right + t * t * (p.right - last.right),
    p.inwards = last.inwards + t * t * (p.inwards - last.inwards),
    p.alpha = last.alpha + t * t * (p.alpha - last.alpha);
    p.up *= t, p.beta *= t;
    return p;
}

/* Direction of a point of the curve in the observer's frame; at infinity (alpha, beta). As u goes once round, the
 * radius of the photon orbit varies as a cosine, so that the curve has no gap. */
static void direction(const struct kd_critical *curve, double u, double out[3])
{
    const double whole = u / KD_RIM_ANGLES, turn = 2 * (whole - floor(whole)), half = turn <= 1 ? 1 : -1;
    struct kd_critical_point p = upper(curve, turn <= 1 ? 1 - turn : turn - 1);
    p.up *= half;
    kd_critical_see(curve, &p);
    const double d[] = { -p.inwards, -p.up, p.right }, plane[] = { p.alpha, half * p.beta, 0 };
    memcpy(out, isinf(curve->observer.radius) ? plane : d, sizeof d);
}

/* Sets the plane about the mean of the directions along the curve. */
static void set_legs(struct kd_rim *o, double d[KD_RIM_ANGLES][3])
{
    double all = 0;
    for (int k = 0; k < KD_RIM_ANGLES; k++) {
        const double *before = d[(k + KD_RIM_ANGLES - 1) % KD_RIM_ANGLES], *after = d[(k + 1) % KD_RIM_ANGLES];
        const double step[] = { after[0] - before[0], after[1] - before[1], after[2] - before[2] },
                     length = sqrt(dot(step, step));
        all += length;
        for (int i = 0; i < 3; i++)
            o->ahead[i] += length * d[k][i];
    }
    scale(o->ahead, 1 / all);
    if (o->flat) {
        o->right[0] = o->up[1] = 1;
        return;
    }
    scale(o->ahead, 1 / sqrt(dot(o->ahead, o->ahead)));
    const double *a = o->ahead, across[] = { 0, 0, 1 }, down[] = { 0, 1, 0 },
                 *beside = fabs(a[2]) < 0.7 ? across : down;
    for (int i = 0; i < 3; i++)
        o->right[i] = beside[i] - dot(beside, a) * a[i];
    scale(o->right, 1 / sqrt(dot(o->right, o->right)));
    const double up[] = { a[1] * o->right[2] - a[2] * o->right[1], a[2] * o->right[0] - a[0] * o->right[2],
                          a[0] * o->right[1] - a[1] * o->right[0] };
    memcpy(o->up, up, sizeof up);
}

/* Projects a direction on the plane. Returns false if the direction is more than 80 degrees from the middle. */
static bool on_plane(const struct kd_rim *o, const double d[3], double place[2])
{
    const double from[] = { d[0] - o->ahead[0], d[1] - o->ahead[1], 0 }, depth = o->flat ? 1 : dot(d, o->ahead);
    place[0] = dot(o->flat ? from : d, o->right) / depth;
    place[1] = dot(o->flat ? from : d, o->up) / depth;
    return depth > cos(80 * (M_PI / 180));
}

/* Sets the edges between two points of the curve: where rays from the middle meet the straight line between these
 * points. Returns false if the curve does not turn about the middle there. */
static bool set_edges_between(struct kd_rim *o, const double p[2], const double q[2], double turning)
{
    const double unit = KD_RIM_EDGES / (2 * M_PI), cross = p[0] * q[1] - p[1] * q[0];
    const double from = atan2(p[1], p[0]), by = atan2(cross, p[0] * q[0] + p[1] * q[1]);
    if (!(by * turning > 0))
        return false;
    const double low = (by > 0 ? from : from + by) * unit, high = (by > 0 ? from + by : from) * unit;
    const double dx = q[0] - p[0], dy = q[1] - p[1];
    for (double i = ceil(low); i <= high; i++) {
        const double c = cos(i / unit), s = sin(i / unit);
        o->edge[((int)i + 2 * KD_RIM_EDGES) % KD_RIM_EDGES] = (float)(cross / (c * dy - s * dx));
    }
    return true;
}

/* Sets all edges. Returns false if the curve does not go round the middle, or if some of the curve is too far from
 * the middle. *least: the curve's least distance from the middle. */
static bool set_edges(struct kd_rim *o, double d[KD_RIM_ANGLES][3], double *least)
{
    double p[KD_RIM_ANGLES][2];
    *least = INFINITY;
    for (int k = 0; k < KD_RIM_ANGLES; k++) {
        if (!on_plane(o, d[k], p[k]))
            return false;
        *least = fmin(*least, hypot(p[k][0], p[k][1]));
    }
    const double *quarter = p[KD_RIM_ANGLES / 4], turning = p[0][0] * quarter[1] - p[0][1] * quarter[0];
    for (int k = 0; k < KD_RIM_ANGLES; k++)
        if (!set_edges_between(o, p[k], p[(k + 1) % KD_RIM_ANGLES], turning))
            return false;
    return true;
}

/* Measures how much the shift of the sky differs between neighbouring points of the curve, while a ray comes e times
 * nearer to the curve. The shift is larger where light leaves its orbit more slowly (photon_shell.h). */
static double winding(const struct kd_critical *curve)
{
    enum { PLACES = 32 };
    double turn = 0, drag = 0, apart = 0;
    for (int i = 0; i <= PLACES; i++) {
        const struct kd_critical_point p = kd_critical_round(curve, (double)i / PLACES);
        const struct kd_shell_exponents e = kd_shell_exponents(&p.orbit);
        const double turned = M_PI / e.gamma,
                     /* delta jumps by pi; the jump is subtracted */
            dragged = (e.delta - copysign(M_PI, e.delta)) / e.gamma;
        if (i)
            apart = fmax(apart, (fabs(turned - turn) + fabs(dragged - drag)) * (2.0 * PLACES / KD_RIM_ANGLES));
        turn = turned, drag = dragged;
    }
    return apart;
}

static void set_widths(struct kd_rim *o, const struct kd_scene *scene, double radius)
{
    const struct kd_camera_exact camera = kd_camera_exact(scene);
    const double turn = fmin(camera.turn_x, camera.turn_y);
    o->pixel = turn > 0 ? 0.5 * M_PI * turn * kd_scene_side(scene) : kd_camera_pixel(scene);
    o->none = fmin(fmax(KD_RIM_PIXELS * o->pixel / radius, KD_RIM_NOISE * radius / o->pixel), KD_RIM_MOST);
    o->full = 0.8 * o->none;
    const double seen = KD_RIM_SEEN * KD_STAR_LEAST * o->pixel * o->pixel / (KD_RIM_BRIGHTEST * radius * radius);
    o->last = fmin(fmax(seen, KD_RIM_NEAREST), KD_RIM_LEAST);
    o->winds = winding(&o->curve) * log(o->none / o->last);
    o->there = o->none > 2 * o->last;
}

bool kd_rim_may_be(const struct kd_scene *scene)
{
    return scene->camera.projection != KD_PROJECTION_RING &&
           scene->camera.r >= 1.05 * kd_kerr_outermost_photon_orbit(kd_scene_hole(scene));
}

void kd_rim_place(const struct kd_rim *rim, double u, double off, double place[2])
{
    double d[3];
    direction(&rim->curve, u, d);
    on_plane(rim, d, place);
    place[0] *= 1 + off;
    place[1] *= 1 + off;
}

void kd_rim_look(const struct kd_rim *rim, const double place[2], double look[3])
{
    for (int i = 0; i < 3; i++)
        look[i] = rim->ahead[i] + place[0] * rim->right[i] + place[1] * rim->up[i];
}

/* True if the outermost and innermost rays escape, all round the curve. */
static bool escapes(const struct kd_scene *scene, const struct kd_rim *o)
{
    const struct kd_sky_rays rays = kd_sky_rays_of(scene);
    bool all = true;
    for (int k = 0; k < 32 && all; k++) {
        double place[2], look[3], where[3];
        kd_rim_place(o, k / 2 * (KD_RIM_ANGLES / 16), k % 2 ? o->last : o->none, place);
        kd_rim_look(o, place, look);
        all = kd_sky_ray(&rays, look, where);
    }
    return all;
}

bool kd_rim_of(const struct kd_scene *scene, struct kd_rim *out)
{
    const struct kd_vantage at = kd_scene_vantage(scene);
    const struct kd_critical_observer observer = {
        .hole = *kd_scene_hole(scene),
        .radius = scene->camera.r,
        .cos_theta = at.u,
        .sin_theta = at.s,
        .motion = kd_scene_observer(scene),
    };
    double d[KD_RIM_ANGLES][3], radius;
    *out = (struct kd_rim) { .flat = isinf(scene->camera.r) };
    if (!kd_rim_may_be(scene))
        return false;
    out->curve = kd_critical_of(&observer);
    if (out->curve.status)
        return false;
    for (int k = 0; k < KD_RIM_ANGLES; k++)
        direction(&out->curve, k, d[k]);
    set_legs(out, d);
    if (!set_edges(out, d, &radius))
        return false;
    set_widths(out, scene, radius);
    out->there = out->there && escapes(scene, out);
    return out->there;
}

double kd_rim_off(const struct kd_rim *rim, const double look[3])
{
    double place[2];
    const bool ahead = rim->flat || dot(look, rim->ahead) > 0;
    on_plane(rim, look, place);
    const double angle = atan2(place[1], place[0]) * (KD_RIM_EDGES / (2 * M_PI));
    const int i = (int)floor(angle) + KD_RIM_EDGES;
    const double part = angle - floor(angle),
                 edge = (1 - part) * rim->edge[i % KD_RIM_EDGES] + part * rim->edge[(i + 1) % KD_RIM_EDGES];
    return ahead ? hypot(place[0], place[1]) / edge - 1 : INFINITY;
}
