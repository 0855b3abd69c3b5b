/* Direct image of the equatorial plane outside the ISCO for an observer at infinity. A table, made once for a spin and
 * an inclination, gives the place of each ring on the image plane. The light of a thin disk (line_profile.h,
 * transfer_function.h, disk_spectrum.h) is an integral over this image. Double precision. Any thread. The functions are
 * pure, except the one that makes the table. G = c = M = 1.
 *
 * The image of a ring of radius r is given by its distance from a centre, in units of an ellipse of about its size:
 *
 *   (alpha, beta) = (x0, y0(r)) + R(r, chi) (A(r) cos chi, B(r) sin chi)
 *
 * R is smooth and near 1. It is computed at nodes in chi and in u = ((r_isco - r')/(r - r'))^(1/4), where r' is the
 * horizon except next to extremal holes. At a node, R is the value for which the ray in closed form (null_radial.h,
 * docs/decisions/0001) meets the plane at r. Between nodes R is interpolated. The disk is opaque and infinitely thin,
 * so that only image order 0 is visible. */
#ifndef KD_PHYSICS_DISK_DISK_IMAGE_H
#define KD_PHYSICS_DISK_DISK_IMAGE_H

#include "physics/spacetime/hole.h"

#include <stdbool.h>

enum {
    KD_DISK_IMAGE_RINGS = 24,   /* number of intervals between the rings from infinity to the ISCO */
    KD_DISK_IMAGE_ANGLES = 512, /* largest number of nodes round a ring */
};

#define KD_DISK_IMAGE_EDGE_ON \
    3 /* degrees from edge-on within which there is no table, because the image of the far side is not resolved; \
         disk_columns.h has that image */

struct kd_disk_image {
    struct kd_hole hole;
    /* cosine and sine of the inclination; cos_i >= 0, because the disk looks the same from below as from above */
    double cos_i, sin_i;
    double isco, horizon, origin;
    /* number of nodes round a ring: from 64 to 512 near edge-on; 0 if there is no table */
    int angles;
    double cosine[KD_DISK_IMAGE_ANGLES], sine[KD_DISK_IMAGE_ANGLES]; /* cosine and sine of chi for each node */
    /* R at the nodes. Row 0 is the ring at infinity, and the last row is the ISCO. */
    double stretch[KD_DISK_IMAGE_RINGS + 1][KD_DISK_IMAGE_ANGLES];
};

/* Makes the table. inclination: radians, 0 to pi. Next to edge-on there is no table; then only the functions below that
 * trace a ray instead of interpolating may be called. Returns false if a ring was not found, which has not been
 * observed. The table takes 1 600 to 19 000 rays. Most nodes take one ray, because preceding rings and angles predict
 * their places and slopes. */
bool kd_disk_image_init(struct kd_disk_image *image, const struct kd_hole *hole, double inclination);

/* A ring's image in `n` directions, evenly spaced in chi. r must be at least the ISCO. n must be a power of 2 from 32
 * to KD_DISK_IMAGE_ANGLES. skip: 1 uses every node of the table, 2 every second one; the difference of the two results
 * estimates the table's error. */
void kd_disk_image_ring(const struct kd_disk_image *image, double r, int skip, int n, double *alpha, double *beta);

/* A step in ln r for finite differences at a ring. The step is `share` of the distance to the horizon, so that a step
 * inwards from the ISCO stays outside the horizon at any spin. */
double kd_disk_image_step(const struct kd_disk_image *image, double r, double share);

/* The image of a ring at one angle, found by a ray instead of interpolation. The ray meets the ring to 1e-12 of r. r
 * may be a little less than the ISCO. Returns false if no ray is found. */
bool kd_disk_image_place(const struct kd_disk_image *image, double r, double chi, double *alpha, double *beta);

/* The radius at which the ray seen at (alpha, beta) first meets the plane; 0 if the ray is captured before that,
 * INFINITY if it escapes. It is computed in closed form, in a microsecond. */
double kd_disk_image_radius(const struct kd_disk_image *image, double alpha, double beta);

/* Light from a ring of gas on circular orbits, seen at alpha: its redshift factor g, and the cosine mu of the angle
 * between the light and the disk's normal in the gas's frame. mu is g sqrt(eta)/r (Cunningham & Bardeen 1973, ApJ 183,
 * 237). */
struct kd_disk_ring { double r, ut, omega; };
struct kd_disk_ring kd_disk_image_gas(const struct kd_disk_image *image, double r);
static inline double kd_disk_image_redshift(const struct kd_disk_image *image, const struct kd_disk_ring *gas,
                                            double alpha)
{
    return 1 / (gas->ut * (1 + gas->omega * alpha * image->sin_i)); /* here lambda = -alpha sin i was used */
}
struct kd_disk_light { double g, mu; };
struct kd_disk_light kd_disk_image_light(const struct kd_disk_image *image, const struct kd_disk_ring *gas,
                                         double alpha, double beta);

#endif
