#include "render/view/rim.h"

#include "physics/critical.h"
#include "physics/kerr.h"
#include "render/view/camera.h"

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
        struct kd_critical_point p = kd_critical_upper(curve, turn <= 1 ? 1 - turn : turn - 1);
        p.up *= half;
        kd_critical_see(curve, &p);
        const double d[] = { -p.inwards, -p.up, p.right }, plane[] = { p.alpha, half * p.beta, 0 };
        memcpy(out[k], flat ? plane : d, sizeof d);
    }
}

/* The plane about the mean of the directions. */
static void set_legs(struct kd_rim *o, bool flat, double d[KD_RIM_ANGLES][3])
{
    for (int k = 0; k < KD_RIM_ANGLES; k++)
        for (int i = 0; i < 3; i++)
            o->ahead[i] += d[k][i] / KD_RIM_ANGLES;
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

/* How far the sky goes by while a ray comes e times nearer to the curve: the more, the slower light leaves its orbit (photon_shell.h). */
static double pace(const struct kd_critical *curve)
{
    double most = 1;
    for (int i = 0; i <= 8; i++) {
        const struct kd_critical_point p = kd_critical_upper(curve, i / 8.0);
        const struct kd_shell_exponents e = kd_shell_exponents(&p.orbit);
        most = fmax(most, fmax(fabs(e.delta), M_PI) / e.gamma);
    }
    return most;
}

/* From row to row the sky goes by a tenth of a radian, if so many rows are enough for that. */
static void set_rows(struct kd_rim *o, const struct kd_scene *scene, const struct kd_critical *curve)
{
    double radius = INFINITY;
    for (int k = 0; k < KD_RIM_ANGLES; k++)
        radius = fmin(radius, hypot(o->x[k], o->y[k]));
    const struct kd_camera_exact camera = kd_camera_exact(scene);
    const double turn = fmin(camera.turn_x, camera.turn_y), pixel = turn > 0 ? 0.5 * M_PI * turn * kd_scene_side(scene) : kd_camera_pixel(scene);
    o->none = fmin(KD_RIM_PIXELS * pixel / radius, KD_RIM_MOST);
    o->full = 0.8 * o->none;
    o->fall = fmin(0.1 / pace(curve), 0.14);
    o->far = o->none * exp(1.5 * o->fall); /* a row and a half further, for differences */
    const double all = log(o->far / KD_RIM_LEAST);
    o->fall = fmax(o->fall, all / (KD_RIM_ROWS - 1));
    o->rows = all > 2 * o->fall ? (uint32_t)ceil(all / o->fall) : 0;
}

/* Places are whole numbers that a float holds. */
static void set_steps(struct kd_rim *o)
{
    double most = 0;
    for (int k = 0; k < KD_RIM_ANGLES; k++)
        most = fmax(most, fmax(fabs(o->x[k]), fabs(o->y[k])));
    o->steps = exp2(floor(log2((1 << 22) / ((1 + o->far) * most))));
}

bool kd_rim_may_be(const struct kd_scene *scene)
{
    return scene->camera.projection != KD_PROJECTION_RING && scene->camera.r >= 1.05 * kd_kerr_photon_orbit(-fabs(scene->spacetime.spin));
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
    set_steps(&rim);
    if (!rim.rows)
        return false;
    *out = rim;
    return true;
}

#define MIDDLE (1 << 22)

double kd_rim_off(const struct kd_rim *rim, uint32_t i) { return rim->far * exp(-(double)i * rim->fall); }

struct kd_rim_pixel kd_rim_ray(const struct kd_rim *rim, uint32_t k, double off)
{
    const double out = (1 + off) * rim->steps;
    return (struct kd_rim_pixel) { (uint32_t)(MIDDLE + (int)lrint(rim->x[k] * out)), (uint32_t)(MIDDLE - (int)lrint(rim->y[k] * out)) };
}

struct kd_camera_block kd_rim_camera(const struct kd_scene *scene, const struct kd_rim *rim)
{
    struct kd_camera_block o = kd_camera_block(scene);
    const double step = 1 / rim->steps;
    o.c0x = (float)rim->ahead[0], o.c0y = (float)rim->ahead[1], o.c0z = (float)rim->ahead[2];
    o.cxx = (float)(step * rim->right[0]), o.cxy = (float)(step * rim->right[1]), o.cxz = (float)(step * rim->right[2]);
    o.cyx = (float)(step * rim->up[0]), o.cyy = (float)(step * rim->up[1]), o.cyz = (float)(step * rim->up[2]);
    o.middle_x = o.middle_y = MIDDLE;
    o.turn_x = o.turn_y = 0;
    return o;
}
