/* Legendre's elliptic integrals and Jacobi's elliptic functions, in the parameter m = k^2. Double precision, pure
 * functions, any thread, no units.
 *
 *   F(phi|m)    = Int_0^phi dx / sqrt(1 - m sin^2 x)
 *   E(phi|m)    = Int_0^phi sqrt(1 - m sin^2 x) dx
 *   Pi(n;phi|m) = Int_0^phi dx / ((1 - n sin^2 x) sqrt(1 - m sin^2 x))
 *
 * m may have any value, also negative, with m sin^2 < 1 on the path. If m < 1, phi may be any real number, by
 * quasi-periodicity. Outside the domain the result is NaN. If n sin^2 > 1 and |phi| <= pi/2, Pi is Cauchy's principal
 * value past the pole. The relative error is a few 1e-16 times the conditioning.
 *
 * Sources: DLMF 19.25(i) (in terms of Carlson's integrals), 22.20(ii) and 22.7(i) (Jacobi's functions by the
 * arithmetic-geometric mean and descending Landen transformations). */
#ifndef KD_PHYSICS_MATH_ELLIPTIC_H
#define KD_PHYSICS_MATH_ELLIPTIC_H

double kd_elliptic_f(double phi, double m);
double kd_elliptic_e(double phi, double m);
double kd_elliptic_pi(double n, double phi, double m);

/* Complete integrals, with phi = pi/2. K is INFINITY at m = 1. */
double kd_elliptic_k(double m);
double kd_elliptic_e_complete(double m);
double kd_elliptic_pi_complete(double n, double m);

struct kd_jacobi { double sn, cn, dn; };

/* Jacobi's functions of u, 0 <= m <= 1. m1 = 1 - m is a separate argument, because 1 - m loses all digits near m = 1.
 * For |u| < K the relative error of each function is a few 1e-16, in addition to the effect of an ulp or two in u. The
 * domain is |u| <= 2K. */
struct kd_jacobi kd_jacobi(double u, double m, double m1);

/* The amplitude am, for which sn = sin(am); |u| <= 2K. */
double kd_jacobi_am(double u, double m, double m1);

#endif
