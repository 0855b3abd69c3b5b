#include "physics/spacetime/embedding.h"

#include "physics/spacetime/kerr.h"

#include <math.h>

/* The variable u in r = 1 + s cosh(u), with s = sqrt(1 - a^2). u is 0 at the horizon, Delta = s^2 sinh^2(u), and
 * dr/sqrt(Delta) = du is regular. */
static double rapidity(const struct kd_hole *hole, double r)
{
    double x = (r - hole->outer) / hole->root;
    return x > 0 ? log1p(x + sqrt(x * (x + 2))) : 0;
}

double kd_embedding_radius(const struct kd_hole *hole, double r)
{
    return sqrt(r * r + hole->a * hole->a * (1 + kd_hole_mass_w(hole, 1 / r) / r));
}

double kd_embedding_distance(const struct kd_hole *hole, double r)
{
    double u = rapidity(hole, r);
    return hole->root * sinh(u) + u;
}

/* dz/du */
static double slope(const struct kd_hole *hole, double r)
{
    double a2 = hole->a * hole->a, t = a2 / r * kd_hole_pull_w(hole, 1 / r) / r;
    double n = kd_hole_mass(hole, r) * (r * r + a2) + t * kd_hole_delta(hole, r) * (2 * r - t);
    return sqrt(n) / kd_embedding_radius(hole, r);
}

/* Gauss-Legendre quadrature with 16 points on pieces of u no longer than 1. The zero of (dz/du)^2 that is nearest to
 * the real axis has an imaginary part of more than 1. For such an integrand 16 points leave an error of 1e-16. */
double kd_embedding_height(const struct kd_hole *hole, double r)
{
    static const double node[8] = { 0.0950125098376374402, 0.281603550779258913, 0.458016777657227386,
                                    0.617876244402643748,  0.755404408355003034, 0.865631202387831744,
                                    0.944575023073232576,  0.989400934991649933 };
    static const double weight[8] = { 0.189450610455068496,  0.182603415044923589, 0.169156519395002538,
                                      0.149595988816576732,  0.124628971255533872, 0.0951585116824927848,
                                      0.0622535239386478929, 0.0271524594117540949 };
    double s = hole->root, end = rapidity(hole, r), sum = 0;
    int pieces = (int)ceil(end);
    for (int i = 0; i < pieces; i++) {
        double half = end / (2 * pieces), middle = (2 * i + 1) * half;
        for (int k = 0; k < 8; k++)
            sum += half * weight[k] *
                   (slope(hole, 1 + s * cosh(middle - half * node[k])) +
                    slope(hole, 1 + s * cosh(middle + half * node[k])));
    }
    return sum;
}
