#include "render/view/rim.h"

#include "physics/critical.h"
#include "physics/kerr.h"
#include "render/view/camera.h"
#include "render/view/rim_sky.h"

#include <math.h>
#include <string.h>

static double dot(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

static void scale(double a[3], double by)
{
    for (int i = 0; i < 3; i++)
        a[i] *= by;
}

/* Directions of the curve's points in the observer's frame, or alpha and beta. They go round once, without a gap: the place of an orbit goes as a
 * cosine. */
static void directions(const struct kd_critical *curve, double out[KD_RIM_ANGLES][3])
{
    const bool flat = isinf(curve->observer.radius);
    for (int k = 0; k < KD_RIM_ANGLES; k++) {
        const double turn = 2.0 * k / KD_RIM_ANGLES, half = turn <= 1 ? 1 : -1;
        struct kd_critical_point p = kd_critical_round(curve, turn <= 1 ? 1 - turn : turn - 1);
        p.up *= half;
        kd_critical_see(curve, &p);
        const double d[] = { -p.inwards, -p.up, p.right }, plane[] = { p.alpha, half * p.beta, 0 };
        memcpy(out[k], flat ? plane : d, sizeof d);
    }
}

/* The plane about the mean of the directions along the curve. */
static void set_legs(struct kd_rim *o, bool flat, double d[KD_RIM_ANGLES][3])
{
    double all = 0;
    for (int k = 0; k < KD_RIM_ANGLES; k++) {
        const double *before = d[(k + KD_RIM_ANGLES - 1) % KD_RIM_ANGLES], *after = d[(k + 1) % KD_RIM_ANGLES];
        const double step[] = { after[0] - before[0], after[1] - before[1], after[2] - before[2] }, length = sqrt(dot(step, step));
        all += length;
        for (int i = 0; i < 3; i++)
            o->ahead[i] += length * d[k][i];
    }
    scale(o->ahead, 1 / all);
    if (flat) {
        o->right[0] = o->up[1] = 1;
        return;
    }
    scale(o->ahead, 1 / sqrt(dot(o->ahead, o->ahead)));
    const double *a = o->ahead, across[] = { 0, 0, 1 }, down[] = { 0, 1, 0 }, *beside = fabs(a[2]) < 0.7 ? across : down;
    for (int i = 0; i < 3; i++)
        o->right[i] = beside[i] - dot(beside, a) * a[i];
    scale(o->right, 1 / sqrt(dot(o->right, o->right)));
    const double up[] = { a[1] * o->right[2] - a[2] * o->right[1], a[2] * o->right[0] - a[0] * o->right[2], a[0] * o->right[1] - a[1] * o->right[0] };
    memcpy(o->up, up, sizeof up);
}

/* False: some of the curve is too far off the middle. */
static bool set_curve(struct kd_rim *o, bool flat, double d[KD_RIM_ANGLES][3])
{
    const double widest = cos(80 * (M_PI / 180));
    for (int k = 0; k < KD_RIM_ANGLES; k++) {
        const double from[] = { d[k][0] - o->ahead[0], d[k][1] - o->ahead[1], d[k][2] }, depth = flat ? 1 : dot(d[k], o->ahead);
        if (!(depth > widest))
            return false;
        o->x[k] = dot(flat ? from : d[k], o->right) / depth;
        o->y[k] = dot(flat ? from : d[k], o->up) / depth;
    }
    return true;
}

/* From one point of the curve to the next: where rays from the middle meet the straight line between them. False: it does not go round the middle. */
static bool set_edges_between(struct kd_rim *o, int k, double turning)
{
    const int next = (k + 1) % KD_RIM_ANGLES;
    const double unit = KD_RIM_EDGES / (2 * M_PI), cross = o->x[k] * o->y[next] - o->y[k] * o->x[next];
    const double from = atan2(o->y[k], o->x[k]), by = atan2(cross, o->x[k] * o->x[next] + o->y[k] * o->y[next]);
    if (!(by * turning > 0))
        return false;
    const double low = (by > 0 ? from : from + by) * unit, high = (by > 0 ? from + by : from) * unit;
    const double dx = o->x[next] - o->x[k], dy = o->y[next] - o->y[k];
    for (double i = ceil(low); i <= high; i++) {
        const double c = cos(i / unit), s = sin(i / unit);
        o->edge[((int)i + 2 * KD_RIM_EDGES) % KD_RIM_EDGES] = (float)(cross / (c * dy - s * dx));
    }
    return true;
}

static bool set_edges(struct kd_rim *o)
{
    const double turning = o->x[0] * o->y[KD_RIM_ANGLES / 4] - o->y[0] * o->x[KD_RIM_ANGLES / 4];
    for (int k = 0; k < KD_RIM_ANGLES; k++)
        if (!set_edges_between(o, k, turning))
            return false;
    return true;
}

/* How far the sky goes by while a ray comes e times nearer to the curve: the more, the slower light leaves its orbit (photon_shell.h). *apart: how much less or more that
 * is at the next column. */
static double pace(const struct kd_critical *curve, double *apart)
{
    enum { PLACES = 32 };
    double most = 1, turn = 0, drag = 0;
    *apart = 0;
    for (int i = 0; i <= PLACES; i++) {
        const struct kd_critical_point p = kd_critical_round(curve, (double)i / PLACES);
        const struct kd_shell_exponents e = kd_shell_exponents(&p.orbit);
        const double turned = M_PI / e.gamma, dragged = (e.delta - copysign(M_PI, e.delta)) / e.gamma; /* the latter without the jump of delta */
        if (i)
            *apart = fmax(*apart, (fabs(turned - turn) + fabs(dragged - drag)) * (2.0 * PLACES / KD_RIM_ANGLES));
        most = fmax(most, fmax(fabs(e.delta), M_PI) / e.gamma);
        turn = turned, drag = dragged;
    }
    return most;
}

/* From row to row the sky goes by KD_RIM_STEP, if so many rows are enough for that. */
static void set_rows(struct kd_rim *o, const struct kd_scene *scene, const struct kd_critical *curve)
{
    double radius = INFINITY;
    for (int k = 0; k < KD_RIM_ANGLES; k++)
        radius = fmin(radius, hypot(o->x[k], o->y[k]));
    const struct kd_camera_exact camera = kd_camera_exact(scene);
    const double turn = fmin(camera.turn_x, camera.turn_y), pixel = turn > 0 ? 0.5 * M_PI * turn * kd_scene_side(scene) : kd_camera_pixel(scene);
    o->none = fmin(fmax(KD_RIM_PIXELS * pixel / radius, KD_RIM_NOISE * radius / pixel), KD_RIM_MOST);
    o->full = 0.8 * o->none;
    double apart;
    const double by_e = pace(curve, &apart), seen = KD_RIM_SEEN * KD_STAR_LEAST * pixel * pixel / (KD_RIM_BRIGHTEST * radius * radius);
    o->fall = KD_RIM_STEP / by_e;
    o->far = o->none * exp(2.5 * o->fall); /* two rows and a half further, for differences */
    const double all = log(o->far / fmin(fmax(seen, KD_RIM_NEAREST), KD_RIM_LEAST));
    o->fall = fmax(o->fall, all / (KD_RIM_ROWS - 1));
    o->apart = fmax(o->fall * by_e, all * apart);
    o->rows = all > 2 * o->fall ? (uint32_t)ceil(all / o->fall) : 0;
}

bool kd_rim_may_be(const struct kd_scene *scene)
{
    return scene->camera.projection != KD_PROJECTION_RING && scene->camera.r >= 1.05 * kd_kerr_photon_orbit(-fabs(scene->spacetime.spin));
}

/* Rays of the first row and of the last, all round, end in the sky. */
static bool escapes(const struct kd_scene *scene, const struct kd_rim *o)
{
    double where[3];
    bool all = true;
    for (uint32_t k = 0; k < KD_RIM_ANGLES && all; k += KD_RIM_ANGLES / 16)
        all = kd_rim_sky_at(scene, o, k, o->far, where) && kd_rim_sky_at(scene, o, k, o->far * exp(-(o->rows - 1.0) * o->fall), where);
    return all;
}

bool kd_rim_of(const struct kd_scene *scene, struct kd_rim *out)
{
    const struct kd_vantage at = kd_scene_vantage(scene);
    const struct kd_critical_observer observer = {
        .spin = scene->spacetime.spin, .radius = scene->camera.r, .cos_theta = at.u, .sin_theta = at.s, .motion = kd_scene_observer(scene),
    };
    double d[KD_RIM_ANGLES][3];
    struct kd_rim rim = { 0 };
    *out = rim;
    if (!kd_rim_may_be(scene))
        return false;
    const struct kd_critical curve = kd_critical_of(&observer);
    if (curve.status)
        return false;
    directions(&curve, d);
    set_legs(&rim, isinf(scene->camera.r), d);
    if (!set_curve(&rim, isinf(scene->camera.r), d) || !set_edges(&rim))
        return false;
    set_rows(&rim, scene, &curve);
    if (!rim.rows || !escapes(scene, &rim))
        return false;
    *out = rim;
    return true;
}

void kd_rim_look(const struct kd_rim *rim, double x, double y, double look[3])
{
    for (int i = 0; i < 3; i++)
        look[i] = rim->ahead[i] + x * rim->right[i] + y * rim->up[i];
}

double kd_rim_off(const struct kd_rim *rim, const double look[3], bool flat)
{
    const double from[] = { look[0] - rim->ahead[0], look[1] - rim->ahead[1], 0 }, depth = flat ? 1 : dot(look, rim->ahead);
    const double x = dot(flat ? from : look, rim->right), y = dot(flat ? from : look, rim->up), angle = atan2(y, x) * (KD_RIM_EDGES / (2 * M_PI));
    const int i = (int)floor(angle) + KD_RIM_EDGES;
    const double part = angle - floor(angle), edge = (1 - part) * rim->edge[i % KD_RIM_EDGES] + part * rim->edge[(i + 1) % KD_RIM_EDGES];
    return depth > 0 ? hypot(x, y) / (depth * edge) - 1 : INFINITY;
}

/* By Lagrange's form, from places -2 ... 2. */
static double quartic(const double *values, int middle, double x)
{
    static const double over[] = { 24, -6, 4, -6, 24 };
    double sum = 0;
    for (int i = -2; i <= 2; i++) {
        double w = values[(middle + i + KD_RIM_ANGLES) % KD_RIM_ANGLES] / over[i + 2];
        for (int j = -2; j <= 2; j++)
            w *= j == i ? 1 : x - j;
        sum += w;
    }
    return sum;
}

void kd_rim_between(const struct kd_rim *rim, double column, double row, double place[2])
{
    const double nearest = nearbyint(column), out = 1 + rim->far * exp(-row * rim->fall);
    const int middle = (int)(nearest - KD_RIM_ANGLES * floor(nearest / KD_RIM_ANGLES));
    place[0] = out * quartic(rim->x, middle, column - nearest);
    place[1] = out * quartic(rim->y, middle, column - nearest);
}
