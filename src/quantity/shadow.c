#include "quantity/define.h"

#include "physics/math/angle.h"
#include "physics/null/critical.h"

#define PARAMETERS(P) \
    KD_PARAMETER_SPIN(P) \
    KD_PARAMETER_HOLE_MORE(P) \
    P(inclination_deg, .unit = "degrees", .typed = "60", .least = 0, .most = 180, \
      .help = "polar angle of the observer") \
    KD_PARAMETER_OBSERVER(P) \
    P(angle_deg, .unit = "degrees", .typed = "0:355:72", .least = -360, .most = 720, \
      .help = "angle about the curve's centre, from the right over the top")
#define OUTPUTS(O) \
    O(alpha, .unit = "M", \
      .help = "coordinate of the curve on the image plane, to the right; at any distance it labels the constants of " \
              "motion") \
    O(beta, .unit = "M", \
      .help = "coordinate of the curve on the image plane, along the projected spin; at any distance it labels the " \
              "constants of motion") \
    O(rho, .unit = "M or radians", \
      .help = "distance from the centre, in M for an observer at infinity, otherwise an angle on the sky") \
    KD_RESULTS_DIRECTION(O) \
    O(orbit_r, .unit = "M", .help = "radius of the photon orbit seen at this point of the curve") \
    O(lyapunov, .unit = "1", \
      .help = \
          "Lyapunov exponent gamma of this orbit: with each half turn, images lie closer to the curve by e^-gamma") \
    O(area, .unit = "M^2 or sr", .fixed = true, .help = "area of the shadow in M^2, or its solid angle") \
    O(mean_radius, .unit = "M or radians", .fixed = true, \
      .help = "mean of rho about the midpoint of the left and right ends") \
    O(displacement, .unit = "M or radians", .fixed = true, \
      .help = "displacement of the midpoint of the left and right ends from the hole's centre, to the right") \
    O(asymmetry, .unit = "M or radians", .fixed = true, \
      .help = "twice the root mean square of the difference of rho and its mean") \
    O(width, .unit = "M or radians", .fixed = true, .help = "extent from left to right") \
    O(height, .unit = "M or radians", .fixed = true, .help = "extent from bottom to top")
KD_QUANTITY_TABLES(PARAMETERS, OUTPUTS)

static const char *const sources[] = {
    "J. M. Bardeen 1973, in Black Holes (Les Houches), p. 215; E. Teo 2003, Gen. Rel. Grav. 35, 1909",
    "T. Johannsen & D. Psaltis 2010, ApJ 718, 446; C.-K. Chan, D. Psaltis & F. Ozel 2013, ApJ 777, 13 (displacement, "
    "radius, asymmetry)",
    "M. D. Johnson et al. 2020, Sci. Adv. 6, eaaz1310 (gamma)",
    NULL,
};
static const char *const approximations[] = { NULL };

struct memory { struct kd_critical curve; };

static enum kd_status make_curve(const struct parameters *p, struct memory *m, struct outputs *o,
                                 struct kd_error *error)
{
    const struct kd_vantage at = { kd_hole_in(p), p->observer_r, kd_cos_deg(p->inclination_deg),
                                   kd_sin_deg(p->inclination_deg) };
    const struct kd_critical_observer observer = {
        .hole = at.hole,
        .radius = at.r,
        .cos_theta = at.u,
        .sin_theta = at.s,
        .motion = KD_QUANTITY_MOTION(p),
    };
    if (kd_hole_check(&at.hole, error))
        return KD_EINVAL;
    if (kd_quantity_observer_exists(&observer.motion, &at, error))
        return KD_EINVAL;
    m->curve = kd_critical_of(&observer);
    if (m->curve.status)
        return kd_error_field(error, "/observer_r", "there is no critical curve for this observer");
    struct kd_critical_measures s = kd_critical_measure(&m->curve);
    o->area = s.area;
    o->mean_radius = s.mean_radius;
    o->displacement = s.displacement;
    o->asymmetry = s.asymmetry;
    o->width = s.width;
    o->height = s.height;
    return KD_OK;
}

static enum kd_status evaluate(const double *in, double *out, void *memory, bool fresh, struct kd_error *error)
{
    const struct parameters *p = KD_QUANTITY_IN(in);
    struct outputs *o = KD_QUANTITY_OUT(out);
    struct memory *m = memory;
    if (fresh && make_curve(p, m, o, error))
        return KD_EINVAL;
    struct kd_critical_point c = kd_critical_at(&m->curve, p->angle_deg * (M_PI / 180));
    bool far = isinf(p->observer_r);
    o->alpha = c.alpha, o->beta = c.beta, o->rho = c.rho;
    o->right = far ? NAN : c.right, o->up = far ? NAN : c.up, o->inwards = far ? NAN : c.inwards;
    o->orbit_r = c.orbit.r;
    o->lyapunov = kd_shell_exponents(&c.orbit).gamma;
    return KD_OK;
}

KD_QUANTITY(shadow, "shadow",
            "the critical curve, which is the edge of the shadow, for any observer, with its size and shape",
            .memory_size = sizeof(struct memory), .along = 1, .point_us = 8, .fresh_us = 1000)
