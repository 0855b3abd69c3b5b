/* The echo of a flash. A lamp on the axis flashes, and its light runs over the thin disk. The disk's gas shines as soon
 * as it receives that light, and in proportion to it. For each ray the gas is shown at the time when the ray's light
 * left it.
 *
 * Gas at r receives the light that the lamp sent a time t_1(r) earlier (emit/lamp.glsl). I_nu/nu^3 is constant along
 * the ray, so a spectrum I_nu ~ nu^-index is multiplied by g^(3 + index). The light in all rays together, over time, is
 * the impulse response of src/physics/disk/echo.h. */
#ifndef KD_BLOCK_flash
/* clang-format off */
#define KD_BLOCK_flash(F, U, A) \
    F(since)               /* time from the peak at the lamp to the time that the picture shows, M */ \
    F(sharp)               /* log2(e)/(2 duration^2), the coefficient of the Gaussian pulse in exp2 */ \
    F(period) F(per_period) /* time between flashes, M, and its inverse; 0 if there is only one flash */ \
    F(brightness) F(power) /* peak brightness where the disk is lit most; exponent of g */ \
    F(temperature)         /* K */
/* clang-format on */
#define KD_TABLES_flash(T)
#define KD_TRAITS_flash(T) T(DOPPLER) T(REDSHIFT) T(SLOW) T(LIMB)
#define KD_BUFFERS_flash(B)
#define KD_PASS_flash(P)
#endif

#ifdef KD_EMIT_CODE
kd_glow kd_flash_glow(kd_sample s)
{
    float r = 1.0 / s.w;
    if (r < emission.disk.r_in || r > emission.disk.r_out)
        return kd_glow(vec3(0.0), 0.0, 0.0);
    vec2 lamp = kd_lamp_at(s.w);
    float late = emission.flash.since - ((TRAITS_flash & KD_TRAIT_SLOW) != 0u ? s.ago : 0.0) - r - lamp.x;
    late -= emission.flash.period * round(late * emission.flash.per_period);
    float g = kd_orbit_shift(s.w, s.energy, s.momentum, TRAITS_flash);
    float light = emission.flash.brightness * lamp.y * kd_disk_fade(r) *
                  exp2(emission.flash.power * log2(g) - emission.flash.sharp * late * late);
    if ((TRAITS_flash & KD_TRAIT_LIMB) != 0u)
        light *= kd_disk_limb(s);
    return kd_glow(light * kd_colour_of(kd_colour_at(emission.flash.temperature * g)), 0.0, 0.0);
}
#endif
