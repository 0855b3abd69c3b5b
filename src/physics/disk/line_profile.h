/* Profile of a narrow emission line of a thin disk's gas, as an observer at infinity sees it. The profile is the number
 * of photons by energy, in units of the energy in the gas's frame. Double precision; any thread. G = c = M = 1.
 *
 * The gas moves on circular orbits from `inner` >= ISCO to `outer`. It emits epsilon(r) f(mu) photons per time, solid
 * angle and area across the light. mu is the cosine of the angle between light and normal; per area of the disk, the
 * number of photons is mu epsilon f. Since I_nu/nu^3 is constant along a ray, an area of the image plane receives
 * (Cunningham 1975, ApJ 202, 788)
 *
 *   dN = g^3 epsilon(r) f(mu) dalpha dbeta        at E = g E0
 *
 * photons, each with the energy g E0. The disk's image (disk_image.h) is divided into cells between two rings and two
 * directions. Within a cell g is taken as linear, with the cell's light-weighted mean and differences of g. The
 * fraction of a cell's light below an energy is then a quadratic function at both ends and a linear one between them.
 * So the light of a cell is divided among bins exactly, however narrow the bins are. Next to edge-on, where the image
 * has no table, the cells are those of its columns (disk_columns.h), and both faces of the disk count. */
#ifndef KD_PHYSICS_DISK_LINE_PROFILE_H
#define KD_PHYSICS_DISK_LINE_PROFILE_H

#include "base/error.h"
#include "physics/disk/corona.h"
#include "physics/disk/disk_image.h"
#include "physics/disk/limb.h"

enum kd_line_emissivity { KD_LINE_POWER, KD_LINE_BROKEN, KD_LINE_LAMPPOST, KD_LINE_RING, KD_LINE_DISK, KD_LINE_SLAB };

struct kd_line_params {
    double inner, outer;
    enum kd_line_emissivity emissivity;
    double index;                /* for POWER and BROKEN: epsilon = r^-index (for BROKEN, up to break_r) */
    double outer_index, break_r; /* for BROKEN, beyond break_r: epsilon ~ r^-outer_index, continuous at break_r */
    /* For LAMPPOST: epsilon is proportional to the light that the disk receives from a lamp at `height`. For RING, DISK
     * and SLAB: epsilon is proportional to the light that it receives from the corona. */
    double height, photon_index;
    struct kd_corona_shape corona;
    enum kd_limb limb;
    bool energy; /* true if the profile counts energies instead of photons */
    /* Largest allowed error of the cumulative share. The sum is refined until its estimated error is smaller. If the
     * tolerance is 0, the sum is the finest possible one. */
    double tolerance;
};

struct kd_line_profile {
    /* The sum over all energies, in units of epsilon M^2. It is extrapolated from the last two sums, of which the
     * second has twice the resolution of the first. */
    double total;
    /* Largest error of the cumulative share at an edge. It is estimated from the change of the share when rings, angles
     * and nodes of the table are halved in number. */
    double error;
};

/* Computes a profile. edges: ascending energies in units of E0. share[i], i < bins: fraction of the total between
 * edges[i] and edges[i + 1]. Returns KD_ENOMEM, or KD_EINVAL if the lamp's light does not reach a ring, or if the
 * result is not a number. */
enum kd_status kd_line_profile(const struct kd_disk_image *image, const struct kd_line_params *params,
                               const double *edges, int bins, double *share, struct kd_line_profile *profile,
                               struct kd_error *error);

#endif
