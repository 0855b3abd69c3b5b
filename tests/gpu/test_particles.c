/* Tests of particles as the device computes them, compared with the closed form in double precision and with tracks:
 * phases after long times, periods, and the seed. Also tests frames that show them. */
#include "render/emit/particles.h"

#include "physics/orbit/orbit_bound.h"
#include "physics/spacetime/hole.h"
#include "render_support.h"
#include "render/device/prepare.h"
#include "render/emit/deposit.h"

#include <math.h>

static struct kd_scene particle_scene(double spin, double epicycles)
{
    struct kd_scene scene;
    kd_scene_smooth(&scene);
    scene.image.width = 160;
    scene.image.height = 90;
    scene.spacetime.spin = spin;
    scene.disk.model = KD_DISK_PARTICLES;
    scene.disk.particles = 20000;
    scene.disk.plunging = 0; /* see test_plunging.c */
    scene.disk.epicycles = epicycles;
    return scene;
}

#define N 97 /* indices of some particles, at radii over the whole disk */

static void places_at(struct kd_scene *scene, double time, struct kd_particle_place *out)
{
    struct kd_emitter_buffers_work work;
    scene->top.time = time;
    OK(kd_prepare_asked(renderer, KD_EMITTER_particles, &work, &error));
    OK(kd_particles_places(&work, scene, 5, 20000 / N, N, out, &error));
}

/* Guiding radius of the i-th particle. */
static double radius(const struct kd_scene *scene, int i)
{
    struct kd_particle_grid grid = kd_particle_grid(scene);
    uint32_t guide = kd_particle_guide(&grid, 5 + (uint32_t)i * (20000 / N));
    return kd_particle_radius(scene, (guide + 0.5) / grid.radii);
}

static double angle(uint32_t turns) { return turns * (2 * M_PI / 4294967296.0); }

/* Without epicycles a particle is at phi0 + t/(r^(3/2) + a), computed here with 64 bits of mantissa; The radii r divide
 * the disk into equal shares. The reported r has an error of 1e-7 (single precision), which would cause 1e-4 rad after
 * 1e4 M. The test therefore computes r in double precision from the share, and checks the reported r against it. */
static void test_phase(void **state)
{
    (void)state;
    static const double spins[] = { -0.9, 0, 0.5, 0.998 }, times[] = { 1, 1e4, -1e4, 123456.789, 1e9 };
    struct kd_particle_place start[N], then[N];
    double worst = 0;
    for (size_t s = 0; s < sizeof spins / sizeof *spins; s++) {
        struct kd_scene scene = particle_scene(spins[s], 0);
        places_at(&scene, 0, start);
        for (size_t k = 0; k < sizeof times / sizeof *times; k++) {
            places_at(&scene, times[k], then);
            for (int i = 0; i < N; i++) {
                double r = radius(&scene, i);
                assert_true(fabs(then[i].r / r - 1) < 1e-6 && then[i].latitude == 0);
                long double x = sqrtl(r), phase = times[k] / (x * x * x + spins[s]);
                double off =
                    remainder((double)remainderl(phase, 2 * M_PIl) - angle(then[i].phi - start[i].phi), 2 * M_PI);
                /* a double resolves a large phase to 1e-16 of its size */
                double bound = 1e-8 + 4e-16 * (double)fabsl(phase);
                if (!(fabs(off) < bound))
                    fail_msg("a = %g, r = %g, t = %g: phase off by %.2g", spins[s], r, times[k], off);
                worst = fabs(times[k]) <= 1e4 ? fmax(worst, fabs(off)) : worst;
            }
        }
    }
    printf("orbital phase after 1e4 M: within %.2g rad\n", worst);
}

/* Mean time between upward zero crossings. samples: values, `step` apart in time. */
struct period {
    double first, last, before;
    int zeros;
};
static void sample(struct period *p, int i, double step, double value)
{
    if (i && p->before < 0 && value >= 0) {
        double at = (i - value / (value - p->before)) * step;
        if (!p->zeros++)
            p->first = at;
        p->last = at;
    }
    p->before = value;
}
static double period(const struct period *p) { return (p->last - p->first) / (p->zeros - 1); }

/* Frequencies of small oscillations by another method: those of a bound geodesic close to a circle
 * (src/physics/orbit/orbit_bound.h, which shares nothing with epicyclic.c). */
static struct kd_orbit_frequencies frequencies(const struct kd_hole *hole, double r)
{
    struct kd_orbit orbit;
    OK(kd_orbit_from_shape(hole, r, 1e-6, cos(1e-6), &orbit, &error));
    struct kd_orbit_state start = kd_orbit_start(&orbit, NAN, true);
    struct kd_orbit_bound bound = kd_orbit_bound_of(&orbit, &start);
    return kd_orbit_frequencies_of(&bound);
}

/* Tracks of some particles: periods of r and latitude. */
static void test_periods(void **state)
{
    (void)state;
    enum { SAMPLES = 2500 };
    static const double holes[][2] = { { 0, 0 }, { 0.5, 0 }, { 0.9, 0 }, { 0.998, 0 }, { -0.4, 0.9 } };
    struct kd_particle_place at[N];
    static struct period radial[N], vertical[N];
    double worst[2] = { 0 };
    int judged = 0;
    for (size_t s = 0; s < sizeof holes / sizeof *holes; s++) {
        const struct kd_hole hole = kd_hole_charged(holes[s][0], holes[s][1]);
        struct kd_scene scene = particle_scene(hole.a, 0.02);
        scene.spacetime.charge = hole.q;
        scene.disk.outer = 30;
        memset(radial, 0, sizeof radial);
        memset(vertical, 0, sizeof vertical);
        double step = 5.37, r[N];
        for (int i = 0; i < N; i++)
            r[i] = radius(&scene, i);
        for (int k = 0; k < SAMPLES; k++) {
            places_at(&scene, 1000 + k * step, at);
            for (int i = 0; i < N; i++) {
                sample(&radial[i], k, step, log(at[i].r / r[i]));
                sample(&vertical[i], k, step, at[i].latitude);
            }
        }
        for (int i = 0; i < N; i++) {
            struct kd_orbit_frequencies f = frequencies(&hole, r[i]);
            /* skipped next to the ISCO, where the oscillation is too slow and too small to be resolved in r, a float */
            if (f.r < 0.1 * f.phi)
                continue;
            judged++;
            double off_r = period(&radial[i]) * f.r / (2 * M_PI) - 1,
                   off_t = period(&vertical[i]) * f.theta / (2 * M_PI) - 1;
            if (!(radial[i].zeros > 8 && fabs(off_r) < 1e-4 && fabs(off_t) < 1e-4))
                fail_msg("a = %g, q = %g, r = %g: periods off by %.2g (r), %.2g (theta)", hole.a, hole.q, r[i], off_r,
                         off_t);
            worst[0] = fmax(worst[0], fabs(off_r));
            worst[1] = fmax(worst[1], fabs(off_t));
        }
    }
    printf("epicyclic periods from %d tracks: within %.2g (r), %.2g (theta)\n", judged, worst[0], worst[1]);
    assert_true(judged > 4 * N);
}

static double difference(const struct kd_frame *a, const struct kd_frame *b)
{
    double sum = 0;
    size_t n = (size_t)a->width * a->height * 3;
    for (size_t i = 0; i < n; i++)
        sum += fabs((double)((uint8_t *)kd_frame_pixels(a))[i] - ((uint8_t *)kd_frame_pixels(b))[i]);
    return sum / (double)n;
}

/* A change of time, seed, number or azimuth keeps the lens map. A scene always gives the same picture, whatever was
 * rendered before it. */
static void test_frames(void **state)
{
    (void)state;
    struct kd_scene scene = particle_scene(0.7, 0.05);
    scene.camera.inclination_deg = 57.25;
    scene.style.exposure = 0;
    scene.top.time = 1e6;
    struct kd_frame first = rendered(&scene);
    assert_true(!first.lens_reused && ran(&first, "trace") && ran(&first, "particles"));
    struct kd_scene others[5] = { scene, scene, scene, scene, scene };
    others[0].top.time = -300;
    others[1].disk.seed++;
    others[2].disk.particles = 30000;
    others[3].camera.azimuth_deg = 90;
    others[4].disk.epicycles = 0;
    for (int i = 0; i < 5; i++) {
        struct kd_frame other = rendered(&others[i]);
        assert_true(other.lens_reused && !ran(&other, "trace") && ran(&other, "particles"));
        assert_true(difference(&first, &other) > 1);
        kd_frame_finish(&other);
    }
    struct kd_frame again = rendered(&scene);
    assert_true(again.lens_reused);
    assert_memory_equal(kd_frame_pixels(&first), kd_frame_pixels(&again), 3 * 160 * 90);
    kd_frame_finish(&first);
    kd_frame_finish(&again);
}

/* A near observer's slow light uses particles at another time than a list of the same scene. The picture does not use
 * the particles of the list, nor the list those of the picture. */
static void test_lists_between_frames(void **state)
{
    (void)state;
    struct kd_particle_place before[N], after[N];
    struct kd_scene scene = particle_scene(0.7, 0.05);
    scene.disk.slow_light = true;
    scene.camera.r = 40;
    places_at(&scene, 500, before);
    scene.top.time = 0;
    struct kd_frame other = rendered(&scene);
    scene.top.time = 500;
    struct kd_frame first = rendered(&scene);
    places_at(&scene, 500, after);
    struct kd_frame again = rendered(&scene);
    for (int i = 0; i < N; i++)
        assert_true(before[i].r == after[i].r && before[i].phi == after[i].phi &&
                    before[i].latitude == after[i].latitude && before[i].plunging == after[i].plunging);
    assert_true(again.lens_reused && difference(&first, &other) > 1 && difference(&first, &again) == 0);
    kd_frame_finish(&other);
    kd_frame_finish(&first);
    kd_frame_finish(&again);
}

/* A narrow ring does not move for an observer that co-rotates with it. It moves for an observer that rotates the other
 * way. */
static void test_turning(void **state)
{
    (void)state;
    struct kd_scene scene = particle_scene(0.5, 0);
    scene.image.height = 160;
    scene.camera.inclination_deg = 20;
    scene.camera.field_m = 30;
    scene.disk.inner = 10;
    scene.disk.outer = 10.4;
    scene.disk.taper = 0;
    scene.disk.particles = 1000; /* the grid is coarse, so that the shear from edge to edge is half a cell */
    scene.disk.doppler = false;
    scene.style.exposure = 0;
    struct kd_frame start = rendered(&scene);
    double rate = 180 / M_PI / (pow(10.2, 1.5) + 0.5);
    scene.top.time = 8;
    struct kd_frame later = rendered(&scene);
    scene.camera.azimuth_deg = 8 * rate;
    struct kd_frame along = rendered(&scene);
    scene.camera.azimuth_deg = -8 * rate;
    struct kd_frame against = rendered(&scene);
    double stood = difference(&start, &along);
    printf("%g %g %g\n", stood, difference(&start, &later), difference(&start, &against));
    assert_true(difference(&start, &later) > 4 * stood && difference(&start, &against) > 4 * stood);
    kd_frame_finish(&start);
    kd_frame_finish(&later);
    kd_frame_finish(&along);
    kd_frame_finish(&against);
}

/* Particles oscillate across the edges of the disk; the picture shows those that are between the edges. From above,
 * without spin, the direct image of a circle of r has b^2 = r^2 + 2r to a percent (A. M. Beloborodov 2002, at 90
 * degrees). */
static void test_edges(void **state)
{
    (void)state;
    struct kd_scene scene = particle_scene(0, 0);
    scene.image.height = scene.image.width;
    scene.camera.inclination_deg = 0;
    scene.camera.field_m = 50;
    scene.disk.inner = 12;
    scene.disk.outer = 18;
    scene.disk.taper = 0;
    scene.disk.epicycles = 0.2;
    scene.accuracy.orders = 1;
    scene.style.exposure = 0;
    struct kd_frame frame = rendered(&scene);
    const double pixel = scene.camera.field_m / scene.image.width, middle = scene.image.width / 2.0;
    unsigned lit = 0, outside = 0, within = 0;
    for (int y = 0; y < scene.image.height; y++)
        for (int x = 0; x < scene.image.width; x++) {
            const double b = pixel * hypot(x + 0.5 - middle, y + 0.5 - middle);
            const uint8_t *rgb = (uint8_t *)kd_frame_pixels(&frame) + 3 * (y * scene.image.width + x);
            const bool light = rgb[0] + rgb[1] + rgb[2] > 12; /* tolerance: dither changes the sum by at most 12 */
            lit += light && b > 14 && b < 18;
            outside += light && b > sqrt(18 * 18 + 2 * 18) + 1;
            within += light && b < sqrt(12 * 12 + 2 * 12) - 1;
        }
    printf("%u pixels are lit between the edges, %u beyond, %u inside\n", lit, outside, within);
    assert_true(lit > 1000 && outside == 0 && within == 0);
    kd_frame_finish(&frame);
}

/* Light with delay D shows the disk at t - D. A pixel of a picture with slow light therefore equals the pixel of a
 * picture without slow light at t - D, where D is the delay of its ray. Tested for an observer at infinity, a near
 * observer, and a charged hole. The pixels agree only approximately, because a grid that is rotated by a fraction of a
 * cell is blurred differently. For the charged hole, the angular velocity of an uncharged hole would cause an error of
 * several cells. */
static void test_slow_light(void **state)
{
    (void)state;
    enum { PIXELS = 60 };
    static const struct {
        const char *what;
        double spin, charge, camera_r, far;
        int particles;
    } views[] = {
        { "far", 0.6, 0, INFINITY, 18, 4000 },
        { "near", 0.6, 0, 40, 18, 4000 },
        { "charged", 0.1, 0.99, INFINITY, 8, 1000000 },
    };
    for (size_t v = 0; v < sizeof views / sizeof *views; v++) {
        struct kd_scene scene = particle_scene(views[v].spin, 0);
        scene.spacetime.charge = views[v].charge;
        scene.disk.particles = views[v].particles;
        scene.disk.doppler = scene.disk.redshift = false;
        scene.style.tone_map = KD_TONE_SRGB;
        scene.style.exposure = -1;
        scene.style.dither = false;
        scene.top.time = 700;
        scene.camera.inclination_deg = 70;
        scene.camera.r = views[v].camera_r;
        struct kd_frame fast = rendered(&scene);
        scene.disk.slow_light = true;
        struct kd_frame slow = rendered(&scene), again = rendered(&scene);
        assert_true(!slow.lens_reused && again.lens_reused);
        kd_frame_finish(&again);
        struct kd_capacity c;
        struct kd_plan plan;
        kd_renderer_capacity(renderer, &c);
        OK(kd_plan_make(&scene, &c, &plan, &error));
        float *planes = malloc(4 * plan.lens.planes * plan.lens.rays);
        OK(kd_render_lens(renderer, &scene, &plan, planes, NULL, &error));
        scene.disk.slow_light = false;
        double off_then = 0, off_now = 0;
        int n = 0;
        for (uint32_t at = 1000; at < 160 * 90 && n < PIXELS; at += 31) {
            float w = planes[at];
            if (!(w > 1 / views[v].far && w < 1 / 5.0))
                continue;
            scene.top.time = 700 - planes[2 * plan.lens.orders * plan.lens.rays + at];
            struct kd_frame then = rendered(&scene);
            const uint8_t *a = kd_frame_pixels(&slow), *b = kd_frame_pixels(&then), *now = kd_frame_pixels(&fast);
            off_then += abs(a[3 * at + 1] - b[3 * at + 1]);
            off_now += abs(a[3 * at + 1] - now[3 * at + 1]);
            n++;
            kd_frame_finish(&then);
        }
        printf("slow light, %s: %g of 255 from the time of emission, %g from now, %d pixels\n", views[v].what,
               off_then / n, off_now / n, n);
        assert_true(n > 15 && off_now > 2 * off_then);
        free(planes);
        kd_frame_finish(&fast);
        kd_frame_finish(&slow);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_phase),     cmocka_unit_test(test_periods),
                                        cmocka_unit_test(test_frames),    cmocka_unit_test(test_lists_between_frames),
                                        cmocka_unit_test(test_edges),     cmocka_unit_test(test_turning),
                                        cmocka_unit_test(test_slow_light) };
    int code = open_renderer();
    return code ? code : close_renderer(cmocka_run_group_tests(tests, NULL, NULL));
}
