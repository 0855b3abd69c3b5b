#include "physics/transfer_function.h"

#include "physics/root.h"

#include <math.h>

#define APART 1e-3 /* of chi, and of the way to the horizon: central differences leave its square, rays of 1e-12 their 1e-9 */

struct seek {
    const struct kd_disk_image *image;
    double r, g;
};

static double alpha_at(const struct kd_disk_image *image, double r, double chi)
{
    double alpha, beta;
    return kd_disk_image_place(image, r, chi, &alpha, &beta) ? alpha : NAN;
}

/* g = 1/(u^t (1 + Omega alpha sin i)) has its ends where alpha has. */
static double alpha_slope(const void *user, double chi)
{
    const struct seek *s = user;
    return alpha_at(s->image, s->r, chi + APART) - alpha_at(s->image, s->r, chi - APART);
}

static double redshift_off(const void *user, double chi)
{
    const struct seek *s = user;
    struct kd_disk_ring ring = kd_disk_image_gas(s->image, s->r);
    return kd_disk_image_light(s->image, &ring, alpha_at(s->image, s->r, chi), 0).g - s->g;
}

bool kd_transfer_ring_of(const struct kd_disk_image *image, double r, struct kd_transfer_ring *out)
{
    enum { N = KD_DISK_IMAGE_ANGLES };
    double alpha[N], beta[N], ends[2];
    const struct seek seek = { image, r, 0 };
    int turns[2], n = 0;
    kd_disk_image_ring(image, r, 1, N, alpha, beta);
    for (int j = 0; j < N; j++) {
        double before = alpha[j] - alpha[(j + N - 1) % N], after = alpha[(j + 1) % N] - alpha[j];
        if ((before > 0) != (after > 0) && n++ < 2)
            turns[n - 1] = j;
    }
    if (n != 2 || image->sin_i < 1e-4)
        return false;
    for (int k = 0; k < 2; k++) {
        double chi = 2 * M_PI * turns[k] / N, near = 2 * M_PI / N;
        ends[k] = kd_root(alpha_slope, &seek, chi - 1.5 * near, chi + 1.5 * near);
        if (isnan(ends[k]))
            return false;
    }
    bool first_is_red = alpha_at(image, r, ends[0]) > alpha_at(image, r, ends[1]);
    struct kd_disk_ring gas = kd_disk_image_gas(image, r);
    *out = (struct kd_transfer_ring) { .r = r, .chi_min = ends[!first_is_red], .chi_max = ends[first_is_red] };
    out->g_min = kd_disk_image_light(image, &gas, alpha_at(image, r, out->chi_min), 0).g;
    out->g_max = kd_disk_image_light(image, &gas, alpha_at(image, r, out->chi_max), 0).g;
    return out->g_max > out->g_min;
}

/* |d(alpha, beta)/d(ln r, chi)|. */
static double stretch_of(const struct kd_disk_image *image, double r, double chi)
{
    double a[4], b[4], apart = kd_disk_image_step(image, r, APART);
    bool found = kd_disk_image_place(image, r, chi - APART, &a[0], &b[0]) && kd_disk_image_place(image, r, chi + APART, &a[1], &b[1]) &&
                 kd_disk_image_place(image, r * exp(-apart), chi, &a[2], &b[2]) && kd_disk_image_place(image, r * exp(apart), chi, &a[3], &b[3]);
    return found ? fabs((a[1] - a[0]) * (b[3] - b[2]) - (b[1] - b[0]) * (a[3] - a[2])) / (4 * APART * apart) : NAN;
}

bool kd_transfer_at(const struct kd_disk_image *image, const struct kd_transfer_ring *ring, double g_star, bool far_side, struct kd_transfer *out)
{
    double span = ring->g_max - ring->g_min, red = ring->chi_min, blue = ring->chi_max;
    /* From the red end up over pi/2 to the blue one, or down over -pi/2. */
    while (far_side && blue < red)
        blue += 2 * M_PI;
    while (!far_side && blue > red)
        blue -= 2 * M_PI;
    const struct seek seek = { image, ring->r, ring->g_min + g_star * span };
    double chi = kd_root(redshift_off, &seek, red, blue);
    if (!kd_disk_image_place(image, ring->r, chi, &out->alpha, &out->beta))
        return false;
    double slope = (redshift_off(&seek, chi + APART) - redshift_off(&seek, chi - APART)) / (2 * APART * span); /* of g*, in chi at one r */
    struct kd_disk_ring gas = kd_disk_image_gas(image, ring->r);
    out->mu = kd_disk_image_light(image, &gas, out->alpha, out->beta).mu;
    out->f = seek.g * sqrt(g_star * (1 - g_star)) * stretch_of(image, ring->r, chi) / (M_PI * ring->r * ring->r * fabs(slope));
    return isfinite(out->f);
}
