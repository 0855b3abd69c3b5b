#include "scene/scene.h"

#include "physics/spacetime/kerr.h"
#include "scene/asset.h"
#include "scene/hole.h"
#include "document/number.h"

#include <math.h>

/* Minimum of the inner edge, as a multiple of the horizon's radius. Matter at rest that is closer to the hole is no
 * longer visible, and the length of the path to this edge is finite. */
#define CLEAR 1.01
/* the same minimum for light of a radio frequency, whose energy in the frame of the matter grows as 1/sqrt(distance
 * to the horizon) */
#define CLEAR_RADIO 1.0005

#define TORUS 0.5 /* ratio of the inner edge to the radius of maximum pressure, as in most simulations */

bool kd_scene_is_radio(const struct kd_scene *scene) { return scene->volume.model > KD_VOLUME_UNIFORM; }

bool kd_scene_is_slow_volume(const struct kd_scene *scene)
{
    return scene->volume.slow_light && scene->volume.model == KD_VOLUME_GRID;
}

bool kd_scene_is_slow(const struct kd_scene *scene) { return scene->disk.slow_light || kd_scene_is_slow_volume(scene); }

double kd_scene_lead(const struct kd_scene *scene)
{
    return kd_scene_is_slow(scene) && isfinite(scene->camera.r) ? scene->camera.r : 0;
}

bool kd_scene_is_magnetic(const struct kd_scene *scene) { return scene->volume.model >= KD_VOLUME_RIAF; }

double kd_scene_volume_inner(const struct kd_scene *scene)
{
    const double horizon = kd_scene_hole(scene)->outer,
                 least = (kd_scene_is_radio(scene) ? CLEAR_RADIO : CLEAR) * horizon;
    if (isinf(scene->volume.inner) && scene->volume.model == KD_VOLUME_TORUS)
        return fmax(TORUS * scene->volume.torus_radius, least);
    return isinf(scene->volume.inner) ? least : fmax(scene->volume.inner, least);
}

#define SAME_HOLE 1e-6

static enum kd_status check_same(const char *name, double made, double here, struct kd_error *error)
{
    char of[KD_NUMBER_SIZE], is[KD_NUMBER_SIZE];
    if (fabs(made - here) <= SAME_HOLE)
        return KD_OK;
    kd_number_format(of, made);
    kd_number_format(is, here);
    return kd_error_field(error, "/volume/grid",
                          "volume.grid has matter for a hole of %s %s; spacetime.%s is %s and must be the same", name,
                          of, name, is);
}

enum kd_status kd_asset_check_grid(const struct kd_asset_grid *grid, const struct kd_scene *scene,
                                   struct kd_error *error)
{
    if (scene->volume.model != KD_VOLUME_GRID)
        return KD_OK;
    enum kd_status status;
    KD_TRY(check_same("spin", grid->spin, scene->spacetime.spin, error));
#define SAME(x, name, ...) KD_TRY(check_same(#name, grid->name, scene->spacetime.name, error));
    KD_HOLE_MORE(SAME, )
#undef SAME
done:
    return status;
}
