/* Describes the motion of one ray: the case of its roots in r and in theta, its turning points, why it ends, and points
 * of its path. The description uses the closed form of physics/null/null_geodesic.h and the steps of
 * physics/null/null_course.h, for `kerrd pixel` and `kerrd rays --trace`. Pure, any thread. */
#ifndef KD_RENDER_EXPLAIN_MOTION_H
#define KD_RENDER_EXPLAIN_MOTION_H

#include "base/json.h"
#include "physics/null/null_course.h"
#include "physics/null/null_quartic.h"
#include "render/rays/rays.h"

#define KD_PATH_PLACES 4000 /* largest number of places of a path */

struct kd_ray_motion {
    struct kd_null_ray ray;
    /* true if the observer is on or inside the horizon, so that azimuths and times of the path are ingoing
     * (null_course.h) */
    bool within;
    double lambda, eta; /* L/E, Q/E^2 */
    struct kd_null_roots roots;
    const char *radial_case;   /* "I" to "IV" */
    double root[4][2];         /* real and imaginary part of each root */
    double horizon, turning_r; /* turning_r: turning point of this ray outside the horizon, NAN if the ray has none */
    /* "ordinary": oscillates across the plane; "vortical": stays on one side of it; "fixed": theta is constant */
    const char *polar_case;
    double polar_root[2]; /* roots of the polar potential, as cos^2(theta); the second is NAN without spin */
    double theta[2];      /* range of theta */
};

/* All values of radial_case and polar_case by index; NULL after the last. */
const char *kd_ray_radial_case(size_t i);
const char *kd_ray_polar_case(size_t i);

struct kd_ray_motion kd_ray_motion_of(const struct kd_null_ray *ray);
/* Writes one sentence on why a ray with this fate ends as it does. Returns its length. */
int kd_ray_motion_why(const struct kd_ray_motion *motion, enum kd_ray_fate fate, char *out, size_t size);

/* Computes the requested crossings and the end of a ray that starts inside the horizon. For rays that start outside,
 * kd_rays_closed does this. phi is counted from the observer's ingoing azimuth; for places outside the horizon it is
 * Boyer-Lindquist. delay is in ingoing time. There is no error estimate. Returns KD_OK or KD_ENOMEM. */
enum kd_status kd_ray_within(const struct kd_ray_motion *motion, bool reversed, struct kd_ray_crossing *crossings,
                             struct kd_ray_end *end, struct kd_error *error);

/* The frame in which a ray's azimuths and times are given: the observer's azimuth and time. If the ray's energy at
 * infinity is negative, the frame rotates the other way (view/camera.h). */
struct kd_ray_path_frame {
    double azimuth, twist;
    bool reversed;
};

struct kd_ray_path {
    struct kd_null_course course;
    struct kd_null_place *places; /* malloc'd */
    struct kd_ray_path_frame frame;
    double spin;
    bool ingoing; /* true if azimuth and delay are ingoing */
    /* largest relative error in r of the path's crossings; NAN: there is nothing to compare */
    double error;
};

/* Computes the part of the path that is worth drawing, and compares its crossings with the n given crossings.
 * Returns KD_OK or KD_ENOMEM. Call kd_ray_path_finish in any case. */
enum kd_status kd_ray_path_draw(const struct kd_ray_motion *motion, const struct kd_ray_path_frame *frame,
                                const struct kd_ray_crossing *crossings, size_t n, struct kd_ray_path *out,
                                struct kd_error *error);
void kd_ray_path_finish(struct kd_ray_path *path);
/* kd_ray_path_phi, kd_ray_path_delay: azimuth and delay of a place in the frame. kd_ray_path_at: its coordinates (x, y)
 * = sqrt(r^2 + a^2) sin(theta) (cos(azimuth), sin(azimuth)) and z = r cos(theta). */
double kd_ray_path_phi(const struct kd_ray_path_frame *frame, double phi);
double kd_ray_path_delay(const struct kd_ray_path_frame *frame, double delay);
void kd_ray_path_at(const struct kd_ray_path *path, const struct kd_null_place *place, double out[3]);
/* A row of the path: one number for each column's name. */
#define KD_PATH_COLUMNS 8
extern const char *const kd_ray_path_columns[KD_PATH_COLUMNS];
void kd_ray_path_row(const struct kd_ray_path *path, size_t i, double out[KD_PATH_COLUMNS]);

/* kd_ray_motion_json writes the members `radial` and `polar` of the current object, kd_ray_path_json the member `path`.
 * kd_ray_motion_text appends two lines of plain text. */
void kd_ray_motion_json(struct kd_json *json, const struct kd_ray_motion *motion);
void kd_ray_path_json(struct kd_json *json, const struct kd_ray_path *path);
enum kd_status kd_ray_motion_text(const struct kd_ray_motion *motion, struct kd_buffer *out);

#endif
