/* The emitters: what sends light along a ray, takes it away or changes it. One line each, in the order in which they are composed at one
 * place; the number is that of the specialisation constant TRAITS_name behind KD_SPEC_TRAITS.
 *
 *   AT_CROSSING   kd_name_glow(sample): light of a crossing of the equatorial plane, and its opacity
 *   PART          nothing of its own: another emitter calls its functions, so that what both compute is computed once
 *   OVER          kd_name_over(sample): a factor of all light of a crossing
 *   AT_END        kd_name_end(end): what a ray sees that has come through
 *
 * Of an emitter called name, emit/name.glsl says by KD_BLOCK_name(F, U, A) which numbers it needs (F float, U uint, A(type, member,
 * count) an array of structs), by KD_TABLES_name(T) which tables (T(name, first, rows): rows of four floats behind those of others), by KD_TRAIT_... which
 * variants it has; and it holds the functions, for whoever defines KD_EMIT_CODE. src/render/emit/name.c fills numbers and tables in
 * (src/render/emit/emitter.h). */
#ifndef KD_EMITTERS_H
#define KD_EMITTERS_H

#define KD_EMITTERS(AT_CROSSING, PART, OVER, AT_END)                                                           \
    AT_CROSSING(0, disk)                                                                                       \
    AT_CROSSING(1, particles)                                                                                  \
    PART(2, plunge)                                                                                            \
    AT_CROSSING(3, spots)                                                                                      \
    OVER(4, ringdown)                                                                                          \
    AT_END(5, sky)                                                                                             \
    AT_CROSSING(6, gas)

/* All that has numbers; and tables. */
#define KD_EMIT_BLOCKS(B) B(-1, frame) KD_EMITTERS(B, B, B, B)
#define KD_EMIT_TABLES(T) KD_TABLES_colour(T) KD_TABLES_disk(T) KD_TABLES_plunge(T) KD_TABLES_gas(T)

/* Bits that each word has: the scene has the emitter; its luminance is kept apart as well, so that its flux and centroid are measured by
 * themselves. There is room for that of one. */
#define KD_TRAIT_PRESENT 1u
#define KD_TRAIT_APART 32u

#endif
#include "emit/frame.glsl"
#include "emit/colour.glsl"
#include "emit/orbit.glsl"
#include "emit/disk.glsl"
#include "emit/particles.glsl"
#include "emit/plunge.glsl"
#include "emit/spots.glsl"
#include "emit/ringdown.glsl"
#include "emit/sky.glsl"
#include "emit/gas.glsl"
