/* This is the direct image of the equatorial plane outside the ISCO, for an observer at infinity, as a table that is
 * made once for a spin and an inclination: where on the image plane each ring is seen. What a thin disk's light adds
 * up to (line_profile.h, transfer_function.h, disk_spectrum.h) is an integral over it. Double precision; pure but
 * for the table, any thread. G = c = M = 1.
 *
 * A ring of radius r is told by how far its image lies from a centre, in units of an ellipse that is about as large:
 *
 *   (alpha, beta) = (x0, y0(r)) + R(r, chi) (A(r) cos chi, B(r) sin chi)
 *
 * R is smooth and near 1, and is found at nodes in chi and in u = ((r_isco - r')/(r - r'))^(1/4), r' the horizon but
 * for holes next to extremal ones, by a root in r of the ray that is followed in closed form (null_radial.h,
 * docs/decisions/0001); between nodes it is interpolated. The disk is opaque and infinitely thin: image order 0
 * alone. */
#ifndef KD_PHYSICS_DISK_DISK_IMAGE_H
#define KD_PHYSICS_DISK_DISK_IMAGE_H

#include "physics/spacetime/hole.h"

#include <stdbool.h>

enum {
    KD_DISK_IMAGE_RINGS = 24,   /* between infinity and the ISCO */
    KD_DISK_IMAGE_ANGLES = 512, /* nodes round a ring, at most */
};

#define KD_DISK_IMAGE_EDGE_ON \
    3 /* degrees from edge on within which there is no table: the image of the far side is not resolved */

struct kd_disk_image {
    double spin, cos_i, sin_i; /* cos_i > 0: from below the disk looks as from above */
    double isco, horizon, origin;
    int angles;                                                      /* 64 to 512: more towards edge on */
    double cosine[KD_DISK_IMAGE_ANGLES], sine[KD_DISK_IMAGE_ANGLES]; /* of directions */
    double stretch[KD_DISK_IMAGE_RINGS + 1][KD_DISK_IMAGE_ANGLES];   /* R; row 0: infinity; the last row: the ISCO */
};

/* inclination in radians, 0 to pi; false next to edge on, and where a ring is not found, which has not been seen. 1
 * 600 to 19 000 rays: most nodes take one, since rings and angles before tell where they are and how r changes
 * there. */
bool kd_disk_image_init(struct kd_disk_image *image, const struct kd_hole *hole, double inclination);

/* A ring seen in `n` directions, evenly spaced in chi; n is a power of 2, 32 at least and KD_DISK_IMAGE_ANGLES at
 * most. `skip` 1 uses every node of the table and 2 every second one: by how much that differs tells the error of
 * the table. r >= ISCO. */
void kd_disk_image_ring(const struct kd_disk_image *image, double r, int skip, int n, double *alpha, double *beta);

/* A step of ln r for differences at a ring: `share` of the way to the horizon, so that one inwards from the ISCO
 * stays outside it, whatever the spin. */
double kd_disk_image_step(const struct kd_disk_image *image, double r, double share);

/* The place of a ring at one angle, by a ray that leads there to 1e-12 of r instead of by interpolation; also a
 * little within the ISCO. False where it is not found. */
bool kd_disk_image_place(const struct kd_disk_image *image, double r, double chi, double *alpha, double *beta);

/* The radius at which the ray seen at (alpha, beta) meets the plane first; 0: it is captured before; INFINITY: it
 * leaves. Closed form, a microsecond. */
double kd_disk_image_radius(const struct kd_disk_image *image, double alpha, double beta);

/* Redshift factor of the light of a ring on a circular orbit seen at alpha, and the cosine of the angle off the
 * disk's normal at which it leaves the gas: g sqrt(eta)/r (Cunningham & Bardeen 1973, ApJ 183, 237). */
struct kd_disk_ring { double r, ut, omega; };
struct kd_disk_ring kd_disk_image_gas(const struct kd_disk_image *image, double r);
static inline double kd_disk_image_redshift(const struct kd_disk_image *image, const struct kd_disk_ring *gas,
                                            double alpha)
{
    return 1 / (gas->ut * (1 + gas->omega * alpha * image->sin_i)); /* lambda = -alpha sin i */
}
struct kd_disk_light { double g, mu; };
struct kd_disk_light kd_disk_image_light(const struct kd_disk_image *image, const struct kd_disk_ring *gas,
                                         double alpha, double beta);

#endif
