#include "render/plan/march.h"

#include "render/emit/emitter.h"
#include "render/view/camera.h"

#include <math.h>

#define BODIES 0.5 /* cost of looking for bodies, relative to a ray of a smooth volume */

enum { LEAST = 2, BALANCED = 4, MOST = 64, SKETCH = 2 };

#define UNSEEN 0.05 /* octaves of less than this amplitude contribute less than 1e-4 to the light */
/* the same amplitude for a sketch, which also leaves out octaves that a ray's footprint mostly averages out */
#define SKETCH_UNSEEN 0.15

static bool is_stirred(const struct kd_scene *scene)
{
    return kd_emit_along(scene) && scene->disk.height > 0 && scene->gas.amplitude > 0;
}

static double error_of(const struct kd_scene *scene)
{
    static const double errors[] = KD_MARCH_ERRORS, stirred[] = KD_MARCH_STIRRED_ERRORS;
    const struct kd_accuracy *a = &scene->accuracy;
    return isfinite(a->tolerance) ? a->tolerance : (is_stirred(scene) ? stirred : errors)[a->profile];
}

/* distance between rays, in M divided by disk.gas.scale; rays that are closer resolve more of the fine noise */
#define PIXEL 0.36
#define CLOSER 0.08 /* change of the exponent in fine_of each time the distance halves */
#define CLOSEST 3   /* number of halvings after which all octaves are resolved */

/* How many times PIXEL must be halved to give the distance between the rays of this picture; 0 if that distance is
 * larger than PIXEL. PIXEL is the distance in a picture of the preset thick-disk that is 320 pixels wide. */
static double closeness(const struct kd_scene *scene)
{
    const double distance = isfinite(scene->camera.r) ? scene->camera.r : 1, side = fmax(scene->image.samples, 1);
    return fmin(fmax(log2(PIXEL * scene->gas.scale * side / (kd_camera_pixel(scene) * distance)), 0), CLOSEST);
}

/* Errors measured in the preset thick-disk at 320 x 180, against 16 times as many stretches. In nine of ten rays, the
 * relative error of light is at most 8e-3 for fine = 4, 1.6e-3 for fine = 8 and 5e-4 for fine = 12. The error falls no
 * faster than this, because noise is smooth to the second derivative only. Closer rays resolve noise that is much finer
 * than stretches, and then the error falls more slowly. For fine = 9 it is 8e-4 at 320 x 180, 1.4e-3 at 640 x 360 and
 * 2e-3 at 1280 x 720; for fine = 3 it is 1.3e-2, 1.5e-2 and 1.8e-2 at these sizes. */
static uint32_t fine_of(double error, const struct kd_scene *scene)
{
    double fine = BALANCED * sqrt(sqrt(1e-4 / error));
    if (is_stirred(scene))
        fine = BALANCED * pow(8e-3 / error, 1 / 2.8) * pow(fmax(2e-2 / error, 1), CLOSER * closeness(scene));
    return (uint32_t)fmin(fmax(ceil(fine - 1e-9), LEAST), MOST);
}

/* The method of order six has an error of 1e-7 with sixteen steps a half period, and of 1e-5 with eight. */
static uint32_t steps_of(double error, const struct kd_setting *rays)
{
    uint32_t least = error > 5e-4 ? 8 : 16;
    bool mino = rays->engine == KD_ENGINE_MINO_RKN6 || rays->engine == KD_ENGINE_MINO_RKN4;
    return mino && rays->steps > least ? rays->steps : least;
}

/* Cost of a ray through matter at a radio frequency, relative to a ray through a uniform volume. Measured with
 * lavapipe, in core seconds of pictures of two sizes. The scenes were test 3 of Gold et al., ipole's flow, the torus,
 * and a grid of the torus with 192 x 96 nodes. */
static double of_matter(const struct kd_scene *scene)
{
    static const double of[] = { [KD_VOLUME_NONE] = 1,   [KD_VOLUME_UNIFORM] = 1, [KD_VOLUME_GOLD] = 1.7,
                                 [KD_VOLUME_RIAF] = 3.7, [KD_VOLUME_TORUS] = 1.8, [KD_VOLUME_GRID] = 6 };
    return of[scene->volume.model];
}

/* Measured with lavapipe: an octave of noise in three dimensions takes a quarter of the time of everything else at a
 * sample. */
static double weight_of(const struct kd_scene *scene, uint32_t steps, uint32_t fine)
{
    const double bodies = kd_emit_met(scene) ? BODIES * steps / 16 : 0;
    if (!kd_emit_along(scene))
        return bodies;
    return bodies + (0.25 * steps / 16 + 0.75 * fine / BALANCED) * of_matter(scene) *
                        (is_stirred(scene) ? 1 + 0.25 * scene->gas.octaves : 1);
}

/* Samples one pixel in 144, so that measuring the error takes a thirtieth of the picture's time. The fraction is
 * larger in small pictures, and smaller in large ones. */
static void lattice(uint32_t size, uint32_t most, uint32_t *n, uint32_t *every, uint32_t *first)
{
    *n = (uint32_t)fmin(fmin(fmax(size / 12, 4), most), size);
    *every = size / *n;
    /* the sample is not symmetric about the middle, because pictures may be */
    *first = (uint32_t)(0.382 * (size - (*n - 1) * *every));
}

static struct kd_march_sample sample_of(uint32_t width, uint32_t height)
{
    const double columns = sqrt(KD_MARCH_SAMPLED * (double)width / height);
    struct kd_march_sample s;
    lattice(width, (uint32_t)fmin(fmax(columns, 1), KD_MARCH_SAMPLED), &s.columns, &s.every[0], &s.first[0]);
    lattice(height, KD_MARCH_SAMPLED / s.columns, &s.rows, &s.every[1], &s.first[1]);
    return s;
}

struct kd_march kd_march_of(const struct kd_scene *scene, const struct kd_setting *rays)
{
    const double error = error_of(scene);
    const uint32_t steps = steps_of(error, rays), fine = fine_of(error, scene);
    const struct kd_window window = kd_scene_window(scene);
    return (struct kd_march) {
        .steps = steps,
        .weight = weight_of(scene, steps, fine),
        .fine = fine,
        .opaque = 0.1 * error,
        .unseen = UNSEEN,
        .sample = kd_emit_along(scene) ? sample_of((int32_t)window.width, (int32_t)window.height)
                                       : (struct kd_march_sample) { 0 },
    };
}

struct kd_march kd_march_sketch(struct kd_march march, const struct kd_scene *scene)
{
    march.sketched = true;
    march.steps = 8;
    march.fine = SKETCH;
    march.opaque = 0.1 * KD_MARCH_SKETCHED;
    march.unseen = SKETCH_UNSEEN;
    march.weight = weight_of(scene, march.steps, march.fine);
    for (int i = 0; i < 2; i++) {
        uint32_t *n = i ? &march.sample.rows : &march.sample.columns;
        march.sample.every[i] *= *n > 1 ? 2 : 1;
        *n = (*n + 1) / 2;
    }
    return march;
}

struct kd_march kd_march_finer(struct kd_march march)
{
    march.steps *= KD_MARCH_FINER;
    march.fine *= KD_MARCH_FINER;
    march.opaque /= KD_MARCH_FINER * KD_MARCH_FINER;
    return march;
}
