/* Illumination of a thin disk by a corona off the axis, and the corona's own light. Double precision; any thread. G = c
 * = M = 1.
 *
 * A corona is made of rings about the axis. A ring lies at height z = r cos theta above the plane and at the distance
 * rho = r sin theta from the axis. Each piece of a ring shines isotropically in its own frame (tetrad.h), with a photon
 * power law N(E) ~ E^-Gamma.
 *
 * A direction is given by two angles in the frame of zero angular momentum: delta is the angle from -e_r, near which
 * the hole is seen, and chi is the angle about -e_r. Light that leaves in the direction (delta, chi) first meets the
 * plane at r(delta, chi), which is found in closed form (null_geodesic.h). A solid angle in this frame is e^2 times the
 * solid angle in the source's frame. Here e is the ratio of a photon's energy in the source's frame to its energy in
 * this frame.
 *
 * Let the source emit one photon per unit of time and energy. Then the gas receives, per comoving area and per unit of
 * time and energy in its own frame,
 *
 *   epsilon(r) = Int |d cos delta/dr| g^(Gamma - 1) e^-2 dchi/(8 pi^2 r u^t_source)     g = u^t_gas (E - Omega L)
 *
 * photons. E and L belong to a photon of unit energy in the source's frame. r dr dphi dt is the comoving area times
 * proper time of the disk. On the axis epsilon is the epsilon of lamppost.h. D. R. Wilkins & A. C. Fabian 2012, MNRAS
 * 424, 1284, compute the same quantity by rays drawn at random.
 *
 * For the same source, the continuum that reaches an observer at infinity directly, per solid angle, is
 *
 *   F = <dOmega_source/dOmega_infinity g^(Gamma - 1)>/(4 pi u^t_source)            g = E
 *
 * where <> is the mean over the azimuth of the ring. */
#ifndef KD_PHYSICS_DISK_CORONA_H
#define KD_PHYSICS_DISK_CORONA_H

#include "base/error.h"
#include "physics/spacetime/hole.h"
#include "physics/spacetime/tetrad.h"

#include <stdbool.h>

/* Motion of a ring. STATIC: at rest. ZAMO: with zero angular momentum. COROTATING: with the angular velocity of the
 * disk's gas at rho; at the ISCO's angular velocity if rho is smaller than the ISCO. */
enum kd_corona_motion { KD_CORONA_STATIC, KD_CORONA_ZAMO, KD_CORONA_COROTATING };

/* Shape of a corona: rings with rho from `inner` to `outer` and z from `height` to `top`, each of which shines in
 * proportion to its circumference. A single ring has outer = inner and top = height. A layer has top = height. */
struct kd_corona_shape {
    double inner, outer, height, top;
    enum kd_corona_motion motion;
};

/* One ring. frame: the frame of zero angular momentum at its place. speed, gamma: the ring's speed towards +phi in this
 * frame, and its Lorentz factor. ut: the ring's u^t. */
struct kd_corona_source {
    double ut, speed, gamma;
    struct kd_tetrad frame;
};

/* Makes a source from its motion and place. Returns false if no ring can have this motion there: the speed would be 1
 * or more, or the place is within KD_CORONA_LEAST times the radius of the ergosphere. */
#define KD_CORONA_LEAST 1.05
/* The smallest ratio of a corona's height to its largest radius that KD_CORONA_ANGLES directions resolve: for a ring,
 * and for other shapes. */
#define KD_CORONA_FLATTEST 0.05
#define KD_CORONA_FLATTEST_SHAPE 0.1
bool kd_corona_source_of(const struct kd_hole *hole, double radius, double height, enum kd_corona_motion motion,
                         struct kd_corona_source *out);

/* Result for a photon that leaves along -cos(delta) e_r + sin(delta) (cos(chi) e_phi - sin(chi) e_theta). log_tangent:
 * ln tan(delta/2). r: radius at which the photon first meets the plane; 0 if the hole captures it, INFINITY if it
 * escapes. energy, momentum: E and L for unit energy in the source's frame. solid: e^-2, the ratio of the solid angle
 * in the source's frame to that in the frame of zero angular momentum. delay: coordinate time to the plane. */
struct kd_corona_photon { double r, energy, momentum, solid, delay; };
struct kd_corona_photon kd_corona_emit(const struct kd_corona_source *source, double log_tangent, double chi);

enum { KD_CORONA_RINGS = 128, KD_CORONA_ANGLES = 1024 };

/* Table of ln epsilon at nodes in r. Nodes are even in s = ln r + asinh((ln r - centre)/width), or in ln r if width is
 * 0. error: relative error of epsilon, estimated as the change when every second angle is left out. */
struct kd_corona_light { double first, step, centre, width, log_epsilon[KD_CORONA_RINGS], error; };
double kd_corona_light_at(const struct kd_corona_light *light, double r);

/* The light of a whole corona, which is the mean over its rings, at radii from inner to outer. inner must be the ISCO
 * or larger. This takes 0.1 s for a ring, and seconds for other shapes; the last 64 results are cached. Errors are
 * those of kd_corona_init. kd_corona_source_of must be true for every ring. */
enum kd_status kd_corona_light_of(const struct kd_hole *hole, const struct kd_corona_shape *shape, double photon_index,
                                  double inner, double outer, struct kd_corona_light *out);

/* Rings that stand for a corona in integrals, by Gauss's rule. The weights add up to 1. Returns the number of rings. */
enum { KD_CORONA_PARTS = 64 };
struct kd_corona_ring { double radius, height, weight; };
int kd_corona_rings(const struct kd_corona_shape *shape, struct kd_corona_ring out[KD_CORONA_PARTS]);

/* The light that one ring of a corona sends to the rings of the disk, for each angle chi. */
struct kd_corona {
    struct kd_corona_light light;
    int angles;
    /* Allocated arrays, indexed by ring of the disk and angle. log_part: ln of the angle's part of epsilon. time:
     * coordinate time from the source to the disk. */
    double *log_part, *time;
};

/* Computes the light at radii from inner, which is the ISCO or larger, to outer. Takes some 30 ms to 1 s. Returns
 * KD_ENOMEM, or KD_EINVAL if, along some chi, photons do not hit a ring of the disk exactly once. This happens for a
 * source that is close both to the hole and to the plane. Call kd_corona_finish in any case. */
enum kd_status kd_corona_init(struct kd_corona *corona, const struct kd_corona_source *source, double photon_index,
                              double inner, double outer);
void kd_corona_finish(struct kd_corona *corona);
/* Writes, for each angle, the part of epsilon and the time of the light at the radius r. */
void kd_corona_parts(const struct kd_corona *corona, double r, double *part, double *time);

/* The light of a ring that reaches an observer at infinity without meeting the plane, computed at `n` azimuths of the
 * ring. */
enum { KD_CORONA_AZIMUTHS = 64 };
struct kd_corona_direct {
    int n;       /* number of azimuths in use; 1 for a source on the axis */
    double flux; /* the flux F that the head of this file defines */
    double g;    /* mean of E, weighted by the flux */
    double time; /* mean coordinate time to the observer minus r_o + 2 ln r_o, weighted by the flux */
    /* for each azimuth: its part of the flux, and the time of its light */
    double part[KD_CORONA_AZIMUTHS], part_time[KD_CORONA_AZIMUTHS];
};
/* Computes the direct light of a ring, in some milliseconds. cos_i must be positive. Returns false if the image of one
 * azimuth is not found. */
bool kd_corona_direct_of(const struct kd_corona_source *source, double photon_index, double cos_i,
                         struct kd_corona_direct *out);

/* The direct light of a whole corona: its flux F, and the mean of E weighted by the flux. */
struct kd_corona_continuum { double flux, g; };
bool kd_corona_continuum_of(const struct kd_hole *hole, const struct kd_corona_shape *shape, double photon_index,
                            double cos_i, struct kd_corona_continuum *out);

#endif
