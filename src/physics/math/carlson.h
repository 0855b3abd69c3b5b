/* Carlson's symmetric elliptic integrals by duplication. Double precision, pure functions, any thread, no units.
 *
 *   R_F(x,y,z)   = 1/2 Int_0^inf dt / sqrt((t+x)(t+y)(t+z))
 *   R_C(x,y)     = R_F(x,y,y)
 *   R_J(x,y,z,p) = 3/2 Int_0^inf dt / ((t+p) sqrt((t+x)(t+y)(t+z)))
 *   R_D(x,y,z)   = R_J(x,y,z,z)
 *
 * Sources: B. C. Carlson 1995, Numer. Algorithms 10, 13 (duplication, and R_J's sum of R_C); DLMF 19.36(i) (the final
 * series, to the seventh degree); DLMF 19.20.14 (negative p). The series starts when the spread of the arguments leaves
 * an error below 1e-17. The relative error is a few 1e-16; for arguments from 1e-10 to 1e10 it was measured to be below
 * 2e-15. Outside a function's domain the result is NaN; where the integral diverges, INFINITY. */
#ifndef KD_PHYSICS_MATH_CARLSON_H
#define KD_PHYSICS_MATH_CARLSON_H

#include <complex.h>

/* R_F for x, y, z >= 0, of which at most one is 0. */
double kd_carlson_rf(double x, double y, double z);

/* R_C for x >= 0 and y != 0; Cauchy's principal value for y < 0. R_C is an elementary function (DLMF 19.2.17-20). */
double kd_carlson_rc(double x, double y);

/* R_J for x, y, z >= 0, of which at most one is 0, and p != 0; Cauchy's principal value for p < 0. */
double kd_carlson_rj(double x, double y, double z, double p);

/* R_D for x, y >= 0, of which at most one is 0, and z > 0. */
double kd_carlson_rd(double x, double y, double z);

/* Arguments x, y, z of R_F, R_J and R_D in real arithmetic. y and z are either real and >= 0, or complex conjugates.
 * Only sums that are real in both cases are stored,
 *
 *   first = sqrt(x),   sum = sqrt(y) + sqrt(z),   root = sqrt(y z),
 *
 * where square roots have a positive real part. With g = x + first sum + root = x + lambda, one step of duplication is
 *
 *   first' = sqrt(g)/2,   root' = sum sqrt(g)/4,   sum' = sqrt(sum (sum + 2 first + 2 sqrt(g)))/2,
 *
 * which follows from y + lambda = (sqrt(y) + sqrt(x))(sqrt(y) + sqrt(z)). Nothing is subtracted, so no digits are lost
 * if y and z are nearly equal or nearly 0. Domain: first >= 0, sum > 0, root >= 0, at most one of x, y, z zero. */
struct kd_carlson_arg { double first, sum, root; };

double kd_carlson_rf_arg(struct kd_carlson_arg arg);
double kd_carlson_rj_arg(struct kd_carlson_arg arg, double p); /* p must be positive */
/* R_D(y, z, x), with x > 0. x is the last argument, which differs in role from the other two */
double kd_carlson_rd_arg(struct kd_carlson_arg arg);

/* Difference quotients (f(p) - f(q))/(p - q) for p, q > 0, or f'(p) if p = q: first for f = R_J(x, y, z, .), then for f
 * = R_C(1, .). Nothing is subtracted, so no digits are lost if p and q are close. The relative error is some 1e-15. The
 * quotient of R_J is -3/2 Int_0^inf dt / ((t+p)(t+q) sqrt((t+x)(t+y)(t+z))) by duplication. Its final series is that of
 * DLMF 19.19.7 for seven arguments. */
double kd_carlson_rj_slope(struct kd_carlson_arg arg, double p, double q);
double kd_carlson_rc_slope(double p, double q);

/* Functions of complex arguments: R_J for Re(p) > 0, and R_C(s^2, q2) for Re(s) > 0 and a q2 that is not negative real.
 */
double complex kd_carlson_rj_complex(struct kd_carlson_arg arg, double complex p);
double complex kd_carlson_rc_complex(double complex s, double complex q2);

#endif
