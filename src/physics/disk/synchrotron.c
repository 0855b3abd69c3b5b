#include "physics/disk/synchrotron.h"

#include "physics/math/constants.h"

#include <math.h>

#define CM3 1e6
#define GHZ 1e9
/* e^2 in Gaussian units, as e^2/(4 pi epsilon_0), J m */
#define CLASSICAL (KD_CHARGE_C * KD_CHARGE_C / (4 * M_PI * KD_EPSILON_0))

double kd_synchrotron_light_unit(void) { return CLASSICAL / KD_C_M_S * CM3 * GHZ; }

double kd_synchrotron_depth_unit(void)
{
    return kd_synchrotron_light_unit() * KD_C_M_S * KD_C_M_S / (2 * KD_H_J_S * GHZ * GHZ * GHZ);
}

/* log2 of e^2/(m_e c) cm^-3/GHz, in the kernels' unit of absorptivity. */
static double depth_scale(void)
{
    return log2(CLASSICAL / (KD_ELECTRON_KG * KD_C_M_S) * CM3 / GHZ / kd_synchrotron_depth_unit());
}

struct kd_synchrotron_power kd_synchrotron_power(double p, double gamma_min, double gamma_max)
{
    const double ln3 = log(3), norm = log((p - 1) / (pow(gamma_min, 1 - p) - pow(gamma_max, 1 - p)));
    const double light = norm + p / 2 * ln3 - log(2 * (p + 1)) + lgamma((3 * p - 1) / 12) + lgamma((3 * p + 19) / 12);
    const double depth = norm + (p + 1) / 2 * ln3 - log(4) + lgamma((3 * p + 2) / 12) + lgamma((3 * p + 22) / 12);
    return (struct kd_synchrotron_power) { light / M_LN2, depth / M_LN2 + depth_scale() };
}

struct kd_synchrotron_kappa kd_synchrotron_kappa(double kappa)
{
    const double all = (kappa - 2) * (kappa - 1) * kappa;
    const double deep_low = pow(3, 1.0 / 6) * 10 / 41 * 2 * M_PI * all / (3 * kappa - 1) * tgamma(5.0 / 3);
    const double deep_high =
        pow(M_PI, 1.5) / 3 * all * (2 * tgamma(2 + kappa / 2) / (2 + kappa) - 1) * (pow(3 / kappa, 4.75) + 0.6);
    return (struct kd_synchrotron_kappa) {
        .light_low = log2(4 * M_PI * tgamma(kappa - 4.0 / 3) / (pow(3, 7.0 / 3) * tgamma(kappa - 2))),
        .light_high = log2(pow(3, (kappa - 1) / 2) * (kappa - 2) * (kappa - 1) / 4 * tgamma(kappa / 4 - 1.0 / 3) *
                           tgamma(kappa / 4 + 4.0 / 3)),
        .light_sharp = 3 * pow(kappa, -1.5),
        .depth_low = log2(deep_low) + depth_scale(),
        .depth_high = log2(deep_high) + depth_scale(),
        .depth_sharp = pow(8 * kappa / 5 - 1.75, -0.86),
    };
}

struct kd_synchrotron_kappa_polarised kd_synchrotron_kappa_polarised(double kappa)
{
    const double deep = pow(3 / kappa, 4.75) + 0.6; /* for I: the exponent s by which the two laws are joined */
    return (struct kd_synchrotron_kappa_polarised) {
        .light_q_high = log2(0.64 + kappa / 50),
        .light_q_sharp = 3.7 * pow(kappa, -1.6),
        .light_v_low = log2(9.0 / 16 * pow(kappa, -66.0 / 125)),
        .light_v_high = log2(49.0 / 64 * pow(kappa, -11.0 / 25)),
        .depth_q_high = log2((441 * pow(kappa, -144.0 / 25) + 0.55) / deep),
        .depth_q_sharp = 1.4 * pow(kappa, -1.15),
        .depth_v_low = log2(0.77 * pow(kappa, -0.7)),
        .depth_v_high =
            log2(14.3 * (169 * pow(kappa, -8) + 13 * kappa / 2500 - 263.0 / 5000 + 47 / (200 * kappa)) / deep),
        .depth_v_sharp = 1.22 * pow(kappa, -142.0 / 125) + 0.007,
    };
}

/* The hypergeometric function 2F1(a, b; c; -z) has c = a + 1. By Euler's integral, z^a 2F1 is then a times the integral
 * of s^(a - 1) (1 + s)^-b from 0 to z. It is computed in the variable ln s by Simpson's rule. */
void kd_synchrotron_kappa_table(double kappa, double first, double step, int n, double *out)
{
    enum { PARTS = 8 };
    const double a = kappa - 1.0 / 3, b = kappa + 1, z = exp2(first), h = step * M_LN2 / PARTS;
    double sum = pow(z, a) * (1 / a - b * z / (a + 1));
    for (int i = 0; i < n; i++) {
        out[i] = log2(a * sum);
        for (int k = 0; k < PARTS; k++) {
            const double from = (first + i * step) * M_LN2 + k * h;
            for (int j = 0; j < 3; j++)
                sum += h / 6 * (j == 1 ? 4 : 1) * exp(a * (from + 0.5 * j * h)) * pow(1 + exp(from + 0.5 * j * h), -b);
        }
    }
}
