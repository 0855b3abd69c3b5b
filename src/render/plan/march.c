#include "render/plan/march.h"

#include <math.h>

enum { LEAST = 2, BALANCED = 4, MOST = 64 };

static double error_of(const struct kd_accuracy *a)
{
    static const double errors[] = KD_MARCH_ERRORS;
    return isfinite(a->tolerance) ? a->tolerance : errors[a->profile];
}

static uint32_t fine_of(double error)
{
    double fine = ceil(BALANCED * sqrt(sqrt(1e-4 / error)) - 1e-9);
    return (uint32_t)fmin(fmax(fine, LEAST), MOST);
}

/* Of sixteen steps a half period the sixth order leaves 1e-7; of eight, 1e-5. */
static uint32_t steps_of(double error, const struct kd_setting *rays)
{
    uint32_t least = error > 5e-4 ? 8 : 16;
    bool mino = rays->engine == KD_ENGINE_MINO_RKN6 || rays->engine == KD_ENGINE_MINO_RKN4;
    return mino && rays->steps > least ? rays->steps : least;
}

/* By lavapipe: an octave of noise in three dimensions takes a quarter of what all else of a place does. */
static double weight_of(const struct kd_scene *scene, uint32_t steps, uint32_t fine)
{
    const bool stirred = scene->disk.height > 0 && scene->gas.amplitude > 0;
    return (0.25 * steps / 16 + 0.75 * fine / BALANCED) * (stirred ? 1 + 0.25 * scene->gas.octaves : 1);
}

struct kd_march kd_march_of(const struct kd_scene *scene, const struct kd_setting *rays)
{
    const double error = error_of(&scene->accuracy);
    const uint32_t steps = steps_of(error, rays), fine = fine_of(error);
    return (struct kd_march) { .steps = steps, .weight = weight_of(scene, steps, fine), .fine = fine };
}
