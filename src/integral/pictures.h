/* The pictures of a scene that an integral needs, and the data that are read from each picture. Pure, any thread. */
#ifndef KD_INTEGRAL_PICTURES_H
#define KD_INTEGRAL_PICTURES_H

#include "integral/request.h"
#include "render/output/format.h"

enum { KD_INTEGRAL_USUAL_FREQUENCIES = 13 };
/* ratio of the finer picture's pixels per side to the coarser picture's; not 2, because aliases of both grids could
 * then coincide */
#define KD_INTEGRAL_FINER 1.5

/* The error of the coarse picture is this factor times the difference between the two pictures. As the error decreases
 * with 1/(pixels per side)^2, the factor is 1/(1 - 1/1.5^2). */
#define KD_INTEGRAL_OF_DIFFERENCE (1 / (1 - 1 / (KD_INTEGRAL_FINER * KD_INTEGRAL_FINER)))

/* Number of pictures that a checked request needs; 0 if the integral needs none. */
unsigned kd_integral_pictures(const struct kd_integral_request *request);
/* The scene of a picture, in the format below. If the error is to be estimated, each even-numbered picture is followed
 * by a finer version of the same picture. */
struct kd_scene kd_integral_scene(const struct kd_integral_request *request, unsigned picture);
bool kd_integral_is_finer(const struct kd_integral_request *request, unsigned picture);

/* The format in which each picture is read. For a visibility: maps of floats, first the total light, then each image
 * order. For a spectrum: the flux in Jy as a double. */
const struct kd_format *kd_integral_picture_format(enum kd_integral what);

/* Plans a picture's scene. If matter is normalised to a flux, its density in all pictures is that of the requested
 * scene, and does not depend on the pictures' pixels. */
enum kd_status kd_integral_plan(const struct kd_integral_request *request, struct kd_scene *scene,
                                const struct kd_capacity *capacity, struct kd_plan *out, struct kd_error *error);

/* Adds the name of a set to a KD_EINVAL error about a picture: the first set that uses this picture. Leaves errors of
 * other requests and other kinds unchanged. */
void kd_integral_name_set(const struct kd_integral_request *request, unsigned picture, enum kd_status status,
                          struct kd_error *error);

/* Replaces the request's scene by the default scene. A request for the spectrum of a disk becomes a request for the
 * spectrum of a volume. */
enum kd_status kd_integral_make_scene(struct kd_integral_request *request, struct kd_error *error);

/* kd_integral_pixel: size of a pixel in radians, for a picture seen from far away. The next function: the longest
 * baseline that pixels of this size resolve. */
double kd_integral_pixel(const struct kd_scene *scene);
double kd_integral_nyquist_gl(const struct kd_scene *scene);

#endif
