/* Course of a null geodesic of Kerr as a list of places, for drawing. The course is integrated in steps of Mino time,
 * in double precision. This code shares no formula of the motion with the closed form of null_geodesic.h, and must give
 * the same crossings as the closed form. Units G = c = M = 1, E = 1. Pure functions, any thread.
 *
 * With w = 1/r, and a unit vector n towards the direction (theta, psi), where psi is the azimuth without frame
 * dragging, the equations are
 *
 *   w'' = A w + 3K w^2 + 2C w^3                     w'^2 = 1 + A w^2 + 2K w^3 + C w^4
 *   n'' = a^2 n_z e_z - (eta + lambda^2 + 2 a^2 n_z^2) n      n'^2 = eta + lambda^2 + a^2 n_z^2,  (n x n')_z =
 *     lambda
 *   chi' = a w (2 - (q^2 + a lambda) w)/D,   D = 1 - 2w + (a^2 + q^2) w^2
 *
 * (Carter 1968; A, K, C of null_quartic.h), which is regular on the axis and at infinity. The time, t'
 * = 1/w^2 + 2/w + 4 - q^2 + ((8 - 4q^2 - 2a lambda) w + (q^2 (q^2 + a lambda - 4) - 4a^2) w^2)/D + a^2 n_z^2 (Gralla &
 * Lupsasca 2020, arXiv:1910.12881, eqs. 6-8, with 2r - q^2 for 2r), is integrated without its first two terms, by
 *   1/w^2 = (-w'/w)' + K w + C w^2,   1/w = -s (ln((1 + s w')/w))' + w^2 (K + C w)/(1 + s w'),   s = 1 on the way
 *                                     in, -1 on the way out.
 *
 * A ray that is followed back out of the horizon has no Boyer-Lindquist azimuth and time there. Instead those of
 * ingoing coordinates are used, phi + Int a/Delta dr and t + Int (2r - q^2)/Delta dr. With W = 1 + (a^2 - a lambda)
 * w^2, w'^2 = W^2 - D k w^2, k = eta + (lambda - a)^2, and s the sign of the energy at infinity,
 *
 *   chi' = a (G - 1),   t' = 1/w^2 + a^2 n_z^2 + (2/w - q^2) G,   G = (W + s w')/D = k w^2/(W - s w'):
 *
 * regular at the horizon for light that comes from outside, s W > 0 there. */
#ifndef KD_PHYSICS_NULL_NULL_COURSE_H
#define KD_PHYSICS_NULL_NULL_COURSE_H

#include "physics/null/null_geodesic.h"

#include <stddef.h>

/* A place of the ray. mino: Mino time since the observer. phi, delay: as in null_geodesic.h. order: number of crossings
 * between the place and the observer. crossing: if this place is itself a crossing of the plane, the number of that
 * crossing; otherwise -1. */
struct kd_null_place {
    double mino, r, u, phi, delay;
    int order, crossing;
};

struct kd_null_course {
    size_t n, steps; /* n: number of places. steps: number of integrator steps, several for each place */
    enum {
        KD_COURSE_NONE,
        KD_COURSE_CAPTURED,
        KD_COURSE_ESCAPED,
        KD_COURSE_LONG
    } end;          /* NONE: no such ray exists. LONG: the ray has more places than `out` has room for */
    double least_r; /* smallest r over all places, including the turning point */
    double drift;   /* largest error of the first integrals, relative to their terms */
};

/* Computes the places of the ray traced back. The first place is the observer's or, if the observer is beyond r = far,
 * where the ray comes within it. The last place is beyond both `far` and the observer, or within `near` (M) of the
 * horizon. Neighbouring places are at most 0.03 rad apart in direction. Every crossing of the plane is among the
 * places. out: memory for `most` places. */
struct kd_null_course kd_null_course_of(const struct kd_null_ray *ray, double far, double near,
                                        struct kd_null_place *out, size_t most);

/* Like kd_null_course_of, but azimuth and time are ingoing, and the observer may be anywhere outside the inner horizon.
 * reversed: true if the labels belong to a ray with negative energy at infinity, whose azimuth and time run opposite to
 * those of a ray with positive energy. The fate is CAPTURED if the ray traced back does not lead outside but ends at
 * the horizon from within. far may be INFINITY: the last place of an escaping ray is then at infinity and has its
 * direction. */
struct kd_null_course kd_null_course_ingoing(const struct kd_null_ray *ray, bool reversed, double far, double near,
                                             struct kd_null_place *out, size_t most);

#endif
