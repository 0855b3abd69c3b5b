/* This is Cunningham's transfer function of a thin disk: how a ring is seen, by energy. Double precision; pure, any thread. G = c = M = 1.
 *
 *   f(g*, r) = g sqrt(g* (1 - g*)) |d(alpha, beta)/d(g*, r)|/(pi r)      g* = (g - g_min)/(g_max - g_min)
 *
 * Cunningham 1975, ApJ 202, 788; Speith, Riffert & Ruder 1995, Comput. Phys. Commun. 88, 109, eq. 1. A ring shows each g between the ends twice, on the near and on the far side of
 * the hole, and a line is F(g) dg = sum over both of pi r f g^2 epsilon/sqrt(g* (1 - g*)) dg* dr (photons: line_profile.h). Here places are found by rays that lead there
 * (kd_disk_image_place), and slopes by their differences. */
#ifndef KD_PHYSICS_TRANSFER_FUNCTION_H
#define KD_PHYSICS_TRANSFER_FUNCTION_H

#include "physics/disk_image.h"

/* Where a ring is bluest and reddest. */
struct kd_transfer_ring {
    double r, g_min, g_max;
    double chi_min, chi_max; /* the angles of disk_image.h there: the far side lies between them about pi/2, the near one about -pi/2 */
};

/* False where a ring shows an energy more than twice, which has not been seen, and where all of it has one: face on. */
bool kd_transfer_ring_of(const struct kd_disk_image *image, double r, struct kd_transfer_ring *ring);

struct kd_transfer {
    double f, mu, alpha, beta;
};
/* 0 < g_star < 1; f to some 1e-6. */
bool kd_transfer_at(const struct kd_disk_image *image, const struct kd_transfer_ring *ring, double g_star, bool far_side, struct kd_transfer *out);

#endif
