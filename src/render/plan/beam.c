#include "render/plan/beam.h"

#include <math.h>

/* full width at half maximum of a Gaussian, in standard deviations: 2 sqrt(2 ln 2) */
#define FWHM 2.3548200450309493
/* width in pixels: a narrower beam gives a neighbouring pixel less than exp(-50) of the weight of the pixel itself */
#define LEAST 0.1
#define SPLINES 0.5 /* sum of the variances of both splines, in squared cells */

static uint32_t cells(uint32_t pixels, uint32_t cell) { return cell > 1 ? (pixels + cell - 1) / cell + 2 : pixels; }

struct kd_beam_grid kd_beam_of(const struct kd_scene *scene)
{
    struct kd_beam_grid beam = { 0 };
    const uint32_t width = (uint32_t)scene->image.width, height = (uint32_t)scene->image.height;
    if (!(scene->style.beam_uas > 0))
        return beam;
    const double sigma = scene->style.beam_uas / FWHM / kd_scene_width_uas(scene) * width;
    if (!(sigma >= LEAST))
        return beam;
    beam.cell = (uint32_t)fmax(floor(sigma / KD_BEAM_CELLS), 1);
    beam.sigma = beam.cell > 1 ? sqrt(pow(sigma / beam.cell, 2) - SPLINES) : sigma;
    beam.reach = (uint32_t)ceil(5 * beam.sigma);
    beam.columns = cells(width, beam.cell);
    beam.rows = cells(height, beam.cell);
    beam.height = height;
    return beam;
}
