/* The motion of one ray: the case of its roots in r and in theta, its turning points, why it ends, and points of its
 * path. From the closed form of physics/null/null_geodesic.h and the steps of physics/null/null_course.h, for `kerrd
 * pixel` and `kerrd rays --trace`. Pure, any thread. */
#ifndef KD_RENDER_EXPLAIN_MOTION_H
#define KD_RENDER_EXPLAIN_MOTION_H

#include "base/json.h"
#include "physics/null/null_course.h"
#include "physics/null/null_quartic.h"
#include "render/rays/rays.h"

#define KD_PATH_PLACES 4000 /* at most */

struct kd_ray_motion {
    struct kd_null_ray ray;
    bool within; /* the observer is not outside the horizon: azimuths and times of the path are ingoing (null_course.h)
                  */
    double lambda, eta; /* L/E, Q/E^2 */
    struct kd_null_roots roots;
    const char *radial_case;   /* "I" to "IV" */
    double root[4][2];         /* real and imaginary part */
    double horizon, turning_r; /* turning_r: of this ray outside the horizon, NAN if it has none */
    const char *polar_case; /* "ordinary": it swings across the plane; "vortical": on one side of it; "fixed": theta is
                               constant */
    double polar_root[2];   /* of the polar potential, as cos^2(theta); the second is NAN without spin */
    double theta[2];        /* what it swings between */
};

/* What radial_case and polar_case can be, in a list; NULL behind the last. */
const char *kd_ray_radial_case(size_t i);
const char *kd_ray_polar_case(size_t i);

struct kd_ray_motion kd_ray_motion_of(const struct kd_null_ray *ray);
/* Why a ray of that fate ends as it does, in a sentence. Returns its length. */
int kd_ray_motion_why(const struct kd_ray_motion *motion, enum kd_ray_fate fate, char *out, size_t size);

/* Crossings, as many as the ray wants, and the end of a ray from within, as kd_rays_closed has those from outside:
 * phi is Boyer-Lindquist of places outside the horizon less the observer's ingoing one, delay in ingoing time, no
 * error is known. KD_ENOMEM. */
enum kd_status kd_ray_within(const struct kd_ray_motion *motion, bool reversed, struct kd_ray_crossing *crossings,
                             struct kd_ray_end *end, struct kd_error *error);

/* What azimuths and times of a ray are counted by: those of the observer, and whether its energy at infinity is
 * below 0, so that it goes round the other way (view/camera.h). */
struct kd_ray_path_frame {
    double azimuth, twist;
    bool reversed;
};

struct kd_ray_path {
    struct kd_null_course course;
    struct kd_null_place *places; /* malloc'd */
    struct kd_ray_path_frame frame;
    double spin;
    bool ingoing; /* azimuth and delay are */
    double error; /* of its crossings, relative in r, at worst; NAN: it has none, or nothing to be held against */
};

/* The path, as far as it is worth drawing, with its crossings held against the n that are given. KD_ENOMEM. Finish
 * *out in any case. */
enum kd_status kd_ray_path_draw(const struct kd_ray_motion *motion, const struct kd_ray_path_frame *frame,
                                const struct kd_ray_crossing *crossings, size_t n, struct kd_ray_path *out,
                                struct kd_error *error);
void kd_ray_path_finish(struct kd_ray_path *path);
/* Azimuth and delay as the frame has them; and a place: x, y = sqrt(r^2 + a^2) sin(theta) (cos, sin)(azimuth), z = r
 * cos(theta). */
double kd_ray_path_phi(const struct kd_ray_path_frame *frame, double phi);
double kd_ray_path_delay(const struct kd_ray_path_frame *frame, double delay);
void kd_ray_path_at(const struct kd_ray_path *path, const struct kd_null_place *place, double out[3]);
/* A row of the path: as many numbers as there are names. */
#define KD_PATH_COLUMNS 8
extern const char *const kd_ray_path_columns[KD_PATH_COLUMNS];
void kd_ray_path_row(const struct kd_ray_path *path, size_t i, double out[KD_PATH_COLUMNS]);

/* Members `radial` and `polar`, and `path`, of the object at hand; and two lines for eyes. */
void kd_ray_motion_json(struct kd_json *json, const struct kd_ray_motion *motion);
void kd_ray_path_json(struct kd_json *json, const struct kd_ray_path *path);
enum kd_status kd_ray_motion_text(const struct kd_ray_motion *motion, struct kd_buffer *out);

#endif
