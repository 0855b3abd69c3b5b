/* The particles that fall from the ISCO. All follow one curve (physics/orbit/plunge.h), again and again. A particle
 * would take infinite time at both ends of the curve. So particles start after 1/32 of the way from the ISCO to the
 * horizon, and end when 1/64 of the way is left. At the start gas falls at 1e-3 c without spin and at 7e-4 c for a =
 * 0.9. This speed is about the drift alpha (h/r)^2 v_phi of a disk of alpha = 0.1 and h/r = 0.1 (Shakura & Sunyaev
 * 1973). A particle orbits the hole 3 times (a = 0), 7 times (0.9) or 38 times (0.998) before its end; W. J. Potter
 * 2021, arXiv:2104.09951, finds 4 to 17 times for turbulent gas. Light that escapes from the end has g < 0.02 and less
 * than 1e-6 of its brightness.
 *
 * A steady stream is uniform in time. So a particle's first coordinate is its phase: the fraction of the curve's time
 * that has passed. The second is its azimuth at the ISCO, in the frame that rotates with that orbit. A parcel of gas is
 * at rest in both coordinates. On such a grid each cell is a parcel that is stretched as it falls. The surface density
 * of the parcel is 1/(r |u^r|) times a conserved quantity (mass: I. D. Novikov & K. S. Thorne 1973). Double precision,
 * pure, any thread. */
#ifndef KD_RENDER_EMIT_PLUNGING_H
#define KD_RENDER_EMIT_PLUNGING_H

#include "physics/orbit/plunge.h"
#include "scene/scene.h"

#include <stdbool.h>

/* True if some particles fall. The disk must be made of particles and reach the ISCO, and the fraction of falling
 * particles must be above 0. */
bool kd_plunging_is_on(const struct kd_scene *scene);

struct kd_plunging {
    struct kd_plunge curve;
    double start, end;            /* radii of the curve's start and end */
    double time, omega;           /* time: from start to end; omega: angular velocity at the ISCO */
    struct kd_plunge_event first; /* the event at which the curve starts */
};
struct kd_plunging kd_plunging_of(const struct kd_scene *scene);

/* Place at a radius r, start >= r >= end. phase: 0 at the start to 1 at the end. turns: azimuth in turns, minus the
 * turns that the orbit at the ISCO has made since the start. */
struct kd_plunging_place { double phase, turns; };
struct kd_plunging_place kd_plunging_at(const struct kd_plunging *plunging, double r);

/* kd_plunging_radius converts a phase to a place. It is the inverse of kd_plunging_at for many phases: kd_plunging_path
 * makes a table of points with known slopes, and cubics interpolate between the points. r is accurate to 1e-9. */
#define KD_PLUNGING_POINTS 1025
struct kd_plunging_path {
    struct { double r, turns, r_slope, turns_slope; } at[KD_PLUNGING_POINTS];
};
void kd_plunging_path(const struct kd_plunging *plunging, struct kd_plunging_path *out);
double kd_plunging_radius(const struct kd_plunging_path *path, double phase, double *turns);

#endif
