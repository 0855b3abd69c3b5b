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

struct kd_march kd_march_of(const struct kd_scene *scene, const struct kd_setting *rays)
{
    double error = error_of(&scene->accuracy);
    return (struct kd_march) { steps_of(error, rays), fine_of(error) };
}

struct kd_march kd_march_finer(struct kd_march march)
{
    march.steps *= 2;
    march.fine = 2 * march.fine;
    return march;
}
