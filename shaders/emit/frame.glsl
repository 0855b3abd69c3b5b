/* Numbers of the picture and of the hole that all emitters may read. */
#ifndef KD_BLOCK_frame
/* clang-format off */
#define KD_BLOCK_frame(F, U, A) \
    U(pixels_x)            /* a row */ \
    U(band_pixels)         /* number of pixels whose light one buffer holds; the separate luminance follows it */ \
    F(azimuth)             /* azimuth of the observer, radians */ \
    F(delay)               /* the light delay for which moving emitters are shown at the scene's time, M */ \
    F(w_least) F(w_most)   /* range of 1/r in which crossings may have light */ \
    F(along_least) F(along_most) /* range of 1/r of all volumes together */ \
    F(along_hollow) F(along_u)   /* least and largest |cos(theta)| of all volumes together */ \
    F(along_knot)          /* 1/r of a sphere at which the light of a volume has an edge; 0: none */ \
    F(kelvin) F(jansky)    /* light 1 at one frequency: as brightness temperature in K, and as Jy per steradian */ \
    F(jansky_pixel)        /* Jy from one pixel of light 1 of one frequency; 0: pixels differ in size */ \
    F(r_isco) \
    F(one_minus_a)         /* 1 - spin, which would lose digits if it were computed from a float near 1 */ \
    F(inner) F(outer)      /* edges of the disk, M; always set, even if nothing emits light between them */
/* clang-format on */
#endif
