/* The hole as a value. It is made once, and passed as a const pointer to every function that computes in the hole's
 * spacetime. The pointer need not outlive the call. Double precision, pure, any thread. Units G = c = M = 1. The domain
 * is |a| < 1; outside it, numbers that are undefined are NaN.
 *
 * The spin a is signed: a < 0 means that the orbit or disk, which always turns towards +phi, is retrograde to the hole.
 * The horizons are r± = 1 ± root with root = sqrt(1 - a^2 - q^2). */
#ifndef KD_PHYSICS_SPACETIME_HOLE_H
#define KD_PHYSICS_SPACETIME_HOLE_H

#include "base/error.h"
#include "physics/spacetime/parameters.h"

#include <math.h>
#include <stdbool.h>
#include <stddef.h>

struct kd_hole {
    double a;     /* spin */
    double q;     /* charge q, in units of M */
    double root;  /* half the distance between the horizons, accurate to an ulp or two, also as |a| -> 1 */
    double outer; /* r+, accurate to a few ulp up to |a| = 1 - 1e-15 */
    double inner; /* r- */
};

/* An uncharged hole. root is computed from (1 - a)(1 + a), because 1 - a*a loses all digits as |a| -> 1. inner is
 * computed from r+ r- = a^2, without cancellation at small a. */
static inline struct kd_hole kd_hole_of(double a)
{
    double root = sqrt((1 - a) * (1 + a)), outer = 1 + root;
    return (struct kd_hole) { a, 0, root, outer, a * a / outer };
}

/* A hole of charge q, with a^2 + q^2 < 1. The sum 1 - a^2 - q^2 takes the rounding errors of its terms into account
 * (Dekker 1971), so that root keeps its digits as a^2 + q^2 -> 1. If q^2 is 0 or underflows, the horizons equal those
 * of kd_hole_of bit by bit. */
struct kd_hole kd_hole_charged(double a, double q);

/* kd_hole_from: the hole with the given parameters. kd_hole_in: the hole with the parameters that any struct has as
 * members. kd_hole_told: the parameters of a hole. */
static inline struct kd_hole kd_hole_from(struct kd_hole_given given)
{
    return kd_hole_charged(given.spin, given.charge);
}
#define kd_hole_in(from) kd_hole_from(kd_hole_given(from))
static inline struct kd_hole_given kd_hole_told(const struct kd_hole *hole)
{
#define KD_TOLD_(x, name, member, ...) , .name = hole->member
    return (struct kd_hole_given) { .spin = hole->a KD_HOLE_MORE(KD_TOLD_, ) };
#undef KD_TOLD_
}

/* q^2, for functions that need only the charge. All effects of the charge depend on q^2. */
static inline double kd_hole_charge2(const struct kd_hole *hole) { return hole->q * hole->q; }

/* True if the charge has any effect, that is, if its square does not underflow. */
static inline bool kd_hole_is_charged(const struct kd_hole *hole) { return hole->q * hole->q > 0; }

/* True if the horizons are close to each other. Otherwise time and azimuth may be computed as a difference of two
 * integrals, each with a pole at one horizon, because the difference's error, 1e-16/(r+ - r-), is below 2e-15. */
static inline bool kd_hole_is_close(const struct kd_hole *hole) { return hole->root < 0.03; }

/* r - horizon, for one of the two horizons. If the horizons are close, the function uses r - 1, which is exact. */
static inline double kd_hole_past(const struct kd_hole *hole, double r, double horizon)
{
    if (!kd_hole_is_close(hole))
        return r - horizon;
    return r - 1 - (horizon > 1 ? hole->root : -hole->root);
}

/* True if the metric is Kerr's, that is, if no parameter besides the spin has any effect. */
static inline bool kd_hole_is_kerr(const struct kd_hole *hole) { return !kd_hole_is_charged(hole); }

/* False for a struct of zeros and for a hole outside the domain. */
static inline bool kd_hole_exists(const struct kd_hole *hole)
{
    return hole->a * hole->a + hole->q * hole->q <= 1 && hole->root > 0 && hole->outer > 1;
}

/* Returns KD_EINVAL at "/spin" or "/charge", with the allowed range, if the hole does not exist. */
enum kd_status kd_hole_check(const struct kd_hole *hole, struct kd_error *error);

/* The approximation that is reported for the hole's parameter with this index; NULL after the last one. */
struct kd_hole_sentence { const char *name, *text; };
const struct kd_hole_sentence *kd_hole_sentence(struct kd_hole_given given, size_t index);

/* The parameter that an error about a nearly extremal hole names: the larger of spin and charge. */
struct kd_hole_parameter {
    const char *name, *pointer;
    double value;
};
struct kd_hole_parameter kd_hole_largest(const struct kd_hole *hole);

/* A hole from its spin, for use as a function's argument: kd_kerr_isco(kd_hole(0.9)). It lives until the end of the
 * enclosing block. */
#define kd_hole(a) ((const struct kd_hole[]) { kd_hole_of(a) })

/* The hole in turned coordinates, in which motion towards +phi (sense 1) or towards -phi (sense -1) is motion towards
 * +phi. */
static inline struct kd_hole kd_hole_turned_of(const struct kd_hole *hole, double sense)
{
    struct kd_hole turned = *hole;
    turned.a = sense * hole->a;
    return turned;
}
#define kd_hole_turned(hole, sense) ((const struct kd_hole[]) { kd_hole_turned_of(hole, sense) })

/* Delta = r^2 - 2r + a^2 + q^2 as a product of its factors, which keeps the accuracy of r - r+ next to the horizon. */
static inline double kd_hole_delta(const struct kd_hole *hole, double r)
{
    return (r - hole->outer) * (r - hole->inner);
}

/* Delta at r = 1 + y, for places whose distance from r = 1 is known to more digits than r. */
static inline double kd_hole_delta_y(const struct kd_hole *hole, double y)
{
    return (y - hole->root) * (y + hole->root);
}

/* Delta at r = 0, which is the product of the horizons, a^2 + q^2. */
static inline double kd_hole_horizons(const struct kd_hole *hole) { return hole->a * hole->a + hole->q * hole->q; }

/* kd_hole_delta_sum: Delta - a^2 as a sum of its terms. kd_hole_delta_sum_w: Delta/r^2 as a sum of its terms. Schmidt's
 * conditions on bound orbits (orbit_shape.c) have determinants in which the terms of Delta cancel against each other.
 * Next to the separatrix at a = 1 - 1e-9 (p = 1.21, e = 0.1) these sums give E with an error of 1.6e-13; Delta as a
 * product would give 6.8e-12. */
static inline double kd_hole_delta_sum(const struct kd_hole *hole, double r) { return r * (r - 2) + hole->q * hole->q; }
static inline double kd_hole_delta_sum_w(const struct kd_hole *hole, double w)
{
    return 1 - 2 * w + kd_hole_horizons(hole) * w * w;
}

/* Delta/r^2 = 1 - 2w + (a^2 + q^2) w^2 at w = 1/r, as (1 - w)^2 - (root w)^2. Near the horizon of a hole that spins
 * fast, 1 - w is exact, and the two factors keep their accuracy where the horizons almost coincide. The result is as
 * accurate as w. */
#define KD_HOLE_DELTA_W(root, w) ((1 - (w) - (root) * (w)) * (1 - (w) + (root) * (w))) /* also for vectors */
static inline double kd_hole_delta_w(const struct kd_hole *hole, double w) { return KD_HOLE_DELTA_W(hole->root, w); }

/* kd_hole_mass: the mass term of the metric, 2r - q^2 (2r without charge). kd_hole_mass_w: this term divided by r, as a
 * function of w = 1/r. */
static inline double kd_hole_mass(const struct kd_hole *hole, double r) { return 2 * r - hole->q * hole->q; }
static inline double kd_hole_mass_w(const struct kd_hole *hole, double w) { return 2 - hole->q * hole->q * w; }

/* Coefficients c of the mass term: kd_hole_mass is c[0] r + c[1], and kd_hole_mass_w is c[0] + c[1] w. */
static inline void kd_hole_mass_line(const struct kd_hole *hole, double c[2]) { c[0] = 2, c[1] = -hole->q * hole->q; }

/* kd_hole_pull: the rate of decrease of the mass term, -(Sigma^2/2r) d/dr (mass/Sigma), at cos(theta) = u.
 * kd_hole_pull_w: this rate in the plane, where Sigma = r^2, divided by r: 1 - q^2/r. */
static inline double kd_hole_pull(const struct kd_hole *hole, double r, double u)
{
    return (r - hole->a * u) * (r + hole->a * u) / r - hole->q * hole->q;
}
static inline double kd_hole_pull_w(const struct kd_hole *hole, double w) { return 1 - hole->q * hole->q * w; }

/* A of kd_metric_at in the plane: r^2 (r^2 + a^2) + a^2 (2r - q^2), which does not contain Delta. */
static inline double kd_hole_area_in_plane(const struct kd_hole *hole, double r)
{
    const double a2 = hole->a * hole->a;
    return r * (r * (r * r + a2) + 2 * hole->a * hole->a) - a2 * (hole->q * hole->q);
}

/* D of the radial quartic R/r^4 = E^2 - mu^2 + ... - D w^4, for light and for matter. D = a^2 Q + q^2 K, with Carter's
 * constants Q and K = Q + (L - aE)^2 (Carter 1968, Phys. Rev. 174, 1559). */
static inline double kd_hole_quartic(const struct kd_hole *hole, double carter, double k)
{
    return hole->a * hole->a * carter + hole->q * hole->q * k;
}

/* The part of the coefficient of w^2 in w'^2 of a body of unit mass that does not depend on its motion. */
static inline double kd_hole_own_quadratic(const struct kd_hole *hole) { return -(hole->q * hole->q); }

/* Coefficients of w'^2 of a body of unit mass, as a polynomial in w = 1/r. bound: E^2 - 1. moving: a^2 (E^2 - 1) - L^2
 * - Q. */
static inline void kd_hole_radial(const struct kd_hole *hole, double bound, double moving, double carter, double k,
                                  double c[5])
{
    c[0] = bound, c[1] = 2, c[3] = 2 * k, c[4] = -kd_hole_quartic(hole, carter, k);
    c[2] = moving + kd_hole_own_quadratic(hole);
}

/* Numbers in the rates of phi and t per Mino time, for light and for matter:
 *   phi' = a (2E r - drag)/Delta + ...,   t' = E (r^2 + 2r + four) + (near r - nearer - 4 a^2 E)/Delta + ... */
struct kd_hole_rates { double drag, four, near, nearer; };
static inline struct kd_hole_rates kd_hole_rates_of(const struct kd_hole *hole, double energy, double momentum)
{
    const double q2 = hole->q * hole->q, al = hole->a * momentum, four = 4 - q2;
    return (struct kd_hole_rates) { al + q2 * energy, four, 8 * energy - 2 * al - 4 * q2 * energy,
                                    q2 * (four * energy - al) };
}

/* The metric in Boyer-Lindquist coordinates (Bardeen, Press & Teukolsky 1972, ApJ 178, 347, eqs 2.1 to 2.5; with
 * charge Misner, Thorne & Wheeler 1973, eq. 33.2): Sigma = r^2 + a^2 cos^2(theta), Delta, A = (r^2 + a^2)^2 - a^2
 * Delta sin^2(theta), the angular velocity of frame dragging -g_tphi/g_phiphi, and the square of the lapse,
 * Sigma Delta/A. */
struct kd_metric_scalars { double sigma, delta, area, omega, lapse2; };
struct kd_metric_scalars kd_metric_at(const struct kd_hole *hole, double r, double cos_theta);

#endif
