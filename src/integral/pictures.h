/* The pictures of a scene that an integral needs, and what is read from each. Pure, any thread. */
#ifndef KD_INTEGRAL_PICTURES_H
#define KD_INTEGRAL_PICTURES_H

#include "integral/request.h"
#include "render/output/format.h"

enum { KD_INTEGRAL_USUAL_FREQUENCIES = 13 };
/* pixels per side of the finer picture divided by those of the coarse one; not 2, because the aliases of both grids
 * could then coincide */
#define KD_INTEGRAL_FINER 1.5

/* The error of the coarse picture is this factor times the difference between the coarse and the finer picture. The
 * error falls as 1/(pixels per side)^2, so the factor is 1/(1 - 1/1.5^2). */
#define KD_INTEGRAL_OF_DIFFERENCE (1 / (1 - 1 / (KD_INTEGRAL_FINER * KD_INTEGRAL_FINER)))

/* Number of pictures that a checked request needs; 0: it is not made of pictures. */
unsigned kd_integral_pictures(const struct kd_integral_request *request);
/* The scene of a picture, for the format below. If the error is to be estimated, every second picture is a finer
 * version of the picture before it. */
struct kd_scene kd_integral_scene(const struct kd_integral_request *request, unsigned picture);
bool kd_integral_is_finer(const struct kd_integral_request *request, unsigned picture);

/* The format in which each picture is read. Visibility: maps as floats, first the total light, then each image order.
 * Spectrum: the flux in Jy as a double. */
const struct kd_format *kd_integral_picture_format(enum kd_integral what);

/* Plans a picture's scene. Matter normalised to a flux has the same density in all pictures: that of the requested
 * scene, independent of the pictures' pixels. */
enum kd_status kd_integral_plan(const struct kd_integral_request *request, struct kd_scene *scene,
                                const struct kd_capacity *capacity, struct kd_plan *out, struct kd_error *error);

/* Adds to an error about a picture the name of the first set that uses this picture, KD_EINVAL. Does nothing for
 * other requests and errors. */
void kd_integral_name_set(const struct kd_integral_request *request, unsigned picture, enum kd_status status,
                          struct kd_error *error);

/* Replaces the request's scene by the default scene. A request for a spectrum of a disk becomes one for a spectrum of a
 * volume. */
enum kd_status kd_integral_make_scene(struct kd_integral_request *request, struct kd_error *error);

/* For a picture seen from far away: the size of a pixel in radians, and the longest baseline that pixels of this
 * size resolve. */
double kd_integral_pixel(const struct kd_scene *scene);
double kd_integral_nyquist_gl(const struct kd_scene *scene);

#endif
