/* Numbers of the picture and of the hole that all emitters may read. */
#ifndef KD_BLOCK_frame
/* clang-format off */
#define KD_BLOCK_frame(F, U, A) \
    U(pixels_x)            /* number of pixels in a row */ \
    U(band_pixels)         /* number of pixels of the buffer of light; the separate luminance follows their light */ \
    F(azimuth)             /* azimuth of the observer, radians */ \
    F(delay)                /* light delay, M, with which moving emitters are shown as at the scene's time */ \
    F(w_least) F(w_most)   /* range of 1/r within which crossings may have light */ \
    F(along_least) F(along_most) /* range of 1/r that contains all volumes */ \
    F(along_hollow) F(along_u)   /* least and largest |cos(theta)| in all volumes */ \
    F(along_knot)          /* 1/r of a sphere on which the light of a volume has an edge; 0 if there is none */ \
    F(kelvin) F(jansky)     /* factors that convert light at one frequency to K (brightness) and to Jy/sr */ \
    F(jansky_pixel)         /* converts a pixel's light at one frequency to Jy; 0 if pixels differ in size */ \
    F(r_isco) \
    F(one_minus_a)         /* 1 - spin; computed from a float near 1 it would lose digits */ \
    F(inner) F(outer)      /* edges of the disk, M; set even if nothing between them emits light */
/* clang-format on */
#endif
