/* Computes visibilities: the Fourier transform of the sky, summed directly over the pixels of a map. Pure, any
 * thread.
 *
 *     V(u, v) = sum of I dOmega exp(-2 pi i (u x + v y))        (Thompson, Moran & Swenson 2017, eq. 3.7)
 *
 * x points east, to the left of the picture, and y north, to the top; both are in radians from the hole. u and v have
 * the same directions, and are in wavelengths. The light of a pixel's whole solid angle is taken to be at its centre.
 */
#ifndef KD_INTEGRAL_FOURIER_H
#define KD_INTEGRAL_FOURIER_H

#include <stddef.h>
#include <stdint.h>

struct kd_fourier_grid {
    uint32_t width, height;
    double pixel; /* angular size of a pixel, radians */
    /* Place of the hole, in pixels: right of the centre of the first column, and below the centre of the first row. */
    double x0, y0;
};

/* Transforms n maps of the grid at once. Rows count from the top. out: for each map the real and the imaginary part,
 * without the factor dOmega. u_gl, v_gl: baseline in 10^9 wavelengths. scratch: room for 2 * width numbers. */
void kd_fourier(const struct kd_fourier_grid *grid, const float *const *maps, size_t n, double u_gl, double v_gl,
                double *scratch, double (*out)[2]);

#endif
