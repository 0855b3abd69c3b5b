#include "physics/spacetime/scale.h"

#include "physics/math/constants.h"

const struct kd_scale_hole kd_scale_holes[] = {
    [KD_SCALE_M87] = { "M87*", KD_SCALE_M87_MSUN, KD_SCALE_M87_PC, 42, 3 },
    [KD_SCALE_SGRA] = { "Sgr A*", KD_SCALE_SGRA_MSUN, KD_SCALE_SGRA_PC, 51.8, 2.3 },
};

double kd_scale_metres(double mass_msun) { return mass_msun * KD_M_SUN_M; }

double kd_scale_seconds(double mass_msun) { return mass_msun * KD_M_SUN_S; }

double kd_scale_microarcseconds(double mass_msun, double distance_pc)
{
    return kd_scale_metres(mass_msun) / (distance_pc * KD_PARSEC_M) / KD_MICROARCSECOND_RAD;
}
