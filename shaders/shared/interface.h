/* Layouts and constants shared by C and GLSL. Layouts consist of 4-byte scalars only. Each list is written once, and
 * both C and GLSL expand it. A test compares the offsets in the SPIR-V with offsetof. */
#ifndef KD_INTERFACE_H
#define KD_INTERFACE_H

/* Number of invocations in a workgroup of every kernel. It is eight lavapipe vectors, two NVIDIA warps, or one AMD
 * wave. */
#define KD_GROUP_SIZE 64

/* Projections of a camera. PLANE: rays from infinity, on a plane. PINHOLE: perspective, at a finite radius. SPHERE: all
 * directions, with longitude across and latitude upwards. DOME: half the sky, where the distance from the middle is
 * proportional to the angle. */
#define KD_SIGHT_PLANE 0
#define KD_SIGHT_PINHOLE 1
#define KD_SIGHT_SPHERE 2
#define KD_SIGHT_DOME 3

/* Unit roundoff of the kernels' floats. */
#define KD_ROUNDOFF 6e-8

/* Parameters of the hole besides those of the Kerr metric. The function kd_hole_NAME of hole.h computes NAME. */
#define KD_HOLE_MORE_FIELDS_(F) F(charge2) /* q^2 */

/* Parameters of the hole. Each uniform block whose kernel needs the hole contains them. */
/* clang-format off */
#define KD_HOLE_FIELDS_(F) \
    F(spin)                 /* a */ \
    F(horizon)              /* 1/r+ */ \
    F(root)                 /* sqrt(1 - a^2 - q^2), inexact if computed from floats; horizons: r = 1 +- root */ \
    KD_HOLE_MORE_FIELDS_(F)
/* clang-format on */

/* The camera and the hole, which are a uniform block of the tracing and transfer kernels. A ray at (x, y), in steps
 * from the middle of the picture with y upwards, has the direction c0 + x cx + y cy. For an observer at infinity, the
 * first two components of this direction are alpha and beta. For an observer at a finite radius, the normalised
 * direction is the look direction k = (k_r, k_theta, k_phi) in the observer's local frame. On a sphere and a dome the
 * steps are angles, and c0, cx and cy point ahead, to the right and up. The direction is then cos(y) (cos(x) c0 +
 * sin(x) cx) + sin(y) cy on a sphere, and cos(d) c0 + sin(d) (x cx + y cy) / d with d^2 = x^2 + y^2 on a dome. A photon
 * that arrives from the direction k moves along m = -k, and has E = e_t + m_r e_r + m_theta e_theta + m_phi e_phi.
 * L/sin(theta) is the same sum with l_ in place of e_, p_theta with p_, and dw/dtau of the traced ray with dw_. The
 * numbers named _t, _r, _theta and _phi are components of the observer's tetrad (src/physics/spacetime/tetrad.h). */
/* clang-format off */
#define KD_CAMERA_FIELDS_(F, U) \
    F(c0x) F(c0y) F(c0z) F(cxx) F(cxy) F(cxz) F(cyx) F(cyy) F(cyz) \
    F(middle_x) F(middle_y) /* column and row, in rays, of the picture's middle */ \
    KD_HOLE_FIELDS_(F) \
    F(u) F(s)               /* cosine and sine of the observer's polar angle */ \
    F(w0)                   /* 1/r of the observer; 0 at infinity */ \
    /* Boyer-Lindquist azimuth minus ingoing azimuth, for an observer that falls outside the horizon; otherwise 0 */ \
    F(twist) \
    F(e_t) F(e_r) F(e_theta) F(e_phi) F(l_t) F(l_r) F(l_theta) F(l_phi) \
    F(p_t) F(p_r) F(p_theta) F(p_phi) F(dw_t) F(dw_r) F(dw_theta) F(dw_phi) \
    F(turn_x) F(turn_y)     /* angle of a step on a sphere or a dome, in quarter turns */ \
    F(size_e)               /* upper bound of |E| over all rays of the camera */ \
    /* bounds of the rounding error of R (kd_rounding of shaders/ray/kerr_ray.glsl) */ \
    F(noise_w) F(noise_wl) F(noise_p) F(noise_l) F(noise_k) F(noise_0) \
    U(width)                /* number of rays in a row */ \
    U(sight)                /* projection KD_SIGHT_..., which kernels also have as a specialisation constant */
/* clang-format on */

/* Push constants of the tracing and transfer kernels: the current rows of rays. For listed pixels three members have
 * other meanings: row0 is the first pixel of the slice, rows is the number of pixels, and band0 is the first row of the
 * band to which the light of these pixels is written. */
/* clang-format off */
#define KD_SLICE_FIELDS_(F, U) \
    U(row0) U(rows)         /* row0: first row of the slice in the picture. rows: its number of rows */ \
    U(band0)                /* first row of the band that the buffers hold */ \
    U(stride)               /* number of rays of the band, which is the distance between planes of the lens map */ \
    U(list)                 /* offset of the list of pixels, or of the states of nodes, in the lens map */ \
    /* for rays by place: number of the stage, offset of its list of places, and the ray at the origin of these \
     * places */ \
    U(stage) U(places) U(origin_x) U(origin_y) \
    U(steps) U(fine)        /* march (light/march.glsl): steps in a half period; 4/fine: longest stretch, in grains */ \
    F(opaque)               /* a ray ends where less than this fraction of the light behind is transmitted */ \
    F(unseen)               /* octaves of noise fainter than this fraction of the first octave are left out */ \
    /* sample: number of pixels in a row, 0 if all pixels are lit; and its first column. Its first row is row0 */ \
    U(columns) U(first) \
    U(every_x) U(every_y)   /* sample: distance between columns, and between rows, in pixels */ \
    /* sample: index of its first pixel in the buffer of light; its pixels follow row by row */ \
    U(to) \
    /* number of the ray in its pixel; the light of rays after the first is added to that of earlier ones */ \
    U(ray) \
    U(lost_most)            /* capacity of the list of rays that were stopped early */ \
    U(lost_first) U(lost_n) /* listed rays that this dispatch continues: index of the first, and number */ \
    U(lost_goes)            /* 0 for the rays' first piece; 1 for later ones, which read the state of each ray */
/* clang-format on */

/* Rays through volumes that were stopped early are stored after a band's light (frame/pieces.c). Offsets count
 * backwards from the end of the light's buffer. First come three counters: of rays given up, of rays listed, and of
 * rays that wait for their next piece. Then come the states, KD_LOST_STATE words for each ray that a dispatch
 * continues. The list follows. An entry of the list is (number of the pixel) * (rays of a pixel) + (number of the ray).
 * The pixel is numbered in the band, in the list of pixels or in the sample. A piece takes up to KD_PIECE_PASSES passes
 * of loops, because lavapipe (Mesa 22.3) ends the loops of eight invocations after 65 535 passes in total. Work that is
 * repeated for each piece takes some thousand of these passes. */
#define KD_LOST_GIVEN_UP 1
#define KD_LOST_LISTED 2
#define KD_LOST_WAITING 3
#define KD_LOST_STATES 3 /* offset at which the states end */
#define KD_LOST_STATE 25
#define KD_LOST_AT_ONCE 2048
/* offset of the first ray of the list; each further ray has the next larger offset, nearer to the buffer's start */
#define KD_LOST_RAYS (KD_LOST_STATES + KD_LOST_STATE * KD_LOST_AT_ONCE + 1)
#define KD_LOST_NONE 0xffffffffu /* marks a ray that reached its end */
#define KD_PIECE_PASSES 6000u

/* Push constants of footprint.comp. Rows are rows of rays in the buffer. */
/* clang-format off */
#define KD_FOOTPRINT_FIELDS_(F, U) \
    U(width)                /* number of rays in a row */ \
    U(rows)                 /* number of all rows or, if pixels are listed, of listed pixels */ \
    U(first) U(end)         /* requested range of rows, or of rays on listed pixels */ \
    U(stride)               /* number of rays in a plane */ \
    U(list)                 /* offset of the list of pixels, or of the places of rays that are traced singly */ \
    U(alone)                /* 1: only single rays; footprints from row `end` on are only marked as missing, */ \
                            /* because the rows below are not traced yet. 2: only the marked footprints */ \
    U(origin_x) U(origin_y) /* row and column, in the buffer, of the ray at the origin of the single rays' places */
/* clang-format on */
/* Push constants of lens_cells.comp and lens_fill.comp, for a lens map traced at nodes and interpolated
 * (src/render/frame/sample.c). Places are in rays of this picture, which may be a tile. Cells are aligned to the whole
 * picture. */
/* clang-format off */
#define KD_SAMPLE_FIELDS_(F, U) \
    U(origin_x) U(origin_y) /* column and row of the first block's first ray, as signed integers */ \
    U(blocks_x) U(blocks_y) \
    U(width) U(rows)        /* width: number of rays in a row of the map. rows: number of requested rows */ \
    U(row0) U(band0)        /* row0: first requested row. band0: first row in the map's buffer */ \
    U(stride)               /* number of rays in a plane of the map */ \
    U(room)                 /* number of rays in a plane of the nodes' map */ \
    U(level)                /* lens_cells.comp: 0: makes the first nodes; 1 to KD_CELL_LEVELS: tests this level */ \
    F(tolerance)
/* clang-format on */
#define KD_CELL_BLOCK 64 /* number of rays along the side of a cell of level 1; each further level halves the side */
#define KD_CELL_LEVELS 4
/* Header of the nodes' lists, in words: the workgroups along three axes of an indirect dispatch, and the number of
 * items. These four words are an entry. The header has an entry for each stage of rays (the nodes of each level, and
 * single rays), one for each level of cells, and two for filling smooth cells: with crossings, and with the sky. */
#define KD_STAGE_ALONE KD_CELL_LEVELS
#define KD_SAMPLE_STAGES (KD_CELL_LEVELS + 1)
#define KD_SAMPLE_CELLS (4 * KD_SAMPLE_STAGES)
#define KD_SAMPLE_FILLS (KD_SAMPLE_CELLS + 4 * KD_CELL_LEVELS)
#define KD_SAMPLE_COUNTED (KD_SAMPLE_FILLS + 4 * 2)
#define KD_SAMPLE_QUEUES 64 /* offset of the lists, which follow the header */
#define KD_SAMPLE_QUEUED 85
#define KD_SAMPLE_UNITS \
    64 /* maximum number of units to fill in a block, for each of two kinds; a unit is eight columns of a cell. The \
          lists of places follow the units */
#define KD_PLACE_BITS 17
#define KD_FOOTPRINT_PLACES 1
#define KD_PLACES_BINDING 3          /* binding of the lists of places in the tracing kernels */
#define KD_RAYS_BY_PLACE 0xffffffffu /* value of the constant CRITICAL in kernels that process a stage of rays */
/* State of a node: the number of crossings of its ray, plus KD_NODE_CAPTURED if the ray is captured. A negative state
 * means that the ray is undecided. */
#define KD_NODE_CAPTURED 16.0
#define KD_NODE_OPEN -1.0
/* number of additional planes in the nodes' map: one of states, one of a value that vanishes where fates change */
#define KD_NODE_OWN 2

#define KD_FOOTPRINT_WANTED -1.0
#define KD_FOOTPRINT_EDGE 1e9 /* stands for no footprint; larger than any footprint in M or radians */

/* Push constants of star_tiles.comp, star_search.comp and star_images.comp. Rows are rows of rays in the buffer. */
/* clang-format off */
#define KD_STARS_FIELDS_(F, U) \
    U(width)                /* number of rays in a row */ \
    U(rows)                 /* number of all rows */ \
    U(first) U(end)         /* range of requested rows */ \
    U(left) U(right)        /* range of requested columns: first column, and column after the last */ \
    U(stride)               /* number of rays in a plane */ \
    U(row0) U(column0)      /* row and column of the buffer's first ray in the picture's grid */ \
    U(room)                 /* capacity of the list of pairs */ \
    U(tiles)                /* capacity of the list of small tiles */ \
    U(stars)                /* number of stars; the list has all directions and fluxes, then all temperatures */ \
    U(pixels_y)             /* number of rows of pixels that the buffer of light holds */ \
    /* signed numbers that convert a row and a column of the picture's pixels to those in the buffer of light, by \
     * addition */ \
    U(up) U(rightward) \
    U(rim)                  /* rim: start of the current grid's table (render/view/rim_grid.h) */ \
    /* distance of the grid's first row from the curve; decrease of the distance from row to row */ \
    /* the members from none to up_z are as in rim.h */ \
    F(far) F(fall) F(none) F(full) \
    F(ahead_x) F(ahead_y) F(ahead_z) F(right_x) F(right_y) F(right_z) F(up_x) F(up_y) F(up_z) \
    F(least)                /* in units of sky.brightness; images that add less light to a pixel are left out */
/* clang-format on */
#define KD_RIM_ANGLES 256
#define KD_RIM_EDGES 512
/* number of rays along a side of a large tile of star_tiles.comp; must be odd and a multiple of 3 */
#define KD_STAR_TILE 9
/* images of stars that add less light to a pixel are left out; in units of sky.brightness */
#define KD_STAR_LEAST 0.03
#define KD_STAR_LEAST_BRIGHT 1.0 /* limit in place of KD_STAR_LEAST if only bright images are made */
#define KD_STAR_PATCH 0.15       /* largest patch of a ray in which images of stars are searched, radians */
/* limit in place of KD_STAR_PATCH if a rim makes the images next to the critical curve */
#define KD_STAR_PATCH_RIM 0.8

/* Push constants of between.comp, for the pixels of a list that are in one band. */
/* clang-format off */
#define KD_BETWEEN_FIELDS_(F, U) \
    U(first) U(count)       /* entries of the list with pixels of the band: index of the first, and number */ \
    U(stride) U(list)       /* number of rays in a plane; offset of the list, as in KD_SLICE_FIELDS_ */ \
    U(marks)                /* number of pixels in the whole list; a result word for each follows the list */ \
    U(width) U(row0)        /* width: number of pixels in a row. row0: first row of the band */ \
    U(map_rows) U(map_stride) /* number of rows of the band; number of rays in a plane of its lens map */
/* clang-format on */

/* A guiding orbit of particles. Phases are those at the time of the picture, in units of 2^-32 turn. Amplitudes are the
 * largest amplitudes of the epicycles. */
/* clang-format off */
#define KD_GUIDE_FIELDS_(F, U) \
    U(phi) U(radial) U(vertical) \
    F(row)                   /* row of the grid at the guiding orbit's radius */ \
    F(swing_row) F(swing_phi) /* largest amplitude of the epicycle in rows; in azimuth, turns */
/* clang-format on */
/* clang-format off */
#define KD_PARTICLES_FIELDS_(F, U) \
    U(key)                   /* hash of the seed of random numbers */ \
    U(first) U(stride) U(count) \
    U(per_particle)          /* 2^31 times the number of radii, divided by the number of particles */ \
    U(rows) U(columns_log2) \
    U(unit)                  /* weight of one particle */ \
    F(tilt)                  /* largest latitude of an orbit, radians */ \
    U(plunging)              /* number of falling particles, which have the lowest numbers */ \
    U(lap) U(phase)          /* time since time 0 in plunges: the whole plunges, and the rest in units of 2^-32 */ \
    U(turn)                  /* azimuth that the orbit at the ISCO has covered since time 0, in units of 2^-32 turn */ \
    U(plunge_at)             /* offset of the falling particles' grid in the common buffer */ \
    U(plunge_rows) U(plunge_columns_log2) \
    U(lap_rows) U(lead_rows) /* numbers of rows, as in emit/plunge.glsl */
/* clang-format on */

#define KD_TRANSFER_ROWS \
    8 /* rows of adjacent pixels that one invocation of transfer.comp processes, if pixels have a single ray each */

/* number of pixels of one invocation of post.comp. The invocation writes three words, or six words with 16 bits a
 * channel */
#define KD_POST_PIXELS 4
/* clang-format off */
#define KD_POST_FIELDS_(F, U) \
    F(gain)                  /* 2^exposure */ \
    F(dither)                /* 1 if the picture is dithered, otherwise 0 */ \
    U(pixels)                /* number of pixels of the band */ \
    U(first)                 /* index of the band's first pixel in the picture */ \
    U(pixels_x) \
    F(left) F(top)           /* column and row in the picture of a tile's first pixel */ \
    U(counter)               /* index of the word that counts pixels whose light is not finite; 0 for no count */ \
    F(bloom) /* spread fraction of the light above white; used, like all members below, only with bloom */ \
    F(scale_x) F(scale_y)    /* number of cells per pixel along each axis */ \
    U(cells_x) U(cells_y)
/* clang-format on */

/* Bloom: spreading of light above white, after exposure. KD_BLOOM_ROWS is the number of rows of cells of the finest
 * grid. Each of the KD_BLOOM_LEVELS - 1 further grids has half as many rows as the one before (render/plan/bloom.h). */
#define KD_BLOOM_ROWS 128
#define KD_BLOOM_LEVELS 5
/* clang-format off */
#define KD_BLOOM_BRIGHT_FIELDS_(F, U) \
    F(gain)                  /* 2^exposure */ \
    F(strength)              /* fraction of the light above white that is spread */ \
    U(pixels_x) \
    U(row0) U(rows)          /* row0: first row of the band. rows: number of its rows */ \
    U(blocks_x)              /* number of blocks in a row of the picture */ \
    U(block_row0) U(block_rows) /* rows of blocks with pixels of the band: first row, and number */ \
    U(across)                /* number of invocations for a row of blocks */
/* clang-format on */
#define KD_BLOOM_TAPS 16 /* maximum number of blocks, along an axis, that two cells read */
/* clang-format off */
#define KD_BLOOM_GATHER_FIELDS_(F, U) \
    U(pixels_x) U(pixels_y)  /* columns and rows of the picture */ \
    U(blocks_x) U(blocks_y) U(cells_x) U(cells_y) \
    U(block_x) U(block_y)    /* sides of a block in pixels */
/* clang-format on */

/* A telescope's beam (render/plan/beam.h). These are the push constants of beam_gather.comp and beam_spread.comp. They
 * describe a band of pixels, and rows of cells. */
/* clang-format off */
#define KD_BEAM_BAND_FIELDS_(F, U) \
    U(pixels_x) \
    U(row0) U(rows)          /* row0: first row of the band in the picture. rows: number of its rows */ \
    U(columns)               /* number of cells in a row */ \
    U(cell)                  /* side of a cell, in pixels */ \
    F(cells)                 /* reciprocal of `cell` */
/* clang-format on */
/* Push constants of beam_spline.comp. Row i of the result is a sum over `count` rows of the source, from row i
 * first_times/first_over - before on. */
/* clang-format off */
#define KD_BEAM_SPLINE_FIELDS_(F, U) \
    U(columns) \
    U(row0) U(rows)          /* slice of the result: first row, and number of rows */ \
    U(length_)               /* number of rows of the source */ \
    U(first_times) U(first_over) U(before) U(count) \
    F(from_scale)            /* units of the weights' argument per row of the source */ \
    F(to_scale) F(shift)     /* the same units per row of the result; shift of the result in these units */ \
    F(weight)                /* factor by which the sum is multiplied */
/* clang-format on */
/* Push constants of beam_blur.comp. */
#define KD_BEAM_BLUR_FIELDS_(F, U) \
    U(columns) \
    U(row0)    /* first row of the slice; a multiple of four */ \
    U(lines)   /* number of lines of the slice: rows or, if the blur is along columns, groups of four rows */ \
    U(length_) /* number of cells along the axis */ \
    U(reach)   /* number of cells on each side whose weight is not 0 */ \
    F(narrow)  /* 1/(2 sigma^2), with sigma in cells */ \
    F(weight)  /* factor by which the sum is multiplied */

/* Value of Stokes V that marks a pixel one of whose rays was given up. It is larger than that of any light. */
#define KD_STOKES_UNTOLD 3e38
#define KD_STOKES_LEAST_UNTOLD 1e38

/* Push constants of photometry.comp. Each invocation adds the light of KD_LIGHT_PIXELS pixels of a band to eight sums,
 * or to sixteen sums if Stokes Q, U and V are kept. */
/* clang-format off */
#define KD_LIGHT_FIELDS_(F, U) \
    U(pixels_x) U(pixels)     /* pixels_x: number of pixels in a row. pixels: number of pixels in the band */ \
    U(row0)                   /* first row of the band in the picture */ \
    U(spots)                  /* offset of the spots' separate luminance */ \
    U(stokes)                 /* offset of the planes of Stokes Q, U and V, then of the spots' Q and U */ \
    U(plane)                  /* number of pixels in each of these planes */ \
    F(middle_x) F(middle_y)   /* column and row of the middle of the picture, in pixels */ \
    F(step_)                  /* distance between pixels, relative to the distance of the picture */
/* clang-format on */
#define KD_LIGHT_PIXELS 64
#define KD_LIGHT_SUMS 8
#define KD_LIGHT_SUMS_STOKES 16

/* Histogram of luminance for auto exposure, with eight bins a stop. The number of a bin consists of the bits of a
 * float's exponent and the first three bits of its fraction. Numbers count from FIRST, which is 2^-40. Bin 0 is black.
 */
#define KD_HISTOGRAM_BINS 512
#define KD_HISTOGRAM_FIRST 696 /* (127 - 40) * 8: the bits of 2^-40 */

/* Capacity of the list of rays that a kernel leaves open (src/render/frame/settle.c). */
#define KD_GIVEN_MOST 1048576

/* Values of the plane FATE of a lens map. */
#define KD_FATE_ESCAPED 0.0
#define KD_FATE_CAPTURED 1.0
#define KD_FATE_UNDECIDED 2.0 /* the ray reached the limit of steps before its end was known */

/* Layout of the records of trace.glsl. HEADER: count of numbers in the header. RECORD: count of numbers in a record.
 * The others are stages. Stages 0, 1, ... are the steps towards the crossing of that order, and their records hold w
 * and u. Records of the other stages hold the unit vector n and w. */
#define KD_TRACE_HEADER 8
#define KD_TRACE_RECORD 11
#define KD_TRACE_START -1.0
#define KD_TRACE_CROSSING -2.0
#define KD_TRACE_END -3.0 /* stage of the steps after the last crossing */

/* Layout of the records of light/probe.glsl. RECORD: count of numbers in a record. The others are kinds of records. */
#define KD_PROBE_RECORD 11
#define KD_PROBE_AT 0.0
#define KD_PROBE_OF_PLACE 1.0
#define KD_PROBE_ENDS 2.0
#define KD_PROBE_OF_END 3.0
#define KD_PROBE_OF_POINTS 4.0
#define KD_PROBE_LOST 5.0
#define KD_PROBE_FRONT 6.0
#define KD_PROBE_WHOLE 7.0
#define KD_PROBE_ALONG 8.0
#define KD_PROBE_OF_VOLUME 9.0
#define KD_PROBE_MET 10.0
#define KD_PROBE_MET_AT 11.0
#define KD_PROBE_POLARIZED 12.0
#define KD_PROBE_ALONG_AT 13.0
#define KD_PROBE_SUMS 2u /* number of records at the start, before all others: KD_PROBE_FRONT and KD_PROBE_WHOLE */

#endif
