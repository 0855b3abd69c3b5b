/* Explains the light of one pixel. Each of its rays is traced in closed form, and the picture's own kernel reports what
 * each emitter added to that ray (frame/probe.h). The document has both results, the difference between them, and the
 * path of the middle ray for drawing. The plan of the picture names the pixel (kd_plan_report.probe). Any thread.
 *
 * Lengths and times are in M, angles in radians, frequencies as measured by the observer. docs/pixel.md describes the
 * document. */
#ifndef KD_RENDER_EXPLAIN_EXPLAIN_H
#define KD_RENDER_EXPLAIN_EXPLAIN_H

#include "render/explain/motion.h"
#include "render/frame/probe.h"
#include "render/output/format.h"
#include "render/rays/rays.h"
#include "render/view/camera.h"

struct kd_explained {
    const struct kd_probed_pixel *pixel;
    const struct kd_probed_ray *told; /* the picture's report on this ray */
    /* factor of the ray's light in the pixel's light: 1 divided by the number of rays; 0: the ray is not one of those
     * whose mean is the pixel's light */
    double weight;
    const char *eye;              /* "left" or "right"; NULL: the picture is not a pair */
    struct kd_scene scene;        /* scene of this eye */
    struct kd_camera_label label; /* energy: E at infinity divided by the energy that the observer measures */
    struct kd_ray_motion motion;
    /* crossings in closed form, with azimuths of the scene, and g as measured by the observer */
    struct kd_ray_crossing crossings[KD_RAYS_MAX_ORDERS];
    struct kd_ray_end end;
    struct kd_ray_path_frame frame;
    struct kd_ray_path path; /* path of the ray; only the middle ray's path has places */
    /* largest relative error in 1/r of the picture's crossings; 1: the picture has a crossing that the closed form
     * lacks; NAN: the picture has no crossing */
    double picture_error;
    double shown[3]; /* displayed value of the pixel, 0 to 1 */
    char why[240];   /* where the ray ends and why, and what hides that end, if anything does */
};

/* kd_explain explains the middle ray. kd_explain_each explains one of the rays whose mean is the pixel's light, without
 * its path. Both functions return KD_EINVAL for a ray that has no closed form. Call kd_explained_finish in any case. */
enum kd_status kd_explain(const struct kd_picture *picture, struct kd_explained *out, struct kd_error *error);
enum kd_status kd_explain_each(const struct kd_picture *picture, uint32_t number, struct kd_explained *out,
                               struct kd_error *error);
/* The point at which the ray passes through the picture, in pixels. */
void kd_explained_ray_at(const struct kd_picture *picture, const struct kd_explained *explained, double out[2]);
/* Relative difference between the mean of the rays' light and the pixel's light. */
double kd_explained_sum_error(const struct kd_probed_pixel *pixel);
/* Stokes I, Q, U and V of a ray as it arrives; I is the luminance of all its light. Returns how many of the four are
 * known: 4 for polarised volumes, 3 (without V) if only light of the plane is polarised, 0 if the scene is not
 * polarised. */
enum { KD_EXPLAINED_STOKES = 4 };
int kd_explained_stokes(const struct kd_probed_ray *ray, double out[KD_EXPLAINED_STOKES]);
/* kd_explained_evpa: angle of the electric field. kd_explained_polarized: degree of polarisation. NAN if undefined. */
double kd_explained_evpa(const double stokes[3]);
double kd_explained_polarized(const double stokes[3]);
/* Mean delay of the light from volumes, weighted by the light that arrives. NAN if there is none, or if the observer
 * is inside the horizon, where a distant clock is meaningless. */
double kd_explained_along_delay(const struct kd_explained *explained);
void kd_explained_finish(struct kd_explained *explained);

/* The reported place at the crossing of this order. NULL if the crossing's light is blocked, or if nothing emits
 * light there. */
const struct kd_probed_place *kd_explained_place(const struct kd_explained *explained, uint32_t order);
/* True if there is gas with a known temperature and angle; place may be NULL. */
bool kd_explained_has_gas(const struct kd_probed_place *place);
/* Velocity of the disk's gas at a crossing outside the horizon, in units of c. A local observer of zero angular
 * momentum measures it. speed: magnitude of the velocity; approach: its component along the light towards the camera.
 * Inside the ISCO the gas keeps the E and L of the ISCO. */
struct kd_gas_velocity { double speed, approach; };
struct kd_gas_velocity kd_explained_velocity(const struct kd_explained *explained, const struct kd_ray_crossing *at);
/* Boyer-Lindquist azimuth in the hole's own frame, in (-pi, pi]. */
double kd_explained_azimuth(const struct kd_explained *explained, double phi);

/* Writes the explanation as a table in plain text. Returns KD_EINVAL as in kd_explain. */
enum kd_status kd_explain_text(const struct kd_picture *picture, struct kd_buffer *out, struct kd_error *error);

/* The document of POST /v1/pixel; not among kd_formats, because it is about one pixel. */
extern const struct kd_format kd_format_pixel;
/* Sets the pixel of a plan from "X,Y", in pixels from the picture's upper left corner. Returns KD_EINVAL if the text
 * does not name a place in the picture. */
enum kd_status kd_explain_at(const char *text, struct kd_plan *plan, struct kd_error *error);
/* Reduces the scene and its plan to the plan's pixel with a margin (render/plan/tile.h). Does so only if the pixel does
 * not depend on the rest of the picture: the exposure must be a number, and there must be no bloom and no beam.
 * Otherwise leaves scene and plan unchanged. */
enum kd_status kd_explain_narrow(const struct kd_capacity *capacity, struct kd_scene *scene, struct kd_plan *plan,
                                 struct kd_error *error);
/* Requests additional output by a keyword. The only keyword is "steps", for the engine's steps along the middle ray.
 * Returns KD_EINVAL for any other text. */
enum kd_status kd_explain_trace(const char *text, struct kd_plan *plan, struct kd_error *error);

#endif
