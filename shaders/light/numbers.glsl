/* Computes the physical numbers of a place on a ray, even if the picture does not show them. They are used by layers
 * (shared/layers.h) and to describe a ray. Needs light/inputs.glsl. */
#ifndef KD_NUMBERS_GLSL
#define KD_NUMBERS_GLSL

/* g: ratio of the frequency that the observer measures to the frequency in the frame of the gas. It does not depend on
 * whether the picture applies the shift. */
float kd_layer_g(kd_sample s)
{
    if (kd_plunge_falls(s))
        return kd_plunge_shift(s, true, true);
    return kd_orbit_shift(s.w, s.energy, s.momentum, KD_TRAIT_DOPPLER | KD_TRAIT_REDSHIFT);
}

/* Temperature in K of the black body as which the gas emits, in the gas's own frame. */
float kd_layer_temperature(kd_sample s)
{
    if (kd_plunge_falls(s))
        return emission.plunge.temperature * emission.disk.peak;
    float r = 1.0 / s.w, t = emission.disk.peak * kd_disk_heat(s.w) * inversesqrt(r * sqrt(r));
    return KD_HAS(gas) && KD_GAS_TAKEN > 0u ? t * exp(0.25 * kd_gas_excess(s))
                                            /* the fourth root, because the flux is proportional to the fourth
                                             * power of the temperature */
                                            : t;
}

#ifdef KD_MARCH
/* g of a surface, computed by the emitter to which the surface belongs. */
float kd_layer_met_g(kd_met met)
{
#define KD_MET_G_(number, name) \
    if (KD_HAS(name)) \
        return 1.0 / kd_##name##_shift(met);
    KD_EMITTERS(KD_NO_EMITTER_, KD_NO_EMITTER_, KD_NO_EMITTER_, KD_NO_EMITTER_, KD_NO_EMITTER_, KD_MET_G_)
    return 0.0;
}

float kd_layer_met_temperature(kd_met met)
{
#define KD_MET_KELVIN_(number, name) \
    if (KD_HAS(name)) \
        return kd_##name##_kelvin(met);
    KD_EMITTERS(KD_NO_EMITTER_, KD_NO_EMITTER_, KD_NO_EMITTER_, KD_NO_EMITTER_, KD_NO_EMITTER_, KD_MET_KELVIN_)
    return 0.0;
}
#endif

/* Reduces an azimuth to (-pi, pi]. */
float kd_layer_turned(float phi) { return phi - 2.0 * KD_PI * ceil((phi - KD_PI) * (0.5 / KD_PI)); }

/* An angle from its cosine. It is used for the angle between light and the disk's normal in the frame of the gas, whose
 * cosine is g |p_theta| / r. Here p_theta / r is the photon's momentum along the normal, with p_theta^2 = Q in the
 * equatorial plane, and 1/g is the photon's energy in the frame of the gas. For gas that moves within the plane the
 * normal is along theta (Carter 1968). */
float kd_layer_angle(float c) { return kd_angle_upper(clamp(c, -1.0, 1.0), sqrt(max(1.0 - c * c, 0.0))); }

#endif
