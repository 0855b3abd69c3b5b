#include "render/output/wcs.h"

#include "physics/math/angle.h"
#include "physics/spacetime/scale.h"
#include "render/view/camera.h"

#include <math.h>

#define DEGREE (M_PI / 180)
#define MICROARCSECOND (1 / 3.6e9) /* degrees */

/* A place x pixels right of the middle and y above it has alpha - centre_alpha = step (c x + s y) and beta -
 * centre_beta = step (c y - s x), where c and s are cosine and sine of the camera's clockwise roll. The reference pixel
 * is where alpha and beta are 0. */
static struct kd_wcs plane(const struct kd_scene *scene)
{
    const struct kd_camera *c = &scene->camera;
    double step = kd_camera_pixel(scene),
           angle = step * kd_scale_microarcseconds(scene->spacetime.mass_msun, scene->spacetime.distance_pc) *
                   MICROARCSECOND;
    double cr = kd_cos_deg(c->roll_deg), sr = kd_sin_deg(c->roll_deg);
    double x = 0.5 * (scene->image.width + 1) - (cr * c->centre_alpha - sr * c->centre_beta) / step;
    double y = 0.5 * (scene->image.height + 1) - (sr * c->centre_alpha + cr * c->centre_beta) / step;
    return (struct kd_wcs) {
        .known = true,
        .far = true,
        .at = { { "RA---SIN", "deg", x, scene->source.ra_deg, -angle },
                { "DEC--SIN", "deg", y, scene->source.dec_deg, angle } },
        .impact = { { "ALPHA", "", x, 0, step }, { "BETA", "", y, 0, step } },
        .turn = { { cr, sr }, { -sr, cr } },
    };
}

/* Moves world coordinates to a tile, whose pixels are counted from its own corner, with rows from below. */
static struct kd_wcs in_tile(struct kd_wcs wcs, const struct kd_scene *scene)
{
    const struct kd_window tile = kd_scene_window(scene);
    const double left = tile.left, below = (double)scene->image.height - tile.top - tile.height;
    wcs.at[0].pixel -= left, wcs.at[1].pixel -= below;
    wcs.impact[0].pixel -= left, wcs.impact[1].pixel -= below;
    return wcs;
}

struct kd_wcs kd_wcs_of(const struct kd_scene *scene)
{
    static const char *const types[][2] = { [KD_SIGHT_PINHOLE] = { "CLON-TAN", "CLAT-TAN" },
                                            [KD_SIGHT_SPHERE] = { "CLON-CAR", "CLAT-CAR" },
                                            [KD_SIGHT_DOME] = { "CLON-ARC", "CLAT-ARC" } };
    const double width = scene->image.width, height = scene->image.height;
    const uint32_t sight = kd_camera_sight(scene);
    if (scene->camera.projection == KD_PROJECTION_RING ||
        scene->camera.stereo == KD_STEREO_PAIR) /* a pair has two pictures, each with coordinates of its own */
        return (struct kd_wcs) { 0 };
    if (sight == KD_SIGHT_PLANE)
        return in_tile(plane(scene), scene);
    double step = sight == KD_SIGHT_SPHERE ? 360 / width
                  : sight == KD_SIGHT_DOME ? 180 / fmin(width, height)
                                           : kd_camera_pixel(scene) / DEGREE;
    const struct kd_wcs whole = {
        .known = true,
        .turn = { { 1, 0 }, { 0, 1 } },
        .at = { { types[sight][0], "deg", 0.5 * (width + 1), 0, step },
                { types[sight][1], "deg", 0.5 * (height + 1), 0, sight == KD_SIGHT_SPHERE ? 180 / height : step } },
    };
    return in_tile(whole, scene);
}
