#include "physics/spacetime/observer.h"

#include "physics/math/polynomial.h"
#include "physics/math/root.h"
#include "physics/spacetime/kerr.h"

#include <math.h>
#include <stdio.h>

static double delta_of(const struct kd_vantage *at) { return kd_hole_delta(&at->hole, at->r); }

/* Sigma, Delta and B of the metric, where g_phiphi = B sin^2(theta)/Sigma. */
struct shape { double sigma, delta, big; };

static struct shape shape_of(const struct kd_vantage *at)
{
    double a = at->hole.a, r = at->r, w2 = r * r + a * a, delta = delta_of(at);
    return (struct shape) { r * r + a * a * at->u * at->u, delta, w2 * w2 - a * a * delta * at->s * at->s };
}

/* Frame of an observer of zero angular momentum (Bardeen, Press & Teukolsky 1972, ApJ 178, 347, section III). */
static struct kd_tetrad frame_zamo(const struct kd_observer_motion *motion, const struct kd_vantage *at)
{
    (void)motion;
    const struct shape k = shape_of(at);
    double root = sqrt(k.big / k.sigma);
    return (struct kd_tetrad) {
        .at = *at,
        .t = { .energy = sqrt(k.sigma * k.delta / k.big) },
        .r = { .radial = sqrt(k.sigma) * sqrt(k.delta) },
        .theta = { .polar = sqrt(k.sigma) },
        .phi = { .energy = kd_kerr_dragging(&at->hole, at->r, at->u) * root * at->s, .momentum = root },
    };
}

/* Frame of a static observer. The velocity is along the Killing vector d_t, and e_phi lies in the plane of d_t and
 * d_phi. Both follow from g_tt and g_tphi. */
static struct kd_tetrad frame_static(const struct kd_observer_motion *motion, const struct kd_vantage *at)
{
    (void)motion;
    double a = at->hole.a, r = at->r, u = at->u, s = at->s;
    double sigma = r * r + a * a * u * u, delta = delta_of(at);
    double mass = kd_hole_mass(&at->hole, r), lapse = sqrt((sigma - mass) / sigma); /* sqrt(-g_tt) */
    return (struct kd_tetrad) {
        .at = *at,
        .t = { .energy = lapse, .momentum = -mass * a * s / (sigma * lapse) },
        .r = { .radial = sqrt(sigma) * sqrt(delta) },
        .theta = { .polar = sqrt(sigma) },
        .phi = { .momentum = sqrt(delta) / lapse },
    };
}

/* Angular velocity of an orbit at constant radius, at its highest latitude, for the sense +1 or -1. The condition is
 * r'' = 0 where r' = theta' = 0, that is
 *   d_r g_tt + 2 Omega d_r g_tphi + Omega^2 d_r g_phiphi = 0,   which is   Omega sin = +-G/(1 +- a sin G),   G^2 =
 *     (r^2 - q^2 r - a^2 cos^2)/(r Sigma^2).
 * In Mino time r'' depends on r alone, so that r is constant. In the equatorial plane Omega = +-1/(r^2/s +- a), s^2 = r
 * - q^2; elsewhere the orbit is spherical (Wilkins 1972, Phys. Rev. D 5, 814). Returns sin * (Omega - omega), which is
 * regular on the axis. */
static double circling(const struct kd_hole *hole, double r, double u, double s, int sense)
{
    double a = hole->a;
    double g = sqrt(kd_hole_pull(hole, r, u)) / (r * r + a * a * u * u);
    return sense * g / (1 + sense * a * s * g) - s * kd_kerr_dragging(hole, r, u);
}

/* Frame that moves along e_phi relative to the observer of zero angular momentum, at the speed sqrt(g_phiphi) (Omega -
 * omega)/lapse. */
static struct kd_tetrad circular(const struct kd_vantage *at, int sense)
{
    const struct shape k = shape_of(at);
    double v = k.big / k.sigma * circling(&at->hole, at->r, at->u, at->s, sense) / sqrt(k.delta),
           gamma = 1 / sqrt((1 - v) * (1 + v));
    const struct kd_tetrad zamo = frame_zamo(NULL, at);
    return kd_tetrad_boosted(&zamo, (double[]) { gamma, 0, 0, gamma * v });
}

static struct kd_tetrad frame_keplerian(const struct kd_observer_motion *motion, const struct kd_vantage *at)
{
    (void)motion;
    return circular(at, 1);
}

static struct kd_tetrad frame_retrograde(const struct kd_observer_motion *motion, const struct kd_vantage *at)
{
    (void)motion;
    return circular(at, -1);
}

/* Frame of rain, which falls from rest at infinity without angular momentum. It has E = 1, L = 0, constant theta, and
 * Sigma r' = -sqrt((2r - q^2) (r^2 + a^2)) (Doran 2000, Phys. Rev. D 61, 067503; Natario 2009, Gen. Rel. Grav. 41,
 * 2579). e_phi is that of the frame of zero angular momentum, and e_r completes the frame. The frame is regular at the
 * horizon, because (2r - q^2) (r^2 + a^2) = B - Sigma Delta, and 2r > q^2 down to the inner horizon. */
static struct kd_tetrad rain(const struct kd_vantage *at)
{
    const struct shape k = shape_of(at);
    double root = sqrt(k.big / k.sigma), mass = kd_hole_mass(&at->hole, at->r),
           fall = sqrt(mass * (at->r * at->r + at->hole.a * at->hole.a));
    return (struct kd_tetrad) {
        .at = *at,
        .t = { .energy = 1, .radial = -fall },
        .r = { .energy = -fall / sqrt(k.big), .radial = sqrt(k.big) },
        .theta = { .polar = sqrt(k.sigma) },
        .phi = { .energy = kd_kerr_dragging(&at->hole, at->r, at->u) * root * at->s, .momentum = root },
    };
}

/* L divided by the radius of the circle's circumference, which is the momentum per mass along e_phi; 0 on the axis. */
static double swing(double momentum, const struct kd_vantage *at)
{
    const struct shape k = shape_of(at);
    return momentum == 0 ? 0 : momentum / (sqrt(k.big / k.sigma) * at->s);
}

/* E of a body that has this angular momentum and no other motion at this place. */
static double rest_energy(double momentum, const struct kd_vantage *at)
{
    const struct shape k = shape_of(at);
    return kd_kerr_dragging(&at->hole, at->r, at->u) * momentum +
           sqrt(k.sigma * k.delta / k.big) * hypot(1, swing(momentum, at));
}

double kd_observer_energy(const struct kd_observer_motion *m, const struct kd_vantage *at)
{
    struct kd_vantage from = *at;
    from.r = m->fall_from;
    return isfinite(m->fall_energy) ? m->fall_energy : isfinite(from.r) ? rest_energy(m->fall_momentum, &from) : 1;
}

/* With E' = E - omega L and constant latitude, (Sigma r')^2 = B E'^2 - Sigma Delta (1 + x_phi^2). Frame of infall. The
 * components x in the rain frame follow from
 *   x_t - x_r = (sqrt(B) E' - Sigma r')/(sqrt(B) + sqrt((2r - q^2) (r^2 + a^2))),   (x_t - x_r)(x_t + x_r) = 1 +
 * x_phi^2, none of which vanishes at the horizon. */
static struct kd_tetrad frame_infall(const struct kd_observer_motion *m, const struct kd_vantage *at)
{
    const struct kd_tetrad base = rain(at);
    const struct shape k = shape_of(at);
    double x = swing(m->fall_momentum, at), one = 1 + x * x, root = sqrt(k.big);
    double energy = kd_observer_energy(m, at) - kd_kerr_dragging(&at->hole, at->r, at->u) * m->fall_momentum;
    double speed = sqrt(fmax(0, k.big * energy * energy - k.sigma * k.delta * one));
    double less = (root * energy + speed) / (root - base.t.radial), more = one / less;
    const double velocity[4] = { 0.5 * (more + less), 0.5 * (more - less), 0, x };
    struct kd_tetrad frame = less == 1 && x == 0 ? base : kd_tetrad_boosted(&base, velocity);
    frame.falls = true;
    for (int i = 0; i < 4; i++)
        frame.past_rain[i] = velocity[i];
    return frame;
}

static struct kd_tetrad frame_velocity(const struct kd_observer_motion *m, const struct kd_vantage *at)
{
    const double *v = m->velocity, gamma = 1 / sqrt(1 - (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]));
    const struct kd_tetrad zamo = frame_zamo(NULL, at);
    return kd_tetrad_boosted(&zamo, (double[]) { gamma, gamma * v[0], gamma * v[1], gamma * v[2] });
}

struct round {
    const struct kd_hole *hole;
    double u, s;
    int sense;
};

/* Lapse minus the coordinate speed of a circular orbit, which is negative where the orbit would be faster than light.
 */
static double slower_than_light(const void *user, double r)
{
    const struct round *o = user;
    const struct kd_vantage at = { *o->hole, r, o->u, o->s };
    const struct shape k = shape_of(&at);
    return sqrt(fmax(0, k.delta)) * k.sigma / k.big - fabs(circling(o->hole, r, o->u, o->s, o->sense));
}

double kd_observer_light_orbit(const struct kd_hole *hole, double u, int sense)
{
    const struct round o = { hole, u, sqrt((1 - u) * (1 + u)), sense };
    return u == 0 ? kd_kerr_photon_orbit(kd_hole_turned(hole, sense))
                  : kd_root(slower_than_light, &o, hole->outer, 4.01);
}

#define OUTSIDE(NAME, word, what, where, outside, ...) \
    static double outside_of_##word(const struct kd_hole *hole, double u) \
    { \
        (void)u; \
        return outside; \
    }
KD_OBSERVERS(OUTSIDE)

#define ROW(NAME, name, what, where, edge_r, edge_name, not_inside) \
    [KD_OBSERVER_##NAME] = { #name, edge_name, not_inside, outside_of_##name, frame_##name },
const struct kd_observer_row kd_observers[] = { KD_OBSERVERS(ROW) };

#define FITS(NAME, word, ...) \
    _Static_assert(sizeof #word <= 11, "room in KD_OBSERVER_TEXT for \"" #word "\", quoted, and \" or \"");
KD_OBSERVERS(FITS)

bool kd_observer_exists(enum kd_observer observer, const struct kd_vantage *at)
{
    return at->r > kd_observers[observer].outside(&at->hole, at->u);
}

struct kd_observer_motion kd_observer_motion_of(enum kd_observer observer)
{
    return (struct kd_observer_motion) { .observer = observer, .fall_from = INFINITY, .fall_energy = INFINITY };
}

/* True if r' vanishes between this place and the radius of release. It uses w'^2 of a body, in w = 1/r
 * (docs/physics/geodesics.md with mu = 1). */
static bool turns_on_its_way(const struct kd_observer_motion *m, const struct kd_vantage *at)
{
    double a = at->hole.a, e = kd_observer_energy(m, at), l = m->fall_momentum, bound = (e - 1) * (e + 1);
    double ls = l == 0 ? 0 : l / at->s, q = at->u * at->u * (ls * ls - a * a * bound), rest = l - a * e, roots[4];
    double c[5];
    kd_hole_radial(&at->hole, bound, a * a * bound - l * l - q, q, q + rest * rest, c);
    double last = fmin(1 / at->r, 1 / at->hole.outer);
    return last > 1 / m->fall_from * (1 + 1e-9) &&
           kd_polynomial_roots(c, 4, 1 / m->fall_from * (1 + 1e-9) + 1e-12, last, roots) > 0;
}

static enum kd_observer_fault check_fall(const struct kd_observer_motion *m, const struct kd_vantage *at, double *bound)
{
    if (isfinite(m->fall_energy) && isfinite(m->fall_from))
        return KD_OBSERVER_TWO_ENERGIES;
    *bound = at->r;
    if (m->fall_from < at->r)
        return KD_OBSERVER_FROM_INSIDE;
    struct kd_vantage here = *at; /* within the horizon, every body that came through the horizon falls */
    here.r = fmax(at->r, at->hole.outer);
    *bound = rest_energy(m->fall_momentum, &here);
    if (!(kd_observer_energy(m, at) >= *bound) || (!isfinite(m->fall_energy) && turns_on_its_way(m, at)))
        return KD_OBSERVER_TURNS;
    return KD_OBSERVER_SOUND;
}

enum kd_observer_fault kd_observer_check(const struct kd_observer_motion *m, const struct kd_vantage *at, double *bound)
{
    const double *v = m->velocity;
    *bound = 1;
    if (m->observer == KD_OBSERVER_VELOCITY)
        return v[0] * v[0] + v[1] * v[1] + v[2] * v[2] < 1 ? KD_OBSERVER_SOUND : KD_OBSERVER_TOO_FAST;
    return m->observer == KD_OBSERVER_INFALL ? check_fall(m, at, bound) : KD_OBSERVER_SOUND;
}

const char *kd_observer_fastest(const double v[3], double *component)
{
    static const char *const names[] = { "velocity_r", "velocity_theta", "velocity_phi" };
    int most = 0;
    for (int i = 1; i < 3; i++)
        most = fabs(v[i]) > fabs(v[most]) ? i : most;
    *component = v[most];
    return names[most];
}

struct kd_tetrad kd_observer_tetrad(const struct kd_observer_motion *motion, const struct kd_vantage *at)
{
    return kd_observers[motion->observer].tetrad(motion, at);
}

const char *kd_observer_others(const struct kd_vantage *at, char out[KD_OBSERVER_TEXT])
{
    int used = 0;
    snprintf(out, KD_OBSERVER_TEXT, "none");
    for (int i = 0; i < KD_OBSERVER_COUNT; i++)
        if (kd_observer_exists((enum kd_observer)i, at))
            used += snprintf(out + used, (size_t)(KD_OBSERVER_TEXT - used), "%s\"%s\"", used ? " or " : "",
                             kd_observers[i].word);
    return out;
}
