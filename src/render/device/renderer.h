/* A renderer: one device, and the data that are cached for it between pictures. A struct kd_renderer is owned by one
 * thread at a time, and is passed on under a lock. Other threads may call only functions marked "any thread". */
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
    const char *device;    /* same meaning as in kd_vk_params */
    const char *cache_dir; /* same meaning as in kd_vk_params */
    bool validate;
    /* test of a device that is used for the first time, which takes half a second: kd_first_start
     * (selftest/first_start.h); NULL: no test */
    enum kd_status (*prove)(struct kd_renderer *renderer, struct kd_error *error);
    const struct kd_assets *assets; /* assets that scenes name (scene/asset.h); NULL: none */
    /* called on another thread when kd_renderer_assets_begin may have a new result; may be NULL */
    void (*asset_read)(void *user);
    void *asset_read_user;
    /* Called when a picture needs kernels that are not yet compiled; takes ownership of the compilation. background:
     * true if the picture is rendered by kd_render_in_background, so that others may use the renderer before this
     * function returns. If the function returns false, the picture is abandoned with KD_ECANCELLED. If `lacks` is
     * NULL, the thread that owns the device makes the kernels. */
    bool (*lacks)(void *user, struct kd_compilation *compilation, bool background);
    void *lacks_user;
    bool passing;          /* true if another renderer uses the same device, so that measured speeds are not stored */
    bool compiles_only;    /* as in kd_vk_params; if true, pictures are black, and no Milky Way is made */
    uint32_t deadline_ms;  /* same meaning as in kd_vk_params */
    uint64_t memory_bytes; /* memory limit for all pictures, including those in the background; 0: the device and the
                            * host set the limit */
};
enum kd_status kd_renderer_create(const struct kd_renderer_params *params, struct kd_renderer **out,
                                  struct kd_error *error);
void kd_renderer_destroy(struct kd_renderer *renderer);

/* Closes a device that has failed and reopens it. Measurements and data cached on the host are kept, so that later
 * pictures are the same as before. Buffers and kernels are made again when needed. Returns KD_EDEVICE in three cases:
 * the device hangs and cannot be closed (kd_renderer_hangs), the device is unavailable now, or another device has taken
 * its place. The call may be repeated. */
enum kd_status kd_renderer_reopen(struct kd_renderer *renderer, struct kd_error *error);
/* True if the device has missed a deadline. The device can then be neither closed nor reopened, and the process should
 * soon end by _exit. */
bool kd_renderer_hangs(const struct kd_renderer *renderer);

/* A copy of the present capacity, for kd_plan_make. The accuracy table in the copy still belongs to the renderer. Any
 * thread. */
void kd_renderer_capacity(struct kd_renderer *renderer, struct kd_capacity *out);
/* Starts reading a scene's sky.image and volume.grid unless they are cached. Reading takes up to some seconds.
 * Returns whether the reading is in progress. A render that waits for the reading would hold the device meanwhile. So
 * a client should call this function repeatedly until the reading is done, and only then render. Any thread. */
bool kd_renderer_assets_begin(struct kd_renderer *renderer, const struct kd_scene *scene);
/* Starts reading an asset that may become a sky (panoramas.h). Any thread. */
void kd_renderer_sky_ahead(struct kd_renderer *renderer, const char *hash);
/* Waits until no asset is being read. asset_read is not called again before the next begin. */
void kd_renderer_assets_stop(struct kd_renderer *renderer);
/* Writes the JSON of GET /v1/device: device, driver, precision, memory, limits, versions. */
enum kd_status kd_renderer_device_json(struct kd_renderer *renderer, struct kd_buffer *out);
/* One line such as "llvmpipe (LLVM 15.0.6, 256 bits), llvmpipe Mesa 22.3.6". Any thread. */
const char *kd_renderer_device_name(const struct kd_renderer *renderer);
const char *kd_renderer_type_name(size_t i); /* name of the i-th type of devices; NULL after the last */
/* The device part and the driver part of kd_renderer_device_name. Any thread. */
const char *kd_renderer_device(const struct kd_renderer *renderer);
const char *kd_renderer_driver(const struct kd_renderer *renderer);
/* Bytes of device memory in the renderer's buffers after the last frame. Any thread. */
uint64_t kd_renderer_held(const struct kd_renderer *renderer);
/* Path of a file that belongs to this version of device and driver (vk/vk.h). The path is malloc'd, or NULL if there is
 * no folder. Any thread. */
char *kd_renderer_cache_file(const struct kd_renderer *renderer, const char *suffix);
uint32_t kd_renderer_validation_messages(const struct kd_renderer *renderer);

/* Measured accuracy of a picture: errors of crossing radii on a sample of its rays, compared with the closed form in
 * double precision. `sampled` is 0 if the errors cannot be measured. This happens if the picture has no crossings, or
 * if it is too large to keep its lens map. */
struct kd_accuracy_report {
    uint64_t undecided; /* rays of the whole picture whose tracing was given up; the picture shows them in magenta */
    /* Members for an interpolated lens map; 0 for any other map. traced: number of rays that were traced to make the
     * map (a node that two slices share counts twice); interpolated: number of pixel rays that lie in smooth cells */
    uint64_t traced, interpolated;
    /* sampled: number of rays that were traced again; crossings: number of crossings that were compared */
    uint32_t sampled, crossings;
    /* number of crossings that only one of the two methods finds, plus the number of rays with different fates */
    uint32_t differ;
    double median, worst; /* relative error of the crossing radius: median and maximum over the sample */
    uint64_t followed;    /* number of rays that refinement traced in addition to those of the plan */
    /* Members for image.samples "auto". refined: number of pixels with more traced rays than planned; between: number
     * of pixels with interpolated rays */
    uint64_t refined, between;
    uint32_t pixel_sampled; /* number of pixels that were compared with 64 rays each */
    /* differences between displayed values and values of 64 rays at these pixels, as a fraction of white.
     * pixel_error: root mean square, extrapolated to the whole picture; pixel_error_worst: largest difference in the
     * sample */
    double pixel_error, pixel_error_worst;
    /* for scenes with volumes: number of sampled rays whose light changes, or is not valid, when they are traced again
     * with steps KD_MARCH_FINER times as fine */
    uint32_t volume_sampled;
    /* relative change of the light of these rays; the divisor is at least KD_MARCH_DARK times the brightest light.
     * volume_error: 90th percentile; volume_error_worst: largest change. A ray counts as 1 if its light is not finite
     * or if the ray was given up */
    double volume_error, volume_error_worst;
    /* number of rays that were given up in volumes (magenta in the displayed picture), plus number of pixels whose
     * light is not finite */
    uint64_t lost;
};

/* Largest number of pictures that may be rendered in the background at once (render/frame/frame.h). */
#define KD_BACKGROUND_RENDERS 8

/* Called between slices of long work, with the completed fraction. If it returns false, the work stops with
 * KD_ECANCELLED. */
typedef bool (*kd_progress_fn)(void *user, double fraction);

#endif
