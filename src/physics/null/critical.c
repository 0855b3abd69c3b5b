#include "physics/null/critical.h"

#include "physics/math/root.h"
#include "physics/spacetime/kerr.h"

#include <math.h>

enum { POINTS_MIN = 32, POINTS_MAX = 8192 };

/* A point of the upper half of the critical curve. x is measured to the right of the curve's centre. */
struct place {
    struct kd_shell_orbit orbit;
    double alpha, beta2;
    /* right, inwards: components of the direction. up2: square of its component `up`. energy: ratio of the energy at
     * infinity to the measured energy */
    double right, up2, inwards, energy;
    /* place relative to the centre, with the square of y; at a finite radius, components of the direction */
    double x, y2;
};

/* The point of the critical curve that belongs to the orbit at the place `at` * sin i. Places are divided by sin i
 * because at a small inclination only orbits near the polar one are visible. */
static struct place label(const struct kd_critical *c, double at)
{
    const struct kd_shell *s = &c->shell;
    double u = c->observer.cos_theta, a = s->spin;
    struct place p = { .orbit = kd_shell_orbit_at(s, at * c->sine) };
    const struct kd_shell_orbit *o = &p.orbit;
    bool linear = o->y >= 0.5 * s->y_polar;
    double alpha = (linear ? at : o->w / c->sine) * (o->y + s->y_polar + 2 * s->n / (o->y * s->y_polar));
    p.beta2 = o->eta + (a - alpha) * (a + alpha) * u * u;
    p.alpha = copysign(1, s->a) * alpha;
    return p;
}

/* Computes the direction from which the photon arrives. R(r_o) is that of a double root (kd_shell_inside). p_theta may
 * be the root of a negative number here, and is left out: in a frame without motion along theta it affects only `up`.
 */
static void look(const struct kd_critical *c, struct place *p)
{
    const struct kd_shell_orbit *o = &p->orbit;
    double r = c->observer.radius, less = kd_shell_inside(&c->observer.hole, o),
           root = sqrt(fmax(r * r + 2 * o->r * r - less, 0));
    const struct kd_covector photon = { .energy = 1, .momentum = -p->alpha, .radial = (r - o->r) * root };
    const struct kd_look seen = c->tetrad.falls && photon.radial <= 0
                                    ? kd_tetrad_look_inwards(&c->tetrad, &photon, p->beta2)
                                    : kd_tetrad_look(&c->tetrad, &photon);
    double up = seen.energy / c->tetrad.theta.polar; /* `up` divided by beta */
    p->right = seen.right;
    p->inwards = seen.inwards;
    p->energy = seen.energy;
    p->up2 = p->beta2 * up * up;
}

static struct place see(const struct kd_critical *c, double at)
{
    struct place p = label(c, at);
    if (isinf(c->observer.radius)) {
        p.inwards = 1;
        p.x = p.alpha - c->centre;
        p.y2 = p.beta2;
        return p;
    }
    look(c, &p);
    p.x = p.right * cos(c->centre) - p.inwards * sin(c->centre);
    p.y2 = p.up2;
    return p;
}

static double beta2_at(const void *curve, double at) { return label(curve, at).beta2; }

/* The place of an end of the curve. An observer in the equatorial plane sees the equatorial orbit itself there. Other
 * observers see the orbit whose turning point is at their latitude. Near the axis its place is far from that of the
 * equatorial orbit, in units of sin i. */
static double end(const struct kd_critical *c, double equatorial)
{
    double limit = copysign(1, equatorial);
    while (fabs(limit * c->sine) < fabs(equatorial) && beta2_at(c, limit) >= 0)
        limit *= 2;
    if (fabs(limit * c->sine) >= fabs(equatorial))
        limit = equatorial / c->sine;
    return beta2_at(c, limit) >= 0 ? limit : kd_root(beta2_at, c, 0, limit);
}

static double along(const struct kd_critical *c, double at)
{
    struct place p = see(c, at);
    return isinf(c->observer.radius) ? p.alpha : atan2(p.right, p.inwards);
}

static bool valid(const struct kd_critical_observer *o)
{
    return kd_hole_exists(&o->hole) && fabs(o->cos_theta) <= 1 && o->sin_theta >= 0 && o->sin_theta <= 1 &&
           o->radius > (o->motion.observer == KD_OBSERVER_INFALL ? o->hole.inner : o->hole.outer) &&
           (unsigned)o->motion.observer < KD_OBSERVER_COUNT;
}

struct kd_critical kd_critical_of(const struct kd_critical_observer *o)
{
    struct kd_critical c = { .observer = *o, .status = KD_CRITICAL_BAD_INPUT };
    if (!valid(o))
        return c;
    double u = o->cos_theta;
    c.status = KD_CRITICAL_OK;
    c.sine = o->sin_theta > 0 ? o->sin_theta : sqrt((1 - u) * (1 + u));
    c.shell = kd_shell_of(&o->hole);
    if (isfinite(o->radius)) {
        const struct kd_vantage at = { o->hole, o->radius, u, c.sine };
        double bound;
        if (!kd_observer_exists(o->motion.observer, &at) || kd_observer_check(&o->motion, &at, &bound))
            c.status = KD_CRITICAL_NO_OBSERVER;
        c.tetrad = kd_observer_tetrad(&o->motion, &at);
        c.is_skew = !c.status && !kd_tetrad_is_level(&c.tetrad);
        if (c.is_skew) {
            const struct kd_observer_motion zamo = kd_observer_motion_of(KD_OBSERVER_ZAMO);
            c.skew = c.tetrad;
            c.tetrad = kd_observer_tetrad(&zamo, &at);
        }
    }
    c.low = end(&c, c.shell.prograde);
    c.high = end(&c, c.shell.retrograde);
    if (signbit(o->hole.a)) { /* for a < 0 the curve is mirrored: retrograde orbits appear on the left */
        double swap = c.low;
        c.low = c.high, c.high = swap;
    }
    c.left = along(&c, c.low), c.right = along(&c, c.high);
    if (c.right < c.left) /* the curve surrounds the direction +e_r */
        c.right += 2 * M_PI;
    c.centre = 0.5 * (c.left + c.right);
    return c;
}

/* Parameters of `miss`, a function of the place whose root is the point at the requested angle. The function rises with
 * x. Near the sides of the curve beta is the square root of a difference, so beta^2 is used there. */
struct aim {
    const struct kd_critical *curve;
    double cosine, sine;
};

static double miss(const void *user, double at)
{
    const struct aim *aim = user;
    struct place p = see(aim->curve, at);
    double x = p.x, y2 = fmax(p.y2, 0), s = aim->sine, k = aim->cosine;
    return fabs(k) < s ? x * s - sqrt(y2) * k : x * fabs(x) * s * s - y2 * k * fabs(k);
}

/* The point of the curve at an angle from 0 to pi. */
static struct place aim_at(const struct kd_critical *c, double angle)
{
    if (angle == 0)
        return see(c, c->high);
    struct aim aim = { c, cos(angle), sin(angle) };
    double at = angle == M_PI ? c->low : kd_root(miss, &aim, c->low, c->high);
    if (isnan(at)) /* returns the curve's end, because the angle differs from the end's by rounding only */
        at = angle < 1 ? c->high : c->low;
    return see(c, at);
}

void kd_critical_see(const struct kd_critical *c, struct kd_critical_point *p)
{
    if (!c->is_skew)
        return;
    const struct kd_covector photon = kd_tetrad_covector(&c->tetrad, (double[]) { 1, p->inwards, p->up, -p->right });
    const struct kd_look seen = kd_tetrad_look(&c->skew, &photon);
    p->right = seen.right, p->up = seen.up, p->inwards = seen.inwards;
}

struct kd_critical_point kd_critical_at(const struct kd_critical *c, double angle)
{
    double turned = remainder(angle, 2 * M_PI), upper = fabs(turned), s = sin(upper), k = cos(upper);
    struct place p = aim_at(c, upper);
    /* Uses the more accurate of the two coordinates, and computes the other from it and the angle. */
    bool side = fabs(k) >= s;
    double y = side ? p.x * s / k : sqrt(fmax(p.y2, 0)), x = side ? p.x : y * k / s, rho = hypot(x, y);
    struct kd_critical_point q = { .orbit = p.orbit, .alpha = p.alpha, .angle = angle, .rho = rho, .inwards = 1 };
    double below = turned < 0 ? -1 : 1;
    if (isinf(c->observer.radius)) {
        q.alpha = c->centre + x;
        q.beta = below * y;
        return q;
    }
    q.right = p.right, q.up = below * y, q.inwards = p.inwards;
    q.beta = q.up * c->tetrad.theta.polar / p.energy;
    q.rho = atan2(rho, p.inwards * cos(c->centre) + p.right * sin(c->centre));
    kd_critical_see(c, &q);
    return q;
}

static struct kd_critical_point upper(const struct kd_critical *c, double at)
{
    struct place p = see(c, at);
    double y = sqrt(fmax(p.y2, 0));
    struct kd_critical_point q = { .orbit = p.orbit, .alpha = p.alpha, .angle = atan2(y, p.x), .inwards = 1 };
    if (isinf(c->observer.radius)) {
        q.beta = y;
        q.rho = hypot(p.x, y);
        return q;
    }
    q.right = p.right, q.up = y, q.inwards = p.inwards;
    q.beta = y * c->tetrad.theta.polar / p.energy;
    q.rho = atan2(hypot(p.x, y), p.inwards * cos(c->centre) + p.right * sin(c->centre));
    return q;
}

struct kd_critical_point kd_critical_upper(const struct kd_critical *c, double along)
{
    double half = sin(0.5 * M_PI * along); /* points are denser at the ends, where beta behaves as a square root */
    return upper(c, c->low + (c->high - c->low) * half * half);
}

/* Converts a place to a coordinate in which radii are evenly spaced: (ln y - ln y_P)/(a sin i). Where it is small, it
 * is w/(y_P sin i). The next function is the inverse. */
static double evenly(const struct kd_critical *c, double at)
{
    const struct kd_shell *s = &c->shell;
    const double scale = s->spin * c->sine, half = 0.5 * s->y_polar, w = scale * at / s->y_polar;
    if (w < -0.5) /* for y < y_P/2, where places are logarithmic */
        return (log(0.5) + scale * at / half + 1) / scale;
    return scale > 1e-8 ? log1p(w) / scale : at / s->y_polar;
}

static double place_evenly(const struct kd_critical *c, double q)
{
    const struct kd_shell *s = &c->shell;
    const double scale = s->spin * c->sine, half = 0.5 * s->y_polar;
    if (scale * q < log(0.5))
        return half * (scale * q - log(0.5) - 1) / scale;
    return s->y_polar * (scale > 1e-8 ? expm1(scale * q) / scale : q);
}

struct kd_critical_point kd_critical_round(const struct kd_critical *c, double along)
{
    const double half = sin(0.5 * M_PI * along), low = evenly(c, c->low), high = evenly(c, c->high);
    return upper(c, along <= 0 ? c->low : along >= 1 ? c->high : place_evenly(c, low + (high - low) * half * half));
}

/* Sums over the upper half of the curve. The two ends have half the weight of other points. Half the curve's width is
 * subtracted from rho, so that squares keep their digits. */
struct sums { double off, off2, area; };

static void add(const struct kd_critical *c, double angle, double weight, struct sums *s)
{
    double rho = kd_critical_at(c, angle).rho, off = rho - 0.5 * (c->right - c->left), half = sin(0.5 * rho);
    s->off += weight * off;
    s->off2 += weight * off * off;
    s->area += weight * (isinf(c->observer.radius) ? 0.5 * rho * rho : 2 * half * half);
}

/* Largest height of the curve, where d(rho sin(angle)) = 0. It is found by golden section between the neighbours of the
 * highest sample. */
static double height(const struct kd_critical *c, double step)
{
    const double golden = 0.5 * (sqrt(5) - 1);
    double best = 0, at = 0;
    for (double x = step; x < M_PI; x += step) {
        double y = kd_critical_at(c, x).rho * sin(x);
        if (y > best)
            best = y, at = x;
    }
    double low = at - step, high = at + step;
    while (high - low > 1e-8) { /* the error of the largest height is the square of the bracket's width */
        double p = high - golden * (high - low), q = low + golden * (high - low);
        if (kd_critical_at(c, p).rho * sin(p) > kd_critical_at(c, q).rho * sin(q))
            high = q;
        else
            low = p;
    }
    at = 0.5 * (low + high);
    return 2 * kd_critical_at(c, at).rho * sin(at);
}

struct kd_critical_measures kd_critical_measure(const struct kd_critical *c)
{
    struct kd_critical_measures m = { .displacement = c->centre, .width = c->right - c->left };
    struct sums s = { 0 };
    if (c->is_skew)
        return (struct kd_critical_measures) { NAN, NAN, NAN, NAN, NAN, NAN, 0 };
    add(c, 0, 0.5, &s);
    add(c, M_PI, 0.5, &s);
    int n = 1; /* number of intervals of the upper half */
    double before = NAN, spread = NAN;
    for (;;) {
        double h = M_PI / n;
        if (n >= POINTS_MIN / 2) {
            m.mean_radius = 0.5 * m.width + s.off / n;
            spread = s.off2 / n - (s.off / n) * (s.off / n);
            m.area = 2 * h * s.area;
            if (fabs(m.area - before) <= 1e-13 * m.area || 2 * n >= POINTS_MAX)
                break;
            before = m.area;
        }
        for (int i = 0; i < n; i++)
            add(c, (i + 0.5) * h, 1, &s);
        n *= 2;
    }
    m.asymmetry = 2 * sqrt(fmax(spread, 0));
    m.points = 2 * n;
    m.height = height(c, M_PI / 32);
    return m;
}
