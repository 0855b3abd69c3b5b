/* The echo of a flash on a thin disk: a narrow line of the disk's gas by energy and time. Double precision; any thread.
 * G = c = M = 1.
 *
 * A ring of a corona (corona.h) flashes at one coordinate time. Its light takes the time t_1 to the disk. The gas there
 * at once emits a line in proportion to the light that it receives. The line's light takes the time t_2 to the
 * observer. With epsilon(r, t_1) of corona.h, the observer receives (line_profile.h)
 *
 *   dN = g^3 epsilon(r, t_1) f(mu) dt_1 dalpha dbeta       at E = g E0 and t = t_1 + t_2 - t_0
 *
 * photons. t_0 is the mean time of arrival of the direct light. The rays are exact: t_1 and t_2 are coordinate
 * times in closed form (null_geodesic.h). Reverberation: P. Uttley et al. 2014, A&ARv 22, 72; C. S. Reynolds et al.
 * 1999, ApJ 514, 164. */
#ifndef KD_PHYSICS_DISK_ECHO_H
#define KD_PHYSICS_DISK_ECHO_H

#include "base/error.h"
#include "physics/disk/corona.h"
#include "physics/disk/disk_image.h"
#include "physics/disk/limb.h"

#include <stddef.h>

struct kd_echo_params {
    double inner, outer, photon_index;
    enum kd_limb limb;
    struct kd_corona_source source;
};

struct kd_echo {
    struct kd_corona_direct direct;
    /* Equivalent width of the line at infinity over its equivalent width in the gas's frame. The gas emits one photon
     * of the line for each photon of the continuum per unit of energy that it receives. */
    double strength;
    /* mean and error are set by kd_echo_impulse only. mean: mean arrival time of all photons of the line, after t_0.
     * error: estimated from sums over every second ring and direction. */
    double mean, error;
};

/* share[i * times + k]: share of the line's photons between the energies edges[i] and edges[i + 1], in units of E0, and
 * the times first + k step and first + (k + 1) step. error: largest error of the cumulative share, which is the sum
 * from the first energy and time. KD_ENOMEM; KD_EINVAL: the source's light does not reach a ring or the observer. */
enum kd_status kd_echo_impulse(const struct kd_disk_image *image, const struct kd_echo_params *params,
                               const double *edges, size_t bins, double first, double step, size_t times, double *share,
                               struct kd_echo *echo, struct kd_error *error);

/* Fourier transforms of the line's photons between two edges: Int exp(2 pi i f t) dN over all photons of the line, at
 * frequencies in 1/M. part[2 (i n + k)] and the next number are the real and the imaginary part of bin i at frequency
 * k. coarse: the same from sums over every second ring and direction. */
enum kd_status kd_echo_transform(const struct kd_disk_image *image, const struct kd_echo_params *params,
                                 const double *edges, size_t bins, const double *frequencies, size_t n, double *part,
                                 double *coarse, struct kd_echo *echo, struct kd_error *error);

/* The same transform of the direct light, as a mean over its photons. */
void kd_echo_direct(const struct kd_corona_direct *direct, double frequency, double part[2]);

#endif
