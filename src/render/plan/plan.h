/* A plan: everything that rendering a scene requires, namely passes, specialisation constants, rays, bytes,
 * estimated time and approximations. Rendering executes the plan; admission control reads it. Any thread. */
#ifndef KD_RENDER_PLAN_PLAN_H
#define KD_RENDER_PLAN_PLAN_H

#include "base/buffer.h"
#include "base/error.h"
#include "render/plan/capacity.h"
#include "render/plan/cost.h"
#include "render/plan/lens_map.h"
#include "render/plan/light.h"
#include "render/plan/picture.h"
#include "render/plan/report.h"
#include "scene/scene.h"
#include "interface.h"

#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct kd_plan {
    struct kd_plan_picture picture;
    struct kd_plan_lens lens;
    struct kd_plan_light light;
    struct kd_plan_cost cost;
    struct kd_plan_report report;
};

/* scene must be valid (kd_scene_validate). Returns KD_ETOOBIG, with the size, if the picture does not fit. Returns
 * KD_EINVAL at /accuracy/... for an engine, precision or tolerance that is impossible with this device or camera. */
enum kd_status kd_plan_make(const struct kd_scene *scene, const struct kd_capacity *capacity, struct kd_plan *out,
                            struct kd_error *error);

/* Checks whether kd_plan_make would succeed, without listing the pixels at the critical curve, which takes
 * milliseconds for large pictures. With that list kd_plan_make may still return KD_ETOOBIG. */
enum kd_status kd_plan_check(const struct kd_scene *scene, const struct kd_capacity *capacity, struct kd_error *error);

/* A key for scenes that share a lens map, without a plan: scenes with equal keys share a lens map on any device. Scenes
 * with different keys may also share one, if two ways to request an accuracy have the same result. The only error is
 * KD_ENOMEM. */
enum kd_status kd_plan_lens_group(const struct kd_scene *scene, uint64_t *out);

/* The largest number of rays that one dispatch may leave undecided. The host traces them again in double
 * (frame/settle.c). The number is at most KD_GIVEN_MOST, so that the list of these rays is no larger than a band of
 * the lens map. */
uint64_t kd_plan_open_most(const struct kd_plan *plan);
/* Checks that there is memory for a finished plan, and for `more` bytes on the host. If there is not, returns
 * KD_ETOOBIG; the message states the limit. */
enum kd_status kd_plan_has_room(const struct kd_plan *plan, uint64_t more, const struct kd_capacity *capacity,
                                struct kd_error *error);

/* Time of a ray of the grid's map, which may be traced or interpolated, ns. */
static inline double kd_plan_map_ns(const struct kd_plan *plan)
{
    return plan->lens.interpolates > 0
               ? plan->cost.trace_ns * (fmin(1, KD_PLAN_FOLLOWED / sqrt((double)plan->lens.rays)) + 0.25)
               : plan->cost.trace_ns;
}

/* Number of rays in a list behind the light of a band, and bytes of the list. The list holds the rays that the march
 * could not complete, and the state of rays that continue (interface.h, KD_LOST_...). */
static inline uint32_t kd_plan_lost_most(const struct kd_plan *plan)
{
    return plan->light.march.steps ? plan->picture.width * plan->picture.band_rows : 0;
}
static inline uint64_t kd_plan_lost_bytes(uint64_t most) { return most ? 4 * (KD_LOST_RAYS - 1 + most) : 4; }

/* Sizes of further buffers for the light of stars, besides kd_plan_star_bytes. They hold pairs of a ray and a star,
 * and rays, for one slice of KD_PLAN_STAR_RAYS rays or one row (frame/stars.c). A slice takes about 20 ms, and its
 * pairs fit. */
#define KD_PLAN_PAIRS (1u << 18)
/* a search for bright images only is about this many times as fast as a search for all images */
#define KD_PLAN_BRIGHT 8
#define KD_PLAN_STAR_RAYS (1u << 17)
static inline uint64_t kd_plan_pair_bytes(void) { return 8ull * (KD_PLAN_PAIRS + 1); }
static inline uint32_t kd_plan_star_slice(const struct kd_plan *plan)
{
    const uint32_t row = plan->picture.width * plan->lens.side;
    return row > KD_PLAN_STAR_RAYS ? row : KD_PLAN_STAR_RAYS;
}
/* Number of tiles of 3 x 3 rays; the last tiles of a row or column may be smaller. */
static inline uint32_t kd_plan_star_tiles(const struct kd_plan *plan)
{
    const uint32_t row = plan->picture.width * plan->lens.side, rows = kd_plan_star_slice(plan) / row;
    return (row / 3 + 1) * (rows / 3 + 1);
}
static inline uint64_t kd_plan_star_ray_bytes(const struct kd_plan *plan)
{
    return 4ull * (2 + kd_plan_star_tiles(plan) + kd_plan_star_slice(plan));
}

/* Requirements on the plan. kd_plan_make derives them from the scene; benchmarks and tests set further ones. */
struct kd_needs {
    uint32_t quantities;      /* KD_LENS_... quantities of the lens map */
    bool light;               /* measure flux and centroid; always measured if some luminance is kept separate */
    bool no_image;            /* make no pixels and no layers, whatever image.layers says */
    bool radiance;            /* make linear light a layer, if the picture is requested */
    bool followed;            /* trace every ray, even if the profile would interpolate */
    bool sketch;              /* march through volumes as coarsely as kd_march_sketch */
    bool bright;              /* search stars as kd_plan_light.bright says */
    bool reuse_normalisation; /* for volume.normalise_to_jy, reuse the density found for the same matter from any
                                 viewpoint */
};
struct kd_needs kd_needs_of(const struct kd_scene *scene);
enum kd_status kd_plan_make_for(const struct kd_scene *scene, const struct kd_needs *needs,
                                const struct kd_capacity *capacity, struct kd_plan *out, struct kd_error *error);

/* Approximations of plans that belong to no emitter. */
size_t kd_plan_sentence_count(void);
struct kd_approximation kd_plan_sentence(size_t index);

/* Writes the plan as the JSON of POST /v1/plan. */
enum kd_status kd_plan_to_json(const struct kd_plan *plan, struct kd_buffer *out);

#endif
