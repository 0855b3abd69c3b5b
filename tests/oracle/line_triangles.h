/* Oracle for line profiles. It traces a ray for each place of the disk's image; the code under test interpolates a
 * table. It sums triangles with linear g and uniform light, and extrapolates from two such sums; the code under test
 * has cells with moments. The formula of g is written out (Bardeen, Press & Teukolsky 1972, ApJ 178, 347, eqs. 2.16,
 * 5.4a; with charge Dadhich & Kale 1977, J. Math. Phys. 18, 1727). The rays themselves are tested by
 * tests/oracle/kerr_schild.h. The cumulative share is accurate to about a tenth of `apart`: 1e-5 to 1e-4 with 1024
 * directions. */
#ifndef KD_TESTS_LINE_TRIANGLES_H
#define KD_TESTS_LINE_TRIANGLES_H

#include "physics/disk/disk_image.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

struct lt_place { double alpha, beta, g, light; };

struct lt_sum {
    const double *edges;
    int bins;
    double *in, total;
};

static inline double lt_below(const double g[3], double x)
{
    if (x <= g[0])
        return 0;
    if (x >= g[2])
        return 1;
    return x < g[1] ? (x - g[0]) * (x - g[0]) / ((g[2] - g[0]) * (g[1] - g[0]))
                    : 1 - (g[2] - x) * (g[2] - x) / ((g[2] - g[0]) * (g[2] - g[1]));
}

static inline void lt_add(struct lt_sum *s, const struct lt_place *a, const struct lt_place *b,
                          const struct lt_place *c)
{
    double area = 0.5 * fabs((b->alpha - a->alpha) * (c->beta - a->beta) - (c->alpha - a->alpha) * (b->beta - a->beta)),
           light = area * (a->light + b->light + c->light) / 3;
    double low = fmin(fmin(a->g, b->g), c->g), high = fmax(fmax(a->g, b->g), c->g),
           g[3] = { low, fmin(fmax(a->g + b->g + c->g - low - high, low), high), high };
    int first = 0, last = s->bins - 1;
    while (first < last) { /* the bin of the smallest g */
        int middle = (first + last + 1) / 2;
        *(s->edges[middle] <= low ? &first : &last) = s->edges[middle] <= low ? middle : middle - 1;
    }
    double before = lt_below(g, s->edges[first]);
    for (int i = first; i < s->bins && (i == first || s->edges[i] < high); i++) {
        double share = lt_below(g, s->edges[i + 1]);
        s->in[i] += light * (share - before);
        before = share;
    }
    s->total += light;
}

/* The emission law of the line, with the profile's parameters. mu is the cosine of the angle to the disk's normal. */
struct lt_law {
    double inner, outer;
    double (*light)(const void *user, double r, double g, double mu);
    const void *user;
};

/* mu = g sqrt(eta)/r, eta = (alpha^2 - a^2) cos^2 i + beta^2 (Cunningham & Bardeen 1973, ApJ 183, 237). */
static inline double lt_cosine(const struct kd_disk_image *image, const struct lt_place *p, double r)
{
    double a = image->hole.a, c = image->cos_i, eta = (p->alpha * p->alpha - a * a) * c * c + p->beta * p->beta;
    return fmin(1, p->g * sqrt(fmax(eta, 0)) / r);
}

/* Computes the cumulative share of a line with this law. cumulative[i]: fraction of photons below edges[i + 1]; edges
 * ascend. n directions and m rings, both even. Returns the largest difference of the two sums over all edges; negative
 * if a place was not found. */
static inline double lt_profile_of(const struct kd_disk_image *image, const struct lt_law *law, int n, int m,
                                   const double *edges, int bins, double *cumulative)
{
    struct lt_place *at = malloc((size_t)n * (size_t)(m + 1) * sizeof *at);
    double *in = calloc((size_t)bins * 2, sizeof *in), apart = 0, a = image->hole.a, q2 = image->hole.q * image->hole.q;
    for (int i = 0; i <= m && apart >= 0; i++) {
        double part = (double)i / m,
               r = i == m ? law->outer : law->inner * pow(law->outer / law->inner, part * (0.4 + 0.6 * part)),
               s = sqrt(r - q2);
        for (int j = 0; j < n; j++) {
            struct lt_place *p = &at[i * n + j];
            if (!kd_disk_image_place(image, r, 2 * M_PI * j / n, &p->alpha, &p->beta))
                apart = -1;
            p->g = r * sqrt(r * r - 3 * r + 2 * q2 + 2 * a * s) / (r * r + a * s + p->alpha * image->sin_i * s);
            p->light = law->light(law->user, r, p->g, lt_cosine(image, p, r));
        }
    }
    struct lt_sum sums[2];
    for (int step = 1; step <= 2 && apart >= 0; step++) {
        struct lt_sum *s = &sums[step - 1];
        *s = (struct lt_sum) { edges, bins, in + (size_t)bins * (size_t)(step - 1), 0 };
        for (int i = 0; i < m; i += step)
            for (int j = 0; j < n; j += step) {
                const struct lt_place *x = &at[i * n], *y = &at[(i + step) * n];
                int k = (j + step) % n;
                lt_add(s, &x[j], &y[j], &y[k]);
                lt_add(s, &x[j], &x[k], &y[k]);
            }
    }
    double fine = 0, rough = 0;
    for (int i = 0; i < bins && apart >= 0; i++) {
        fine += sums[0].in[i] / sums[0].total, rough += sums[1].in[i] / sums[1].total;
        /* the errors of both sums are proportional to the square of their steps */
        cumulative[i] = fine + (fine - rough) / 3;
        apart = fmax(apart, fabs(fine - rough));
    }
    free(at);
    free(in);
    return apart;
}

static inline double lt_power(const void *user, double r, double g, double mu)
{
    (void)mu;
    return g * g * g * pow(r, -*(const double *)user);
}

/* Like lt_profile_of, for a line with emissivity r^-index from the ISCO to `outer`. */
static inline double lt_profile(const struct kd_disk_image *image, double index, double outer, int n, int m,
                                const double *edges, int bins, double *cumulative)
{
    const struct lt_law law = { image->isco, outer, lt_power, &index };
    return lt_profile_of(image, &law, n, m, edges, bins, cumulative);
}

#endif
