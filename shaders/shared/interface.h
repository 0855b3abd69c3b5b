/* C and GLSL share these layouts and constants. 4-byte scalars only; each list is written once and expanded by both
 * sides; a test compares the offsets in the SPIR-V with offsetof. */
#ifndef KD_INTERFACE_H
#define KD_INTERFACE_H

/* A workgroup has so many invocations in every kernel: eight lavapipe vectors, two NVIDIA warps, one AMD wave. */
#define KD_GROUP_SIZE 64

/* How a camera looks: at infinity over a plane; at a finite radius through a pinhole; all round it, longitude across
 * and latitude upwards; or over half the sky, the angle from the middle as the distance from it. */
#define KD_SIGHT_PLANE 0
#define KD_SIGHT_PINHOLE 1
#define KD_SIGHT_SPHERE 2
#define KD_SIGHT_DOME 3

/* Unit roundoff of the kernels' numbers. */
#define KD_ROUNDOFF 6e-8

/* The camera and constants of the hole are a uniform block of the tracing and transfer kernels.
 * A ray at (x, y), in steps from the middle of the picture, y upwards, has the direction c0 + x cx + y cy; at
 * infinity its first two components are alpha and beta, at a finite radius it is normalised to the look direction k
 * = (k_r, k_theta, k_phi) in the observer's local frame. On a sphere and a dome the steps are angles, and c0, cx and
 * cy ahead, to the right and up: the direction is cos(y) (cos(x) c0 + sin(x) cx) + sin(y) cy, or cos(d) c0 + sin(d)
 * (x cx + y cy) / d with d^2 = x^2 + y^2. A photon that comes from there flies along m = -k, and has E = e_t + m_r
 * e_r + m_theta e_theta + m_phi e_phi; likewise L/sin(theta) by l_, p_theta by p_ and dw/dtau of the traced ray by
 * dw_: they are the legs of the observer's tetrad (src/physics/spacetime/tetrad.h). */
/* clang-format off */
#define KD_CAMERA_FIELDS_(F, U) \
    F(c0x) F(c0y) F(c0z) F(cxx) F(cxy) F(cxz) F(cyx) F(cyy) F(cyz) \
    F(middle_x) F(middle_y) /* ray coordinates of the middle of the picture */ \
    F(spin) F(u) F(s)       /* a; cosine and sine of the observer's polar angle */ \
    F(horizon)              /* 1/r+ */ \
    F(root)                 /* sqrt(1 - a^2): the horizons are at r = 1 +- root; a float of a has lost it near 1 */ \
    F(w0)                   /* 1/r of the observer, 0 at infinity */ \
    /* of one that falls, outside the horizon: its Boyer-Lindquist azimuth less its ingoing one; else 0 */ \
    F(twist) \
    F(e_t) F(e_r) F(e_theta) F(e_phi) F(l_t) F(l_r) F(l_theta) F(l_phi) \
    F(p_t) F(p_r) F(p_theta) F(p_phi) F(dw_t) F(dw_r) F(dw_theta) F(dw_phi) \
    F(turn_x) F(turn_y)     /* quarter turns a step, on a sphere and a dome */ \
    F(size_e)               /* |E| of any of its rays is at most this, */ \
    /* and rounding changes R by no more than these say (kd_rounding of shaders/ray/kerr_ray.glsl) */ \
    F(noise_w) F(noise_wl) F(noise_p) F(noise_l) F(noise_k) F(noise_0) \
    U(width)                /* rays a row */ \
    U(sight)                /* KD_SIGHT_, which kernels have as a constant */
/* clang-format on */

/* The rows of rays at hand are the push constants of these kernels. Of listed pixels row0 is the first of a slice,
 * rows how many, band0 the first row of pixels of the band that light is written to. */
/* clang-format off */
#define KD_SLICE_FIELDS_(F, U) \
    U(row0) U(rows)         /* first row of this slice in the picture; rows of the slice */ \
    U(band0)                /* first row of the band that the buffers hold */ \
    U(stride)               /* rays of the band: distance between planes of the lens map */ \
    U(list)                 /* of listed pixels, where it begins in the lens map; of nodes, where states do */ \
    /* of rays by their places: which, where the places of their list begin, and the ray that these count from */ \
    U(stage) U(places) U(origin_x) U(origin_y) \
    U(steps) U(fine)        /* of the march (light/march.glsl): steps a half period; quarters of a stretch a grain; */ \
    F(opaque)               /* what of the light behind need not come through for the ray to go on */ \
    F(unseen)               /* octaves of noise whose part is less than this one of the first are left out */ \
    /* pixels a row of a sample, 0: all pixels are lit; the first column, row0 being the first row; */ \
    U(columns) U(first) \
    U(every_x) U(every_y)   /* how far they are apart; and */ \
    /* the number, in the order of rows, from which on their light lies one behind the other */ \
    U(to) \
    /* of its pixel, which the march follows, and adds its light to that of the rays before it */ \
    U(ray) \
    U(lost_most)            /* rays that the list of lost ones has room for, and of these, where they go on, */ \
    U(lost_first) U(lost_n) /* the first, and how many; */ \
    U(lost_goes)            /* 0: with their first piece */
/* clang-format on */

/* Rays through volumes that were not followed to their end stand behind a band's light (frame/pieces.c), counted from
 * the end of its buffer: words that count those that were given up, those that are listed and those that wait for
 * their next piece; KD_LOST_STATE words for each of so many that go on at once; and the list. A name in it is the
 * number of a pixel of the band, of the list of pixels or of a sample, times the rays of a pixel, and the ray. A piece
 * takes up to so many passes of loops: lavapipe (Mesa 22.3) ends those of eight invocations after 65 535 in total, and
 * what is gone through again takes some thousand of these. */
#define KD_LOST_GIVEN_UP 1
#define KD_LOST_LISTED 2
#define KD_LOST_WAITING 3
#define KD_LOST_STATES 3 /* their end */
#define KD_LOST_STATE 25
#define KD_LOST_AT_ONCE 2048
#define KD_LOST_RAYS (KD_LOST_STATES + KD_LOST_STATE * KD_LOST_AT_ONCE + 1) /* the first, and the others before it */
#define KD_LOST_NONE 0xffffffffu                                            /* it was followed to its end */
#define KD_PIECE_PASSES 6000u

/* footprint.comp takes these. Rows are those of rays that the buffer holds. */
/* clang-format off */
#define KD_FOOTPRINT_FIELDS_(F, U) \
    U(width)                /* rays a row */ \
    U(rows)                 /* all of them; of listed pixels how many these are */ \
    U(first) U(end)         /* those that are wanted; on listed pixels, rays */ \
    U(stride)               /* rays from plane to plane */ \
    U(list)                 /* where the listed pixels are; of rays that are followed alone, where their places are */ \
    U(alone)                /* 1: of these; and of those in rows from `end` on, whose next rows are not there yet, */ \
                            /* mark that they are wanted. 2: of those that are marked so */ \
    U(origin_x) U(origin_y) /* what their places are counted from, in rows and columns of the buffer */
/* clang-format on */
/* lens_cells.comp and lens_fill.comp take these: a lens map that is followed in nodes and interpolated between them
 * (src/render/frame/sample.c). Places are those of rays in the picture at hand; cells begin where those of the whole
 * picture do. */
/* clang-format off */
#define KD_SAMPLE_FIELDS_(F, U) \
    U(origin_x) U(origin_y) /* place of the first block's first ray, an integer of either sign */ \
    U(blocks_x) U(blocks_y) \
    U(width) U(rows)        /* rays a row of the map; rows of rays that are wanted, */ \
    U(row0) U(band0)        /* from this one on; the first row that the buffer of the map holds */ \
    U(stride)               /* rays from plane to plane of the map, */ \
    U(room)                 /* and of the nodes */ \
    U(level)                /* of lens_cells.comp: 0 makes the first nodes, 1 to KD_CELL_LEVELS look at cells */ \
    F(tolerance)
/* clang-format on */
#define KD_CELL_BLOCK 64 /* rays along the side of a cell of level 1, which half of them halve at each level */
#define KD_CELL_LEVELS 4
/* The head of what the nodes' kernels count, in words: for each stage of rays, which are the nodes of the levels and
 * the rays that are followed alone, for each level of cells, and for what is filled of smooth cells, their crossings
 * and their sky, the workgroups along three axes of the dispatch that takes them, and how many they are. */
#define KD_STAGE_ALONE KD_CELL_LEVELS
#define KD_SAMPLE_STAGES (KD_CELL_LEVELS + 1)
#define KD_SAMPLE_CELLS (4 * KD_SAMPLE_STAGES)
#define KD_SAMPLE_FILLS (KD_SAMPLE_CELLS + 4 * KD_CELL_LEVELS)
#define KD_SAMPLE_COUNTED (KD_SAMPLE_FILLS + 4 * 2)
#define KD_SAMPLE_QUEUES 64 /* where the lists begin, behind that: cells of each level, at most 85 a block; */
#define KD_SAMPLE_QUEUED 85
#define KD_SAMPLE_UNITS \
    64 /* units that are filled, eight columns of a cell each, twice at most so many a block; then \
          places */
#define KD_PLACE_BITS 17
#define KD_FOOTPRINT_PLACES 1
#define KD_PLACES_BINDING 3          /* of the kernels that trace */
#define KD_RAYS_BY_PLACE 0xffffffffu /* the specialisation constant CRITICAL of kernels that take stages */
/* How a node counts: its crossings, and so much more if it is captured; below 0: the ray is open. */
#define KD_NODE_CAPTURED 16.0
#define KD_NODE_OPEN -1.0
#define KD_NODE_OWN 2 /* planes behind those of nodes: their states, and what vanishes where fates change */

#define KD_FOOTPRINT_WANTED -1.0
#define KD_FOOTPRINT_EDGE 1e9 /* M, and radians: larger than all that is */

/* star_tiles.comp, star_search.comp and star_images.comp are told this. Rows are those of rays that the buffer
 * holds. */
/* clang-format off */
#define KD_STARS_FIELDS_(F, U) \
    U(width)                /* rays a row */ \
    U(rows)                 /* all of them */ \
    U(first) U(end)         /* those that are wanted */ \
    U(stride)               /* rays from plane to plane */ \
    U(row0) U(column0)      /* row and column of the picture's rays that the first of the buffer is */ \
    U(room)                 /* pairs of a ray and a star that there is room for, */ \
    U(tiles)                /* and small tiles */ \
    U(stars)                /* places in their list: their temperatures lie behind directions and fluxes */ \
    U(pixels_y)             /* rows of pixels that light is written to */ \
    /* added to rows and columns of pixels of the picture, as 32-bit integers of either sign: those of the light */ \
    U(up) U(aside) \
    U(rim)                  /* of the rim, where the table of the grid at hand begins (render/view/rim_grid.h) */ \
    /* far, fall: how far its first row is from the curve, and by how much that falls from row to row; */ \
    /* none to up_z: numbers of rim.h */ \
    F(far) F(fall) F(none) F(full) \
    F(ahead_x) F(ahead_y) F(ahead_z) F(right_x) F(right_y) F(right_z) F(up_x) F(up_y) F(up_z) \
    F(least)                /* images that brighten their pixel by less of the unit of sky.brightness are left out */
/* clang-format on */
#define KD_RIM_ANGLES 256
#define KD_RIM_EDGES 512
#define KD_STAR_TILE 9           /* rays along the sides of a large tile of star_tiles.comp, a multiple of 3, and odd */
#define KD_STAR_LEAST 0.03       /* of sky.brightness: images that brighten their pixel by less are left out */
#define KD_STAR_LEAST_BRIGHT 1.0 /* where only bright ones are wanted */
#define KD_STAR_PATCH 0.15       /* radians that a ray may stand for where images of stars are sought, */
#define KD_STAR_PATCH_RIM 0.8    /* and where a rim has those next to the critical curve */

/* between.comp is told this of the pixels of a list that lie in one band. */
/* clang-format off */
#define KD_BETWEEN_FIELDS_(F, U) \
    U(first) U(count)       /* which of them */ \
    U(stride) U(list)       /* as in a slice */ \
    U(marks)                /* pixels of the whole list, behind which the word of each is */ \
    U(width) U(row0)        /* pixels a row; first row of the band */ \
    U(map_rows) U(map_stride) /* rows of the band; from plane to plane of its lens map */
/* clang-format on */

/* One of the radii that particles go round at: phases at the time of the picture in turns of 2^32, and the largest
 * swings. */
/* clang-format off */
#define KD_GUIDE_FIELDS_(F, U) \
    U(phi) U(radial) U(vertical) \
    F(row)                   /* of the grid */ \
    F(swing_row) F(swing_phi) /* the latter in turns */
/* clang-format on */
/* clang-format off */
#define KD_PARTICLES_FIELDS_(F, U) \
    U(key)                   /* hash of the seed */ \
    U(first) U(stride) U(count) \
    U(per_particle)          /* 2^31 radii/particles */ \
    U(rows) U(columns_log2) \
    U(unit)                  /* weight of one particle */ \
    F(tilt)                  /* largest latitude, radians */ \
    U(plunging)              /* the first of all particles do, and this is how many */ \
    U(lap) U(phase)          /* of a plunge that began at time 0: whole ones, and turns of 2^32 */ \
    U(turn)                  /* of the orbit at the ISCO */ \
    U(plunge_at)             /* their grid in the buffer of both */ \
    U(plunge_rows) U(plunge_columns_log2) \
    U(lap_rows) U(lead_rows) /* as in the transfer kernel */
/* clang-format on */

#define KD_TRANSFER_ROWS \
    8 /* of pixels below one another, of one invocation of transfer.comp, where a pixel has one ray */

#define KD_POST_PIXELS 4 /* of one invocation of post.comp: three words, or six */
/* clang-format off */
#define KD_POST_FIELDS_(F, U) \
    F(gain)                  /* 2^exposure */ \
    F(dither)                /* 0 or 1 */ \
    U(pixels)                /* of the band */ \
    U(first)                 /* index of the band's first pixel in the picture */ \
    U(pixels_x) \
    F(left) F(top)           /* of a tile, its first pixel in the picture */ \
    U(counter)               /* word in which pixels without light that is a number are counted; 0: they are not */ \
    F(bloom)                 /* share of light over white that is spread; this and what follows with bloom only */ \
    F(scale_x) F(scale_y)    /* cells a pixel */ \
    U(cells_x) U(cells_y)
/* clang-format on */

/* The light that a lens spreads: exposed light over white, in a grid of so many rows of cells and KD_BLOOM_LEVELS -
 * 1 grids of half as many each (render/plan/bloom.h). */
#define KD_BLOOM_ROWS 128
#define KD_BLOOM_LEVELS 5
/* clang-format off */
#define KD_BLOOM_BRIGHT_FIELDS_(F, U) \
    F(gain)                  /* 2^exposure */ \
    F(strength)              /* of light over white, the share that is spread */ \
    U(pixels_x) \
    U(row0) U(rows)          /* of the band */ \
    U(blocks_x)              /* of the picture */ \
    U(block_row0) U(block_rows) /* those that the band has pixels of */ \
    U(across)                /* invocations a row of blocks */
/* clang-format on */
#define KD_BLOOM_TAPS 16 /* blocks along an axis that two cells may see, at most */
/* clang-format off */
#define KD_BLOOM_GATHER_FIELDS_(F, U) \
    U(pixels_x) U(pixels_y)  /* of the picture */ \
    U(blocks_x) U(blocks_y) U(cells_x) U(cells_y) \
    U(block_x) U(block_y)    /* pixels of a block along its sides */
/* clang-format on */

/* A telescope's beam (render/plan/beam.h): of beam_gather.comp and beam_spread.comp, a band of pixels and rows of
 * cells; */
/* clang-format off */
#define KD_BEAM_BAND_FIELDS_(F, U) \
    U(pixels_x) \
    U(row0) U(rows)          /* of the band in the picture */ \
    U(columns)               /* of cells */ \
    U(cell)                  /* pixels along the side of one, */ \
    F(cells)                 /* and one over that */
/* clang-format on */
/* of beam_spline.comp, whose row i is a sum over `count` rows from i first_times/first_over - before on; */
/* clang-format off */
#define KD_BEAM_SPLINE_FIELDS_(F, U) \
    U(columns) \
    U(row0) U(rows)          /* of the slice, of what is made */ \
    U(length_)               /* rows of what is read */ \
    U(first_times) U(first_over) U(before) U(count) \
    F(from_scale)            /* units of the weights a row that is read, */ \
    F(to_scale) F(shift)     /* and a row that is made, which are shifted by so much */ \
    F(weight)                /* of the whole sum */
/* clang-format on */
/* and of beam_blur.comp. */
#define KD_BEAM_BLUR_FIELDS_(F, U) \
    U(columns) \
    U(row0)    /* of the slice, a multiple of four */ \
    U(lines)   /* of the slice: rows, or along columns fours of them */ \
    U(length_) /* cells along the axis */ \
    U(reach)   /* cells to either side of one that count */ \
    F(narrow)  /* 1/(2 sigma^2) */ \
    F(weight)  /* of the whole sum */

/* A pixel one of whose rays was given up has this for Stokes V: no light is as bright. */
#define KD_STOKES_UNTOLD 3e38
#define KD_STOKES_LEAST_UNTOLD 1e38

/* photometry.comp takes these, each of whose invocations adds up so many pixels of a band to twice four sums, and
 * where there is Stokes Q, U and V twice four more. */
/* clang-format off */
#define KD_LIGHT_FIELDS_(F, U) \
    U(pixels_x) U(pixels)     /* a row, and of the band */ \
    U(row0)                   /* of the band in the picture */ \
    U(spots)                  /* where the spots' own luminance begins, */ \
    U(stokes)                 /* and Stokes Q, U, V, and the spots' Q and U, */ \
    U(plane)                  /* each so many pixels long */ \
    F(middle_x) F(middle_y)   /* pixel coordinates of the middle of the picture */ \
    F(step_)                  /* from pixel to pixel, over the distance of the picture */
/* clang-format on */
#define KD_LIGHT_PIXELS 64
#define KD_LIGHT_SUMS 8
#define KD_LIGHT_SUMS_STOKES 16

/* The histogram of luminance for auto exposure has eight bins a stop: a bin is the exponent and the first three bits
 * of the fraction of the float. Bin 0 is black; bin FIRST stands for 2^-40. */
#define KD_HISTOGRAM_BINS 512
#define KD_HISTOGRAM_FIRST 696 /* (127 - 40) * 8 */

/* Rays that a kernel leaves open are counted, and so many are listed (src/render/frame/settle.c). */
#define KD_GIVEN_MOST 1048576

/* The fate plane has these values. */
#define KD_FATE_ESCAPED 0.0
#define KD_FATE_CAPTURED 1.0
#define KD_FATE_UNDECIDED 2.0 /* hit the step limit */

/* Records of trace.glsl have these: numbers in front, numbers a record, and the stages. A stage 0, 1, ... is a step
 * on the way to the crossing of that order, in w and u; the others hold the unit vector n and w. */
#define KD_TRACE_HEADER 8
#define KD_TRACE_RECORD 11
#define KD_TRACE_START -1.0
#define KD_TRACE_CROSSING -2.0
#define KD_TRACE_END -3.0 /* after the last crossing */

/* Records of light/tell.glsl have so many numbers, and are of these kinds. */
#define KD_TELL_RECORD 11
#define KD_TELL_AT 0.0
#define KD_TELL_OF_PLACE 1.0
#define KD_TELL_ENDS 2.0
#define KD_TELL_OF_END 3.0
#define KD_TELL_OF_POINTS 4.0
#define KD_TELL_LOST 5.0
#define KD_TELL_FRONT 6.0
#define KD_TELL_WHOLE 7.0
#define KD_TELL_ALONG 8.0
#define KD_TELL_OF_VOLUME 9.0
#define KD_TELL_MET 10.0
#define KD_TELL_MET_AT 11.0
#define KD_TELL_POLARIZED 12.0
#define KD_TELL_ALONG_AT 13.0
#define KD_TELL_SUMS 2u /* records in front of the others: KD_TELL_FRONT and KD_TELL_WHOLE */

#endif
