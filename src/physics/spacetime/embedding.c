#include "physics/spacetime/embedding.h"

#include "physics/spacetime/kerr.h"

#include <math.h>

/* r = 1 + s cosh(u), s = sqrt(1 - a^2), u = 0 at the horizon: Delta = s^2 sinh^2(u), and dr/sqrt(Delta) = du has no
 * end. */
static double spread(double a) { return sqrt((1 - a) * (1 + a)); }

static double rapidity(double a, double r)
{
    double x = (r - kd_kerr_horizon(a)) / spread(a);
    return x > 0 ? log1p(x + sqrt(x * (x + 2))) : 0;
}

double kd_embedding_radius(double a, double r) { return sqrt(r * r + a * a * (1 + 2 / r)); }

double kd_embedding_distance(double a, double r)
{
    double u = rapidity(a, r);
    return spread(a) * sinh(u) + u;
}

/* dz/du */
static double slope(double a, double r)
{
    double a2 = a * a, q = a2 / r;
    double n = 2 * r * r * r + 4 * a2 * (r - 1) + q * (2 * a2 - q) + q * q * (2 - q) / r;
    return sqrt(n) / kd_embedding_radius(a, r);
}

/* Gauss & Legendre in 16 points on pieces of u no longer than 1: the nearest zero of dz/du^2 lies at an imaginary
 * part of more than 1, where 16 points leave 1e-16. */
double kd_embedding_height(double a, double r)
{
    static const double node[8] = { 0.0950125098376374402, 0.281603550779258913, 0.458016777657227386,
                                    0.617876244402643748,  0.755404408355003034, 0.865631202387831744,
                                    0.944575023073232576,  0.989400934991649933 };
    static const double weight[8] = { 0.189450610455068496,  0.182603415044923589, 0.169156519395002538,
                                      0.149595988816576732,  0.124628971255533872, 0.0951585116824927848,
                                      0.0622535239386478929, 0.0271524594117540949 };
    double s = spread(a), end = rapidity(a, r), sum = 0;
    int pieces = (int)ceil(end);
    for (int i = 0; i < pieces; i++) {
        double half = end / (2 * pieces), middle = (2 * i + 1) * half;
        for (int k = 0; k < 8; k++)
            sum += half * weight[k] *
                   (slope(a, 1 + s * cosh(middle - half * node[k])) + slope(a, 1 + s * cosh(middle + half * node[k])));
    }
    return sum;
}
