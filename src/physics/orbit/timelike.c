#include "physics/orbit/timelike.h"

#include "physics/math/angle.h"
#include "physics/math/polynomial.h"
#include "physics/spacetime/kerr.h"

#include <float.h>
#include <math.h>

/* relative range of w below which a motion counts as nearly circular. The ends of wider ranges are found as roots of W,
 * with an error of 1e-12 */
#define NEAR_CIRCLE 1e-3

const char *kd_orbit_fate_name(enum kd_orbit_fate fate)
{
    static const char *const names[] = { "bound", "plunge", "escape" };
    return names[fate];
}

double kd_orbit_radial(const struct kd_orbit *o, double w) { return kd_polynomial_at(o->w, 4, w); }

double kd_orbit_radial_slope(const struct kd_orbit *o, double w)
{
    return o->w[1] + w * (2 * o->w[2] + w * (3 * o->w[3] + w * 4 * o->w[4]));
}

double kd_orbit_radial_by_energy(const struct kd_orbit *o, double w)
{
    return 2 * o->energy * (1 + o->hole.a * o->hole.a * w * w) -
           2 * kd_hole_mass_w(&o->hole, w) * o->hole.a * (o->momentum - o->hole.a * o->energy) * w * w * w;
}

/* z is the root, in u^2, that the motion reaches. 1 - z follows from the product L^2 = (1 - z)(n - a^2 b) or from z n =
 * Q. Of both forms the one without subtraction is used. */
static void set_polar(struct kd_orbit *o)
{
    double flat = o->hole.a * o->hole.a * o->binding, l2 = o->momentum * o->momentum, sum = o->total + flat;
    double disc = sqrt(fmax((o->total - flat) * (o->total - flat) + 4 * flat * l2, 0));
    if (sum > 0 || flat >= 0) {
        o->n = 0.5 * (sum + disc);
        o->z = o->n > 0 ? o->carter / o->n : 0;
    } else {
        o->z = (disc - sum) / (-2 * flat);
        o->n = o->carter / o->z;
    }
    double less = l2 + flat - o->carter; /* n - Q = (less + disc)/2 */
    if (less >= 0 && o->n > 0)
        o->axis_gap = 0.5 * (less + disc) / o->n;
    else
        o->axis_gap = l2 > 0 ? l2 / (o->n - flat) : 0;
}

void kd_orbit_set_constants(struct kd_orbit *o)
{
    double a2 = o->hole.a * o->hole.a, rest = o->momentum - o->hole.a * o->energy;
    const struct kd_hole_rates rates = kd_hole_rates_of(&o->hole, o->energy, o->momentum);
    o->k = o->carter + rest * rest;
    o->total = o->momentum * o->momentum + o->carter;
    kd_hole_radial(&o->hole, -o->binding, -(a2 * o->binding + o->total), o->carter, o->k, o->w);
    o->drag = rates.drag, o->four = rates.four, o->near = rates.near, o->nearer = rates.nearer;
    set_polar(o);
}

/* Finds the range between roots of W that contains w, or the outermost range if w is NAN. */
static bool find_range(struct kd_orbit *o, double w)
{
    double roots[KD_POLYNOMIAL_DEGREE + 2], horizon = 1 / o->hole.outer;
    int n = kd_polynomial_roots(o->w, 4, 0, horizon, roots);
    double low = 0, high = horizon;
    for (int i = 0; i <= n; i++) {
        double next = i < n ? roots[i] : horizon;
        /* true at a double root, which is a circular orbit or the limit of a whirl */
        bool touches = i < n && i > 0 && next == low;
        double middle = 0.5 * (low + next);
        bool allowed = touches || kd_orbit_radial(o, middle) > 0;
        bool here = isnan(w) || (w >= low * (1 - 1e-14) && w <= next * (1 + 1e-14));
        if (allowed && here) {
            high = next;
            o->w_low = low, o->w_high = high;
            /* true if the lower end is above 0: w = 0 is infinity, which is a root for E = 1, but not a turning point
             * */
            o->turns_out = low > 0;
            o->turns_in = i < n;
            o->circular = touches;
            return true;
        }
        low = next;
    }
    return false;
}

static void set_fate(struct kd_orbit *o)
{
    if (o->circular) { /* a circular orbit is unstable if W has a minimum there */
        double w = o->w_low, bend = o->w[2] + w * (3 * o->w[3] + w * 6 * o->w[4]);
        double size = fabs(o->w[2]) + w * (3 * fabs(o->w[3]) + w * 6 * fabs(o->w[4]));
        /* the tolerance is needed because, at a triple root, `bend` vanishes within rounding */
        o->fate = bend > 1e-7 * size ? KD_ORBIT_PLUNGE : KD_ORBIT_BOUND;
        return;
    }
    o->fate = !o->turns_in ? KD_ORBIT_PLUNGE : o->turns_out ? KD_ORBIT_BOUND : KD_ORBIT_ESCAPE;
}

/* True if E(r^2 + a^2) - aL > 0, that is, if the particle moves towards the future. */
static bool to_the_future(const struct kd_orbit *o)
{
    double w = o->turns_out ? o->w_low : 0.5 * (o->w_low + o->w_high);
    return o->energy * (1 + o->hole.a * o->hole.a * w * w) - o->hole.a * o->momentum * w * w > 0;
}

enum kd_status kd_orbit_from_constants(const struct kd_hole *hole, double energy, double momentum, double carter,
                                       double r, struct kd_orbit *o, struct kd_error *error)
{
    enum kd_status status = kd_hole_check(hole, error);
    if (status)
        return status;
    if (!(carter >= 0))
        return kd_error_field(error, "/carter",
                              "carter is %.16g; it must be at least 0; a motion with Q < 0, which never crosses the "
                              "equator, must be given by position and velocity",
                              carter);
    if (!isnan(r) && !(r > hole->outer))
        return kd_error_field(error, "/r", "r is %.16g; it must be above the horizon at %.9g", r, hole->outer);
    *o = (struct kd_orbit) {
        .hole = *hole, .energy = energy, .binding = (1 - energy) * (1 + energy), .momentum = momentum, .carter = carter
    };
    kd_orbit_set_constants(o);
    if (!find_range(o, 1 / r) && !isnan(r))
        return kd_error_field(error, "/r", "r is %.16g, which no particle with these constants reaches", r);
    if (!(o->w_high > 0) || !to_the_future(o))
        return kd_error_field(
            error, "/energy",
            "energy is %.16g; it must be different, because no particle outside the horizon has these constants",
            energy);
    set_fate(o);
    return KD_OK;
}

void kd_orbit_factor(const struct kd_orbit *o, double g[3])
{
    double sum = o->w_low + o->w_high, product = o->w_low * o->w_high;
    g[2] = -o->w[4];
    g[1] = sum * g[2] - o->w[3];
    g[0] = o->binding / product;
}

struct kd_orbit_state kd_orbit_start(const struct kd_orbit *o, double r, bool outward)
{
    struct kd_orbit_state s = { .u = 0, .u_rate = sqrt(o->carter) };
    if (isnan(r))
        s.w = o->circular || o->turns_in ? o->w_high : o->w_low;
    else
        s.w = fmin(fmax(1 / r, o->w_low), o->w_high);
    /* W vanishes at a turning point, so close to a turning point its rounded value has no meaning. */
    if (o->turns_out && s.w <= o->w_low * (1 + 1e-14))
        s.w = o->w_low;
    else if (o->turns_in && s.w >= o->w_high * (1 - 1e-14))
        s.w = o->w_high;
    else
        s.w_rate = copysign(sqrt(fmax(kd_orbit_radial(o, s.w), 0)), outward ? -1 : 1);
    /* a body on an unstable circle starts inside the circle, by one ulp of w */
    if (o->circular && o->fate == KD_ORBIT_PLUNGE) {
        double g[3];
        kd_orbit_factor(o, g);
        s.w = nextafter(o->w_high, 1);
        s.w_rate = (s.w - o->w_high) * sqrt(fmax(-g[0] - s.w * (g[1] + s.w * g[2]), 0));
    }
    return s;
}

double kd_orbit_whirl(const struct kd_orbit *o, const struct kd_orbit_state *s, double *r)
{
    /* Places of the extrema of W. For large w, W either falls or is a rising cubic. Therefore W has at most one
     * minimum. */
    double slope[4] = { o->w[1], 2 * o->w[2], 3 * o->w[3], 4 * o->w[4] }, turns[KD_POLYNOMIAL_DEGREE + 2];
    int n = kd_polynomial_roots(slope, 3, 0, 1 / o->hole.outer, turns);
    for (int i = 0; i < n && !o->circular; i++) {
        double w = turns[i], w3 = w * w * w, rest = fabs(o->momentum) + fabs(o->hole.a * o->energy);
        bool ahead = s->w <= w ? s->w_rate > 0 || o->turns_out : s->w_rate < 0 || o->turns_in;
        if (!ahead || o->w[2] + w * (3 * o->w[3] + w * 6 * o->w[4]) <= 0)
            continue;
        double size = fabs(o->w[0]) + 2 * w + fabs(o->w[2]) * w * w + 2 * w3 * (fabs(o->carter) + rest * rest) +
                      fabs(o->w[4]) * w3 * w;
        if (r)
            *r = 1 / w;
        return size / fabs(kd_orbit_radial(o, w));
    }
    return 0;
}

static enum kd_status check_state(const struct kd_hole *hole, double r, double theta_deg, enum kd_observer frame,
                                  const double v[3], struct kd_error *error)
{
    const struct kd_vantage at = { *hole, r, kd_cos_deg(theta_deg), kd_sin_deg(theta_deg) };
    const struct kd_observer_row *row = &kd_observers[frame];
    char others[KD_OBSERVER_TEXT];
    enum kd_status status = kd_hole_check(hole, error);
    double speed = hypot(hypot(v[0], v[1]), v[2]);
    if (status)
        return status;
    if (!(r > hole->outer) || !isfinite(r))
        return kd_error_field(error, "/position/r", "r is %.16g; it must be above the horizon at %.9g", r, hole->outer);
    if (!(theta_deg >= 0 && theta_deg <= 180))
        return kd_error_field(error, "/position/theta_deg", "theta_deg is %.16g; it must be 0 to 180", theta_deg);
    if (!kd_observer_exists(frame, &at))
        return kd_error_field(error, "/velocity/frame",
                              "%s at r = %.16g, inside %s, which ends at %.9g here; frame must be %s", row->why, r,
                              row->edge, row->outside(hole, at.u), kd_observer_others(&at, others));
    if (!(speed < 1))
        return kd_error_field(error, "/velocity", "the speed is %.16g c; it must be below 1", speed);
    return KD_OK;
}

/* Turning points of a motion near a stable circle. There the roots of W nearly merge and are lost in the rounding of W,
 * and W at the start may be rounded below zero. Instead, W at the start is set to w_rate^2, and W is written as a
 * polynomial in the distance d from the start, which keeps its digits. */
static bool find_range_of_circle(struct kd_orbit *o, const struct kd_orbit_state *start)
{
    const double w = start->w, cubic = o->w[3] + 4 * w * o->w[4];
    const double c[5] = { start->w_rate * start->w_rate, kd_orbit_radial_slope(o, w),
                          o->w[2] + w * (3 * o->w[3] + w * 6 * o->w[4]), cubic, o->w[4] };
    const double middle = -c[1] / (2 * c[2]), reach = sqrt(middle * middle - c[0] / c[2]);
    if (!(c[2] < 0) || !(reach < NEAR_CIRCLE * w) || !(fabs(cubic) * reach < -0.1 * c[2]))
        return false;
    double ends[2] = { middle - reach, middle + reach };
    for (int i = 0; i < 2; i++)
        for (int k = 0; k < 4 && reach > 0; k++) {
            const double d = ends[i];
            ends[i] -= kd_polynomial_at(c, 4, d) / (c[1] + d * (2 * c[2] + d * (3 * c[3] + d * 4 * c[4])));
        }
    o->w_low = w + fmin(ends[0], 0);
    o->w_high = w + fmax(ends[1], 0);
    o->turns_out = o->turns_in = true;
    o->circular = o->w_low == o->w_high;
    return true;
}

/* Finds the range of motion for a start that is, within rounding, at a turning point or slightly beyond it. The error
 * of W there is `unknown`, 64 roundings of its largest terms. The range is therefore where W exceeds `unknown`. If W
 * does not exceed `unknown` before the next extremum of W, the orbit is a circle: both ends of the range coincide. */
static bool find_range_at_turn(struct kd_orbit *o, const struct kd_orbit_state *start)
{
    const double w = start->w, slope = kd_orbit_radial_slope(o, w),
                 bend = o->w[2] + w * (3 * o->w[3] + w * 6 * o->w[4]);
    const double size =
        fabs(o->w[0]) + w * (fabs(o->w[1]) + w * (fabs(o->w[2]) + w * (fabs(o->w[3]) + w * fabs(o->w[4]))));
    const double unknown = 64 * DBL_EPSILON * size;
    if (fabs(kd_orbit_radial(o, w)) > unknown || start->w_rate * start->w_rate > unknown)
        return false;
    if (slope * slope < 16 * unknown * fabs(bend)) {
        o->w_low = o->w_high = w;
        o->turns_out = o->turns_in = o->circular = true;
        return true;
    }
    if (!find_range(o, w + 4 * unknown / slope))
        return false;
    o->w_low = fmin(o->w_low, w);
    o->w_high = fmax(o->w_high, w);
    return true;
}

enum kd_status kd_orbit_from_state(const struct kd_hole *hole, double r, double theta_deg, enum kd_observer frame,
                                   const double v[3], struct kd_orbit *o, struct kd_orbit_state *start,
                                   struct kd_error *error)
{
    const double a = hole->a;
    enum kd_status status = check_state(hole, r, theta_deg, frame, v, error);
    if (status)
        return status;
    const struct kd_vantage at = { *hole, r, kd_cos_deg(theta_deg), kd_sin_deg(theta_deg) };
    const struct kd_observer_motion motion = kd_observer_motion_of(frame);
    const struct kd_tetrad tetrad = kd_observer_tetrad(&motion, &at);
    double gamma = 1 / sqrt(1 - (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]));
    const struct kd_covector p =
        kd_tetrad_covector(&tetrad, (double[]) { gamma, gamma * v[0], gamma * v[1], gamma * v[2] });
    *o = (struct kd_orbit) { .hole = *hole, .energy = p.energy, .binding = (1 - p.energy) * (1 + p.energy) };
    o->momentum = p.momentum * at.s;
    o->carter = p.polar * p.polar + at.u * at.u * (a * a * o->binding + p.momentum * p.momentum);
    kd_orbit_set_constants(o);
    *start = (struct kd_orbit_state) {
        .w = 1 / r,
        .w_rate = -p.radial / (r * r),
        .u = at.u,
        .u_rate = -p.polar * at.s,
    };
    if (!find_range_of_circle(o, start) && !find_range(o, start->w) && !find_range_at_turn(o, start))
        return kd_error_field(error, "/position/r", "double precision cannot follow the motion from r = %.16g", r);
    if (start->w_rate == 0) { /* the start is exactly at the nearer turning point */
        bool outer = fabs(o->w_low - start->w) < fabs(o->w_high - start->w);
        *(outer ? &o->w_low : &o->w_high) = start->w;
        if (o->circular)
            o->w_low = o->w_high = start->w;
    }
    set_fate(o);
    if (o->fate == KD_ORBIT_PLUNGE && !o->turns_out && start->w_rate < 0)
        o->fate = KD_ORBIT_ESCAPE;
    return KD_OK;
}
