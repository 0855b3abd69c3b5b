#include "physics/math/angle.h"

#include <math.h>

/* Removes quarter turns from an angle in degrees, where this is exact, and returns the cosine or the sine of the
 * result. first: 0 for sines, 1 for cosines, which are a quarter turn ahead. Adding 0 avoids a negative zero. */
static double turned(double degrees, int first)
{
    int quarter;
    double rest = remquo(degrees, 90, &quarter) * (M_PI / 180);
    switch ((quarter + first) & 3) {
    case 0: return 0 + sin(rest);
    case 1: return cos(rest);
    case 2: return 0 - sin(rest);
    default: return -cos(rest);
    }
}

double kd_cos_deg(double degrees) { return turned(degrees, 1); }

double kd_sin_deg(double degrees) { return turned(degrees, 0); }
