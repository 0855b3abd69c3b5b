/* World coordinates of a picture, as FITS has them (Greisen & Calabretta 2002, A&A 395, 1061; Calabretta & Greisen
 * 2002, A&A 395, 1077): what a place in it is on the sky of an observer far away, or around a near one. Pure. */
#ifndef KD_RENDER_OUTPUT_WCS_H
#define KD_RENDER_OUTPUT_WCS_H

#include "scene/scene.h"

#include <stdbool.h>

struct kd_wcs_axis {
    const char *type, *unit;   /* "RA---SIN", "deg" */
    double pixel, value, step; /* the pixel of reference, counted from 1, from the left or from the lowest row; what is
                                  there; how much a pixel more is */
};

struct kd_wcs {
    bool known; /* false: the projection has no linear axes, or the file has two pictures side by side, or there are two
                   pictures */
    struct kd_wcs_axis at[2]; /* far away, east to the left, by mass and distance of the hole; near, right of and above
                                 the camera's axis */
    bool far;                 /* then the same places are */
    struct kd_wcs_axis impact[2]; /* impact parameters alpha and beta, M */
    double turn[2][2];            /* PCi_j of both: how steps of the axes are made of pixels, where the camera rolls */
};

/* The scene must be valid. */
struct kd_wcs kd_wcs_of(const struct kd_scene *scene);

#endif
