/* The parts of the suite of extremes share this: the table, the measure of an error, and the parts themselves. One
 * thread. */
#ifndef KD_TEST_EXTREMES_H
#define KD_TEST_EXTREMES_H

#include "physics/null/null_geodesic.h"
#include "render/render.h"

#include <stdbool.h>
#include <stddef.h>

/* A case in one engine. Errors are over 1 + condition number: of r relative, of phi in radians; NaN: not judged. */
struct extreme_row {
    char what[48];
    const char *engine;         /* "mino-rkn6 f32", "lens map 16", ... */
    size_t rays;                /* or pixels */
    double median, most, worst; /* of r; most: 99 % */
    double phi;                 /* worst, of crossings 1.6 times as far out as the horizon */
    double bound, phi_bound;    /* of the worst */
    size_t unsure;              /* rays of which the answer says that it does not hold them */
    double unsure_most;         /* fraction of the rays that may be so */
    size_t loose;               /* rays that are off by more than the error that they come with */
    size_t broken; /* rays with a number that is not finite, or a wrong fate or crossing of which nothing warns */
};

/* Print a row, the first one under its heading. It breaks if `broken` is not 0, a worst error exceeds its bound,
 * more rays are unsure than may be, or more than one in a hundred is loose. */
void extreme_row(const struct extreme_row *row);
/* Rows so far; of them, those that broke. */
size_t extreme_rows(size_t *broken);

/* Sorts, and fills in median, most and worst; NaN without any. */
void extreme_spread(double *errors, size_t n, struct extreme_row *row);

/* Condition numbers of the crossings of `path`, measured on the closed form: the sum of |d ln r/d ln x|, or |d phi/d
 * ln x|, over alpha, beta, spin, cos(theta) and radius, each times its weight (NULL: 1). INFINITY where a fraction
 * `step` makes it another ray. */
enum { EXTREME_INPUTS = 5 };
void extreme_condition(const struct kd_null_ray *ray, const struct kd_null_path *path, double step,
                       const double weight[EXTREME_INPUTS], double *r, double *phi);
/* The same ray, path->crossings and fate, when each input moves by this fraction times its weight, either way? */
bool extreme_steady(const struct kd_null_ray *ray, const struct kd_null_path *path, double step,
                    const double weight[EXTREME_INPUTS]);

/* Point k of a sequence that fills the unit square evenly (M. Roberts 2018). */
double extreme_x(size_t k);
double extreme_y(size_t k);

void extreme_closed(void);                           /* the closed form */
void extreme_rays(struct kd_renderer *renderer);     /* listed rays in f32 and f64 */
void extreme_lenses(struct kd_renderer *renderer);   /* the lens maps of pictures */
void extreme_pictures(struct kd_renderer *renderer); /* whole pictures, JSON to pixels */

/* These lose no digit next to 90 and 180 degrees, where the difference of the angles is exact. */
static inline double extreme_cos_deg(double i) { return sin((90 - i) * (M_PI / 180)); }
static inline double extreme_sin_deg(double i) { return sin((i > 90 ? 180 - i : i) * (M_PI / 180)); }

#endif
