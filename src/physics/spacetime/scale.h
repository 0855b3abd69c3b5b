/* Converts M to metres, seconds and angles on the sky, for real holes. Double precision, pure, any thread. Masses are
 * in solar masses (IAU 2015 nominal), distances in parsecs. Constants are those of physics/math/constants.h. */
#ifndef KD_PHYSICS_SPACETIME_SCALE_H
#define KD_PHYSICS_SPACETIME_SCALE_H

/* The unit M. kd_scale_metres: the length G m/c^2 in metres. kd_scale_seconds: the time G m/c^3 in seconds.
 * kd_scale_microarcseconds: the angle of this length on the sky in microarcseconds. */
double kd_scale_metres(double mass_msun);
double kd_scale_seconds(double mass_msun);
double kd_scale_microarcseconds(double mass_msun, double distance_pc);

/* Proper time from the horizon to the singularity for a = 0, in M. KD_SCALE_FALL: for a fall from rest at infinity,
 * 4/3, which is the integral of dr/sqrt(2/r) from 0 to 2. KD_SCALE_FALL_LONGEST: the maximum, pi, for a fall from rest
 * at the horizon (Misner, Thorne & Wheeler 1973, ch. 31). */
#define KD_SCALE_FALL (4. / 3)
#define KD_SCALE_FALL_LONGEST M_PI

/* Holes with measured rings. Errors are one sigma.
 *
 * M87*: Event Horizon Telescope Collaboration 2019, ApJL 875, L1 (ring 42 +- 3 uas; M = 6.5 +- 0.7 1e9, D = 16.8 +-
 * 0.8 Mpc). Sgr A*: ring 51.8 +- 2.3 uas, EHT Collaboration 2022, ApJL 930, L12; M = 4.297 +- 0.012 1e6 and D = 8277
 * +- 9 pc, GRAVITY Collaboration 2022, A&A 657, L12. */
struct kd_scale_hole {
    const char *name;
    double mass_msun, distance_pc, ring_uas, ring_error_uas;
};
extern const struct kd_scale_hole kd_scale_holes[];
/* Masses and distances of these holes as tokens, because the presets write them as text (scene/presets.c). */
#define KD_SCALE_M87_MSUN 6.5e9
#define KD_SCALE_M87_PC 16.8e6
#define KD_SCALE_SGRA_MSUN 4.297e6
#define KD_SCALE_SGRA_PC 8277
enum { KD_SCALE_M87, KD_SCALE_SGRA, KD_SCALE_HOLES };

#endif
