#include "physics/math/angle.h"

#include <math.h>

/* Quarter turns are removed in degrees, where this is exact. `first`: 1 for cosines, which are a quarter turn ahead of
 * sines. Adding 0 avoids a negative zero. */
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
