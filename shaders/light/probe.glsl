/* Describes what each emitter contributes to one ray. If transfer.comp, which makes the picture, is compiled with
 * KD_PROBE, it writes records to binding 3 instead of light. Otherwise this file compiles to nothing. The first number
 * written is the count of records, including those that did not fit. The records FRONT and WHOLE come next, at fixed
 * places, so that other records cannot displace them. A record has KD_PROBE_RECORD numbers. The first number is its
 * kind:
 *
 *   KD_PROBE_AT        a place: order, w, azimuth, slope, footprint, g, temperature (K), emission angle, transmission
 *                     of everything in front
 *     KD_PROBE_OF_PLACE  an emitter at that place: its number, light, opacity, transmitted fraction of its light
 *     KD_PROBE_ENDS      the ray's end: cosine of the polar angle, azimuth, footprint
 *     KD_PROBE_OF_END, KD_PROBE_OF_POINTS   an emitter at the ray's end: its number, light
 *   KD_PROBE_ALONG     a stretch through volumes: w and u at both ends, contributed light, transmission before and
 *                     after it; followed by KD_PROBE_ALONG_AT: the delay of light from both ends
 *   KD_PROBE_OF_VOLUME a volume, for the whole ray: its number, light as it arrives, optical depth
 *   KD_PROBE_MET       an opaque surface: number of its emitter, light, its index, crossings before it, cosine of the
 *                     emission angle, transmission in front; followed by KD_PROBE_MET_AT: w, u, azimuth, g
 *     KD_PROBE_POLARIZED for the place recorded before: ratios of Stokes Q and U to I
 *   KD_PROBE_LOST      the ray was given up
 *   KD_PROBE_FRONT     sums without what lies at the ray's end: light, transmission, steps and samples of the march,
 *                     Stokes Q, U and V of volumes, and 1 if these were computed, else 0
 *   KD_PROBE_WHOLE     the same sums with what lies at the ray's end */
#ifndef KD_PROBE_GLSL
#define KD_PROBE_GLSL

#ifdef KD_PROBE
layout(set = 0, binding = 3) writeonly buffer Told { float told[]; };
uint kd_probed_records = 0u;

float kd_layer_g(kd_sample s);
float kd_layer_temperature(kd_sample s);
float kd_layer_angle(float c);

void kd_probe_at(uint record, float of, vec4 a, vec4 b, vec2 c)
{
    uint at = 1u + KD_PROBE_RECORD * record;
    told[0] = float(kd_probed_records);
    if (at + KD_PROBE_RECORD > uint(told.length()))
        return;
    told[at] = of;
    for (uint k = 0u; k < 4u; k++) {
        told[at + 1u + k] = a[k];
        told[at + 5u + k] = b[k];
    }
    told[at + 9u] = c.x;
    told[at + 10u] = c.y;
}

void kd_probe(float of, vec4 a, vec4 b, vec2 c)
{
    kd_probed_records++;
    kd_probe_at(KD_PROBE_SUMS + kd_probed_records - 1u, of, a, b, c);
}

void kd_probe_place(kd_sample s, float through)
{
    float g = kd_layer_g(s);
    kd_probe(KD_PROBE_AT, vec4(s.order, s.w, s.phi, s.slope),
             vec4(s.footprint, g, kd_layer_temperature(s), kd_layer_angle(g * sqrt(max(s.q, 0.0)) * s.w)),
             vec2(through, 0.0));
}
#define KD_PROBE_PLACE(s, through) kd_probe_place(s, through);
#define KD_PROBE_GLOW(number, seen, glow) \
    kd_probe(KD_PROBE_OF_PLACE, vec4(number, glow.light), vec4(glow.alpha, seen, 0.0, 0.0), vec2(0.0));
#define KD_PROBE_POLARIZED_AT(s, place, up) \
    if (KD_HAS(polarization)) \
        kd_probe(KD_PROBE_POLARIZED, vec4(kd_polarization_at(s, kd_polarization_right(place), up), 0.0, 0.0), \
                 vec4(0.0), vec2(0.0));
/* Stretches of length 0 are not recorded. */
#define KD_PROBE_BEFORE(beam) kd_beam before = beam;
#define KD_PROBE_STRETCH(s, from, to, beam) \
    if (from < to) { \
        kd_probe( \
            KD_PROBE_ALONG, \
            vec4(kd_quintic_at(s.w, from), kd_quintic_at(s.w, to), kd_quintic_at(s.u, from), kd_quintic_at(s.u, to)), \
            vec4(beam.light - before.light, before.through), vec2(beam.through, 0.0)); \
        kd_probe(KD_PROBE_ALONG_AT, \
                 vec4(vec2(kd_march_ago(s, from), kd_march_ago(s, to)) + emission.frame.delay, 0.0, 0.0), vec4(0.0), \
                 vec2(0.0)); \
    }
#define KD_PROBE_END(end) kd_probe(KD_PROBE_ENDS, vec4(end.u, end.phi, end.footprint, 0.0), vec4(0.0), vec2(0.0));
#define KD_PROBE_LIGHT(of, number, light) kd_probe(of, vec4(number, light), vec4(0.0), vec2(0.0));
#define KD_PROBE_MET_(number, name, met, light, through) \
    kd_probe(KD_PROBE_MET, vec4(number, light), vec4(kd_##name##_which(met), met.crossed, met.cosine, through), \
             vec2(0.0)); \
    kd_probe(KD_PROBE_MET_AT, vec4(met.w, met.u, met.phi, 1.0 / kd_##name##_shift(met)), vec4(0.0), vec2(0.0));
#define KD_PROBE_GIVEN_UP kd_probe(KD_PROBE_LOST, vec4(0.0), vec4(0.0), vec2(0.0));
#define KD_PROBE_SUM(of, beam) \
    kd_probe_at(of == KD_PROBE_FRONT ? 0u : 1u, of, vec4(beam.light, beam.through), \
                vec4(kd_probed_steps, kd_probed_places, KD_PROBED_STOKES.xy), KD_PROBED_STOKES.zw);
#ifdef KD_MARCH
#define KD_PROBED_STOKES (KD_HAS(stokes) ? vec4(kd_stokes_seen, 1.0) : vec4(0.0))
#else
#define KD_PROBED_STOKES vec4(0.0)
#endif

/* Light and depth of each volume. kd_place_name: values at a sample, per unit of the affine parameter. kd_tried_name:
 * sums over the current stretch. kd_probed_name: sums over all accepted stretches. */
float kd_probed_steps = 0.0, kd_probed_places = 0.0;
#define KD_PROBE_NONE_(number, name)
#define KD_PROBE_VOLUME_(number, name) \
    vec4 kd_place_##name = vec4(0.0), kd_tried_##name = vec4(0.0), kd_probed_##name = vec4(0.0);
#define KD_PROBE_VOLUMES_(OF) \
    KD_EMITTERS(KD_PROBE_NONE_, KD_PROBE_NONE_, KD_PROBE_NONE_, KD_PROBE_NONE_, OF, KD_PROBE_NONE_)
KD_PROBE_VOLUMES_(KD_PROBE_VOLUME_)
#define KD_PROBE_MEDIUM(name, one) kd_place_##name = vec4(one.light, one.depth);
#define KD_PROBE_TRY_(number, name) kd_tried_##name = vec4(0.0);
#define KD_PROBE_TRY(places) \
    kd_probed_places += places; \
    KD_PROBE_VOLUMES_(KD_PROBE_TRY_)
#define KD_PROBE_ON_(number, name) \
    kd_tried_##name += vec4(tells * min(told_way * kd_place_##name.rgb, 1e30), told_way * kd_place_##name.a);
#define KD_PROBE_ON(comes, way) \
    { \
        float tells = comes, told_way = way; \
        KD_PROBE_VOLUMES_(KD_PROBE_ON_) \
    }
/* The stretch's light may exceed the sum over its samples. The excess is divided among the volumes in proportion to
 * their parts of that sum. */
#define KD_PROBE_TAKE_(number, name) kd_probed_##name += kd_tried_##name * vec4(share, 1.0);
#define KD_PROBE_TAKE(before, tried, rest) \
    { \
        vec3 added = tried - before, share = vec3(1.0) + rest / max(added, vec3(1e-30)); \
        share = vec3(added.r > 0.0 ? share.r : 1.0, added.g > 0.0 ? share.g : 1.0, added.b > 0.0 ? share.b : 1.0); \
        KD_PROBE_VOLUMES_(KD_PROBE_TAKE_) \
    }
#define KD_PROBE_OF_(number, name) \
    if (KD_HAS(name)) \
        kd_probe(KD_PROBE_OF_VOLUME, vec4(number, kd_probed_##name.rgb), vec4(kd_probed_##name.a, 0.0, 0.0, 0.0), \
                 vec2(0.0));
#define KD_PROBE_MARCHED(steps) \
    kd_probed_steps = float(steps); \
    KD_PROBE_VOLUMES_(KD_PROBE_OF_)
#else
#define KD_PROBE_MEDIUM(name, one)
#define KD_PROBE_TRY(places)
#define KD_PROBE_ON(comes, way)
#define KD_PROBE_TAKE(before, tried, rest)
#define KD_PROBE_MARCHED(steps)
#define KD_PROBE_MET_(number, name, met, light, through)
#define KD_PROBE_PLACE(s, through)
#define KD_PROBE_GLOW(number, seen, glow)
#define KD_PROBE_POLARIZED_AT(s, place, up)
#define KD_PROBE_BEFORE(beam)
#define KD_PROBE_STRETCH(s, from, to, beam)
#define KD_PROBE_END(end)
#define KD_PROBE_LIGHT(of, number, light)
#define KD_PROBE_GIVEN_UP
#define KD_PROBE_SUM(of, beam)
#endif

#endif
