/* Compares small pictures with the committed ones.
 *
 *     golden DIR            compare
 *     golden --quick DIR    leaves out pictures whose kernels take SwiftShader half a minute to compile
 *     golden --long DIR     only the pictures that --quick leaves out
 *     golden --update DIR   write them anew
 *
 * A name after DIR selects that picture.
 *
 * A reference file has a fixed exposure in its scene. Automatic exposure is quantised to an eighth of a stop. On
 * another device, one pixel at the edge of a bin may change the exposure, and thereby every pixel. Pixels are therefore
 * compared at the exposure of the reference, and the automatic exposure separately. */
#include "studio.h"

#include "image/png.h"
#include "playground/json.h"
#include "playground/show.h"
#include "render/output/png.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* 16 rays a pixel: if one ray falls on the other side of an edge, the pixel changes by only a sixteenth. */
#define SIZE "\"image\":{\"width\":160,\"height\":90,\"samples\":4}"

static const struct shot {
    const char *name, *preset, *json;
    const char *playground; /* JSON of the playground that the picture shows, or NULL */
    double after;           /* time since the beginning of the playground */
} shots[] = {
    { "default", "gas", "{" SIZE "}" },
    { "smooth", "smooth", "{" SIZE "}" },
    { "schwarzschild", "schwarzschild", "{" SIZE "}" },
    { "reissner-nordstrom", "reissner-nordstrom", "{" SIZE "}" },
    { "charged", "smooth",
      "{\"spacetime\":{\"spin\":0.7,\"charge\":0.6},\"camera\":{\"r\":30,\"observer\":\"infall\"},\"sky\":{\"model\":"
      "\"grid\"}," SIZE "}" },
    { "gargantua", "gargantua", "{" SIZE "}" },
    /* large enough for the scales that kerrd draws in the picture */
    { "m87", "m87", "{\"image\":{\"width\":400,\"height\":225}}" },
    { "sgra", "sgra", "{\"image\":{\"width\":400,\"height\":225}}" },
    { "luminet1979", "luminet1979", "{" SIZE "}" },
    { "edge-on", "edge-on", "{" SIZE "}" },
    { "face-on", "face-on", "{" SIZE "}" },
    { "photon-rings", "photon-rings", "{" SIZE "}" },
    { "gas", "gas", "{\"time\":1000," SIZE "}" },
    { "gas-stars", "gas-stars", "{\"time\":1000,\"sky\":{\"milky_way\":1}," SIZE "}" },
    { "falling", "falling", "{" SIZE "}" },
    { "inside", "falling", "{\"camera\":{\"r\":1,\"projection\":\"equirectangular\"}," SIZE "}" },
    { "infall", "infall", "{" SIZE "}" },
    { "thick-disk", "thick-disk", "{\"time\":1000,\"image\":{\"width\":160,\"height\":90}}" },
    { "gargantua-gas", "gargantua-gas", "{" SIZE "}" },
    { "living-disk", "living-disk", "{\"time\":1000," SIZE "}" },
    { "polarised-ring", "polarised-ring", "{" SIZE "}" },
    { "gold-1", "gold-1", "{\"image\":{\"width\":96,\"height\":96}}" },
    { "gold-2", "gold-2", "{\"image\":{\"width\":96,\"height\":96}}" },
    { "gold-3", "gold-3", "{\"image\":{\"width\":96,\"height\":96}}" },
    { "gold-4", "gold-4", "{\"image\":{\"width\":96,\"height\":96}}" },
    { "gold-5", "gold-5", "{\"image\":{\"width\":96,\"height\":96}}" },
    { "riaf", "riaf", "{\"image\":{\"width\":96,\"height\":96}}" },
    { "torus", "torus", "{\"image\":{\"width\":96,\"height\":96}}" },
    { "jet", "jet", "{\"image\":{\"width\":160,\"height\":90}}" },
    { "star-behind", "star-behind", "{\"image\":{\"width\":160,\"height\":90}}" },
    { "companions", "companions", "{\"image\":{\"width\":160,\"height\":90}}" },
    { "hot-spot", "hot-spot", "{\"time\":130," SIZE "}" },
    { "echo", "echo", "{" SIZE "}" },
    { "spots", NULL,
      "{\"spacetime\":{\"spin\":0.9},\"camera\":{\"r\":40,\"inclination_deg\":75},\"disk\":{\"model\":\"none\",\"slow_"
      "light\":true},"
      "\"spot1\":{\"brightness\":1,\"r\":3,\"size\":0.5,\"phase_deg\":200,\"temperature_k\":4000},"
      "\"spot2\":{\"brightness\":0.5,\"r\":7,\"size\":1.5,\"phase_deg\":100},"
      "\"spot3\":{\"brightness\":0.3,\"r\":12,\"phase_deg\":-20,\"index\":-1},\"time\":70,\"style\":{\"exposure\":0}"
      "," SIZE "}" },
    { "plunging", NULL,
      "{\"time\":1000,\"spacetime\":{\"spin\":0.3},\"camera\":{\"inclination_deg\":40,\"field_m\":18},"
      "\"disk\":{\"model\":\"particles\",\"outer\":18,\"plunging_temperature\":0.9},\"style\":{\"exposure\":1}," SIZE
      "}" },
    { "retrograde", NULL, "{\"spacetime\":{\"spin\":-0.9}," SIZE "}" },
    { "zamo", NULL,
      "{\"spacetime\":{\"spin\":0.9},\"camera\":{\"r\":15,\"observer\":\"zamo\",\"inclination_deg\":70,"
      "\"fov_deg\":100,\"yaw_deg\":-10,\"pitch_deg\":5,\"roll_deg\":20}," SIZE "}" },
    { "equirectangular", NULL,
      "{\"spacetime\":{\"spin\":0.9},\"camera\":{\"r\":8,\"observer\":\"zamo\",\"inclination_deg\":75,\"projection\":"
      "\"equirectangular\"},"
      "\"disk\":{\"outer\":7,\"opacity\":0.7,\"gas\":{\"amplitude\":0}},\"sky\":{\"model\":\"grid\"}," SIZE "}" },
    { "fulldome", NULL,
      "{\"spacetime\":{\"spin\":0.9},\"camera\":{\"r\":5,\"observer\":\"zamo\",\"inclination_deg\":80,\"projection\":"
      "\"fulldome\",\"pitch_deg\":20,"
      "\"roll_deg\":10},\"disk\":{\"outer\":12,\"gas\":{\"amplitude\":0}},\"sky\":{\"model\":\"grid\"}," SIZE "}" },
    { "grid", NULL,
      "{\"camera\":{\"field_m\":40,\"inclination_deg\":60},\"disk\":{\"model\":\"none\"},"
      "\"sky\":{\"model\":\"grid\",\"brightness\":0.7},\"style\":{\"exposure\":0}," SIZE "}" },
    { "milky-way", "milky-way", "{" SIZE "}" },
    { "stars", NULL,
      "{\"camera\":{\"field_m\":60,\"inclination_deg\":70},\"sky\":{\"model\":\"stars\",\"seed\":3,\"brightness\":0.03}"
      ",\"style\":{\"exposure\":0.5}," SIZE "}" },
    { "real-stars", NULL,
      "{\"spacetime\":{\"spin\":0.9},\"camera\":{\"r\":6,\"observer\":\"zamo\",\"inclination_deg\":80,\"projection\":"
      "\"equirectangular\"},"
      "\"disk\":{\"model\":\"none\",\"band\":\"visible\"},\"sky\":{\"model\":\"catalogue\",\"milky_way\":0,\"limit_"
      "mag\":7,\"brightness\":0.02,\"orientation\":\"equatorial\"},"
      "\"style\":{\"exposure\":1}," SIZE "}" },
    { "translucent", NULL, "{\"disk\":{\"opacity\":0.4},\"sky\":{\"model\":\"grid\"}," SIZE "}" },
    { "no-doppler", NULL, "{\"disk\":{\"doppler\":false,\"redshift\":false}," SIZE "}" },
    { "visible", NULL,
      "{\"disk\":{\"model\":\"shakura-sunyaev\",\"band\":\"visible\",\"colour\":\"accretion\","
      "\"hardening\":1.7}," SIZE "}" },
    { "deep", NULL,
      "{\"image\":{\"width\":160,\"height\":90,\"samples\":4,\"bit_depth\":16},"
      "\"style\":{\"tone_map\":\"srgb\"}}" },
    { "torn-star", NULL,
      "{\"camera\":{\"inclination_deg\":30,\"field_m\":300,\"centre_beta\":20},\"disk\":{\"outer\":20},\"spacetime\":{"
      "\"spin\":0},\"style\":{\"exposure\":1}," SIZE "}",
      "{\"preset\":\"white-dwarf\",\"debris_per_body\":20000}", 1800 },
};
#define SHOTS (sizeof shots / sizeof *shots)

/* Each kind of sky for each kind of observer. The observer's motion aberrates the sky and shifts its colours. An
 * infalling observer is computed in other coordinates. */
#define SKY(name, model, fields) { name, "{\"model\":\"" model "\"," fields "}" }
static const struct {
    const char *name, *json;
} skies[] = {
    SKY("grid", "grid", "\"brightness\":0.25"),
    SKY("stars", "stars", "\"brightness\":0.06,\"seed\":3"),
    SKY("catalogue", "catalogue", "\"brightness\":0.06,\"orientation\":\"sgra\""),
    SKY("image", "image", "\"brightness\":0.35,\"orientation\":\"sgra\",\"image\":\"" STUDIO_SKY "\""),
    SKY("image-stars", "catalogue",
        "\"brightness\":0.2,\"milky_way\":0.7,\"limit_mag\":5,\"orientation\":\"equatorial\",\"image\":\"" STUDIO_SKY
        "\""),
};
#define OBSERVER(word, fields) { word, "\"observer\":\"" word "\"" fields }
static const struct {
    const char *name, *json;
} observers[] = {
    OBSERVER("static", ""),
    OBSERVER("zamo", ""),
    OBSERVER("keplerian", ""),
    OBSERVER("infall", ""),
    OBSERVER("velocity", ",\"velocity_r\":-0.3,\"velocity_theta\":0.2,\"velocity_phi\":0.4"),
};
enum { SKIES = sizeof skies / sizeof *skies, OBSERVERS = sizeof observers / sizeof *observers };

static void sky_shot(size_t i, char name[64], char json[640], struct shot *out)
{
    snprintf(name, 64, "sky-%s-%s", skies[i / OBSERVERS].name, observers[i % OBSERVERS].name);
    snprintf(json, 640,
             "{\"spacetime\":{\"spin\":0.9},\"camera\":{\"r\":7,\"inclination_deg\":90,\"fov_deg\":120,\"pitch_deg\":"
             "10,%s},\"disk\":{\"model\":\"none\"},"
             "\"sky\":%s,\"style\":{\"exposure\":1},\"image\":{\"width\":144,\"height\":81,\"samples\":2}}",
             observers[i % OBSERVERS].json, skies[i / OBSERVERS].json);
    *out = (struct shot) { .name = name, .json = json };
}

static struct kd_dynamic_bodies *dynamic_of(const struct shot *shot)
{
    struct kd_playground_progress progress;
    struct kd_playground *p = NULL;
    struct kd_dynamic_bodies *dynamic = NULL;
    struct kd_error error;
    enum kd_status status = kd_playground_read(shot->playground, strlen(shot->playground), &p, &error);
    if (!status)
        kd_playground_advance(p, shot->after, &progress);
    if (!status && progress.slowed)
        status = kd_error_set(&error, KD_EINVAL, "the budget of sub-steps was spent after %g M", progress.done);
    if (!status)
        status = kd_playground_show(p, &dynamic, &error);
    kd_playground_destroy(p);
    if (status) {
        fprintf(stderr, "%s: %s\n", shot->name, error.message);
        exit(1);
    }
    return dynamic;
}

static struct kd_frame render(const struct shot *shot, const struct kd_scene *scene)
{
    struct kd_scene shown = *scene;
    struct kd_dynamic_bodies *dynamic = shot->playground ? dynamic_of(shot) : NULL;
    if (dynamic)
        kd_scene_show(&shown, dynamic);
    struct kd_frame frame = studio_render(&shown);
    kd_dynamic_bodies_release(dynamic);
    return frame;
}

/* Last bits of sqrt, log2 and sin differ between devices, which changes crossing radii by some 1e-6. If rays are
 * displaced by 1e-5, the PSNR of the grid, which has only sharp lines, is 50 dB, and that of every other picture is
 * above 57 dB. A brightness error of 4 %, or a camera error of a tenth of a pixel, gives 32 to 45 dB. */
#define PSNR_MIN 45.0
/* If one ray of sixteen gets another colour, its pixel changes by up to 24 steps of 255, and at the black edge of a
 * bright ring by more. One pixel in 200 may change by more. */
#define FAR (24.0 / 255)
#define FAR_SHARE 0.005
#define EXPOSURE_STEP 0.126 /* width of one bin of the histogram */

static enum kd_status read_file(const char *path, struct kd_buffer *out)
{
    char chunk[4096];
    enum kd_status status = KD_OK;
    FILE *file = fopen(path, "rb");
    if (!file)
        return KD_EIO;
    for (size_t n; !status && (n = fread(chunk, 1, sizeof chunk, file)) > 0;)
        status = kd_buffer_append(out, chunk, n);
    fclose(file);
    return status;
}

/* Renders the reference's scene, whose exposure is fixed. */
static enum kd_status read_reference(const char *path, struct kd_frame *out, struct kd_error *error)
{
    struct kd_buffer file = { 0 };
    struct kd_scene scene;
    struct kd_png png;
    if (read_file(path, &file)) {
        kd_buffer_finish(&file);
        return kd_error_set(error, KD_EIO, "%s cannot be read", path);
    }
    enum kd_status status = kd_format_scene(file.data, file.size, &scene, error);
    if (!status)
        status = kd_png_decode(file.data, file.size, &png, error);
    if (!status) {
        *out = (struct kd_frame) { .width = png.width,
                                   .height = png.height,
                                   .layers = { { "rgb", 3, png.bit_depth == 16 ? KD_LAYER_U16 : KD_LAYER_U8,
                                                 png.pixels } },
                                   .n_layers = 1,
                                   .exposure = scene.style.exposure };
        png.pixels = NULL;
        kd_png_finish(&png);
    }
    kd_buffer_finish(&file);
    return status;
}

static bool same_picture(const char *name, const struct kd_frame *got, const struct kd_frame *want)
{
    if (got->width != want->width || got->height != want->height ||
        kd_frame_bit_depth(got) != kd_frame_bit_depth(want)) {
        printf("%s: another size or depth\n", name);
        return false;
    }
    double sum = 0;
    size_t off = 0, pixels = (size_t)got->width * got->height;
    for (uint32_t y = 0; y < got->height; y++)
        for (uint32_t x = 0; x < got->width; x++) {
            double worst = 0;
            for (int c = 0; c < 3; c++) {
                double d = fabs(studio_value(got, x, y, c) - studio_value(want, x, y, c));
                sum += d * d;
                worst = fmax(worst, d);
            }
            off += worst > FAR;
        }
    double psnr = 10 * log10(3 * (double)pixels / sum), share = (double)off / (double)pixels;
    bool good = !(psnr < PSNR_MIN) && share <= FAR_SHARE;
    printf("%-14s %5.1f dB, %zu pixels far off%s\n", name, psnr, off, good ? "" : ": ANOTHER PICTURE");
    return good;
}

static bool compare(const struct shot *shot, const char *path)
{
    struct kd_scene scene = studio_scene(shot->preset, shot->json);
    struct kd_error error = { 0 };
    struct kd_frame want, got;
    if (read_reference(path, &want, &error)) {
        printf("%s: %s\n", shot->name, error.message);
        return false;
    }
    bool good = true;
    if (isinf(scene.style.exposure)) {
        got = render(shot, &scene);
        if (!(fabs(got.exposure - want.exposure) < EXPOSURE_STEP)) {
            printf("%s: exposed by %g stops, not %g\n", shot->name, got.exposure, want.exposure);
            good = false;
        }
        kd_frame_finish(&got);
        scene.style.exposure = want.exposure;
    }
    got = render(shot, &scene);
    good &= same_picture(shot->name, &got, &want);
    kd_frame_finish(&got);
    kd_frame_finish(&want);
    return good;
}

static bool update(const struct shot *shot, const char *path)
{
    struct kd_scene scene = studio_scene(shot->preset, shot->json);
    struct kd_frame frame = render(shot, &scene);
    struct kd_buffer png = { 0 };
    struct kd_error error = { 0 };
    scene.style.exposure = frame.exposure;
    const struct kd_plan none = { 0 };
    const struct kd_picture picture = { &frame, &scene, &none, "reference", 0 };
    enum kd_status status = kd_png_of_picture(&picture, 8, &png, &error);
    FILE *file = status ? NULL : fopen(path, "wb");
    bool good = file && fwrite(png.data, 1, png.size, file) == png.size;
    if (file && fclose(file))
        good = false;
    printf("%s: %s\n", path, good ? "written" : status ? error.message : "cannot be written");
    kd_buffer_finish(&png);
    kd_frame_finish(&frame);
    return good;
}

static bool takes_long(const struct shot *shot)
{
    struct kd_scene scene = studio_scene(shot->preset, shot->json);
    const struct kd_body *bodies[KD_SCENE_BODIES];
    return scene.sky.model == KD_SKY_STARS || scene.sky.model == KD_SKY_CATALOGUE || scene.jets.brightness > 0 ||
           !strncmp(shot->name, "gold-", 5) || !strcmp(shot->name, "riaf") || !strcmp(shot->name, "torus") ||
           kd_scene_bodies(&scene, bodies);
}

int main(int argc, char **argv)
{
    const char *which = argc > 2 ? argv[1] : "";
    bool updating = !strcmp(which, "--update"), quick = !strcmp(which, "--quick"), slow = !strcmp(which, "--long");
    int options = updating || quick || slow;
    if (argc != 2 + options && argc != 3 + options) {
        fprintf(stderr, "usage: golden [--update|--quick|--long] DIR [NAME]\n");
        return 2;
    }
    int code = studio_open();
    if (code)
        return code;
    for (size_t i = 0; i < SHOTS + SKIES * OBSERVERS; i++) {
        char path[1024], name[64], json[640];
        struct shot shot;
        if (i < SHOTS)
            shot = shots[i];
        else
            sky_shot(i - SHOTS, name, json, &shot);
        const char *only = argv[2 + options];
        if (only ? strcmp(shot.name, only) != 0 : (quick || slow) && takes_long(&shot) != slow)
            continue;
        snprintf(path, sizeof path, "%s/%s.png", argv[1 + options], shot.name);
        if (!(updating ? update : compare)(&shot, path))
            code = 1;
    }
    /* a preset that no picture shows */
    for (size_t p = 0; p < kd_scene_preset_count(); p++) {
        bool shown = false;
        for (size_t i = 0; i < SHOTS; i++)
            shown |= shots[i].preset && !strcmp(shots[i].preset, kd_scene_preset_name(p));
        if (!shown) {
            printf("preset %s has no picture\n", kd_scene_preset_name(p));
            code = 1;
        }
    }
    studio_close();
    return code;
}
