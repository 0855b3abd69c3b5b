#include "render/explain/motion.h"

#include "physics/null/null_polar.h"
#include "physics/spacetime/kerr.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#define FAR 50.0     /* radius in M to which the path normally extends */
#define FARTHEST 1e3 /* largest radius in M to which a crossing further out than FAR extends the path */
#define NEAR 0.01    /* distance from the horizon at which the path ends, as a fraction of the horizon's radius */
#define DEGREES (180 / M_PI)

static const char *const radial_cases[] = { "I", "II", "III", "IV" }, *const polar_cases[] = { "ordinary", "vortical",
                                                                                               "fixed" };
enum { ORDINARY, VORTICAL, FIXED };

const char *kd_ray_radial_case(size_t i)
{
    return i < sizeof radial_cases / sizeof *radial_cases ? radial_cases[i] : NULL;
}
const char *kd_ray_polar_case(size_t i) { return i < sizeof polar_cases / sizeof *polar_cases ? polar_cases[i] : NULL; }

/* Names roots and case number as in Gralla & Lupsasca 2020, arXiv:1910.12881, section IV. */
static void name_roots(struct kd_ray_motion *m)
{
    static const int cases[] = { [KD_NULL_FOUR_REAL] = 1, [KD_NULL_TWO_REAL] = 2, [KD_NULL_NO_REAL] = 3 };
    const struct kd_null_roots *q = &m->roots;
    const double right = sqrt(fabs(q->pair)), left = sqrt(fabs(q->pair_left));
    const bool complex_right = q->kind != KD_NULL_FOUR_REAL, complex_left = q->kind == KD_NULL_NO_REAL;
    m->radial_case = radial_cases[q->kind == KD_NULL_FOUR_REAL && q->r4 > m->horizon ? 0 : cases[q->kind]];
    for (int i = 0; i < 2; i++) {
        const double sign = i ? 1 : -1;
        m->root[i][0] = complex_left ? -q->mean : i ? q->r2 : q->r1;
        m->root[i][1] = complex_left ? sign * left : 0;
        m->root[2 + i][0] = complex_right ? q->mean : i ? q->r4 : q->r3;
        m->root[2 + i][1] = complex_right ? sign * right : 0;
    }
}

/* Roots of (z - v)(N + a^2 v) in v = cos^2(theta), section III of the same paper. */
static void name_polar(struct kd_ray_motion *m, const struct kd_null_motion *constants)
{
    const struct kd_null_polar p = kd_null_polar_of(constants, KD_NULL_TAU_PHI_T);
    const double a2 = p.a * p.a, low = a2 > 0 ? -p.n / a2 : NAN;
    m->polar_root[0] = p.z;
    m->polar_root[1] = low;
    m->polar_case = polar_cases[p.fixed ? FIXED : p.crosses ? ORDINARY : VORTICAL];
    const double most = sqrt(fmax(0, fmin(1, p.z))), least = p.crosses ? -most : sqrt(fmax(0, fmin(1, low)));
    const double side = m->ray.cos_theta < 0 && !p.crosses ? -1 : 1;
    m->theta[0] = p.fixed ? acos(m->ray.cos_theta) : acos(side * (side < 0 ? least : most));
    m->theta[1] = p.fixed ? m->theta[0] : acos(side * (side < 0 ? most : least));
}

struct kd_ray_motion kd_ray_motion_of(const struct kd_null_ray *ray)
{
    struct kd_ray_motion m = { .ray = *ray, .horizon = ray->hole.outer, .turning_r = NAN };
    const struct kd_null_motion constants =
        kd_null_motion_of(&ray->hole, ray->cos_theta, ray->sin_theta, ray->alpha, ray->beta);
    m.within = !(ray->radius > m.horizon);
    m.lambda = constants.lambda, m.eta = constants.eta;
    m.roots = kd_null_roots_of(&constants);
    name_roots(&m);
    name_polar(&m, &constants);
    if (m.within) { /* a ray from inside can turn outside the horizon only at r3 */
        m.turning_r = m.roots.kind == KD_NULL_FOUR_REAL && m.roots.r3 > m.horizon ? m.roots.r3 : NAN;
        return m;
    }
    const struct kd_null_path path = kd_null_trace_fast(ray);
    if (path.turned)
        m.turning_r = path.fate == KD_NULL_ESCAPED ? m.roots.r4 : m.roots.r3;
    return m;
}

static int why_from_within(const struct kd_ray_motion *m, enum kd_ray_fate fate, char *out, size_t size)
{
    if (fate == KD_RAY_ESCAPED)
        return snprintf(out, size,
                        "Followed back, the ray leaves the hole through the horizon and escapes to the sky.");
    if (isfinite(m->turning_r))
        return snprintf(out, size,
                        "Followed back, the ray leaves the hole through the horizon, rises to r = %.6g M, turns, and "
                        "falls to the horizon of the hole's past.",
                        m->turning_r);
    return snprintf(
        out, size,
        "Followed back, the ray stays inside until the horizon of the hole's past: its light has no source outside.");
}

int kd_ray_motion_why(const struct kd_ray_motion *m, enum kd_ray_fate fate, char *out, size_t size)
{
    if (fate == KD_RAY_UNDECIDED)
        return snprintf(out, size,
                        "Followed back, the ray is so close to the critical curve that double precision cannot decide "
                        "whether it escapes.");
    if (m->within)
        return why_from_within(m, fate, out, size);
    if (fate == KD_RAY_ESCAPED && isfinite(m->turning_r))
        return snprintf(out, size, "Followed back, the ray turns at r = %.6g M and escapes to the sky.", m->turning_r);
    if (fate == KD_RAY_ESCAPED)
        return snprintf(
            out, size,
            "Followed back, the ray leaves the observer outwards and escapes to the sky without a turning point.");
    if (isfinite(m->turning_r))
        return snprintf(out, size, "Followed back, the ray rises to r = %.6g M, turns, and falls to the horizon.",
                        m->turning_r);
    if (!m->ray.outward)
        return snprintf(out, size, "Followed back, the ray falls to the horizon without a turning point.");
    return snprintf(out, size, "Followed back, the ray ends at the horizon.");
}

enum kd_status kd_ray_path_draw(const struct kd_ray_motion *m, const struct kd_ray_path_frame *frame,
                                const struct kd_ray_crossing *crossings, size_t n, struct kd_ray_path *path,
                                struct kd_error *error)
{
    double far = isfinite(m->ray.radius) ? fmax(FAR, 2 * m->ray.radius) : FAR, near = NEAR * m->horizon;
    for (size_t i = 0; i < n; i++) {
        far = fmax(far, fmin(1.25 * crossings[i].r, FARTHEST));
        if (crossings[i].r > m->horizon)
            near = fmin(near, 0.5 * (crossings[i].r - m->horizon));
    }
    *path = (struct kd_ray_path) { .frame = *frame, .spin = m->ray.hole.a, .ingoing = m->within, .error = NAN };
    if (!(path->places = malloc(KD_PATH_PLACES * sizeof *path->places)))
        return kd_error_set(error, KD_ENOMEM, "out of memory for the path of a ray");
    path->course = m->within ? kd_null_course_ingoing(&m->ray, frame->reversed, far, near, path->places, KD_PATH_PLACES)
                             : kd_null_course_of(&m->ray, far, near, path->places, KD_PATH_PLACES);
    for (size_t i = 0; i < path->course.n && !m->within; i++) {
        const struct kd_null_place *p = &path->places[i];
        if (p->crossing >= 0 && p->crossing < (int)n)
            path->error = fmax(path->error, fabs(p->r / crossings[p->crossing].r - 1));
    }
    return KD_OK;
}

void kd_ray_path_finish(struct kd_ray_path *path)
{
    free(path->places);
    path->places = NULL;
}

double kd_ray_path_phi(const struct kd_ray_path_frame *f, double phi) { return (f->reversed ? -phi : phi) + f->twist; }
double kd_ray_path_delay(const struct kd_ray_path_frame *f, double delay) { return f->reversed ? -delay : delay; }

void kd_ray_path_at(const struct kd_ray_path *path, const struct kd_null_place *p, double out[3])
{
    const double a = path->spin, phi = kd_ray_path_phi(&path->frame, p->phi) + path->frame.azimuth,
                 across = sqrt((p->r * p->r + a * a) * (1 - p->u) * (1 + p->u));
    out[0] = across * cos(phi);
    out[1] = across * sin(phi);
    out[2] = p->r * p->u;
}

const char *const kd_ray_path_columns[KD_PATH_COLUMNS] = { "x", "y", "z", "r", "theta", "phi", "delay", "order" };

void kd_ray_path_row(const struct kd_ray_path *path, size_t i, double out[KD_PATH_COLUMNS])
{
    const struct kd_null_place *p = &path->places[i];
    kd_ray_path_at(path, p, out);
    out[3] = p->r;
    out[4] = acos(p->u);
    out[5] = kd_ray_path_phi(&path->frame, p->phi);
    out[6] = kd_ray_path_delay(&path->frame, p->delay);
    out[7] = p->order;
}

static int real_roots(const struct kd_ray_motion *m)
{
    return m->roots.kind == KD_NULL_FOUR_REAL ? 4 : m->roots.kind == KD_NULL_TWO_REAL ? 2 : 0;
}

void kd_ray_motion_json(struct kd_json *json, const struct kd_ray_motion *m)
{
    kd_json_object(json, "radial");
    kd_json_string(json, "case", m->radial_case);
    kd_json_number(json, "real_roots", real_roots(m));
    kd_json_array(json, "roots");
    for (int i = 0; i < 4; i++) {
        kd_json_array(json, NULL);
        kd_json_number(json, NULL, m->root[i][0]);
        kd_json_number(json, NULL, m->root[i][1]);
        kd_json_end(json);
    }
    kd_json_end(json);
    kd_json_number(json, "horizon_r", m->horizon);
    kd_json_number(json, "turning_r", m->turning_r);
    kd_json_end(json);
    kd_json_object(json, "polar");
    kd_json_string(json, "case", m->polar_case);
    kd_json_array(json, "roots");
    for (int i = 0; i < 2; i++)
        kd_json_number(json, NULL, m->polar_root[i]);
    kd_json_end(json);
    kd_json_array(json, "theta");
    for (int i = 0; i < 2; i++)
        kd_json_number(json, NULL, m->theta[i]);
    kd_json_end(json);
    kd_json_end(json);
}

void kd_ray_path_json(struct kd_json *json, const struct kd_ray_path *path)
{
    kd_json_object(json, "path");
    kd_json_number(json, "steps", (double)path->course.steps);
    kd_json_number(json, "least_r", path->course.least_r);
    kd_json_string(json, "coordinates", path->ingoing ? "ingoing" : "Boyer-Lindquist");
    kd_json_bool(json, "whole", path->course.end == KD_COURSE_CAPTURED || path->course.end == KD_COURSE_ESCAPED);
    kd_json_array(json, "columns");
    for (size_t i = 0; i < KD_PATH_COLUMNS; i++)
        kd_json_string(json, NULL, kd_ray_path_columns[i]);
    kd_json_end(json);
    kd_json_array(json, "points");
    for (size_t i = 0; i < path->course.n; i++) {
        double row[KD_PATH_COLUMNS];
        kd_ray_path_row(path, i, row);
        kd_json_array(json, NULL);
        for (size_t k = 0; k < KD_PATH_COLUMNS; k++)
            kd_json_number(json, NULL, row[k]);
        kd_json_end(json);
    }
    kd_json_end(json);
    kd_json_end(json);
}

enum kd_status kd_ray_motion_text(const struct kd_ray_motion *m, struct kd_buffer *out)
{
    enum kd_status status;
    KD_TRY(kd_buffer_printf(out, "radial case %s, roots", m->radial_case));
    for (int i = 0; i < 4; i++)
        KD_TRY(m->root[i][1] != 0 ? kd_buffer_printf(out, " %.6g%+.6gi", m->root[i][0], m->root[i][1])
                                  : kd_buffer_printf(out, " %.6g", m->root[i][0]));
    KD_TRY(kd_buffer_printf(out, "; horizon %.6g\npolar motion %s, theta %.4f to %.4f deg, cos^2 theta roots %.6g",
                            m->horizon, m->polar_case, DEGREES * m->theta[0], DEGREES * m->theta[1], m->polar_root[0]));
    if (isfinite(m->polar_root[1]))
        KD_TRY(kd_buffer_printf(out, " %.6g", m->polar_root[1]));
    KD_TRY(kd_buffer_printf(out, "\n"));
done:
    return status;
}
