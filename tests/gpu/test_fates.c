/* Tests of fates and orders of all rays of small pictures from random cameras, of every observer, spin, radius and
 * projection. They are compared with the closed form in double precision. The captured fraction of the sky is compared
 * with the area inside the critical curve.
 *
 *   test_fates [CAMERAS [SEED [FIRST]]]     e.g. nice build/tests/gpu/test_fates 2000 7
 *
 * Without arguments the run is short. A failure prints a camera's number; use it as FIRST of a run of one camera. A ray
 * is not judged if two methods in double precision disagree on it, or if its crossings come and go when its labels move
 * by 1e-11. */
#include "random_camera.h"
#include "render_support.h"

#include "physics/null/critical.h"
#include "physics/spacetime/kerr.h"
#include "render/rays/closed.h"
#include "render/view/camera.h"
#include "scene/hole.h"

#include "interface.h"

enum { SIDE = 24, RAYS = SIDE * SIDE, MOST_ORDERS = 3 };

static unsigned cameras = 40, first;
static uint64_t seed = 36;

/* Expected fates and image orders of a picture; -1: undetermined. */
struct truth {
    double alpha_beta[2 * RAYS];
    bool outward[RAYS];
    int fate[RAYS], orders[RAYS];
};

/* Fate for an observer within the horizon. The photon came from infinity if R(w) = E^2 + A w^2 + 2 K w^3 - D w^4 has no
 * zero between the observer and infinity, and if E + a (aE - L) w^2 is positive at the horizon
 * (docs/physics/observers.md). */
static int fate_within(const struct kd_camera_exact *c, const struct kd_camera_label *label)
{
    enum { PLACES = 4000 };
    const double a = c->spin, e = label->energy < 0 ? -1 : 1, l = -e * label->alpha, p = label->beta, ae = a * e,
                 u2 = c->u * c->u;
    const double q = p * p + u2 * (l * l - ae * ae), momentum = l * c->s, k = q + (momentum - ae) * (momentum - ae),
                 d = a * a * q, a2 = ae * ae - momentum * momentum - q;
    const double at = e + a * (ae - momentum) * c->horizon * c->horizon,
                 size = 1 + fabs(a * (ae - momentum)) * c->horizon * c->horizon;
    if (fabs(at) < 1e-9 * size)
        return -1;
    double least = INFINITY;
    for (int i = 0; i <= PLACES && at > 0; i++) {
        const double w = c->w0 * i / PLACES;
        least = fmin(least, (1 + w * w * (a2 + w * (2 * k - d * w))) / (1 + fabs(a2) * w * w));
    }
    return at < 0 ? KD_RAY_CAPTURED : least > 1e-3 ? KD_RAY_ESCAPED : least < -1e-3 ? KD_RAY_CAPTURED : -1;
}

static void truth_of(const struct kd_scene *scene, struct truth *out)
{
    const struct kd_camera_exact c = kd_camera_exact(scene);
    const bool within = scene->camera.r <= kd_scene_hole(scene)->outer;
    const uint32_t orders = (uint32_t)scene->accuracy.orders;
    static struct kd_ray_crossing crossings[RAYS * MOST_ORDERS];
    static struct kd_ray_end ends[RAYS];
    struct kd_camera_label label;
    for (uint32_t i = 0; i < RAYS; i++) {
        kd_camera_label(&c, i % SIDE, i / SIDE, &label);
        out->alpha_beta[2 * i] = label.alpha;
        out->alpha_beta[2 * i + 1] = label.beta;
        out->outward[i] = label.outward;
        out->fate[i] = within ? fate_within(&c, &label) : -1;
        out->orders[i] = -1;
    }
    if (within)
        return;
    const struct kd_rays_params params = {
        .spin = scene->spacetime.spin,
        .r = scene->camera.r,
        .inclination_deg = scene->camera.inclination_deg,
        .orders = orders,
        .engine = KD_ENGINE_CLOSED,
        .precision = KD_PRECISION_F64,
    };
    const struct kd_ray_labels rays = { out->alpha_beta, out->outward, RAYS };
    OK(kd_rays_closed(&params, &rays, KD_CLOSED_ERRORS, crossings, ends, NULL, NULL, &error));
    for (uint32_t i = 0; i < RAYS; i++) {
        const bool told = ends[i].fate != KD_RAY_UNDECIDED && !(ends[i].error >= 1);
        out->fate[i] = told ? (int)ends[i].fate : -1;
        out->orders[i] = told ? (int)ends[i].n_crossings : -1;
    }
}

struct tally { uint64_t rays, judged, untold, other_fate, other_order, shares, other_share, most_untold; };

static void tell(const struct kd_scene *s, unsigned number, const char *what, uint64_t n)
{
    const struct kd_camera *c = &s->camera;
    print_message("camera %u: %llu of %d %s: a = 1%+.6g%s, %s, r = %.9g, i = %.6g, v = %.9g %.9g %.9g, projection %d, "
                  "fov %.4g, yaw %.4g, pitch %.4g, roll %.4g\n",
                  number, (unsigned long long)n, RAYS, what, fabs(s->spacetime.spin) - 1,
                  s->spacetime.spin < 0 ? " (-)" : "", isinf(c->r) ? "plane" : kd_observers[c->observer].word, c->r,
                  c->inclination_deg, c->velocity_r, c->velocity_theta, c->velocity_phi, (int)c->projection, c->fov_deg,
                  c->yaw_deg, c->pitch_deg, c->roll_deg);
}

/* The captured part of the sky of an equirectangular picture is the area inside the critical curve. The tolerance is
 * two pixels times the curve's length, plus the undecided pixels. An observer at 0.999999 c next to a horizon has many
 * undecided pixels, because labels divided by E cannot represent their rays, even in double precision. */
static void judge_share(const struct kd_scene *scene, unsigned number, const float *fate, struct tally *t)
{
    const struct kd_camera *c = &scene->camera;
    const struct kd_vantage at = kd_scene_vantage(scene);
    const struct kd_critical_observer observer = { at.hole, at.r, at.u, at.s, kd_scene_observer(scene) };
    if (isinf(c->r) || c->projection != KD_PROJECTION_EQUIRECTANGULAR)
        return;
    const struct kd_critical curve = kd_critical_of(&observer);
    const struct kd_critical_measures m = kd_critical_measure(&curve);
    if (curve.status || !(m.area > 0))
        return;
    const double pixel = 2 * M_PI / SIDE;
    double captured = 0, undecided = 0;
    for (int i = 0; i < RAYS; i++) { /* the picture's height corresponds to half a turn */
        const double up = M_PI / SIDE * (i / SIDE + 0.5) - M_PI / 2;
        const double size = pixel * 2 * sin(M_PI / (2 * SIDE)) * cos(up);
        captured += fate[i] == KD_FATE_CAPTURED ? size : 0;
        undecided += fate[i] == KD_FATE_UNDECIDED ? size : 0;
    }
    /* the curve's length is at most the circumference of the circle with that area, plus a term for the asymmetry */
    const double length = 2 * M_PI * fmin(1, sin(fmin(m.mean_radius, M_PI / 2))) + 4 * m.asymmetry;
    t->shares++;
    if (fabs(captured - m.area) > 2 * pixel * length + pixel * pixel + undecided) {
        tell(scene, number, "as share of the sky", 0);
        print_message("captured: %.6g of the sky, inside the critical curve %.6g, of length %.4g\n", captured, m.area,
                      length);
        t->other_share++;
    }
}

static void judge(const struct kd_scene *scene, unsigned number, struct tally *t)
{
    static struct truth truth;
    static float planes[RAYS * (MOST_ORDERS + 3)];
    struct kd_capacity capacity;
    struct kd_plan plan;
    uint64_t fates = 0, orders = 0, untold = 0, judged = 0;
    kd_renderer_capacity(renderer, &capacity);
    OK(kd_scene_validate(scene, &error));
    OK(kd_plan_make_for(scene, &(struct kd_needs) { .quantities = KD_LENS_W | KD_LENS_SKY }, &capacity, &plan, &error));
    assert_int_equal(plan.lens.planes, plan.lens.orders + 3);
    OK(kd_render_lens(renderer, scene, &plan, planes, NULL, &error));
    truth_of(scene, &truth);
    const float *fate = planes + RAYS * kd_lens_plane(plan.lens.quantities, plan.lens.orders, KD_LENS_FATE);
    for (int i = 0; i < RAYS; i++) {
        int n = 0;
        bool open = fate[i] == KD_FATE_UNDECIDED;
        while (n < (int)plan.lens.orders && planes[n * RAYS + i] > 0)
            n++;
        open |= n < (int)plan.lens.orders && planes[n * RAYS + i] != 0;
        judged += truth.fate[i] >= 0;
        untold += open && truth.fate[i] >= 0;
        fates += !open && truth.fate[i] >= 0 && (fate[i] == KD_FATE_ESCAPED) != (truth.fate[i] == KD_RAY_ESCAPED);
        orders += !open && truth.orders[i] >= 0 && n != truth.orders[i];
    }
    if (fates)
        tell(scene, number, "of another fate", fates);
    if (orders)
        tell(scene, number, "of another order", orders);
    if (untold > RAYS / 1000)
        tell(scene, number, "untold", untold);
    t->rays += RAYS, t->judged += judged, t->untold += untold, t->other_fate += fates, t->other_order += orders;
    t->most_untold = untold > t->most_untold ? untold : t->most_untold;
    judge_share(scene, number, fate, t);
}

/* Pictures that earlier versions rendered wrongly. */
static const struct once {
    double spin, inclination, r;
    enum kd_observer observer;
    double velocity_phi, fov, yaw, pitch;
} once[] = {
    { 0.9, 60, 3, KD_OBSERVER_INFALL, 0, 120, 0, 0 },
    { 0.9, 60, 4, KD_OBSERVER_INFALL, 0, 120, 0, 0 },
    { 0.998, 75, 4, KD_OBSERVER_INFALL, 0, 120, 0, 0 },
    { -0.95, 60, 3, KD_OBSERVER_INFALL, 0, 120, 0, 0 },
    { 0.5, 90, 1e7, KD_OBSERVER_VELOCITY, 0.999999, 90, 180, -90 },
    { 0.7, 17, 5, KD_OBSERVER_STATIC, 0, 0.001, 90, 30 },
};

typedef void make_camera(struct kd_random *, int, struct kd_scene *);

/* Cameras of long runs whose pictures earlier versions rendered wrongly. */
static const struct once_random {
    make_camera *make;
    uint64_t seed;
    unsigned number;
} once_random[] = {
    /* near an extremal hole, steps missed the second crossing of a ray that circles the hole */
    { random_camera, 7, 998 },
    /* a step moved a crossing from r = 1.016 M to the inside of the horizon */
    { random_camera_near_horizon, 91, 4891 },
};

static void judge_one(make_camera *make, uint64_t from, unsigned number, struct tally *t)
{
    struct kd_random random = { from + number * UINT64_C(0x100000001) };
    struct kd_scene scene;
    make(&random, SIDE, &scene);
    judge(&scene, number, t);
}

static void tell_tally(const struct tally *t, unsigned n)
{
    print_message("%u cameras, %llu rays, %llu judged: %llu of another fate, %llu of another order, %llu untold, at "
                  "most %llu of a picture; %llu shares of the sky\n",
                  n, (unsigned long long)t->rays, (unsigned long long)t->judged, (unsigned long long)t->other_fate,
                  (unsigned long long)t->other_order, (unsigned long long)t->untold, (unsigned long long)t->most_untold,
                  (unsigned long long)t->shares);
    assert_int_equal(t->other_fate, 0);
    assert_int_equal(t->other_order, 0);
    assert_int_equal(t->other_share, 0);
    assert_true(t->most_untold <= RAYS / 1000);
    assert_true(t->judged > 0.9 * (double)t->rays);
}

static void pictures_that_were_wrong_once(void **state)
{
    (void)state;
    struct tally t = { 0 };
    for (unsigned i = 0; i < sizeof once / sizeof *once; i++) {
        struct kd_scene scene;
        kd_scene_smooth(&scene);
        scene.spacetime.spin = once[i].spin;
        scene.image.width = scene.image.height = SIDE;
        scene.image.critical_factor = 1;
        scene.camera.inclination_deg = once[i].inclination;
        scene.camera.r = once[i].r;
        scene.camera.observer = once[i].observer;
        scene.camera.velocity_phi = once[i].velocity_phi;
        scene.camera.fov_deg = once[i].fov;
        scene.camera.yaw_deg = once[i].yaw;
        scene.camera.pitch_deg = once[i].pitch;
        scene.sky.model = KD_SKY_GRID;
        judge(&scene, i, &t);
    }
    for (unsigned i = 0; i < sizeof once_random / sizeof *once_random; i++)
        judge_one(once_random[i].make, once_random[i].seed, once_random[i].number, &t);
    tell_tally(&t, sizeof once / sizeof *once + sizeof once_random / sizeof *once_random);
}

static void judge_random(make_camera *make)
{
    struct tally t = { 0 };
    for (unsigned i = first; i < first + cameras; i++)
        judge_one(make, seed, i, &t);
    tell_tally(&t, cameras);
}

static void fates_are_those_of_double_precision(void **state)
{
    (void)state;
    judge_random(random_camera);
}

static void fates_near_the_horizon(void **state)
{
    (void)state;
    judge_random(random_camera_near_horizon);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pictures_that_were_wrong_once),
        cmocka_unit_test(fates_are_those_of_double_precision),
        cmocka_unit_test(fates_near_the_horizon),
    };
    cameras = argc > 1 ? (unsigned)strtoul(argv[1], NULL, 10) : cameras;
    seed = argc > 2 ? strtoull(argv[2], NULL, 10) : seed;
    first = argc > 3 ? (unsigned)strtoul(argv[3], NULL, 10) : first;
    int status = open_renderer();
    if (status)
        return status;
    return close_renderer(cmocka_run_group_tests_name("fates", tests, NULL, NULL));
}
