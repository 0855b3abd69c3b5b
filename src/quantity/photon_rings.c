#include "quantity/define.h"

#include "physics/math/angle.h"
#include "physics/null/critical.h"
#include "physics/null/lensing.h"
#include "physics/spacetime/kerr.h"

#define PARAMETERS(P) \
    KD_PARAMETER_SPIN(P) \
    KD_PARAMETER_HOLE_MORE(P) \
    P(inclination_deg, .unit = "degrees", .typed = "60", .least = 0, .most = 180, \
      .help = "polar angle of the observer, who is at infinity; at 90 the equatorial plane is seen edge-on") \
    P(angle_deg, .unit = "degrees", .typed = "0", .least = -360, .most = 720, \
      .help = "position on the critical curve: angle about its centre, from the right over the top") \
    P(inner, .unit = "M", .typed = "horizon", .least = 1, .most = 1e9, .words = "horizon", .stands = INFINITY, \
      .help = "inner radius of the light's source in the equatorial plane") \
    P(outer, .unit = "M", .typed = "infinity", .least = 1, .most = 1e9, .words = "infinity", .stands = INFINITY, \
      .help = "outer radius of the light's source") \
    P(order, .unit = "1", .typed = "1:6:6", .least = 1, .most = 12, .kind = KD_KIND_INT, \
      .help = "order of the ring: number of half turns of its light round the hole")
#define OUTPUTS(O) \
    O(inner_edge, .unit = "1", \
      .help = "distance of the image of inner from the critical curve, along the curve's radius and in units of it; " \
              "below 0 inside the curve; null if there is no image") \
    O(outer_edge, .unit = "1", \
      .help = "distance of the image of outer from the critical curve, in the same units; null if there is no image") \
    O(width, .unit = "M", .help = "width of the ring at this angle, from edge to edge") \
    O(ladder, .unit = "M", .help = "width by the limit of high orders: that of order 1 times e^(-gamma (order - 1))") \
    O(gamma, .unit = "1", .fixed = true, \
      .help = "Lyapunov exponent, for each half turn, of the photon orbit seen at this angle; pi for a = 0") \
    O(orbit_r, .unit = "M", .fixed = true, .help = "radius of the photon orbit seen at this angle") \
    O(rho, .unit = "M", .fixed = true, .help = "distance of the critical curve from its centre at this angle")
KD_QUANTITY_TABLES(PARAMETERS, OUTPUTS)

static const char *const sources[] = {
    "S. E. Gralla, D. E. Holz & R. M. Wald 2019, Phys. Rev. D 100, 024018; S. E. Gralla & A. Lupsasca 2020, Phys. Rev. "
    "D 101, 044031 (edges)",
    "M. D. Johnson et al. 2020, Sci. Adv. 6, eaaz1310 (gamma)",
    NULL,
};
static const char *const approximations[] = {
    "ladder is the limit of high orders, extended from order 1 for comparison", NULL
};

struct memory {
    struct kd_critical curve;
    struct kd_critical_point point;
    double inner, first, gamma;
};

static double width_of(const struct memory *m, const struct parameters *p, int order)
{
    return m->point.rho * (kd_lensing_edge(&m->curve, &m->point, order, p->outer) -
                           kd_lensing_edge(&m->curve, &m->point, order, m->inner));
}

/* For an observer below the plane the picture is mirrored vertically, so the observer is reflected to above the plane.
 */
static enum kd_status begin(const struct parameters *p, struct memory *m, struct outputs *o, struct kd_error *error)
{
    const double horizon = KD_QUANTITY_HOLE(p)->outer;
    const bool below = p->inclination_deg > 90;
    m->inner = isinf(p->inner) ? horizon : p->inner;
    if (m->inner < horizon)
        return kd_quantity_outside(error, "inner", m->inner, "; it must be at least %.9g M, the horizon", horizon);
    if (!(p->outer > m->inner))
        return kd_quantity_outside(error, "outer", p->outer, "; it must be more than %.9g M, the value of inner",
                                   m->inner);
    m->curve = kd_critical_of(&(struct kd_critical_observer) { .hole = kd_hole_in(p),
                                                               .radius = INFINITY,
                                                               .cos_theta = fabs(kd_cos_deg(p->inclination_deg)),
                                                               .sin_theta = kd_sin_deg(p->inclination_deg) });
    m->point = kd_critical_at(&m->curve, (below ? -p->angle_deg : p->angle_deg) * (M_PI / 180));
    m->gamma = kd_shell_exponents(&m->point.orbit).gamma;
    m->first = width_of(m, p, 1);
    o->gamma = m->gamma, o->orbit_r = m->point.orbit.r, o->rho = m->point.rho;
    return KD_OK;
}

static enum kd_status evaluate(const double *in, double *out, void *memory, bool fresh, struct kd_error *error)
{
    const struct parameters *p = KD_QUANTITY_IN(in);
    struct outputs *o = KD_QUANTITY_OUT(out);
    struct memory *m = memory;
    const int order = (int)p->order;
    if (fresh && (kd_hole_check(KD_QUANTITY_HOLE(p), error) || begin(p, m, o, error)))
        return KD_EINVAL;
    o->inner_edge = kd_lensing_edge(&m->curve, &m->point, order, m->inner);
    o->outer_edge = kd_lensing_edge(&m->curve, &m->point, order, p->outer);
    o->width = width_of(m, p, order);
    o->ladder = m->first * exp(-m->gamma * (order - 1));
    return KD_OK;
}

KD_QUANTITY(photon_rings, "photon-rings", "photon rings: their edges relative to the critical curve, and their widths",
            .memory_size = sizeof(struct memory), .along = 1, .point_us = 60, .fresh_us = 60)
