/* Tests of every kind of observer. The metric used for comparison is written here in the form of its line element
 * (Boyer & Lindquist 1967, J. Math. Phys. 8, 265) and inverted by elimination in extended precision. Constants of
 * motion are compared with frames computed in Kerr-Schild coordinates. */
#include "kerr_schild.h"
#include "kerr_schild_frame.h"
#include "physics/spacetime/kerr.h"
#include "physics/spacetime/observer.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#define COUNT(x) (sizeof(x) / sizeof *(x))
enum { T, R, THETA, PHI };
typedef long double vector[4], matrix[4][4];

/* ds^2 = -(Delta/Sigma) (dt - a sin^2 dphi)^2 + (sin^2/Sigma) ((r^2 + a^2) dphi - a dt)^2 + (Sigma/Delta) dr^2 +
 * Sigma dtheta^2 */
static void metric(const struct kd_vantage *at, matrix g)
{
    long double a = at->hole.a, r = at->r, u = at->u, s = at->s, sigma = r * r + a * a * u * u;
    /* r^2 - 2r + a^2 would cancel near the horizon. With sqrtl this form is more accurate than the double of the code
     * under test */
    long double root = sqrtl((1 - a) * (1 + a)), delta = (r - 1 - root) * (r - 1 + root);
    vector time = { [T] = 1, [PHI] = -a * s * s }, turn = { [T] = -a, [PHI] = r * r + a * a };
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            g[i][j] = (s * s * turn[i] * turn[j] - delta * time[i] * time[j]) / sigma;
    g[R][R] += sigma / delta;
    g[THETA][THETA] += sigma;
}

/* Solves g x = p for x. */
static void raise_index(matrix g, const vector p, vector x)
{
    long double m[4][5];
    for (int i = 0; i < 4; i++) {
        memcpy(m[i], g[i], sizeof(vector));
        m[i][4] = p[i];
    }
    for (int i = 0; i < 4; i++) {
        int pivot = i;
        for (int k = i + 1; k < 4; k++)
            if (fabsl(m[k][i]) > fabsl(m[pivot][i]))
                pivot = k;
        for (int j = 0; j < 5; j++) {
            long double kept = m[i][j];
            m[i][j] = m[pivot][j];
            m[pivot][j] = kept;
        }
        for (int k = 0; k < 4; k++) {
            long double share = k == i ? 0 : m[k][i] / m[i][i];
            for (int j = i; j < 5; j++)
                m[k][j] -= share * m[i][j];
        }
    }
    for (int i = 0; i < 4; i++)
        x[i] = m[i][4] / m[i][i];
}

static long double dot(const vector p, const vector x) { return p[0] * x[0] + p[1] * x[1] + p[2] * x[2] + p[3] * x[3]; }

/* Components are covariant, in Boyer-Lindquist coordinates. */
static void lower(const struct kd_vantage *at, const struct kd_covector *p, vector out)
{
    long double root = sqrtl((1 - (long double)at->hole.a) * (1 + (long double)at->hole.a));
    out[T] = -p->energy;
    out[R] = p->radial / ((at->r - 1 - root) * (at->r - 1 + root));
    out[THETA] = p->polar;
    out[PHI] = (long double)p->momentum * at->s;
}

static const double spins[] = { 0, 1e-9, 0.3, -0.7, 0.9, -0.998, 0.999999 },
                    angles[] = { 1e-6, 0.01, 0.4, 1.1, M_PI / 2, 2, 3.1 },
                    heights[] = { 1e-7, 1e-3, 0.02, 0.3, 1, 3, 20, 1e3, 1e6 };

/* Motions of every kind. L is scaled down near the axis, and fall_from is given as a multiple of the radius. */
static const struct kd_observer_motion motions[] = {
    { .observer = KD_OBSERVER_STATIC },
    { .observer = KD_OBSERVER_ZAMO },
    { .observer = KD_OBSERVER_KEPLERIAN },
    { .observer = KD_OBSERVER_RETROGRADE },
    { .observer = KD_OBSERVER_INFALL, .fall_from = INFINITY, .fall_energy = INFINITY },
    { .observer = KD_OBSERVER_INFALL, .fall_from = 1.5, .fall_energy = INFINITY },
    { .observer = KD_OBSERVER_INFALL, .fall_from = INFINITY, .fall_energy = 1.25, .fall_momentum = 0.75 },
    { .observer = KD_OBSERVER_INFALL, .fall_from = INFINITY, .fall_energy = 2, .fall_momentum = -2 },
    { .observer = KD_OBSERVER_VELOCITY, .velocity = { 0.3, -0.2, 0.5 } },
    { .observer = KD_OBSERVER_VELOCITY, .velocity = { -0.9, 0, 0.3 } },
};

/* Calls `each` for places from just outside the limit of where the observer can be to a million times as far out. */
typedef void check(const struct kd_observer_motion *m, const struct kd_vantage *at, const struct kd_tetrad *frame);
static void everywhere(check *each)
{
    int seen[COUNT(motions)] = { 0 };
    for (size_t n = 0; n < COUNT(spins) * COUNT(angles) * COUNT(heights) * COUNT(motions); n++) {
        double a = spins[n % COUNT(spins)], theta = angles[n / COUNT(spins) % COUNT(angles)];
        double height = heights[n / COUNT(spins) / COUNT(angles) % COUNT(heights)], bound;
        size_t k = n / COUNT(spins) / COUNT(angles) / COUNT(heights);
        struct kd_observer_motion m = motions[k];
        struct kd_vantage at = { .hole = kd_hole_of(a), .u = cos(theta), .s = sin(theta) };
        at.r = fmax(kd_observers[m.observer].outside(&at.hole, at.u), at.hole.outer) *
               (1 + height); /* the coordinates are singular on the axis */
        m.fall_momentum *= at.s;
        m.fall_from *= at.r;
        assert_true(kd_observer_exists(m.observer, &at));
        /* skipped, because with its constants the body turns back before it gets here */
        if (kd_observer_check(&m, &at, &bound)) {
            assert_true(m.observer == KD_OBSERVER_INFALL && m.fall_momentum != 0);
            continue;
        }
        const struct kd_tetrad frame = kd_observer_tetrad(&m, &at);
        each(&m, &at, &frame);
        seen[k]++;
    }
    for (size_t k = 0; k < COUNT(motions); k++)
        assert_true(seen[k] > (int)(COUNT(spins) * COUNT(angles) * COUNT(heights)) / 2);
}

/* The relative rounding error of Delta or g_tt, which vanish at the edge of the region where the observer exists. It is
 * the rounding of r, or the shift of the edge by the rounding of cos(theta), divided by the distance to the edge. */
static double rounding(const struct kd_observer_motion *m, const struct kd_vantage *at)
{
    double edge = fmax(kd_observers[m->observer].outside(&at->hole, at->u), at->hole.outer),
           inner = fabs(at->r - at->hole.outer);
    double moves = at->hole.a * at->hole.a / fabs(edge - 1);
    return (m->observer > KD_OBSERVER_ZAMO ? 100 : 8) * 2.2e-16 *
           ((at->r + moves) / (at->r - edge) + at->r / inner + 1);
}

static void near(double is, double wanted, double bound, const char *what, const struct kd_observer_motion *m,
                 const struct kd_vantage *at)
{
    if (!(fabs(is - wanted) <= bound))
        fail_msg("%s is %.17g, not %.17g within %.3g: %s, a = %g, r = %.17g, u = %g", what, is, wanted, bound,
                 kd_observers[m->observer].word, at->hole.a, at->r, at->u);
}

/* The derivative of the metric with respect to r, by differences. */
static void slope(const struct kd_vantage *at, matrix out)
{
    matrix g[4];
    const double h = 1e-4 * (at->r - at->hole.outer);
    for (int k = 0; k < 4; k++) {
        struct kd_vantage beside = *at;
        beside.r += h * (k < 2 ? k - 2 : k - 1);
        metric(&beside, g[k]);
    }
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            out[i][j] = (g[0][i][j] - 8 * g[1][i][j] + 8 * g[2][i][j] - g[3][i][j]) / (12 * h);
}

/* The radial force on a body that stays at its radius and latitude, 1/2 u^i u^j d_r g_ij, divided by the size of its
 * terms. */
static double force(const struct kd_vantage *at, const vector up)
{
    matrix d;
    long double sum = 0, size = 0;
    slope(at, d);
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            sum += up[i] * up[j] * d[i][j], size += fabsl(up[i] * up[j] * d[i][j]);
    return (double)(sum / size);
}

/* The energy of a body at r with that angular momentum and without other motion: the root of g^tt E^2 - 2 g^tphi E L
 * + g^phiphi L^2 = -1, by the inverse metric. */
static double energy_at_rest(const struct kd_vantage *at, double momentum)
{
    matrix g;
    vector e = { [T] = -1 }, l = { [PHI] = momentum }, up_e, up_l;
    metric(at, g);
    raise_index(g, e, up_e);
    raise_index(g, l, up_l);
    long double tt = dot(e, up_e), mixed = dot(e, up_l), rest = dot(l, up_l) + 1;
    return (double)((-mixed - sqrtl(mixed * mixed - tt * rest)) / tt);
}

static void circular_orbit(const struct kd_observer_motion *m, const struct kd_vantage *at, const vector down,
                           const vector up)
{
    int sense = m->observer == KD_OBSERVER_KEPLERIAN ? 1 : -1;
    near((double)up[R], 0, 0, "fall", m, at);
    near((double)up[THETA], 0, 0, "way down", m, at);
    near(force(at, up), 0, 1e-9 + rounding(m, at), "force", m, at);
    if (fabs(at->u) < 1e-9) { /* Bardeen, Press & Teukolsky's circular orbits */
        double a = sense * at->hole.a, bound = 4 * rounding(m, at);
        near((double)-down[T], kd_kerr_energy(kd_hole(a), at->r), bound * kd_kerr_energy(kd_hole(a), at->r), "E", m,
             at);
        near((double)down[PHI], sense * kd_kerr_momentum(kd_hole(a), at->r),
             bound * fabs(kd_kerr_momentum(kd_hole(a), at->r)), "L", m, at);
    }
}

static void free_fall(const struct kd_observer_motion *m, const struct kd_vantage *at, const vector down,
                      const vector up)
{
    struct kd_vantage from = *at;
    from.r = m->fall_from;
    double energy = isfinite(m->fall_energy) ? m->fall_energy
                    : isfinite(from.r)       ? energy_at_rest(&from, m->fall_momentum)
                                             : 1;
    near((double)-down[T], energy, 1e-14 * fabs(energy) + rounding(m, at) * 1e-2, "E", m, at);
    near((double)down[PHI], m->fall_momentum, 1e-14 * fabs(m->fall_momentum), "L", m, at);
    near((double)down[THETA], 0, 0, "way down", m, at);
    assert_true(up[R] < 0);
    if (at->hole.a == 0 && isfinite(from.r) && m->fall_momentum == 0)
        near(energy, sqrt(1 - 2 / from.r), 1e-14, "E of Schwarzschild", m, at);
}

/* The velocity as an observer of zero angular momentum measures it. */
static void velocity(const struct kd_observer_motion *m, const struct kd_vantage *at, const vector up)
{
    const struct kd_observer_motion zamo = kd_observer_motion_of(KD_OBSERVER_ZAMO);
    const struct kd_tetrad rest = kd_observer_tetrad(&zamo, at);
    const struct kd_covector *const legs[] = { &rest.t, &rest.r, &rest.theta, &rest.phi };
    double x[4];
    for (int i = 0; i < 4; i++) {
        vector down;
        lower(at, legs[i], down);
        x[i] = (double)dot(down, up) * (i ? 1 : -1);
    }
    for (int i = 0; i < 3; i++)
        near(x[i + 1] / x[0], m->velocity[i], rounding(m, at), "velocity", m, at);
}

static void what_it_is_called_after(const struct kd_observer_motion *m, const struct kd_vantage *at, matrix g,
                                    const vector down, const vector up)
{
    switch (m->observer) {
    case KD_OBSERVER_STATIC:
        for (int i = R; i <= PHI; i++)
            near((double)(up[i] / up[T] * sqrtl(g[i][i])), 0, rounding(m, at), "velocity", m, at);
        break;
    case KD_OBSERVER_ZAMO:
        near((double)down[PHI], 0, 0, "angular momentum", m, at);
        near((double)up[R], 0, 0, "fall", m, at);
        near((double)up[THETA], 0, 0, "way down", m, at);
        break;
    case KD_OBSERVER_KEPLERIAN:
    case KD_OBSERVER_RETROGRADE: circular_orbit(m, at, down, up); break;
    case KD_OBSERVER_INFALL: free_fall(m, at, down, up); break;
    case KD_OBSERVER_VELOCITY: velocity(m, at, up); break;
    case KD_OBSERVER_COUNT: fail_msg("an observer that says nothing of its velocity");
    }
}

/* The rounding of a product of two legs of an infalling body, where p^r and E - Omega_H L nearly cancel in these
 * coordinates; 0 for other observers. */
static double cancelled(const struct kd_observer_motion *m, const struct kd_vantage *at, const vector p, const vector x)
{
    long double size = 0;
    for (int i = 0; i < 4; i++)
        size += fabsl(p[i] * x[i]);
    return m->observer == KD_OBSERVER_INFALL ? 16 * 2.2e-16 * (double)size * (1 + at->r / (at->r - at->hole.outer)) : 0;
}

static void orthonormal_at(const struct kd_observer_motion *m, const struct kd_vantage *at,
                           const struct kd_tetrad *frame)
{
    const struct kd_covector *const legs[] = { &frame->t, &frame->r, &frame->theta, &frame->phi };
    matrix g;
    vector down[4], up[4];
    metric(at, g);
    for (int i = 0; i < 4; i++) {
        lower(at, legs[i], down[i]);
        raise_index(g, down[i], up[i]);
    }
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            near((double)dot(down[i], up[j]),
                 i != j ? 0
                 : i    ? 1
                        : -1,
                 rounding(m, at) + cancelled(m, at, down[i], up[j]), "product", m, at);
    /* The time leg points to the future. The other legs point outwards, away from the north pole and along the
     * rotation, before the boost. */
    const struct kd_observer_motion zamo = kd_observer_motion_of(KD_OBSERVER_ZAMO);
    const struct kd_tetrad rest = kd_observer_tetrad(&zamo, at);
    const struct kd_covector *const still[] = { &rest.t, &rest.r, &rest.theta, &rest.phi };
    for (int i = 0; i < 4; i++) {
        vector other;
        lower(at, still[i], other);
        assert_true((i ? 1 : -1) * dot(other, up[i]) > 0);
    }
    what_it_is_called_after(m, at, g, down[T], up[T]);
}

static void orthonormal(void **state)
{
    (void)state;
    everywhere(orthonormal_at);
}

static const double directions[][3] = { { 1, 0, 0 },  { 0, 1, 0 },          { 0, 0, 1 },
                                        { 0, 0, -1 }, { 0.48, -0.6, 0.64 }, { -0.64, 0.48, -0.6 } };

/* The frame of an observer in Kerr-Schild coordinates, from its constants of motion or its velocity. */
static struct ks_frame frame_by_oracle(const struct kd_observer_motion *m, const struct kd_vantage *v,
                                       const struct kd_tetrad *frame)
{
    const struct ks_place at = { v->hole.a, v->r, atan2(v->s, v->u) };
    struct ks_frame base = m->observer == KD_OBSERVER_INFALL ? ks_rain(&at) : ks_zamo(&at);
    double u[4] = { 0 }, x[4] = { 1, m->velocity[0], m->velocity[1], m->velocity[2] };
    double gamma = 1 / sqrt(1 - (x[1] * x[1] + x[2] * x[2] + x[3] * x[3]));
    if (m->observer == KD_OBSERVER_INFALL)
        /* takes E from the code, because E is tested elsewhere */
        ks_inwards(&at, 1, frame->t.energy, m->fall_momentum, 0, u);
    for (int i = 0; i < 4 && m->observer == KD_OBSERVER_VELOCITY; i++)
        for (int k = 0; k < 4; k++)
            u[k] += gamma * x[i] * base.e[i][k];
    if (m->observer == KD_OBSERVER_ZAMO)
        return base;
    if (m->observer != KD_OBSERVER_INFALL &&
        m->observer != KD_OBSERVER_VELOCITY) { /* on circular orbits p^r = 0; E and L are tested elsewhere */
        double delta = at.r * at.r - 2 * at.r + at.a * at.a;
        u[0] = -frame->t.energy, u[3] = frame->t.momentum * v->s, u[1] = -(2 * at.r * u[0] + at.a * u[3]) / delta;
    }
    return ks_boost(&at, &base, u);
}

/* The reference makes its frames by Gram and Schmidt's method and covariant boosts. */
static void constants_at(const struct kd_observer_motion *m, const struct kd_vantage *at, const struct kd_tetrad *frame)
{
    double bound = 100 * rounding(m, at) * (1 + 1 / at->s);
    /* skipped for static observers, because the axes of their frames are not those of boosted frames */
    if (bound > 1e-4 || at->s < 1e-3 || m->observer == KD_OBSERVER_STATIC)
        return;
    const struct ks_place place = { at->hole.a, at->r, atan2(at->s, at->u) };
    const struct ks_frame oracle = frame_by_oracle(m, at, frame);
    double size = fabs(frame->phi.momentum) + fabs(frame->t.momentum);
    for (size_t i = 0; i < COUNT(directions); i++) {
        const double *k = directions[i];
        double p[4], want[4];
        ks_seen(&oracle, (double[]) { -k[0], -k[1], -k[2] }, p);
        ks_constants(&place, p, want);
        struct kd_covector is = kd_tetrad_covector(frame, (double[]) { 1, k[0], k[1], k[2] });
        near(is.energy, want[0], bound * (fabs(frame->t.energy) + fabs(frame->phi.energy)), "E", m, at);
        near(is.momentum * at->s, want[1], bound * size * at->s, "L", m, at);
        near(is.polar, want[2], bound * size, "p_theta", m, at);
        near(is.radial, want[3], bound * (size * at->r + fabs(frame->r.radial) + fabs(frame->t.radial)), "p^r", m, at);
    }
}

/* The first reference has frames at rest, in Boyer-Lindquist coordinates. */
static void at_rest_at(const struct kd_observer_motion *m, const struct kd_vantage *at, const struct kd_tetrad *frame)
{
    double theta = atan2(at->s, at->u), bound = 40 * rounding(m, at) * (1 + 1 / at->s);
    if (bound > 1e-4 || at->s < 1e-3 || m->observer > KD_OBSERVER_ZAMO)
        return;
    for (size_t i = 0; i < COUNT(directions); i++) {
        const double *k = directions[i];
        struct ks_photon want = ks_from_camera(at->hole.a, at->r, theta, m->observer == KD_OBSERVER_ZAMO,
                                               (double[]) { -k[0], -k[1], -k[2] });
        struct kd_covector is = kd_tetrad_covector(frame, (double[]) { 1, k[0], k[1], k[2] });
        double size = fabs(frame->phi.momentum) + fabs(frame->t.momentum);
        near(is.energy, want.energy, bound * (fabs(frame->t.energy) + fabs(frame->phi.energy)), "E", m, at);
        near(is.momentum * at->s, want.momentum, bound * size * at->s, "L", m, at);
        near(is.polar, want.p_theta, bound * at->r, "p_theta", m, at);
    }
}

static void constants(void **state)
{
    (void)state;
    everywhere(at_rest_at);
    everywhere(constants_at);
}

/* The square of the observer's Lorentz factor in the frame of an observer of zero angular momentum. */
static double square_gamma(const struct kd_observer_motion *m, const struct kd_vantage *at,
                           const struct kd_tetrad *frame)
{
    const struct kd_observer_motion zamo = kd_observer_motion_of(KD_OBSERVER_ZAMO);
    double lapse = kd_observer_tetrad(&zamo, at).t.energy;
    double gamma = (frame->t.energy - kd_kerr_dragging(&at->hole, at->r, at->u) * frame->t.momentum * at->s) / lapse;
    return m->observer > KD_OBSERVER_ZAMO ? gamma * gamma * (1 + at->r / (at->r - at->hole.outer)) : 1;
}

/* Components survive the conversion into the frame and back, and a photon is seen in the direction from which it comes.
 * The same is tested for a frame whose axes are mixed by rotations. */
static void back_and_forth_at(const struct kd_observer_motion *m, const struct kd_vantage *at,
                              const struct kd_tetrad *frame)
{
    static const double v[] = { 0.3, -0.2, 0.5 };
    const double gamma = 1 / sqrt(1 - (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]));
    const struct kd_tetrad moving =
        kd_tetrad_boosted(frame, (double[]) { gamma, gamma * v[0], gamma * v[1], gamma * v[2] });
    /* The condition number of the answer. Next to an edge E and L of the frame are nearly proportional. */
    double bound = 300 * 2.2e-16 * (1 + frame->phi.momentum / fabs(at->r * frame->t.energy)) *
                   (1 + at->r / fabs(frame->phi.momentum));
    bound *= 4 * square_gamma(m, at, frame);
    for (size_t i = 0; i < 2 * COUNT(directions); i++) {
        const double *k = directions[i / 2], x[] = { 1, k[0], k[1], k[2] };
        const struct kd_tetrad *f = i % 2 ? &moving : frame;
        struct kd_covector p = kd_tetrad_covector(f, x);
        double back[4];
        kd_tetrad_components(f, &p, back);
        for (int j = 0; j < 4; j++)
            near(back[j], x[j], bound, "component", m, at);
        struct kd_look look = kd_tetrad_look(f, &p);
        near(look.inwards, k[0], bound, "inwards", m, at);
        near(look.up, k[1], bound, "up", m, at);
        near(look.right, -k[2], bound, "right", m, at);
        near(look.energy, p.energy, bound * (1 + fabs(p.energy)), "energy", m, at);
    }
    assert_true(kd_tetrad_is_level(frame) == (m->velocity[1] == 0) && !kd_tetrad_is_level(&moving));
}

static void back_and_forth(void **state)
{
    (void)state;
    everywhere(back_and_forth_at);
}

/* The outgoing photon is null by the metric. */
static void outgoing_at(const struct kd_observer_motion *m, const struct kd_vantage *at, const struct kd_tetrad *frame)
{
    (void)m, (void)frame;
    if (at->s < 1e-3)
        return;
    matrix g;
    vector down, up;
    struct kd_covector p = kd_tetrad_outgoing(at, 1.3, -0.7);
    metric(at, g);
    lower(at, &p, down);
    raise_index(g, down, up);
    double size = (double)(fabsl(down[T] * up[T]) + fabsl(down[R] * up[R]) + fabsl(down[PHI] * up[PHI]));
    near((double)dot(down, up), 0, 4 * rounding(m, at) * size, "norm", m, at);
    assert_true(p.energy == 1 && p.momentum == -1.3 && p.polar == -0.7 && p.radial > 0);
}

static void outgoing(void **state)
{
    (void)state;
    everywhere(outgoing_at);
    assert_true(kd_tetrad_outgoing(&(struct kd_vantage) { kd_hole_of(0), 3, 0, 1 }, 9, 0).radial == 0);
}

static void words(void **state)
{
    (void)state;
    char text[KD_OBSERVER_TEXT];
    const struct kd_vantage far = { kd_hole_of(0.9), 10, 0, 1 }, ergosphere = { kd_hole_of(0.9), 1.9, 0, 1 },
                            hole = { kd_hole_of(0.9), 1.2, 0, 1 };
    assert_string_equal(KD_OBSERVER_WORDS, "static|zamo|keplerian|retrograde|infall|velocity");
    assert_string_equal(kd_observers[KD_OBSERVER_STATIC].word, "static");
    assert_string_equal(kd_observers[KD_OBSERVER_ZAMO].word, "zamo");
    assert_string_equal(kd_observer_others(&far, text),
                        "\"static\" or \"zamo\" or \"keplerian\" or \"retrograde\" or \"infall\" or \"velocity\"");
    assert_string_equal(kd_observer_others(&ergosphere, text),
                        "\"zamo\" or \"keplerian\" or \"infall\" or \"velocity\"");
    assert_string_equal(kd_observer_others(&hole, text), "\"infall\"");
    assert_true(!kd_observer_exists(KD_OBSERVER_STATIC, &ergosphere) &&
                kd_observer_exists(KD_OBSERVER_ZAMO, &ergosphere));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(orthonormal), cmocka_unit_test(constants), cmocka_unit_test(back_and_forth),
        cmocka_unit_test(outgoing),    cmocka_unit_test(words),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
