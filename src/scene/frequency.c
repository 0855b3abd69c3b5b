/* Scenes that show light of a single frequency, and the temperature of their disk. */
#include "scene/scene.h"

#include "physics/disk/thin_disk.h"
#include "physics/math/constants.h"
#include "scene/hole.h"

bool kd_scene_has_disk_frequency(const struct kd_scene *scene)
{
    return scene->disk.model != KD_DISK_NONE && scene->disk.band == KD_BAND_FREQUENCY;
}

static bool has_only_disk(const struct kd_scene *scene)
{
    return kd_scene_has_disk_frequency(scene) && scene->volume.model == KD_VOLUME_NONE;
}

static bool has_only_radio(const struct kd_scene *scene)
{
    return kd_scene_is_radio(scene) && scene->disk.model == KD_DISK_NONE;
}

bool kd_scene_is_radio_alone(const struct kd_scene *scene)
{
    const struct kd_spot *on[KD_SPOTS];
    const struct kd_body *bodies[KD_SCENE_BODIES];
    return (has_only_radio(scene) || has_only_disk(scene)) && scene->jets.brightness == 0 &&
           scene->flash.brightness == 0 && scene->sky.model == KD_SKY_NONE && !kd_scene_spots(scene, on) &&
           !kd_scene_bodies(scene, bodies) && !scene->dynamic.at;
}

double kd_scene_frequency_ghz(const struct kd_scene *scene)
{
    return kd_scene_is_radio(scene) ? scene->volume.frequency_ghz : scene->disk.frequency_ghz;
}

const char *kd_scene_frequency_path(const struct kd_scene *scene)
{
    return kd_scene_is_radio(scene) ? "volume.frequency_ghz" : "disk.frequency_ghz";
}

void kd_scene_set_frequency(struct kd_scene *scene, double ghz)
{
    *(kd_scene_is_radio(scene) ? &scene->volume.frequency_ghz : &scene->disk.frequency_ghz) = ghz;
}

/* Maximum effective temperature of the disk in K, in the frame of the gas. Light that returns to the disk is
 * ignored. */
static double peak_k(const struct kd_scene *scene)
{
    if (scene->disk.colour == KD_COLOUR_PEAK)
        return scene->disk.peak_temperature_k;
    const struct kd_hole *hole = kd_scene_hole(scene);
    const double flux = scene->disk.model == KD_DISK_SHAKURA_SUNYAEV
                            ? kd_disk_flux_shakura_sunyaev(hole, kd_disk_peak_shakura_sunyaev(hole))
                            : kd_disk_flux_page_thorne(hole, kd_disk_peak_page_thorne(hole));
    return kd_disk_temperature(flux, hole, scene->spacetime.mass_msun, scene->disk.mdot_edd);
}

double kd_scene_disk_most_ghz(const struct kd_scene *scene)
{
    return KD_DISK_QUANTA * KD_K_J_K / KD_H_J_S * 1e-9 * peak_k(scene) * scene->disk.hardening;
}
