/* Adds up light along one ray, front to back, of whatever emitters the scene has. Knows the list and no names:
 * kernels feed it samples, of crossings from a lens map (transfer.comp) or of places along the path. */
#ifndef KD_COMPOSE_GLSL
#define KD_COMPOSE_GLSL

/* This is one place on a ray. ago: how long before that which shows the scene's time its light left it; energy,
 * momentum, q: E, L and Carter's Q, by the energy that the observer measures; footprint, shape: of this ray there, 0
 * where no emitter needs it (shared/lens.h). */
struct kd_sample {
    float w, phi, ago, slope, energy, momentum, q, footprint, shape;
    uint order;
};
/* It ends there, if it escapes; its footprint in radians; its energy by that which the observer measures. */
struct kd_end { float u, phi, footprint, energy; };
/* One emitter adds this at a place: light, its opacity already in it; opacity; luminance that is kept apart as well. */
struct kd_glow {
    vec3 light;
    float alpha, apart;
};
/* This is the ellipse across a ray that it stands for, at the crossing of the plane that is nearest on it: M_rr,
 * M_rf, M_ff in the plane, as KD_LENS_SHAPE has it (shared/lens.h), and M_rz, M_fz, M_zz, M^2; z is along the
 * normal. */
struct kd_spread { vec3 plane, rise; };
/* This is a place in a volume that the ray goes through. w = 1/r, u = cos(theta), and what they grow by in Mino time
 * as the ray is traced, against the light: the arriving photon has p_r = dw/kd_delta(w), p_theta = du/sin(theta) and
 * the E, L and Q of `energy`, `momentum`, `q`, by the energy that the observer measures. speed: M of length in (r, r
 * n) a unit of Mino time, n being the direction from the hole, as if space were flat: what a grain is counted in.
 * phi: azimuth, source minus observer; spread: what the ray stands for: both 0 but for KD_TRAIT_AZIMUTH. order: of
 * the crossing of the plane that is nearest on the ray, as it has one up to where its cos(theta) turns: 0 where
 * nothing asks for it. ago: as in kd_sample: 0 but for KD_TRAIT_SLOW. nearest: 1/r of the ray's innermost crossing of
 * the plane; 0: none is known. */
struct kd_midst {
    float w, u, dw, du, energy, momentum, q, speed, phi;
    kd_spread spread;
    uint order;
    float ago;
    float nearest;
};
/* That is what is there. light: what is added to the light, and depth: optical depth, of a unit of the affine
 * parameter by the observer's energy: along a ray, d lambda = (r^2 + a^2 u^2) d tau, matter of velocity U sees the
 * way -k.U d lambda, so that of its emissivity j and opacity alpha, by its own length, depth = alpha (-k.U), and
 * bolometric light = j (-k.U)^-3, 1/(-k.U) being g. grain: M along the ray over which it changes by about its own
 * size; where there is nothing, as much as the way to where there is something. */
struct kd_medium {
    vec3 light;
    float depth, grain;
};
/* A surface that a ray meets. time: Mino time from the observer; body: which one, KD_NOBODY: none; crossed:
 * crossings of the plane before it; w, u, phi and dw, du as in kd_midst; energy, momentum: E and L; cosine: of the
 * angle of emission, in the frame of the surface. */
struct kd_met {
    float time;
    uint body, crossed;
    float w, u, phi, dw, du, energy, momentum, cosine;
};
#define KD_NOBODY 0xffffffffu
/* A ray on its way: the light so far, and what all in front lets pass. */
struct kd_beam {
    vec3 light;
    float apart, through;
};

#include "light/tell.glsl"

#define KD_SPEC_TRAIT_(number, name) layout(constant_id = KD_SPEC_TRAITS + number) const uint TRAITS_##name = 0;
KD_EMITTERS(KD_SPEC_TRAIT_, KD_SPEC_TRAIT_, KD_SPEC_TRAIT_, KD_SPEC_TRAIT_, KD_SPEC_TRAIT_, KD_SPEC_TRAIT_)
#define KD_HAS(name) ((TRAITS_##name & KD_TRAIT_PRESENT) != 0u)
#define KD_NO_EMITTER_(number, name)
/* Volumes in the scene. */
#define KD_PRESENT_(number, name) +((TRAITS_##name & KD_TRAIT_PRESENT) != 0u ? 1 : 0)
const int KD_VOLUMES =
    0 KD_EMITTERS(KD_NO_EMITTER_, KD_NO_EMITTER_, KD_NO_EMITTER_, KD_NO_EMITTER_, KD_PRESENT_, KD_NO_EMITTER_);

#define KD_BEAM_MOST 1e30 /* light that one place adds: more is no number when it is added up */

#define KD_EMIT_CODE
#define KD_EMIT_END_CODE
#include "shared/emitters.h"

/* These say whether anything is to be seen at crossings, and whether the luminance of some of it is kept apart. */
#define KD_OR_TRAITS_(number, name) | TRAITS_##name
const uint KD_ALL_TRAITS =
    0u KD_EMITTERS(KD_OR_TRAITS_, KD_NO_EMITTER_, KD_NO_EMITTER_, KD_NO_EMITTER_, KD_NO_EMITTER_, KD_NO_EMITTER_);
const bool KD_GLOWS = (KD_ALL_TRAITS & KD_TRAIT_PRESENT) != 0u;
const bool KD_APART = (KD_ALL_TRAITS & KD_TRAIT_APART) != 0u;
const uint KD_ALONG_TRAITS =
    0u KD_EMITTERS(KD_NO_EMITTER_, KD_NO_EMITTER_, KD_NO_EMITTER_, KD_NO_EMITTER_, KD_OR_TRAITS_, KD_NO_EMITTER_);
const uint KD_MET_TRAITS =
    0u KD_EMITTERS(KD_NO_EMITTER_, KD_NO_EMITTER_, KD_NO_EMITTER_, KD_NO_EMITTER_, KD_NO_EMITTER_, KD_OR_TRAITS_);
const bool KD_MARCHES = (KD_ALONG_TRAITS & KD_TRAIT_PRESENT) != 0u, KD_MEETS = (KD_MET_TRAITS & KD_TRAIT_PRESENT) != 0u;
/* This says whether light changes by its order. */
const uint KD_OVER_TRAITS =
    0u KD_EMITTERS(KD_NO_EMITTER_, KD_NO_EMITTER_, KD_OR_TRAITS_, KD_NO_EMITTER_, KD_NO_EMITTER_, KD_NO_EMITTER_);
const bool KD_OVERS = (KD_OVER_TRAITS & KD_TRAIT_PRESENT) != 0u;
/* This says whether anything shines where rays end. */
const uint KD_END_TRAITS =
    0u KD_EMITTERS(KD_NO_EMITTER_, KD_NO_EMITTER_, KD_NO_EMITTER_, KD_OR_TRAITS_, KD_NO_EMITTER_, KD_NO_EMITTER_);
const bool KD_ENDS = (KD_END_TRAITS & KD_TRAIT_PRESENT) != 0u;

/* All emitters of a place are in it together: none hides another's light. */
void kd_beam_at(inout kd_beam beam, kd_sample s)
{
    float seen = beam.through;
    KD_TELL_PLACE(s, beam.through)
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
        KD_TELL_GLOW(number, seen, glow) \
    }
    KD_EMITTERS(KD_GLOW_, KD_NO_EMITTER_, KD_NO_EMITTER_, KD_NO_EMITTER_, KD_NO_EMITTER_, KD_NO_EMITTER_)
}

#ifdef KD_MARCH
/* All emitters of a place are in it together. */
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
        KD_TELL_MEDIUM(name, one) \
        sum.light += one.light; \
        sum.depth += one.depth; \
        sum.grain = min(sum.grain, one.grain); \
    }
    KD_EMITTERS(KD_NO_EMITTER_, KD_NO_EMITTER_, KD_NO_EMITTER_, KD_NO_EMITTER_, KD_ALONG_, KD_NO_EMITTER_)
    return sum;
}

/* The ray goes `way` of its affine parameter through a medium that is the same all along: exact, whatever the depth. */
void kd_beam_along(inout kd_beam beam, kd_medium medium, float way)
{
    float x = medium.depth * way, passes = exp(-x);
    float mean = x < 0.25 ? 1.0 - x * (0.5 - x * (1.0 / 6.0 - x * (1.0 / 24.0 - x * (1.0 / 120.0 - x * (1.0 / 720.0)))))
                          : (1.0 - passes) / x;
    KD_TELL_ON(beam.through * mean, way)
    beam.light += (beam.through * mean) * min(way * medium.light, KD_BEAM_MOST);
    beam.through *= passes;
}
#endif

#ifdef KD_MARCH
/* Nothing comes through what is met. */
void kd_beam_met(inout kd_beam beam, kd_met met)
{
#define KD_MET_(number, name) \
    if (KD_HAS(name)) { \
        vec3 light = kd_##name##_light(met); \
        KD_TELL_MET_(number, name, met, light, beam.through) \
        beam.light += beam.through * light; \
    }
    KD_EMITTERS(KD_NO_EMITTER_, KD_NO_EMITTER_, KD_NO_EMITTER_, KD_NO_EMITTER_, KD_NO_EMITTER_, KD_MET_)
    beam.through = 0.0;
}
#endif

void kd_beam_end(inout kd_beam beam, kd_end end)
{
    KD_TELL_END(end)
#define KD_END_(number, name) \
    if (KD_HAS(name)) { \
        vec3 light = kd_##name##_end(end); \
        beam.light += beam.through * light; \
        KD_TELL_LIGHT(KD_TELL_OF_END, number, light) \
    }
    KD_EMITTERS(KD_NO_EMITTER_, KD_NO_EMITTER_, KD_NO_EMITTER_, KD_END_, KD_NO_EMITTER_, KD_NO_EMITTER_)
}

/* Points of light are spread over pixels, whatever becomes of a pixel's own rays. */
void kd_beam_points(inout kd_beam beam, uint pixel)
{
#define KD_POINTS_(number, name) \
    if ((TRAITS_##name & KD_TRAIT_POINTS) != 0u) { \
        vec3 light = kd_##name##_points(pixel); \
        beam.light += beam.through * light; \
        KD_TELL_LIGHT(KD_TELL_OF_POINTS, number, light) \
    }
    KD_EMITTERS(KD_NO_EMITTER_, KD_NO_EMITTER_, KD_NO_EMITTER_, KD_POINTS_, KD_NO_EMITTER_, KD_NO_EMITTER_)
}

/* Nothing in the sky has this colour: a ray that was given up is not painted as if it had finished. */
void kd_beam_given_up(inout kd_beam beam)
{
    beam.light += beam.through * vec3(1.0, 0.0, 1.0);
    beam.through = 0.0;
    KD_TELL_GIVEN_UP
}

#endif
