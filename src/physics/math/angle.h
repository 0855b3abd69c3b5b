/* Cosine and sine of angles in degrees, to two ulp even where they are small. cos(x * (M_PI / 180)) loses digits near
 * 90 degrees, because the radians are rounded: at 89.9 degrees it has only thirteen correct digits. Here quarter turns
 * are exact. Double precision; pure; any thread. */
#ifndef KD_PHYSICS_MATH_ANGLE_H
#define KD_PHYSICS_MATH_ANGLE_H

double kd_cos_deg(double degrees);
double kd_sin_deg(double degrees);

#endif
