#include "physics/disk/scattering.h"

#include "physics/math/quadrature.h"

#include <math.h>

#define PI 3.14159265358979323846

/* Nodes of Gauss-Legendre quadrature. In the variable s, mu = s^2, the infinite slope of H at mu = 0 is harmless:
 * errors are some 1e-9. */
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

/* H(mu) for the characteristic function psi = scale (1 - mu^2): 1/H = sqrt(1 - 2 psi0) + the integral of psi(m) m
 * H(m)/(mu + m), psi0 being the integral of psi (section 38, equation 12), from its values at the nodes. */
static double h_at(const struct rule *rule, const double *h, double scale, double root, double mu)
{
    double sum = root;
    for (int i = 0; i < NODES; i++) {
        const double m = rule->mu[i];
        sum += rule->weight[i] * scale * (1 - m * m) * m * h[i] / (mu + m);
    }
    return 1 / sum;
}

/* With conservative scattering, 2 psi0 = 1, plain iteration oscillates about the solution. The mean of two successive
 * rounds does not. */
static void solve(const struct rule *rule, double scale, double root, double h[NODES])
{
    for (int i = 0; i < NODES; i++)
        h[i] = 1 + rule->mu[i];
    for (int round = 0; round < ROUNDS; round++) {
        double next[NODES], most = 0;
        for (int i = 0; i < NODES; i++)
            next[i] = h_at(rule, h, scale, root, rule->mu[i]);
        for (int i = 0; i < NODES; i++) {
            most = fmax(most, fabs(next[i] / h[i] - 1));
            h[i] = 0.5 * (h[i] + next[i]);
        }
        if (most < 1e-14)
            break;
    }
}

/* I_l = 3/8 F q/sqrt(2) H_l and I_r = 3/8 F 1/sqrt(2) H_r (mu + c), H_l and H_r belonging to 3/4 (1 - mu^2) and 3/8
 * (1 - mu^2) (section 68, equation 139; F is pi times the flux). At mu = 1 both are equal, q H_l(1) = (1 + c)
 * H_r(1), and q^2 = 2 (1 - c^2): so c = (2 k - 1)/(2 k + 1), k = (H_l(1)/H_r(1))^2. */
void kd_scattered_light(const double *mu, size_t n, struct kd_scattered *out)
{
    const struct rule rule = gauss();
    const double scale_l = 0.75, scale_r = 0.375, root_l = 0, root_r = sqrt(0.5);
    double l[NODES], r[NODES];
    solve(&rule, scale_l, root_l, l);
    solve(&rule, scale_r, root_r, r);
    const double ratio = h_at(&rule, l, scale_l, root_l, 1) / h_at(&rule, r, scale_r, root_r, 1), k = 2 * ratio * ratio;
    const double c = (k - 1) / (k + 1), q = sqrt(2 * (1 - c) * (1 + c));
    for (size_t i = 0; i < n; i++)
        out[i] = (struct kd_scattered) {
            .across = 0.375 * sqrt(0.5) * h_at(&rule, r, scale_r, root_r, mu[i]) * (mu[i] + c),
            .along = 0.375 * sqrt(0.5) * q * h_at(&rule, l, scale_l, root_l, mu[i]),
        };
}
