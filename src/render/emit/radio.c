#include "render/emit/radio.h"

#include "physics/math/constants.h"
#include "render/view/camera.h"

#include <math.h>

double kd_radio_unit(const struct kd_scene *scene)
{
    const double per_c = scene->volume.frequency_ghz * 1e9 / KD_C_M_S;
    return 2 * KD_K_J_K * KD_RADIO_KELVIN * per_c * per_c;
}

double kd_radio_jansky_pixel(const struct kd_scene *scene)
{
    const double step = kd_camera_pixel(scene);
    return kd_radio_jansky(scene, step * step);
}

double kd_radio_jansky(const struct kd_scene *scene, double flux)
{
    const double m = scene->spacetime.mass_msun * KD_M_SUN_M / (scene->spacetime.distance_pc * KD_PARSEC_M),
                 r = isfinite(scene->camera.r) ? scene->camera.r : 1;
    return flux * r * r * m * m * kd_radio_unit(scene) / KD_JANSKY_SI;
}
