#include "physics/math/angle.h"

#include <math.h>

/* The next quarter turn is taken off while the angle still is degrees, where nothing is rounded by it. `first`:
 * cosines begin a quarter turn ahead of sines. 0 + : no negative zero. */
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
