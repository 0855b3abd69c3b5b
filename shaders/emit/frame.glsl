/* All emitters may read these numbers of the picture and of the hole. */
#ifndef KD_BLOCK_frame
/* clang-format off */
#define KD_BLOCK_frame(F, U, A) \
    U(pixels_x)            /* a row */ \
    U(band_pixels)         /* whose light one buffer holds; behind it is what is kept apart */ \
    F(azimuth)             /* of the observer, radians */ \
    F(delay)               /* of the light that shows what moves as it is, M */ \
    F(w_least) F(w_most)   /* 1/r of crossings that may shine */ \
    F(along_least) F(along_most) /* 1/r between which volumes are, */ \
    F(along_hollow) F(along_u)   /* and the least and the largest |cos(theta)| */ \
    F(along_knot)          /* 1/r of a sphere at which the light of one has an edge; 0: none */ \
    F(r_isco) \
    F(one_minus_a)         /* 1 - spin, which a float of the spin has lost near 1 */ \
    F(inner) F(outer)      /* edges of the disk, M, whether anything shines between them or not */
/* clang-format on */
#endif
