/* Explains the light of one pixel. Each of its rays is traced in closed form, and the picture's own kernel reports
 * what each emitter added to that ray (frame/tell.h). The document has both, their difference, and the path of the
 * middle ray for drawing. The plan of the picture names the pixel (kd_plan.told). Any thread.
 *
 * Lengths and times in M, angles in radians, frequencies as the observer measures them. docs/pixel.md describes the
 * document. */
#ifndef KD_RENDER_EXPLAIN_EXPLAIN_H
#define KD_RENDER_EXPLAIN_EXPLAIN_H

#include "render/explain/motion.h"
#include "render/frame/tell.h"
#include "render/output/format.h"
#include "render/rays/rays.h"
#include "render/view/camera.h"

struct kd_explained {
    const struct kd_told *pixel;
    const struct kd_told_ray *told; /* which of its rays this is */
    double weight;                  /* that its light has in the pixel's: 0, or 1 over the number of rays */
    const char *eye;                /* "left", "right"; NULL: the picture is of one eye */
    struct kd_scene scene;          /* that of this eye */
    struct kd_camera_label label;   /* energy: E at infinity by what the observer measures */
    struct kd_ray_motion motion;
    struct kd_ray_crossing crossings[KD_RAYS_MAX_ORDERS]; /* by closed form, as the scene has azimuths, and g as the
                                                             observer measures it */
    struct kd_ray_end end;
    struct kd_ray_path_frame frame;
    struct kd_ray_path path; /* of the middle ray; of others it has no places */
    double picture_error;    /* of the picture's, likewise; 1: it has another number of them */
    double shown[3];         /* the pixel as it is shown, 0 to 1 */
    char why[240];           /* where the ray ends and why, a sentence */
};

/* The middle ray; or one of those that the pixel's light is the mean of, without its path. KD_EINVAL for a ray
 * without a course in closed form. Finish *out in any case. */
enum kd_status kd_explain(const struct kd_picture *picture, struct kd_explained *out, struct kd_error *error);
enum kd_status kd_explain_each(const struct kd_picture *picture, uint32_t number, struct kd_explained *out,
                               struct kd_error *error);
/* Where the ray goes through the picture, in pixels. */
void kd_explained_ray_at(const struct kd_picture *picture, const struct kd_explained *explained, double out[2]);
/* How far the mean of the rays' light is off the pixel's, relative to that. */
double kd_explained_sum_error(const struct kd_told *pixel);
/* Stokes I, Q, U and V of a ray as it arrives, I the luminance of all its light; how many of them are known, without
 * V where only light of the plane is polarised; 0: none is in the scene. */
enum { KD_EXPLAINED_STOKES = 4 };
int kd_explained_stokes(const struct kd_told_ray *ray, double out[KD_EXPLAINED_STOKES]);
/* The angle of the electric field, and the part of the light that is polarised; NAN where there is none. */
double kd_explained_evpa(const double stokes[3]);
double kd_explained_polarized(const double stokes[3]);
/* The delay of light from volumes, their mean over what arrives; NAN: there is no light of any, or the observer is
 * within the horizon, where a far clock tells no time. */
double kd_explained_along_delay(const struct kd_explained *explained);
void kd_explained_finish(struct kd_explained *explained);

/* A place of the crossing of that order in what is told, NULL: its light did not come through, or nothing shines. */
const struct kd_told_place *kd_explained_place(const struct kd_explained *explained, uint32_t order);
/* Says whether gas lies there, of whose temperature and angle something can be told; place may be NULL. */
bool kd_explained_has_gas(const struct kd_told_place *place);
/* Boyer-Lindquist azimuth of the hole's own frame in (-pi, pi]. */
double kd_explained_azimuth(const struct kd_explained *explained, double phi);

/* A table for eyes. KD_EINVAL as kd_explain. */
enum kd_status kd_explain_text(const struct kd_picture *picture, struct kd_buffer *out, struct kd_error *error);

/* The document of POST /v1/pixel: not among kd_formats, for it is of one pixel. */
extern const struct kd_format kd_format_pixel;
/* Names the pixel at a place "X,Y" of the picture, in pixels from its upper left corner, in a plan of it. KD_EINVAL
 * for what is no place of it. */
enum kd_status kd_explain_at(const char *text, struct kd_plan *plan, struct kd_error *error);
/* Makes the scene and its plan those of that pixel and a margin round it alone, where nothing of the pixel depends on
 * the rest of the picture (render/plan/tile.h): with an exposure that is a number, no glare, no beam. Else it leaves
 * them. */
enum kd_status kd_explain_narrow(const struct kd_capacity *capacity, struct kd_scene *scene, struct kd_plan *plan,
                                 struct kd_error *error);
/* What else is told, by a word: "steps", those of the engine along the middle ray. KD_EINVAL for another. */
enum kd_status kd_explain_trace(const char *text, struct kd_plan *plan, struct kd_error *error);

#endif
