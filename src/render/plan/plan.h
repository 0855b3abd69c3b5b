/* A plan is what a scene requires and nothing more: passes, specialisation constants, rays, bytes, estimated time,
 * approximations. Rendering executes the plan; admission control reads it. Any thread. */
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
    16 /* at least those of shaders/shared/emitters.h, which those who include this need not see \
        */
#define KD_COST_CLASSES 16
#define KD_AUDIT_RAYS 768              /* at most, on a grid of 16 x 48 */
#define KD_PLAN_MAX_APPROXIMATIONS 116 /* a test compares it with all there are */

/* The capacity says what the device allows and how fast it has been measured to be. */
struct kd_capacity {
    uint64_t max_binding_bytes, memory_bytes; /* of one storage-buffer binding; of everything on the device */
    const char *memory_by;                    /* what sets memory_bytes, for a sentence; NULL: the device */
    bool host_memory;                         /* the device's memory is the host's: pixels on the host count as well */
    uint64_t host_bytes;                      /* else of pixels on the host; 0: not known */
    uint64_t max_allocation_bytes;            /* of one buffer; 0: 2^30, the least that Vulkan 1.2 has */
    uint32_t max_groups_x, max_groups_y;      /* workgroups of one dispatch; 0: 65535, the least that Vulkan has */
    double ns[KD_FIGURE_COUNT];               /* what an item costs, KD_NS_... of pass.h */
    struct kd_class_cost {
        uint64_t class, learned; /* of cost_class.h, 0: none; when it was learned from last, in measurements */
        double ns[KD_PASS_COUNT];
    } classes[KD_COST_CLASSES];               /* what an item costs in pictures of these */
    uint64_t learned;                         /* measurements of those so far */
    bool measured;                            /* false: the figures are a default guess for this type of device */
    bool float64;                             /* the device has double precision */
    unsigned cores;                           /* of the host, that the closed form in double runs on */
    const struct kd_accuracy_table *accuracy; /* of the device, or built in; lives as long as the renderer */
    bool accuracy_measured;                   /* false: built in */
};

struct kd_plan_pass {
    const char *name, *kernel; /* as in pass.h */
    uint64_t invocations;
    double estimate_ms;
    enum kd_figure_id figure; /* that its time is learned as, KD_NS_NONE: none */
};

struct kd_plan {
    uint32_t width, height, side; /* pixels; rays along each side of a pixel */
    struct kd_window
        cut; /* of a tile: where it lies in these, which have its margin too (tile.h); of width 0: this is no tile */
    uint32_t strips; /* that a picture which does not fit in one is made of, each a tile with a margin; passes, times
                      * and host_bytes are of all, device_bytes of the largest. 0: it is made in one */
    uint64_t rays;   /* of the grid */
    uint32_t eyes;   /* 2: there is such a picture for each eye, side by side; passes, times and host_bytes are of both
                      * then, device_bytes of the larger one, and all else is the left one's. 0: one */
    uint32_t critical;       /* rays of each pixel at the critical curve (view/critical_pixels.h); 0: as of any other */
    uint32_t critical_dense; /* where one is not enough (frame/refine.c); 0: all there have as many */
    uint64_t critical_pixels; /* how many they are */
    uint64_t critical_part;   /* how many one buffer holds the lens map of */
    uint32_t adaptive;        /* rays of a pixel for which one is not enough (frame/refine.c); 0: all have as many */
    uint64_t listed_bytes;    /* of the buffer that holds the lens map of such pixels, part by part */
    enum kd_lens_path {
        KD_LENS_CLOSED, /* lens_closed.comp: closed forms, from outside the orbits of light */
        KD_LENS_MAP,    /* lens_map.comp: by steps */
        KD_LENS_LISTED, /* as listed rays (render/rays/rays.h), by any engine, in either precision */
    } path;
    double interpolates;               /* the relative error that a map interpolated between nodes may have from that
                                        * (plan/sample.h); 0: every ray is followed */
    uint32_t sample_rows;              /* rows of pixels whose map is interpolated at once, at most */
    struct kd_setting setting;         /* engine, precision and steps of a half period (0: closed form) */
    uint32_t traits[KD_PLAN_EMITTERS]; /* of the emitters, 0 for those that the scene has not */
    bool points;                       /* some emitter has points of light, */
    bool bright;           /* of which only images that are bright are made, and none next to the critical curve */
    bool apart;            /* the luminance of some is kept beside the radiance */
    uint32_t stokes_words; /* numbers a pixel behind the radiance: Stokes Q, U and V, where light is measured that is
                            * polarised, or layers are of light that is marched; and Q and U of what is kept apart. 0:
                            * none */
    bool ends;             /* some shine where rays end, and the lens map says where */
    struct kd_march
        march;  /* of volumes and bodies; all 0: the scene has none, and light is made of the lens map alone */
    bool meets; /* there are bodies */
    struct kd_beam_grid beam; /* of a telescope, that light is convolved with */
    struct kd_bloom bloom;    /* what a lens spreads */
    bool light;               /* flux and centroid are measured */
    bool held; /* the density of matter of a given flux may be one that was found from another side (frame/normalise.h)
                */
    struct {
        uint32_t width, height;
    } shape;      /* and it is that of a picture of this shape; 0: of its own, which its pixels round */
    bool unseen;  /* no pixels are made of the radiance */
    bool numbers; /* the frame is for a file of numbers: what is done to a picture behind its light does not count there
                   */
    bool ring;    /* rays are listed, round the critical curve */
    bool ingoing; /* the observer falls, in coordinates that know no outer horizon */
    struct kd_plan_layer layers[KD_WORDS_MOST]; /* maps of numbers beside the picture */
    size_t n_layers;
    bool picture;              /* the picture is among image.layers */
    bool radiance;             /* and linear light is brought to the host too */
    uint32_t quantities;       /* of the lens map, KD_LENS_... */
    uint32_t orders;           /* crossings a ray */
    uint32_t planes;           /* 4-byte values a ray in the lens map */
    uint32_t band_rows, bands; /* rows of pixels that one set of buffers holds; how many sets */
    bool cacheable;            /* the whole lens map fits in memory and can be kept */
    uint32_t audit; /* rays of the lens map that are traced again in closed form, at most KD_AUDIT_RAYS; 0: none */
    uint64_t lens_bytes, device_bytes, host_bytes;
    uint64_t making_bytes; /* beside host_bytes, while a renderer makes what emitters have on the device, once for all
                              pictures */
    struct kd_plan_pass passes[KD_PASS_COUNT];
    size_t n_passes;
    double estimate_ms, trace_ns; /* of all; of one ray */
    uint64_t cost_class;          /* that its passes' times are learned for (cost_class.h) */
    double kernels_ms;            /* what compiling its kernels takes beside that, estimated by who knows that they are
                                     missing (server/render/queue.h); 0: none are, or nobody knows */
    /* Not of the scene, for whoever shows frames one after the other: where style.exposure is "auto", only this
     * share of the way from there to what the picture alone would have. 0, as kd_plan_make leaves it: all of it. */
    double exposure_from, exposure_share;
    struct {
        bool on, steps;
        uint32_t x, y;
    } told; /* nor is this: the light of the middle ray of that pixel is told (frame/tell.h), and with `steps` the
               engine's own */
    struct {
        unsigned samples;
        double shutter;
    } blur; /* nor this: its light is the mean of so many pictures (frame/blur.h), within that part of a frame's time;
               0: it is its own */
    bool measured, accuracy_measured; /* as in the capacity */
    struct kd_approximation approximations[KD_PLAN_MAX_APPROXIMATIONS];
    size_t n_approximations;
    char lens_key[65]; /* hash of what the lens map depends on */
};

/* scene must be valid (kd_scene_validate). KD_ETOOBIG, saying how much, when it does not fit; KD_EINVAL at
 * /accuracy/... for an engine, precision or tolerance that this device or this camera cannot have. */
enum kd_status kd_plan_make(const struct kd_scene *scene, const struct kd_capacity *capacity, struct kd_plan *out,
                            struct kd_error *error);

/* Checks whether kd_plan_make finds the scene possible, without the list of pixels at the critical curve, which
 * takes milliseconds for pictures of many pixels. With that list it may still be KD_ETOOBIG. */
enum kd_status kd_plan_check(const struct kd_scene *scene, const struct kd_capacity *capacity, struct kd_error *error);

/* Says which scenes share a lens map, without a plan: those of which this is equal, on any device. Others may all
 * the same, where two ways to ask for an accuracy come to the same. KD_ENOMEM. */
enum kd_status kd_plan_lens_group(const struct kd_scene *scene, uint64_t *out);

/* Count the buffers that the lens map of the pixels at the critical curve takes, and the bytes of one. */
static inline uint32_t kd_plan_critical_parts(const struct kd_plan *plan)
{
    return plan->critical ? (uint32_t)((plan->critical_pixels + plan->critical_part - 1) / plan->critical_part) : 0;
}
static inline uint64_t kd_plan_critical_bytes(const struct kd_plan *plan)
{
    return 4ull * plan->critical_part * (plan->planes * plan->critical + 2);
}

/* The most rays that a device leaves open for the host, of those that it follows at once: no more than KD_GIVEN_MOST,
 * so that their list takes no more than a band of the lens map does. */
uint64_t kd_plan_open_most(const struct kd_plan *plan);

/* Where image.samples is "auto" a pixel may have KD_PLAN_ADAPTIVE_SIDE^2 rays. */
#define KD_PLAN_ADAPTIVE_SIDE 4
#define KD_PLAN_TRUTH_SIDE 8       /* of the rays that tell what is left, */
#define KD_PLAN_SAMPLED_OF_EACH 48 /* on so many pixels of four kinds */
#define KD_PLAN_SAMPLED (4 * KD_PLAN_SAMPLED_OF_EACH * KD_PLAN_TRUTH_SIDE * KD_PLAN_TRUTH_SIDE)
#define KD_PLAN_ROUNDS 6                            /* most, of choosing pixels */
#define KD_PLAN_REFINING_LOOKS (1 + KD_PLAN_ROUNDS) /* at the picture as it is shown */
#define KD_PLAN_LISTED_BYTES (15u << 20)            /* rays of all of which are fewer than 65535 workgroups */

/* Pixels of so many rays whose lens map the buffer of listed pixels holds. */
static inline uint64_t kd_plan_listed_most(const struct kd_plan *plan, uint32_t rays)
{
    return plan->listed_bytes / (4ull * (plan->planes * rays + 2));
}

static inline bool kd_plan_holds(const struct kd_plan *plan, uint32_t quantities)
{
    return (plan->quantities & quantities) == quantities;
}

/* Says whether something shines wherever a ray ends. */
bool kd_plan_is_spread(const struct kd_plan *plan);

/* Count the pixels along the sides of what is handed over: of a tile without its margin, of a pair of both eyes'
 * pictures. */
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

/* Says whether the lens map is one of crossing radii alone, by the closed form: the cheapest there is. */
static inline bool kd_plan_is_radii(const struct kd_plan *plan)
{
    return plan->path == KD_LENS_CLOSED && !(plan->quantities & ~(uint32_t)KD_LENS_W);
}

/* Counts all that are followed. */
static inline uint64_t kd_plan_rays(const struct kd_plan *plan)
{
    return plan->rays + plan->critical * plan->critical_pixels;
}

/* Of these, where the map is interpolated between rays, about so many are followed: those along the edges of orders and
 * fates, and between them the fewer the more closely they lie. Measured on four presets, and of one from 320 x 180 to
 * 4K (docs/accuracy.md): 117 to 154 times the square root of their number. */
#define KD_PLAN_FOLLOWED 130
static inline uint64_t kd_plan_followed(const struct kd_plan *plan)
{
    const double rays = (double)plan->rays, most = fmin(rays, KD_PLAN_FOLLOWED * sqrt(rays));
    return plan->interpolates > 0 ? (uint64_t)most + plan->critical * plan->critical_pixels : kd_plan_rays(plan);
}

/* What a ray of the grid's map takes, followed or not, in ns. */
static inline double kd_plan_map_ns(const struct kd_plan *plan)
{
    return plan->interpolates > 0 ? plan->trace_ns * (fmin(1, KD_PLAN_FOLLOWED / sqrt((double)plan->rays)) + 0.25)
                                  : plan->trace_ns;
}

/* Rays that may be followed on such pixels: all together are then a quarter of those that a picture with 16 in each
 * has. */
static inline uint64_t kd_plan_followed_most(const struct kd_plan *plan)
{
    const uint64_t uniform = plan->adaptive * plan->rays + plan->critical_dense * plan->critical_pixels;
    return uniform / 4 - plan->rays - plan->critical * plan->critical_pixels;
}

/* The pass that makes light of rays, and what one takes in it, in ns. */
static inline enum kd_pass_id kd_plan_light_pass(const struct kd_plan *plan)
{
    return plan->march.steps ? KD_PASS_MARCH : KD_PASS_TRANSFER;
}
/* Where the sky has stars, the light between them is read too, which takes several times what a disk does. */
static inline enum kd_figure_id kd_plan_light_figure(const struct kd_plan *plan)
{
    return plan->march.steps ? KD_NS_RAY_MARCH : plan->points ? KD_NS_SAMPLE_STARS : KD_NS_SAMPLE_TRANSFER;
}
static inline double kd_plan_light_ns(const struct kd_plan *plan, const struct kd_capacity *c)
{
    return (plan->march.steps ? plan->march.weight : 1) * c->ns[kd_plan_light_figure(plan)];
}

/* Linear light takes so many bytes a pixel, all that is kept behind it included. */
#define KD_PLAN_STOKES 3
static inline uint64_t kd_plan_pixel_bytes(const struct kd_plan *plan)
{
    return 4ull * ((plan->apart ? 4 : 3) + plan->stokes_words);
}

/* Behind the light of a band there is room for a list of so many rays that the march could not follow to their end, and
 * for what those that go on have: so many bytes (interface.h, KD_LOST_...). */
static inline uint32_t kd_plan_lost_most(const struct kd_plan *plan)
{
    return plan->march.steps ? plan->width * plan->band_rows : 0;
}
static inline uint64_t kd_plan_lost_bytes(uint64_t most) { return most ? 4 * (KD_LOST_RAYS - 1 + most) : 4; }

/* Says whether Q and U are kept of the light that is kept apart. */
static inline bool kd_plan_stokes_apart(const struct kd_plan *plan) { return plan->stokes_words > KD_PLAN_STOKES; }

/* Where points of light are spread: fixed-point numbers of a band of pixels; and pairs of a ray and a point, and
 * rays, of one slice of so many rays, or a row (frame/stars.c): some 20 ms, and few enough that their pairs have
 * room. */
#define KD_PLAN_PAIRS (1u << 18)
#define KD_PLAN_BRIGHT 8 /* bright images take so much less of the time that all do, about */
#define KD_PLAN_STAR_RAYS (1u << 17)
static inline uint64_t kd_plan_star_bytes(const struct kd_plan *plan) { return 24ull * plan->width * plan->band_rows; }
static inline uint64_t kd_plan_pair_bytes(void) { return 8ull * (KD_PLAN_PAIRS + 1); }
static inline uint32_t kd_plan_star_slice(const struct kd_plan *plan)
{
    const uint32_t row = plan->width * plan->side;
    return row > KD_PLAN_STAR_RAYS ? row : KD_PLAN_STAR_RAYS;
}
/* Tiles of three rays a side, the last ones of which may be narrower, and lower. */
static inline uint32_t kd_plan_star_tiles(const struct kd_plan *plan)
{
    const uint32_t row = plan->width * plan->side, rows = kd_plan_star_slice(plan) / row;
    return (row / 3 + 1) * (rows / 3 + 1);
}
static inline uint64_t kd_plan_star_ray_bytes(const struct kd_plan *plan)
{
    return 4ull * (2 + kd_plan_star_tiles(plan) + kd_plan_star_slice(plan));
}

/* Counts the bytes of one layer, a band of pixels: a multiple of what a binding may begin at. */
static inline uint64_t kd_plan_layer_bytes(const struct kd_plan *plan)
{
    return (4ull * plan->width * plan->band_rows + 255) / 256 * 256;
}

/* Counts the bytes that layers need to come to the host a band at a time. */
static inline uint64_t kd_plan_readback_bytes(const struct kd_plan *plan)
{
    return (plan->radiance ? 12ull : plan->n_layers ? 4ull : 0) * plan->width * plan->band_rows;
}

/* Says whether a layer is made of what the march has left of the picture's own light, rather than followed along
 * rays of its own. */
static inline bool kd_plan_gathers(const struct kd_plan *plan, int kind)
{
    return plan->march.steps && kd_layer_kinds[kind].of == KD_OF_LIGHT;
}

/* Says whether the one layer that is asked for is a map: then the picture is that in false colour. */
static inline bool kd_plan_is_map(const struct kd_plan *plan) { return plan->n_layers == 1 && !plan->picture; }

/* Gives the stops to apply where the picture alone would have `stops`. */
double kd_plan_exposure(const struct kd_plan *plan, double stops);

/* These say what the lens map must hold. kd_plan_make derives it from the scene; benchmarks and tests ask for more. */
struct kd_needs {
    uint32_t quantities; /* KD_LENS_... */
    bool light;          /* and that flux and centroid be measured, as they are whenever some light is kept apart */
    bool unseen;   /* and that nobody sees the picture: it has no pixels, and no layers, whatever image.layers says */
    bool radiance; /* and that linear light be among the layers, where the picture is asked for */
    bool followed; /* and that every ray be followed, whatever the profile would interpolate, */
    bool sketch;   /* and that volumes be followed as coarsely as kd_march_sketch has it, */
    bool bright;   /* and that points of light be sought as plan.bright says, */
    bool held;     /* and that volume.normalise_to_jy has the density that was found for the same matter before, from
                      wherever it was seen */
};
struct kd_needs kd_needs_of(const struct kd_scene *scene);
enum kd_status kd_plan_make_for(const struct kd_scene *scene, const struct kd_needs *needs,
                                const struct kd_capacity *capacity, struct kd_plan *out, struct kd_error *error);

/* These are the approximations of plans that are no emitter's. */
size_t kd_plan_sentence_count(void);
struct kd_approximation kd_plan_sentence(size_t index);

/* Writes the plan as the JSON of POST /v1/plan. */
enum kd_status kd_plan_to_json(const struct kd_plan *plan, struct kd_buffer *out);

#endif
