#include "physics/disk/scattering.h"

#include "physics/math/quadrature.h"

#include <math.h>

#define PI 3.14159265358979323846

/* Number of nodes of Gauss-Legendre quadrature. In the variable s, with mu = s^2, the infinite slope of H at mu = 0 is
 * harmless, and errors are some 1e-9. */
enum { NODES = 48, ROUNDS = 400 };
struct rule { double mu[NODES], weight[NODES]; };

static struct rule gauss(void)
{
    struct rule rule;
    double s[NODES];
    kd_gauss_legendre(NODES, s, rule.weight);
    for (int i = 0; i < NODES; i++) {
        rule.mu[i] = s[i] * s[i];
        rule.weight[i] *= 2 * s[i];
    }
    return rule;
}

/* Parameters of H(mu) for the characteristic function psi = scale (1 + two mu^2 + four mu^4). 1/H = root + the integral
 * of psi(m) m H(m)/(mu + m), with root = sqrt(1 - 2 psi0), where psi0 is the integral of psi (section 38, equation 12).
 */
struct law { double scale, two, four, root; };

static double h_at(const struct rule *rule, const double *h, const struct law *law, double mu)
{
    double sum = law->root;
    for (int i = 0; i < NODES; i++) {
        const double m = rule->mu[i];
        sum += rule->weight[i] * law->scale * (1 + m * m * (law->two + law->four * m * m)) * m * h[i] / (mu + m);
    }
    return 1 / sum;
}

/* Solves for H at the nodes by iteration. With conservative scattering (2 psi0 = 1) plain iteration oscillates about
 * the solution. The mean of two successive iterates converges. */
static void solve(const struct rule *rule, const struct law *law, double h[NODES])
{
    for (int i = 0; i < NODES; i++)
        h[i] = 1 + rule->mu[i];
    for (int round = 0; round < ROUNDS; round++) {
        double next[NODES], most = 0;
        for (int i = 0; i < NODES; i++)
            next[i] = h_at(rule, h, law, rule->mu[i]);
        for (int i = 0; i < NODES; i++) {
            most = fmax(most, fabs(next[i] / h[i] - 1));
            h[i] = 0.5 * (h[i] + next[i]);
        }
        if (most < 1e-14)
            break;
    }
}

/* H_l belongs to psi = 3/4 (1 - mu^2), and H_r to psi = 3/8 (1 - mu^2). From q H_l(1) = (1 + c) H_r(1) and q^2 = 2 (1 -
 * c^2) follows c = (2 k - 1)/(2 k + 1), with k = (H_l(1)/H_r(1))^2. */
struct laws {
    struct rule rule;
    double l[NODES], r[NODES], c, q;
};
static const struct law law_l = { 0.75, -1, 0, 0 }, law_r = { 0.375, -1, 0, 0.70710678118654752 };

static struct laws laws_of(void)
{
    struct laws laws = { .rule = gauss() };
    solve(&laws.rule, &law_l, laws.l);
    solve(&laws.rule, &law_r, laws.r);
    const double ratio = h_at(&laws.rule, laws.l, &law_l, 1) / h_at(&laws.rule, laws.r, &law_r, 1),
                 k = 2 * ratio * ratio;
    laws.c = (k - 1) / (k + 1);
    laws.q = sqrt(2 * (1 - laws.c) * (1 + laws.c));
    return laws;
}

/* I_l = 3/8 F q/sqrt(2) H_l and I_r = 3/8 F 1/sqrt(2) H_r (mu + c) (section 68, equation 139; F is pi times the
 * flux). */
void kd_scattered_light(const double *mu, size_t n, struct kd_scattered *out)
{
    const struct laws laws = laws_of();
    for (size_t i = 0; i < n; i++)
        out[i] = (struct kd_scattered) {
            .across = 0.375 * sqrt(0.5) * h_at(&laws.rule, laws.r, &law_r, mu[i]) * (mu[i] + laws.c),
            .along = 0.375 * sqrt(0.5) * laws.q * h_at(&laws.rule, laws.l, &law_l, mu[i]),
        };
}

/* psi = q mu H_l, phi = H_l (1 - c mu), chi = H_r (1 + c mu), zeta = q mu H_r/2; The H functions for the first and for
 * the second multiple of the azimuth have the characteristic functions 3/8 (1 - mu^2)(1 + 2 mu^2) and 3/16 (1 +
 * mu^2)^2. */
void kd_scattering_functions(const double *mu, size_t n, struct kd_scattering_functions *out)
{
    static const struct law first = { 0.375, 1, -2, 0.54772255750516612 },
                            second = { 0.1875, 2, 1, 0.54772255750516612 };
    const struct laws laws = laws_of();
    double one[NODES], two[NODES];
    solve(&laws.rule, &first, one);
    solve(&laws.rule, &second, two);
    for (size_t i = 0; i < n; i++) {
        const double l = h_at(&laws.rule, laws.l, &law_l, mu[i]), r = h_at(&laws.rule, laws.r, &law_r, mu[i]);
        out[i] = (struct kd_scattering_functions) { laws.q * mu[i] * l,
                                                    l * (1 - laws.c * mu[i]),
                                                    r * (1 + laws.c * mu[i]),
                                                    laws.q * mu[i] * r / 2,
                                                    h_at(&laws.rule, one, &first, mu[i]),
                                                    h_at(&laws.rule, two, &second, mu[i]) };
    }
}

/* Rayleigh's phase matrix (section 17) for light that arrives at the cosine -mu0 and leaves at mu, with the functions
 * of section 70. */
void kd_scattering_reflect(const struct kd_scattering_functions *f, double mu, const struct kd_scattering_functions *g,
                           double mu0, const double light[3], struct kd_reflected_stokes *out)
{
    const double il = light[0], ir = light[1], u = light[2], m = -mu0, part = 3 / (16 * PI) * mu0 / (mu + mu0),
                 one = part * sqrt((1 - mu) * (1 + mu) * (1 - m) * (1 + m)) * f->first * g->first,
                 two = part * f->second * g->second;
    *out = (struct kd_reflected_stokes) {
        .l = { part * ((f->psi * g->psi + 2 * f->phi * g->phi) * il + (f->psi * g->chi + 2 * f->phi * g->zeta) * ir),
               one * 4 * mu * m * il, one * 2 * mu * u, two * mu * mu * (m * m * il - ir), two * mu * mu * m * u },
        .r = { part * ((f->chi * g->psi + 2 * f->zeta * g->phi) * il + (f->chi * g->chi + 2 * f->zeta * g->zeta) * ir),
               0, 0, two * (ir - m * m * il), -two * m * u },
        .u = { 0, one * 2 * u, -one * 4 * m * il, two * 2 * mu * m * u, two * 2 * mu * (ir - m * m * il) },
    };
}
