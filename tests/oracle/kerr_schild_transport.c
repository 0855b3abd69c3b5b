#include "kerr_schild_transport.h"

#include <math.h>
#include <string.h>

enum { VECTORS = 3 }; /* derivatives of k, right and up */
struct state { double x[4], v[VECTORS][4]; };

struct hole { double a, q; };

static double radius(double a, const double *x)
{
    double rho2 = x[1] * x[1] + x[2] * x[2] + x[3] * x[3] - a * a;
    return sqrt(0.5 * (rho2 + hypot(rho2, 2 * a * x[3])));
}

static void metric(struct hole o, const double *x, double g[4][4])
{
    const double a = o.a, r = radius(a, x), q = r * r + a * a,
                 f = r * r * (2 * r - o.q * o.q) / (r * r * r * r + a * a * x[3] * x[3]);
    double l[4] = { 1, (r * x[1] + a * x[2]) / q, (r * x[2] - a * x[1]) / q, x[3] / r };
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            g[i][j] = (i == j ? (i ? 1 : -1) : 0) + f * l[i] * l[j];
}

static double product(double g[4][4], const double *p, const double *q)
{
    double sum = 0;
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            sum += g[i][j] * p[i] * q[j];
    return sum;
}

/* Gauss-Jordan elimination: g w = v. */
static void solve(double g[4][4], const double *v, double *w)
{
    double m[4][5];
    for (int i = 0; i < 4; i++) {
        memcpy(m[i], g[i], sizeof g[i]);
        m[i][4] = v[i];
    }
    for (int i = 0; i < 4; i++) {
        int pivot = i;
        for (int k = i + 1; k < 4; k++)
            if (fabs(m[k][i]) > fabs(m[pivot][i]))
                pivot = k;
        for (int j = 0; j < 5; j++) {
            double t = m[i][j];
            m[i][j] = m[pivot][j];
            m[pivot][j] = t;
        }
        for (int k = 0; k < 4; k++)
            for (int j = 4; k != i && j >= i; j--)
                m[k][j] -= m[k][i] / m[i][i] * m[i][j];
    }
    for (int i = 0; i < 4; i++)
        w[i] = m[i][4] / m[i][i];
}

/* Derivatives along the ray traced back in time: dx = -k, dv^m = +Gamma^m_ab k^a v^b. */
static void derivative(struct hole o, const struct state *s, struct state *d)
{
    double g[4][4], dg[4][4][4] = { { { 0 } } }, h = 1e-4 * radius(o.a, s->x);
    metric(o, s->x, g);
    for (int c = 1; c < 4; c++) {
        double x[4], at[4][4][4];
        for (int i = 0; i < 4; i++) {
            memcpy(x, s->x, sizeof x);
            x[c] += (double[]) { -2, -1, 1, 2 }[i] * h;
            metric(o, x, at[i]);
        }
        for (int i = 0; i < 4; i++)
            for (int j = 0; j < 4; j++)
                dg[c][i][j] = (at[0][i][j] - 8 * at[1][i][j] + 8 * at[2][i][j] - at[3][i][j]) / (12 * h);
    }
    const double *k = s->v[0];
    for (int n = 0; n < VECTORS; n++) {
        const double *v = s->v[n];
        double low[4] = { 0 };
        for (int m = 0; m < 4; m++)
            for (int i = 0; i < 4; i++)
                for (int j = 0; j < 4; j++)
                    low[m] += 0.5 * (dg[i][m][j] + dg[j][i][m] - dg[m][i][j]) * k[i] * v[j];
        solve(g, low, d->v[n]);
    }
    for (int i = 0; i < 4; i++)
        d->x[i] = -k[i];
}

static void add(struct state *s, const struct state *d, double h)
{
    for (int i = 0; i < 4; i++) {
        s->x[i] += h * d->x[i];
        for (int n = 0; n < VECTORS; n++)
            s->v[n][i] += h * d->v[n][i];
    }
}

static void step(struct hole o, struct state *s, double h)
{
    struct state d[4], at;
    derivative(o, s, &d[0]);
    for (int i = 1; i < 4; i++) {
        at = *s;
        add(&at, &d[i - 1], i == 3 ? h : 0.5 * h);
        derivative(o, &at, &d[i]);
    }
    for (int i = 0; i < 4; i++)
        add(s, &d[i], h * (i == 0 || i == 3 ? 1. / 6 : 1. / 3));
}

/* The light-like vector with the spatial components n: g kk = 0, with k^t > 0. */
static void light_like(struct hole o, const double *x, const double n[3], double k[4])
{
    double g[4][4], half = 0, rest = 0;
    metric(o, x, g);
    for (int i = 0; i < 3; i++) {
        k[i + 1] = n[i];
        half += g[0][i + 1] * n[i];
        for (int j = 0; j < 3; j++)
            rest += g[i + 1][j + 1] * n[i] * n[j];
    }
    k[0] = -(half + sqrt(half * half - g[0][0] * rest)) / g[0][0];
}

struct ks_screen ks_screen_far(double a, double q, double theta, double alpha, double beta)
{
    const double far = 1e6, s = sin(theta), c = cos(theta), n[3] = { s, 0, c };
    struct ks_screen o = { .a = a,
                           .q = q,
                           .x = { 0, far * s - beta * c, alpha, far * c + beta * s },
                           .right = { 0, 0, 1, 0 },
                           .up = { 0, -c, 0, s } };
    light_like((struct hole) { a, q }, o.x, n, o.k);
    return o;
}

/* Converts a covector of (t, r, theta, phi) to a vector of (t, x, y, z), at azimuth 0: x + i y = (r + i a)
 * sin(theta). */
static void to_cartesian(const struct ks_place *at, const double *x, const double p[4], double out[4])
{
    const double s = sin(at->theta), c = cos(at->theta), a = at->a, r = at->r;
    double dx[4][4] = {
        { 1, 0, 0, 0 }, { 0, s, 0, c }, { 0, r * c, a * c, -r * s }, { 0, -a * s, r * s, 0 }
    }; /* d(x)/d(spherical) */
    double low[4], g[4][4];
    solve(dx, p, low);
    metric((struct hole) { a, 0 }, x, g);
    solve(g, low, out);
}

struct ks_screen ks_screen_near(const struct ks_place *at, const struct ks_frame *f, const double look[3],
                                const double up[3])
{
    const double s = sin(at->theta);
    struct ks_screen o = { .a = at->a, .x = { 0, at->r * s, at->a * s, at->r * cos(at->theta) } };
    double along = 0, size = 0, across[3], side[3], p[4];
    for (int i = 0; i < 3; i++)
        along += look[i] * up[i];
    for (int i = 0; i < 3; i++) {
        across[i] = up[i] - along * look[i];
        size += across[i] * across[i];
    }
    for (int i = 0; i < 3; i++)
        across[i] /= sqrt(size);
    for (int i = 0; i < 3; i++) /* `up` is x, rotated */
        side[i] = look[(i + 1) % 3] * across[(i + 2) % 3] - look[(i + 2) % 3] * across[(i + 1) % 3];
    ks_seen(f, look, p);
    to_cartesian(at, o.x, p, o.k);
    for (int n = 0; n < 2; n++) {
        const double *of = n ? across : side;
        for (int i = 0; i < 4; i++)
            p[i] = of[0] * f->e[1][i] + of[1] * f->e[2][i] + of[2] * f->e[3][i];
        to_cartesian(at, o.x, p, n ? o.up : o.right);
    }
    return o;
}

/* Removes from v its components along the preceding vectors, which are orthogonal. */
static void across(double g[4][4], double v[4], double (*before)[4], int n)
{
    for (int k = 0; k < n; k++) {
        double part = product(g, v, before[k]) / product(g, before[k], before[k]);
        for (int i = 0; i < 4; i++)
            v[i] -= part * before[k][i];
    }
}

/* Squared length of d/dt + omega d/dphi on the circle of this radius in the plane. */
static double line(struct hole o, double r, double omega)
{
    double g[4][4], x[4] = { 0, sqrt(r * r + o.a * o.a), 0, 0 }, v[4] = { 1, 0, omega * x[1], 0 };
    metric(o, x, g);
    return product(g, v, v);
}

/* Angular velocity of the circular geodesic, where its radial derivative vanishes. */
static double omega_of(struct hole o, double r)
{
    double low = 0, high = 1 / r, h = 1e-3 * r;
    for (int i = 0; i < 60; i++) {
        double w = 0.5 * (low + high),
               pull = 8 * (line(o, r + h, w) - line(o, r - h, w)) - line(o, r + 2 * h, w) + line(o, r - 2 * h, w);
        *(pull < 0 ? &low : &high) = w;
    }
    return 0.5 * (low + high);
}

/* Velocity of the gas at x. It moves on a circle, or falls within the ISCO with the ISCO's E and L. */
static void gas(struct hole o, const double *x, double r_isco, double u[4])
{
    const double a = o.a;
    double r = radius(a, x), turn[4] = { 0, -x[2], x[1], 0 }, g[4][4], t[4] = { 1, 0, 0, 0 };
    const bool falls = r < r_isco;
    const double at = falls ? r_isco : r, omega = omega_of(o, at), norm = 1 / sqrt(-line(o, at, omega));
    metric(o, x, g);
    if (!falls) {
        for (int i = 0; i < 4; i++)
            u[i] = norm * (t[i] + omega * turn[i]);
        return;
    }
    double there[4][4], y[4] = { 0, sqrt(at * at + a * a), 0, 0 }, v[4] = { norm, 0, norm * omega * y[1], 0 },
                        round[4] = { 0, 0, y[1], 0 };
    metric(o, y, there);
    const double want[2] = { product(there, v, t), product(there, v, round) };
    /* u = c t + d turn + e out. The products of u with t and turn give c and d, and the length of u gives e. */
    double out[4] = { 0, x[1], x[2], 0 }, basis[2][4], c[2] = { 0 };
    memcpy(basis[0], t, sizeof t);
    memcpy(basis[1], turn, sizeof turn);
    const double m00 = product(g, t, t), m01 = product(g, t, turn), m11 = product(g, turn, turn),
                 det = m00 * m11 - m01 * m01;
    for (int i = 0; i < 2; i++)
        c[i] = i ? (m00 * want[1] - m01 * want[0]) / det : (m11 * want[0] - m01 * want[1]) / det;
    double o0 = product(g, out, t), o1 = product(g, out, turn), d0 = (m11 * o0 - m01 * o1) / det,
           d1 = (m00 * o1 - m01 * o0) / det;
    for (int i = 0; i < 4; i++)
        out[i] -= d0 * t[i] + d1 * turn[i];
    for (int i = 0; i < 4; i++)
        u[i] = c[0] * t[i] + c[1] * turn[i];
    double e = sqrt(fmax(0, (-1 - product(g, u, u)) / product(g, out, out)));
    for (int i = 0; i < 4; i++)
        u[i] -= e * out[i];
}

static void judge(const struct state *s, struct hole hole, enum ks_field field, double r_isco, struct ks_polarized *o)
{
    double g[4][4], before[3][4], f[4] = { 0 }, b[4] = { 0 };
    const double *k = s->v[0];
    metric(hole, s->x, g);
    o->r = radius(hole.a, s->x);
    o->falls = o->r < r_isco;
    gas(hole, s->x, r_isco, before[0]);
    const double seen = -product(g, k, before[0]);
    for (int i = 0; i < 4; i++)
        before[1][i] = k[i] / seen - before[0][i];
    const double t[4] = { 1, 0, 0, 0 }, turn[4] = { 0, -s->x[2], s->x[1], 0 }, normal[4] = { 0, 0, 0, 1 };
    if (field == KS_VERTICAL)
        memcpy(b, normal, sizeof b);
    else if (field == KS_TOROIDAL)
        memcpy(b, turn, sizeof b);
    else { /* outwards, orthogonal to both Killing vectors */
        double both[2][4], out[4] = { 0, s->x[1], s->x[2], 0 };
        memcpy(both[0], t, sizeof t);
        memcpy(both[1], turn, sizeof turn);
        across(g, both[1], both, 1);
        across(g, out, both, 2);
        memcpy(b, out, sizeof b);
    }
    memcpy(before[2], b, sizeof b);
    across(g, before[2], before, 2);
    /* The direction outside the span of the other two vectors: the coordinate vector with the longest component outside
     * the span is used. */
    double most = 0;
    for (int n = 0; n < 4; n++) {
        double v[4] = { 0 };
        v[n] = 1;
        across(g, v, before, 3);
        double size = product(g, v, v);
        if (size > most) {
            most = size;
            memcpy(f, v, sizeof f);
        }
    }
    double x = product(g, f, s->v[1]), y = product(g, f, s->v[2]);
    o->angle = atan2(-x, y);
    o->angle -= M_PI * ceil((o->angle - 0.5 * M_PI) / M_PI);
    o->cosine = fabs(product(g, k, normal) / sqrt(product(g, normal, normal))) / seen;
    o->g = seen;
}

struct ks_polarized ks_polarization(const struct ks_screen *screen, int order, enum ks_field field, double r_isco)
{
    struct ks_polarized o = { 0 };
    struct state s, last;
    const struct hole hole = { screen->a, screen->q };
    double a = hole.a, horizon = 1 + sqrt(1 - a * a - hole.q * hole.q), start = radius(a, screen->x);
    memcpy(s.x, screen->x, sizeof s.x);
    memcpy(s.v[0], screen->k, sizeof s.v[0]);
    memcpy(s.v[1], screen->right, sizeof s.v[1]);
    memcpy(s.v[2], screen->up, sizeof s.v[2]);
    for (int n = 0, crossed = 0; n < 20000; n++) {
        double r = radius(a, s.x), speed = sqrt(s.v[0][1] * s.v[0][1] + s.v[0][2] * s.v[0][2] + s.v[0][3] * s.v[0][3]);
        double h = 0.01 * fmin(r, 8 * (r - horizon)) / speed;
        if (r < horizon * 1.0001 || r > 1.2 * start + 100)
            return o;
        last = s;
        step(hole, &s, h);
        if ((last.x[3] > 0) == (s.x[3] > 0) || n == 0)
            continue;
        if (crossed++ < order)
            continue;
        for (int i = 0; i < 50; i++) { /* repeats steps until the ray is on the plane */
            double part = last.x[3] / last.v[0][3];
            if (fabs(last.x[3]) < 1e-13)
                break;
            step(hole, &last, part);
        }
        o.there = true;
        judge(&last, hole, field, r_isco, &o);
        return o;
    }
    return o;
}

double ks_carried_product(const struct ks_carried *at, const double p[4], const double q[4])
{
    double sum = 0;
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            sum += at->g[i][j] * p[i] * q[j];
    return sum;
}

/* In ingoing coordinates dt + (2 r - q^2)/Delta dr and dphi + a/Delta dr; x + i y = (r + i a) sin(theta) exp(i phi). */
void ks_carried_vector(const struct ks_carried *at, const double v[4], double out[4])
{
    const double a = at->a, r = at->r, m = 2 * r - at->q * at->q, delta = r * r - m + a * a, c = at->x[3] / r,
                 s = sqrt(1 - c * c), turn = v[3] + a / delta * v[1];
    const double azimuth = atan2(at->x[2], at->x[1]) - atan2(a, r), ca = cos(azimuth), sa = sin(azimuth);
    const double x = s * v[1] + r * c * v[2] - a * s * turn, y = a * c * v[2] + r * s * turn;
    out[0] = v[0] + m / delta * v[1];
    out[1] = ca * x - sa * y;
    out[2] = sa * x + ca * y;
    out[3] = c * v[1] - r * s * v[2];
}

static void tell(const struct state *s, struct hole o, double h, ks_told *told, void *user)
{
    struct ks_carried at = { .a = o.a, .q = o.q, .r = radius(o.a, s->x), .step = h };
    memcpy(at.x, s->x, sizeof at.x);
    memcpy(at.k, s->v[0], sizeof at.k);
    memcpy(at.right, s->v[1], sizeof at.right);
    memcpy(at.up, s->v[2], sizeof at.up);
    metric(o, s->x, at.g);
    told(user, &at);
}

/* The fraction of a pair of steps after which the ray reaches this radius, if the radius lies within the pair. */
static double landing(const struct state *s, struct hole o, double h, double r)
{
    const bool inwards = radius(o.a, s->x) > r;
    double low = 0, high = 1;
    for (int i = 0; i < 50; i++) {
        const double t = 0.5 * (low + high);
        struct state at = *s;
        step(o, &at, t * h);
        step(o, &at, t * h);
        *((radius(o.a, at.x) > r) == inwards ? &low : &high) = t;
    }
    return high;
}

void ks_carry(const struct ks_screen *screen, double inner, double outer, double fine, ks_told *told, void *user)
{
    const struct hole o = { screen->a, screen->q };
    const double a = o.a, horizon = 1 + sqrt(1 - a * a - o.q * o.q);
    struct state s;
    memcpy(s.x, screen->x, sizeof s.x);
    memcpy(s.v[0], screen->k, sizeof s.v[0]);
    memcpy(s.v[1], screen->right, sizeof s.v[1]);
    memcpy(s.v[2], screen->up, sizeof s.v[2]);
    bool within = false;
    for (int n = 0; n < 200000; n++) {
        const double r = radius(a, s.x),
                     speed = sqrt(s.v[0][1] * s.v[0][1] + s.v[0][2] * s.v[0][2] + s.v[0][3] * s.v[0][3]);
        double h = (within ? fine : 0.01) * fmin(r, 8 * (r - horizon)) / speed;
        struct state next = s;
        step(o, &next, h);
        step(o, &next, h);
        const double then = radius(a, next.x);
        bool enters = !within && then < outer, leaves = within && (then > outer || then < inner);
        if (!within && then > 1.2 * r)
            return;
        if (enters || leaves) {
            h *= landing(&s, o, h, then < inner ? inner : outer);
            next = s;
            step(o, &next, h);
            step(o, &next, h);
        }
        if (within) {
            struct state half = s;
            tell(&s, o, h, told, user);
            step(o, &half, h);
            tell(&half, o, h, told, user);
        }
        s = next;
        if (leaves) {
            tell(&s, o, 0, told, user);
            return;
        }
        within |= enters;
    }
}
