/* Cunningham's transfer function of a thin disk: the image of a ring by energy. Double precision; pure, any thread.
 * G = c = M = 1.
 *
 *   f(g*, r) = g sqrt(g* (1 - g*)) |d(alpha, beta)/d(g*, r)|/(pi r)      g* = (g - g_min)/(g_max - g_min)
 *
 * Cunningham 1975, ApJ 202, 788; Speith, Riffert & Ruder 1995, Comput. Phys. Commun. 88, 109, eq. 1. A ring shows each
 * g between g_min and g_max twice: on the near and on the far side of the hole. A line is F(g) dg = pi r f g^2
 * epsilon/sqrt(g* (1 - g*)) dg* dr photons (line_profile.h), summed over both sides. Places are found by rays that meet
 * the ring. The determinant |d(alpha, beta)/d(g, r)| is 1/(|dg/d alpha| |dr/d beta|). dg/d alpha is taken at constant
 * r, in closed form. dr/d beta is taken at constant alpha, by finite differences of rays. */
#ifndef KD_PHYSICS_DISK_TRANSFER_FUNCTION_H
#define KD_PHYSICS_DISK_TRANSFER_FUNCTION_H

#include "physics/disk/disk_image.h"

/* The points of a ring with the largest and the smallest energy. */
struct kd_transfer_ring {
    double r, g_min, g_max;
    double alpha[2], beta[2]; /* places of the two points, first of the red end, then of the blue end */
};

/* Finds the two points of a ring. Returns false if the ring has a single energy, as for an observer on the axis. */
bool kd_transfer_ring_of(const struct kd_disk_image *image, double r, struct kd_transfer_ring *ring);

struct kd_transfer { double f, mu, alpha, beta; };
/* Computes f for the near side and for the far side, accurate to some 1e-6. g_star: between 0 and 1, exclusive. Returns
 * false if one of the two places is not found, which has not been observed. */
bool kd_transfer_at(const struct kd_disk_image *image, const struct kd_transfer_ring *ring, double g_star,
                    struct kd_transfer out[2]);

#endif
