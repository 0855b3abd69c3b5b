#include "physics/disk/transfer_function.h"

#include "physics/math/root.h"

#include <math.h>

/* Since g = 1/(u^t (1 + Omega alpha sin i)), the energy of a ring's light determines alpha. Along a line of constant
 * alpha, the visible radius r(beta) decreases from the near side to a minimum and grows again on the far side. A ring
 * of radius r is seen twice on the line if that minimum is below r, and once, at an end of the ring, if the minimum
 * equals r. This also holds next to edge-on, where the image of the far side lies high above the image of the near
 * side. */

#define SHORTER 0.61803398874989485 /* ratio of the golden section: (sqrt(5) - 1)/2 */
/* relative width at which the bracket of the minimum is narrow enough; the error of the minimum value is the square of
 * this width */
#define LEAST_WIDTH 1e-8
/* step of central differences, as a fraction of the distance between the two places, or of the depth of the minimum
 * below the ring. The error of the differences is proportional to the square of the step */
#define APART 1e-4

struct line {
    const struct kd_disk_image *image;
    double r, alpha;
    int side; /* side of the two ends on which the search is; 1 means alpha > 0, the red end */
};

/* Visible radius at beta minus the ring's radius. If the ray escapes, the radius counts as large. */
static double off(const void *user, double beta)
{
    const struct line *s = user;
    const double r = kd_disk_image_radius(s->image, s->alpha, beta);
    return (isfinite(r) ? r : 1e300) - s->r;
}

/* The line is searched upwards and downwards to this distance, where the visible radius exceeds the ring's. */
static double reach(const struct line *s) { return 2 * s->r + 20; }

/* The beta at which the visible radius is smallest. If below_is_enough is true, any beta with a visible radius below
 * the ring's is accepted. */
static double least(const struct line *s, bool below_is_enough)
{
    double low = -reach(s), high = reach(s), a = high - SHORTER * (high - low), b = low + SHORTER * (high - low),
           at_a = off(s, a), at_b = off(s, b);
    while (high - low > LEAST_WIDTH * s->r && !(below_is_enough && fmin(at_a, at_b) < 0)) {
        if (at_a < at_b) {
            high = b, b = a, at_b = at_a;
            at_a = off(s, a = high - SHORTER * (high - low));
        } else {
            low = a, a = b, at_a = at_b;
            at_b = off(s, b = low + SHORTER * (high - low));
        }
    }
    return at_a < at_b ? a : b;
}

static double least_off(const void *user, double alpha)
{
    struct line s = *(const struct line *)user;
    s.alpha = s.side * alpha;
    return off(&s, least(&s, false));
}

bool kd_transfer_ring_of(const struct kd_disk_image *image, double r, struct kd_transfer_ring *out)
{
    const struct kd_disk_ring gas = kd_disk_image_gas(image, r);
    struct kd_transfer_ring ring = { .r = r };
    if (image->sin_i < 1e-4)
        return false;
    for (int k = 0; k < 2; k++) {
        struct line s = { image, r, 0, k ? -1 : 1 };
        s.alpha = s.side * kd_root(least_off, &s, 0, reach(&s));
        if (isnan(s.alpha))
            return false;
        ring.alpha[k] = s.alpha;
        ring.beta[k] = least(&s, false);
    }
    ring.g_min = kd_disk_image_light(image, &gas, ring.alpha[0], 0).g;
    ring.g_max = kd_disk_image_light(image, &gas, ring.alpha[1], 0).g;
    *out = ring;
    return ring.g_max > ring.g_min;
}

/* |dr/d beta| at constant alpha next to edge-on, from the places of two neighbouring rings. The near side of a ring is
 * a strip of width r cos i there. */
static double steepness(const struct line *s, double lowest, int k)
{
    const double depth = fmin(1, -off(s, lowest) / s->r), apart = APART * depth, end = k ? reach(s) : -reach(s);
    struct line in = *s, out = *s;
    in.r *= 1 - apart, out.r *= 1 + apart;
    return 2 * apart * s->r / fabs(kd_root(off, &out, lowest, end) - kd_root(off, &in, lowest, end));
}

bool kd_transfer_at(const struct kd_disk_image *image, const struct kd_transfer_ring *ring, double g_star,
                    struct kd_transfer out[2])
{
    const struct kd_disk_ring gas = kd_disk_image_gas(image, ring->r);
    const double span = ring->g_max - ring->g_min, g = ring->g_min + g_star * span;
    /* interpolates alpha, as 1/g is linear in alpha */
    const double part = (1 / g - 1 / ring->g_min) / (1 / ring->g_max - 1 / ring->g_min);
    const struct line s = { image, ring->r, ring->alpha[0] + part * (ring->alpha[1] - ring->alpha[0]), 0 };
    const bool edge_on = !image->angles;
    const double middle = least(&s, !edge_on),
                 slope = g * g * gas.ut * fabs(gas.omega) * image->sin_i; /* |dg/d alpha| at constant r */
    const double beta[2] = { kd_root(off, &s, -reach(&s), middle), kd_root(off, &s, middle, reach(&s)) },
                 apart = APART * (beta[1] - beta[0]);
    for (int k = 0; k < 2; k++) {
        const double steep = edge_on ? steepness(&s, middle, k)
                                     /* |dr/d beta| at constant alpha */
                                     : fabs(off(&s, beta[k] + apart) - off(&s, beta[k] - apart)) / (2 * apart);
        out[k] = (struct kd_transfer) { g * sqrt(g_star * (1 - g_star)) * span / (M_PI * ring->r * slope * steep),
                                        kd_disk_image_light(image, &gas, s.alpha, beta[k]).mu, s.alpha, beta[k] };
        if (!isfinite(out[k].f) || !(fabs(off(&s, beta[k])) < 1e-6 * ring->r))
            return false;
    }
    return true;
}
