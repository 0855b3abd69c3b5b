#include "physics/math/quadrature.h"

#include <math.h>

/* x = 1/(1 + exp(-pi sinh t)), so that dx/dt = pi cosh(t) x y. At |t| = 4.5 the product x y is 1e-61. Values beyond
 * contribute less than 1e-30, even if the integrand has an inverse square root at the end. */
static const double reach = 4.5;

static double term(kd_integrand f, const void *context, double t)
{
    double e = exp(M_PI * sinh(t));
    double x = e / (1 + e), y = 1 / (1 + e);
    return M_PI * cosh(t) * x * y * f(x, y, context);
}

double kd_quadrature(kd_integrand f, const void *context)
{
    double step = 0.5, sum = term(f, context, 0);
    for (double t = step; t <= reach; t += step)
        sum += term(f, context, t) + term(f, context, -t);
    for (int level = 0; level < 8; level++) {
        double more = 0;
        for (double t = step / 2; t <= reach; t += step)
            more += term(f, context, t) + term(f, context, -t);
        /* the difference of two rules; their mean is the rule with half the step */
        double change = more - sum;
        sum += more;
        step /= 2;
        if (fabs(change) <= 1e-14 * fabs(sum))
            return sum * step;
    }
    return NAN;
}

void kd_gauss_legendre(int n, double *nodes, double *weights)
{
    for (int i = 0; i < n; i++) {
        double x = cos(M_PI * (n - 1 - i + 0.75) / (n + 0.5)), slope = 1;
        /* Newton's method for a root of the polynomial, which its recurrence evaluates */
        for (int k = 0; k < 60; k++) {
            double p = x, before = 1;
            for (int j = 2; j <= n; j++) {
                const double next = ((2 * j - 1) * x * p - (j - 1) * before) / j;
                before = p;
                p = next;
            }
            slope = n * (x * p - before) / (x * x - 1);
            const double step = p / slope;
            x -= step;
            if (fabs(step) < 1e-16)
                break;
        }
        nodes[i] = 0.5 * (1 + x);
        weights[i] = 1 / ((1 - x * x) * slope * slope);
    }
}
