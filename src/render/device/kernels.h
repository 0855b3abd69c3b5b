/* Compute pipelines of a renderer: created when a plan first needs them, then cached. Render thread only. */
#ifndef KD_RENDER_DEVICE_KERNELS_H
#define KD_RENDER_DEVICE_KERNELS_H

#include "render/plan/bloom.h"
#include "vk/vk.h"

enum kd_kernel {
    KD_KERNEL_LENS_CLOSED,
    KD_KERNEL_LENS_MAP,
    KD_KERNEL_FOOTPRINT,
    KD_KERNEL_FOOTPRINT_TEXELS, /* variant of the footprint kernel that reads the lens map as texels */
    KD_KERNEL_LENS_CELLS,
    KD_KERNEL_LENS_FILL,
    KD_KERNEL_LENS_FILL_TEXELS, /* variant of the fill kernel that reads nodes as texels */
    KD_KERNEL_BETWEEN,
    KD_KERNEL_SETTLE,
    KD_KERNEL_RAYS_F32,
    KD_KERNEL_RAYS_F64,
    KD_KERNEL_RAYS_KS_F32,
    KD_KERNEL_RAYS_KS_F64,
    KD_KERNEL_RAYS_TRACE_F32, /* variants of the four ray kernels above that also record each step */
    KD_KERNEL_RAYS_TRACE_F64,
    KD_KERNEL_RAYS_KS_TRACE_F32,
    KD_KERNEL_RAYS_KS_TRACE_F64,
    KD_KERNEL_STAR_TILES,
    KD_KERNEL_STAR_TILES_TEXELS,
    KD_KERNEL_STAR_SEARCH,
    KD_KERNEL_STAR_SEARCH_TEXELS,
    KD_KERNEL_STAR_IMAGES,
    KD_KERNEL_STAR_IMAGES_TEXELS,
    KD_KERNEL_TRANSFER,
    KD_KERNEL_TRANSFER_TEXELS, /* variant of the transfer kernel that reads texels */
    /* transfer kernel for a single ray, with a report of each emitter; KD_KERNEL_MARCH_PROBE does the same for rays
     * through volumes */
    KD_KERNEL_TRANSFER_PROBE,
    KD_KERNEL_MARCH_PROBE,
    KD_KERNEL_LAYERS,
    KD_KERNEL_MARCH,        /* the transfer kernel for scenes with volumes */
    KD_KERNEL_MARCH_PIECES, /* the same for rays that continue from a stored state */
    KD_KERNEL_LAYERS_MARCH, /* the layers kernel for scenes with volumes */
    KD_KERNEL_PHOTOMETRY,
    KD_KERNEL_EXPOSE,
    KD_KERNEL_BLOOM_BRIGHT, /* each bloom and beam kernel is followed by its variant that reads texels */
    KD_KERNEL_BLOOM_BRIGHT_TEXELS,
    KD_KERNEL_BLOOM_GATHER,
    KD_KERNEL_BLOOM_GATHER_TEXELS,
    KD_KERNEL_BLOOM_DOWN,
    KD_KERNEL_BLOOM_DOWN_TEXELS,
    KD_KERNEL_BLOOM_UP,
    KD_KERNEL_BLOOM_UP_TEXELS,
    KD_KERNEL_BEAM_GATHER,
    KD_KERNEL_BEAM_GATHER_TEXELS,
    KD_KERNEL_BEAM_SPLINE,
    KD_KERNEL_BEAM_SPLINE_TEXELS,
    KD_KERNEL_BEAM_BLUR,
    KD_KERNEL_BEAM_BLUR_TEXELS,
    KD_KERNEL_BEAM_SPREAD,
    KD_KERNEL_BEAM_SPREAD_TEXELS,
    KD_KERNEL_POST,
    KD_KERNEL_POST_TEXELS, /* variant of the kernel above that reads texels; kd_kernel_post chooses between the two */
    KD_KERNEL_POST_BLOOM,
    KD_KERNEL_POST_BLOOM_TEXELS,
    KD_KERNEL_POST_HEAT,
    KD_KERNEL_POST_HEAT_TEXELS,
    KD_KERNEL_POST_BLOOM_HEAT,
    KD_KERNEL_POST_BLOOM_HEAT_TEXELS,
};

#define KD_KERNEL_MAX_CONSTANTS 32
#define KD_KERNELS_KEPT 48
#define KD_KERNEL_WISHES 32

struct kd_kernel_entry {
    const struct kd_vk_pipeline_params *source; /* points to constant data */
    uint32_t constants[KD_KERNEL_MAX_CONSTANTS];
    size_t n; /* number of constants */
    struct kd_vk_pipeline *pipeline;
    uint64_t used;
};
/* A kernel to be made. made: its pipeline; NULL: not made yet, or it failed. */
struct kd_kernel_request {
    const struct kd_vk_pipeline_params *source;
    uint32_t constants[KD_KERNEL_MAX_CONSTANTS];
    size_t n;
    struct kd_vk_pipeline *made;
};
struct kd_kernel_requests {
    struct kd_kernel_request at[KD_KERNEL_WISHES];
    size_t n;
};
struct kd_kernels {
    struct kd_kernel_entry entries[KD_KERNELS_KEPT];
    size_t limit; /* number of entries that may be used; 0: all. A test sets this limit before the first request */
    uint64_t clock;
    bool noting;
    struct kd_kernel_requests wishes;
    uint64_t noted; /* value of the clock when noted kernels were last added to the cache */
};

/* Gets the pipeline of a kernel with specialisation constants 0..n-1. If the cache is full, the least recently used
 * pipeline is evicted. */
enum kd_status kd_kernels_get(struct kd_kernels *kernels, struct kd_vk *vk, enum kd_kernel kernel,
                              const uint32_t *constants, size_t n, const struct kd_vk_pipeline **out,
                              struct kd_error *error);
/* Like kd_kernels_get, for a kernel that is not in the list, such as an emitter's (render/emit/own.h). */
enum kd_status kd_kernels_get_of(struct kd_kernels *kernels, struct kd_vk *vk,
                                 const struct kd_vk_pipeline_params *source, const uint32_t *constants, size_t n,
                                 const struct kd_vk_pipeline **out, struct kd_error *error);
/* kd_kernels_note starts recording. From then on kd_kernels_get only notes missing kernels, up to KD_KERNEL_WISHES, and
 * sets *out to NULL. kd_kernels_make ends recording and makes the noted kernels, on one thread for each processor, at
 * most four. If a kernel fails, the next kd_kernels_get reports its error. */
void kd_kernels_note(struct kd_kernels *kernels);
void kd_kernels_make(struct kd_kernels *kernels, struct kd_vk *vk);
/* These three functions are the steps of kd_kernels_make. kd_kernels_noted ends recording and returns the noted
 * kernels. kd_kernel_requests_make makes them; it may run on any thread while another thread uses the device, as long
 * as the device stays open. kd_kernels_keep adds them to the cache. */
void kd_kernels_noted(struct kd_kernels *kernels, struct kd_kernel_requests *out);
void kd_kernel_requests_make(struct kd_kernel_requests *wishes, struct kd_vk *vk);
void kd_kernels_keep(struct kd_kernels *kernels, struct kd_vk *vk, const struct kd_kernel_requests *made);
/* True if the device can bind the radiance of this many pixels as texels of four floats. The number of texels that can
 * be bound differs between devices. A software device reads texels in a third of the time that it needs for a storage
 * buffer. */
bool kd_kernels_texels(const struct kd_vk *vk, uint64_t pixels);
/* like kd_kernels_texels, for this number of bytes of any data */
bool kd_kernels_texels_of(const struct kd_vk *vk, uint64_t bytes);
/* like kd_kernels_texels, for any lens map, with one number in each texel. Software devices read such texels in less
 * than half the time */
bool kd_kernels_map_as_texels(const struct kd_vk *vk);
bool kd_kernels_cells_as_texels(const struct kd_vk *vk, const struct kd_bloom *bloom);
static inline enum kd_kernel kd_kernel_post(bool texels, bool bloom, bool heat)
{
    return (heat    ? bloom ? KD_KERNEL_POST_BLOOM_HEAT : KD_KERNEL_POST_HEAT
            : bloom ? KD_KERNEL_POST_BLOOM
                    : KD_KERNEL_POST) +
           (texels ? 1 : 0);
}
/* Keeps the n most recently used kernels and destroys the others. */
void kd_kernels_rest(struct kd_kernels *kernels, struct kd_vk *vk, size_t n);
/* Lists all cached kernels, up to KD_KERNEL_WISHES, so that kd_kernel_requests_make can make them again on another
 * device. */
void kd_kernels_list(const struct kd_kernels *kernels, struct kd_kernel_requests *out);
uint64_t kd_kernels_spirv_bytes(const struct kd_kernels *kernels); /* size of the cached kernels' SPIR-V */
void kd_kernels_finish(struct kd_kernels *kernels, struct kd_vk *vk);

#endif
