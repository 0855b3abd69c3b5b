#include "physics/synchrotron.h"

#include "physics/constants.h"

#include <math.h>

#define CM3 1e6
#define GHZ 1e9
#define CLASSICAL (KD_CHARGE_C * KD_CHARGE_C / (4 * M_PI * KD_EPSILON_0)) /* e^2, J m */

double kd_synchrotron_light_unit(void) { return CLASSICAL / KD_C_M_S * CM3 * GHZ; }

double kd_synchrotron_depth_unit(void) { return kd_synchrotron_light_unit() * KD_C_M_S * KD_C_M_S / (2 * KD_H_J_S * GHZ * GHZ * GHZ); }

struct kd_synchrotron_power kd_synchrotron_power(double p, double gamma_min, double gamma_max)
{
    const double ln3 = log(3), norm = log((p - 1) / (pow(gamma_min, 1 - p) - pow(gamma_max, 1 - p)));
    const double light = norm + p / 2 * ln3 - log(2 * (p + 1)) + lgamma((3 * p - 1) / 12) + lgamma((3 * p + 19) / 12);
    const double depth = norm + (p + 1) / 2 * ln3 - log(4) + lgamma((3 * p + 2) / 12) + lgamma((3 * p + 22) / 12);
    const double unit = CLASSICAL / (KD_ELECTRON_KG * KD_C_M_S) * CM3 / GHZ / kd_synchrotron_depth_unit();
    return (struct kd_synchrotron_power) { light / M_LN2, depth / M_LN2 + log2(unit) };
}
