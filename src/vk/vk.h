/* Drives a Vulkan 1.2 compute device: memory, pipelines, submission, timing. Knows nothing of black holes.
 *
 * One thread owns a struct kd_vk and everything made from it; only kd_vk_list and kd_vk_info of a
 * device that is already open may be called from elsewhere, and kd_vk_pipeline_create by threads that the owner
 * waits for. Every object has a name, for the validation layer and for captures. destroy accepts NULL and half-built
 * objects. */
#ifndef KD_VK_VK_H
#define KD_VK_VK_H

#include "base/buffer.h"
#include "base/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct kd_vk;
struct kd_vk_buffer;
struct kd_vk_pipeline;

/* In ascending order of preference. */
enum kd_vk_type { KD_VK_OTHER, KD_VK_CPU, KD_VK_VIRTUAL, KD_VK_INTEGRATED, KD_VK_DISCRETE };
const char *kd_vk_type_name(enum kd_vk_type type); /* "discrete GPU", "CPU", ... never NULL */

struct kd_vk_info {
    uint32_t index; /* the N of --device N */
    char name[256], driver[256], driver_info[256];
    enum kd_vk_type type;
    uint32_t api_version;       /* VK_MAKE_API_VERSION packing */
    uint64_t heap_bytes;        /* largest device-local heap */
    uint64_t budget_bytes;      /* how much of the heap this process may use now (VK_EXT_memory_budget); 0: not told */
    uint64_t max_binding_bytes; /* largest storage-buffer binding: 128 MiB on lavapipe */
    uint64_t max_uniform_bytes; /* largest uniform-buffer binding: at least 16 KiB, often 64 */
    uint64_t max_texels;        /* of one binding of texels: at least 65536 (SwiftShader), 2^27 on lavapipe */
    uint64_t max_allocation_bytes;
    uint32_t max_push_bytes, subgroup_size, max_groups_x, max_groups_y, max_workgroup;
    bool float64, timestamps;
    uint8_t uuid[16];        /* of the device, the same for every driver and process */
    uint32_t driver_version; /* in the driver's own packing */
    char missing[256];       /* what this device lacks for kerrd, "" if it is usable */
};

struct kd_vk_params {
    const char *device;    /* "auto", an index, or part of a name (case-insensitive)    */
    const char *cache_dir; /* pipeline cache directory, NULL: $XDG_CACHE_HOME/kerrd, "": none */
    bool validate;         /* Khronos layer with synchronisation validation; also KERRD_VALIDATE=1 */
    bool compiles_only;    /* dispatches have no workgroups, and copies to the host are zeros: nothing is computed, but
                              a driver that compiles a kernel at its first dispatch does so */
    bool pipelines_only;   /* neither memory nor submissions: makes pipelines, and a driver without its hardware will do
                              (RADV with RADV_FORCE_FAMILY) */
    uint32_t deadline_ms;  /* of one submission, then KD_EDEVICE; 0: 60000. A software device that hardly has the
                              processor has up to 8 times as long */
};

/* Every device of this machine, whether usable or not, in the order of their indices. *out is malloc'd.
 * KD_EDEVICE, saying which, if there is no loader, no driver or no device: *count is never 0 on KD_OK. */
enum kd_status kd_vk_list(struct kd_vk_info **out, size_t *count, struct kd_error *error);

enum kd_status kd_vk_create(const struct kd_vk_params *params, struct kd_vk **out, struct kd_error *error);
/* Waits for what is under way. A lost device is closed as any other, and one may be created again. One that hangs is
 * abandoned instead, memory and all: drivers crash when it is torn down. End the process soon then, by _exit: exit
 * handlers of the driver may hang. */
void kd_vk_destroy(struct kd_vk *vk);
bool kd_vk_hangs(const struct kd_vk *vk); /* a submission has missed its deadline */
const struct kd_vk_info *kd_vk_info(const struct kd_vk *vk);
const char *kd_vk_choice(const struct kd_vk *vk);           /* one sentence: why this device */
uint32_t kd_vk_validation_messages(const struct kd_vk *vk); /* warnings and errors so far    */
/* When the driver compiles a kernel: as its pipeline is made; or at its first dispatch, on the device's queue, and then
 * whether it keeps what it compiled in files, which other devices of the process read (lavapipe). dir: the folder of
 * these files, "" where it is not known. Any thread. */
enum kd_vk_compiling { KD_VK_COMPILES_EARLY, KD_VK_COMPILES_LATE, KD_VK_COMPILES_LATE_KEEPS_NOTHING };
enum kd_vk_compiling kd_vk_compiling(const struct kd_vk *vk, char dir[4096]);
/* A number for the folders in which it keeps them: another one when they have been removed and made again. 0: there are
 * none. Any thread. */
uint64_t kd_vk_compiled_id(const struct kd_vk *vk);
/* Path of a file in the cache directory that belongs to this device and this version of its driver, as the pipeline
 * cache does; malloc'd. NULL where there is no such directory. Any thread. */
char *kd_vk_cache_file(const struct kd_vk *vk, const char *suffix);

/* Buffers: suballocated from few large allocations. Each can be bound as any kind and copied from and to. UPLOAD and
 * READBACK are host-visible and persistently mapped. What the host has written to an UPLOAD buffer before
 * kd_vk_submit is seen by that submission; what the device has written to either is seen by the host after
 * kd_vk_wait, also where the memory is not coherent. A READBACK buffer's contents are the device's alone. */
enum kd_vk_memory { KD_VK_DEVICE, KD_VK_UPLOAD, KD_VK_READBACK };
enum kd_status kd_vk_buffer_create(struct kd_vk *vk, uint64_t size, enum kd_vk_memory memory, const char *name,
                                   struct kd_vk_buffer **out, struct kd_error *error);
/* May be called at any time. Buffers and pipelines that the device still uses are freed once it has finished. */
void kd_vk_buffer_destroy(struct kd_vk *vk, struct kd_vk_buffer *buffer);
void *kd_vk_buffer_map(struct kd_vk_buffer *buffer); /* NULL for KD_VK_DEVICE without host access */
uint64_t kd_vk_buffer_size(const struct kd_vk_buffer *buffer);
uint64_t kd_vk_allocated(const struct kd_vk *vk); /* bytes held from the device, all buffers */

/* How a kernel sees a binding. A software device reads a storage buffer lane by lane with a check for each word,
 * uniform buffers and texels through vector gathers; elsewhere the kinds differ little. Only storage can be written,
 * and only storage holds as much as max_binding_bytes: a kernel that reads bands of pixels as texels needs a twin
 * that reads them as storage. */
enum kd_vk_kind {
    KD_VK_STORAGE,     /* buffer { } */
    KD_VK_UNIFORM,     /* uniform { }, std140 or std430; max_uniform_bytes */
    KD_VK_TEXELS_R,    /* uniform textureBuffer of R32_SFLOAT, a texel a float; max_texels */
    KD_VK_TEXELS_RGBA, /* and of R32G32B32A32_SFLOAT, a texel four floats */
    KD_VK_TEXELS_WORD, /* uniform utextureBuffer of R32_UINT, a texel a word, */
    KD_VK_TEXELS_PAIR, /* and of R32G32_UINT, a texel two words */
};
#define KD_VK_MAX_BINDINGS 12
#define KD_VK_MAX_STORAGE 8 /* of them, those of storage: what a device must have to be used */

/* Pipelines: one buffer a binding 0..n_buffers-1 in set 0, storage unless `kinds` says otherwise; push constants;
 * specialisation constants of 4 bytes. */
struct kd_vk_spec {
    uint32_t id;
    uint32_t value;
};
struct kd_vk_pipeline_params {
    const char *name;
    const uint32_t *spirv;
    size_t spirv_bytes;
    uint32_t n_buffers, push_bytes;
    enum kd_vk_kind kinds[KD_VK_MAX_BINDINGS];
    const struct kd_vk_spec *spec;
    size_t n_spec;
};
enum kd_status kd_vk_pipeline_create(struct kd_vk *vk, const struct kd_vk_pipeline_params *params,
                                     struct kd_vk_pipeline **out, struct kd_error *error);
void kd_vk_pipeline_destroy(struct kd_vk *vk, struct kd_vk_pipeline *pipeline);

/* Work: record with the calls below, then kd_vk_submit. Commands run in the order they were recorded; a
 * barrier between any two that touch the same buffer, one of them writing, is emitted by the layer from the
 * declared access, as are those against host reads and against earlier submissions.
 * Passes are timed: the same pass name over several dispatches and submissions adds up. */
struct kd_vk_binding {
    struct kd_vk_buffer *buffer;
    uint64_t offset, size; /* size 0: to the end, of texels as many whole ones as there are; offset a multiple of 256 */
    bool write;            /* the shader writes (it may read as well); storage alone */
};
struct kd_vk_dispatch {
    const char *pass; /* string that outlives the submission, e.g. a literal */
    const struct kd_vk_pipeline *pipeline;
    struct kd_vk_binding bindings[KD_VK_MAX_BINDINGS];
    const void *push;
    uint32_t groups[3]; /* 0 counts as 1 */
    /* Three words at this offset of a buffer, a multiple of 4, instead of `groups`: kernels before this one have
     * written them, within what the device dispatches; a 0 among them is no dispatch. NULL: `groups` says */
    struct kd_vk_buffer *counts;
    uint64_t counts_at;
};
enum kd_status kd_vk_dispatch(struct kd_vk *vk, const struct kd_vk_dispatch *dispatch, struct kd_error *error);
enum kd_status kd_vk_copy(struct kd_vk *vk, const char *pass, struct kd_vk_buffer *to, uint64_t to_offset,
                          struct kd_vk_buffer *from, uint64_t from_offset, uint64_t size, struct kd_error *error);
enum kd_status kd_vk_fill(struct kd_vk *vk, const char *pass, struct kd_vk_buffer *buffer, uint64_t offset,
                          uint64_t size, uint32_t value, struct kd_error *error);

/* Submit what was recorded (nothing recorded: no-op) and return at once; *ticket (may be NULL) is the
 * timeline value. At most KD_VK_IN_FLIGHT submissions are under way: one more waits for the oldest. */
#define KD_VK_IN_FLIGHT 4
enum kd_status kd_vk_submit(struct kd_vk *vk, uint64_t *ticket, struct kd_error *error);
/* Wait until that ticket (0: everything submitted) is done, or its deadline passes: KD_EDEVICE, and the
 * device is lost. */
enum kd_status kd_vk_wait(struct kd_vk *vk, uint64_t ticket, struct kd_error *error);
/* Drop what was recorded and not submitted. */
void kd_vk_discard(struct kd_vk *vk);

/* Device time by pass name since the last reset, of finished submissions (those that kd_vk_submit or
 * kd_vk_wait has seen finish). pass: the caller's name, copied; valid while the device lives. A device knows
 * KD_VK_MAX_PASSES names; if there are more, the last ones are summed as "other". Nothing without timestamps.
 */
struct kd_vk_time {
    const char *pass;
    double ms;
    uint32_t dispatches;
};
#define KD_VK_MAX_PASSES 24
size_t kd_vk_times(const struct kd_vk *vk, struct kd_vk_time out[KD_VK_MAX_PASSES]);
void kd_vk_times_reset(struct kd_vk *vk);

#endif
