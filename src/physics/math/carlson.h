/* Carlson's symmetric elliptic integrals by duplication. Double precision, pure functions, any thread, no units.
 *
 *   R_F(x,y,z)   = 1/2 Int_0^inf dt / sqrt((t+x)(t+y)(t+z))
 *   R_C(x,y)     = R_F(x,y,y)
 *   R_J(x,y,z,p) = 3/2 Int_0^inf dt / ((t+p) sqrt((t+x)(t+y)(t+z)))
 *   R_D(x,y,z)   = R_J(x,y,z,z)
 *
 * Sources: B. C. Carlson 1995, Numer. Algorithms 10, 13 (duplication, R_J's sum of R_C); DLMF 19.36(i) (the final
 * series, to the seventh degree: the spread of arguments at which it starts leaves an error below 1e-17); DLMF
 * 19.20.14 (negative p). Relative error a few 1e-16, measured below 2e-15 over 1e-10 ... 1e10. Outside a function's
 * domain the result is NaN; where the integral diverges, INFINITY. */
#ifndef KD_PHYSICS_MATH_CARLSON_H
#define KD_PHYSICS_MATH_CARLSON_H

#include <complex.h>

/* x, y, z >= 0, at most one of them 0. */
double kd_carlson_rf(double x, double y, double z);

/* x >= 0, y != 0; for y < 0 Cauchy's principal value. R_C is an elementary function (DLMF 19.2.17-20). */
double kd_carlson_rc(double x, double y);

/* x, y, z >= 0, at most one of them 0, p != 0; for p < 0 Cauchy's principal value. */
double kd_carlson_rj(double x, double y, double z, double p);

/* x, y >= 0, at most one of them 0; z > 0. */
double kd_carlson_rd(double x, double y, double z);

/* R_F, R_J and R_D in real arithmetic, where y and z are either real and >= 0 or complex conjugates. Only the sums that
 * are real in both cases are stored,
 *
 *   first = sqrt(x),   sum = sqrt(y) + sqrt(z),   root = sqrt(y z),
 *
 * with square roots of positive real part. One step of duplication is, with g = x + first sum + root = x + lambda,
 *
 *   first' = sqrt(g)/2,   root' = sum sqrt(g)/4,   sum' = sqrt(sum (sum + 2 first + 2 sqrt(g)))/2,
 *
 * from y + lambda = (sqrt(y) + sqrt(x))(sqrt(y) + sqrt(z)). Nothing is subtracted, so that nearly equal, or nearly
 * vanishing, y and z lose no digits. Domain: first >= 0, sum > 0, root >= 0, at most one of x, y, z zero. */
struct kd_carlson_arg { double first, sum, root; };

double kd_carlson_rf_arg(struct kd_carlson_arg arg);
double kd_carlson_rj_arg(struct kd_carlson_arg arg, double p); /* p > 0 */
/* R_D(y, z, x): x, the last argument, differs in role from y and z; x > 0 */
double kd_carlson_rd_arg(struct kd_carlson_arg arg);

/* (f(p) - f(q))/(p - q) for f = R_J(x, y, z, .), p, q > 0, and for f = R_C(1, .), p, q > 0; f'(p) if p = q. Nothing is
 * subtracted, so that close p and q lose no digits: relative error some 1e-15. The first difference quotient, of R_J,
 * is -3/2 Int_0^inf dt / ((t+p)(t+q) sqrt((t+x)(t+y)(t+z))) by duplication; its series is that of DLMF 19.19.7 for
 * seven arguments. */
double kd_carlson_rj_slope(struct kd_carlson_arg arg, double p, double q);
double kd_carlson_rc_slope(double p, double q);

/* R_J for Re(p) > 0 and R_C(s^2, q2) for Re(s) > 0 and q2 not negative real. */
double complex kd_carlson_rj_complex(struct kd_carlson_arg arg, double complex p);
double complex kd_carlson_rc_complex(double complex s, double complex q2);

#endif
