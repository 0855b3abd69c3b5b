/* Root of a function of one variable in a bracketing interval. Double precision, pure, any thread. */
#ifndef KD_PHYSICS_MATH_ROOT_H
#define KD_PHYSICS_MATH_ROOT_H

typedef double (*kd_root_fn)(const void *user, double x);

/* Returns an x between low and high with f(x) = 0. Either of low and high may be the larger. f must have different
 * signs at the two ends, or be 0 at one of them; otherwise the result is NaN. f need not be smooth. The error of x is
 * one or two ulps; for a root near 0 it is some 1e-18 times the larger of |low| and |high|. The method is that of
 * Chandrupatla 1997, Adv. Eng. Softw. 28, 145: inverse quadratic interpolation where it is safe, otherwise bisection.
 * It takes about ten calls of f. */
double kd_root(kd_root_fn f, const void *user, double low, double high);

#endif
