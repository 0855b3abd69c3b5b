/* Tests of the images of one star, Sirius: their places and light. They are compared with the Kerr-Schild oracle and,
 * for a hole without spin, with quadrature of the lens equation. The test rotates the sky to put the star at a given
 * position. */
#include "kerr_schild.h"
#include "render/render.h"
#include "render/sky/frame.h"
#include "render/sky/star.h"
#include "render/view/rim.h"

#include "render_support.h"

#include <math.h>

#define DEGREE (M_PI / 180)
enum { WIDTH = 800, HEIGHT = 401 };
#define RADIUS 30.0
#define FIELD 80.0

struct vec3 { double x, y, z; };
static double dot(struct vec3 a, struct vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static struct vec3 cross(struct vec3 a, struct vec3 b)
{
    return (struct vec3) { a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x };
}

static struct kd_scene scene_of(double spin, double inclination)
{
    struct kd_scene scene;
    kd_scene_smooth(&scene);
    scene.spacetime.spin = spin;
    scene.camera.r = RADIUS;
    scene.camera.inclination_deg = inclination;
    scene.camera.fov_deg = FIELD;
    scene.disk.model = KD_DISK_NONE;
    scene.sky.model = KD_SKY_CATALOGUE;
    scene.sky.limit_mag = -1; /* a limit so bright that no other star is shown */
    scene.sky.brightness = 1;
    scene.sky.milky_way = 0;
    scene.style.exposure = 0;
    scene.image.width = WIDTH;
    scene.image.height = HEIGHT;
    return scene;
}

/* Rotates the sky so that the star is in a direction of the hole's frame: n = Rz(-turn) Ry(-tilt) s. */
static bool aim(struct kd_scene *scene, struct vec3 n)
{
    const struct kd_catalogue_star star = kd_catalogue_star(0);
    const struct kd_rotation galactic = kd_rotation_galactic();
    const struct kd_vec s = kd_rotate(&galactic, kd_sky_direction(star.ra, star.dec));
    double length = hypot(s.x, s.z);
    if (fabs(n.z) > length)
        return false;
    double tilt = atan2(s.x, s.z) + acos(n.z / length), x = cos(tilt) * s.x - sin(tilt) * s.z;
    double turn = atan2(s.y, x) - atan2(n.y, n.x);
    scene->sky.tilt_deg = remainder(tilt, 2 * M_PI) / DEGREE;
    scene->sky.turn_deg = remainder(turn, 2 * M_PI) / DEGREE;
    return true;
}

static struct kd_frame shot(const struct kd_scene *scene, const struct kd_capacity *capacity)
{
    struct kd_needs needs = kd_needs_of(scene);
    struct kd_plan plan;
    struct kd_frame frame;
    needs.radiance = true;
    OK(kd_scene_validate(scene, &error));
    OK(kd_plan_make_for(scene, &needs, capacity, &plan, &error));
    OK(kd_render(renderer, scene, &plan, NULL, NULL, &frame, &error));
    return frame;
}

static struct kd_frame seen(const struct kd_scene *scene)
{
    struct kd_capacity c;
    kd_renderer_capacity(renderer, &c);
    return shot(scene, &c);
}

static double luminance(const struct kd_frame *frame, int x, int y)
{
    const float *rgb = frame->layers[1].data;
    size_t i = 3 * ((size_t)y * frame->width + (size_t)x);
    if (x < 0 || y < 0 || x >= (int)frame->width || y >= (int)frame->height)
        return 0;
    return 0.2126 * rgb[i] + 0.7152 * rgb[i + 1] + 0.0722 * rgb[i + 2];
}

/* The sum and the centroid of the light about a point of the picture. */
struct blob { double light, x, y; };
static struct blob blob_at(const struct kd_frame *frame, double x, double y, int reach)
{
    struct blob b = { 0 };
    for (int py = (int)floor(y) - reach; py <= (int)floor(y) + 1 + reach; py++)
        for (int px = (int)floor(x) - reach; px <= (int)floor(x) + 1 + reach; px++) {
            double l = luminance(frame, px, py);
            b.light += l;
            b.x += l * px;
            b.y += l * py;
        }
    b.x /= b.light;
    b.y /= b.light;
    return b;
}

static double step = 2 * 0.83909963117728001177 / WIDTH; /* tan(40 degrees) */

/* Direction on the sky and g of the ray at a point of the picture, by the oracle. */
static struct vec3 from(const struct kd_scene *scene, double x, double y, double *g)
{
    double right = (x - 0.5 * (WIDTH - 1)) * step, up = (0.5 * (HEIGHT - 1) - y) * step,
           n = 1 / sqrt(1 + right * right + up * up);
    const double k[] = { -n, -n * up, n * right };
    struct ks_photon photon =
        ks_from_camera(scene->spacetime.spin, RADIUS, scene->camera.inclination_deg * DEGREE, false, k);
    const struct ks_path path = ks_trace(photon, 8);
    double s = sqrt(1 - path.u * path.u);
    *g = path.fate == KS_ESCAPED ? 1 / photon.energy : 0; /* g is 0 in the shadow */
    return (struct vec3) { s * cos(path.sky_phi), s * sin(path.sky_phi), path.u };
}

/* Solid angle on the sky that a pixel maps to, from extrapolated central differences of the oracle's rays. */
static double patch(const struct kd_scene *scene, double x, double y, double step_)
{
    double g, area[2];
    for (int k = 0; k < 2; k++) {
        double h = k ? step_ : 2 * step_;
        struct vec3 a = from(scene, x + h, y, &g), b = from(scene, x - h, y, &g), c = from(scene, x, y + h, &g),
                    d = from(scene, x, y - h, &g), n = from(scene, x, y, &g);
        struct vec3 i = { a.x - b.x, a.y - b.y, a.z - b.z }, j = { c.x - d.x, c.y - d.y, c.z - d.z };
        area[k] = fabs(dot(n, cross(i, j))) / (4 * h * h);
    }
    return (4 * area[1] - area[0]) / 3;
}

/* Compares the light and the position of the star's image near a point of the picture with the oracle's. */
static void compare(struct kd_scene *scene, double x, double y, double *worst_light, double *worst_place)
{
    double g;
    if (x < 4 || y < 4 || x > WIDTH - 5 || y > HEIGHT - 5)
        return;
    struct vec3 n = from(scene, x, y, &g);
    if (g == 0 || !aim(scene, n))
        return;
    struct kd_frame frame = seen(scene);
    const struct blob b = blob_at(&frame, x, y, 2);
    double want = kd_star_flux(kd_catalogue_star(0).magnitude) * g * g * g * g / patch(scene, x, y, 0.02),
           light = fabs(b.light / want - 1), place = hypot(b.x - x, b.y - y);
    if (light > 0.01 || place > 0.01)
        printf("spin %g: at %.2f, %.2f light %.5f of %.5g, place off by %.3f pixels\n", scene->spacetime.spin, x, y,
               b.light / want, want, place);
    *worst_light = fmax(*worst_light, light);
    *worst_place = fmax(*worst_place, place);
    kd_frame_finish(&frame);
}

/* Compares images at several points of the picture. The last ones are next to the critical curve of the primary image,
 * where the magnification diverges. */
static void by_rays(double spin, double inclination, double *worst_light, double *worst_place)
{
    struct kd_scene scene = scene_of(spin, inclination);
    for (int k = 0; k < 24; k++) {
        double angle = 2.399963 * k, rho = 0.2 + 0.018 * k;
        compare(&scene, 0.5 * (WIDTH - 1) + rho * cos(angle) / step, 0.5 * (HEIGHT - 1) - rho * sin(angle) / step,
                worst_light, worst_place);
    }
    /* At these points an image's light is shared by the picture's rays and the rim's rays, or the points are just
     * inside or outside this zone. In the second half the field of view makes the curve so large that its rim is wide.
     * */
    const double wide = step;
    for (int k = 0; k < 24; k++) {
        struct kd_rim rim;
        scene.camera.fov_deg = k < 12 ? FIELD : 26;
        step = k < 12 ? wide : 2 * tan(13 * DEGREE) / WIDTH;
        assert_true(kd_rim_of(&scene, &rim));
        const double off = rim.full + (k / 2 % 4 - 0.5) * 0.5 * (rim.none - rim.full);
        double place[2], look[3];
        kd_rim_place(&rim, KD_RIM_ANGLES * (0.5 * (k % 2) + 0.003 * k), off, place);
        kd_rim_look(&rim, place, look);
        compare(&scene, 0.5 * (WIDTH - 1) + look[2] / -look[0] / step, 0.5 * (HEIGHT - 1) + look[1] / -look[0] / step,
                worst_light, worst_place);
    }
    step = wide;
}

static void images_by_the_oracle(void **state)
{
    (void)state;
    static const struct { double spin, inclination; } holes[] = { { 0, 75 }, { 0.9, 60 }, { 0.9, 85 } };
    for (size_t i = 0; i < sizeof holes / sizeof *holes; i++) {
        double light = 0, place = 0;
        by_rays(holes[i].spin, holes[i].inclination, &light, &place);
        printf("spin %g, inclination %g: light within %.4f, places within %.3f pixels\n", holes[i].spin,
               holes[i].inclination, light, place);
        assert_true(light > 0 && light < 0.01 && place < 0.01); /* the centroid of a B-spline is exact */
    }
}

/* Azimuth swept by a ray from the observer at R in to the turning point and out to infinity, as a function of b. With w
 * = 1/r, dphi = dw / sqrt(1/b^2 - w^2 + 2 w^3). Substituting w = w_t sin^2 removes the zero of the root at the turning
 * point. The midpoint rule is used, because the integrands are smooth, and even at both ends. */
static double swept(double b)
{
    double low = 0, high = 1.0 / 3, sum = 0;
    for (int i = 0; i < 200; i++) {
        double w = 0.5 * (low + high);
        *(1 / (b * b) - w * w * (1 - 2 * w) > 0 ? &low : &high) = w;
    }
    const double turn = 0.5 * (low + high), start = asin(sqrt(1 / RADIUS / turn));
    const int n = 20000;
    for (int part = 0; part < 2; part++) {
        double begin = part ? start : 0, length = M_PI / 2 - begin;
        for (int i = 0; i < n; i++) {
            double t = begin + (i + 0.5) * length / n, s = sin(t), w = turn * s * s;
            /* Since 1/b^2 = w_t^2 - 2 w_t^3, the radicand is (w_t - w)(w_t + w - 2 (w_t^2 + w_t w + w^2)). */
            sum += length / n * 2 * sqrt(turn) * s / sqrt(turn + w - 2 * (turn * turn + turn * w + w * w));
        }
    }
    return sum;
}

/* Angle between the hole and the ray that sweeps this azimuth. */
static double looking(double azimuth)
{
    double low = asin(sqrt(27) * (1 + 1e-7) * sqrt(1 - 2 / RADIUS) / RADIUS), high = 1.2;
    for (int i = 0; i < 60; i++) {
        double theta = 0.5 * (low + high);
        *(swept(RADIUS * sin(theta) / sqrt(1 - 2 / RADIUS)) > azimuth ? &low : &high) = theta;
    }
    return 0.5 * (low + high);
}

/* Puts the star at the angle beta from the point behind the hole. turned: angle of the star's side from the picture's
 * horizontal plane. The images are on this side of the picture and on the opposite side. */
static bool behind_by(struct kd_scene *scene, double beta, double turned)
{
    *scene = scene_of(0, 90);
    return aim(scene, (struct vec3) { -cos(beta), sin(beta) * cos(turned), sin(beta) * sin(turned) });
}

static bool in_the_picture(const struct blob *b, int margin)
{
    return b->x > margin && b->y > margin && b->x < WIDTH - 1 - margin && b->y < HEIGHT - 1 - margin;
}

/* Position and light of an image, from the lens equation: on the star's side or on the opposite side. rounds:
 * additional turns of the light round the hole. */
static struct blob by_the_lens_equation(double beta, double turned, int side, int rounds)
{
    const double flux = kd_star_flux(kd_catalogue_star(0).magnitude), g = 1 / sqrt(1 - 2 / RADIUS),
                 h = rounds ? 1e-3 : 1e-4;
    const double azimuth = (2 * rounds + 1) * M_PI + (side ? beta : -beta), theta = looking(azimuth);
    const double slope = (looking(azimuth + h) - looking(azimuth - h)) / (2 * h),
                 off = (side ? -1 : 1) * tan(theta) / step;
    return (struct blob) { flux * pow(g, 4) * sin(theta) * fabs(slope) / sin(beta) / (step * step * pow(cos(theta), 3)),
                           0.5 * (WIDTH - 1) + off * cos(turned), 0.5 * (HEIGHT - 1) - off * sin(turned) };
}

/* Tests each image of a star behind the hole, and the sum of both, however close to the caustic. The star is put at all
 * angles round the hole, so that its positions relative to the grid of rays vary. */
static void behind(const double *betas, size_t n, int rounds)
{
    static const double turns[] = { 0, 0.3, 0.9, 2.1, 3.7, 5 };
    for (size_t i = 0; i < n; i++) {
        double single = 0, both = 0, place = 0;
        int images = 0;
        for (size_t t = 0; t < sizeof turns / sizeof *turns; t++) {
            struct kd_scene scene;
            if (!behind_by(&scene, betas[i], turns[t]))
                continue;
            struct kd_frame frame = seen(&scene);
            double all = 0, is = 0;
            for (int side = 0; side < 2; side++) {
                const struct blob want = by_the_lens_equation(betas[i], turns[t], side, rounds);
                if (want.light < 0.05 || !in_the_picture(&want, 5)) /* close to the threshold of display */
                    continue;
                const struct blob b = blob_at(&frame, want.x, want.y, rounds ? 2 : 3);
                single = fmax(single, fabs(b.light / want.light - 1));
                place = fmax(place, hypot(b.x - want.x, b.y - want.y));
                all += want.light;
                is += b.light;
                images++;
            }
            if (all > 0)
                both = fmax(both, fabs(is / all - 1));
            kd_frame_finish(&frame);
        }
        printf("beta %g, %d rounds more: %d images, each within %.5f of its light, both together within %.5f, places "
               "within %.4f pixels\n",
               betas[i], rounds, images, single, both, place);
        assert_true(images >= (!rounds ? 9 : betas[i] > 1 ? 3 : betas[i] == 1 ? 8 : 12));
        assert_true(single < 0.01 && both < 0.01 && place < 0.02);
    }
}

static void behind_the_hole(void **state)
{
    (void)state;
    static const double betas[] = { 0.3, 0.1, 0.03, 0.01, 3e-3, 1e-3 };
    behind(betas, sizeof betas / sizeof *betas, 0);
}

/* Images whose light goes round the hole once more, next to the curve, for stars in any direction. */
static void round_the_hole(void **state)
{
    (void)state;
    static const double betas[] = { 2, 1, 0.3, 0.1, 0.03, 0.01, 3e-3, 1e-3 };
    behind(betas, sizeof betas / sizeof *betas, 1);
}

/* A small picture of a point next to the curve. rho: the point's distance from the middle of a plane perpendicular to
 * the inward direction. angle: its direction from the right. */
enum { CLOSE_WIDTH = 160, CLOSE_HEIGHT = 91 };
#define CLOSE_FIELD 1.6
struct close { double rho, angle; };

/* The origin of the light that is seen in the direction d (right, up and inwards), by the oracle. */
static struct vec3 seen_by(const struct kd_scene *scene, struct vec3 d, double *g)
{
    const double n = 1 / sqrt(dot(d, d)), k[] = { -n * d.z, -n * d.y, n * d.x };
    const struct ks_path path =
        ks_trace(ks_from_camera(scene->spacetime.spin, RADIUS, scene->camera.inclination_deg * DEGREE, false, k), 8);
    const double s = sqrt(1 - path.u * path.u),
                 e = ks_from_camera(scene->spacetime.spin, RADIUS, scene->camera.inclination_deg * DEGREE, false, k)
                         .energy;
    *g = path.fate == KS_ESCAPED ? 1 / e : 0;
    return (struct vec3) { s * cos(path.sky_phi), s * sin(path.sky_phi), path.u };
}

static struct vec3 towards(const struct close *c, double further)
{
    return (struct vec3) { (c->rho + further) * cos(c->angle), (c->rho + further) * sin(c->angle), 1 };
}

/* Distance from the middle at which rays begin to escape, by the oracle. */
static double edge(const struct kd_scene *scene, double angle)
{
    double low = 0, high = 0.5, g;
    for (int i = 0; i < 46; i++) {
        const struct close c = { 0.5 * (low + high), angle };
        seen_by(scene, towards(&c, 0), &g);
        *(g > 0 ? &high : &low) = c.rho;
    }
    return high;
}

/* The solid angle of the sky that a pixel at the small picture's middle maps to, to fourth order, by steps outwards and
 * along the curve. So close to the curve the oracle's rays are not accurate enough for short steps along it. Longer
 * steps have an error, because the curve bends by the square of the step. */
static double patch_close(const struct kd_scene *scene, const struct close *c, double off, double curve)
{
    const double ahead = c->angle + 1e-3, behind = c->angle - 1e-3, far = edge(scene, ahead),
                 near = edge(scene, behind);
    const double tx = far * cos(ahead) - near * cos(behind), ty = far * sin(ahead) - near * sin(behind),
                 length = hypot(tx, ty);
    /* for rapidly spinning holes the sky changes faster along the curve */
    const bool fast = fabs(scene->spacetime.spin) > 0.9;
    const double outwards = (fast ? 0.003 : 0.01) * fmin(off, 0.1) * curve,
                 along_ = (fast ? 0.001 : 0.03) * sqrt(fmin(off, 0.1)) * curve;
    static const double weights[] = { 8.0 / 12, -1.0 / 12 };
    const double pixel = 2 * tan(0.5 * scene->camera.fov_deg * DEGREE) / CLOSE_WIDTH;
    const struct vec3 middle = towards(c, 0);
    struct vec3 i = { 0 }, j = { 0 };
    double g;
    for (int k = 0; k < 2; k++)
        for (int sign = -1; sign <= 1; sign += 2) {
            const double step_ = sign * (k + 1), w = sign * weights[k] / outwards, v = sign * weights[k] / along_;
            const struct vec3 out = seen_by(scene, towards(c, step_ * outwards), &g);
            const struct vec3 along = seen_by(
                scene,
                (struct vec3) { middle.x + step_ * along_ * tx / length, middle.y + step_ * along_ * ty / length, 1 },
                &g);
            i = (struct vec3) { i.x + w * out.x, i.y + w * out.y, i.z + w * out.z };
            j = (struct vec3) { j.x + v * along.x, j.y + v * along.y, j.z + v * along.z };
        }
    const struct vec3 n = seen_by(scene, middle, &g);
    /* cos^3 converts areas of the plane to solid angles of view; here the pixel is in the middle of its own picture */
    /* components outwards and along the curve */
    const double square = fabs(cos(c->angle) * ty - sin(c->angle) * tx) / length;
    return fabs(dot(n, cross(i, j))) / square * pow(dot(middle, middle), 1.5) * pixel * pixel;
}

/* Aims the camera: right of inwards by yaw, up by pitch (docs/scene.md). */
static void look_at(struct kd_scene *scene, const struct close *c, double field_deg)
{
    const struct vec3 d = towards(c, 0);
    scene->camera.yaw_deg = atan2(d.x, d.z) / DEGREE;
    scene->camera.pitch_deg = atan2(d.y, hypot(d.x, d.z)) / DEGREE;
    scene->camera.fov_deg = field_deg;
    scene->image.width = CLOSE_WIDTH;
    scene->image.height = CLOSE_HEIGHT;
    scene->image.critical_factor = 1;
}

/* Points ever closer to the curve of a spinning hole show images of ever higher orders. Tests each image above the
 * threshold. */
static void next_to_the_curve(void **state)
{
    (void)state;
    static const double offs[] = { 0.1, 0.03, 0.0135, 0.011, 0.006, 3e-3, 1e-3, 3e-4, 1e-4, 3e-5, 1e-5, 3e-6 };
    const double flux = kd_star_flux(kd_catalogue_star(0).magnitude);
    double worst = 0, off_most = 0, faintest = INFINITY;
    int n = 0, tried = 0;
    for (int k = 0; k < 4 * (int)(sizeof offs / sizeof *offs); k++) {
        struct kd_scene scene = scene_of(0.9, k % 2 ? 85 : 60);
        const double angle = 1 + 2.399963 * k, off = offs[k / 4], curve = edge(&scene, angle);
        const struct close at = { curve * (1 + off), angle };
        double g;
        if (!aim(&scene, seen_by(&scene, towards(&at, 0), &g)))
            continue;
        tried++;
        look_at(&scene, &at, CLOSE_FIELD);
        const double want = flux * g * g * g * g / patch_close(&scene, &at, off, curve);
        if (want < 0.031) /* below the threshold */
            continue;
        struct kd_frame frame = seen(&scene);
        const double x = 0.5 * (CLOSE_WIDTH - 1), y = 0.5 * (CLOSE_HEIGHT - 1);
        /* a region with all of this image, and almost nothing of the star's other images */
        const struct blob b = blob_at(&frame, x, y, 1);
        if (fabs(b.light / want - 1) > 0.003 || hypot(b.x - x, b.y - y) > 0.003)
            printf("spin 0.9, %g from the curve at angle %.2f: light %.4g, off by %+.5f, place by %.4f\n", off, angle,
                   want, b.light / want - 1, hypot(b.x - x, b.y - y));
        worst = fmax(worst, fabs(b.light / want - 1));
        off_most = fmax(off_most, hypot(b.x - x, b.y - y));
        faintest = fmin(faintest, want);
        n++;
        kd_frame_finish(&frame);
    }
    printf("spin 0.9: %d images of %d places, down to %.3g: light within %.5f, places within %.4f pixels\n", n, tried,
           faintest, worst, off_most);
    assert_true(n == 39 && tried == 41 && worst < 0.005 && off_most < 0.02);
}

/* Fast holes, seen edge-on or not, on the approaching side. Each image is only some hundredths closer to the curve than
 * the one before. The field of view is so small that the middle image is `AWAY` pixels from the curve. */
#define AWAY 100
static void next_to_the_curve_of_fast_holes(void **state)
{
    (void)state;
    static const struct {
        double spin, inclination;
    } holes[] = { { 0.95, 90 }, { 0.998, 85 }, { 0.9999, 90 }, { -0.9999, 100 } };
    static const double offs[] = { 0.1, 0.03, 0.01 };
    const double flux = kd_star_flux(kd_catalogue_star(0).magnitude);
    for (size_t h = 0; h < sizeof holes / sizeof *holes; h++) {
        double worst = 0, off_most = 0;
        int n = 0;
        for (int k = 0; k < 6; k++) {
            struct kd_scene scene = scene_of(holes[h].spin, holes[h].inclination);
            const double angle = (holes[h].spin > 0 ? M_PI : 0) + (k % 2 ? 0.3 : -0.9) + 0.05 * k, off = offs[k / 2],
                         curve = edge(&scene, angle);
            const struct close at = { curve * (1 + off), angle };
            double g;
            if (!aim(&scene, seen_by(&scene, towards(&at, 0), &g)))
                continue;
            look_at(&scene, &at, off * curve / AWAY * CLOSE_WIDTH / DEGREE);
            const double want = flux * g * g * g * g / patch_close(&scene, &at, off, curve);
            if (want < 0.031)
                continue;
            struct kd_frame frame = seen(&scene);
            const double x = 0.5 * (CLOSE_WIDTH - 1), y = 0.5 * (CLOSE_HEIGHT - 1);
            const struct blob b = blob_at(&frame, x, y, 1);
            if (!(fabs(b.light / want - 1) < 0.005 && hypot(b.x - x, b.y - y) < 0.02))
                printf("spin %g, inclination %g, %g from the curve at angle %.2f: light %.4g, off by %+.5f, place by "
                       "%.4f\n",
                       holes[h].spin, holes[h].inclination, off, angle, want, b.light / want - 1,
                       hypot(b.x - x, b.y - y));
            worst = fmax(worst, fabs(b.light / want - 1));
            off_most = fmax(off_most, hypot(b.x - x, b.y - y));
            n++;
            kd_frame_finish(&frame);
        }
        printf("spin %g, inclination %g: %d images, light within %.5f, places within %.4f pixels\n", holes[h].spin,
               holes[h].inclination, n, worst, off_most);
        /* Most positions have errors below 0.002 pixels. An image next to a caustic, at spin 0.9999 and with pixels of
         * 1e-5 rad, has an error of 0.02. */
        assert_true(n >= 4 && worst < 0.005 && off_most < 0.03);
    }
}

/* With all stars the picture has the same bytes each time. In bands it has the same bytes except at their edges. */
static void whole_skies(void **state)
{
    (void)state;
    struct kd_scene scene = scene_of(0.9, 75);
    struct kd_capacity c;
    kd_renderer_capacity(renderer, &c);
    scene.sky.limit_mag = 14;
    struct kd_frame one = shot(&scene, &c), again = shot(&scene, &c);
    assert_memory_equal(one.layers[1].data, again.layers[1].data, 12ull * WIDTH * HEIGHT);
    c.max_binding_bytes = 3 << 20;
    struct kd_frame bands = shot(&scene, &c);
    double sum = 0, off = 0, most = 0;
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) {
            sum += luminance(&one, x, y);
            off += fabs(luminance(&bands, x, y) - luminance(&one, x, y));
            most = fmax(most, luminance(&one, x, y));
        }
    printf("in bands: off by %.2g of the light\n", off / sum);
    assert_true(sum > 0 && off / sum < 5e-4 &&
                most > 100); /* if the rows next to each band were missing, the difference would be larger */
    kd_frame_finish(&one);
    kd_frame_finish(&again);
    kd_frame_finish(&bands);
}

/* Renders another picture whenever the background picture yields the device. */
struct other {
    struct kd_scene scene;
    struct kd_plan plan;
    int times;
};

static bool render_other(void *user, double fraction)
{
    (void)fraction;
    struct other *o = user;
    struct kd_frame frame;
    OK(kd_render(renderer, &o->scene, &o->plan, NULL, NULL, &frame, &error));
    kd_frame_finish(&frame);
    o->times++;
    return true;
}

static struct kd_plan plan_of(const struct kd_scene *scene, const struct kd_capacity *c)
{
    struct kd_needs needs = kd_needs_of(scene);
    struct kd_plan plan;
    needs.radiance = true;
    OK(kd_plan_make_for(scene, &needs, c, &plan, &error));
    return plan;
}

/* A picture in bands is rendered in the background under one sky, while others are rendered under another. The cached
 * light of one sky is not used for the other: pictures that share a lens map equal pictures with maps of their own. */
static void another_sky_meanwhile(void **state)
{
    (void)state;
    struct kd_scene scene = scene_of(0.9, 75), turned;
    struct kd_capacity c;
    struct kd_frame first, again;
    struct other o = { 0 };
    kd_renderer_capacity(renderer, &c);
    c.max_binding_bytes = 3 << 20;
    scene.sky.limit_mag = 8;
    scene.camera.fov_deg = 20;
    scene.camera.yaw_deg = 40; /* the curve is out of view, so that the number of rays at it changes no pixel */
    scene.image.critical_factor = 3;
    turned = scene;
    turned.camera.azimuth_deg = 40;
    o.scene = turned;
    o.scene.image.critical_factor = 2; /* another factor, so that this picture has its own map */
    o.plan = plan_of(&o.scene, &c);
    const struct kd_plan plan = plan_of(&scene, &c), plan_turned = plan_of(&turned, &c);
    assert_true(plan.picture.bands > 1 && plan.lens.cacheable);
    OK(kd_render_in_background(renderer, &scene, &plan, render_other, NULL, &o, &first, &error));
    OK(kd_render_in_background(renderer, &turned, &plan_turned, NULL, NULL, NULL, &again, &error));
    struct kd_frame want = shot(&o.scene, &c);
    assert_true(o.times > 1 && again.lens_reused);
    assert_memory_equal(again.layers[1].data, want.layers[1].data, 12ull * WIDTH * HEIGHT);
    assert_memory_not_equal(again.layers[1].data, first.layers[1].data, 12ull * WIDTH * HEIGHT);
    kd_frame_finish(&first);
    kd_frame_finish(&again);
    kd_frame_finish(&want);
}

static bool was_run(const struct kd_frame *frame, const char *pass)
{
    for (size_t i = 0; i < frame->n_timings; i++)
        if (!strcmp(frame->timings[i].name, pass))
            return true;
    return false;
}

/* The light of stars is cached with the lens map. A frame that reuses the map after one change equals a frame with a
 * map of its own. To force a new map, the second frame has another number of rays at the critical curve. This changes
 * no pixel, because the curve is out of view. */
static void kept_and_made_anew(void **state)
{
    (void)state;
    static const char *const changes[][2] = {
        { "camera.azimuth_deg", "3" }, { "sky.turn_deg", "5" },    { "sky.tilt_deg", "-20" },
        { "sky.brightness", "2" },     { "sky.limit_mag", "6" },   { "sky.orientation", "m87" },
        { "sky.model", "stars" },      { "disk.band", "visible" }, { "time", "10" },
    };
    struct kd_scene base = scene_of(0.9, 75);
    base.sky.limit_mag = 8;
    base.camera.fov_deg = 20;
    base.camera.yaw_deg = 40; /* the curve is out of view */
    for (size_t i = 0; i < sizeof changes / sizeof *changes; i++) {
        struct kd_scene scene = base, own;
        OK(kd_scene_set(&scene, changes[i][0], changes[i][1], &error));
        own = scene;
        own.image.critical_factor = 5 + (int)i;
        struct kd_frame first = seen(&base), again = seen(&scene), fresh = seen(&own);
        /* no star depends on what the last change affects */
        bool idle = i + 1 == sizeof changes / sizeof *changes;
        assert_true(again.lens_reused && !fresh.lens_reused && was_run(&fresh, "stars"));
        assert_true(was_run(&again, "stars") == !idle);
        assert_memory_equal(again.layers[1].data, fresh.layers[1].data, 12ull * WIDTH * HEIGHT);
        assert_true((memcmp(again.layers[1].data, first.layers[1].data, 12ull * WIDTH * HEIGHT) == 0) == idle);
        kd_frame_finish(&first);
        kd_frame_finish(&again);
        kd_frame_finish(&fresh);
    }
}

/* When only bright images are drawn, images above half the threshold have the right light, and the right position to a
 * fifth of a ray. Many others are absent, which the plan reports. The map has no footprints. */
static void bright_images(void **state)
{
    (void)state;
    struct kd_scene scene = scene_of(0.9, 75);
    struct kd_capacity c;
    scene.sky.limit_mag = 9;
    scene.sky.brightness = 1;
    scene.camera.fov_deg = 60;
    kd_renderer_capacity(renderer, &c);
    struct kd_needs needs = kd_needs_of(&scene);
    struct kd_plan plan;
    struct kd_frame bright;
    needs.radiance = needs.bright = true;
    OK(kd_plan_make_for(&scene, &needs, &c, &plan, &error));
    const struct kd_plan whole = plan_of(&scene, &c);
    assert_true(!(plan.lens.quantities & KD_LENS_SKY_FOOTPRINT) && (whole.lens.quantities & KD_LENS_SKY_FOOTPRINT));
    assert_true(plan.light.bright && !whole.light.bright &&
                plan.report.n_approximations == whole.report.n_approximations + 1);
    struct kd_frame all = seen(&scene);
    OK(kd_render(renderer, &scene, &plan, NULL, NULL, &bright, &error));
    struct kd_frame again = seen(&scene);
    assert_true(was_run(&bright, "stars") && !bright.lens_reused && !was_run(&again, "stars") &&
                again.lens_reused); /* checks that the two pictures do not share a lens map */
    assert_memory_equal(again.layers[1].data, all.layers[1].data, 12ull * WIDTH * HEIGHT);
    /* approximate radius of the curve */
    const double radius = 0.5 * WIDTH * tan(asin(sqrt(27) / RADIUS)) / tan(0.5 * scene.camera.fov_deg * DEGREE);
    int images = 0, faint = 0, lost = 0, off = 0; /* also counts faint images within a pixel, whose light is missing */
    for (int y = 4; y < HEIGHT - 4; y++)
        for (int x = 4; x < WIDTH - 4; x++) {
            const double l = luminance(&all, x, y);
            if (hypot(x - 0.5 * WIDTH, y - 0.5 * HEIGHT) < 1.5 * radius)
                continue; /* skips images next to the curve */
            faint += l > 0.05 && l < 0.3 && luminance(&bright, x, y) == 0;
            bool top = l > 3;
            for (int k = 0; k < 9; k++)
                top = top && luminance(&all, x - 1 + k % 3, y - 1 + k / 3) <= l;
            if (!top)
                continue;
            const struct blob want = blob_at(&all, x, y, 1), is = blob_at(&bright, x, y, 1);
            const double place = hypot(want.x - is.x, want.y - is.y);
            images++;
            lost += fabs(is.light / want.light - 1) > 0.1;
            off += !(place < 0.2);
        }
    printf("%d bright images, %d of other light, %d off their places; %d pixels of faint ones are dark\n", images, lost,
           off, faint);
    assert_true(images > 30 && lost <= images / 30 && off <= images / 60 && faint > 500);
    kd_frame_finish(&all);
    kd_frame_finish(&bright);
    kd_frame_finish(&again);
}

/* With diffuse light on the sky, bright images are searched for in the same lens map, which then has footprints. Cached
 * light of one kind of map, with or without footprints, must not be used for the other. */
static void bright_images_before_spread_light(void **state)
{
    (void)state;
    struct kd_scene scene = scene_of(0.9, 75);
    struct kd_capacity c;
    scene.sky.limit_mag = 7;
    scene.sky.milky_way = 0.01;
    kd_renderer_capacity(renderer, &c);
    struct kd_needs needs = kd_needs_of(&scene);
    struct kd_plan plan;
    struct kd_frame bright, all = seen(&scene);
    needs.bright = true;
    OK(kd_plan_make_for(&scene, &needs, &c, &plan, &error));
    OK(kd_render(renderer, &scene, &plan, NULL, NULL, &bright, &error));
    struct kd_frame again = seen(&scene);
    assert_true(plan.lens.quantities & KD_LENS_SKY_FOOTPRINT);
    assert_true(was_run(&bright, "stars") && bright.lens_reused && was_run(&again, "stars") && again.lens_reused);
    assert_memory_equal(again.layers[1].data, all.layers[1].data, 12ull * WIDTH * HEIGHT);
    kd_frame_finish(&all);
    kd_frame_finish(&bright);
    kd_frame_finish(&again);
}

/* With diffuse light on the sky, however faint, each pixel is lit by itself. With stars only, columns of pixels are
 * processed from crossing to crossing. */
static void points_behind_a_disk(void **state)
{
    (void)state;
    for (int spots = 0; spots < 2; spots++) {
        struct kd_scene scene, spread;
        size_t lit = 0, behind = 0;
        kd_scene_defaults(&scene);
        scene.sky.model = KD_SKY_CATALOGUE;
        scene.sky.brightness = 1;
        scene.sky.milky_way = 0;
        scene.image.width = WIDTH;
        scene.image.height = HEIGHT;
        if (spots)
            OK(kd_scene_set(&scene, "spots.0.brightness", "2", &error));
        spread = scene;
        spread.sky.milky_way = 1e-12;
        struct kd_frame a = seen(&scene), b = seen(&spread);
        const float *points = a.layers[1].data, *each = b.layers[1].data;
        scene.sky.model = KD_SKY_NONE;
        struct kd_frame c = seen(&scene);
        const float *disk = c.layers[1].data;
        for (size_t i = 0; i < 3ul * WIDTH * HEIGHT; i++) {
            if (fabsf(points[i] - each[i]) > 1e-9f + 1e-6f * each[i])
                fail_msg("pixel %zu: %g, lit by itself %g", i / 3, points[i], each[i]);
            lit += points[i] > 0 && disk[i] == 0;
            behind += disk[i] > 0 && points[i] > 1.01f * disk[i];
        }
        printf("%zu channels of stars alone, %zu of stars behind the disk\n", lit, behind);
        assert_true(lit > 10000 && behind > 100);
        kd_frame_finish(&a);
        kd_frame_finish(&b);
        kd_frame_finish(&c);
    }
}

int main(int argc, char **argv)
{
    if (argc > 1)
        cmocka_set_test_filter(argv[1]);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bright_images),
        cmocka_unit_test(bright_images_before_spread_light),
        cmocka_unit_test(points_behind_a_disk),
        cmocka_unit_test(kept_and_made_anew),
        cmocka_unit_test(another_sky_meanwhile),
        cmocka_unit_test(behind_the_hole),
        cmocka_unit_test(round_the_hole),
        cmocka_unit_test(next_to_the_curve),
        cmocka_unit_test(next_to_the_curve_of_fast_holes),
        cmocka_unit_test(images_by_the_oracle),
        cmocka_unit_test(whole_skies),
    };
    int skip = open_renderer();
    if (skip)
        return skip;
    return close_renderer(cmocka_run_group_tests(tests, NULL, NULL));
}
