/* Real roots of a real polynomial in an interval. Double precision, pure functions, any thread. */
#ifndef KD_PHYSICS_MATH_POLYNOMIAL_H
#define KD_PHYSICS_MATH_POLYNOMIAL_H

#define KD_POLYNOMIAL_DEGREE 4

/* c[0] + c[1] x + ... + c[degree] x^degree, degree <= KD_POLYNOMIAL_DEGREE. */
double kd_polynomial_at(const double *c, int degree, double x);

/* The roots in [low, high], ascending; returns their number. Between neighbouring roots of the derivative there is one
 * root if the sign changes. An extremum that is zero within rounding counts as a double root, since rounded
 * coefficients cannot resolve it further. roots: room for `degree` numbers. */
int kd_polynomial_roots(const double *c, int degree, double low, double high, double *roots);

#endif
