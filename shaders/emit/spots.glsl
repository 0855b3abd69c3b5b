/* Hot spots as an emitter. Spots are shown where they were when their light left them: `phi` decreases with the light
 * delay. The luminance of the spots is kept separately, in `apart`.
 *
 * The light of each place has the g of the gas on the circular orbit there. The shape of a spot rotates with the orbit
 * of the spot's centre, and gas shears through it. I_nu/nu^3 is constant along the ray, so a spectrum I_nu ~ nu^-index
 * is multiplied by g^(3 + index). A. E. Broderick & A. Loeb 2006, MNRAS 367, 905, have such spots as spheres in a hot
 * flow. Spots are inside the gas, so the gas around a spot does not hide it. */
#ifndef KD_BLOCK_spots
#define KD_SPOT_MAX 16
/* clang-format off */
#define KD_BLOCK_spot(F, U) \
    /* r: radius of the centre, M. phi: azimuth of the centre minus the observer's, radians, at the picture's time */ \
    F(r) F(phi) \
    F(omega)                 /* decrease of phi per M of light delay */ \
    F(sharp) F(reach)        /* log2(e)/(2 size^2); square of the distance beyond which brightness is 0 */ \
    F(brightness) F(power)   /* brightness at the centre; exponent of g, which is 3 + index */ \
    F(temperature)           /* K */
/* clang-format on */
#define KD_BLOCK_spots(F, U, A) A(kd_spot_block, at, KD_SPOT_MAX)
#define KD_TRAIT_SPOTS_SHIFT 8u /* first bit of the number of spots in the traits */
#define KD_TRAIT_SPOTS (31u << KD_TRAIT_SPOTS_SHIFT)
#define KD_TABLES_spots(T)
#define KD_TRAITS_spots(T) T(DOPPLER) T(REDSHIFT) T(SLOW) T(SEPARATE_PHOTOMETRY) T(SPOTS)
#define KD_BUFFERS_spots(B)
#define KD_PASS_spots(P)
#endif

#ifdef KD_EMIT_CODE
kd_glow kd_spots_glow(kd_sample s)
{
    kd_glow sum = kd_glow(vec3(0.0), 0.0, 0.0);
    float r = 1.0 / s.w;
    if (r < emission.frame.r_isco)
        return sum;
    for (uint i = 0; i < (TRAITS_spots >> KD_TRAIT_SPOTS_SHIFT); i++) {
        kd_spot_block spot = emission.spots.at[i];
        float ahead = (TRAITS_spots & KD_TRAIT_SLOW) != 0u ? spot.omega * s.ago : 0.0;
        float half_ = kd_cos_sin(0.5 * (s.phi - spot.phi + ahead)).s;
        float off = (r - spot.r) * (r - spot.r) + 4.0 * r * spot.r * half_ * half_;
        if (off > spot.reach)
            continue;
        float g = kd_orbit_shift(s.w, s.energy, s.momentum, TRAITS_spots);
        float light = spot.brightness * exp2(spot.power * log2(g) - spot.sharp * off);
        sum.light += light * kd_colour_of(kd_colour_at(spot.temperature * g));
        sum.apart += light;
    }
    return sum;
}
#endif
