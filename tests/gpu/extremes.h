/* Shared by the files of the suite of extremes: the table of results, the measure of errors, and the declarations of
 * the parts. One thread. */
#ifndef KD_TEST_EXTREMES_H
#define KD_TEST_EXTREMES_H

#include "physics/null/null_geodesic.h"
#include "render/render.h"

#include <stdbool.h>
#include <stddef.h>

/* Result of a case for one engine. Errors are divided by 1 + the condition number. Errors of r are relative, those of
 * phi are in radians. NaN: not compared. */
struct extreme_row {
    char what[48];
    const char *engine;         /* name of the engine, such as "mino-rkn6 f32" or "lens map 16" */
    size_t rays;                /* number of rays or pixels */
    double median, most, worst; /* errors of r: the median; the 99th percentile; the largest */
    double phi;                 /* largest error of phi, for crossings beyond 1.6 times the horizon's radius */
    double bound, phi_bound;    /* largest allowed values of `worst` and `phi` */
    size_t unsure;              /* number of rays that the answer itself marks as inaccurate */
    double unsure_most;         /* largest allowed fraction of `unsure` rays */
    size_t loose;               /* number of rays whose error exceeds their stated error */
    /* number of rays that are wrong but not marked: a number is not finite, or a fate or crossing is wrong */
    size_t broken;
};

/* Prints a row, and a heading before the first row. A row fails if `broken` is not 0, a worst error exceeds its bound,
 * more rays than `limit` are unsure, or the errors of more than one ray in a hundred exceed their stated errors. */
void extreme_row(const struct extreme_row *row);
/* Number of rows so far; number of failed rows so far. */
size_t extreme_rows(size_t *broken);

/* Sorts the errors. Fills in `median`, `most` and `worst`, with NaN if n is 0. */
void extreme_spread(double *errors, size_t n, struct extreme_row *row);

/* Condition numbers of the crossings of `path`, measured on the closed form. Each is the sum of |d ln r/d ln x| or |d
 * phi/d ln x| over the inputs x (alpha, beta, spin, cos(theta) and radius), each times its weight (NULL: 1). INFINITY
 * if a relative change of `step` gives a different kind of ray. */
enum { EXTREME_INPUTS = 5 };
void extreme_condition(const struct kd_null_ray *ray, const struct kd_null_path *path, double step,
                       const double weight[EXTREME_INPUTS], double *r, double *phi);
/* True if the ray keeps its fate and its path->crossings when each input is changed by plus or minus this fraction
 * times its weight. */
bool extreme_steady(const struct kd_null_ray *ray, const struct kd_null_path *path, double step,
                    const double weight[EXTREME_INPUTS]);

/* Point k of a sequence that fills the unit square evenly (M. Roberts 2018). */
double extreme_x(size_t k);
double extreme_y(size_t k);

void extreme_closed(void);                           /* the closed form */
void extreme_rays(struct kd_renderer *renderer);     /* part: lists of rays, in f32 and f64 */
void extreme_lenses(struct kd_renderer *renderer);   /* part: the lens maps of pictures */
void extreme_pictures(struct kd_renderer *renderer); /* part: whole pictures, from JSON to pixels */

/* Cosine of an angle in degrees. It is accurate next to 90 and 180 degrees, because the difference from these angles is
 * exact in double precision. */
static inline double extreme_cos_deg(double i) { return sin((90 - i) * (M_PI / 180)); }
static inline double extreme_sin_deg(double i) { return sin((i > 90 ? 180 - i : i) * (M_PI / 180)); }

#endif
