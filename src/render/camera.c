#include "render/camera.h"

#include "physics/kerr.h"
#include "physics/tetrad.h"

#include <math.h>

/* Sine and cosine of degrees, exact at the quarter turns: the equatorial plane and the axis are where users look from. */
static double cos_deg(double x)
{
    x = fabs(fmod(x, 360));
    return x == 90 || x == 270 ? 0 : cos(x * (M_PI / 180));
}
static double sin_deg(double x) { return fmod(x, 180) == 0 ? 0 : sin(x * (M_PI / 180)); }

struct vec { double x, y, z; };
static struct vec mix(double a, struct vec p, double b, struct vec q)
{
    return (struct vec){ a * p.x + b * q.x, a * p.y + b * q.y, a * p.z + b * q.z };
}

static void set_directions(struct kd_camera_push *o, struct vec c0, struct vec cx, struct vec cy)
{
    o->c0x = (float)c0.x, o->c0y = (float)c0.y, o->c0z = (float)c0.z;
    o->cxx = (float)cx.x, o->cxy = (float)cx.y, o->cxz = (float)cx.z;
    o->cyx = (float)cy.x, o->cyy = (float)cy.y, o->cyz = (float)cy.z;
}

/* Image plane: (alpha, beta) of the middle, and of one step to the right and up. A camera that rolls clockwise has its
 * right-hand side pointing down. */
static void plane(struct kd_camera_push *o, const struct kd_camera *c, double step)
{
    double cr = cos_deg(c->roll_deg), sr = sin_deg(c->roll_deg);
    set_directions(o, (struct vec){ c->centre_alpha, c->centre_beta, 0 }, (struct vec){ step * cr, -step * sr, 0 },
                   (struct vec){ step * sr, step * cr, 0 });
}

/* Pinhole: look directions in the local frame (e_r, e_theta, e_phi). Unturned, the camera looks along -e_r, with +e_phi to
 * the right and -e_theta up. */
static void pinhole(struct kd_camera_push *o, const struct kd_camera *c, double step)
{
    const struct vec inwards = { -1, 0, 0 }, right = { 0, 0, 1 }, up = { 0, -1, 0 };
    double cy = cos_deg(c->yaw_deg), sy = sin_deg(c->yaw_deg);
    double cp = cos_deg(c->pitch_deg), sp = sin_deg(c->pitch_deg);
    double cr = cos_deg(c->roll_deg), sr = sin_deg(c->roll_deg);
    struct vec level = mix(cy, inwards, sy, right);
    struct vec forward = mix(cp, level, sp, up), upward = mix(cp, up, -sp, level);
    struct vec side = mix(cy, right, -sy, inwards);
    set_directions(o, forward, mix(step * cr, side, -step * sr, upward), mix(step * sr, side, step * cr, upward));
}

/* E and L/sin(theta) of a photon of unit local energy and direction m. */
static void frame(struct kd_camera_push *o, const struct kd_scene *scene, double u, double s)
{
    double a = scene->spacetime.spin, r = scene->camera.r;
    bool zamo = scene->camera.observer == KD_OBSERVER_ZAMO; /* a valid scene has no static one in the ergosphere */
    struct kd_tetrad t = (zamo ? kd_tetrad_zamo : kd_tetrad_static)(a, r, u, s);
    o->e0 = (float)t.e0;
    o->e1 = (float)t.e1;
    o->l0 = (float)t.l0;
    o->l1 = (float)t.l1;
    o->cp = (float)t.p;
    o->cw = (float)(-t.p * t.root_delta / (r * r));
    o->w0 = (float)(1 / r);
}

struct kd_camera_push kd_camera_push(const struct kd_scene *scene)
{
    struct kd_camera_push o = { 0 };
    const struct kd_camera *c = &scene->camera;
    double width = (double)scene->image.width * scene->image.samples;
    double height = (double)scene->image.height * scene->image.samples;
    double u = cos_deg(c->inclination_deg), s = sin_deg(c->inclination_deg);

    o.middle_x = (float)(0.5 * width - 0.5);
    o.middle_y = (float)(0.5 * height - 0.5);
    o.width = (uint32_t)width;
    o.spin = (float)scene->spacetime.spin;
    o.u = (float)u;
    o.s = (float)s;
    o.root = (float)sqrt((1 - scene->spacetime.spin) * (1 + scene->spacetime.spin));
    o.horizon = (float)(1 / kd_kerr_horizon(scene->spacetime.spin));
    if (isinf(c->r)) {
        plane(&o, c, c->field_m / width);
    } else {
        pinhole(&o, c, tan(0.5 * c->fov_deg * (M_PI / 180)) / (0.5 * width));
        frame(&o, scene, u, s);
    }
    return o;
}
