/* The particles that fall have one curve for all (physics/orbit/plunge.h), from a thirty-second of the way between the
 * ISCO and the horizon to all but a sixty-fourth of it, again and again. At its ends the curve takes for ever. Where
 * it starts here gas falls at 1e-3 without spin, at 7e-4 for a = 0.9, about as fast as a disk of alpha = 0.1 and h/r
 * = 0.1 drifts, alpha (h/r)^2 v_phi (Shakura & Sunyaev 1973), and goes round 3 times (a = 0), 7 (0.9) or 38 (0.998)
 * before it is gone; W. J. Potter 2021, arXiv:2104.09951, finds 4 to 17 for turbulent gas. Where it ends light that
 * gets away comes with g < 0.02, and less than 1e-6 of its brightness.
 *
 * A steady stream is uniform in time, so a particle is its phase, the share of the curve's time that has passed. The
 * gas leaves the ISCO turning with it; its azimuth there, kept as that of the orbit goes on, is the other coordinate
 * in which a parcel of it stands still. On such a grid each cell is a parcel, which is drawn out as it falls, and
 * its surface density is 1/(r |u^r|) times what is conserved (mass: I. D. Novikov & K. S. Thorne 1973). Double
 * precision, pure, any thread. */
#ifndef KD_RENDER_EMIT_PLUNGING_H
#define KD_RENDER_EMIT_PLUNGING_H

#include "physics/orbit/plunge.h"
#include "scene/scene.h"

#include <stdbool.h>

/* Says whether the scene has any: a disk of particles that reaches the ISCO, and a share of them. */
bool kd_plunging_is_on(const struct kd_scene *scene);

struct kd_plunging {
    struct kd_plunge curve;
    double start, end;            /* radii */
    double time, omega;           /* from start to end; angular velocity at the ISCO */
    struct kd_plunge_event first; /* of the curve at its start */
};
struct kd_plunging kd_plunging_of(const struct kd_scene *scene);

/* Gives the place at start >= r >= end: phase from 0 to 1; azimuth in turns, less what the orbit at the ISCO has
 * turned since the start. */
struct kd_plunging_place { double phase, turns; };
struct kd_plunging_place kd_plunging_at(const struct kd_plunging *plunging, double r);

/* Goes the other way round, for many phases: cubics between points whose slopes are known; r within 1e-9. */
#define KD_PLUNGING_POINTS 1025
struct kd_plunging_path {
    struct { double r, turns, r_slope, turns_slope; } at[KD_PLUNGING_POINTS];
};
void kd_plunging_path(const struct kd_plunging *plunging, struct kd_plunging_path *out);
double kd_plunging_radius(const struct kd_plunging_path *path, double phase, double *turns);

#endif
