/* Where a listed ray starts in Cartesian ingoing Kerr-Schild coordinates of the mirrored spacetime (t, phi) -> (-t, -phi), in
 * which a ray that is traced back is a photon that flies away from the observer. Double precision, pure, any thread. */
#ifndef KD_RENDER_RAYS_START_H
#define KD_RENDER_RAYS_START_H

/* a; r and cosine and sine of the observer's polar angle; labels as in render/rays.h. r = INFINITY: the start is at `far`,
 * reached from infinity by a series to second order in 1/far: its error is of order (b/far)^3. A finite observer must not
 * sit on the axis. out: x, y, z, p_x, p_y, p_z with E = 1. */
void kd_rays_start(double a, double r, double u, double s, double alpha, double beta, double far, double out[6]);

#endif
