/* A plan: everything that rendering a scene requires, namely passes, specialisation constants, rays, bytes,
 * estimated time and approximations. Rendering executes the plan; admission control reads it. Any thread. */
#ifndef KD_RENDER_PLAN_PLAN_H
#define KD_RENDER_PLAN_PLAN_H

#include "base/buffer.h"
#include "base/error.h"
#include "render/emit/approximation.h"
#include "render/accuracy/engine.h"
#include "render/plan/beam.h"
#include "render/plan/bloom.h"
#include "render/plan/layer_kinds.h"
#include "render/plan/march.h"
#include "render/plan/pass.h"
#include "scene/scene.h"
#include "interface.h"
#include "lens.h"

#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define KD_PLAN_EMITTERS \
    16 /* at least the number of emitters in shaders/shared/emitters.h, which this header does not include */
#define KD_COST_CLASSES 16
#define KD_AUDIT_RAYS 768              /* at most, on a grid of 16 x 48 */
#define KD_PLAN_MAX_APPROXIMATIONS 121 /* a test compares it with the number of approximations */

/* What a device allows, and its measured speed. */
struct kd_capacity {
    uint64_t max_binding_bytes, memory_bytes; /* limit of one storage-buffer binding; limit of all device memory
                                               * together */
    const char *memory_by;                    /* what determines memory_bytes, for messages; NULL: the device */
    bool host_memory;                         /* device memory is host memory, so pixels on the host count as well */
    uint64_t host_bytes;                      /* otherwise, memory for pixels on the host; 0: unknown */
    uint64_t max_allocation_bytes;            /* limit of one buffer; 0: 2^30, the least that Vulkan 1.2 guarantees */
    /* workgroups of one dispatch; 0: 65535, the least that Vulkan guarantees */
    uint32_t max_groups_x, max_groups_y;
    double ns[KD_FIGURE_COUNT]; /* cost of an item, KD_NS_... of pass.h */
    struct kd_class_cost {
        uint64_t class, learned; /* the class of cost_class.h, 0: unused; the count of measurements when this class was
                                  * last updated */
        double ns[KD_PASS_COUNT];
    } classes[KD_COST_CLASSES];               /* cost of an item in pictures of a class */
    uint64_t learned;                         /* number of measurements of classes so far */
    bool measured;                            /* false: the figures are defaults for this type of device */
    bool float64;                             /* whether the device has double precision */
    unsigned cores;                           /* cores of the host, on which the closed form in double runs */
    const struct kd_accuracy_table *accuracy; /* the device's or a built-in one; valid as long as the renderer */
    bool accuracy_measured;                   /* false: built in */
};

struct kd_plan_pass {
    const char *name, *kernel; /* as in pass.h */
    uint64_t invocations;
    double estimate_ms;
    enum kd_figure_id figure; /* the performance figure that the pass's measured time updates; KD_NS_NONE: none */
};

struct kd_plan {
    uint32_t width, height, side; /* pixels; rays along each side of a pixel */
    struct kd_window
        cut; /* for a tile: its place within the size above, which includes its margin (tile.h); width 0: not a tile */
    /* number of strips of a picture that does not fit in one piece; each is a tile with a margin. Passes, times and
     * host_bytes are for all of them, device_bytes for the largest. 0: in one piece */
    uint32_t strips;
    uint64_t rays; /* rays of the grid */
    /* 2: a pair, with a picture for each eye, side by side. Passes, times and host_bytes are then for both pictures,
     * device_bytes for the larger one, all else for the left one. 0: a single picture */
    uint32_t eyes;
    /* rays of each pixel at the critical curve (view/critical_pixels.h); 0: as any other pixel */
    uint32_t critical;
    uint32_t critical_dense;  /* rays of each such pixel after refinement (frame/refine.c); 0: no refinement there */
    uint64_t critical_pixels; /* number of these pixels */
    uint64_t critical_part;   /* how many of these pixels fit one buffer of their lens map */
    uint32_t adaptive;        /* rays of a pixel after refinement (frame/refine.c); 0: no refinement */
    uint64_t listed_bytes;    /* size of the buffer for the lens map of refined pixels, filled part by part */
    enum kd_lens_path {
        KD_LENS_CLOSED, /* lens_closed.comp: closed forms, for observers outside the photon orbits */
        KD_LENS_MAP,    /* lens_map.comp: by integration steps */
        KD_LENS_LISTED, /* as listed rays (render/rays/rays.h), by any engine in either precision */
    } path;
    /* tolerated relative error of a map interpolated between nodes (plan/sample.h); 0: every ray is traced */
    double interpolates;
    uint32_t sample_rows;              /* rows of pixels whose map is interpolated at once, at most */
    struct kd_setting setting;         /* engine, precision and steps per half period (0: closed form) */
    uint32_t traits[KD_PLAN_EMITTERS]; /* traits of the emitters; 0 for those that the scene does not have */
    bool points;                       /* some emitter consists of points of light */
    bool bright;                       /* only bright images of points are made, and none next to the critical curve */
    bool apart;                        /* the luminance of some emitter is kept beside the radiance */
    /* numbers a pixel after the radiance: Stokes Q, U and V, if polarised light is measured or marched layers need
     * them; Q and U of the separate luminance. 0: none */
    uint32_t stokes_words;
    bool ends;                /* some emitters shine at the ends of rays, and the lens map holds these ends */
    struct kd_march march;    /* the march for volumes and bodies; all 0: the scene has none, and light follows from the
                               * lens map alone */
    bool meets;               /* the scene has bodies */
    struct kd_beam_grid beam; /* the telescope's beam with which light is convolved */
    struct kd_bloom bloom;    /* glare of the lens */
    bool light;               /* flux and centroid are measured */
    /* for a scene that gives the flux of matter: a density found from another viewpoint may be reused
     * (frame/normalise.h) */
    bool reuse_normalisation;
    struct {
        uint32_t width, height;
    } shape;       /* shape of the picture for which that density is found; 0: this picture's own shape, which is
                    * subject to rounding to pixels */
    bool no_image; /* no pixels are made of the radiance */
    bool numbers;  /* the frame is for a file of numbers: no processing after the light is part of it */
    bool ring;     /* rays are listed, round the critical curve */
    bool ingoing;  /* the observer falls, in coordinates that are regular at the outer horizon */
    struct kd_plan_layer layers[KD_WORDS_MOST]; /* layers besides the picture */
    size_t n_layers;
    bool picture;              /* image.layers contains the picture */
    bool radiance;             /* linear light is copied to the host, too */
    uint32_t quantities;       /* KD_LENS_... quantities of the lens map */
    uint32_t orders;           /* crossings of a ray that are recorded */
    uint32_t planes;           /* 4-byte values a ray in the lens map */
    uint32_t band_rows, bands; /* rows of pixels for which one set of buffers has room; number of such sets */
    bool cacheable;            /* the whole lens map fits in memory and can be cached */
    uint32_t audit; /* rays of the lens map that are traced again in closed form, at most KD_AUDIT_RAYS; 0: none */
    uint64_t lens_bytes, device_bytes, host_bytes;
    /* further host memory while a renderer makes the emitters' device data, once for all pictures */
    uint64_t making_bytes;
    struct kd_plan_pass passes[KD_PASS_COUNT];
    size_t n_passes;
    double estimate_ms, trace_ns; /* estimated time of all passes; of tracing one ray */
    uint64_t cost_class;          /* cost class of its passes (cost_class.h) */
    /* additional time for compiling missing kernels, estimated by server/render/queue.h; 0: none are missing, or it
     * is not known */
    double kernels_ms;
    /* The remaining settings come from the caller and not from the scene. The next two are for showing successive
     * frames. If style.exposure is "auto", the exposure moves by the fraction exposure_share from exposure_from towards
     * the picture's own. exposure_share is 0, as set by kd_plan_make: the picture's own exposure. */
    double exposure_from, exposure_share;
    struct {
        bool on, steps;
        uint32_t x, y;
        /* describes the light of the middle ray of this pixel (frame/probe.h); with `steps` also the engine's steps */
    } told;
    struct {
        unsigned samples;
        double shutter;
        /* motion blur: light is the mean of this many pictures (frame/blur.h) within this fraction of a frame's time;
         * 0: off */
    } blur;
    bool measured, accuracy_measured; /* as in the capacity */
    struct kd_approximation approximations[KD_PLAN_MAX_APPROXIMATIONS];
    size_t n_approximations;
    char lens_key[65]; /* hash of everything that the lens map depends on */
};

/* scene must be valid (kd_scene_validate). KD_ETOOBIG, with the size, if the picture does not fit; KD_EINVAL at
 * /accuracy/... for an engine, precision or tolerance that is impossible with this device or camera. */
enum kd_status kd_plan_make(const struct kd_scene *scene, const struct kd_capacity *capacity, struct kd_plan *out,
                            struct kd_error *error);

/* Checks whether kd_plan_make would succeed, without listing the pixels at the critical curve, which takes
 * milliseconds for large pictures. With that list kd_plan_make may still return KD_ETOOBIG. */
enum kd_status kd_plan_check(const struct kd_scene *scene, const struct kd_capacity *capacity, struct kd_error *error);

/* A key for scenes that share a lens map, without a plan: scenes with equal keys share one on any device. Scenes
 * with different keys may still share one, if two ways to request an accuracy have the same result. KD_ENOMEM. */
enum kd_status kd_plan_lens_group(const struct kd_scene *scene, uint64_t *out);

/* Number of buffers for the lens map of the pixels at the critical curve. kd_plan_critical_bytes: bytes of one. */
static inline uint32_t kd_plan_critical_parts(const struct kd_plan *plan)
{
    return plan->critical ? (uint32_t)((plan->critical_pixels + plan->critical_part - 1) / plan->critical_part) : 0;
}
static inline uint64_t kd_plan_critical_bytes(const struct kd_plan *plan)
{
    return 4ull * plan->critical_part * (plan->planes * plan->critical + 2);
}

/* The most rays that one dispatch may leave open for the host. It is limited to KD_GIVEN_MOST, so that their list is no
 * larger than a band of the lens map. */
uint64_t kd_plan_open_most(const struct kd_plan *plan);

/* If image.samples is "auto", a pixel may have KD_PLAN_ADAPTIVE_SIDE^2 rays. */
#define KD_PLAN_ADAPTIVE_SIDE 4
#define KD_PLAN_TRUTH_SIDE 8       /* side of the grid of rays that measure the remaining error of a pixel, */
#define KD_PLAN_SAMPLED_OF_EACH 48 /* on this many pixels of each of four kinds */
#define KD_PLAN_SAMPLED (4 * KD_PLAN_SAMPLED_OF_EACH * KD_PLAN_TRUTH_SIDE * KD_PLAN_TRUTH_SIDE)
#define KD_PLAN_ROUNDS 6                            /* rounds of choosing pixels, at most */
#define KD_PLAN_REFINING_LOOKS (1 + KD_PLAN_ROUNDS) /* number of times that the displayed picture is examined */
#define KD_PLAN_LISTED_BYTES (15u << 20)            /* fewer rays than 65535 workgroups have */

/* Pixels, with `rays` rays each, whose lens map fits the buffer of listed pixels. */
static inline uint64_t kd_plan_listed_most(const struct kd_plan *plan, uint32_t rays)
{
    return plan->listed_bytes / (4ull * (plan->planes * rays + 2));
}

static inline bool kd_plan_holds(const struct kd_plan *plan, uint32_t quantities)
{
    return (plan->quantities & quantities) == quantities;
}

/* Whether something emits light wherever a ray ends. */
bool kd_plan_is_spread(const struct kd_plan *plan);

/* Size of the delivered picture in pixels: a tile without its margin, a pair with both eyes' pictures. */
static inline uint32_t kd_plan_shown_width(const struct kd_plan *plan)
{
    return plan->cut.width ? plan->cut.width : plan->width * (plan->eyes ? plan->eyes : 1);
}
static inline uint32_t kd_plan_shown_height(const struct kd_plan *plan)
{
    return plan->cut.width ? plan->cut.height : plan->height;
}

static inline bool kd_plan_has_footprints(const struct kd_plan *plan)
{
    return plan->quantities & (KD_LENS_FOOTPRINT | KD_LENS_SKY_FOOTPRINT);
}

/* Whether the lens map is the cheapest kind: crossing radii only, by the closed form. */
static inline bool kd_plan_is_radii(const struct kd_plan *plan)
{
    return plan->path == KD_LENS_CLOSED && !(plan->quantities & ~(uint32_t)KD_LENS_W);
}

/* All rays that are traced or interpolated. */
static inline uint64_t kd_plan_rays(const struct kd_plan *plan)
{
    return plan->rays + plan->critical * plan->critical_pixels;
}

/* If the map is interpolated, this many times the square root of the number of the grid's rays are traced: those along
 * edges of orders and fates, and in between the fewer, the denser the rays are. Measured on four presets, one of them
 * from 320 x 180 to 4K (docs/accuracy.md): 117 to 154. */
#define KD_PLAN_FOLLOWED 130
static inline uint64_t kd_plan_followed(const struct kd_plan *plan)
{
    const double rays = (double)plan->rays, most = fmin(rays, KD_PLAN_FOLLOWED * sqrt(rays));
    return plan->interpolates > 0 ? (uint64_t)most + plan->critical * plan->critical_pixels : kd_plan_rays(plan);
}

/* Time of a ray of the grid's map, which may be traced or interpolated, ns. */
static inline double kd_plan_map_ns(const struct kd_plan *plan)
{
    return plan->interpolates > 0 ? plan->trace_ns * (fmin(1, KD_PLAN_FOLLOWED / sqrt((double)plan->rays)) + 0.25)
                                  : plan->trace_ns;
}

/* Limit for the rays traced by refinement: a quarter of the rays of a picture that has 16 in each pixel. */
static inline uint64_t kd_plan_followed_most(const struct kd_plan *plan)
{
    const uint64_t uniform = plan->adaptive * plan->rays + plan->critical_dense * plan->critical_pixels;
    return uniform / 4 - plan->rays - plan->critical * plan->critical_pixels;
}

/* The pass that computes the light of rays, and its time for one ray, ns. */
static inline enum kd_pass_id kd_plan_light_pass(const struct kd_plan *plan)
{
    return plan->march.steps ? KD_PASS_MARCH : KD_PASS_TRANSFER;
}
/* Under a sky of stars the diffuse light is read as well, which takes several times as long as a disk. */
static inline enum kd_figure_id kd_plan_light_figure(const struct kd_plan *plan)
{
    return plan->march.steps ? KD_NS_RAY_MARCH : plan->points ? KD_NS_SAMPLE_STARS : KD_NS_SAMPLE_TRANSFER;
}
static inline double kd_plan_light_ns(const struct kd_plan *plan, const struct kd_capacity *c)
{
    return (plan->march.steps ? plan->march.weight : 1) * c->ns[kd_plan_light_figure(plan)];
}

/* Bytes a pixel of linear light, including everything stored after the radiance. */
#define KD_PLAN_STOKES 3
static inline uint64_t kd_plan_pixel_bytes(const struct kd_plan *plan)
{
    return 4ull * ((plan->apart ? 4 : 3) + plan->stokes_words);
}

/* After the light of a band there is room for a list of rays that the march could not complete, and for the state of
 * rays that continue: their number, and bytes (interface.h, KD_LOST_...). */
static inline uint32_t kd_plan_lost_most(const struct kd_plan *plan)
{
    return plan->march.steps ? plan->width * plan->band_rows : 0;
}
static inline uint64_t kd_plan_lost_bytes(uint64_t most) { return most ? 4 * (KD_LOST_RAYS - 1 + most) : 4; }

/* Whether Q and U of the separate luminance are kept. */
static inline bool kd_plan_stokes_apart(const struct kd_plan *plan) { return plan->stokes_words > KD_PLAN_STOKES; }

/* Sizes of the buffers for spreading points of light: fixed-point numbers for a band of pixels; pairs of a ray and a
 * point, and rays, for one slice of KD_PLAN_STAR_RAYS rays or one row (frame/stars.c). A slice takes about 20 ms, and
 * its pairs fit. */
#define KD_PLAN_PAIRS (1u << 18)
#define KD_PLAN_BRIGHT 8 /* searching only bright images is about this many times as fast as searching all */
#define KD_PLAN_STAR_RAYS (1u << 17)
static inline uint64_t kd_plan_star_bytes(const struct kd_plan *plan) { return 24ull * plan->width * plan->band_rows; }
static inline uint64_t kd_plan_pair_bytes(void) { return 8ull * (KD_PLAN_PAIRS + 1); }
static inline uint32_t kd_plan_star_slice(const struct kd_plan *plan)
{
    const uint32_t row = plan->width * plan->side;
    return row > KD_PLAN_STAR_RAYS ? row : KD_PLAN_STAR_RAYS;
}
/* Tiles of 3 x 3 rays; the last ones of a row or column may be smaller. */
static inline uint32_t kd_plan_star_tiles(const struct kd_plan *plan)
{
    const uint32_t row = plan->width * plan->side, rows = kd_plan_star_slice(plan) / row;
    return (row / 3 + 1) * (rows / 3 + 1);
}
static inline uint64_t kd_plan_star_ray_bytes(const struct kd_plan *plan)
{
    return 4ull * (2 + kd_plan_star_tiles(plan) + kd_plan_star_slice(plan));
}

/* Bytes of one layer for a band of pixels: a multiple of the alignment of bindings. */
static inline uint64_t kd_plan_layer_bytes(const struct kd_plan *plan)
{
    return (4ull * plan->width * plan->band_rows + 255) / 256 * 256;
}

/* Bytes for reading layers back a band at a time. */
static inline uint64_t kd_plan_readback_bytes(const struct kd_plan *plan)
{
    return (plan->radiance ? 12ull : plan->n_layers ? 4ull : 0) * plan->width * plan->band_rows;
}

/* Whether a layer follows from what the march stored with the picture's own light, rather than from rays traced for
 * it. */
static inline bool kd_plan_gathers(const struct kd_plan *plan, int kind)
{
    return plan->march.steps && kd_layer_kinds[kind].of == KD_OF_LIGHT;
}

/* Whether the only requested layer is a map: the picture then shows it in false colour. */
static inline bool kd_plan_is_map(const struct kd_plan *plan) { return plan->n_layers == 1 && !plan->picture; }

/* The exposure in stops to apply where the picture by itself would have `stops`. */
double kd_plan_exposure(const struct kd_plan *plan, double stops);

/* Requirements on the plan. kd_plan_make derives them from the scene; benchmarks and tests ask for more. */
struct kd_needs {
    uint32_t quantities;      /* KD_LENS_... quantities of the lens map */
    bool light;               /* measure flux and centroid; always on if some luminance is kept separate */
    bool no_image;            /* make no pixels and no layers, whatever image.layers says */
    bool radiance;            /* make linear light a layer, if the picture is requested */
    bool followed;            /* trace every ray, even if the profile would interpolate */
    bool sketch;              /* march through volumes as coarsely as kd_march_sketch */
    bool bright;              /* search points of light as kd_plan.bright says */
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
