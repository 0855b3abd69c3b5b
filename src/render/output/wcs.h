/* World coordinates of a picture as in FITS (Greisen & Calabretta 2002, A&A 395, 1061; Calabretta & Greisen 2002,
 * A&A 395, 1077): position on the sky for a distant observer, direction for a near one. Pure. */
#ifndef KD_RENDER_OUTPUT_WCS_H
#define KD_RENDER_OUTPUT_WCS_H

#include "scene/scene.h"

#include <stdbool.h>

struct kd_wcs_axis {
    const char *type, *unit; /* "RA---SIN", "deg" */
    /* pixel: the reference pixel, counted from 1, from the left or from the lowest row. value: the coordinate at the
     * reference pixel. step: increment of the coordinate from pixel to pixel */
    double pixel, value, step;
};

struct kd_wcs {
    bool known; /* false: the projection has no linear axes, or the picture is a pair for two eyes */
    /* for a distant observer: angles on the sky, east to the left, from the hole's mass and distance. For a near one:
     * angles to the right of the camera's axis and above it */
    struct kd_wcs_axis at[2];
    bool far;                     /* true if the observer is distant; `impact` is then valid as well */
    struct kd_wcs_axis impact[2]; /* the same places as impact parameters alpha and beta, M */
    /* PCi_j of both pairs of axes; converts pixels to steps of the axes when the camera is rolled */
    double turn[2][2];
};

/* The scene must be valid. */
struct kd_wcs kd_wcs_of(const struct kd_scene *scene);

#endif
