/* Real roots of a real polynomial in an interval. Double precision, pure functions, any thread. */
#ifndef KD_PHYSICS_MATH_POLYNOMIAL_H
#define KD_PHYSICS_MATH_POLYNOMIAL_H

#define KD_POLYNOMIAL_DEGREE 4

/* Value of c[0] + c[1] x + ... + c[degree] x^degree. degree is at most KD_POLYNOMIAL_DEGREE. */
double kd_polynomial_at(const double *c, int degree, double x);

/* Finds the roots in [low, high], in ascending order, and returns their number. Between neighbouring roots of the
 * derivative there is one root if the sign of the polynomial changes. An extremum that is zero within rounding counts
 * as a double root, since rounded coefficients cannot resolve it further. roots: memory for `degree` numbers. */
int kd_polynomial_roots(const double *c, int degree, double low, double high, double *roots);

#endif
