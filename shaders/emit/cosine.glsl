/* Cosine of the angle of emission, which is the angle between the light and the normal of the plane in the frame of the
 * gas. For a photon of energy 1/g it is |p_theta| g/r, with p_theta^2 = Q in the plane (Carter 1968). Opacity by
 * optical depth, limb darkening and light scattered by electrons depend on it. It is computed once for each crossing,
 * if anything needs it. */
#ifdef KD_EMIT_CODE
const bool KD_COSINE = (((TRAITS_disk | TRAITS_particles | TRAITS_gas | TRAITS_flash) & KD_TRAIT_LIMB) |
                        (TRAITS_gas & KD_TRAIT_GAS_DEEP) | (TRAITS_polarization & KD_TRAIT_SCATTERED)) != 0u;

/* The sample with its cosine of emission. The gas moves on circular orbits or falls from the ISCO. */
kd_sample kd_with_cosine(kd_sample s)
{
    if (KD_COSINE)
        s.cosine =
            sqrt(max(s.q, 0.0)) * s.w *
            (kd_plunge_falls(s) ? kd_plunge_shift(s, true, true)
                                : kd_orbit_shift(s.w, s.energy, s.momentum, KD_TRAIT_DOPPLER | KD_TRAIT_REDSHIFT));
    return s;
}
#endif
