/* Vulkan 1.2 compute device: memory, pipelines, submission, timing. Contains nothing about black holes.
 *
 * One thread owns a struct kd_vk and everything made from it. Other threads may call only kd_vk_list, kd_vk_info on an
 * open device, and functions marked "any thread"; kd_vk_pipeline_create may run on threads that the owner waits for.
 * Every object has a name, for the validation layer and for captures. destroy accepts NULL and half-built objects. */
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
const char *kd_vk_type_name(enum kd_vk_type type); /* such as "discrete GPU"; never NULL */

struct kd_vk_info {
    uint32_t index; /* N in --device N */
    char name[256], driver[256], driver_info[256];
    enum kd_vk_type type;
    uint32_t api_version;       /* VK_MAKE_API_VERSION packing */
    uint64_t heap_bytes;        /* largest device-local heap */
    uint64_t budget_bytes;      /* part of the heap that this process may use now (VK_EXT_memory_budget); 0: unknown */
    uint64_t max_binding_bytes; /* largest storage-buffer binding: 128 MiB on lavapipe */
    uint64_t max_uniform_bytes; /* largest uniform-buffer binding: at least 16 KiB, often 64 */
    uint64_t max_texels;        /* largest texel-buffer binding: at least 65536 (SwiftShader), 2^27 on lavapipe */
    uint64_t max_allocation_bytes;
    uint32_t max_push_bytes, subgroup_size, max_groups_x, max_groups_y, max_workgroup;
    bool float64, timestamps;
    uint8_t uuid[16];        /* of the device, the same for every driver and process */
    uint32_t driver_version; /* in the driver's own encoding */
    char missing[256];       /* what the device lacks for kerrd; "": usable */
};

struct kd_vk_params {
    const char *device;    /* "auto", an index, or part of a name (case-insensitive) */
    const char *cache_dir; /* pipeline cache directory, NULL: $XDG_CACHE_HOME/kerrd, "": none */
    bool validate;         /* enables the Khronos layer with synchronisation validation; also KERRD_VALIDATE=1 */
    /* dispatches have no workgroups and copies to the host are zeros: nothing is computed, but a driver that compiles
     * kernels at their first dispatch does so */
    bool compiles_only;
    /* no memory and no submissions, only pipelines, so that a driver without its hardware will do (RADV with
     * RADV_FORCE_FAMILY) */
    bool pipelines_only;
    /* of one submission, then KD_EDEVICE; 0: 60000. Up to 8 times as long for a software device that gets little
     * processor time */
    uint32_t deadline_ms;
};

/* Lists all devices of this machine, usable or not, in the order of their indices. *out is malloc'd. Returns
 * KD_EDEVICE, with the reason, if there is no loader, driver or device: *count is never 0 on KD_OK. */
enum kd_status kd_vk_list(struct kd_vk_info **out, size_t *count, struct kd_error *error);

enum kd_status kd_vk_create(const struct kd_vk_params *params, struct kd_vk **out, struct kd_error *error);
/* Waits for work under way. A lost device is closed like any other, and can be created again. A hanging device is
 * abandoned with its memory, because drivers crash when it is closed. Then end the process soon, by _exit, since exit
 * handlers of the driver may hang. */
void kd_vk_destroy(struct kd_vk *vk);
bool kd_vk_hangs(const struct kd_vk *vk); /* a submission has missed its deadline */
const struct kd_vk_info *kd_vk_info(const struct kd_vk *vk);
const char *kd_vk_choice(const struct kd_vk *vk);           /* one sentence: why this device was chosen */
uint32_t kd_vk_validation_messages(const struct kd_vk *vk); /* warnings and errors so far */
/* When the driver compiles a kernel: EARLY, when its pipeline is created; LATE, at its first dispatch, on the device's
 * queue. KEEPS_NOTHING: it does not store compiled kernels in files for other devices of the process, as lavapipe
 * otherwise does. dir: the folder of these files, "" if unknown. Any thread. */
enum kd_vk_compiling { KD_VK_COMPILES_EARLY, KD_VK_COMPILES_LATE, KD_VK_COMPILES_LATE_KEEPS_NOTHING };
enum kd_vk_compiling kd_vk_compiling(const struct kd_vk *vk, char dir[4096]);
/* Identifies the folders of these files: changes if they are removed and made again. 0: none. Any thread. */
uint64_t kd_vk_compiled_id(const struct kd_vk *vk);
/* Path of a file in the cache directory for this device and driver version, like that of the pipeline cache; malloc'd.
 * NULL if there is no such directory. Any thread. */
char *kd_vk_cache_file(const struct kd_vk *vk, const char *suffix);

/* Buffers: suballocated from few large allocations. Each can be bound as any kind and copied from and to. UPLOAD and
 * READBACK are host-visible and persistently mapped. A submission sees what the host has written to an UPLOAD buffer
 * before kd_vk_submit. The host sees what the device has written to either after kd_vk_wait. Both hold also where the
 * memory is not coherent. Only the device may write a READBACK buffer. */
enum kd_vk_memory { KD_VK_DEVICE, KD_VK_UPLOAD, KD_VK_READBACK };
enum kd_status kd_vk_buffer_create(struct kd_vk *vk, uint64_t size, enum kd_vk_memory memory, const char *name,
                                   struct kd_vk_buffer **out, struct kd_error *error);
/* May be called at any time. Buffers and pipelines in use are freed when the device has finished with them. */
void kd_vk_buffer_destroy(struct kd_vk *vk, struct kd_vk_buffer *buffer);
void *kd_vk_buffer_map(struct kd_vk_buffer *buffer); /* NULL for KD_VK_DEVICE without host access */
uint64_t kd_vk_buffer_size(const struct kd_vk_buffer *buffer);
uint64_t kd_vk_allocated(const struct kd_vk *vk); /* bytes allocated from the device, for all buffers */

/* How a kernel accesses a binding. A software device reads storage buffers lane by lane with a check for each word, but
 * uniform buffers and texels by vector gathers; on other devices the kinds differ little. Only storage can be written
 * or be as large as max_binding_bytes: a kernel that reads bands of pixels as texels needs a variant that reads them as
 * storage. */
enum kd_vk_kind {
    KD_VK_STORAGE,     /* buffer { } */
    KD_VK_UNIFORM,     /* uniform { }, std140 or std430; max_uniform_bytes */
    KD_VK_TEXELS_R,    /* uniform textureBuffer of R32_SFLOAT, a float in each texel; max_texels */
    KD_VK_TEXELS_RGBA, /* uniform textureBuffer of R32G32B32A32_SFLOAT, four floats in each texel */
    KD_VK_TEXELS_WORD, /* uniform utextureBuffer of R32_UINT, a word in each texel */
    KD_VK_TEXELS_PAIR, /* uniform utextureBuffer of R32G32_UINT, two words in each texel */
};
#define KD_VK_MAX_BINDINGS 12
#define KD_VK_MAX_STORAGE 8 /* storage bindings among these; a usable device has as many */

/* Pipelines: one buffer for each binding 0..n_buffers-1 in set 0, storage unless `kinds` says otherwise; push
 * constants; specialisation constants of 4 bytes. */
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

/* Work: record it with the functions below, then call kd_vk_submit. Commands run in the order of recording. The layer
 * inserts barriers from the declared accesses: between commands that touch the same buffer if one of them writes,
 * against host reads, and against earlier submissions. Passes are timed: the times of one pass name add up over
 * dispatches and submissions. */
struct kd_vk_binding {
    struct kd_vk_buffer *buffer;
    uint64_t offset, size; /* size 0: to the end, for texels rounded down to complete ones; offset: a multiple of 256 */
    bool write;            /* the shader writes, and perhaps reads; storage only */
};
struct kd_vk_dispatch {
    const char *pass; /* outlives the submission, such as a literal */
    const struct kd_vk_pipeline *pipeline;
    struct kd_vk_binding bindings[KD_VK_MAX_BINDINGS];
    const void *push;
    uint32_t groups[3]; /* 0 counts as 1 */
    /* Replaces `groups` if not NULL: three words at this offset, a multiple of 4, that earlier kernels have written,
     * within the device's limits. A 0 among them means no dispatch. */
    struct kd_vk_buffer *counts;
    uint64_t counts_at;
};
enum kd_status kd_vk_dispatch(struct kd_vk *vk, const struct kd_vk_dispatch *dispatch, struct kd_error *error);
enum kd_status kd_vk_copy(struct kd_vk *vk, const char *pass, struct kd_vk_buffer *to, uint64_t to_offset,
                          struct kd_vk_buffer *from, uint64_t from_offset, uint64_t size, struct kd_error *error);
enum kd_status kd_vk_fill(struct kd_vk *vk, const char *pass, struct kd_vk_buffer *buffer, uint64_t offset,
                          uint64_t size, uint32_t value, struct kd_error *error);

/* Submits what was recorded, if anything, and returns at once; *ticket (may be NULL) is the timeline value. With
 * KD_VK_IN_FLIGHT submissions under way it waits for the oldest. */
#define KD_VK_IN_FLIGHT 4
enum kd_status kd_vk_submit(struct kd_vk *vk, uint64_t *ticket, struct kd_error *error);
/* Waits for a ticket (0: everything submitted). If its deadline passes, returns KD_EDEVICE, and the device is lost. */
enum kd_status kd_vk_wait(struct kd_vk *vk, uint64_t ticket, struct kd_error *error);
/* Drops what was recorded and not submitted. */
void kd_vk_discard(struct kd_vk *vk);

/* Device time by pass name since the last reset, of finished submissions (those that kd_vk_submit or kd_vk_wait has
 * seen finished). pass: a copy of the caller's name, valid while the device lives. Beyond KD_VK_MAX_PASSES names the
 * rest is summed as "other". Empty without timestamps. */
struct kd_vk_time {
    const char *pass;
    double ms;
    uint32_t dispatches;
};
#define KD_VK_MAX_PASSES 24
size_t kd_vk_times(const struct kd_vk *vk, struct kd_vk_time out[KD_VK_MAX_PASSES]);
void kd_vk_times_reset(struct kd_vk *vk);

#endif
