/* Integration over (0, 1) by the double exponential rule (H. Takahasi & M. Mori 1974, Publ. RIMS 9, 721). Double
 * precision, pure, any thread.
 *
 * The integrand gets x and y = 1 - x. Each has full relative precision near its own end, where the integrand may have
 * any integrable singularity; in the interior it must be smooth. The step is halved until the sum converges. The
 * relative error is a few 1e-15 if nothing cancels. The result is NaN if the sum does not converge within 2000 points.
 */
#ifndef KD_PHYSICS_MATH_QUADRATURE_H
#define KD_PHYSICS_MATH_QUADRATURE_H

typedef double (*kd_integrand)(double x, double y, const void *context);

double kd_quadrature(kd_integrand f, const void *context);

/* Nodes and weights of Gauss-Legendre quadrature on (0, 1), in ascending order. n may be up to some hundreds. Errors
 * are some 1e-16. */
void kd_gauss_legendre(int n, double *nodes, double *weights);

#endif
