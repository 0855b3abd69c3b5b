/* A renderer: one device, and what is cached on it between pictures. One thread at a time owns a struct
 * kd_renderer, and passes it on under a lock. Other threads may then call only kd_renderer_capacity. */
#ifndef KD_RENDER_DEVICE_RENDERER_H
#define KD_RENDER_DEVICE_RENDERER_H

#include "base/error.h"
#include "render/plan/plan.h"
#include "scene/asset.h"

#include <stdbool.h>
#include <stdint.h>

struct kd_renderer;
struct kd_compilation;

#define KD_CREDIT 512 /* bytes for the credits of a picture's sources */

struct kd_renderer_params {
    const char *device;    /* as kd_vk_params */
    const char *cache_dir; /* as kd_vk_params */
    bool validate;
    /* NULL, or kd_first_start (selftest/first_start.h): a device that is used for the first time is tested, which
     * takes half a second. */
    enum kd_status (*prove)(struct kd_renderer *renderer, struct kd_error *error);
    const struct kd_assets *assets; /* assets that scenes name (scene/asset.h); NULL: none */
    /* called on another thread when kd_renderer_assets_begin may have a new result; may be NULL */
    void (*asset_read)(void *user);
    void *asset_read_user;
    /* Called when a picture needs kernels that were not foreseen; takes ownership of the compilation. background: as in
     * kd_render_in_background, so that others may use the renderer before this returns. False: the picture is
     * abandoned, KD_ECANCELLED. NULL: the thread with the device makes them. */
    bool (*lacks)(void *user, struct kd_compilation *compilation, bool background);
    void *lacks_user;
    bool passing;          /* another renderer uses the same device: measured speeds are not stored */
    bool compiles_only;    /* as kd_vk_params: pictures are black, and no Milky Way is made */
    uint32_t deadline_ms;  /* as kd_vk_params */
    uint64_t memory_bytes; /* limit for pictures, including those rendered in the background; 0: set by the device and
                              the host */
};
enum kd_status kd_renderer_create(const struct kd_renderer_params *params, struct kd_renderer **out,
                                  struct kd_error *error);
void kd_renderer_destroy(struct kd_renderer *renderer);

/* Closes a device that has failed and reopens it. The measurements and the cached data on the host are kept, and
 * pictures come out the same; buffers and kernels are made again when needed. KD_EDEVICE: the device hangs, so that it
 * cannot be closed (kd_renderer_hangs); or it is unavailable now; or another device answers in its place. The call may
 * be repeated. */
enum kd_status kd_renderer_reopen(struct kd_renderer *renderer, struct kd_error *error);
/* Whether its device has missed a deadline: it can be neither closed nor reopened, and the process should soon end
 * by _exit. */
bool kd_renderer_hangs(const struct kd_renderer *renderer);

/* A copy of the present capacity, for kd_plan_make. Its accuracy table stays the renderer's. Any thread. */
void kd_renderer_capacity(struct kd_renderer *renderer, struct kd_capacity *out);
/* Starts reading a scene's sky.image and volume.grid, unless they are cached; this takes up to some seconds.
 * Returns whether the reading is in progress. A render would wait for it while it holds the device. A client that polls
 * until the reading is done, and renders then, leaves the device to others meanwhile. Any thread. */
bool kd_renderer_assets_begin(struct kd_renderer *renderer, const struct kd_scene *scene);
/* Starts reading an asset that may become a sky (panoramas.h). Any thread. */
void kd_renderer_sky_ahead(struct kd_renderer *renderer, const char *hash);
/* Afterwards no asset is being read, and asset_read is not called until the next begin. */
void kd_renderer_assets_stop(struct kd_renderer *renderer);
/* Device, driver, precision, memory, limits, versions: the JSON of GET /v1/device. */
enum kd_status kd_renderer_device_json(struct kd_renderer *renderer, struct kd_buffer *out);
/* One line: "llvmpipe (LLVM 15.0.6, 256 bits), llvmpipe Mesa 22.3.6". Any thread. */
const char *kd_renderer_device_name(const struct kd_renderer *renderer);
/* Parts of that line: device and driver. Any thread. */
const char *kd_renderer_type_name(size_t i); /* name of the i-th type of devices; NULL after the last */
const char *kd_renderer_device(const struct kd_renderer *renderer);
const char *kd_renderer_driver(const struct kd_renderer *renderer);
/* Bytes of device memory in the renderer's buffers as of the last frame. Any thread. */
uint64_t kd_renderer_held(const struct kd_renderer *renderer);
/* Path of a file that belongs to this device and driver version (vk/vk.h): malloc'd, NULL if there is no folder. Any
 * thread. */
char *kd_renderer_cache_file(const struct kd_renderer *renderer, const char *suffix);
uint32_t kd_renderer_validation_messages(const struct kd_renderer *renderer);

/* Measured accuracy of a picture: errors of crossing radii on a sample of its rays against the closed form in double.
 * sampled is 0 if no error can be measured: the picture is too large to keep its lens map, or has no crossings. */
struct kd_accuracy_report {
    uint64_t undecided; /* rays of the whole picture that were given up; shown in magenta */
    /* for an interpolated lens map. traced: number of rays that were traced for it (nodes shared by slices count
     * twice); interpolated: number of the pixels' rays in smooth cells. 0: not interpolated */
    uint64_t traced, interpolated;
    uint32_t sampled, crossings; /* sampled: rays that were traced again; crossings: crossings that were compared */
    uint32_t differ;             /* number of crossings that only one of the two has, plus rays with different fates */
    double median, worst;        /* relative error of the radius */
    uint64_t followed;           /* rays that refinement traced beyond those of the plan */
    /* pixels with more rays. refined: traced; between: interpolated. These two and the next three: only with
     * image.samples "auto" */
    uint64_t refined, between;
    uint32_t pixel_sampled; /* pixels compared with 64 rays each */
    /* difference of displayed values at these pixels, as a fraction of white: root mean square for the picture; worst
     * of the sample */
    double pixel_error, pixel_error_worst;
    /* for scenes with volumes: number of rays that were followed again KD_MARCH_FINER times as finely */
    uint32_t volume_sampled;
    /* change of the light of these rays, relative to that light or to KD_MARCH_DARK of the brightest: 90th percentile;
     * worst. 1 if light is not finite or a ray has no end */
    double volume_error, volume_error_worst;
    /* for the displayed picture: the number of rays given up in volumes, which are magenta, plus the number of pixels
     * whose light is not finite */
    uint64_t lost;
};

/* The most pictures that may be rendered in the background concurrently (render/frame/frame.h). */
#define KD_BACKGROUND_RENDERS 8

/* Called between slices of long work, with the completed fraction; return false to stop: KD_ECANCELLED. */
typedef bool (*kd_progress_fn)(void *user, double fraction);

#endif
