/* The sky: light from infinity, where escaping rays end.
 *
 * The model "grid" is a celestial sphere with four quadrants in quiet colours, and with meridians and parallels in
 * white; a line's width is a fortieth of the spacing. All other models have diffuse light and stars.
 *
 * Diffuse light is a panorama in galactic coordinates (src/render/sky/panorama.h), interpolated between the two levels
 * of its mips that fit a ray's footprint. Texels are interpolated by a quadratic B-spline, which shows no corners when
 * the picture is magnified. Stars are points. comp/star_images.comp has already spread each image of a star over some
 * pixels. The sky reads this light, with 64 bits a channel.
 *
 * By Liouville's theorem I_nu/nu^3 is constant along a ray. A black body of temperature T is therefore seen as a black
 * body of temperature g T, with a bolometric intensity g^4 times as large. g = 1/E, where E is the energy at infinity
 * of light that the observer measures as 1. A star's flux changes in the same way, and is multiplied by the
 * magnification of its solid angle. Diffuse light is shifted like the light of a black body of KD_SKY_KELVIN. */
#ifndef KD_BLOCK_sky
/* clang-format off */
#define KD_BLOCK_sky(F, U, A) \
    F(brightness) \
    F(spacing)             /* spacing of the grid, radians */ \
    F(spread)              /* factor for the brightness of the panorama */ \
    U(columns) U(rows)     /* numbers of columns and rows of the panorama's finest level, powers of two */ \
    F(texel)               /* log2 of the size of a texel of the finest level, radians */ \
    /* rows of the matrix that rotates directions to galactic ones; azimuths are relative to the observer's */ \
    F(xx) F(xy) F(xz) F(yx) F(yy) F(yz) F(zx) F(zy) F(zz)
/* clang-format on */
#define KD_TRAIT_SKY_GRID 64u
#define KD_TRAIT_SKY_SPREAD 128u
#define KD_SKY_KELVIN 5600.0
/* words for each pixel: the lower and the upper 32 bits of red, then of green, then of blue */
#define KD_STAR_LIGHT 6
#define KD_STAR_UNIT 268435456.0 /* 2^28, the value that stands for 1 in these words */
#define KD_TABLES_sky(T)
#define KD_TRAITS_sky(T) T(VISIBLE) T(SKY_GRID) T(SKY_SPREAD) T(POINTS) T(SPREAD)
#define KD_BUFFERS_sky(B) B(1, words, panorama) B(2, pairs, point_light)
#define KD_PASS_sky(P)
#endif

#ifdef KD_EMIT_CODE
/* Observed light of a black body. kelvin: its temperature. At g = 1 its luminance is 1. */
vec3 kd_sky_shifted(float kelvin, float g, uint traits)
{
    kd_colour_place seen = kd_colour_at(g * kelvin);
    float g2 = g * g, weight = g2 * g2;
    if ((traits & KD_TRAIT_VISIBLE) != 0u)
        weight *= exp2(max(kd_colour_luminous(seen) - kd_colour_luminous(kd_colour_at(kelvin)), -120.0));
    return weight * kd_colour_of(seen);
}

/* Rotates a direction from the hole's frame to the galactic frame. */
vec3 kd_sky_galactic(vec3 n)
{
    return vec3(emission.sky.xx * n.x + emission.sky.xy * n.y + emission.sky.xz * n.z,
                emission.sky.yx * n.x + emission.sky.yy * n.y + emission.sky.yz * n.z,
                emission.sky.zx * n.x + emission.sky.zy * n.y + emission.sky.zz * n.z);
}

vec3 kd_sky_from_galactic(vec3 n)
{
    return vec3(emission.sky.xx * n.x + emission.sky.yx * n.y + emission.sky.zx * n.z,
                emission.sky.xy * n.x + emission.sky.yy * n.y + emission.sky.zy * n.z,
                emission.sky.xz * n.x + emission.sky.yz * n.y + emission.sky.zz * n.z);
}
#endif

#ifdef KD_EMIT_END_CODE
vec3 kd_sky_texel(uint word)
{
    return uintBitsToFloat(((word >> 27) + 103u) << 23) *
           vec3(float(word & 511u), float((word >> 9) & 511u), float((word >> 18) & 511u));
}

/* The panorama's value at (u, v) in [0, 1], interpolated on one level of the mips. */
vec3 kd_sky_level(vec2 at, uint level)
{
    uint columns = emission.sky.columns >> level, rows = emission.sky.rows >> level,
         all = emission.sky.columns * emission.sky.rows;
    uint first = (4u * all - ((4u * all) >> (2u * level))) / 3u;
    float x = at.x * float(columns), y = at.y * float(rows), column = floor(x), row = floor(y), p = x - column - 0.5,
          q = y - row - 0.5;
    vec3 a = vec3(0.5 * (0.5 - p) * (0.5 - p), 0.75 - p * p, 0.5 * (0.5 + p) * (0.5 + p));
    vec3 b = vec3(0.5 * (0.5 - q) * (0.5 - q), 0.75 - q * q, 0.5 * (0.5 + q) * (0.5 + q)), sum = vec3(0.0);
    uint i1 = uint(column) & (columns - 1u), i0 = (i1 - 1u) & (columns - 1u), i2 = (i1 + 1u) & (columns - 1u);
    int last = int(rows) - 1;
    for (int k = 0; k < 3; k++) {
        uint line = first + columns * uint(clamp(int(row) + k - 1, 0, last));
        sum += b[k] * (a.x * kd_sky_texel(KD_OWN_WORD(panorama, line + i0)) +
                       a.y * kd_sky_texel(KD_OWN_WORD(panorama, line + i1)) +
                       a.z * kd_sky_texel(KD_OWN_WORD(panorama, line + i2)));
    }
    return sum;
}

vec3 kd_sky_spread(vec3 n, float footprint)
{
    float latitude = kd_atan2(n.z, sqrt(n.x * n.x + n.y * n.y)), longitude = kd_atan2(n.y, n.x);
    vec2 at = vec2(0.5 - longitude / (2.0 * KD_PI), clamp(0.5 - latitude / KD_PI, 0.0, 1.0));
    float coarsest = log2(float(emission.sky.rows)) - 1.0,
          level = clamp(log2(max(footprint, 1e-9)) - emission.sky.texel, 0.0, coarsest);
    uint k = uint(level);
    return mix(kd_sky_level(at, k), kd_sky_level(at, min(k + 1u, uint(coarsest))), level - float(k));
}

vec3 kd_sky_points(uint pixel)
{
    uint o = (KD_STAR_LIGHT / 2u) * pixel;
    uvec2 r = KD_OWN_PAIR(point_light, o), g = KD_OWN_PAIR(point_light, o + 1u), b = KD_OWN_PAIR(point_light, o + 2u);
    return vec3(r.x, g.x, b.x) * (1.0 / KD_STAR_UNIT) + vec3(r.y, g.y, b.y) * (4294967296.0 / KD_STAR_UNIT);
}

/* True if a pixel has any light of points. The red channel decides, because black bodies of all temperatures have red
 * light. */
bool kd_sky_has_points(uint pixel) { return KD_OWN_PAIR(point_light, (KD_STAR_LIGHT / 2u) * pixel) != uvec2(0u); }

vec3 kd_sky_grid(float u, float phi)
{
    float s = sqrt(max(1.0 - u * u, 0.0));
    float latitude = atan(u, s);
    float longitude = phi - 2.0 * KD_PI * floor(phi / (2.0 * KD_PI));
    vec2 q = vec2(longitude, latitude) / emission.sky.spacing;
    vec2 d = abs(q - floor(q + 0.5));
    d.x *= s; /* divided by the sine of the polar angle, so that meridians keep their width towards the pole */
    float line = min(d.x, d.y) < 0.025 ? 1.0 : 0.0;
    vec3 base = longitude < KD_PI ? (u > 0.0 ? vec3(0.10, 0.22, 0.55) : vec3(0.08, 0.38, 0.26))
                                  : (u > 0.0 ? vec3(0.45, 0.16, 0.30) : vec3(0.48, 0.33, 0.08));
    return emission.sky.brightness * mix(base, vec3(1.0), line);
}

vec3 kd_sky_end(kd_end end)
{
    vec3 light = vec3(0.0);
    if ((TRAITS_sky & KD_TRAIT_SKY_GRID) != 0u)
        light += kd_sky_grid(end.u, end.phi + emission.frame.azimuth);
    if ((TRAITS_sky & KD_TRAIT_SKY_SPREAD) != 0u) {
        kd_phasor phi = kd_cos_sin(end.phi);
        float s = sqrt(max(1.0 - end.u * end.u, 0.0));
        vec3 spread =
            emission.sky.spread * kd_sky_spread(kd_sky_galactic(vec3(s * phi.c, s * phi.s, end.u)), end.footprint);
        light += FINITE ? spread * kd_sky_shifted(KD_SKY_KELVIN, 1.0 / end.energy, TRAITS_sky) /
                              kd_colour_of(kd_colour_at(KD_SKY_KELVIN))
                        : spread;
    }
    return light;
}
#endif
