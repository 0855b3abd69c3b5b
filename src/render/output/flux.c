#include "render/output/flux.h"

#include "render/emit/radio.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

double kd_flux_jy(const struct kd_scene *scene, const struct kd_frame *frame)
{
    return frame->light.measured && kd_scene_is_radio_alone(scene) ? kd_radio_jansky(scene, frame->light.all.flux)
                                                                   : NAN;
}

void kd_flux_text(const struct kd_scene *scene, const struct kd_frame *frame, char out[KD_FLUX_TEXT])
{
    const double jy = kd_flux_jy(scene, frame);
    *out = 0;
    if (!isnan(jy))
        snprintf(out, KD_FLUX_TEXT, "jy=%.6g ghz=%.9g kelvin=%.6g", jy, kd_scene_frequency_ghz(scene),
                 kd_radio_kelvin(scene));
    if (*out && scene->volume.normalise_to_jy > 0)
        snprintf(out + strlen(out), KD_FLUX_TEXT - strlen(out), " density_scale=%.9g", frame->density_scale);
}
