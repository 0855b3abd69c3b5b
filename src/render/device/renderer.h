/* A renderer: one device and what is cached on it between pictures. One thread at a time has a struct kd_renderer, and
 * hands it on under a lock. Meanwhile other threads may call kd_renderer_capacity only. */
#ifndef KD_RENDER_DEVICE_RENDERER_H
#define KD_RENDER_DEVICE_RENDERER_H

#include "base/error.h"
#include "render/plan/plan.h"
#include "scene/asset.h"

#include <stdbool.h>
#include <stdint.h>

struct kd_renderer;
struct kd_compilation;

#define KD_CREDIT 512 /* room for the names of those whose work is in a picture */

struct kd_renderer_params {
    const char *device;    /* as kd_vk_params */
    const char *cache_dir; /* as kd_vk_params */
    bool validate;
    /* NULL, or kd_first_start (selftest/first_start.h): a device that is met for the first time is tested, half a
     * second. */
    enum kd_status (*prove)(struct kd_renderer *renderer, struct kd_error *error);
    const struct kd_assets *assets; /* what scenes name (scene/asset.h); NULL: none */
    void (*sky_made)(void *user);   /* by another thread: kd_renderer_sky_begin may say otherwise now; may be NULL */
    void *sky_user;
    /* A picture has come to need kernels that nobody could foresee. Takes the compilation. aside: as kd_render_aside,
     * so that others may use the renderer before this returns. False: the picture is given up, KD_ECANCELLED. NULL:
     * they are made by who has the device. */
    bool (*lacks)(void *user, struct kd_compilation *compilation, bool aside);
    void *lacks_user;
    bool passing; /* beside another one of the same device, with less of it: what it learns of the device's speed is not
                     kept */
    bool compiles_only;    /* as kd_vk_params: pictures are black, and a Milky Way is not made */
    uint32_t deadline_ms;  /* as kd_vk_params */
    uint64_t memory_bytes; /* most memory for pictures, those rendered aside included; 0: as the device and the host
                              have it */
};
enum kd_status kd_renderer_create(const struct kd_renderer_params *params, struct kd_renderer **out,
                                  struct kd_error *error);
void kd_renderer_destroy(struct kd_renderer *renderer);

/* Closes a device that has failed and opens it once more. What the renderer has learned and what it keeps on the
 * host stay, and pictures come out the same; buffers and kernels are made anew when they are wanted. KD_EDEVICE: it
 * hangs, so that nothing can be done (kd_renderer_hangs), or it is not to be had now, or another one answers in its
 * place; it may be called again. */
enum kd_status kd_renderer_reopen(struct kd_renderer *renderer, struct kd_error *error);
/* Whether its device has missed a deadline: it can be neither closed nor opened again, and the process should end
 * soon, by _exit. */
bool kd_renderer_hangs(const struct kd_renderer *renderer);

/* A copy of the present capacity, for kd_plan_make. Its accuracy table stays the renderer's. Any thread. */
void kd_renderer_capacity(struct kd_renderer *renderer, struct kd_capacity *out);
/* Begin to read the picture of a scene's sky, where it has one that is not there: up to a second. A render waits for
 * it and keeps the device meanwhile; who asks until it is not under way, and renders then, leaves the device to
 * others. Whether it is under way. Any thread. */
bool kd_renderer_sky_begin(struct kd_renderer *renderer, const struct kd_scene *scene);
/* Begin to read an asset that may become one (panoramas.h). Any thread. */
void kd_renderer_sky_ahead(struct kd_renderer *renderer, const char *hash);
void kd_renderer_sky_stop(
    struct kd_renderer *renderer); /* afterwards none is, and sky_made is not called until another is begun */
/* Device, driver, precision, memory, limits, versions: the JSON of GET /v1/device. */
enum kd_status kd_renderer_device_json(struct kd_renderer *renderer, struct kd_buffer *out);
/* One line: "llvmpipe (LLVM 15.0.6, 256 bits), llvmpipe Mesa 22.3.6". Any thread. */
const char *kd_renderer_device_name(const struct kd_renderer *renderer);
/* The two parts of that. Any thread. */
const char *kd_renderer_type_name(size_t i); /* of the i-th type of devices; NULL: there are no more */
const char *kd_renderer_device(const struct kd_renderer *renderer);
const char *kd_renderer_driver(const struct kd_renderer *renderer);
/* Bytes of device memory that its buffers hold, as of the last frame. Any thread. */
uint64_t kd_renderer_held(const struct kd_renderer *renderer);
/* Path of a file that belongs to this device and its driver's version (vk/vk.h): malloc'd, NULL where there is no
 * folder for such. Any thread. */
char *kd_renderer_cache_file(const struct kd_renderer *renderer, const char *suffix);
uint32_t kd_renderer_validation_messages(const struct kd_renderer *renderer);

/* What an answer says of its own accuracy: errors of crossing radii, measured on a sample of the picture's rays
 * against the closed form in double. sampled is 0 where that cannot be: a picture too large to keep its lens map,
 * one without crossings. */
struct kd_accuracy_report {
    uint64_t undecided;            /* rays of the whole picture that were given up: magenta in it */
    uint64_t traced, interpolated; /* of a lens map that is interpolated between nodes: rays that were followed for it,
                                      nodes that slices share twice; and the pixels' rays in smooth cells. 0: none */
    uint32_t sampled, crossings;   /* rays traced again; crossings compared */
    uint32_t differ;               /* crossings that one of the two has and the other has not; rays of another fate */
    double median, worst;          /* relative error of the radius */
    uint64_t followed;             /* rays beyond those of the plan that were followed, on */
    uint64_t refined, between;     /* pixels that were given more rays, followed or taken from between others; with
                                      image.samples "auto" alone, as what follows: */
    uint32_t pixel_sampled;        /* pixels compared with 64 rays each */
    double pixel_error, pixel_error_worst; /* how far off what is shown is there, of white: root mean square of the
                                              picture; worst of the sample */
    uint32_t volume_sampled; /* of scenes with volumes: rays whose light changed when they were followed KD_MARCH_FINER
                                times as closely; and by how much, */
    double volume_error,
        volume_error_worst; /* relative to their light, or KD_MARCH_DARK of the brightest: nine of ten are within;
                               worst; 1 where there is no light that is a number, or an end */
    uint64_t lost; /* of what is shown: rays that were given up on their way through volumes, magenta as well, and
                      pixels whose light is no number */
};

/* Pictures that may be under way aside at once (render/frame/frame.h). */
#define KD_ASIDES 8

/* Called between slices of what takes long, with the fraction done; return false to stop: KD_ECANCELLED. */
typedef bool (*kd_progress_fn)(void *user, double fraction);

#endif
