/* Root of a function of one variable in a bracketing interval. Double precision, pure, any thread. */
#ifndef KD_PHYSICS_MATH_ROOT_H
#define KD_PHYSICS_MATH_ROOT_H

typedef double (*kd_root_fn)(const void *user, double x);

/* Returns x between low and high, in either order, with f(x) = 0, to an ulp or two (next to 0, to 1e-18 of the ends). f
 * must have different signs at the ends, or be 0 at one of them; otherwise the result is NaN. f need not be smooth.
 * Method: Chandrupatla 1997, Adv. Eng. Softw. 28, 145, that is inverse quadratic interpolation where it is safe, and
 * otherwise bisection; some ten calls of f. */
double kd_root(kd_root_fn f, const void *user, double low, double high);

#endif
