/* Tests of one ray step by step. The recording kernel ends where the ordinary kernel does. The steps lie on the ray,
 * and the first integrals are constant along them. */
#include "render/rays/steps.h"

#include "render_support.h"

#include <math.h>

struct ray { double spin, inclination, r, alpha, beta; };
static const struct ray rays[] = {
    { 0.9, 70, INFINITY, -3.75, 1 }, { 0.9, 70, INFINITY, 6.5, 0.5 },  { 0, 45, INFINITY, 5, -2.5 },
    { 0.9, 0, INFINITY, 5, 3 },      { 0.9, 90, INFINITY, 5, 4 },      { 0.9, 90, INFINITY, 7.5, 0 },
    { -0.9, 70, 50, 4, -3 },         { 0.9, 60, INFINITY, 0.25, 0.5 },
};
enum { RAYS = sizeof rays / sizeof *rays, ORDERS = 3 };

static struct kd_rays_steps steps_of(const struct ray *ray, enum kd_engine engine, enum kd_precision precision)
{
    const struct kd_rays_params params = {
        .spin = ray->spin,
        .r = ray->r,
        .inclination_deg = ray->inclination,
        .orders = ORDERS,
        .engine = engine,
        .precision = precision,
    };
    struct kd_rays_steps steps;
    OK(kd_rays_steps(renderer, &params, &(struct kd_ray_labels) { (double[]) { ray->alpha, ray->beta }, NULL, 1 },
                     &steps, &error));
    assert_true(steps.n > 1 && steps.lost == 0 && steps.same);
    assert_int_equal(steps.steps[0].stage, KD_STAGE_START);
    return steps;
}

static void below(double residual, double size, double bound)
{
    if (!isnan(residual) && !(fabs(residual) <= bound * size))
        fail_msg("residual %g of terms of size %g, bound %g", residual, size, bound);
}

/* Terms of each first integral are of the order of b^2; b is below 10 here. */
static void check_step(const struct kd_rays_step *s, double bound)
{
    double b2 = 100;
    below(s->res_w, 1 + b2 * s->w * s->w, bound);
    below(s->res_u, b2, bound);
    below(s->res_n, 1, bound);
    below(s->res_dn, b2, bound);
    below(s->res_l, sqrt(b2), bound);
    assert_true(!isnan(s->res_w) && !isnan(s->res_u) != !isnan(s->res_n) && !isnan(s->res_n) == !isnan(s->res_l));
}

/* Every crossing is recorded, half a period (params.steps steps) after the previous one. It has the same r, phi and
 * delay as in the answer without steps. */
static void check_crossings(const struct kd_rays_steps *steps)
{
    unsigned found = 0, taken = 0;
    for (size_t i = 0; i < steps->n; i++) {
        const struct kd_rays_step *s = &steps->steps[i];
        taken += s->stage == KD_STAGE_STEP;
        if (s->stage != KD_STAGE_CROSSING)
            continue;
        const struct kd_ray_crossing *c = &steps->crossings[found];
        assert_int_equal(s->order, found);
        assert_int_equal(taken, steps->params.steps);
        assert_true(fabs(s->r - c->r) <= 1e-15 * c->r && s->phi == c->phi && s->delay == c->delay);
        assert_true(fabs(s->u) < 1e-6 && s->time == steps->steps[i - 1].time);
        assert_true(fabs(steps->steps[i - 1].u) < 1e-4 && steps->steps[i - 1].w == s->w);
        found++;
        taken = 0;
    }
    assert_int_equal(found, steps->end.n_crossings);
}

/* The ray starts at the observer, and ends at infinity or at the horizon. Mino time increases, except where the kernel
 * takes steps back. */
static void check_ends(const struct ray *ray, const struct kd_rays_steps *steps)
{
    const struct kd_rays_step *first = &steps->steps[0], *last = &steps->steps[steps->n - 1];
    assert_true(fabs(first->u - cos(ray->inclination * (M_PI / 180))) < 1e-7);
    assert_true(fabs(first->w - 1 / ray->r) < 1e-7);
    assert_int_equal(last->stage, KD_STAGE_END);
    double horizon = 1 + sqrt(1 - ray->spin * ray->spin);
    assert_true(steps->end.fate == KD_RAY_ESCAPED ? fabs(last->w) < 1e-3 : last->w * horizon > 1 - 1e-6);
    for (size_t i = 1; i < steps->n; i++) {
        const struct kd_rays_step *a = &steps->steps[i - 1], *b = &steps->steps[i];
        assert_true(b->time >= a->time || (a->stage == KD_STAGE_STEP && b->stage == KD_STAGE_END));
    }
}

static void check_engine(enum kd_engine engine, enum kd_precision precision, double bound)
{
    for (int i = 0; i < RAYS; i++) {
        struct kd_rays_steps steps = steps_of(&rays[i], engine, precision);
        for (size_t k = 0; k < steps.n; k++)
            if (steps.steps[k].r > 0.99 * (1 + sqrt(1 - rays[i].spin * rays[i].spin)) ||
                steps.steps[k].stage == KD_STAGE_CROSSING)
                check_step(&steps.steps[k], bound);
        check_crossings(&steps);
        check_ends(&rays[i], &steps);
        kd_rays_steps_finish(&steps);
    }
}

static bool wide(void)
{
    struct kd_capacity capacity;
    kd_renderer_capacity(renderer, &capacity);
    return capacity.float64;
}

/* The bounds allow for the rounding of some hundred steps, and for the error of the usual number of steps. */
static void test_mino(void **state)
{
    (void)state;
    check_engine(KD_ENGINE_MINO_RKN6, KD_PRECISION_F32, 1e-5);
    check_engine(KD_ENGINE_MINO_RKN4, KD_PRECISION_F32, 1e-4);
    if (wide()) {
        check_engine(KD_ENGINE_MINO_RKN6, KD_PRECISION_F64, 1e-10);
        check_engine(KD_ENGINE_MINO_RKN4, KD_PRECISION_F64, 1e-8);
    }
}

/* The steps lie on the ray: a trace with twice as many steps has the same points, up to the error of the coarser trace.
 * */
static void test_refined(void **state)
{
    (void)state;
    for (int i = 0; i < 2; i++) {
        struct kd_rays_steps steps[2];
        for (int k = 0; k < 2; k++) {
            const struct kd_rays_params params = {
                .spin = rays[i].spin,
                .r = INFINITY,
                .inclination_deg = rays[i].inclination,
                .orders = 1,
                .engine = KD_ENGINE_MINO_RKN6,
                .precision = KD_PRECISION_F32,
                .steps = 16u << k,
            };
            OK(kd_rays_steps(renderer, &params,
                             &(struct kd_ray_labels) { (double[]) { rays[i].alpha, rays[i].beta }, NULL, 1 }, &steps[k],
                             &error));
        }
        for (size_t k = 1; k <= 16; k++) {
            assert_true(fabs(steps[0].steps[k].time - steps[1].steps[2 * k].time) < 1e-5);
            assert_true(fabs(steps[0].steps[k].w - steps[1].steps[2 * k].w) < 1e-5);
            assert_true(fabs(steps[0].steps[k].u - steps[1].steps[2 * k].u) < 1e-5);
        }
        kd_rays_steps_finish(&steps[0]);
        kd_rays_steps_finish(&steps[1]);
    }
}

/* w' is the rate of w in the recorded time. It is integrated by the trapezoidal rule from the previous step, or from
 * the crossing if the kernel took steps back. */
static void test_time(void **state)
{
    (void)state;
    for (int i = 0; i < RAYS; i++) {
        const struct kd_rays_params params = {
            .spin = rays[i].spin,
            .r = rays[i].r,
            .inclination_deg = rays[i].inclination,
            .orders = ORDERS,
            .engine = KD_ENGINE_MINO_RKN6,
            .precision = KD_PRECISION_F32,
            .steps = 64,
        };
        struct kd_rays_steps steps;
        OK(kd_rays_steps(renderer, &params,
                         &(struct kd_ray_labels) { (double[]) { rays[i].alpha, rays[i].beta }, NULL, 1 }, &steps,
                         &error));
        const struct kd_rays_step *kept = &steps.steps[0];
        for (size_t k = 1; k < steps.n; k++) {
            const struct kd_rays_step *b = &steps.steps[k], *a = b - 1;
            if (b->stage == KD_STAGE_END && a->stage == KD_STAGE_STEP)
                a = kept;
            double dt = b->time - a->time, rate = fmax(fabs(a->dw), fabs(b->dw));
            assert_true(dt >= 0 && fabs(b->w - a->w - 0.5 * dt * (a->dw + b->dw)) <= 0.02 * dt * rate + 1e-6);
            kept = b->stage == KD_STAGE_CROSSING ? b : kept;
        }
        kd_rays_steps_finish(&steps);
    }
}

static void test_kerr_schild(void **state)
{
    (void)state;
    for (int i = 0; i < 3; i++) {
        struct kd_rays_steps steps = steps_of(&rays[i], KD_ENGINE_KS_RK4, wide() ? KD_PRECISION_F64 : KD_PRECISION_F32);
        double bound = wide() ? 1e-5 : 1e-3;
        for (size_t k = 0; k < steps.n; k++) {
            const struct kd_rays_step *s = &steps.steps[k];
            assert_true(isnan(s->res_w) && isfinite(s->x) && s->stage != KD_STAGE_CROSSING);
            /* skipped, because steps further in have larger errors */
            if (s->r > 1.8 * (1 + sqrt(1 - rays[i].spin * rays[i].spin))) {
                assert_true(fabs(s->res_null) < bound && fabs(s->res_l) < 10 * bound);
                assert_true(fabs(s->u * s->r - s->z) < 1e-9 * s->r);
            }
        }
        kd_rays_steps_finish(&steps);
    }
}

static void test_refused(void **state)
{
    (void)state;
    struct kd_rays_params params = { .spin = 0.5,
                                     .r = INFINITY,
                                     .inclination_deg = 60,
                                     .orders = 1,
                                     .engine = KD_ENGINE_CLOSED,
                                     .precision = KD_PRECISION_F64 };
    struct kd_rays_steps steps;
    FAILS(KD_EINVAL, "no steps",
          kd_rays_steps(renderer, &params, &(struct kd_ray_labels) { (double[]) { 1, 2 }, NULL, 1 }, &steps, &error));
    kd_rays_steps_finish(&steps);
    params.engine = KD_ENGINE_MINO_RKN6;
    params.spin = 1;
    FAILS(KD_EINVAL, "spin",
          kd_rays_steps(renderer, &params, &(struct kd_ray_labels) { (double[]) { 1, 2 }, NULL, 1 }, &steps, &error));
    kd_rays_steps_finish(&steps);
}

int main(void)
{
    int status = open_renderer();
    if (status)
        return status;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_mino),        cmocka_unit_test(test_refined), cmocka_unit_test(test_time),
        cmocka_unit_test(test_kerr_schild), cmocka_unit_test(test_refused),
    };
    return close_renderer(cmocka_run_group_tests(tests, NULL, NULL));
}
