#include "playground/body.h"

#include <math.h>

struct kd_playground_spherical kd_playground_spherical(const double x[3], const double v[3])
{
    const double rho = hypot(x[0], x[1]), r = hypot(rho, x[2]);
    const double c = rho > 0 ? x[0] / rho : 1, s = rho > 0 ? x[1] / rho : 0;
    const double cos_theta = r > 0 ? x[2] / r : 1, sin_theta = r > 0 ? rho / r : 0;
    const double outwards = c * v[0] + s * v[1]; /* component perpendicular to the axis, away from it */
    return (struct kd_playground_spherical) {
        .r = r,
        .theta = atan2(rho, x[2]),
        .phi = rho > 0 ? atan2(x[1], x[0]) : 0,
        .v = { sin_theta * outwards + cos_theta * v[2], cos_theta * outwards - sin_theta * v[2], c * v[1] - s * v[0] },
    };
}
