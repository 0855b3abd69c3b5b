/* Visibilities are the Fourier transform of the sky, summed directly over the pixels of a map. Pure, any thread.
 *
 *     V(u, v) = sum of I dOmega exp(-2 pi i (u x + v y))        (Thompson, Moran & Swenson 2017, eq. 3.7)
 *
 * x to the east, which is the left of the picture, y to the north, its top, both in radians from where the hole is;
 * u and v the same way, in wavelengths. A pixel counts as a point in its middle, with all the light of its solid
 * angle. */
#ifndef KD_INTEGRAL_FOURIER_H
#define KD_INTEGRAL_FOURIER_H

#include <stddef.h>
#include <stdint.h>

struct kd_fourier_grid {
    uint32_t width, height;
    double pixel;  /* radians from a pixel to the next */
    double x0, y0; /* where the hole is: in pixels right of the middle of the first column, and below the middle of the
                      first row */
};

/* For n maps of the grid at once, rows from the top: out has n pairs of real and imaginary part, of sums without
 * dOmega. scratch: room for 2 * width numbers. */
void kd_fourier(const struct kd_fourier_grid *grid, const float *const *maps, size_t n, double u_gl, double v_gl,
                double *scratch, double (*out)[2]);

#endif
