/* The smooth thin disk as an emitter.
 *
 * An element at radius r emits as a black body of temperature T(r). By Liouville's theorem I_nu/nu^3 is constant along
 * the ray. So the element is seen as a black body of temperature g T, with the bolometric intensity g^4 F / pi.
 * Radiance is in units of the largest surface brightness at g = 1. */
#ifndef KD_BLOCK_disk
#define KD_DISK_TABLE 1024
/* clang-format off */
#define KD_BLOCK_disk(F, U, A) \
    F(r_in) F(r_out)       /* M */ \
    F(fade)                /* reciprocal width of the outer fade, 1/M */ \
    F(opacity) \
    F(peak)                /* largest effective temperature times the hardening factor, K */ \
    F(luminous) /* log2 of the fraction of light that the eye perceives, for a black body of temperature `peak` */ \
    F(quanta)              /* x = h nu/(k T) for the observed frequency nu and T = `peak` */ \
    F(quanta_mean)         /* (1 - exp(-x))/x for the x above */
/* clang-format on */
#define KD_ATMOSPHERE_ROWS 64
/* Tables. disk: (T/T_peak) r^(3/4) as a function of y = sqrt(1 - r_isco/r) in [0, 1], and its difference to the next
 * row. With reflected light of temperature T_c, a row also has T_c/T_peak, and r^3 times the ratio of that light's flux
 * to the flux of a black body of T_c. atmosphere: ratio of the emitted intensity to that of an isotropic surface of the
 * same flux, as a function of the square root of the cosine to the normal. Each row has the coefficients of a cubic in
 * the place within its cell. */
#define KD_TABLES_disk(T) T(disk, KD_DISK_TABLE) T(atmosphere, KD_ATMOSPHERE_ROWS)
#define KD_TRAIT_VISIBLE 8u      /* brightness is weighted by the eye's sensitivity; otherwise it is bolometric */
#define KD_TRAIT_LIMB 128u       /* the table `atmosphere` gives the dependence of light on the angle of emission */
#define KD_TRAIT_FREQUENCY 4096u /* brightness is the intensity at one frequency */
#define KD_TRAIT_REFLECTED 8192u /* the disk reflects light that returns to it */
#define KD_TRAITS_disk(T) T(DOPPLER) T(REDSHIFT) T(VISIBLE) T(LIMB) T(FREQUENCY) T(REFLECTED)
#define KD_BUFFERS_disk(B)
#define KD_PASS_disk(P)
#endif

#ifdef KD_EMIT_CODE
/* Gas at a crossing. t: observed temperature, divided by the disk's largest temperature. alpha: opacity. */
struct kd_gas { float t, alpha; };

/* B_nu(t T)/B_nu(T) for the disk's largest colour temperature T. With x = h nu/(k T) and m(y) = (1 - exp(-y))/y the
 * ratio is t exp(x (1 - 1/t)) m(x)/m(x/t), whose factors keep their digits for small and large x. */
float kd_disk_intensity(float t)
{
    float x = emission.disk.quanta, y = min(x / t, 1e30),
          mean = y < 0.25 ? 1.0 - y * (0.5 - y * (1.0 / 6.0 - y * (1.0 / 24.0 - y * (1.0 / 120.0 - y * (1.0 / 720.0)))))
                          : (1.0 - exp(-y)) / y;
    return t > 0.0 ? t * exp(x - y) * emission.disk.quanta_mean / mean : 0.0;
}

/* Light of a black body. t: temperature, divided by the disk's largest temperature. */
vec3 kd_black_body(float t, uint traits)
{
    if ((traits & KD_TRAIT_FREQUENCY) != 0u)
        return vec3(kd_disk_intensity(t));
    kd_colour_place at = kd_colour_at(emission.disk.peak * t);
    float t2 = t * t, weight = t2 * t2;
    if ((traits & KD_TRAIT_VISIBLE) != 0u)
        weight *= exp2(max(kd_colour_luminous(at) - emission.disk.luminous, -120.0));
    return weight * kd_colour_of(at);
}

/* Place in the table of the disk: the row, and the fraction of the way to the next row. */
struct kd_disk_row {
    uint row;
    float x;
};

kd_disk_row kd_disk_at(float w)
{
    float y = sqrt(max(1.0 - emission.frame.r_isco * w, 0.0)) * float(KD_DISK_TABLE - 1);
    uint i = min(uint(y), KD_DISK_TABLE - 2);
    return kd_disk_row(i, y - float(i));
}

/* Reflected light of the disk, which is a dilute black body: its temperature divided by the disk's largest, and its
 * dilution factor. */
vec2 kd_disk_dilute(float w)
{
    kd_disk_row at = kd_disk_at(w);
    vec2 light = mix(kd_table_row(disk, at.row).zw, kd_table_row(disk, at.row + 1u).zw, at.x);
    return vec2(light.x, light.y * w * w * w);
}

vec3 kd_disk_reflected(kd_sample s, uint traits)
{
    vec2 light = kd_disk_dilute(s.w);
    float g = kd_orbit_shift(s.w, s.energy, s.momentum, traits);
    return g > 0.0 ? light.y * kd_black_body(light.x * g, traits) : vec3(0.0); /* g may be NaN */
}

/* Ratio of the emitted intensity to that of an isotropic surface of the same flux, at the sample's angle of emission.
 */
float kd_disk_limb(kd_sample s)
{
    float at = sqrt(clamp(s.cosine, 0.0, 1.0)) * float(KD_ATMOSPHERE_ROWS);
    uint row = min(uint(at), KD_ATMOSPHERE_ROWS - 1u);
    vec4 f = kd_table_row(atmosphere, row);
    float x = at - float(row);
    return f.x + x * (f.y + x * (f.z + x * f.w));
}

/* Light of the disk's surface at the temperature t, with the effect of its atmosphere. */
vec3 kd_disk_surface(float t, kd_sample s, uint traits)
{
    vec3 light = kd_black_body(t, traits);
    if ((traits & KD_TRAIT_REFLECTED) != 0u)
        light += kd_disk_reflected(s, traits);
    if ((traits & KD_TRAIT_LIMB) != 0u)
        light *= kd_disk_limb(s);
    return light;
}

/* T r^(3/4) at r = 1/w, with T relative to the disk's largest. */
float kd_disk_heat(float w)
{
    kd_disk_row at = kd_disk_at(w);
    vec4 row = kd_table_row(disk, at.row);
    return row.x + at.x * row.y;
}

/* The outer fade: 1 inside, 0 at r_out, with vanishing slope at both ends. */
float kd_disk_fade(float r)
{
    float f = clamp((emission.disk.r_out - r) * emission.disk.fade, 0.0, 1.0);
    return f * f * (3.0 - 2.0 * f);
}

kd_gas kd_disk_gas(kd_sample s, uint traits)
{
    float r = 1.0 / s.w;
    float t = kd_disk_heat(s.w) * kd_orbit_cooled(s.w, s.energy, s.momentum, traits);

    bool inside = r >= emission.disk.r_in && r <= emission.disk.r_out;
    /* Outside the disk t may be NaN, for two reasons: inside the photon orbit u^t does not exist, and E (r^(3/2) + a) -
     * L, the divisor of g, may vanish. */
    return kd_gas(inside ? t : 0.0, inside ? emission.disk.opacity * kd_disk_fade(r) : 0.0);
}

kd_glow kd_disk_glow(kd_sample s)
{
    kd_gas gas = kd_disk_gas(s, TRAITS_disk);
    return kd_glow(gas.alpha * kd_disk_surface(gas.t, s, TRAITS_disk), gas.alpha, 0.0);
}
#endif
