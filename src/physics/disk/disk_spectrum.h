/* Spectrum of a thin disk of black bodies, as a distant observer receives it. Double precision; any thread.
 *
 *   F_nu = (M/D)^2 Int g^3 B_nu(nu/g, f T)/f^4 limb(mu) dalpha dbeta      sigma T^4 = F(r)
 *
 * (Li et al. 2005, ApJS 157, 335, eq. 6). F is the flux of Page & Thorne 1974, ApJ 191, 499 (thin_disk.h), or the flux
 * of a disk with returning light (returning.h). The disk begins at the ISCO or beyond. f is the colour correction
 * (Shimura & Takahara 1995, ApJ 445, 780), which leaves the total energy of the light unchanged. The integral over the
 * disk's image (disk_image.h) uses even steps in chi, which converge exponentially, and Gauss points in the square root
 * of ln(r/inner). Next to edge-on, where the image has no table, it uses columns, and both faces of the disk count
 * (disk_columns.h). */
#ifndef KD_PHYSICS_DISK_DISK_SPECTRUM_H
#define KD_PHYSICS_DISK_DISK_SPECTRUM_H

#include "base/error.h"
#include "physics/disk/line_profile.h"
#include "physics/disk/returning.h"

struct kd_disk_spectrum_params {
    double inner, outer;                     /* M */
    double mass_msun, distance_pc, mdot_edd; /* mdot_edd: accretion rate as in thin_disk.h */
    double colour_correction;
    enum kd_limb limb; /* law of limb darkening, normalised so that a face radiates F: Int limb mu dmu = 1/2 */
    /* table of a disk with returning light that gives F, for the same hole and limb; NULL if F is Page & Thorne's flux
     * */
    const struct kd_returning *returning;
};

/* A place of the disk's image, and the area of the image plane that it represents, M^2. */
struct kd_disk_place { double r, alpha, beta, area; };
/* Calls each(user, place) for all places of the integral, ring after ring. */
void kd_disk_places(const struct kd_disk_image *image, double inner, double outer,
                    void (*each)(void *user, const struct kd_disk_place *place), void *user);

/* Computes a spectrum. flux: flux at each of n frequencies (Hz), in W m^-2 Hz^-1. *error_out: largest relative error at
 * frequencies whose flux exceeds 1e-6 of the maximum, estimated as the change from a sum with half as many points.
 * Returns KD_ENOMEM, or KD_EINVAL if the result is not a number. */
enum kd_status kd_disk_spectrum(const struct kd_disk_image *image, const struct kd_disk_spectrum_params *params,
                                const double *frequencies, int n, double *flux, double *error_out,
                                struct kd_error *error);

#endif
