/* Tests of lens maps of pictures at the extremes, for cameras at infinity, and at rest in a locally non-rotating frame
 * next to the horizon. All values of the lens map must be finite. Radii, azimuths and fates are compared with the
 * closed form.
 *
 * A picture's ray has labels of single precision. The labels of a finite camera are sums such as E = e_t + e_phi m_phi,
 * which lose digits where the terms cancel. Rays that change their kind when all inputs move by a few roundings are
 * unsure. */
#include "extremes.h"

#include "physics/spacetime/kerr.h"
#include "render/view/camera.h"
#include "vk/vk.h"

#include "interface.h"

#include <float.h>
#include <math.h>
#include <stdio.h>

enum { GRID = 20, RAYS = GRID * GRID, ORDERS = 8, PLANES = 2 * ORDERS + 3 };

struct kernel {
    const char *name;
    struct kd_needs needs;
    int steps;
    double bound, phi_bound;
};

/* Bounds as in docs/accuracy.md. At order 7 the closed form loses one digit, because it starts its series at an eighth
 * of the Mino time. */
static const struct kernel kernels[] = {
    { "lens_closed", { .quantities = KD_LENS_W }, 0, 5e-6, INFINITY },
    { "lens_closed", { .quantities = KD_LENS_W | KD_LENS_PHI | KD_LENS_SKY }, 0, 5e-6, 2e-6 },
    { "lens_map 8", { .quantities = KD_LENS_W | KD_LENS_SKY }, 8, 5e-6, INFINITY },
    { "lens_map 16", { .quantities = KD_LENS_W | KD_LENS_PHI | KD_LENS_SKY }, 16, 5e-6, 2e-6 },
};

struct camera {
    const char *what;
    double spin, inclination, r, field, beta, yaw;
};

static struct kd_scene scene_of(const struct camera *v, int steps)
{
    struct kd_scene scene;
    kd_scene_smooth(&scene);
    scene.spacetime.spin = v->spin;
    scene.camera.inclination_deg = v->inclination;
    scene.camera.r = v->r;
    scene.camera.observer = isinf(v->r) ? KD_OBSERVER_STATIC : KD_OBSERVER_ZAMO;
    *(isinf(v->r) ? &scene.camera.field_m : &scene.camera.fov_deg) = v->field;
    scene.camera.centre_beta = v->beta;
    scene.camera.yaw_deg = v->yaw;
    scene.image.width = scene.image.height = GRID;
    scene.accuracy.orders = ORDERS;
    scene.accuracy.steps = steps;
    return scene;
}

/* The ray of a pixel, computed in the kernel's own arithmetic, and the error of its labels in units of one rounding.
 * Returns false for E <= 0, which the closed form does not support. */
static bool ray_of(const struct camera *v, const struct kd_camera_block *c, int pixel, struct kd_null_ray *ray,
                   double *weight)
{
    float x = (float)(pixel % GRID) - c->middle_x, y = c->middle_y - (float)(pixel / GRID);
    float kx = c->c0x + x * c->cxx + y * c->cyx, ky = c->c0y + x * c->cxy + y * c->cyy;
    double i = v->inclination;
    *ray = (struct kd_null_ray) { .hole = kd_hole_of(v->spin),
                                  .radius = v->r,
                                  .cos_theta = extreme_cos_deg(i),
                                  .sin_theta = extreme_sin_deg(i),
                                  .alpha = kx,
                                  .beta = ky,
                                  .orders = ORDERS };
    for (int k = 0; k < EXTREME_INPUTS; k++)
        weight[k] = 1;
    if (isinf(v->r))
        return true;
    float kz = c->c0z + x * c->cxz + y * c->cyz, n = 1 / sqrtf(kx * kx + ky * ky + kz * kz);
    double m_phi = -kz * n, energy = c->e_t + c->e_phi * m_phi,
           l = c->l_t + c->l_phi * m_phi; /* angular momentum L of an observer at rest */
    ray->alpha = -l / energy;
    ray->beta = -c->p_theta * ky * n / energy;
    ray->outward = kx > 0;
    double cancels = (fabs(c->e_t) + fabs(c->e_phi * m_phi)) / fabs(energy);
    weight[0] = cancels + (fabs(c->l_t) + fabs(c->l_phi * m_phi)) / fmax(fabs(l), 1e-30);
    weight[1] = cancels + 1;
    return energy > 1e-6;
}

struct tally {
    double r[RAYS * ORDERS], phi;
    size_t n;
};

static double turn(double x) { return fabs(remainder(x, 2 * M_PI)); }

static void judge(const struct camera *v, const struct kd_plan *plan, const float *map, const struct kd_null_ray *ray,
                  const double *weight, struct tally *t, struct extreme_row *row)
{
    struct kd_null_path p = kd_null_trace(ray);
    double gain[KD_NULL_ORDERS], phi_gain[KD_NULL_ORDERS], least = INFINITY;
    const float *fate = map + (plan->lens.planes - 1) * plan->lens.rays;
    int found = 0;
    for (uint32_t k = 0; k < plan->lens.planes; k++)
        if (!isfinite(map[k * plan->lens.rays])) {
            row->broken++;
            return;
        }
    while (found < ORDERS && map[(uint64_t)found * plan->lens.rays] > 0)
        found++;
    /* for a ray on its way out, this includes the part of the path from infinity */
    for (int n = 0; n < p.crossings; n++) {
        double w = 1 / p.crossing[n].r;
        least = fmin(least, fmin(p.crossing[n].sense > 0 ? 1 : w, 1 / kd_hole(v->spin)->outer - w));
    }
    /* A pixel's labels and motion are computed with some twenty roundings. */
    bool steady = p.status == KD_NULL_OK && least > 1e-6 && extreme_steady(ray, &p, 20 * FLT_EPSILON, weight);
    extreme_condition(ray, &p, 1e-9, weight, gain, phi_gain);
    if (!steady || (p.crossings && gain[p.crossings - 1] > 1e5)) {
        row->unsure++;
        return;
    }
    row->broken += found != p.crossings || (kd_plan_holds(&plan->lens, KD_LENS_SKY) &&
                                            (*fate == (float)KD_FATE_ESCAPED) != (p.fate == KD_NULL_ESCAPED));
    for (int n = 0; n < p.crossings && n < found; n++) {
        const struct kd_null_crossing *x = &p.crossing[n];
        double w = map[(uint64_t)n * plan->lens.rays];
        t->r[t->n++] = fmax(fabs(1 / w / x->r - 1) - x->error_r, 0) / (1 + gain[n]);
        if (!kd_plan_holds(&plan->lens, KD_LENS_PHI) || x->r < 1.6 * kd_hole(v->spin)->outer)
            continue;
        double phi = map[(uint64_t)(ORDERS + n) * plan->lens.rays];
        t->phi = fmax(t->phi, fmax(turn(phi - x->phi) - x->error_phi, 0) / (1 + phi_gain[n]));
    }
}

/* Rays within 1e-3 M of the shadow's edge are all unsure. Close to the horizon of an extremal hole, all rays from
 * infinity have L = 2E to 1e-4, so that the labels lose half of their digits. */
static double unsure_most(const struct camera *v)
{
    return v->field < 1e-4 && isinf(v->r) ? 1 : fabs(v->spin) > 0.999 && v->r < 1.001 ? 0.5 : 0.1;
}

static void look(struct kd_renderer *renderer, const struct camera *v, const struct kernel *kernel)
{
    static struct tally t;
    static float planes[PLANES * RAYS];
    struct extreme_row row = { .engine = kernel->name,
                               .rays = RAYS,
                               .bound = kernel->bound,
                               .phi_bound = kernel->phi_bound,
                               .unsure_most = unsure_most(v) };
    struct kd_scene scene = scene_of(v, kernel->steps);
    struct kd_camera_block camera = kd_camera_block(&scene);
    struct kd_capacity capacity;
    struct kd_plan plan;
    struct kd_error error = { 0 };
    kd_renderer_capacity(renderer, &capacity);
    snprintf(row.what, sizeof row.what, "%s", v->what);
    t.n = 0, t.phi = 0;
    if (kd_scene_validate(&scene, &error) || kd_plan_make_for(&scene, &kernel->needs, &capacity, &plan, &error) ||
        kd_render_lens(renderer, &scene, &plan, planes, NULL, &error)) {
        printf("%s: %s\n", v->what, error.message);
        row.broken = RAYS;
        extreme_row(&row);
        return;
    }
    for (int k = 0; k < RAYS; k++) {
        struct kd_null_ray ray;
        double weight[EXTREME_INPUTS];
        if (ray_of(v, &camera, k, &ray, weight)) {
            judge(v, &plan, planes + k, &ray, weight, &t, &row);
            continue;
        }
        for (uint32_t n = 0; n < plan.lens.planes; n++)
            row.broken += !isfinite(planes[n * plan.lens.rays + (uint64_t)k]);
    }
    extreme_spread(t.r, t.n, &row);
    row.phi = t.n && kd_plan_holds(&plan.lens, KD_LENS_PHI) ? t.phi : NAN;
    extreme_row(&row);
}

static void look_with_all(struct kd_renderer *renderer, const struct camera *v)
{
    for (int k = v->r > 1.05 * kd_kerr_photon_orbit(kd_hole(-fabs(v->spin))) ? 0 : 2; k < 4; k++)
        look(renderer, v, &kernels[k]);
}

void extreme_lenses(struct kd_renderer *renderer)
{
    const double near1 = 0.999999999999, up = nextafter(90, 91), down = nextafter(90, 0);
    const struct camera far[] = {
        { "a 0, i 90-", 0, down, INFINITY, 24, 0, 0 },
        { "a 5e-324, i 0+", 5e-324, 5e-324, INFINITY, 24, 0, 0 },
        { "a 0.9, i 90, 21 M", 0.9, 90, INFINITY, 21, 0, 0 },
        { "a 0.9, i 180", 0.9, 180, INFINITY, 24, 0, 0 },
        { "a 1-1e-7, i 85", 0.9999999, 85, INFINITY, 20, 0, 0 },
        { "a 1-1e-12, i 0", near1, 0, INFINITY, 24, 0, 0 },
        { "a 1-1e-12, i 60", near1, 60, INFINITY, 24, 0, 0 },
        { "a 1-1e-12, i 90+", near1, up, INFINITY, 24, 0, 0 },
        { "a -1+1e-12, i 90", -near1, 90, INFINITY, 24, 0, 0 },
        { "a -1+1e-12, i 120", -near1, 120, INFINITY, 24, 0, 0 },
        { "a 0.9, i 60, 1e5 M", 0.9, 60, INFINITY, 1e5, 0, 0 },
        { "a 0, i 60, 1e-6 M at the edge", 0, 60, INFINITY, 1e-6, 5.196152422706632, 0 },
    };
    for (size_t k = 0; k < sizeof far / sizeof *far; k++)
        look_with_all(renderer, &far[k]);
    static const struct {
        const char *name;
        double a;
    } spins[] = { { "a 0", 0 }, { "a 0.9", 0.9 }, { "a 1-1e-12", 0.999999999999 }, { "a -1+1e-12", -0.999999999999 } };
    for (int a = 0; a < 4; a++) {
        double spin = spins[a].a;
        const struct {
            const char *name;
            double r, fov, yaw;
        } places[] = {
            { "1.0001 r+", 1.0001 * kd_hole(spin)->outer, 120, 180 },
            { "r photon", kd_kerr_photon_orbit(kd_hole(spin)), 120, 90 },
            { "r photon, retrograde", kd_kerr_photon_orbit(kd_hole(-spin)), 120, 90 },
            { "r 1e6", 1e6, 2e-3, 0 },
        };
        for (int k = 0; k < 8; k++) {
            char what[48];
            /* single precision does not separate the camera from a prograde photon orbit */
            if (places[k / 2].r < 1.000001 * kd_hole(spin)->outer)
                continue;
            snprintf(what, sizeof what, "%s, i %d, %s", spins[a].name, k % 2 ? 90 : 60, places[k / 2].name);
            look_with_all(renderer, &(struct camera) { what, spin, k % 2 ? 90 : 60, places[k / 2].r, places[k / 2].fov,
                                                       0, places[k / 2].yaw });
        }
    }
}
