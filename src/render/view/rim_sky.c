#include "render/view/rim_sky.h"

#include "render/view/sky_ray.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    ROUND = KD_RIM_ANGLES, ROUND_LEAST = 32, /* rays round the curve, that others are interpolated from; powers of two */
    ACROSS = 96, ACROSS_LEAST = 12,          /* intervals across it, at most and to begin with */
};

/* A ray has four angles: turn, drag, t_theta, t_phi. */
enum { ANGLES = 4 };
struct angles { double of[ANGLES]; };

struct follower {
    const struct kd_rim *rim;
    struct kd_sky_rays rays;
    double first, last; /* logarithms of distances */
};

static struct follower follower_of(const struct kd_scene *scene, const struct kd_rim *rim)
{
    const double first = log(rim->far);
    return (struct follower) { rim, kd_sky_rays_of(scene), first, first - (rim->rows - 1) * rim->fall };
}

static bool follow(const struct follower *f, uint32_t k, double off, struct angles *out)
{
    struct kd_null_bend bend;
    double look[3];
    kd_rim_look(f->rim, (1 + off) * f->rim->x[k], (1 + off) * f->rim->y[k], look);
    const bool escapes = kd_sky_ray_bend(&f->rays, look, &bend);
    *out = (struct angles) { { bend.turn, bend.drag, bend.t_theta, bend.t_phi } };
    return escapes;
}

static void direction(const struct follower *f, const struct angles *a, double out[3])
{
    const double length = sqrt(a->of[2] * a->of[2] + a->of[3] * a->of[3]);
    const struct kd_null_bend bend = { a->of[0], a->of[1], a->of[2] / length, a->of[3] / length };
    kd_null_bend_sky(&bend, f->rays.at.u, f->rays.at.s, out);
}

static double apart(const struct angles *a, const struct angles *b)
{
    double most = 0;
    for (int i = 0; i < ANGLES; i++)
        most = fmax(most, fabs(a->of[i] - b->of[i]));
    return most;
}

/* Trigonometric interpolation of n values, an even number, to a place s/m of a turn from one of them: its weight, for all s that are not multiples of m/n. L. N.
 * Trefethen 2000, Spectral Methods in MATLAB, eq. 3.7. */
static void round_weights(int n, int m, double *w)
{
    for (int s = 0; s < m; s++)
        w[s] = s % (m / n) ? sin(M_PI * n * s / m) / (n * tan(M_PI * s / m)) : 0;
}

/* How far trigonometric interpolation from the even ones of 2 n places is off at the odd ones. */
static double off_between(const struct angles *ring, int n)
{
    double w[ROUND], off = 0;
    round_weights(n, 2 * n, w);
    for (int p = 1; p < 2 * n; p += 2) {
        struct angles sum = { { 0 } };
        for (int i = 0; i < 2 * n; i += 2)
            for (int q = 0; q < ANGLES; q++)
                sum.of[q] += w[(p - i + 2 * n) % (2 * n)] * ring[i].of[q];
        off = fmax(off, apart(&sum, &ring[p]));
    }
    return off;
}

/* How many rays round the curve are enough: on the last row, where neighbours are furthest apart. */
static bool enough_round(const struct follower *f, int *out)
{
    struct angles ring[ROUND];
    for (int n = ROUND_LEAST; n < ROUND; n *= 2) {
        for (int p = 0; p < 2 * n; p++)
            if (!follow(f, (uint32_t)(p * (ROUND / (2 * n))), exp(f->last), &ring[p]))
                return false;
        *out = n;
        if (off_between(ring, n) < KD_RIM_EXACT)
            return true;
    }
    *out = ROUND;
    return true;
}

/* The place of extremum j of n, and its barycentric weight: J.-P. Berrut & L. N. Trefethen 2004, SIAM Rev. 46, 501, eqs. 4.2, 5.4. */
static double place_of(const struct follower *f, int n, int j) { return 0.5 * (f->first + f->last) + 0.5 * (f->first - f->last) * cos(M_PI * j / n); }

static void across_weights(const struct follower *f, int n, double place, double w[ACROSS + 1])
{
    double sum = 0;
    for (int j = 0; j <= n; j++) {
        const double off = place - place_of(f, n, j);
        if (fabs(off) < 1e-12) {
            memset(w, 0, (size_t)(n + 1) * sizeof *w);
            w[j] = 1;
            return;
        }
        w[j] = (j & 1 ? -1 : 1) * (j == 0 || j == n ? 0.5 : 1) / off;
        sum += w[j];
    }
    for (int j = 0; j <= n; j++)
        w[j] /= sum;
}

/* Whether n intervals are enough across column k; -1: rays do not escape. */
static int serves_across(const struct follower *f, int n, uint32_t k)
{
    struct angles at[ACROSS + 1], want;
    double w[ACROSS + 1];
    for (int j = 0; j <= n; j++)
        if (!follow(f, k, exp(place_of(f, n, j)), &at[j]))
            return -1;
    for (int p = 1; p < 2 * n; p += 2) {
        struct angles sum = { { 0 } };
        const double place = place_of(f, 2 * n, p);
        across_weights(f, n, place, w);
        for (int j = 0; j <= n; j++)
            for (int q = 0; q < ANGLES; q++)
                sum.of[q] += w[j] * at[j].of[q];
        if (!follow(f, k, exp(place), &want))
            return -1;
        if (apart(&sum, &want) > KD_RIM_EXACT)
            return 0;
    }
    return 1;
}

static bool enough_across(const struct follower *f, int *out)
{
    for (int n = ACROSS_LEAST; n < ACROSS; n += n / 2) {
        int least = 1;
        for (uint32_t k = 0; k < ROUND && least > 0; k += ROUND / 4) {
            const int serves = serves_across(f, n, k);
            least = serves < least ? serves : least;
        }
        *out = n;
        if (least)
            return least > 0;
    }
    *out = ACROSS;
    return true;
}

/* ring[k] of all columns, from those of n; w: round_weights(n, ROUND). */
static void fill_ring(double ring[ROUND], int n, const double w[ROUND])
{
    const int step = ROUND / n;
    double twice[2 * ROUND];
    for (int i = 0; i < n; i++)
        twice[i] = twice[i + n] = ring[i * step];
    for (int s = 1; s < step; s++) {
        double sum[ROUND] = { 0 };
        for (int m = 0; m < n; m++) { /* from place i - m */
            for (int i = 0; i < n; i++)
                sum[i] += w[s + m * step] * twice[i + n - m];
        }
        for (int i = 0; i < n; i++)
            ring[i * step + s] = sum[i];
    }
}

struct sheet { double of[ACROSS + 1][ANGLES][ROUND]; };

static bool fill_sheet(const struct follower *f, int round_, int across, struct sheet *sheet)
{
    double w[ROUND];
    round_weights(round_, ROUND, w);
    for (int j = 0; j <= across; j++) {
        const double off = exp(place_of(f, across, j));
        for (int k = 0; k < ROUND; k += ROUND / round_) {
            struct angles a;
            if (!follow(f, (uint32_t)k, off, &a))
                return false;
            for (int q = 0; q < ANGLES; q++)
                sheet->of[j][q][k] = a.of[q];
        }
        for (int q = 0; q < ANGLES; q++)
            fill_ring(sheet->of[j][q], round_, w);
    }
    return true;
}

static void fill_row(const struct follower *f, const struct sheet *sheet, int across, uint32_t row, float *out)
{
    const size_t rays = kd_rim_rays(f->rim);
    double w[ACROSS + 1], sum[ANGLES][ROUND] = { { 0 } };
    across_weights(f, across, f->first - row * f->rim->fall, w);
    for (int j = 0; j <= across; j++)
        for (int q = 0; q < ANGLES; q++)
            for (int k = 0; k < ROUND; k++)
                sum[q][k] += w[j] * sheet->of[j][q][k];
    for (int k = 0; k < ROUND; k++) {
        const struct angles a = { { sum[0][k], sum[1][k], sum[2][k], sum[3][k] } };
        double n[3];
        direction(f, &a, n);
        for (int i = 0; i < 3; i++)
            out[(size_t)i * rays + row * ROUND + (size_t)k] = (float)n[i];
    }
}

enum kd_status kd_rim_sky(const struct kd_scene *scene, const struct kd_rim *rim, float *out, struct kd_error *error)
{
    const struct follower f = follower_of(scene, rim);
    struct sheet *sheet = malloc(sizeof *sheet);
    int round_ = 0, across = 0;
    enum kd_status status = KD_OK;
    if (!sheet)
        KD_TRY(kd_error_set(error, KD_ENOMEM, "out of memory for rays next to the critical curve"));
    if (!enough_round(&f, &round_) || !enough_across(&f, &across) || !fill_sheet(&f, round_, across, sheet))
        KD_TRY(kd_error_field(error, "/camera", "camera is where a ray next to the critical curve does not escape: no stars can be sought there"));
    for (uint32_t row = 0; row < rim->rows; row++)
        fill_row(&f, sheet, across, row, out);
done:
    free(sheet);
    return status;
}

bool kd_rim_sky_at(const struct kd_scene *scene, const struct kd_rim *rim, uint32_t k, double off, double out[3])
{
    const struct follower f = follower_of(scene, rim);
    struct angles a;
    if (!follow(&f, k, off, &a))
        return false;
    direction(&f, &a, out);
    return true;
}
