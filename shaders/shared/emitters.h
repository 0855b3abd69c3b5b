/* Emitters are what sends light along a ray, takes it away or changes it. Each has a line here, in the order in
 * which they are composed at one place; the number is that of the specialisation constant TRAITS_name behind
 * KD_SPEC_TRAITS.
 *
 *   AT_CROSSING   kd_name_glow(sample): light of a crossing of the equatorial plane, and its opacity
 *   PART          nothing of its own: another emitter calls its functions, so that what both compute is computed
 *                 once
 *   OVER          kd_name_over(order): a factor of all light of a crossing of that order, and of what light volumes
 *                 have of it (kd_midst)
 *   ALONG         kd_name_along(point): what there is at a place of the ray, which shines and takes light away all
 *                 along it (a kd_medium of light/compose.glsl). Scenes that have one are lit by the march
 *                 (light/march.glsl), which takes as many places as the emitter's grain, its depth and the ray's
 *                 bending ask for; its C file says between which radii and latitudes it is
 *   MET           kd_name_light(met), kd_name_shift(met), kd_name_kelvin(met): light, 1/g and temperature of opaque
 *                 surfaces that the ray meets off the plane (light/meet.glsl), of which the first hides all behind
 *                 it. Scenes that have one are lit by the kernel of the march as well
 *   AT_END        kd_name_end(end): what a ray sees that has come through; kd_name_points(pixel): of those with
 *                 points of light, what a pixel has of them
 *
 * An emitter called name has its GLSL in emit/name.glsl, which says
 *
 *   KD_BLOCK_name(F, U, A)  which numbers it needs: F float, U uint, A(type, member, count) an array of structs
 *   KD_TABLES_name(T)       which tables: T(table, rows), rows of four floats
 *   KD_TRAITS_name(T)       which variants it has: T(trait), bits KD_TRAIT_trait of its word, some of which it may
 *                           share with others
 *   KD_BUFFERS_name(B)      which buffers it fills on the device before light is: B(number, type, member), numbered
 *                           from 0 among all emitters', of words, pairs of words or floats, which are read by
 *                           KD_OWN_WORD(member, at) and the like, or stored floats, member[at] (light/inputs.glsl)
 *   KD_PASS_name(P)         the pass of its own that fills them, if it has one: P(name, ID, word, guess). It is
 *                           timed and named in plans by the emitter's name, its kernel is comp/name.comp; what an
 *                           invocation costs is learned from frames as the figure KD_NS_ID, which GET /v1/device
 *                           calls by the word, and lavapipe's guess is the nanoseconds until then
 *
 * and holds the functions, for whoever defines KD_EMIT_CODE. src/render/emit/name.c fills numbers and tables in
 * (src/render/emit/emitter.h). Both files are found by the name: the build reads this list (shaders/meson.build). */
#ifndef KD_EMITTERS_H
#define KD_EMITTERS_H

#define KD_EMITTERS(AT_CROSSING, PART, OVER, AT_END, ALONG, MET) \
    AT_CROSSING(0, disk) \
    AT_CROSSING(1, particles) \
    PART(2, plunge) \
    AT_CROSSING(3, spots) \
    OVER(4, ringdown) \
    AT_END(5, sky) \
    AT_CROSSING(6, gas) \
    ALONG(7, volume) \
    ALONG(8, jets) \
    ALONG(9, thick) \
    MET(10, bodies) \
    AT_CROSSING(11, debris) \
    PART(12, polarization) \
    ALONG(13, plasma) \
    PART(14, stokes)

/* All that has numbers. */
#define KD_EMIT_BLOCKS(B) B(-1, frame) KD_EMITTERS(B, B, B, B, B, B)
/* All tables, by the KD_T(table, rows) that is defined where this stands; they lie one behind the other in this
 * order. */
#define KD_TABLES_OF_(number, name) KD_TABLES_##name(KD_T)
#define KD_EMIT_TABLES \
    KD_TABLES_colour(KD_T) \
        KD_EMITTERS(KD_TABLES_OF_, KD_TABLES_OF_, KD_TABLES_OF_, KD_TABLES_OF_, KD_TABLES_OF_, KD_TABLES_OF_)
/* All buffers, by the KD_B(number, type, member) that is defined there: bindings of the kernels of light from
 * KD_OWN_BINDING on. */
#define KD_BUFFERS_OF_(number, name) KD_BUFFERS_##name(KD_B)
#define KD_EMIT_BUFFERS \
    KD_EMITTERS(KD_BUFFERS_OF_, KD_BUFFERS_OF_, KD_BUFFERS_OF_, KD_BUFFERS_OF_, KD_BUFFERS_OF_, KD_BUFFERS_OF_)
#define KD_OWN_BINDING 5
/* layers.comp reads the light that the march has left here, in the place of the points of light, which are in it: a
 * device may have no more than 8 storage buffers for a kernel. */
#define KD_LIGHT_BINDING (KD_OWN_BINDING + 2)
/* All passes of their own, by the KD_P(name, ID, word, guess) that is defined there (render/plan/pass.h). */
#define KD_PASS_OF_(number, name) KD_PASS_##name(KD_P)
#define KD_EMIT_PASSES KD_EMITTERS(KD_PASS_OF_, KD_PASS_OF_, KD_PASS_OF_, KD_PASS_OF_, KD_PASS_OF_, KD_PASS_OF_)

/* Bits that each word has: the scene has the emitter; its luminance is kept apart as well, so that its flux and
 * centroid are measured by themselves. There is room for that of one. */
#define KD_TRAIT_PRESENT 1u
#define KD_TRAIT_APART 32u
#define KD_TRAIT_SLOW \
    16u /* what moves is shown as it was when its light left it; volumes are told how long ago that was */
#define KD_TRAIT_AZIMUTH \
    0x20000000u /* of volumes: it needs to know the azimuth of a place, and what of it a ray stands for */
#define KD_TRAIT_POINTS \
    0x80000000u /* it has points of light, which a pass of their own spreads over pixels (comp/star_images.comp) */
#define KD_TRAIT_SPREAD 0x40000000u /* it has light wherever a ray ends */

#endif
#include "emit/frame.glsl"
#include "emit/colour.glsl"
#include "emit/orbit.glsl"
#include "emitter_files.h" /* emit/disk.glsl and so on, in the order of the list */
