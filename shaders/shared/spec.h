/* Kernels have these specialisation constants: U(id, name, value) an unsigned one, B(id, name, value) a flag. Each
 * list is written once; GLSL declares its constants by it and C a struct of 32-bit members, whose places a
 * compile-time check compares with the ids. */
#ifndef KD_SPEC_H
#define KD_SPEC_H

/* SIGHT: how the camera looks, KD_SIGHT_ of interface.h. CRITICAL to SHIFT: rays on listed pixels (ray/place.glsl),
 * how many of each, 0: the picture's grid; the lattice that they are on. */
/* clang-format off */
#define KD_SPEC_LENS_CLOSED(U, B) \
    U(0, QUANTITIES, 1) U(1, ORDERS, 3) U(2, SIGHT, 0) U(3, CRITICAL, 0) U(4, GENERATOR, 1) U(5, SHIFT, 0)
/* clang-format on */

/* STEPS: of a half period, a multiple of 4 for the quadrature; METHOD: order of the Nystroem method, 4 or 6;
 * INGOING: the observer falls, its azimuth is that of ingoing coordinates, and it may be within the outer horizon. */
/* clang-format off */
#define KD_SPEC_LENS_MAP(U, B) \
    U(0, QUANTITIES, 1) U(1, ORDERS, 3) U(2, STEPS, 8) U(3, METHOD, 6) U(4, SIGHT, 0) \
    U(5, CRITICAL, 0) U(6, GENERATOR, 1) U(7, SHIFT, 0) B(8, INGOING, false)
/* clang-format on */

/* X1 to Y4: vectors between neighbours of the lattice, as 32-bit integers of either sign. */
/* clang-format off */
#define KD_SPEC_FOOTPRINT(U, B) \
    U(0, QUANTITIES, 1) U(1, ORDERS, 3) U(2, CRITICAL, 0) U(3, GENERATOR, 1) U(4, SHIFT, 0) \
    U(5, X1, 0) U(6, Y1, 0) U(7, X2, 0) U(8, Y2, 0) U(9, X3, 0) U(10, Y3, 0) U(11, X4, 0) U(12, Y4, 0)
/* clang-format on */

/* lens_cells.comp has these; and lens_fill.comp, OF_SKY: where rays end, instead of their crossings. */
#define KD_SPEC_SAMPLE(U, B) U(0, QUANTITIES, 1) U(1, ORDERS, 3)
#define KD_SPEC_FILL(U, B) U(0, QUANTITIES, 1) U(1, ORDERS, 3) B(2, OF_SKY, false)

/* between.comp has these. SIDE: rays along each side of a pixel; MARK: say only where they may be had so. */
#define KD_SPEC_BETWEEN(U, B) U(0, QUANTITIES, 1) U(1, ORDERS, 3) U(2, SIDE, 4) B(3, MARK, false)

/* SIDE: rays along each side of a pixel; LAYER, ORDER: of layers.comp, which layer (layers.h), and of which image
 * order, KD_NO_ORDER: of the first crossing that lies on the disk. INGOING is the lens map's, for the march
 * (light/march.glsl). STOKES: of transfer.comp, whether Stokes Q, U and V are kept behind the radiance. Behind these
 * comes the word of each emitter (emitters.h), from KD_SPEC_TRAITS on. */
/* clang-format off */
#define KD_SPEC_TRANSFER(U, B) \
    U(0, QUANTITIES, 1) U(1, ORDERS, 3) U(2, SIDE, 1) U(3, SIGHT, 0) \
    U(4, CRITICAL, 0) U(5, GENERATOR, 1) U(6, SHIFT, 0) U(7, LAYER, 0) U(8, ORDER, KD_NO_ORDER) \
    B(9, INGOING, false) B(10, STOKES, false)
/* clang-format on */
#define KD_SPEC_TRAITS 11
#define KD_NO_ORDER 0xffffffffu

/* In rays.comp and rays_kerr_schild.comp METHOD is a Nystroem order, or one of Kerr-Schild's. */
#define KD_SPEC_RAYS(U, B) U(0, ORDERS, 3) U(1, STEPS, 16) U(2, METHOD, 6)

/* SWING: there are epicycles; LIST: places instead of a deposit; PLUNGE: those at hand fall, of a list those with
 * low numbers. */
#define KD_SPEC_PARTICLES(U, B) B(0, SWING, true) B(1, LIST, false) B(2, PLUNGE, false)

/* APART: the luminance of some emitter is kept apart as well; FINITE: solid angles from a near observer; STOKES:
 * Stokes Q, U and V stand behind the radiance, STOKES_APART: and Q and U of what is kept apart. */
#define KD_SPEC_PHOTOMETRY(U, B) B(0, APART, false) B(1, FINITE, false) B(2, STOKES, false) B(3, STOKES_APART, false)

/* star_tiles.comp, star_search.comp and star_images.comp have these. VISIBLE: brightness as the eye weighs it; TILE:
 * rays along the sides of a tile; RIM: ray/rim.glsl. */
/* clang-format off */
#define KD_SPEC_STARS(U, B) \
    U(0, QUANTITIES, 1) \
    U(1, ORDERS, 3) U(2, SIDE, 1) U(3, SIGHT, 0) B(4, VISIBLE, false) U(5, TILE, 9) U(6, RIM, 0) B(7, BRIGHT, false)
/* clang-format on */

/* BLOCK_X, BLOCK_Y: pixels along the sides of a block, 1, 2 or a multiple of 4; BEGUN: the first row of blocks has
 * rows in the bands before. TAPS_X, TAPS_Y: blocks along an axis that two cells may see; RAGGED: the last one is
 * narrower than the others. */
#define KD_SPEC_BLOOM_BRIGHT(U, B) U(0, BLOCK_X, 2) U(1, BLOCK_Y, 2) B(2, BEGUN, false)
#define KD_SPEC_BLOOM_GATHER(U, B) U(0, TAPS_X, 7) U(1, TAPS_Y, 7) B(2, RAGGED, false) B(3, AROUND, false)
/* AROUND: the picture goes all round, from its right edge on to its left one. */
#define KD_SPEC_BLOOM_GRID(U, B) B(0, AROUND, false)

/* ACES: the film-like curve; WIDE: 16 bits a channel; NEUTRAL: the curve that keeps colours; without either light is
 * clipped. TOGETHER: the four pixels of an invocation lie beside one another, within two cells of what a lens
 * spreads. */
#define KD_SPEC_POST(U, B) \
    B(0, ACES, true) B(1, WIDE, false) B(2, NEUTRAL, false) B(3, TOGETHER, false) B(4, AROUND, false)

/* beam_gather.comp and beam_spread.comp are told whether cells are larger than pixels. */
#define KD_SPEC_BEAM(U, B) B(0, COARSE, true)

/* ROWS: along columns, from row to row. */
#define KD_SPEC_BEAM_BLUR(U, B) B(0, ROWS, false)

#ifdef VULKAN
#define KD_SPEC_U_(id, name, value) layout(constant_id = id) const uint name = value;
#define KD_SPEC_B_(id, name, value) layout(constant_id = id) const bool name = value;
#endif

#endif
