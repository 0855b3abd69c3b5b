/* This is the profile of a narrow line that the gas of a thin disk emits, as an observer at infinity sees it: how
 * many of its photons arrive at which energy, over the energy that they have for the gas. Double precision; any
 * thread. G = c = M = 1.
 *
 * The gas goes round on circular orbits from `inner` >= ISCO to `outer` and emits epsilon(r) f(mu) photons per time,
 * solid angle and area *across the light* (an intensity: per area of the disk there is mu times as much), mu the
 * cosine off the normal. Since I_nu/nu^3 is the same all along a ray, what arrives from an area of the image plane
 * is (Cunningham 1975, ApJ 202, 788)
 *
 *   dN = g^3 epsilon(r) f(mu) dalpha dbeta        at E = g E0
 *
 * photons, and g times as much energy. The disk's image (disk_image.h) is cut into cells between two rings and two
 * directions, over each of which g is linear, of the mean and the steps that it has there, weighed by light: the
 * share of a cell below an energy is then made of two squares and a straight line, and a bin has it exactly, however
 * narrow. */
#ifndef KD_PHYSICS_DISK_LINE_PROFILE_H
#define KD_PHYSICS_DISK_LINE_PROFILE_H

#include "base/error.h"
#include "physics/disk/disk_image.h"

enum kd_line_emissivity { KD_LINE_POWER, KD_LINE_BROKEN, KD_LINE_LAMPPOST };
/* f(mu): 1; 1 + 2.06 mu (Laor 1991, ApJ 376, 90); ln(1 + 1/mu) (Haardt 1993, ApJ 413, 680). */
enum kd_line_limb { KD_LIMB_ISOTROPIC, KD_LIMB_LAOR, KD_LIMB_HAARDT };

struct kd_line_params {
    double inner, outer;
    enum kd_line_emissivity emissivity;
    double index;                /* POWER and BROKEN: epsilon = r^-index, of BROKEN out to break_r */
    double outer_index, break_r; /* BROKEN: (r/break_r)^-outer_index beyond, without a jump */
    double height, photon_index; /* LAMPPOST: epsilon is taken to be proportional to what the disk receives */
    enum kd_line_limb limb;
    bool energy;      /* energies, not photon numbers */
    double tolerance; /* of the cumulative share: the sum is not made finer than this takes, by what is estimated; 0: as
                         fine as there is */
};

struct kd_line_profile {
    double total; /* in units of epsilon M^2, all energies: what the last two sums, each twice as close as the one
                     before, tend to */
    double error; /* estimated, of the cumulative share at any edge, the largest: from what half as many rings and
                     angles, and nodes of the table, change */
};

/* share[i]: of the total, between edges[i] and edges[i + 1], i < bins; edges grow, in units of E0. KD_ENOMEM;
 * KD_EINVAL: the lamp lights no such ring, or what came out is no number. */
enum kd_status kd_line_profile(const struct kd_disk_image *image, const struct kd_line_params *params,
                               const double *edges, int bins, double *share, struct kd_line_profile *profile,
                               struct kd_error *error);

double kd_line_limb(enum kd_line_limb limb, double mu);

#endif
