#include "render/emit/radio.h"

#include "render/emit/emitter.h"

#include "physics/math/constants.h"
#include "render/view/camera.h"

#include <math.h>

double kd_radio_unit(double ghz, double kelvin)
{
    const double per_c = ghz * 1e9 / KD_C_M_S;
    return 2 * KD_K_J_K * kelvin * per_c * per_c;
}

/* For a disk: (h nu/k)/(exp(x) - 1)/f^4, where x = h nu/(k T) for the colour temperature T, and f is the hardening
 * factor. The light of a black body of f T is diluted by f^-4, so that it carries sigma T^4 (Shimura & Takahara 1995,
 * ApJ 445, 780). */
double kd_radio_kelvin(const struct kd_scene *scene)
{
    if (kd_scene_is_radio(scene) || !kd_scene_has_disk_frequency(scene))
        return KD_RADIO_KELVIN;
    const double quantum = KD_H_J_S * scene->disk.frequency_ghz * 1e9 / KD_K_J_K;
    return quantum / expm1(quantum / (kd_disk_peak_temperature(scene) * scene->disk.hardening)) /
           pow(scene->disk.hardening, 4);
}

static double unit_of(const struct kd_scene *scene)
{
    return kd_radio_unit(kd_scene_frequency_ghz(scene), kd_radio_kelvin(scene));
}

double kd_radio_jansky_steradian(const struct kd_scene *scene) { return unit_of(scene) / KD_JANSKY_SI; }

double kd_radio_jansky_pixel(const struct kd_scene *scene)
{
    const double step = kd_camera_pixel(scene);
    return kd_radio_jansky(scene, step * step);
}

double kd_radio_jansky(const struct kd_scene *scene, double flux)
{
    const double m = scene->spacetime.mass_msun * KD_M_SUN_M / (scene->spacetime.distance_pc * KD_PARSEC_M),
                 r = isfinite(scene->camera.r) ? scene->camera.r : 1;
    return flux * r * r * m * m * unit_of(scene) / KD_JANSKY_SI;
}
