#include "kerr_schild.h"

typedef double real;
#define KS_FINE 1e-15
#define KS_ACCEPT 1e-12
#define KS_GROW 1e-14
#define KS_LAND 1e-13
#include "kerr_schild_flow.h"

struct ks_path ks_trace(struct ks_photon photon, int max_crossings)
{
    state y;
    start(&photon, y);
    return run((struct system) { photon.a, photon.energy, photon.q }, y, true, max_crossings);
}

struct ks_path ks_follow(const struct ks_place *at, const double p[4], int max_crossings)
{
    state y = { 0 };
    place(at->a, at->r, sin(at->theta), cos(at->theta), 0, (double[]) { -p[1], -p[2], -p[3] }, y);
    return run((struct system) { at->a, p[0], at->q }, y, false, max_crossings);
}

/* The Hamiltonian of a body differs from that of light by a constant, so both have the same equations of motion. */
struct ks_body_place ks_body_after(const struct ks_body *body, double proper)
{
    const double a = body->a, q = body->q, r = body->r, u = body->u, delta = r * r - 2 * r + a * a + q * q;
    const struct system s = { a, body->energy, q };
    const double p_r = body->p_r + ((2 * r - q * q) * body->energy - a * body->momentum) / delta;
    state y = { 0 }, next;
    place(a, r, sqrt((1 - u) * (1 + u)), u, -twist(a, q, r), (double[]) { p_r, body->p_theta, body->momentum }, y);
    double h = 0.02 * r, done = 0;
    while (done < proper) {
        h = fmin(h, proper - done);
        const double error = extrapolate(&s, y, h, next);
        if (!(error < 1e-13) && h > 1e-9) {
            h *= 0.5;
            continue;
        }
        done += h;
        memcpy(y, next, sizeof next);
        h *= error < 1e-15 ? 2 : 1;
    }
    const double end = radius(a, y);
    return (struct ks_body_place) { end, y[2] / end, y[6] - slow(a, q, end) + slow(a, q, r), azimuth(a, q, y) };
}

struct ks_photon ks_from_infinity(double a, double u, double alpha, double beta)
{
    return ks_from_infinity_charged(a, 0, u, alpha, beta);
}

struct ks_photon ks_from_infinity_charged(double a, double charge, double u, double alpha, double beta)
{
    double s = sqrt((1 - u) * (1 + u)), l = -alpha * s, r = 1e6;
    double q = (alpha * alpha - a * a) * u * u + beta * beta;
    /* Azimuth of the path between infinity and this place, by the first terms of the series in 1/r. */
    double t = 1 / r, pull = a * a - l * l - q, here = u + s * beta * t + 0.5 * (pull - 2 * a * a * u * u) * u * t * t;
    double delta = r * r - 2 * r + a * a + charge * charge, w = r * r + a * a - a * l;
    double big = w * w - delta * (q + (l - a) * (l - a));
    double angular = q + here * here * (a * a - l * l / ((1 - here) * (1 + here)));
    struct ks_photon p = { .a = a, .r = r, .u = here, .energy = 1, .momentum = l, .q = charge };
    p.p_r = sqrt(big) / delta; /* the photon arrives moving outwards */
    p.p_theta = copysign(sqrt(fmax(angular, 0)), beta);
    /* The coordinate time from r_o to here, minus r_o + 2 ln r_o, by the same series. */
    p.delay = -r - 2 * log(r) + (4 - charge * charge + a * a * u * u - 0.5 * pull) * t;
    if (s == 0) { /* on the axis the azimuth is that of the image point, since the traced ray leaves the axis in this
                   * direction */
        p.p_theta = copysign(p.p_theta, -u);
        p.phi = atan2(alpha, -u * beta) - a * t * t;
        return p;
    }
    p.phi = -(l * t / (s * s) + l * u * beta * t * t / (s * s * s) + a * t * t);
    return p;
}

static double dot(double g[4][4], const double *x, const double *y)
{
    double sum = 0;
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            sum += g[i][j] * x[i] * y[j];
    return sum;
}

struct ks_photon ks_from_camera(double a, double r, double theta, bool zamo, const double k[3])
{
    return ks_from_camera_charged(a, 0, r, theta, zamo, k);
}

struct ks_photon ks_from_camera_charged(double a, double charge, double r, double theta, bool zamo, const double k[3])
{
    const double mass = 2 * r - charge * charge;
    double c = cos(theta), s = sin(theta), sigma = r * r + a * a * c * c, delta = r * r + a * a - mass;
    double g[4][4] = { { 0 } }; /* components in the order t, r, theta, phi */
    g[0][0] = -(1 - mass / sigma);
    g[0][3] = g[3][0] = -a * mass * s * s / sigma;
    g[1][1] = sigma / delta;
    g[2][2] = sigma;
    g[3][3] = (r * r + a * a + a * a * mass * s * s / sigma) * s * s;
    double u[4] = { 1, 0, 0, zamo ? -g[0][3] / g[3][3] : 0 }, e[4] = { 0, 0, 0, 1 };
    double n = 1 / sqrt(-dot(g, u, u));
    for (int i = 0; i < 4; i++)
        u[i] *= n;
    double along = dot(g, u, e);
    for (int i = 0; i < 4; i++)
        e[i] += along * u[i];
    n = 1 / sqrt(dot(g, e, e));
    double p[4], low[4] = { 0 };
    for (int i = 0; i < 4; i++)
        p[i] = u[i] - k[2] * n * e[i];
    p[1] -= k[0] / sqrt(g[1][1]);
    p[2] -= k[1] / sqrt(g[2][2]);
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            low[i] += g[i][j] * p[j];
    return (struct ks_photon) { a, r, c, -low[0], low[3], low[1], low[2], 0, 0, charge };
}

struct along {
    struct system system;
    const struct ks_photon *photon;
    double inner, outer;
    ks_medium *medium;
    void *user;
    struct ks_light sum;
};

static void medium_at(const struct along *w, const double *from, double t, double out[2])
{
    state y;
    extrapolate(&w->system, from, t, y);
    const double a = w->system.a, r = radius(a, y), u = y[2] / r, s = sqrt((1 - u) * (1 + u)), q = r * r + a * a,
                 term = 2 * r - w->system.q * w->system.q, delta = r * r - term + a * a;
    /* The traced ray is mirrored in time; ingoing Kerr-Schild t and phi increase with r by (2r - q^2)/Delta and
     * a/Delta. */
    const double p_r = ((r * y[0] + a * y[1]) * y[3] + (r * y[1] - a * y[0]) * y[4]) / q + u * y[5];
    struct ks_photon at = *w->photon;
    at.r = r;
    at.u = u;
    at.phi = -azimuth(a, w->system.q, y);
    at.delay = y[6] - slow(a, w->system.q, r);
    at.p_r = (term * at.energy - a * at.momentum) / delta - p_r;
    at.p_theta = r * s * y[5] - u / s * (y[0] * y[3] + y[1] * y[4]);
    w->medium(w->user, &at, r, u, out);
}

/* Integrates from t0 to t1 after a state, by Simpson's rule. */
static void add_stretch(struct along *w, const double *from, double t0, double t1)
{
    double a[2], b[2], c[2], h = t1 - t0;
    medium_at(w, from, t0, a);
    medium_at(w, from, 0.5 * (t0 + t1), b);
    medium_at(w, from, t1, c);
    double middle = w->sum.depth + h * (5 * a[1] + 8 * b[1] - c[1]) / 24,
           end = w->sum.depth + h * (a[1] + 4 * b[1] + c[1]) / 6;
    w->sum.light += h / 6 * (a[0] * exp(-w->sum.depth) + 4 * b[0] * exp(-middle) + c[0] * exp(-end));
    w->sum.depth = end;
    w->sum.length += h;
}

static double radius_after(const struct along *w, const double *from, double t)
{
    state y;
    extrapolate(&w->system, from, t, y);
    return radius(w->system.a, y);
}

static bool holds(const struct along *w, double r) { return r >= w->inner && r <= w->outer; }

/* Like add_stretch, but only for the part of the interval that is between the two radii. At most one of the radii is
 * within the interval. */
static void add_inside(struct along *w, const double *from, double t0, double t1)
{
    bool first = holds(w, radius_after(w, from, t0)), last = holds(w, radius_after(w, from, t1));
    double low = t0, high = t1;
    for (int i = 0; i < 50 && first != last; i++) {
        double t = 0.5 * (low + high);
        *(holds(w, radius_after(w, from, t)) == first ? &low : &high) = t;
    }
    if (first && last)
        add_stretch(w, from, t0, t1);
    else if (first || last)
        add_stretch(w, from, first ? t0 : high, first ? low : t1);
}

struct ks_light ks_along(struct ks_photon photon, double inner, double outer, bool to_plane, ks_medium *medium,
                         void *user)
{
    enum { PARTS = 16 };
    struct along w = { { photon.a, photon.energy, photon.q }, &photon, inner, outer, medium, user, { 0 } };
    const double horizon = 1 + half_gap(photon.a, photon.q);
    state y, next;
    start(&photon, y);
    double h = 0.05 * radius(photon.a, y);
    for (int step = 0; step < 20000; step++) {
        double r = radius(photon.a, y), v = sqrt(y[3] * y[3] + y[4] * y[4] + y[5] * y[5]) + 2 * fabs(photon.energy) / r;
        bool outwards = y[0] * y[3] + y[1] * y[4] + y[2] * y[5] > 0;
        if (r < horizon * (1 + 1e-9) || (r > 2 * outer && r > 20 && outwards))
            break;
        h = fmin(h, 0.25 * r / v);
        double error = extrapolate(&w.system, y, h, next);
        if (!(error < 1e-12) && h > 1e-9) {
            h *= 0.5;
            continue;
        }
        bool meets = to_plane && y[2] != 0 && (y[2] > 0) != (next[2] > 0);
        double end = h;
        for (double low = 0, i = 0; i < 50 && meets; i++) {
            double t = 0.5 * (low + end);
            extrapolate(&w.system, y, t, next);
            *((next[2] > 0) == (y[2] > 0) ? &low : &end) = t;
        }
        for (int k = 0; k < PARTS; k++)
            add_inside(&w, y, k * end / PARTS, (k + 1) * end / PARTS);
        if (meets)
            break;
        memcpy(y, next, sizeof next);
        h *= error < 1e-14 ? 2 : 1;
    }
    return w.sum;
}

struct target { double at[3], f, l[3]; };

/* Azimuths are mirrored, as those of the path are. */
static struct target target_of(double a, double charge, double r, double u, double phi)
{
    const double psi = -phi + atan2(a, r) - twist(a, charge, r), s = sqrt((1 - u) * (1 + u)) * sqrt(r * r + a * a),
                 x = s * cos(psi), y = s * sin(psi), q = r * r + a * a;
    return (struct target) { { x, y, r * u },
                             r * r * (2 * r - charge * charge) / (r * r * r * r + a * a * r * r * u * u),
                             { (r * x + a * y) / q, (r * y - a * x) / q, u } };
}

/* Derivative of the distance to the target, which is negative on approach. */
static double recedes(const struct system *s, const struct target *c, const double *y)
{
    state d;
    derivative(s, y, d);
    return (y[0] - c->at[0]) * d[0] + (y[1] - c->at[1]) * d[1] + (y[2] - c->at[2]) * d[2];
}

/* On the wave front p_mu dx^mu = 0; ds^2 = -dt^2 + dx^2 + f (dt + l.dx)^2. */
static struct ks_near near_of(const struct system *s, const struct target *c, const double *y)
{
    double t = 0, x2 = 0, along = 0;
    for (int i = 0; i < 3; i++) {
        double d = y[i] - c->at[i];
        t += y[3 + i] * d / s->energy;
        x2 += d * d;
        along += c->l[i] * d;
    }
    return (struct ks_near) { sqrt(fmax(x2 - t * t + c->f * (t + along) * (t + along), 0)),
                              y[6] - slow(s->a, s->q, radius(s->a, y)) };
}

int ks_passes(struct ks_photon photon, double r, double u, double phi, double within, int most, struct ks_near *out)
{
    const struct system s = { photon.a, photon.energy, photon.q };
    const struct target c = target_of(photon.a, photon.q, r, u, phi);
    const double horizon = 1 + half_gap(photon.a, photon.q);
    int n = 0;
    state y, next;
    start(&photon, y);
    double h = 0.05 * radius(photon.a, y);
    for (int step = 0; step < 20000 && n < most; step++) {
        double at = radius(photon.a, y),
               v = sqrt(y[3] * y[3] + y[4] * y[4] + y[5] * y[5]) + 2 * fabs(photon.energy) / at;
        bool outwards = y[0] * y[3] + y[1] * y[4] + y[2] * y[5] > 0;
        if (at < horizon * (1 + 1e-9) || (at > 2 * r && at > 20 && outwards))
            break;
        h = fmin(h, 0.25 * at / v);
        double error = extrapolate(&s, y, h, next);
        if (!(error < 1e-12) && h > 1e-9) {
            h *= 0.5;
            continue;
        }
        if (recedes(&s, &c, y) < 0 && recedes(&s, &c, next) >= 0) {
            double low = 0, high = h;
            state hit;
            for (int i = 0; i < 40; i++) {
                extrapolate(&s, y, 0.5 * (low + high), hit);
                *(recedes(&s, &c, hit) < 0 ? &low : &high) = 0.5 * (low + high);
            }
            double x = hit[0] - c.at[0], yy = hit[1] - c.at[1], z = hit[2] - c.at[2];
            if (x * x + yy * yy + z * z < within * within)
                out[n++] = near_of(&s, &c, hit);
        }
        memcpy(y, next, sizeof next);
        h *= error < 1e-14 ? 2 : 1;
    }
    return n;
}

/* Position of a path by its distances from the axis and the plane. nearest: the path's point that is closest to a place
 * so far. */
struct meridian { double x, z; };
struct nearest {
    state from;
    double low, high, off;
};

static struct meridian meridian_after(const struct system *s, const double *from, double t)
{
    state y;
    extrapolate(s, from, t, y);
    const double r = radius(s->a, y), u = y[2] / r;
    return (struct meridian) { r * sqrt((1 - u) * (1 + u)), y[2] };
}

/* The fraction of the segment from a to b that is closest to c, and the distance. */
static double part_of(struct meridian a, struct meridian b, struct meridian c, double *off)
{
    const double dx = b.x - a.x, dz = b.z - a.z, long2 = dx * dx + dz * dz;
    const double t = long2 > 0 ? fmin(fmax(((c.x - a.x) * dx + (c.z - a.z) * dz) / long2, 0), 1) : 0;
    *off = hypot(a.x + t * dx - c.x, a.z + t * dz - c.z);
    return t;
}

/* Searches the path between the parameters `low` and `high` after the state `from` for its point closest to `place`. If
 * this point is closer than the best so far, stores it in `best`. */
static void look(const struct system *s, const double *from, double low, double high, struct meridian place,
                 struct nearest *best)
{
    enum { PARTS = 8 };
    struct meridian a = meridian_after(s, from, low);
    for (int k = 0; k < PARTS; k++) {
        const double t0 = low + k * (high - low) / PARTS, t1 = low + (k + 1) * (high - low) / PARTS;
        const struct meridian b = meridian_after(s, from, t1);
        double off;
        part_of(a, b, place, &off);
        if (off < best->off) {
            memcpy(best->from, from, sizeof best->from);
            best->low = t0, best->high = t1, best->off = off;
        }
        a = b;
    }
}

static double delay_at(const struct system *s, struct nearest *best, struct meridian place)
{
    for (int i = 0; i < 4; i++) {
        const struct nearest was = *best;
        best->off = INFINITY;
        look(s, was.from, was.low, was.high, place, best);
    }
    const double t =
        part_of(meridian_after(s, best->from, best->low), meridian_after(s, best->from, best->high), place, &best->off);
    state y;
    extrapolate(s, best->from, best->low + t * (best->high - best->low), y);
    return y[6] - slow(s->a, s->q, radius(s->a, y));
}

void ks_delays(struct ks_photon photon, const double (*places)[2], int n, double *delay, double *off)
{
    static struct nearest best[KS_MOST_PLACES];
    static struct meridian at[KS_MOST_PLACES];
    const struct system s = { photon.a, photon.energy, photon.q };
    const double horizon = 1 + half_gap(photon.a, photon.q);
    state y, next;
    start(&photon, y);
    for (int i = 0; i < n; i++) {
        best[i].off = INFINITY;
        at[i] = (struct meridian) { places[i][0] * sqrt(fmax((1 - places[i][1]) * (1 + places[i][1]), 0)),
                                    places[i][0] * places[i][1] };
    }
    double h = 0.05 * radius(photon.a, y);
    for (int step = 0; step < 20000; step++) {
        const double r = radius(photon.a, y),
                     v = sqrt(y[3] * y[3] + y[4] * y[4] + y[5] * y[5]) + 2 * fabs(photon.energy) / r;
        if (r < horizon * (1 + 1e-9) || (r > 200 && y[0] * y[3] + y[1] * y[4] + y[2] * y[5] > 0))
            break;
        h = fmin(h, 0.1 * r / v);
        const double error = extrapolate(&s, y, h, next);
        if (!(error < 1e-12) && h > 1e-9) {
            h *= 0.5;
            continue;
        }
        for (int i = 0; i < n; i++)
            if (fabs(r / places[i][0] - 1) < 0.5)
                look(&s, y, 0, h, at[i], &best[i]);
        memcpy(y, next, sizeof next);
        h *= error < 1e-14 ? 2 : 1;
    }
    for (int i = 0; i < n; i++) {
        delay[i] = isfinite(best[i].off) ? delay_at(&s, &best[i], at[i]) : NAN;
        off[i] = best[i].off;
    }
}
