/* These give cosine and sine of degrees to two units in the last place wherever they are small: cos(x * (M_PI /
 * 180)) next to 90 degrees has only the digits that rounding of the radians leaves, thirteen of them at 89.9. Whole
 * quarter turns are exact. Double precision; pure; any thread. */
#ifndef KD_PHYSICS_MATH_ANGLE_H
#define KD_PHYSICS_MATH_ANGLE_H

double kd_cos_deg(double degrees);
double kd_sin_deg(double degrees);

#endif
