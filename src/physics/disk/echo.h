/* The echo of a flash on a thin disk: a narrow line of the disk's gas by energy and time. Double precision; any thread.
 * G = c = M = 1.
 *
 * A ring of a corona (corona.h) flashes at one coordinate time. Its light takes the time t_1 to the disk. When the
 * light arrives, the gas immediately emits a line, in proportion to the light that it receives. The line's light takes
 * the time t_2 to the observer. With epsilon(r, t_1) of corona.h, the observer receives (line_profile.h)
 *
 *   dN = g^3 epsilon(r, t_1) f(mu) dt_1 dalpha dbeta       at E = g E0 and t = t_1 + t_2 - t_0
 *
 * photons. t_0 is the mean time of arrival of the direct light. The rays are exact: t_1 and t_2 are coordinate times in
 * closed form (null_geodesic.h). For reverberation see P. Uttley et al. 2014, A&ARv 22, 72, and C. S. Reynolds et al.
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
    /* Ratio of the line's equivalent width at infinity to its equivalent width in the gas's frame. The gas emits one
     * photon of the line for each photon of the continuum that it receives per unit of energy. */
    double strength;
    /* Members that only kd_echo_impulse sets. mean: mean time, after t_0, at which photons of the line arrive. error:
     * error estimated from sums over every second ring and direction. */
    double mean, error;
};

/* Computes the impulse response. share[i * times + k]: share of the line's photons between the energies edges[i] and
 * edges[i + 1], in units of E0, and between the times first + k step and first + (k + 1) step. The member `error` of
 * the echo is the largest error of the cumulative share, which is the sum from the first energy and time. Returns
 * KD_ENOMEM, or KD_EINVAL if the source's light does not reach a ring or the observer. */
enum kd_status kd_echo_impulse(const struct kd_disk_image *image, const struct kd_echo_params *params,
                               const double *edges, size_t bins, double first, double step, size_t times, double *share,
                               struct kd_echo *echo, struct kd_error *error);

/* Fourier transforms of the light in each bin of energy, at frequencies in 1/M. A transform is Int exp(2 pi i f t) dN
 * over the photons in the bin, divided by the number of all photons of the line. part[2 (i n + k)] and the next number
 * are the real and the imaginary part of bin i at frequency k. coarse: the same numbers from sums over every second
 * ring and direction. */
enum kd_status kd_echo_transform(const struct kd_disk_image *image, const struct kd_echo_params *params,
                                 const double *edges, size_t bins, const double *frequencies, size_t n, double *part,
                                 double *coarse, struct kd_echo *echo, struct kd_error *error);

/* Fourier transform of the direct light, as a mean over its photons. */
void kd_echo_direct(const struct kd_corona_direct *direct, double frequency, double part[2]);

#endif
