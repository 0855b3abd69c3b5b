/* Functions that emitters on orbits share: the C side of shaders/emit/orbit.glsl. */
#include "render/emit/emitter.h"

uint32_t kd_orbit_traits(const struct kd_scene *scene)
{
    return (scene->disk.doppler ? KD_TRAIT_DOPPLER : 0) | (scene->disk.redshift ? KD_TRAIT_REDSHIFT : 0);
}

uint32_t kd_orbit_needs(const struct kd_scene *scene)
{
    return KD_LENS_W | KD_LENS_PHI | (scene->disk.slow_light ? KD_LENS_DELAY : 0);
}

unsigned kd_orbit_varies(const struct kd_scene *scene)
{
    (void)scene;
    return KD_MOVES_WITH_TIME | KD_MOVES_WITH_AZIMUTH;
}
