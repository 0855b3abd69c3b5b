/* Tests that panoramas have no visible edges. The light of a star is the same everywhere, also on the seam between left
 * and right and at the poles. This holds for the glare of a lens too. The hole is so far away that space is flat. */
#include "render/sky/frame.h"
#include "render/sky/star.h"
#include "render/view/camera.h"

#include "render_support.h"

#include <math.h>

#define DEGREE (M_PI / 180)

static struct kd_scene scene_of(int width, int height)
{
    struct kd_scene scene;
    kd_scene_smooth(&scene);
    scene.spacetime.spin = 0;
    scene.camera.r = 1e6;
    scene.camera.inclination_deg = 70;
    scene.camera.projection = KD_PROJECTION_EQUIRECTANGULAR;
    scene.disk.model = KD_DISK_NONE;
    scene.sky.model = KD_SKY_CATALOGUE;
    scene.sky.limit_mag = -1; /* shows Sirius alone */
    scene.sky.brightness = 1;
    scene.sky.milky_way = 0;
    scene.style.exposure = 0;
    scene.image.width = width;
    scene.image.height = height;
    return scene;
}

/* Turns the sky so that Sirius appears at the place (x, y) of the picture, by n = Rz(-turn) Ry(-tilt) s. x and y are in
 * pixels, and the centre of the first pixel is at 0. */
static bool put(struct kd_scene *scene, double x, double y)
{
    const struct kd_camera_exact camera = kd_camera_exact(scene);
    const struct kd_catalogue_star star = kd_catalogue_star(0);
    const struct kd_rotation galactic = kd_rotation_galactic();
    const struct kd_vec s = kd_rotate(&galactic, kd_sky_direction(star.ra, star.dec));
    const double side = kd_scene_side(scene), i = scene->camera.inclination_deg * DEGREE;
    double k[3];
    kd_camera_direction(&camera, side * (x + 0.5) - 0.5, side * (y + 0.5) - 0.5, k);
    const struct kd_vec n = { k[0] * sin(i) + k[1] * cos(i), k[2], k[0] * cos(i) - k[1] * sin(i) };
    const double length = hypot(s.x, s.z);
    if (fabs(n.z) > length)
        return false;
    const double tilt = atan2(s.x, s.z) + acos(n.z / length), along = cos(tilt) * s.x - sin(tilt) * s.z;
    scene->sky.tilt_deg = remainder(tilt, 2 * M_PI) / DEGREE;
    scene->sky.turn_deg = remainder(atan2(s.y, along) - atan2(n.y, n.x), 2 * M_PI) / DEGREE;
    return true;
}

/* Total light of a picture: the sum of radiance times solid angle over all pixels, divided by the star's flux. */
static double light_of(const struct kd_scene *scene, bool bright)
{
    struct kd_needs needs = kd_needs_of(scene);
    struct kd_capacity c;
    struct kd_plan plan;
    struct kd_frame frame;
    needs.radiance = true;
    needs.bright = bright;
    kd_renderer_capacity(renderer, &c);
    OK(kd_scene_validate(scene, &error));
    OK(kd_plan_make_for(scene, &needs, &c, &plan, &error));
    OK(kd_render(renderer, scene, &plan, NULL, NULL, &frame, &error));
    const float *rgb = frame.layers[1].data;
    double sum = 0;
    for (uint32_t y = 0; y < frame.height; y++)
        for (uint32_t x = 0; x < frame.width; x++, rgb += 3)
            sum += (0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2]) * sin(M_PI * (y + 0.5) / frame.height);
    const double pixel = 2 * M_PI / frame.width * M_PI / frame.height;
    kd_frame_finish(&frame);
    return sum * pixel / kd_star_flux(kd_catalogue_star(0).magnitude);
}

/* The sky is turned so that the star is on the seam, at the poles, and in the rows of pixels beside the poles that the
 * turn can reach. Pixels are 2.8 degrees wide. Next to a pole a second-order map does not represent a whole turn. If
 * only bright images are drawn, the positions of images in two adjacent tiles of 25 degrees differ by up to 0.2 rays at
 * the border. */
static void a_star_anywhere(void **state)
{
    (void)state;
    static const struct { int width, height, samples; } pictures[] = { { 128, 64, 1 }, { 127, 63, 1 }, { 64, 32, 2 } };
    static const double columns[] = { -0.5, -0.49, -0.3, 0, 0.6, 1.4, 20.3 },
                        rows[] = { -0.45, -0.3, 0, 0.3, 0.6, 1, 2.3, 20.2 };
    for (size_t p = 0; p < sizeof pictures / sizeof *pictures; p++) {
        double worst = 0;
        int n = 0;
        for (size_t r = 0; r < sizeof rows / sizeof *rows; r++)
            for (size_t c = 0; c < sizeof columns / sizeof *columns; c++) {
                struct kd_scene scene = scene_of(pictures[p].width, pictures[p].height);
                scene.image.samples = pictures[p].samples;
                scene.camera.yaw_deg = -140 + 90 * (double)(c % 2);
                scene.camera.pitch_deg = 31;
                const bool right = (c + r) % 3 == 1, down = (c + r) % 2;
                const double x = right ? pictures[p].width - 1 - columns[c] : columns[c],
                             y = down ? pictures[p].height - 1 - rows[r] : rows[r];
                if (!put(&scene, x, y))
                    continue;
                for (int bright = 0; bright < (p ? 1 : 2); bright++) {
                    const double off = light_of(&scene, bright) - 1,
                                 most = bright ? 0.2 : 0.01 + 0.0015 / (rows[r] + 0.5);
                    if (!(fabs(off) < most))
                        fail_msg("%d x %d, %s: at %.2f, %.2f light is off by %+.4f", pictures[p].width,
                                 pictures[p].height, bright ? "bright alone" : "all", x, y, off);
                    worst = fmax(worst, bright ? 0 : fabs(off));
                    n++;
                }
            }
        printf("%d x %d: %d places, light within %.4f\n", pictures[p].width, pictures[p].height, n, worst);
        assert_true(n >= 25);
    }
}

int main(void)
{
    int skip = open_renderer();
    if (skip)
        return skip;
    const struct CMUnitTest tests[] = { cmocka_unit_test(a_star_anywhere) };
    return close_renderer(cmocka_run_group_tests(tests, NULL, NULL));
}
