/* The list of emitters, which send light along a ray, absorb it or change it. Each emitter has a line here, in the
 * order of composition at one place. A line is of one of these kinds: An emitter's number, added to KD_SPEC_TRAITS, is
 * the id of its specialisation constant TRAITS_name.
 *
 *   AT_CROSSING   kd_name_glow(sample): light of a crossing of the equatorial plane, and its opacity
 *   HELPER        no light of its own: other emitters call its functions, so that shared values are computed once
 *   MODULATE      kd_name_over(order): a factor for all light of a crossing of that order, and for a part of the light
 *                 of volumes (kd_midst)
 *   ALONG         kd_name_along(point): emission and absorption of a volume at a point of the ray (a kd_medium of
 *                 light/compose.glsl). Scenes with such an emitter are lit by the march (light/march.glsl), whose step
 *                 length follows the emitter's grain, its optical depth and the ray's bending. The emitter's C file
 *                 gives its range of radii and latitudes
 *   SURFACE       kd_name_light(met), kd_name_shift(met), kd_name_kelvin(met): light, 1/g and temperature of opaque
 *                 surfaces off the plane (light/meet.glsl), the first of which hides everything behind it. Scenes with
 *                 such an emitter are lit by the march's kernel as well
 *   AT_END        kd_name_end(end): light at the end of a ray that was transmitted; kd_name_points(pixel): for points
 *                 of light, their contribution to a pixel; kd_name_has_points(pixel): whether there is any
 *
 * The GLSL of an emitter called name is emit/name.glsl, which defines
 *
 *   KD_BLOCK_name(F, U, A)  its numbers: F float, U uint, A(type, member, count) an array of structs
 *   KD_TABLES_name(T)       its tables: T(table, rows), rows of four floats
 *   KD_TRAITS_name(T)       its variants: T(trait), bits KD_TRAIT_trait of its word; emitters may share traits
 *   KD_BUFFERS_name(B)      device buffers that it fills before the light passes: B(number, type, member), numbered
 *                           from 0 over all emitters. They hold words, pairs of words or floats, which are read by
 *                           KD_OWN_WORD(member, at) and the like, stored floats, member[at], or quads of words, which
 *                           are stored or texels by KD_TRAIT_TEXELS (light/inputs.glsl)
 *   KD_PASS_name(P)         the pass that fills them, if it has one: P(name, ID, word, guess). It is timed and named
 *                           in plans by the emitter's name, and its kernel is comp/name.comp. The cost of an
 *                           invocation is measured on frames as the figure KD_NS_ID, which GET /v1/device calls
 *                           `word`; until then it is `guess`, in ns on lavapipe
 *
 * and, if KD_EMIT_CODE is defined, its functions. src/render/emit/name.c computes numbers and tables
 * (src/render/emit/emitter.h). Both files are found by the name: the build reads this list (shaders/meson.build). */
#ifndef KD_EMITTERS_H
#define KD_EMITTERS_H

#define KD_EMITTERS(AT_CROSSING, HELPER, MODULATE, AT_END, ALONG, SURFACE) \
    AT_CROSSING(0, disk) \
    AT_CROSSING(1, particles) \
    HELPER(2, plunge) \
    AT_CROSSING(3, spots) \
    MODULATE(4, ringdown) \
    AT_END(5, sky) \
    AT_CROSSING(6, gas) \
    ALONG(7, volume) \
    ALONG(8, jets) \
    ALONG(9, thick) \
    SURFACE(10, bodies) \
    AT_CROSSING(11, debris) \
    HELPER(12, polarization) \
    ALONG(13, plasma) \
    HELPER(14, stokes) \
    HELPER(15, lamp) \
    AT_CROSSING(16, flash)

/* The blocks of numbers of all emitters and of the frame. */
#define KD_EMIT_BLOCKS(B) B(-1, frame) KD_EMITTERS(B, B, B, B, B, B)
/* Expands KD_T(table, rows) for each table of all emitters, in sequence. The place of use defines KD_T. */
#define KD_TABLES_OF_(number, name) KD_TABLES_##name(KD_T)
#define KD_EMIT_TABLES \
    KD_TABLES_colour(KD_T) \
        KD_EMITTERS(KD_TABLES_OF_, KD_TABLES_OF_, KD_TABLES_OF_, KD_TABLES_OF_, KD_TABLES_OF_, KD_TABLES_OF_)
/* Expands KD_B(number, type, member) for each buffer of all emitters. The place of use defines KD_B. The buffers are
 * bindings of the kernels of light, from KD_OWN_BINDING on. */
#define KD_BUFFERS_OF_(number, name) KD_BUFFERS_##name(KD_B)
#define KD_EMIT_BUFFERS \
    KD_EMITTERS(KD_BUFFERS_OF_, KD_BUFFERS_OF_, KD_BUFFERS_OF_, KD_BUFFERS_OF_, KD_BUFFERS_OF_, KD_BUFFERS_OF_)
#define KD_OWN_BINDING 5
/* Binding at which layers.comp reads the light that the march has stored. It is the same as the binding for points of
 * light, because the stored light already includes the points, and because a device may allow only 8 storage buffers
 * for a kernel. */
#define KD_LIGHT_BINDING (KD_OWN_BINDING + 2)
/* Expands KD_P(name, ID, word, guess) for each pass that belongs to an emitter (render/plan/pass.h). The place of use
 * defines KD_P. */
#define KD_PASS_OF_(number, name) KD_PASS_##name(KD_P)
#define KD_EMIT_PASSES KD_EMITTERS(KD_PASS_OF_, KD_PASS_OF_, KD_PASS_OF_, KD_PASS_OF_, KD_PASS_OF_, KD_PASS_OF_)

/* Bits that every emitter's word has. PRESENT: the scene has the emitter. SEPARATE_PHOTOMETRY: the emitter's luminance
 * is also stored separately, so that its flux and centroid can be measured. Only one emitter can have the latter bit.
 * */
#define KD_TRAIT_PRESENT 1u
#define KD_TRAIT_SEPARATE_PHOTOMETRY 32u
#define KD_TRAIT_SLOW \
    16u /* slow light: moving emitters are shown as they were when their light left them; volumes then get the light \
         * delay */
#define KD_TRAIT_AZIMUTH \
    0x20000000u /* for volumes: the emitter needs the azimuth of a point, and the ray's footprint at that point */
#define KD_TRAIT_POINTS \
    0x80000000u /* the emitter has points of light, which a separate pass spreads over pixels: comp/star_images.comp \
                 */
#define KD_TRAIT_TEXELS \
    0x10000000u /* the device reads the emitter's buffer of quads as texels; kd_emit_as_texels sets this bit */
#define KD_TRAIT_SPREAD 0x40000000u /* the emitter emits light in all directions of the sky, wherever a ray ends */

#endif
#include "emit/frame.glsl"
#include "emit/colour.glsl"
#include "emit/orbit.glsl"
#include "emitter_files.h" /* includes emit/disk.glsl and the files of the other emitters, in the order of the list */
#include "emit/cosine.glsl"
