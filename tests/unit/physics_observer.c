/* Every row of the table of observers against a metric that is written down here, in the form of its line element (Boyer & Lindquist
 * 1967, J. Math. Phys. 8, 265) and inverted by elimination in extended precision; constants of motion against the oracle's own frames. */
#include "kerr_schild.h"
#include "physics/kerr.h"
#include "physics/observer.h"

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

/* ds^2 = -(Delta/Sigma) (dt - a sin^2 dphi)^2 + (sin^2/Sigma) ((r^2 + a^2) dphi - a dt)^2 + (Sigma/Delta) dr^2 + Sigma dtheta^2 */
static void metric(const struct kd_vantage *at, matrix g)
{
    long double a = at->spin, r = at->r, u = at->u, s = at->s, sigma = r * r + a * a * u * u;
    /* not r^2 - 2r + a^2: near the horizon little is left of that; sqrtl keeps what the code's double has */
    long double root = sqrtl((1 - a) * (1 + a)), delta = (r - 1 - root) * (r - 1 + root);
    vector time = { [T] = 1, [PHI] = -a * s * s }, turn = { [T] = -a, [PHI] = r * r + a * a };
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            g[i][j] = (s * s * turn[i] * turn[j] - delta * time[i] * time[j]) / sigma;
    g[R][R] += sigma / delta;
    g[THETA][THETA] += sigma;
}

/* x of g x = p. */
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

/* Components of Boyer-Lindquist coordinates with the index down. */
static void lower(const struct kd_vantage *at, const struct kd_covector *p, vector out)
{
    long double root = sqrtl((1 - (long double)at->spin) * (1 + (long double)at->spin));
    out[T] = -p->energy;
    out[R] = p->radial / ((at->r - 1 - root) * (at->r - 1 + root));
    out[THETA] = p->polar;
    out[PHI] = (long double)p->momentum * at->s;
}

static const double spins[] = { 0, 1e-9, 0.3, -0.7, 0.9, -0.998, 0.999999 }, angles[] = { 1e-6, 0.01, 0.4, 1.1, M_PI / 2, 2, 3.1 },
                    heights[] = { 1e-7, 1e-3, 0.02, 0.3, 1, 3, 20, 1e3, 1e6 };

/* Places just outside where the observer exists, and up to a million times as far. */
typedef void check(enum kd_observer observer, const struct kd_vantage *at, const struct kd_tetrad *frame);
static void everywhere(check *each)
{
    for (size_t n = 0; n < COUNT(spins) * COUNT(angles) * COUNT(heights) * KD_OBSERVER_COUNT; n++) {
        double a = spins[n % COUNT(spins)], theta = angles[n / COUNT(spins) % COUNT(angles)];
        double height = heights[n / COUNT(spins) / COUNT(angles) % COUNT(heights)];
        enum kd_observer observer = (enum kd_observer)(n / COUNT(spins) / COUNT(angles) / COUNT(heights));
        struct kd_vantage at = { .spin = a, .u = cos(theta), .s = sin(theta) };
        at.r = kd_observers[observer].outside(a, at.u) * (1 + height);
        assert_true(kd_observer_exists(observer, &at));
        const struct kd_tetrad frame = kd_observer_tetrad(observer, &at);
        each(observer, &at, &frame);
    }
}

/* Rounding of Delta or of g_tt, which vanish at the edge, is that of r, or of cos(theta) as far as it moves the edge, over the distance
 * to there. */
static double rounding(enum kd_observer observer, const struct kd_vantage *at)
{
    double edge = kd_observers[observer].outside(at->spin, at->u), inner = fabs(at->r - kd_kerr_horizon(at->spin));
    double moves = at->spin * at->spin / fabs(edge - 1);
    return 8 * 2.2e-16 * ((at->r + moves) / (at->r - edge) + at->r / inner + 1);
}

static void near(double is, double wanted, double bound, const char *what, enum kd_observer observer, const struct kd_vantage *at)
{
    if (!(fabs(is - wanted) <= bound))
        fail_msg("%s is %.17g, not %.17g within %.3g: %s, a = %g, r = %.17g, u = %g", what, is, wanted, bound, kd_observers[observer].word,
                 at->spin, at->r, at->u);
}

static void orthonormal_at(enum kd_observer observer, const struct kd_vantage *at, const struct kd_tetrad *frame)
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
            near((double)dot(down[i], up[j]), i != j ? 0 : i ? 1 : -1, rounding(observer, at), "product", observer, at);
    /* towards the future, and outwards, away from the north pole, along the rotation */
    for (int i = 0; i < 4; i++)
        assert_true(up[i][i] > 0);
    switch (observer) { /* what it is called after */
    case KD_OBSERVER_STATIC:
        for (int i = R; i <= PHI; i++)
            near((double)(up[T][i] / up[T][T] * sqrtl(g[i][i])), 0, rounding(observer, at), "velocity", observer, at);
        break;
    case KD_OBSERVER_ZAMO:
        near((double)down[T][PHI], 0, 0, "angular momentum", observer, at);
        near((double)up[T][R], 0, 0, "fall", observer, at);
        near((double)up[T][THETA], 0, 0, "way down", observer, at);
        break;
    case KD_OBSERVER_COUNT: fail_msg("an observer that says nothing of its velocity");
    }
}

static void orthonormal(void **state)
{
    (void)state;
    everywhere(orthonormal_at);
}

static const double directions[][3] = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, { 0, 0, -1 }, { 0.48, -0.6, 0.64 }, { -0.64, 0.48, -0.6 } };

/* The oracle makes its frames by Gram and Schmidt; it loses what is left of r^2 - 2r + a^2 and of 1 - cos(theta)^2. */
static void constants_at(enum kd_observer observer, const struct kd_vantage *at, const struct kd_tetrad *frame)
{
    double theta = atan2(at->s, at->u), bound = 40 * rounding(observer, at) * (1 + 1 / at->s);
    if (bound > 1e-4 || at->s < 1e-3)
        return;
    for (size_t i = 0; i < COUNT(directions); i++) {
        const double *m = directions[i];
        struct ks_photon want = ks_from_camera(at->spin, at->r, theta, observer == KD_OBSERVER_ZAMO, (double[]) { -m[0], -m[1], -m[2] });
        struct kd_covector is = kd_tetrad_covector(frame, (double[]) { 1, m[0], m[1], m[2] });
        double size = fabs(frame->phi.momentum) + fabs(frame->t.momentum);
        near(is.energy, want.energy, bound * (fabs(frame->t.energy) + fabs(frame->phi.energy)), "E", observer, at);
        near(is.momentum * at->s, want.momentum, bound * size * at->s, "L", observer, at);
        near(is.polar, want.p_theta, bound * at->r, "p_theta", observer, at);
    }
}

static void constants(void **state)
{
    (void)state;
    everywhere(constants_at);
}

/* Components are given back, and a photon is seen where it comes from; a frame that mixes everything is one too. */
static void back_and_forth_at(enum kd_observer observer, const struct kd_vantage *at, const struct kd_tetrad *frame)
{
    static const double v[] = { 0.3, -0.2, 0.5 };
    const double gamma = 1 / sqrt(1 - (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]));
    double legs[4][4] = { { gamma, gamma * v[0], gamma * v[1], gamma * v[2] } }; /* of one who moves by v, in this frame */
    for (int i = 1; i < 4; i++) {
        legs[i][0] = gamma * v[i - 1];
        for (int j = 1; j < 4; j++)
            legs[i][j] = (i == j) + gamma * gamma / (gamma + 1) * v[i - 1] * v[j - 1];
    }
    const struct kd_tetrad moving = {
        .at = *at,
        .t = kd_tetrad_covector(frame, legs[0]),
        .r = kd_tetrad_covector(frame, legs[1]),
        .theta = kd_tetrad_covector(frame, legs[2]),
        .phi = kd_tetrad_covector(frame, legs[3]),
    };
    /* The answer's conditioning: E and L of a frame next to an edge are all but proportional. */
    double bound = 300 * 2.2e-16 * (1 + frame->phi.momentum / (at->r * frame->t.energy)) * (1 + at->r / fabs(frame->phi.momentum));
    for (size_t i = 0; i < 2 * COUNT(directions); i++) {
        const double *m = directions[i / 2], x[] = { 1, m[0], m[1], m[2] };
        const struct kd_tetrad *f = i % 2 ? &moving : frame;
        struct kd_covector p = kd_tetrad_covector(f, x);
        double back[4];
        kd_tetrad_components(f, &p, back);
        for (int j = 0; j < 4; j++)
            near(back[j], x[j], bound, "component", observer, at);
        struct kd_look look = kd_tetrad_look(f, &p);
        near(look.inwards, m[0], bound, "inwards", observer, at);
        near(look.up, m[1], bound, "up", observer, at);
        near(look.right, -m[2], bound, "right", observer, at);
        near(look.energy, p.energy, bound, "energy", observer, at);
    }
    assert_true(kd_tetrad_is_level(frame) && !kd_tetrad_is_level(&moving));
}

static void back_and_forth(void **state)
{
    (void)state;
    everywhere(back_and_forth_at);
}

/* What goes on outwards is null: by the metric. */
static void outgoing_at(enum kd_observer observer, const struct kd_vantage *at, const struct kd_tetrad *frame)
{
    (void)frame;
    if (at->s < 1e-3)
        return;
    matrix g;
    vector down, up;
    struct kd_covector p = kd_tetrad_outgoing(at, 1.3, -0.7);
    metric(at, g);
    lower(at, &p, down);
    raise_index(g, down, up);
    double size = (double)(fabsl(down[T] * up[T]) + fabsl(down[R] * up[R]) + fabsl(down[PHI] * up[PHI]));
    near((double)dot(down, up), 0, 4 * rounding(observer, at) * size, "norm", observer, at);
    assert_true(p.energy == 1 && p.momentum == -1.3 && p.polar == -0.7 && p.radial > 0);
}

static void outgoing(void **state)
{
    (void)state;
    everywhere(outgoing_at);
    assert_true(kd_tetrad_outgoing(&(struct kd_vantage) { 0, 3, 0, 1 }, 9, 0).radial == 0);
}

static void words(void **state)
{
    (void)state;
    char text[KD_OBSERVER_TEXT];
    const struct kd_vantage far = { 0.9, 10, 0, 1 }, ergosphere = { 0.9, 1.9, 0, 1 }, hole = { 0.9, 1.2, 0, 1 };
    assert_string_equal(KD_OBSERVER_WORDS, "static|zamo");
    assert_string_equal(kd_observers[KD_OBSERVER_STATIC].word, "static");
    assert_string_equal(kd_observers[KD_OBSERVER_ZAMO].word, "zamo");
    assert_string_equal(kd_observer_others(&far, text), "\"static\" or \"zamo\"");
    assert_string_equal(kd_observer_others(&ergosphere, text), "\"zamo\"");
    assert_string_equal(kd_observer_others(&hole, text), "none");
    assert_true(!kd_observer_exists(KD_OBSERVER_STATIC, &ergosphere) && kd_observer_exists(KD_OBSERVER_ZAMO, &ergosphere));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(orthonormal), cmocka_unit_test(constants), cmocka_unit_test(back_and_forth),
        cmocka_unit_test(outgoing), cmocka_unit_test(words),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
