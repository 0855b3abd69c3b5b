/* Composes light along one ray, front to back, from the emitters of the scene. The code iterates over the list of
 * emitters and contains no emitter's name. Kernels supply the samples, which are crossings from a lens map
 * (transfer.comp) or points along the path. */
#ifndef KD_COMPOSE_GLSL
#define KD_COMPOSE_GLSL

/* A sample of a ray. ago: how much earlier, M, the sample's light left than light that shows the scene's time. energy,
 * momentum, q: E, L and Carter's Q in units of the energy that the observer measures. footprint, shape: size and shape
 * of the ray's footprint at the sample (shared/lens.h), 0 if no emitter needs them. cosine: cosine of the angle between
 * light and normal, in the frame of the gas where the light left it; 0 if no emitter needs it (emit/cosine.glsl). */
struct kd_sample {
    float w, phi, ago, slope, energy, momentum, q, footprint, shape;
    uint order;
    float cosine;
};
/* The end of a ray that escapes. footprint: size of the ray on the sky, radians. energy: E in units of the energy that
 * the observer measures. */
struct kd_end { float u, phi, footprint, energy; };
/* Contribution of one emitter at a sample. light: the emitter's light, with its opacity applied. alpha: the opacity.
 * apart: the luminance that is also kept separately. */
struct kd_glow {
    vec3 light;
    float alpha, apart;
};
/* The ellipse that a ray stands for, perpendicular to the ray, at the ray's nearest crossing of the plane. plane: M_rr,
 * M_rf, M_ff, as in KD_LENS_SHAPE (shared/lens.h). rise: M_rz, M_fz, M_zz, where z is along the normal. The unit is
 * M^2. */
struct kd_spread { vec3 plane, rise; };
/* A point of a ray inside a volume. w = 1/r, u = cos(theta). dw, du: derivatives of w and u by Mino time. Mino time
 * grows in the direction of tracing, which is opposite to the light's. energy, momentum, q: E, L and Q in units of the
 * energy that the observer measures. These constants belong to the arriving photon, which has p_r = dw/kd_delta(w) and
 * p_theta = du/sin(theta). speed: length of the path in M per unit of Mino time, as if space were flat. A grain is such
 * a length. phi: azimuth, source minus observer. spread: the ellipse that the ray stands for. phi and spread are 0
 * without KD_TRAIT_AZIMUTH. order: order of the nearest crossing of the plane on the ray, which changes at the extremes
 * of cos(theta); 0 if nothing needs it. ago: as in kd_sample, 0 without KD_TRAIT_SLOW. nearest: 1/r of the ray's
 * innermost crossing of the plane, or 0 if that is unknown. */
struct kd_midst {
    float w, u, dw, du, energy, momentum, q, speed, phi;
    kd_spread spread;
    uint order;
    float ago;
    float nearest;
};
/* The medium at a point of a ray. light: emission; depth: optical depth. Light and depth are per unit of the affine
 * parameter lambda, which is normalised by the observer's energy. Along a ray d lambda = (r^2 + a^2 u^2) d tau, and
 * matter of velocity U measures the path length -k.U d lambda. With emissivity j and opacity alpha per length in the
 * matter's frame, depth = alpha (-k.U) and bolometric light = j (-k.U)^-3. 1/(-k.U) is g. grain: length in M along the
 * ray over which the medium changes by about its own size. Where there is no matter, it is the distance to the matter.
 */
struct kd_medium {
    vec3 light;
    float depth, grain;
};
/* A surface that a ray meets. time: Mino time from the observer. body: the body's number, or KD_NOBODY. crossed: number
 * of crossings of the plane before the surface. w, u, phi, dw and du: as in kd_midst. energy, momentum: E and L.
 * cosine: cosine of the emission angle in the frame of the surface. */
struct kd_met {
    float time;
    uint body, crossed;
    float w, u, phi, dw, du, energy, momentum, cosine;
};
#define KD_NOBODY 0xffffffffu
/* State of a ray. light: the light so far. apart: the part of the luminance that is kept separately. through:
 * transmission of everything passed so far. */
struct kd_beam {
    vec3 light;
    float apart, through;
};

#include "light/probe.glsl"

#define KD_SPEC_TRAIT_(number, name) layout(constant_id = KD_SPEC_TRAITS + number) const uint TRAITS_##name = 0;
KD_EMITTERS(KD_SPEC_TRAIT_, KD_SPEC_TRAIT_, KD_SPEC_TRAIT_, KD_SPEC_TRAIT_, KD_SPEC_TRAIT_, KD_SPEC_TRAIT_)
#define KD_HAS(name) ((TRAITS_##name & KD_TRAIT_PRESENT) != 0u)
#define KD_NO_EMITTER_(number, name)
/* Number of volumes in the scene. */
#define KD_PRESENT_(number, name) +((TRAITS_##name & KD_TRAIT_PRESENT) != 0u ? 1 : 0)
const int KD_VOLUMES =
    0 KD_EMITTERS(KD_NO_EMITTER_, KD_NO_EMITTER_, KD_NO_EMITTER_, KD_NO_EMITTER_, KD_PRESENT_, KD_NO_EMITTER_);

/* limit of the light of one contribution; sums of larger values would overflow */
#define KD_BEAM_MOST 1e30

#define KD_EMIT_CODE
#define KD_EMIT_END_CODE
#include "shared/emitters.h"

/* KD_GLOWS: true if any emitter has light at crossings. KD_SEPARATE_PHOTOMETRY: true if some luminance is kept
 * separately. */
#define KD_OR_TRAITS_(number, name) | TRAITS_##name
const uint KD_ALL_TRAITS =
    0u KD_EMITTERS(KD_OR_TRAITS_, KD_NO_EMITTER_, KD_NO_EMITTER_, KD_NO_EMITTER_, KD_NO_EMITTER_, KD_NO_EMITTER_);
const bool KD_GLOWS = (KD_ALL_TRAITS & KD_TRAIT_PRESENT) != 0u;
const bool KD_SEPARATE_PHOTOMETRY = (KD_ALL_TRAITS & KD_TRAIT_SEPARATE_PHOTOMETRY) != 0u;
const uint KD_ALONG_TRAITS =
    0u KD_EMITTERS(KD_NO_EMITTER_, KD_NO_EMITTER_, KD_NO_EMITTER_, KD_NO_EMITTER_, KD_OR_TRAITS_, KD_NO_EMITTER_);
const uint KD_MET_TRAITS =
    0u KD_EMITTERS(KD_NO_EMITTER_, KD_NO_EMITTER_, KD_NO_EMITTER_, KD_NO_EMITTER_, KD_NO_EMITTER_, KD_OR_TRAITS_);
const bool KD_MARCHES = (KD_ALONG_TRAITS & KD_TRAIT_PRESENT) != 0u, KD_MEETS = (KD_MET_TRAITS & KD_TRAIT_PRESENT) != 0u;
/* True if an emitter multiplies light by a factor that depends on the light's image order. */
const uint KD_OVER_TRAITS =
    0u KD_EMITTERS(KD_NO_EMITTER_, KD_NO_EMITTER_, KD_OR_TRAITS_, KD_NO_EMITTER_, KD_NO_EMITTER_, KD_NO_EMITTER_);
const bool KD_OVERS = (KD_OVER_TRAITS & KD_TRAIT_PRESENT) != 0u;
/* True if an emitter emits light at the ends of rays. */
const uint KD_END_TRAITS =
    0u KD_EMITTERS(KD_NO_EMITTER_, KD_NO_EMITTER_, KD_NO_EMITTER_, KD_OR_TRAITS_, KD_NO_EMITTER_, KD_NO_EMITTER_);
const bool KD_ENDS = (KD_END_TRAITS & KD_TRAIT_PRESENT) != 0u;

/* Adds the light of all emitters at a place. The emitters share the place, so none of them hides another's light. */
void kd_beam_at(inout kd_beam beam, kd_sample s)
{
    float seen = beam.through;
    KD_PROBE_PLACE(s, beam.through)
#define KD_OVER_(number, name) \
    if (KD_HAS(name)) \
        seen *= kd_##name##_over(s.order);
    KD_EMITTERS(KD_NO_EMITTER_, KD_NO_EMITTER_, KD_OVER_, KD_NO_EMITTER_, KD_NO_EMITTER_, KD_NO_EMITTER_)
#define KD_GLOW_(number, name) \
    if (KD_HAS(name)) { \
        kd_glow glow = kd_##name##_glow(s); \
        beam.light += seen * glow.light; \
        beam.apart += seen * glow.apart; \
        beam.through *= 1.0 - glow.alpha; \
        KD_PROBE_GLOW(number, seen, glow) \
    }
    KD_EMITTERS(KD_GLOW_, KD_NO_EMITTER_, KD_NO_EMITTER_, KD_NO_EMITTER_, KD_NO_EMITTER_, KD_NO_EMITTER_)
}

#ifdef KD_MARCH
/* The medium of all emitters together at a point. The emitters share the point, so none of them hides another's light.
 */
kd_medium kd_medium_at(kd_midst p)
{
    kd_medium sum = kd_medium(vec3(0.0), 0.0, 1e30);
    float over = 1.0;
#define KD_OVER_ALONG_(number, name) \
    if (KD_HAS(name)) \
        over *= kd_##name##_over(p.order);
    KD_EMITTERS(KD_NO_EMITTER_, KD_NO_EMITTER_, KD_OVER_ALONG_, KD_NO_EMITTER_, KD_NO_EMITTER_, KD_NO_EMITTER_)
#define KD_ALONG_(number, name) \
    if (KD_HAS(name)) { \
        kd_medium one = kd_##name##_along(p); \
        one.light *= KD_OVERS ? over : 1.0; \
        KD_PROBE_MEDIUM(name, one) \
        sum.light += one.light; \
        sum.depth += one.depth; \
        sum.grain = min(sum.grain, one.grain); \
    }
    KD_EMITTERS(KD_NO_EMITTER_, KD_NO_EMITTER_, KD_NO_EMITTER_, KD_NO_EMITTER_, KD_ALONG_, KD_NO_EMITTER_)
    return sum;
}

/* Advances a ray through a uniform medium by the length `way` of the affine parameter. The result is exact for any
 * depth.
 */
void kd_beam_along(inout kd_beam beam, kd_medium medium, float way)
{
    float x = medium.depth * way, passes = exp(-x);
    float mean = x < 0.25 ? 1.0 - x * (0.5 - x * (1.0 / 6.0 - x * (1.0 / 24.0 - x * (1.0 / 120.0 - x * (1.0 / 720.0)))))
                          : (1.0 - passes) / x;
    KD_PROBE_ON(beam.through * mean, way)
    beam.light += (beam.through * mean) * min(way * medium.light, KD_BEAM_MOST);
    beam.through *= passes;
}
#endif

#ifdef KD_MARCH
/* Adds the light of a surface. A surface transmits nothing. */
void kd_beam_met(inout kd_beam beam, kd_met met)
{
#define KD_MET_(number, name) \
    if (KD_HAS(name)) { \
        vec3 light = kd_##name##_light(met); \
        KD_PROBE_MET_(number, name, met, light, beam.through) \
        beam.light += beam.through * light; \
    }
    KD_EMITTERS(KD_NO_EMITTER_, KD_NO_EMITTER_, KD_NO_EMITTER_, KD_NO_EMITTER_, KD_NO_EMITTER_, KD_MET_)
    beam.through = 0.0;
}
#endif

void kd_beam_end(inout kd_beam beam, kd_end end)
{
    KD_PROBE_END(end)
#define KD_END_(number, name) \
    if (KD_HAS(name)) { \
        vec3 light = kd_##name##_end(end); \
        beam.light += beam.through * light; \
        KD_PROBE_LIGHT(KD_PROBE_OF_END, number, light) \
    }
    KD_EMITTERS(KD_NO_EMITTER_, KD_NO_EMITTER_, KD_NO_EMITTER_, KD_END_, KD_NO_EMITTER_, KD_NO_EMITTER_)
}

/* Adds the points of light of a pixel. They were spread over pixels independently of the pixels' own rays. */
void kd_beam_points(inout kd_beam beam, uint pixel)
{
#define KD_POINTS_(number, name) \
    if ((TRAITS_##name & KD_TRAIT_POINTS) != 0u) { \
        vec3 light = kd_##name##_points(pixel); \
        beam.light += beam.through * light; \
        KD_PROBE_LIGHT(KD_PROBE_OF_POINTS, number, light) \
    }
    KD_EMITTERS(KD_NO_EMITTER_, KD_NO_EMITTER_, KD_NO_EMITTER_, KD_POINTS_, KD_NO_EMITTER_, KD_NO_EMITTER_)
}

/* True if a pixel has any points of light. */
bool kd_beam_has_points(uint pixel)
{
    bool has = false;
#define KD_HAS_POINTS_(number, name) \
    if ((TRAITS_##name & KD_TRAIT_POINTS) != 0u) \
        has = has || kd_##name##_has_points(pixel);
    KD_EMITTERS(KD_NO_EMITTER_, KD_NO_EMITTER_, KD_NO_EMITTER_, KD_HAS_POINTS_, KD_NO_EMITTER_, KD_NO_EMITTER_)
    return has;
}

/* Marks a ray that was given up, with a colour that nothing in the sky has. Otherwise it would look complete. */
void kd_beam_given_up(inout kd_beam beam)
{
    beam.light += beam.through * vec3(1.0, 0.0, 1.0);
    beam.through = 0.0;
    KD_PROBE_GIVEN_UP
}

#endif
