/* Specialisation constants of the kernels. U(id, name, value) is an unsigned constant, and B(id, name, value) a flag.
 * Each list is written once. GLSL declares its constants from the list. C declares a struct of 32-bit members from it,
 * whose offsets are compared with the ids at compile time. */
#ifndef KD_SPEC_H
#define KD_SPEC_H

/* SIGHT: projection of the camera, KD_SIGHT_ of interface.h. CRITICAL: number of rays on each listed pixel
 * (ray/place.glsl), or 0 for rays of the picture's grid. GENERATOR, SHIFT: parameters of the lattice of rays on a
 * listed pixel. */
/* clang-format off */
#define KD_SPEC_LENS_CLOSED(U, B) \
    U(0, QUANTITIES, 1) U(1, ORDERS, 3) U(2, SIGHT, 0) U(3, CRITICAL, 0) U(4, GENERATOR, 1) U(5, SHIFT, 0)
/* clang-format on */

/* STEPS: number of steps in a half period; a multiple of 4 because of the quadrature. METHOD: order of the Nystroem
 * method, 4 or 6. INGOING: true if the observer falls. The azimuth of such an observer is in ingoing coordinates, and
 * the observer may be inside the outer horizon. */
/* clang-format off */
#define KD_SPEC_LENS_MAP(U, B) \
    U(0, QUANTITIES, 1) U(1, ORDERS, 3) U(2, STEPS, 8) U(3, METHOD, 6) U(4, SIGHT, 0) \
    U(5, CRITICAL, 0) U(6, GENERATOR, 1) U(7, SHIFT, 0) B(8, INGOING, false)
/* clang-format on */

/* X1 to Y4: x and y of the vectors from a ray of the lattice to four neighbours, as signed 32-bit integers. */
/* clang-format off */
#define KD_SPEC_FOOTPRINT(U, B) \
    U(0, QUANTITIES, 1) U(1, ORDERS, 3) U(2, CRITICAL, 0) U(3, GENERATOR, 1) U(4, SHIFT, 0) \
    U(5, X1, 0) U(6, Y1, 0) U(7, X2, 0) U(8, Y2, 0) U(9, X3, 0) U(10, Y3, 0) U(11, X4, 0) U(12, Y4, 0)
/* clang-format on */

/* KD_SPEC_SAMPLE is for lens_cells.comp, KD_SPEC_FILL for lens_fill.comp. OF_SKY: true if the kernel fills the ends of
 * rays in the sky instead of crossings. */
#define KD_SPEC_SAMPLE(U, B) U(0, QUANTITIES, 1) U(1, ORDERS, 3)
#define KD_SPEC_FILL(U, B) U(0, QUANTITIES, 1) U(1, ORDERS, 3) B(2, OF_SKY, false)

/* For between.comp. SIDE: number of rays along each side of a pixel. MARK: true if the kernel only reports where
 * interpolation is accurate. */
#define KD_SPEC_BETWEEN(U, B) U(0, QUANTITIES, 1) U(1, ORDERS, 3) U(2, SIDE, 4) B(3, MARK, false)

/* SIDE: number of rays along each side of a pixel. LAYER: layer that layers.comp makes (layers.h). ORDER: image order
 * of that layer, or KD_NO_ORDER for the first crossing on the disk. INGOING: as for the lens map; used by the march
 * (light/march.glsl). STOKES: true if transfer.comp stores Stokes Q, U and V after the radiance. BEYOND_KERR: true if
 * the hole has parameters besides the spin. From the id KD_SPEC_TRAITS on, there is a word for each emitter
 * (emitters.h). */
/* clang-format off */
#define KD_SPEC_TRANSFER(U, B) \
    U(0, QUANTITIES, 1) U(1, ORDERS, 3) U(2, SIDE, 1) U(3, SIGHT, 0) \
    U(4, CRITICAL, 0) U(5, GENERATOR, 1) U(6, SHIFT, 0) U(7, LAYER, 0) U(8, ORDER, KD_NO_ORDER) \
    B(9, INGOING, false) B(10, STOKES, false) B(11, BEYOND_KERR, false)
/* clang-format on */
#define KD_SPEC_TRAITS 12
#define KD_NO_ORDER 0xffffffffu

/* For rays.comp and rays_kerr_schild.comp. METHOD: order of the Nystroem method, or number of the Kerr-Schild method.
 */
#define KD_SPEC_RAYS(U, B) U(0, ORDERS, 3) U(1, STEPS, 16) U(2, METHOD, 6)

/* SWING: true if there are epicycles. LIST: true if the kernel lists places instead of depositing weights. PLUNGE: true
 * if it processes falling particles, which have the lowest numbers in a list. */
#define KD_SPEC_PARTICLES(U, B) B(0, SWING, true) B(1, LIST, false) B(2, PLUNGE, false)

/* SEPARATE_PHOTOMETRY: true if the luminance of some emitter is kept separately. FINITE: true if the observer is at a
 * finite radius, so that solid angles are used. STOKES: true if Stokes Q, U and V follow the radiance. STOKES_APART:
 * true if Q and U of the separate luminance follow V. */
#define KD_SPEC_PHOTOMETRY(U, B) \
    B(0, SEPARATE_PHOTOMETRY, false) B(1, FINITE, false) B(2, STOKES, false) B(3, STOKES_APART, false)

/* For star_tiles.comp, star_search.comp and star_images.comp. VISIBLE: true if brightness is weighted by the eye's
 * sensitivity. TILE: number of rays along a side of a tile. RIM: as in ray/rim.glsl. */
/* clang-format off */
#define KD_SPEC_STARS(U, B) \
    U(0, QUANTITIES, 1) \
    U(1, ORDERS, 3) U(2, SIDE, 1) U(3, SIGHT, 0) B(4, VISIBLE, false) U(5, TILE, 9) U(6, RIM, 0) B(7, BRIGHT, false)
/* clang-format on */

/* BLOCK_X, BLOCK_Y: sides of a block in pixels; each is 1, 2 or a multiple of 4. BEGUN: true if the first row of blocks
 * also has rows in earlier bands. TAPS_X, TAPS_Y: number of blocks along an axis that two cells may read. RAGGED: true
 * if the last block is narrower than the others. */
#define KD_SPEC_BLOOM_BRIGHT(U, B) U(0, BLOCK_X, 2) U(1, BLOCK_Y, 2) B(2, BEGUN, false)
#define KD_SPEC_BLOOM_GATHER(U, B) U(0, TAPS_X, 7) U(1, TAPS_Y, 7) B(2, RAGGED, false) B(3, AROUND, false)
/* AROUND: true if the picture shows all directions. Its right and left edges then adjoin. */
#define KD_SPEC_BLOOM_GRID(U, B) B(0, AROUND, false)

/* ACES: true for the film-like curve. NEUTRAL: true for the curve that keeps colours. Without either flag, light is
 * clipped. WIDE: true for 16 bits a channel. COLUMNS: number of columns of the bloom grid that the four pixels of an
 * invocation read together; 0 if each pixel reads its own cells. */
#define KD_SPEC_POST(U, B) B(0, ACES, true) B(1, WIDE, false) B(2, NEUTRAL, false) U(3, COLUMNS, 0) B(4, AROUND, false)

/* For beam_gather.comp and beam_spread.comp. COARSE: true if cells are larger than pixels. */
#define KD_SPEC_BEAM(U, B) B(0, COARSE, true)

/* ROWS: true if the blur is down the columns, from row to row. */
#define KD_SPEC_BEAM_BLUR(U, B) B(0, ROWS, false)

#ifdef VULKAN
#define KD_SPEC_U_(id, name, value) layout(constant_id = id) const uint name = value;
#define KD_SPEC_B_(id, name, value) layout(constant_id = id) const bool name = value;
#endif

#endif
