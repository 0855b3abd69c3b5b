/* Layouts and constants shared by C and GLSL. They consist of 4-byte scalars only. Each list is written once and
 * expanded by both sides; a test compares the offsets in the SPIR-V with offsetof. */
#ifndef KD_INTERFACE_H
#define KD_INTERFACE_H

/* Invocations of a workgroup in every kernel: eight lavapipe vectors, two NVIDIA warps, one AMD wave. */
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

/* Parameters of the hole that a Kerr hole does not have. The function kd_hole_NAME of hole.h computes each of them. */
#define KD_HOLE_MORE_FIELDS_(F) F(charge2) /* q^2 */

/* Parameters of the hole. They are a part of each uniform block whose kernel needs the hole. */
/* clang-format off */
#define KD_HOLE_FIELDS_(F) \
    F(spin)                 /* a */ \
    F(horizon)              /* 1/r+ */ \
    F(root)                 /* sqrt(1 - a^2 - q^2), not exact from floats of a and q; horizons are at r = 1 +- root */ \
    KD_HOLE_MORE_FIELDS_(F)
/* clang-format on */

/* Camera and the hole: a uniform block of the tracing and transfer kernels. A ray at (x, y), in steps from the middle
 * of the picture with y upwards, has the direction c0 + x cx + y cy. At infinity its first two components are alpha and
 * beta. At a finite radius it is normalised to the look direction k = (k_r, k_theta, k_phi) in the observer's local
 * frame. On a sphere and a dome the steps are angles, and c0, cx and cy point ahead, to the right and up. The direction
 * is then cos(y) (cos(x) c0 + sin(x) cx) + sin(y) cy on a sphere, and cos(d) c0 + sin(d) (x cx + y cy) / d with d^2 =
 * x^2 + y^2 on a dome. A photon from there moves along m = -k, and has E = e_t + m_r e_r + m_theta e_theta + m_phi
 * e_phi. L/sin(theta) follows likewise from l_, p_theta from p_, and dw/dtau of the traced ray from dw_. The numbers
 * named with _t, _r, _theta and _phi are components of the observer's tetrad (src/physics/spacetime/tetrad.h). */
/* clang-format off */
#define KD_CAMERA_FIELDS_(F, U) \
    F(c0x) F(c0y) F(c0z) F(cxx) F(cxy) F(cxz) F(cyx) F(cyy) F(cyz) \
    F(middle_x) F(middle_y) /* ray coordinates of the middle of the picture */ \
    KD_HOLE_FIELDS_(F) \
    F(u) F(s)               /* cosine and sine of the observer's polar angle */ \
    F(w0)                   /* 1/r of the observer, 0 at infinity */ \
    /* for an observer that falls outside the horizon: Boyer-Lindquist azimuth minus ingoing azimuth; otherwise 0 */ \
    F(twist) \
    F(e_t) F(e_r) F(e_theta) F(e_phi) F(l_t) F(l_r) F(l_theta) F(l_phi) \
    F(p_t) F(p_r) F(p_theta) F(p_phi) F(dw_t) F(dw_r) F(dw_theta) F(dw_phi) \
    F(turn_x) F(turn_y)     /* angle of a step in quarter turns, for a sphere and a dome */ \
    F(size_e)               /* upper bound of |E| over all rays of the camera */ \
    /* bounds of the rounding error of R (kd_rounding of shaders/ray/kerr_ray.glsl) */ \
    F(noise_w) F(noise_wl) F(noise_p) F(noise_l) F(noise_k) F(noise_0) \
    U(width)                /* rays a row */ \
    U(sight)                /* KD_SIGHT_...; kernels also have it as a specialisation constant */
/* clang-format on */

/* Push constants of the tracing and transfer kernels: the current rows of rays. For listed pixels three members differ:
 * row0 is the first pixel of a slice, rows is the number of pixels, and band0 is the first row of the band to which
 * their light is written. */
/* clang-format off */
#define KD_SLICE_FIELDS_(F, U) \
    U(row0) U(rows)         /* first row of this slice in the picture; rows of the slice */ \
    U(band0)                /* first row of the band that the buffers hold */ \
    U(stride)               /* number of rays of the band, which is the distance between planes of the lens map */ \
    U(list)                 /* listed pixels: offset of the list in the lens map; nodes: offset of their states */ \
    /* rays by place: the stage, the offset of its list of places, and the ray at the origin of these places */ \
    U(stage) U(places) U(origin_x) U(origin_y) \
    U(steps) U(fine) /* march (light/march.glsl): steps in a half period; a stretch is at most 4/fine grains long */ \
    F(opaque)               /* a ray ends if less than this fraction of the light behind is transmitted */ \
    F(unseen)               /* octaves of noise are left out if they are below this fraction of the first octave */ \
    /* sample: pixels in a row (0: no sample, all pixels are lit), and the first column; row0 is the first row */ \
    U(columns) U(first) \
    U(every_x) U(every_y)   /* distance of the sample's columns and of its rows */ \
    /* index at which the stored light of the sample begins; the pixels follow row by row */ \
    U(to) \
    /* number of the ray in its pixel; the march adds its light to that of earlier rays */ \
    U(ray) \
    U(lost_most)            /* capacity of the list of stopped rays */ \
    U(lost_first) U(lost_n) /* range of listed rays that this dispatch continues: the first one, and their number */ \
    U(lost_goes)            /* 0: this is the first piece of these rays; 1: their state is read */
/* clang-format on */

/* Rays through volumes that were stopped early are stored after a band's light (frame/pieces.c). Offsets count from the
 * end of the light's buffer. The data are three counters (rays given up, rays listed, and rays that wait for their next
 * piece), then KD_LOST_STATE words for each ray that is continued in the same dispatch, then the list. An entry of the
 * list is (pixel number) * (rays a pixel) + ray, with the pixel's number in the band, the list of pixels or the sample.
 * A piece takes up to KD_PIECE_PASSES passes of loops. lavapipe (Mesa 22.3) ends the loops of eight invocations after
 * 65 535 passes in total, and work that is repeated takes some thousand of these passes. */
#define KD_LOST_GIVEN_UP 1
#define KD_LOST_LISTED 2
#define KD_LOST_WAITING 3
#define KD_LOST_STATES 3 /* offset of the end of the states */
#define KD_LOST_STATE 25
#define KD_LOST_AT_ONCE 2048
/* place of the first ray of the list; each further ray is stored before the last one */
#define KD_LOST_RAYS (KD_LOST_STATES + KD_LOST_STATE * KD_LOST_AT_ONCE + 1)
#define KD_LOST_NONE 0xffffffffu /* the ray reached its end */
#define KD_PIECE_PASSES 6000u

/* Push constants of footprint.comp. Rows are rows of rays in the buffer. */
/* clang-format off */
#define KD_FOOTPRINT_FIELDS_(F, U) \
    U(width)                /* rays a row */ \
    U(rows)                 /* number of all rows; for listed pixels, number of pixels */ \
    U(first) U(end)         /* range of the requested rows, or of the requested rays on listed pixels */ \
    U(stride)               /* rays a plane */ \
    U(list)                 /* offset of the listed pixels, or of the places of rays that are traced singly */ \
    U(alone)                /* 1: only single rays; footprints from row `end` on are only marked as missing, */ \
                            /* because the rows below are not traced yet. 2: only the marked footprints */ \
    U(origin_x) U(origin_y) /* ray at the origin of the single rays' places: row and column of the buffer */
/* clang-format on */
/* Push constants of lens_cells.comp and lens_fill.comp, for a lens map traced at nodes and interpolated
 * (src/render/frame/sample.c). Places count in rays of this picture. Cells are aligned to the whole picture. */
/* clang-format off */
#define KD_SAMPLE_FIELDS_(F, U) \
    U(origin_x) U(origin_y) /* place of the first block's first ray; signed integers */ \
    U(blocks_x) U(blocks_y) \
    U(width) U(rows)        /* rays a row of the map; number of requested rows of rays */ \
    U(row0) U(band0)        /* first requested row; first row that the map's buffer holds */ \
    U(stride)               /* rays a plane of the map */ \
    U(room)                 /* rays a plane of the nodes' map */ \
    U(level)                /* lens_cells.comp: 0 makes the first nodes, 1 to KD_CELL_LEVELS test cells */ \
    F(tolerance)
/* clang-format on */
#define KD_CELL_BLOCK 64 /* rays along the side of a cell of level 1; the side is halved at each level */
#define KD_CELL_LEVELS 4
/* Header of the nodes' lists, in words: the workgroups along three axes of an indirect dispatch, and the number of
 * items. The header has such an entry for each stage of rays (the nodes of each level, and single rays) and for each
 * level of cells. It has two more entries for filling smooth cells, with crossings and with the sky. */
#define KD_STAGE_ALONE KD_CELL_LEVELS
#define KD_SAMPLE_STAGES (KD_CELL_LEVELS + 1)
#define KD_SAMPLE_CELLS (4 * KD_SAMPLE_STAGES)
#define KD_SAMPLE_FILLS (KD_SAMPLE_CELLS + 4 * KD_CELL_LEVELS)
#define KD_SAMPLE_COUNTED (KD_SAMPLE_FILLS + 4 * 2)
#define KD_SAMPLE_QUEUES 64 /* offset of the lists, after the header; each level has at most 85 cells in a block */
#define KD_SAMPLE_QUEUED 85
#define KD_SAMPLE_UNITS \
    64 /* maximum number of units to fill in a block, for each of two kinds; a unit is eight columns of a cell. The \
          lists of places follow the units */
#define KD_PLACE_BITS 17
#define KD_FOOTPRINT_PLACES 1
#define KD_PLACES_BINDING 3          /* binding of the lists of places in the tracing kernels */
#define KD_RAYS_BY_PLACE 0xffffffffu /* value of the constant CRITICAL in kernels that process stages */
/* State of a node: number of crossings of its ray, plus KD_NODE_CAPTURED if it is captured. Negative: the ray is
 * undecided. */
#define KD_NODE_CAPTURED 16.0
#define KD_NODE_OPEN -1.0
/* planes that follow those of the nodes' map: the nodes' states, and a value that vanishes where fates change */
#define KD_NODE_OWN 2

#define KD_FOOTPRINT_WANTED -1.0
#define KD_FOOTPRINT_EDGE 1e9 /* M, and radians: larger than any footprint */

/* Push constants of star_tiles.comp, star_search.comp and star_images.comp. Rows are rows of rays in the buffer. */
/* clang-format off */
#define KD_STARS_FIELDS_(F, U) \
    U(width)                /* rays a row */ \
    U(rows)                 /* number of all rows */ \
    U(first) U(end)         /* requested rows */ \
    U(left) U(right)        /* requested columns: from left, to the one before right */ \
    U(stride)               /* rays a plane */ \
    U(row0) U(column0)      /* position of the buffer's first ray in the picture's grid of rays: row and column */ \
    U(room)                 /* capacity for pairs of a ray and a star */ \
    U(tiles)                /* capacity for small tiles */ \
    U(stars)                /* number of stars; the temperatures follow the directions and fluxes of all stars */ \
    U(pixels_y)             /* rows of pixels that the buffer of light holds */ \
    /* signed offsets that are added to rows and columns of the picture's pixels, to get those of the light */ \
    U(up) U(rightward) \
    U(rim)                  /* rim: start of the current grid's table (render/view/rim_grid.h) */ \
    /* far, fall: distance of the grid's first row from the curve, and the decrease from row to row */ \
    /* none to up_z: as in rim.h */ \
    F(far) F(fall) F(none) F(full) \
    F(ahead_x) F(ahead_y) F(ahead_z) F(right_x) F(right_y) F(right_z) F(up_x) F(up_y) F(up_z) \
    F(least)                /* images that add less light to a pixel are left out; unit: sky.brightness */
/* clang-format on */
#define KD_RIM_ANGLES 256
#define KD_RIM_EDGES 512
/* rays along the sides of a large tile of star_tiles.comp; odd, and a multiple of 3 */
#define KD_STAR_TILE 9
#define KD_STAR_LEAST 0.03       /* fraction of sky.brightness: images that add less light to a pixel are left out */
#define KD_STAR_LEAST_BRIGHT 1.0 /* as KD_STAR_LEAST, if only bright images are made */
#define KD_STAR_PATCH 0.15       /* radians: largest patch of a ray in which images of stars are searched */
#define KD_STAR_PATCH_RIM 0.8    /* as KD_STAR_PATCH, if a rim has the images next to the critical curve */

/* Push constants of between.comp, for the pixels of a list that are in one band. */
/* clang-format off */
#define KD_BETWEEN_FIELDS_(F, U) \
    U(first) U(count)       /* range of entries of the list whose pixels are in the band */ \
    U(stride) U(list)       /* as in KD_SLICE_FIELDS_ */ \
    U(marks)                /* number of pixels of the whole list; a result word for each of them follows the list */ \
    U(width) U(row0)        /* pixels a row; first row of the band */ \
    U(map_rows) U(map_stride) /* rows of the band; rays a plane of its lens map */
/* clang-format on */

/* A guiding orbit of particles: phases at the time of the picture, in units of 2^-32 turn, and the largest amplitudes
 * of its epicycles. */
/* clang-format off */
#define KD_GUIDE_FIELDS_(F, U) \
    U(phi) U(radial) U(vertical) \
    F(row)                   /* row of the grid */ \
    F(swing_row) F(swing_phi) /* swing_phi in turns */
/* clang-format on */
/* clang-format off */
#define KD_PARTICLES_FIELDS_(F, U) \
    U(key)                   /* hash of the seed */ \
    U(first) U(stride) U(count) \
    U(per_particle)          /* 2^31 radii/particles */ \
    U(rows) U(columns_log2) \
    U(unit)                  /* weight of one particle */ \
    F(tilt)                  /* largest latitude, radians */ \
    U(plunging)              /* number of falling particles, which are the first ones */ \
    U(lap) U(phase)          /* time since time 0, in plunges: whole plunges, and the remainder in units of 2^-32 */ \
    U(turn)                  /* azimuth of the orbit at the ISCO since time 0, in units of 2^-32 turn */ \
    U(plunge_at)             /* start of the falling particles' grid in the common buffer */ \
    U(plunge_rows) U(plunge_columns_log2) \
    U(lap_rows) U(lead_rows) /* as in the transfer kernel */
/* clang-format on */

#define KD_TRANSFER_ROWS \
    8 /* rows of adjacent pixels that one invocation of transfer.comp processes, if pixels have a single ray each */

/* pixels of one invocation of post.comp, which writes three words, or six with 16 bits a channel */
#define KD_POST_PIXELS 4
/* clang-format off */
#define KD_POST_FIELDS_(F, U) \
    F(gain)                  /* 2^exposure */ \
    F(dither)                /* 0 or 1 */ \
    U(pixels)                /* number of pixels of the band */ \
    U(first)                 /* index of the band's first pixel in the picture */ \
    U(pixels_x) \
    F(left) F(top)           /* for a tile: place of its first pixel in the picture */ \
    U(counter)               /* index of the word that counts pixels whose light is not finite; 0: not counted */ \
    F(bloom) /* fraction of light above white that is spread; this and all later members are used only with bloom */ \
    F(scale_x) F(scale_y)    /* cells a pixel */ \
    U(cells_x) U(cells_y)
/* clang-format on */

/* Bloom of light above white, after exposure. The finest grid has this many rows of cells. Each of the KD_BLOOM_LEVELS
 * - 1 further grids has half as many rows as the one before (render/plan/bloom.h). */
#define KD_BLOOM_ROWS 128
#define KD_BLOOM_LEVELS 5
/* clang-format off */
#define KD_BLOOM_BRIGHT_FIELDS_(F, U) \
    F(gain)                  /* 2^exposure */ \
    F(strength)              /* fraction of the light above white that is spread */ \
    U(pixels_x) \
    U(row0) U(rows)          /* rows of the band */ \
    U(blocks_x)              /* blocks in a row of the picture */ \
    U(block_row0) U(block_rows) /* blocks with pixels of the band */ \
    U(across)                /* invocations for a row of blocks */
/* clang-format on */
#define KD_BLOOM_TAPS 16 /* maximum number of blocks along an axis that two cells read */
/* clang-format off */
#define KD_BLOOM_GATHER_FIELDS_(F, U) \
    U(pixels_x) U(pixels_y)  /* size of the picture */ \
    U(blocks_x) U(blocks_y) U(cells_x) U(cells_y) \
    U(block_x) U(block_y)    /* sides of a block in pixels */
/* clang-format on */

/* A telescope's beam (render/plan/beam.h). Push constants of beam_gather.comp and beam_spread.comp: a band of
 * pixels, and rows of cells. */
/* clang-format off */
#define KD_BEAM_BAND_FIELDS_(F, U) \
    U(pixels_x) \
    U(row0) U(rows)          /* rows of the band in the picture */ \
    U(columns)               /* number of cells in a row */ \
    U(cell)                  /* side of a cell in pixels */ \
    F(cells)                 /* reciprocal of `cell` */
/* clang-format on */
/* Push constants of beam_spline.comp. Row i is a sum over `count` rows, starting at i first_times/first_over -
 * before. */
/* clang-format off */
#define KD_BEAM_SPLINE_FIELDS_(F, U) \
    U(columns) \
    U(row0) U(rows)          /* rows of the slice of the result */ \
    U(length_)               /* rows of the source */ \
    U(first_times) U(first_over) U(before) U(count) \
    F(from_scale)            /* units of the weights' argument per row of the source */ \
    F(to_scale) F(shift)     /* units of the weights' argument per row of the result, and the result's shift */ \
    F(weight)                /* factor of the whole sum */
/* clang-format on */
/* Push constants of beam_blur.comp. */
#define KD_BEAM_BLUR_FIELDS_(F, U) \
    U(columns) \
    U(row0)    /* first row of the slice, a multiple of four */ \
    U(lines)   /* lines of the slice: rows, or along columns groups of four rows */ \
    U(length_) /* cells along the axis */ \
    U(reach)   /* cells on either side that have weight */ \
    F(narrow)  /* 1/(2 sigma^2) */ \
    F(weight)  /* factor of the whole sum */

/* Value of Stokes V that marks a pixel if one of its rays was given up. It is larger than that of any light. */
#define KD_STOKES_UNTOLD 3e38
#define KD_STOKES_LEAST_UNTOLD 1e38

/* Push constants of photometry.comp. Each invocation adds KD_LIGHT_PIXELS pixels of a band to eight sums, or to sixteen
 * sums with Stokes Q, U and V. */
/* clang-format off */
#define KD_LIGHT_FIELDS_(F, U) \
    U(pixels_x) U(pixels)     /* pixels a row; pixels of the band */ \
    U(row0)                   /* first row of the band in the picture */ \
    U(spots)                  /* start of the spots' separate luminance */ \
    U(stokes)                 /* start of Stokes Q, U and V, and of the spots' Q and U */ \
    U(plane)                  /* length of each of these planes, in pixels */ \
    F(middle_x) F(middle_y)   /* pixel coordinates of the middle of the picture */ \
    F(step_)                  /* distance of pixels over the distance of the picture */
/* clang-format on */
#define KD_LIGHT_PIXELS 64
#define KD_LIGHT_SUMS 8
#define KD_LIGHT_SUMS_STOKES 16

/* Histogram of luminance for auto exposure, with eight bins a stop. A bin number is the exponent of a float, followed
 * by the first three bits of its fraction. Bin 0 is black; bin FIRST is 2^-40. */
#define KD_HISTOGRAM_BINS 512
#define KD_HISTOGRAM_FIRST 696 /* (127 - 40) * 8 */

/* Capacity of the list of rays that a kernel leaves open (src/render/frame/settle.c). */
#define KD_GIVEN_MOST 1048576

/* Values of the fate plane. */
#define KD_FATE_ESCAPED 0.0
#define KD_FATE_CAPTURED 1.0
#define KD_FATE_UNDECIDED 2.0 /* the ray has reached the limit of steps */

/* Layout of the records of trace.glsl: numbers of the header, numbers of a record, and the stages. A record of stage 0,
 * 1, ... is a step towards the crossing of that order, and holds w and u. Records of the other stages hold the unit
 * vector n and w. */
#define KD_TRACE_HEADER 8
#define KD_TRACE_RECORD 11
#define KD_TRACE_START -1.0
#define KD_TRACE_CROSSING -2.0
#define KD_TRACE_END -3.0 /* stage of the steps after the last crossing */

/* Layout of the records of light/probe.glsl: numbers of a record, and the kinds of records. */
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
#define KD_PROBE_SUMS 2u /* records before the others: KD_PROBE_FRONT and KD_PROBE_WHOLE */

#endif
