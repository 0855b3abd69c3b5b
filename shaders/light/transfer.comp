/* Kernel: makes light (linear sRGB radiance) from the lens map. An invocation lights a pixel, or a column of
 * KD_TRANSFER_ROWS pixels. There are two variants for scenes with volumes, which follow the rays themselves. With
 * KD_MARCH a dispatch follows one ray of each pixel, the ray with the number slice.ray. With KD_PIECES a dispatch
 * continues the rays that KD_MARCH could not complete, by one piece. */
#version 450
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#include "shared/interface.h"
#include "shared/spec.h"
KD_SPEC_TRANSFER(KD_SPEC_U_, KD_SPEC_B_)
#include "light/inputs.glsl"
#ifdef KD_MARCH
#define KD_RADIANCE_ACCESS
#else
#define KD_RADIANCE_ACCESS writeonly
#endif
#ifndef KD_PROBE
layout(set = 0, binding = 3) KD_RADIANCE_ACCESS buffer Radiance { float radiance[]; };
#ifdef KD_MARCH
/* The buffer of light again, as words. After the light it holds the list of rays that were not completed (KD_LOST_...).
 * */
layout(set = 0, binding = 3) buffer Lost { uint lost_rays[]; };
layout(set = 0, binding = 3) buffer Pieces { float pieces[]; };
#endif
#endif

const vec3 LUMINANCE = vec3(0.2126, 0.7152, 0.0722);

/* State of a ray if STOKES is set: Stokes Q, U and V of all its light, Q and U of the separate luminance, and
 * whether it was given up. */
vec3 stokes = vec3(0.0);
vec2 stokes_apart = vec2(0.0);
bool untold = false;

void forget_stokes()
{
    stokes = vec3(0.0);
    stokes_apart = vec2(0.0);
    untold = false;
}

/* True if a crossing at w has light. Also true if w is negative, which marks a ray that was given up. */
bool has_light(float w) { return w < 0.0 || (w >= emission.frame.w_least && w <= emission.frame.w_most); }

/* Composes the crossing of order n of the ray at `place` in the camera, with index `at` in the lens map. w = 1/r of the
 * crossing; it is negative if the ray was given up on its way to the crossing. */
void meet(inout kd_beam beam, float w, uint n, uvec2 place, uint at)
{
    kd_ray ray = kd_camera_ray(place.x, place.y);
    float momentum = ((QUANTITIES & KD_LENS_ALPHA) != 0u ? -quantity(KD_LENS_ALPHA, at) : ray.l) * cam.s;
    uint plane = at + n * slice.stride;
    float ago = SLOW ? quantity(KD_LENS_DELAY, plane) - emission.frame.delay : 0.0,
          slope = quantity(KD_LENS_SLOPE, plane);
    float carter = (QUANTITIES & KD_LENS_ALPHA) != 0u
                       ? kd_carter_of_slope(ray.e, momentum, w, slope)
                       : ray.p * ray.p + cam.u * cam.u * (ray.l * ray.l - cam.spin * cam.spin * ray.e * ray.e);
    if (w < 0.0) {
        kd_beam_given_up(beam);
        untold = true;
        return;
    }
    kd_sample s = kd_with_cosine(kd_sample(w, quantity(KD_LENS_PHI, plane), ago, slope, ray.e, momentum, carter,
                                           quantity(KD_LENS_FOOTPRINT, plane), quantity(KD_LENS_SHAPE, plane), n, 0.0));
    float before = dot(beam.light, LUMINANCE), before_apart = beam.apart;
    kd_beam_at(beam, s);
    KD_PROBE_POLARIZED_AT(s, place, ray.p)
    if (STOKES && KD_HAS(polarization)) { /* all light of a crossing has the same polarisation */
        vec2 part = kd_polarization_at(s, kd_polarization_right(place), ray.p);
        stokes.xy += (dot(beam.light, LUMINANCE) - before) * part;
        stokes_apart += (beam.apart - before_apart) * part;
    }
}

/* True if the picture shows the ends of rays. A map may hold these ends only because layers need them; the picture must
 * not depend on that. */
const bool ENDS = (KD_END_TRAITS & KD_TRAIT_PRESENT) * (QUANTITIES & KD_LENS_FATE) != 0u;

/* Light behind all crossings. */
vec3 background(uvec2 place, uint at, uint pixel)
{
    kd_beam beam = kd_beam(vec3(0.0), 0.0, 1.0);
    float fate = ENDS ? quantity(KD_LENS_FATE, at) : KD_FATE_CAPTURED;
    if (fate == KD_FATE_UNDECIDED) {
        kd_beam_given_up(beam);
        untold = true;
    }
    if (fate == KD_FATE_ESCAPED)
        kd_beam_end(beam, kd_end(quantity(KD_LENS_SKY_U, at), quantity(KD_LENS_SKY_PHI, at),
                                 quantity(KD_LENS_SKY_FOOTPRINT, at), kd_camera_ray(place.x, place.y).e));
    if (ENDS && fate != KD_FATE_UNDECIDED)
        kd_beam_points(beam, pixel);
    return beam.light;
}

#ifdef KD_MARCH
#define KD_MARCH_MEET(beam, w, n, place, at) meet(beam, w, n, place, at)
bool lost = false; /* true if the current ray was given up */
#define KD_MARCH_GIVEN_UP(beam) (kd_beam_given_up(beam), lost = true, untold = true)
#include "light/march.glsl"
#include "light/meet.glsl"

/* Continues one ray to its end, and adds the light there, or continues it to the end of its piece. */
void follow_on(inout kd_beam beam, uvec2 place, uint at, uint pixel)
{
    kd_follow(beam, place, at);
    if (KD_MARCH_WAITS)
        return;
    if (STOKES && KD_HAS(stokes))
        stokes += kd_stokes_seen;
    KD_PROBE_SUM(KD_PROBE_FRONT, beam)
    if (ENDS)
        beam.light += beam.through * background(place, at, pixel);
    KD_PROBE_SUM(KD_PROBE_WHOLE, beam)
}

kd_beam follow(uvec2 place, uint at, uint pixel)
{
    kd_beam beam = kd_beam(vec3(0.0), 0.0, 1.0);
    follow_on(beam, place, at, pixel);
    return beam;
}
#else
/* w of the ray's first crossing with light, from crossing n on; 0 if there is none. Sets n to that crossing's number.
 * For a probe every crossing counts, with light or without. */
float next_crossing(uint at, inout uint n)
{
    float w = 0.0;
    bool goes = n < ORDERS;
    do {
        w = goes ? KD_MAP_AT(at + n * slice.stride) : 0.0;
#ifdef KD_PROBE
        goes = false;
#else
        goes = w != 0.0 && !has_light(w);
#endif
        n += goes ? 1u : 0u;
    } while (goes && n < ORDERS);
    return goes ? 0.0 : w;
}

/* Follows one ray, including the light at its end. */
kd_beam follow(uvec2 place, uint at, uint pixel)
{
    kd_beam beam = kd_beam(vec3(0.0), 0.0, 1.0);
    forget_stokes();
    if (KD_GLOWS && ORDERS > 0u) {
        uint n = 0u;
        float w = next_crossing(at, n);
        do {
            if (w != 0.0)
                meet(beam, w, n, place, at);
            n++;
            w = beam.through > 0.0 && w != 0.0 ? next_crossing(at, n) : 0.0;
        } while (w != 0.0);
    }
    KD_PROBE_SUM(KD_PROBE_FRONT, beam)
    if (ENDS)
        beam.light += beam.through * background(place, at, pixel);
    KD_PROBE_SUM(KD_PROBE_WHOLE, beam)
    return beam;
}
#endif

/* Index of a pixel's light. */
uint light_at(uint x, uint y)
{
    return (y - (CRITICAL > 0 ? slice.band0 : slice.band0 / SIDE)) * emission.frame.pixels_x + x;
}

#ifdef KD_PROBE
#include "light/numbers.glsl"

/* Follows one ray, given by the push constants. On the grid the ray is in row row0 and column `rows` of the rays. On
 * listed pixels it is ray number `ray` of pixel number row0 in the list. */
void main()
{
    kd_camera_read();
    KD_EMIT_BLOCKS(READ)
    if (gl_GlobalInvocationID.x > 0)
        return;
    uvec2 pixel = CRITICAL > 0 ? kd_listed_pixel(slice.row0) : uvec2(slice.rows, slice.row0) / SIDE;
    uvec2 place = CRITICAL > 0 ? kd_critical_place(pixel, slice.ray) : uvec2(slice.rows, slice.row0);
    follow(place, CRITICAL > 0 ? slice.row0 * CRITICAL + slice.ray : (place.y - slice.band0) * cam.width + place.x,
           light_at(pixel.x, pixel.y));
}
#else
void store_light(uint at, vec3 light)
{
    radiance[3 * at] = light.r;
    radiance[3 * at + 1] = light.g;
    radiance[3 * at + 2] = light.b;
}

/* Planes of numbers that follow the light of the band's pixels, with one number for each pixel. They are the separate
 * luminance; Stokes Q, U and V of all light; and Q and U of the separate light. */
const uint STOKES_AT = KD_SEPARATE_PHOTOMETRY ? 4u : 3u;
void store(uint at, vec3 light, float apart, vec3 all, vec2 spots)
{
    uint pixels = emission.frame.band_pixels, to = STOKES_AT * pixels + at;
    store_light(at, light);
    if (KD_SEPARATE_PHOTOMETRY)
        radiance[3 * pixels + at] = apart;
    if (STOKES) {
        radiance[to] = all.x;
        radiance[to + pixels] = all.y;
        radiance[to + 2 * pixels] = all.z;
    }
    if (STOKES && KD_SEPARATE_PHOTOMETRY && KD_HAS(polarization)) {
        radiance[to + 3 * pixels] = spots.x;
        radiance[to + 4 * pixels] = spots.y;
    }
}

/* COLUMNS: an invocation lights KD_TRANSFER_ROWS pixels of a column, with one ray each and without diffuse light behind
 * them. Pixels without light are not written; they were set to black before.
 *
 * lavapipe executes both sides of a branch, and skips work only by leaving a loop. So a first, cheap loop finds the
 * pixels and crossings that have light, and a second loop lights only these. With diffuse light on the sky every pixel
 * has light, and the search would only cost time. */
#ifdef KD_MARCH
/* not used for the march, whose error is measured on a lattice of pixels (src/render/frame/march_error.c) */
const bool COLUMNS = false, SAMPLES = CRITICAL == 0;
#else
const bool SAMPLES = false;
const bool COLUMNS =
    SIDE == 1 && CRITICAL == 0 && (KD_END_TRAITS / KD_TRAIT_SPREAD & 1u) * (QUANTITIES & KD_LENS_FATE) == 0u;
#endif

/* If the sky consists of points only, the points of all pixels are composed first, and pixels with a crossing are lit
 * again afterwards. This saves time, because most pixels have no points. */
void point_column(uint x, uint y, uint end)
{
    uint has = 0u; /* bit k is set if the pixel in row y + k has points of light, or if its ray has no end */
    [[unroll]] for (uint k = 0u; k < KD_TRANSFER_ROWS; k++) {
        uint row = min(y + k, end - 1u);
        float fate = quantity(KD_LENS_FATE, (row - slice.band0) * cam.width + x);
        bool seen = fate == KD_FATE_UNDECIDED || kd_beam_has_points(light_at(x, row));
        has |= seen && y + k < end ? 1u << k : 0u;
    }
    do {
        uint row = y + uint(findLSB(has | 0x80000000u)), to = light_at(x, row);
        if (has != 0u)
            store(to, background(uvec2(x, row), (row - slice.band0) * cam.width + x, to), 0.0, vec3(0.0), vec2(0.0));
        has &= has - 1u;
    } while (has != 0u);
}

/* Number of rows whose crossings fit in the bits of one word. */
const uint AHEAD = KD_TRANSFER_ROWS * ORDERS > 32u ? 32u / ORDERS : KD_TRANSFER_ROWS;

/* The crossings with light of AHEAD pixels of a column, from row y on: bit ORDERS k + n for order n of row y + k. All
 * crossings are read before the first one is lit, so that the reads wait for memory together. */
uint lit_of(uint x, uint y, uint end)
{
    uint at = (y - slice.band0) * cam.width + x, lit = 0u, n = 0u;
    bool more; /* true if any ray crosses the plane once more */
    [[dont_unroll]] do {
        more = false;
        [[unroll]] for (uint k = 0u; k < KD_TRANSFER_ROWS; k++) {
            float w = KD_MAP_AT(at + min(k, end - 1u - y) * cam.width + n * slice.stride);
            more = more || w != 0.0;
            lit |= has_light(w) && k < AHEAD && y + k < end ? 1u << (ORDERS * k + n) : 0u;
        }
    } while (++n < ORDERS && more);
    return lit;
}

void light_rows(uint x, uint y, uint end)
{
    uint lit = lit_of(x, y, end), of = end;
    kd_beam beam = kd_beam(vec3(0.0), 0.0, 1.0);
    do {
        uint next = uint(findLSB(lit | 0x80000000u)), k = next / ORDERS, n = next - ORDERS * k, row = y + k,
             at = (row - slice.band0) * cam.width + x;
        if (row != of) {
            beam = kd_beam(vec3(0.0), 0.0, 1.0);
            forget_stokes();
        }
        of = row;
        if (lit != 0u) {
            meet(beam, KD_MAP_AT(at + n * slice.stride), n, uvec2(x, row), at);
            vec3 behind = ENDS ? beam.through * background(uvec2(x, row), at, light_at(x, row)) : vec3(0.0);
            store(light_at(x, row), beam.light + behind, beam.apart, stokes, stokes_apart);
        }
        uint hidden = ((1u << ORDERS) - 1u) << (ORDERS * k); /* bits of all crossings of row y + k's ray */
        lit &= beam.through > 0.0 ? lit - 1u : ~hidden;
    } while (lit != 0u);
}

/* place_of: place in the camera of a pixel's ray. map_of: index of that ray in the lens map. listed: index of the pixel
 * in the list. */
uvec2 place_of(uvec2 pixel, uint ray)
{
    return CRITICAL > 0 ? kd_critical_place(pixel, ray) : pixel * SIDE + uvec2(ray % SIDE, ray / SIDE);
}
uint map_of(uvec2 place, uint listed, uint ray)
{
    return CRITICAL > 0 ? listed * CRITICAL + ray : (place.y - slice.band0) * cam.width + place.x;
}

/* Follows one ray. Its light goes to index `to`. */
kd_beam follow_one(uvec2 pixel, uint listed, uint ray, uint to)
{
    uvec2 place = place_of(pixel, ray);
    return follow(place, map_of(place, listed, ray), to);
}

#ifdef KD_MARCH
const uint RAYS = CRITICAL > 0 ? CRITICAL : SIDE * SIDE;

/* Stores a ray's share of its pixel's light, or adds it to the light of earlier rays. */
void store_ray(uint to, kd_beam beam, bool adds)
{
    const float share = 1.0 / float(RAYS);
    vec3 sum = share * beam.light;
    float apart = share * beam.apart;
    vec3 all = share * stokes;
    vec2 spots = share * stokes_apart;
    if (adds) {
        const uint pixels = emission.frame.band_pixels, from = STOKES_AT * pixels + to;
        sum += vec3(radiance[3 * to], radiance[3 * to + 1], radiance[3 * to + 2]);
        apart += KD_SEPARATE_PHOTOMETRY ? radiance[3 * pixels + to] : 0.0;
        if (STOKES)
            all += vec3(radiance[from], radiance[from + pixels], radiance[from + 2 * pixels]);
        if (STOKES && KD_SEPARATE_PHOTOMETRY && KD_HAS(polarization))
            spots += vec2(radiance[from + 3 * pixels], radiance[from + 4 * pixels]);
    }
    if (untold || all.z > KD_STOKES_LEAST_UNTOLD) /* the pixel counts as given up, whatever its other rays' light is */
        all.z = KD_STOKES_UNTOLD;
    store(to, sum, apart, all, spots);
}

/* Index of a word of the list. `at` counts back from the end of the buffer. */
uint lost_word(uint at) { return lost_rays.length() - at; }

/* Lists a ray that was not completed, and gives it no light yet. If the list is full, the ray is given up. name: number
 * of the ray (KD_LOST_...). */
void lose(inout kd_beam beam, uint name)
{
    uint n = atomicAdd(lost_rays[lost_word(KD_LOST_LISTED)], 1u);
    if (n >= slice.lost_most) {
        atomicAdd(lost_rays[lost_word(KD_LOST_GIVEN_UP)], 1u);
        return;
    }
    lost_rays[lost_word(KD_LOST_RAYS) - n] = name;
    beam = kd_beam(vec3(0.0), 0.0, 0.0);
    forget_stokes();
}
#endif

#ifdef KD_PIECES
/* Offset of the state of a ray, which is saved between two pieces. */
uint state_at() { return lost_word(KD_LOST_STATES) - (gl_GlobalInvocationID.x + 1u) * KD_LOST_STATE; }

kd_beam begin_piece()
{
    kd_beam beam = kd_beam(vec3(0.0), 0.0, 1.0);
    kd_march_at = kd_march_piece(KD_PIECE_PASSES, 0u, 0.0, 0.0, false);
    kd_stokes_seen = vec3(0.0);
    kd_stokes_front = kd_jones_one();
    if (slice.lost_goes == 0u)
        return beam;
    uint k = state_at();
    kd_march_at.steps = lost_rays[k];
    kd_march_at.from = pieces[k + 1u];
    kd_march_at.stretch = pieces[k + 2u];
    untold = lost_rays[k + 3u] != 0u;
    beam = kd_beam(vec3(pieces[k + 4u], pieces[k + 5u], pieces[k + 6u]), pieces[k + 7u], pieces[k + 8u]);
    stokes = vec3(pieces[k + 9u], pieces[k + 10u], pieces[k + 11u]);
    stokes_apart = vec2(pieces[k + 12u], pieces[k + 13u]);
    kd_stokes_seen = vec3(pieces[k + 14u], pieces[k + 15u], pieces[k + 16u]);
    kd_stokes_front =
        kd_jones(vec2(pieces[k + 17u], pieces[k + 18u]), vec3(pieces[k + 19u], pieces[k + 20u], pieces[k + 21u]),
                 vec3(pieces[k + 22u], pieces[k + 23u], pieces[k + 24u]));
    return beam;
}

void end_piece(kd_beam beam)
{
    uint k = state_at();
    lost_rays[k] = kd_march_at.steps;
    pieces[k + 1u] = kd_march_at.from;
    pieces[k + 2u] = kd_march_at.stretch;
    lost_rays[k + 3u] = untold ? 1u : 0u;
    for (int i = 0; i < 3; i++) {
        pieces[k + 4u + i] = beam.light[i];
        pieces[k + 9u + i] = stokes[i];
        pieces[k + 14u + i] = kd_stokes_seen[i];
        pieces[k + 19u + i] = kd_stokes_front.re[i];
        pieces[k + 22u + i] = kd_stokes_front.im[i];
    }
    pieces[k + 7u] = beam.apart;
    pieces[k + 8u] = beam.through;
    for (int i = 0; i < 2; i++) {
        pieces[k + 12u + i] = stokes_apart[i];
        pieces[k + 17u + i] = kd_stokes_front.s[i];
    }
    atomicAdd(lost_rays[lost_word(KD_LOST_WAITING)], 1u);
}

/* A pixel may have several listed rays. For each pixel, this function follows the next piece of the ray with the number
 * slice.ray, if that ray is unfinished. */
void main()
{
    kd_camera_read();
    KD_EMIT_BLOCKS(READ)
    if (gl_GlobalInvocationID.x >= slice.lost_n)
        return;
    uint entry = lost_word(KD_LOST_RAYS) - (slice.lost_first + gl_GlobalInvocationID.x), name = lost_rays[entry];
    if (name == KD_LOST_NONE || name % RAYS != slice.ray)
        return;
    bool sampled = SAMPLES && slice.columns > 0u;
    uint of = name / RAYS, width = emission.frame.pixels_x;
    uvec2 pixel = sampled ? uvec2(slice.first + of % slice.columns * slice.every_x,
                                  slice.row0 / SIDE + of / slice.columns * slice.every_y)
                          : uvec2(of % width, slice.band0 / SIDE + of / width);
    if (CRITICAL > 0)
        pixel = kd_listed_pixel(of);
    uvec2 place = place_of(pixel, slice.ray);
    uint to = light_at(pixel.x, pixel.y);
    kd_beam beam = begin_piece();
    follow_on(beam, place, map_of(place, of, slice.ray), to);
    if (KD_MARCH_WAITS) {
        end_piece(beam);
        return;
    }
    lost_rays[entry] = KD_LOST_NONE;
    if (sampled) {
        store_light(slice.to + of, lost ? vec3(-1.0) : beam.light);
        return;
    }
    if (lost)
        atomicAdd(lost_rays[lost_word(KD_LOST_GIVEN_UP)], 1u);
    store_ray(to, beam, true);
}
#else
/* With the march an invocation processes one ray. lavapipe (Mesa 22.3) ends all loops of eight invocations after 65 535
 * passes in total. If an invocation processed all rays of a pixel, they would reach that limit in turbulent gas. */
void main()
{
    kd_camera_read();
    KD_EMIT_BLOCKS(READ)
    uint px = gl_GlobalInvocationID.x, py = slice.row0 / SIDE + gl_WorkGroupID.y, listed = 0,
         number = slice.to + gl_WorkGroupID.y * slice.columns + px;
    bool sampled = SAMPLES && slice.columns > 0;
    uint cell = gl_WorkGroupID.y * slice.columns + px;
    if (px >= (CRITICAL > 0 ? slice.rows : sampled ? slice.columns : emission.frame.pixels_x))
        return;
    if (sampled) {
        px = slice.first + px * slice.every_x;
        py = slice.row0 / SIDE + gl_WorkGroupID.y * slice.every_y;
    }
    if (COLUMNS) {
        uint y = slice.row0 + gl_WorkGroupID.y * KD_TRANSFER_ROWS,
             end = min(y + KD_TRANSFER_ROWS, slice.row0 + slice.rows);
        if (ENDS)
            point_column(px, y, end);
        if (KD_GLOWS && ORDERS > 0u)
            do {
                light_rows(px, y, end);
                y += AHEAD;
            } while (y < end);
        return;
    }
    if (CRITICAL > 0) {
        listed = slice.row0 + px;
        uvec2 pixel = kd_listed_pixel(listed);
        px = pixel.x;
        py = pixel.y;
    }
    uint to = light_at(px, py);
#ifdef KD_MARCH
    kd_beam beam = follow_one(uvec2(px, py), listed, slice.ray, to);
    if (lost)
        lose(beam, (sampled ? cell : CRITICAL > 0 ? listed : to) * RAYS + slice.ray);
    if (sampled)
        store_light(number, lost ? vec3(-1.0) : beam.light);
    else
        store_ray(to, beam, RAYS > 1u && slice.ray > 0u);
#else
    const uint rays = CRITICAL > 0 ? CRITICAL : SIDE * SIDE;
    const float share = 1.0 / float(rays);
    vec3 sum = vec3(0.0), all = vec3(0.0);
    float apart = 0.0;
    vec2 spots = vec2(0.0);
    uint i = 0u;
    do {
        kd_beam beam = follow_one(uvec2(px, py), listed, i, to);
        sum += beam.light;
        apart += beam.apart;
        all += stokes;
        spots += stokes_apart;
    } while (++i < rays);
    store(to, share * sum, share * apart, share * all, share * spots);
#endif
}
#endif
#endif
