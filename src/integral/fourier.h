/* Computes visibilities: the Fourier transform of the sky, summed directly over the pixels of a map. Pure, any
 * thread.
 *
 *     V(u, v) = sum of I dOmega exp(-2 pi i (u x + v y))        (Thompson, Moran & Swenson 2017, eq. 3.7)
 *
 * x points east, to the left of the picture, and y north, to its top, both in radians from the hole; u and v point
 * the same way, in wavelengths. A pixel counts as a point at its centre, with all the light of its solid angle. */
#ifndef KD_INTEGRAL_FOURIER_H
#define KD_INTEGRAL_FOURIER_H

#include <stddef.h>
#include <stdint.h>

struct kd_fourier_grid {
    uint32_t width, height;
    double pixel; /* radians a pixel */
    /* Place of the hole, in pixels: right of the centre of the first column, and below the centre of the first row. */
    double x0, y0;
};

/* Transforms n maps of the grid at once, rows from the top. out: n pairs of real and imaginary part, without the
 * factor dOmega. u_gl, v_gl: in 10^9 wavelengths. scratch: room for 2 * width numbers. */
void kd_fourier(const struct kd_fourier_grid *grid, const float *const *maps, size_t n, double u_gl, double v_gl,
                double *scratch, double (*out)[2]);

#endif
