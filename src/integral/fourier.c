#include "integral/fourier.h"

#include <math.h>

#define GIGA 1e9

/* Cosine and sine of 2 pi turns. Whole turns are removed first, because `turns` may be large. */
static void turn(double turns, double *re, double *im)
{
    const double angle = 2 * M_PI * (turns - rint(turns));
    *re = cos(angle), *im = sin(angle);
}

/* Sums a row of pixels times the phases of the columns. Four independent sums keep the pipeline full. */
static void row_sum(const float *row, const double *re, const double *im, uint32_t width, double *out_re,
                    double *out_im)
{
    double a[4] = { 0 }, b[4] = { 0 };
    uint32_t i = 0;
    for (; i + 4 <= width; i += 4)
        for (int k = 0; k < 4; k++)
            a[k] += row[i + k] * re[i + k], b[k] += row[i + k] * im[i + k];
    for (; i < width; i++)
        a[0] += row[i] * re[i], b[0] += row[i] * im[i];
    *out_re = (a[0] + a[1]) + (a[2] + a[3]), *out_im = (b[0] + b[1]) + (b[2] + b[3]);
}

void kd_fourier(const struct kd_fourier_grid *grid, const float *const *maps, size_t n, double u_gl, double v_gl,
                double *scratch, double (*out)[2])
{
    double *re = scratch, *im = scratch + grid->width;
    const double step_u = u_gl * GIGA * grid->pixel, step_v = v_gl * GIGA * grid->pixel;
    for (uint32_t i = 0; i < grid->width; i++)
        turn(step_u * (i - grid->x0), &re[i], &im[i]); /* x = -(i - x0) pixel: east is to the left */
    for (size_t k = 0; k < n; k++)
        out[k][0] = out[k][1] = 0;
    for (uint32_t j = 0; j < grid->height; j++) {
        double c, s;
        turn(step_v * (j - grid->y0), &c, &s); /* y = -(j - y0) pixel: north is at the top */
        for (size_t k = 0; k < n; k++) {
            double a, b;
            row_sum(maps[k] + (size_t)j * grid->width, re, im, grid->width, &a, &b);
            out[k][0] += a * c - b * s, out[k][1] += a * s + b * c;
        }
    }
}
