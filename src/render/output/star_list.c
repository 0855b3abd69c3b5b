/* Lists the stars in a picture and their places: kd_format_stars. The list is a JSON document of the images of stars
 * that have names. Images are sorted by the light that they give to a pixel (docs/physics/sky.md). Images are searched
 * between the rays of the lens map, one a pixel, and in the rim of the shadow. The place of an image is that of the ray
 * that ends at the star. Each image has its own brightness; the images of a star are not added up. */
#include "render/output/format.h"

#include "base/json.h"
#include "render/plan/layer_kinds.h"
#include "render/sky/rim_images.h"
#include "render/sky/star_names.h"
#include "render/sky/star.h"
#include "render/view/sky_ray.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

/* limit in rad of the angle between the ends of neighbouring rays. Rays whose ends are further apart, as near the
 * critical curve, are not used */
#define COARSE 0.15
/* fraction of the rim's width. Nearer to the curve than this, only the images found in the rim count */
#define INNER 0.9
/* distance in pixels. Two images of a star, one from each grid, that are nearer than this are the same image */
#define APART 0.05

enum { MOST = 400 }; /* largest number of images in a file; the brightest are kept */

/* An image in the picture. light: the mean radiance that it gives to a pixel, in units of kd_star_flux. */
struct image {
    struct kd_star_image at;
    double magnification, g, through, light;
};

struct list {
    const struct kd_picture *picture;
    struct kd_sky_rays rays;
    struct kd_star_name names[KD_STAR_NAMES];
    /* for each star, the largest solid angle of a pixel, in sr, at which the star is visible */
    double most[KD_STAR_NAMES];
    struct kd_vec places[KD_STAR_NAMES]; /* directions of the stars in the frame of the lens map */
    size_t n_stars;
    struct image *images;
    /* n: number of images; room: number of images for which there is room; n_rim: number of images of the rim, which
     * come first */
    size_t n, room, n_rim;
};

/* Requests the directions in which rays end, and the optical depth of the disk in front of the sky. */
static enum kd_status draws(struct kd_scene *scene, struct kd_error *error)
{
    const bool disk = scene->disk.model != KD_DISK_NONE;
    if (scene->sky.model != KD_SKY_CATALOGUE)
        return kd_error_field(error, "/sky/model",
                              "sky.model must be \"catalogue\", because only its stars have names");
    if (scene->camera.projection == KD_PROJECTION_RING)
        return kd_error_field(error, "/camera/projection",
                              "camera.projection is \"ring\", whose stars have no names; it must be another");
    if (kd_scene_has_tile(scene))
        return kd_error_field(
            error, "/image/tile/width",
            "image.tile.width is %d; for names of stars it must be 0, because positions are those of the whole picture",
            scene->tile.width);
    if (scene->camera.stereo == KD_STEREO_PAIR)
        return kd_error_field(error, "/camera/stereo",
                              "camera.stereo is \"pair\"; for names of stars it must be \"none\", because positions "
                              "are those of one eye");
    if (scene->camera.stereo != KD_STEREO_NONE)
        return kd_error_field(error, "/camera/stereo",
                              "camera.stereo is \"pair\"; for names of stars it must be \"none\"");
    scene->image.samples = 1;
    scene->image.critical_factor = 1;
    scene->image.layers = (struct kd_words) { 2, { { KD_LAYER_sky_theta, -1 }, { KD_LAYER_sky_phi, -1 } } };
    for (int order = 0; disk && order < scene->accuracy.orders; order++)
        scene->image.layers.at[scene->image.layers.count++] =
            (struct kd_numbered_word) { KD_LAYER_optical_depth, (int16_t)order };
    return KD_OK;
}

/* Lists the stars that have names. The transpose of kd_sky_rotation turns their directions into the frame of the
  rays. */
static void name_stars(struct list *list)
{
    const struct kd_scene *scene = list->picture->scene;
    const struct kd_rotation galactic = kd_rotation_galactic(), to = kd_sky_rotation(scene);
    struct kd_rotation back;
    const char *text = NULL;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            back.m[i][j] = to.m[j][i];
    for (kd_star_name_next(&text, &list->names[0]); text; kd_star_name_next(&text, &list->names[list->n_stars])) {
        const struct kd_catalogue_star star = kd_catalogue_star(list->names[list->n_stars].place);
        if (star.magnitude > scene->sky.limit_mag)
            break;
        const struct kd_vec n = kd_rotate(&galactic, kd_sky_direction(star.ra, star.dec));
        list->places[list->n_stars] = kd_rotate(&back, n);
        list->most[list->n_stars] = kd_star_flux(star.magnitude) / KD_STAR_LEAST;
        if (++list->n_stars == KD_STAR_NAMES)
            break;
    }
}

/* Solid angle in the picture of the square between four rays. It uses the same stencil as the measured solid angle of
 * the sky, so that the projection cancels in the ratio of the two solid angles. NAN at infinity, where parallel rays
 * have no solid angle. */
static double pixel_angle(const struct kd_camera_exact *camera, const struct kd_star_stencil *by)
{
    const double h = 1e-3, x0 = by->x, y0 = by->y;
    const bool there = by->across == 0;
    double n[3], a[3], b[3], from_a[3], from_b[3];
    if (camera->sight == KD_SIGHT_PLANE)
        return NAN;
    kd_camera_direction(camera, x0, y0, n);
    kd_camera_direction(camera, there ? x0 + h : x0 + by->across, y0, a);
    kd_camera_direction(camera, x0, there ? y0 + h : y0 + by->down, b);
    kd_camera_direction(camera, there ? x0 - h : x0, y0, from_a);
    kd_camera_direction(camera, x0, there ? y0 - h : y0, from_b);
    for (int i = 0; i < 3; i++)
        a[i] -= from_a[i], b[i] -= from_b[i];
    const double area = fabs(n[0] * (a[1] * b[2] - a[2] * b[1]) + n[1] * (a[2] * b[0] - a[0] * b[2]) +
                             n[2] * (a[0] * b[1] - a[1] * b[0]));
    return there ? area / (4 * h * h) : area;
}

/* Transmission of the disk, over all crossings of the nearest ray. */
static double through(const struct kd_picture *picture, size_t pixel)
{
    double depth = 0;
    char name[KD_LAYER_NAME];
    for (int order = 0; order < picture->scene->accuracy.orders; order++) {
        kd_layer_name((struct kd_plan_layer) { KD_LAYER_optical_depth, (int16_t)order }, name);
        const struct kd_layer *layer = kd_frame_layer(picture->frame, name);
        double here = layer ? ((const float *)layer->data)[pixel] : NAN;
        depth += here > 0 ? here : 0;
    }
    return exp(-depth);
}

static bool is_there(const struct list *list, const struct kd_star_image *image)
{
    for (size_t i = 0; i < list->n_rim; i++) {
        const struct kd_star_image *o = &list->images[i].at;
        if (o->star == image->star && o->mirrored == image->mirrored && hypot(o->x - image->x, o->y - image->y) < APART)
            return true;
    }
    return false;
}

/* Converts a place of the map to a place of the picture. Returns false if that place is outside the picture. The map
 * of a picture of all directions has one column and two rows more (find()). An image beyond a pole is in the picture
 * at the equivalent place. */
static bool place_of(const struct list *list, struct kd_star_image *image)
{
    const double width = list->picture->frame->width, height = list->picture->frame->height, edge = 0.5;
    if (list->rays.camera.sight == KD_SIGHT_SPHERE)
        image->x -= image->x >= width - edge ? width : 0;
    return image->x >= -edge && image->x < width - edge && image->y >= -edge && image->y < height - edge;
}

/* Adds an image, unless pictures leave it out. */
static enum kd_status add(void *user, const struct kd_star_image *found)
{
    struct list *list = user;
    const uint32_t width = list->picture->frame->width;
    const double flux = kd_star_flux(kd_catalogue_star(list->names[found->star].place).magnitude), edge = 0.5;
    const double magnification = pixel_angle(&list->rays.camera, &found->by) / found->solid_angle;
    struct kd_star_image at = *found;
    if (!place_of(list, &at))
        return KD_OK;
    const double shown = pixel_angle(&list->rays.camera, &(struct kd_star_stencil) { .x = at.x, .y = at.y });
    /* the solid angle at the image's place */
    at.solid_angle = isnan(magnification) ? at.solid_angle : shown / magnification;
    if (at.solid_angle > list->most[at.star] || is_there(list, &at))
        return KD_OK;
    const uint32_t x = (uint32_t)(at.x + edge), y = (uint32_t)(at.y + edge);
    struct kd_camera_label label;
    if (list->n == list->room) {
        size_t room = list->room ? 2 * list->room : 256;
        struct image *images = realloc(list->images, room * sizeof *images);
        if (!images)
            return KD_ENOMEM;
        list->images = images;
        list->room = room;
    }
    kd_camera_label(&list->rays.camera, x, y, &label);
    struct image image = {
        .at = at,
        .magnification = magnification,
        .g = 1 / label.energy,
        .through = through(list->picture, (size_t)y * width + x),
    };
    const double g2 = image.g * image.g;
    image.light = flux * g2 * g2 * image.through / at.solid_angle;
    list->images[list->n++] = image;
    return KD_OK;
}

static int brighter(const void *a, const void *b)
{
    double p = ((const struct image *)a)->light, q = ((const struct image *)b)->light;
    return (p < q) - (p > q);
}

/* The rays of the picture, one for each pixel. around: the picture shows all directions. Its first column is then
 * repeated after the last. If the number of columns is even, a row is also added beyond each pole: the adjacent row
 * shifted by half a turn. */
struct picture_map {
    const float *theta, *phi;
    double azimuth;
    uint32_t width, height;
    bool around;
    const struct kd_sky_rays *rays;
    const struct kd_rim *rim;
};

static bool is_rims(const struct picture_map *m, double x, double y)
{
    double look[3];
    kd_camera_look(&m->rays->camera, x, y, look);
    return m->rim->there && kd_rim_off(m->rim, look) < INNER * m->rim->full;
}

static void row_of(const void *of, uint32_t row, struct kd_vec *out)
{
    const struct picture_map *m = of;
    const bool beyond = m->around && (row == 0 || row == m->height + 1);
    const uint32_t y = !m->around || row == 0 ? row : row == m->height + 1 ? m->height - 1 : row - 1;
    const uint32_t turned = beyond ? m->width / 2 : 0;
    for (uint32_t x = 0; x < m->width + m->around; x++) {
        const uint32_t column = (x + turned) % m->width;
        const size_t o = (size_t)y * m->width + column;
        const double theta = m->theta[o], phi = m->phi[o] - m->azimuth;
        out[x] = (struct kd_vec) { sin(theta) * cos(phi), sin(theta) * sin(phi), cos(theta) };
        if (is_rims(m, column, y) || (beyond && m->width % 2))
            out[x].x = out[x].y = out[x].z = NAN;
    }
}

static bool exact(const void *of, double x, double y, struct kd_vec *out)
{
    const struct picture_map *m = of;
    double look[3], n[3];
    kd_camera_look(&m->rays->camera, x, y - m->around, look);
    if (!kd_sky_ray(m->rays, look, n))
        return false;
    *out = (struct kd_vec) { n[0], n[1], n[2] };
    return true;
}

/* Converts an image from the map's rows to the picture's rows, and adds it. */
static enum kd_status add_around(void *user, const struct kd_star_image *found)
{
    struct kd_star_image image = *found;
    image.y -= 1;
    image.by.y -= 1;
    return add(user, &image);
}

static enum kd_status find(struct list *list, const struct kd_layer *theta, const struct kd_layer *phi,
                           struct kd_error *error)
{
    const struct kd_scene *scene = list->picture->scene;
    const struct kd_frame *frame = list->picture->frame;
    const bool around = list->rays.camera.sight == KD_SIGHT_SPHERE;
    struct kd_rim rim;
    const struct picture_map rays = {
        theta->data, phi->data, scene->camera.azimuth_deg * (M_PI / 180), frame->width, frame->height, around,
        &list->rays, &rim,
    };
    const struct kd_sky_map map = {
        .width = frame->width + around,
        .height = frame->height + (around ? 2 : 0),
        .coarse = COARSE,
        .most = list->most,
        .of = &rays,
        .row = row_of,
        .exact = exact,
    };
    enum kd_status status;
    kd_rim_of(scene, &rim);
    KD_TRY(kd_rim_images(scene, &rim, list->places, list->most, list->n_stars, add, list, error));
    list->n_rim = list->n;
    KD_TRY(kd_star_images(&map, list->places, list->n_stars, around ? add_around : add, list));
    if (list->n)
        qsort(list->images, list->n, sizeof *list->images, brighter);
done:
    return status;
}

/* Writes four digits. */
static void write_number(struct kd_json *json, const char *name, double value)
{
    char text[32];
    snprintf(text, sizeof text, "%.4g", value);
    kd_json_number(json, name, strtod(text, NULL));
}

static void write_image(struct kd_json *json, const struct list *list, const struct image *image)
{
    const struct kd_star_name *name = &list->names[image->at.star];
    const double g2 = image->g * image->g, magnitude = kd_catalogue_star(name->place).magnitude;
    kd_json_object(json, NULL);
    kd_json_string(json, "name", name->name);
    kd_json_string(json, "designation", name->designation);
    kd_json_number(json, "magnitude", magnitude);
    kd_json_number(json, "x", round(100 * (image->at.x + 0.5)) / 100);
    kd_json_number(json, "y", round(100 * (image->at.y + 0.5)) / 100);
    write_number(json, "x_by_azimuth", image->at.x_by_azimuth * (M_PI / 180));
    write_number(json, "y_by_azimuth", image->at.y_by_azimuth * (M_PI / 180));
    write_number(json, "magnification", image->magnification);
    write_number(json, "g", image->g);
    write_number(json, "through", image->through);
    write_number(json, "seen_magnitude", magnitude - 2.5 * log10(image->magnification * g2 * g2 * image->through));
    kd_json_bool(json, "mirrored", image->at.mirrored);
    kd_json_end(json);
}

static enum kd_status write_list(const struct list *list, struct kd_buffer *out)
{
    struct kd_json json = kd_json_begin(out);
    kd_json_object(&json, NULL);
    kd_json_number(&json, "width", list->picture->frame->width);
    kd_json_number(&json, "height", list->picture->frame->height);
    kd_json_number(&json, "azimuth_deg", list->picture->scene->camera.azimuth_deg);
    kd_json_number(&json, "found", (double)list->n);
    kd_json_array(&json, "images");
    for (size_t i = 0; i < list->n && i < MOST; i++)
        write_image(&json, list, &list->images[i]);
    kd_json_end(&json);
    kd_json_end(&json);
    return kd_json_finish_line(&json);
}

static enum kd_status encode(const struct kd_picture *picture, enum kd_effort effort, void **memory,
                             struct kd_buffer *out, struct kd_error *error)
{
    const struct kd_frame *frame = picture->frame;
    const struct kd_layer *theta = kd_frame_layer(frame, "sky_theta"), *phi = kd_frame_layer(frame, "sky_phi");
    struct list *list = calloc(1, sizeof *list);
    enum kd_status status = list ? KD_OK : KD_ENOMEM;
    (void)effort, (void)memory;
    if (!theta || !phi)
        KD_TRY(kd_error_set(error, KD_EINVAL, "the frame has no directions of its rays on the sky"));
    KD_TRY(status);
    list->picture = picture;
    list->rays = kd_sky_rays_of(picture->scene);
    name_stars(list);
    KD_TRY(find(list, theta, phi, error));
    KD_TRY(write_list(list, out));
done:
    if (list)
        free(list->images);
    free(list);
    return status == KD_ENOMEM ? kd_error_set(error, status, "out of memory for a list of stars") : status;
}

const struct kd_format kd_format_stars = {
    .name = "stars",
    .media_type = "application/vnd.kerrd.stars+json",
    .magic = "",
    .carries = KD_CARRIES_LAYERS,
    .draws = draws,
    .encode = encode,
};
