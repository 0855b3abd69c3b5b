#include "render/view/camera.h"

#include "physics/math/angle.h"
#include "physics/spacetime/kerr.h"
#include "physics/spacetime/observer.h"
#include "scene/hole.h"

#include <math.h>

struct vec { double x, y, z; };
static struct vec mix(double a, struct vec p, double b, struct vec q)
{
    return (struct vec) { a * p.x + b * q.x, a * p.y + b * q.y, a * p.z + b * q.z };
}

static void set_directions(struct kd_camera_exact *o, struct vec c0, struct vec cx, struct vec cy)
{
    o->c0x = c0.x, o->c0y = c0.y, o->c0z = c0.z;
    o->cxx = cx.x, o->cxy = cx.y, o->cxz = cx.z;
    o->cyx = cy.x, o->cyy = cy.y, o->cyz = cy.z;
}

/* Image plane: (alpha, beta) of the middle, and of one step to the right and up. When the camera rolls clockwise,
 * its right-hand side points down. */
static void plane(struct kd_camera_exact *o, const struct kd_camera *c, double step)
{
    double cr = kd_cos_deg(c->roll_deg), sr = kd_sin_deg(c->roll_deg);
    set_directions(o, (struct vec) { c->centre_alpha, c->centre_beta, 0 }, (struct vec) { step * cr, -step * sr, 0 },
                   (struct vec) { step * sr, step * cr, 0 });
}

/* Look directions of a camera at a finite radius, in the local frame (e_r, e_theta, e_phi). Without rotation it
 * looks along -e_r, with +e_phi to the right and -e_theta up. */
static void near(struct kd_camera_exact *o, const struct kd_camera *c, double step)
{
    const struct vec inwards = { -1, 0, 0 }, right = { 0, 0, 1 }, up = { 0, -1, 0 };
    double cy = kd_cos_deg(c->yaw_deg), sy = kd_sin_deg(c->yaw_deg);
    double cp = kd_cos_deg(c->pitch_deg), sp = kd_sin_deg(c->pitch_deg);
    double cr = kd_cos_deg(c->roll_deg), sr = kd_sin_deg(c->roll_deg);
    struct vec level = mix(cy, inwards, sy, right);
    struct vec forward = mix(cp, level, sp, up), upward = mix(cp, up, -sp, level);
    struct vec side = mix(cy, right, -sy, inwards);
    set_directions(o, forward, mix(step * cr, side, -step * sr, upward), mix(step * sr, side, step * cr, upward));
}

double kd_camera_twist(const struct kd_scene *scene)
{
    const struct kd_vantage at = kd_scene_vantage(scene);
    bool falls = scene->camera.observer == KD_OBSERVER_INFALL && isfinite(at.r) && at.r > at.hole.outer;
    return falls ? kd_kerr_twist(&at.hole, at.r) : 0;
}

/* Sets the axes of the observer's frame. A valid scene has no observer where the frame does not exist. */
static void frame(struct kd_camera_exact *o, const struct kd_scene *scene, const struct kd_vantage *at)
{
    const struct kd_observer_motion motion = kd_scene_observer(scene);
    const struct kd_tetrad f = kd_observer_tetrad(&motion, at);
    const double r2 = at->r * at->r; /* w = 1/r, and the ray is traced back, so dw = dr/r^2 */
    o->e_t = f.t.energy, o->e_r = f.r.energy, o->e_theta = f.theta.energy, o->e_phi = f.phi.energy;
    o->l_t = f.t.momentum, o->l_r = f.r.momentum, o->l_theta = f.theta.momentum, o->l_phi = f.phi.momentum;
    o->p_t = f.t.polar, o->p_r = f.r.polar, o->p_theta = f.theta.polar, o->p_phi = f.phi.polar;
    o->dw_t = f.t.radial / r2, o->dw_r = f.r.radial / r2, o->dw_theta = f.theta.radial / r2,
    o->dw_phi = f.phi.radial / r2;
    o->w0 = 1 / at->r;
    o->twist = kd_camera_twist(scene);
}

uint32_t kd_camera_sight(const struct kd_scene *scene)
{
    if (isinf(scene->camera.r))
        return KD_SIGHT_PLANE;
    return scene->camera.projection == KD_PROJECTION_EQUIRECTANGULAR ? KD_SIGHT_SPHERE
           : scene->camera.projection == KD_PROJECTION_FULLDOME      ? KD_SIGHT_DOME
                                                                     : KD_SIGHT_PINHOLE;
}

/* A sphere fills the picture, whatever the picture's sides. A dome's circle touches the nearer sides. */
static void turns(struct kd_camera_exact *o, double width, double height)
{
    o->turn_x = o->sight == KD_SIGHT_SPHERE ? 4 / width : o->sight == KD_SIGHT_DOME ? 2 / fmin(width, height) : 0;
    o->turn_y = o->sight == KD_SIGHT_SPHERE ? 2 / height : o->turn_x;
}

double kd_camera_ahead(uint32_t sight, double turn_x, double turn_y, double *x, double *y)
{
    const double to_right = 0.5 * M_PI * turn_x * *x, upwards = 0.5 * M_PI * turn_y * *y,
                 off = hypot(to_right, upwards);
    switch (sight) {
    case KD_SIGHT_SPHERE:
        *x = cos(upwards) * sin(to_right);
        *y = sin(upwards);
        return cos(upwards) * cos(to_right);
    case KD_SIGHT_DOME:
        *x = off > 0 ? sin(off) / off * to_right : 0;
        *y = off > 0 ? sin(off) / off * upwards : 0;
        return cos(off);
    default: return 1;
    }
}

double kd_camera_pixel(const struct kd_scene *scene)
{
    const struct kd_camera *c = &scene->camera;
    return (isinf(c->r) ? c->field_m : 2 * tan(0.5 * c->fov_deg * (M_PI / 180))) / scene->image.width;
}

/* Upper bound on the sum of the terms' sizes minus the size of their sum. It is twice the constant, plus twice the
 * smaller of the other two terms, which may cancel. */
static double more_than_sum(double constant, double across, double up)
{
    return 2 * (fabs(constant) + fmin(fabs(across), fabs(up)));
}

/* Sets the bounds on rounding errors of rays (kd_rounding of shaders/ray/kerr_ray.glsl). width, height: size of the
 * whole picture, in steps. The components of a unit vector are sums of three orthogonal terms, whose sizes add up to at
 * most sqrt(3). */
static void bound_rounding(struct kd_camera_exact *o, double width, double height)
{
    const double all = sqrt(3), x = 0.5 * width, y = 0.5 * height, h2 = o->horizon * o->horizon;
    double most_l, d_l, d_p;
    if (o->sight == KD_SIGHT_PLANE) {
        o->size_e = 1;
        d_l = more_than_sum(o->c0x, x * o->cxx, y * o->cyx);
        d_p = more_than_sum(o->c0y, x * o->cxy, y * o->cyy);
        most_l = fabs(o->c0x) + x * fabs(o->cxx) + y * fabs(o->cyx);
    } else {
        const bool flat = o->sight == KD_SIGHT_PINHOLE; /* a pinhole's unnormalised directions are no shorter than 1 */
        const double d_theta = flat ? fmin(all, more_than_sum(o->c0y, x * o->cxy, y * o->cyy)) : all,
                     d_phi = flat ? fmin(all, more_than_sum(o->c0z, x * o->cxz, y * o->cyz)) : all;
        o->size_e = fabs(o->e_t) + all * (fabs(o->e_r) + fabs(o->e_theta) + fabs(o->e_phi));
        d_l = 2 * (fabs(o->l_t) + all * (fabs(o->l_r) + fabs(o->l_theta))) + d_phi * fabs(o->l_phi);
        d_p = 2 * (fabs(o->p_t) + all * (fabs(o->p_r) + fabs(o->p_phi))) + d_theta * fabs(o->p_theta);
        most_l = fabs(o->l_t) + all * (fabs(o->l_r) + fabs(o->l_theta) + fabs(o->l_phi));
    }
    const double j = fabs(o->spin) * o->size_e, second = 4 * KD_ROUNDOFF;
    o->noise_w = o->size_e + fabs(o->spin) * h2 * (j + o->s * d_l);
    o->noise_wl = fabs(o->spin) * o->s * h2;
    o->noise_p = d_p;
    o->noise_l = d_l + 2 * o->s * j;
    o->noise_k =
        j * ((1 + o->u * o->u) * j + o->s * d_l) + second * (d_p * d_p + d_l * d_l + j * j + 2 * o->s * j * d_l);
    o->noise_0 = second * (o->noise_w + o->noise_wl * most_l) * (o->noise_w + o->noise_wl * most_l);
}

struct kd_camera_exact kd_camera_exact(const struct kd_scene *scene)
{
    struct kd_camera_exact o = { 0 };
    const struct kd_camera *c = &scene->camera;
    const struct kd_window window = kd_scene_window(scene);
    double width = (double)scene->image.width * kd_scene_side(scene);
    double height = (double)scene->image.height * kd_scene_side(scene);
    const struct kd_vantage at = kd_scene_vantage(scene);

    /* The middle of the whole picture, counted from the first ray of the tile. It is a multiple of one half, which
     * floats hold exactly. */
    o.middle_x = 0.5 * width - 0.5 - (double)window.left * kd_scene_side(scene);
    o.middle_y = 0.5 * height - 0.5 - (double)window.top * kd_scene_side(scene);
    o.width = window.width * (uint32_t)kd_scene_side(scene);
    o.sight = kd_camera_sight(scene);
    turns(&o, width, height);
    o.spin = scene->spacetime.spin;
    o.u = at.u;
    o.s = at.s;
    o.root = at.hole.root;
#define F(name) o.name = kd_hole_##name(&at.hole);
    KD_HOLE_MORE_FIELDS_(F)
#undef F
    o.horizon = 1 / at.hole.outer;
    if (isinf(c->r)) {
        plane(&o, c, kd_camera_pixel(scene) / kd_scene_side(scene));
    } else {
        near(&o, c, o.sight == KD_SIGHT_PINHOLE ? kd_camera_pixel(scene) / kd_scene_side(scene) : 1);
        frame(&o, scene, &at);
    }
    bound_rounding(&o, width, height);
    return o;
}

struct kd_camera_block kd_camera_block(const struct kd_scene *scene)
{
    const struct kd_camera_exact exact = kd_camera_exact(scene);
    struct kd_camera_block o = { 0 };
#define F(name) o.name = (float)kd_lifted(exact.name);
#define U(name) o.name = exact.name;
    KD_CAMERA_FIELDS_(F, U)
#undef F
#undef U
    return o;
}

/* The vector that determines the ray at a place of the picture. At infinity it is (alpha, beta, 0). Otherwise it is
 * the ray's direction, along e_r, e_theta, e_phi, of any length. */
static struct vec direction(const struct kd_camera_exact *c, double px, double py)
{
    double x = px - c->middle_x, y = c->middle_y - py, ahead = kd_camera_ahead(c->sight, c->turn_x, c->turn_y, &x, &y);
    return (struct vec) { ahead * c->c0x + x * c->cxx + y * c->cyx, ahead * c->c0y + x * c->cxy + y * c->cyy,
                          ahead * c->c0z + x * c->cxz + y * c->cyz };
}

void kd_camera_look(const struct kd_camera_exact *c, double x, double y, double out[3])
{
    const struct vec k = direction(c, x, y);
    out[0] = k.x, out[1] = k.y, out[2] = k.z;
}

void kd_camera_direction(const struct kd_camera_exact *c, double x, double y, double out[3])
{
    const struct vec k = direction(c, x, y);
    double n = 1 / sqrt(k.x * k.x + k.y * k.y + k.z * k.z);
    out[0] = n * k.x, out[1] = n * k.y, out[2] = n * k.z;
}

static double along(const struct vec *k, double x, double y, double z) { return k->x * x + k->y * y + k->z * z; }

bool kd_camera_seen(const struct kd_camera_exact *c, const double d[3], double *x, double *y)
{
    const bool flat = c->sight == KD_SIGHT_PLANE;
    const struct vec k = { d[0] - (flat ? c->c0x : 0), d[1] - (flat ? c->c0y : 0), flat ? 0 : d[2] };
    const double depth = along(&k, c->c0x, c->c0y, c->c0z), size = c->cxx * c->cxx + c->cxy * c->cxy + c->cxz * c->cxz;
    double right = along(&k, c->cxx, c->cxy, c->cxz) / size, up = along(&k, c->cyx, c->cyy, c->cyz) / size, off,
           lateral;
    switch (c->sight) {
    case KD_SIGHT_SPHERE:
        off = hypot(right, depth);
        right = atan2(right, depth) / (0.5 * M_PI * c->turn_x);
        up = atan2(up, off) / (0.5 * M_PI * c->turn_y);
        break;
    case KD_SIGHT_DOME:
        lateral = hypot(right, up);
        off = lateral > 0 ? atan2(lateral, depth) / (0.5 * M_PI * c->turn_x * lateral) : 0;
        right *= off, up *= off;
        break;
    case KD_SIGHT_PINHOLE:
        if (!(depth > 0))
            return false;
        right /= depth, up /= depth;
        break;
    default: break;
    }
    *x = c->middle_x + right;
    *y = c->middle_y - up;
    return true;
}

void kd_camera_label(const struct kd_camera_exact *c, uint32_t px, uint32_t py, struct kd_camera_label *out)
{
    const struct vec k = direction(c, px, py);
    if (c->w0 == 0) {
        *out = (struct kd_camera_label) { .alpha = k.x, .beta = k.y, .energy = 1 };
        return;
    }
    kd_camera_label_towards(c, (double[]) { k.x, k.y, k.z }, out);
}

void kd_camera_label_towards(const struct kd_camera_exact *c, const double k[3], struct kd_camera_label *out)
{
    double n = 1 / sqrt(k[0] * k[0] + k[1] * k[1] + k[2] * k[2]), m_r = -k[0] * n, m_theta = -k[1] * n,
           m_phi = -k[2] * n;
    kd_camera_label_of(c->e_t + c->e_r * m_r + c->e_theta * m_theta + c->e_phi * m_phi,
                       c->l_t + c->l_r * m_r + c->l_theta * m_theta + c->l_phi * m_phi,
                       c->p_t - (c->p_r * k[0] + c->p_theta * k[1] + c->p_phi * k[2]) * n,
                       c->dw_t - (c->dw_r * k[0] + c->dw_theta * k[1] + c->dw_phi * k[2]) * n < 0, out);
}

/* Labels cannot express E = 0. So |E| is made at least 1e-12 of the energy that the observer measures; this changes a
 * ray by a relative 1e-12. */
void kd_camera_label_of(double energy, double momentum, double up, bool outward, struct kd_camera_label *out)
{
    double e = fabs(energy) < 1e-12 ? copysign(1e-12, energy) : energy;
    *out = (struct kd_camera_label) { .alpha = -momentum / e, .beta = up / fabs(e), .outward = outward, .energy = e };
}
