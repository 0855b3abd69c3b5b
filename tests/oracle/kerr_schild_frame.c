#include "kerr_schild_frame.h"

#include <math.h>

enum { T, R, THETA, PHI };

/* The mass term 2r, or 2r - q^2 with charge. */
static double mass_of(const struct ks_place *at) { return 2 * at->r - at->q * at->q; }

/* The inverse metric: t and phi do not mix, and all components are finite where Delta vanishes. */
static void inverse(const struct ks_place *at, double g[4][4])
{
    double a = at->a, r = at->r, s = sin(at->theta), c = cos(at->theta), sigma = r * r + a * a * c * c,
           mass = mass_of(at);
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            g[i][j] = 0;
    g[T][T] = -(1 + mass / sigma);
    g[T][R] = g[R][T] = mass / sigma;
    g[R][R] = (r * r - mass + a * a) / sigma;
    g[R][PHI] = g[PHI][R] = a / sigma;
    g[THETA][THETA] = 1 / sigma;
    g[PHI][PHI] = 1 / (sigma * s * s);
}

double ks_product(const struct ks_place *at, const double p[4], const double q[4])
{
    double g[4][4], sum = 0;
    inverse(at, g);
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 4; j++)
            sum += g[i][j] * p[i] * q[j];
    return sum;
}

void ks_inwards(const struct ks_place *at, double mass, double energy, double momentum, double p_theta, double p[4])
{
    double g[4][4];
    inverse(at, g);
    double half = -g[T][R] * energy + g[R][PHI] * momentum, a = g[R][R];
    double rest = g[T][T] * energy * energy + g[PHI][PHI] * momentum * momentum + g[THETA][THETA] * p_theta * p_theta +
                  mass * mass;
    p[T] = -energy, p[THETA] = p_theta, p[PHI] = momentum;
    double root =
        sqrt(fmax(0, half * half - a * rest)); /* a p_r^2 + 2 half p_r + rest = 0, where p^r = a p_r + half = -root */
    p[R] = half < 0 ? rest / (root - half) : -(half + root) / a;
}

static void scale(double p[4], double by)
{
    for (int i = 0; i < 4; i++)
        p[i] *= by;
}

/* The covector of d/dphi, from the line element. */
static void turning(const struct ks_place *at, double p[4])
{
    double a = at->a, r = at->r, s2 = sin(at->theta) * sin(at->theta), sigma = r * r + a * a * (1 - s2),
           f = mass_of(at) / sigma;
    p[T] = -f * a * s2, p[R] = -a * s2 * (1 + f), p[THETA] = 0, p[PHI] = s2 * (r * r + a * a + f * a * a * s2);
}

/* Completes a frame from e_t and e_r. e_phi is along d/dphi, e_theta along dtheta; e_r is made orthogonal to e_t and
 * e_phi. */
static void complete(const struct ks_place *at, struct ks_frame *f)
{
    turning(at, f->e[PHI]);
    f->e[THETA][THETA] = 1;
    for (int k = 0; k < 4; k += 3) {
        double part = ks_product(at, f->e[R], f->e[k]) / ks_product(at, f->e[k], f->e[k]);
        for (int i = 0; i < 4; i++)
            f->e[R][i] -= part * f->e[k][i];
    }
    for (int k = 0; k < 4; k++)
        scale(f->e[k], 1 / sqrt(fabs(ks_product(at, f->e[k], f->e[k]))));
}

struct ks_frame ks_zamo(const struct ks_place *at)
{
    double mass = mass_of(at), delta = at->r * at->r - mass + at->a * at->a;
    struct ks_frame f = { .e = { { [T] = -1, [R] = mass / delta }, { [R] = 1 } } }; /* the case p^r = 0 */
    complete(at, &f);
    return f;
}

struct ks_frame ks_rain(const struct ks_place *at)
{
    struct ks_frame f = { .e = { { 0 }, { [R] = 1 } } };
    ks_inwards(at, 1, 1, 0, 0, f.e[T]);
    complete(at, &f);
    return f;
}

/* The map x -> x + (u + w).x (u + w)/(1 - u.w) - 2 (w.x) u takes the four-velocity w to u, and does not rotate the
 * directions perpendicular to both. */
struct ks_frame ks_boost(const struct ks_place *at, const struct ks_frame *from, const double u[4])
{
    struct ks_frame f = *from;
    const double *w = from->e[T];
    double sum[4], under = 1 - ks_product(at, u, w);
    for (int i = 0; i < 4; i++)
        sum[i] = u[i] + w[i];
    for (int k = 0; k < 4; k++) {
        double along = ks_product(at, sum, from->e[k]) / under, time = 2 * ks_product(at, w, from->e[k]);
        for (int i = 0; i < 4; i++)
            f.e[k][i] = from->e[k][i] + along * sum[i] - time * u[i];
    }
    return f;
}

void ks_seen(const struct ks_frame *f, const double k[3], double p[4])
{
    for (int i = 0; i < 4; i++)
        p[i] = f->e[T][i] - k[0] * f->e[R][i] - k[1] * f->e[THETA][i] - k[2] * f->e[PHI][i];
}

void ks_constants(const struct ks_place *at, const double p[4], double out[4])
{
    double mass = mass_of(at), delta = at->r * at->r - mass + at->a * at->a;
    out[0] = -p[T], out[1] = p[PHI], out[2] = p[THETA];
    out[3] = delta * p[R] + mass * p[T] + at->a * p[PHI];
}
