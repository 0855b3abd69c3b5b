/* Some integrals are made of pictures of a scene: these are the pictures, and what is taken from each. Pure, any
 * thread. */
#ifndef KD_INTEGRAL_PICTURES_H
#define KD_INTEGRAL_PICTURES_H

#include "integral/request.h"
#include "render/output/format.h"

enum { KD_INTEGRAL_USUAL_FREQUENCIES = 13 };
#define KD_INTEGRAL_FINER \
    1.5 /* times as many pixels along each side: not 2, where what a coarse grid mistakes for short baselines could \
           fall on the same place */

/* What a picture is off by falls as the square of its pixels: of that the difference from a finer one, 1.5 times as
 * fine, is 1 - 1/1.5^2. */
#define KD_INTEGRAL_OF_DIFFERENCE (1 / (1 - 1 / (KD_INTEGRAL_FINER * KD_INTEGRAL_FINER)))

/* A request that has been checked needs so many pictures; 0: it is made of none. */
unsigned kd_integral_pictures(const struct kd_integral_request *request);
/* The scene of one, as a picture of the format below is made of it. With `check` finer every other one is finer, and
 * tells the error of the one before. */
struct kd_scene kd_integral_scene(const struct kd_integral_request *request, unsigned picture);
bool kd_integral_is_finer(const struct kd_integral_request *request, unsigned picture);

/* What is taken from each: of a visibility maps, as floats, all light and then each image order; of a spectrum its
 * flux in Jy, as a double. */
const struct kd_format *kd_integral_picture_format(enum kd_integral what);

/* The plan of a picture's scene. Matter of a given flux has the same density in all of them: that of the scene as it
 * was asked, whatever their pixels make of its shape. */
enum kd_status kd_integral_plan(const struct kd_integral_request *request, struct kd_scene *scene,
                                const struct kd_capacity *capacity, struct kd_plan *out, struct kd_error *error);

/* Gives the scene that the request begins with: the default one, in place of what it has. A spectrum is that of a
 * volume from then on. */
enum kd_status kd_integral_make_scene(struct kd_integral_request *request, struct kd_error *error);

/* Of a picture as above, seen from far away: radians from a pixel to the next, and the longest baseline that pixels
 * so wide tell. */
double kd_integral_pixel(const struct kd_scene *scene);
double kd_integral_nyquist_gl(const struct kd_scene *scene);

#endif
