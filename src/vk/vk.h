/* Vulkan 1.2 compute device: memory, pipelines, submission, timing. It contains nothing about black holes.
 *
 * One thread owns a struct kd_vk and everything made from it. Other threads may call only kd_vk_list, kd_vk_info on an
 * open device, and functions marked "any thread". kd_vk_pipeline_create may also run on threads for which the owner
 * waits. Every object has a name, for the validation layer and for captures. All destroy functions accept NULL and
 * half-built objects. */
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

/* Types of devices, from the least to the most preferred. */
enum kd_vk_type { KD_VK_OTHER, KD_VK_CPU, KD_VK_VIRTUAL, KD_VK_INTEGRATED, KD_VK_DISCRETE };
const char *kd_vk_type_name(enum kd_vk_type type); /* such as "discrete GPU"; never NULL */

struct kd_vk_info {
    uint32_t index; /* the N of the option --device N */
    char name[256], driver[256], driver_info[256];
    enum kd_vk_type type;
    uint32_t api_version; /* packed as by VK_MAKE_API_VERSION */
    uint64_t heap_bytes;  /* size of the largest device-local heap */
    /* the part of that heap that this process may use now (VK_EXT_memory_budget); 0: unknown */
    uint64_t budget_bytes;
    uint64_t max_binding_bytes; /* largest storage-buffer binding: 128 MiB on lavapipe */
    uint64_t max_uniform_bytes; /* largest uniform-buffer binding: at least 16 KiB, often 64 KiB */
    uint64_t max_texels;        /* largest texel-buffer binding: at least 65536 (SwiftShader), 2^27 on lavapipe */
    uint64_t max_allocation_bytes;
    uint32_t max_push_bytes, subgroup_size, max_groups_x, max_groups_y, max_workgroup;
    bool float64, timestamps;
    /* true if the device's driver is the one that is installed with the program, because the system has none */
    bool own_driver;
    uint8_t uuid[16];        /* UUID of the device; it is the same with every driver and in every process */
    uint32_t driver_version; /* version in the driver's own encoding */
    char missing[256];       /* features that kerrd needs and the device lacks; "": the device is usable */
};

struct kd_vk_params {
    const char *device;    /* "auto", an index, or part of a name (case-insensitive) */
    const char *cache_dir; /* folder of the pipeline cache; NULL: $XDG_CACHE_HOME/kerrd; "": none */
    /* enables the Khronos layer with synchronisation validation; KERRD_VALIDATE=1 does the same */
    bool validate;
    /* If true, dispatches have no workgroups, and copies to the host give zeros. So nothing is computed, but drivers
     * that compile kernels at their first dispatch still compile them. */
    bool compiles_only;
    /* If true, there are no memory and no submissions, only pipelines. So a driver that lacks its hardware is enough
     * (RADV with RADV_FORCE_FAMILY). */
    bool pipelines_only;
    /* Deadline of one submission, after which it fails with KD_EDEVICE; 0: 60000. A software device that gets little
     * processor time may take up to 8 times as long. */
    uint32_t deadline_ms;
};

/* Lists all devices of this machine, usable or not, in the order of their indices. *out is malloc'd. Returns
 * KD_EDEVICE with the reason if there is no loader, driver or device, so that *count is never 0 on KD_OK. */
enum kd_status kd_vk_list(struct kd_vk_info **out, size_t *count, struct kd_error *error);

enum kd_status kd_vk_create(const struct kd_vk_params *params, struct kd_vk **out, struct kd_error *error);
/* Waits for work under way, then closes the device. A lost device is closed like any other, and can be created again. A
 * hanging device is abandoned with its memory, because drivers crash when it is closed. Then the process should end
 * soon, by _exit, because exit handlers of the driver may hang. */
void kd_vk_destroy(struct kd_vk *vk);
bool kd_vk_hangs(const struct kd_vk *vk); /* true if a submission has missed its deadline */
const struct kd_vk_info *kd_vk_info(const struct kd_vk *vk);
const char *kd_vk_choice(const struct kd_vk *vk);           /* one sentence: why this device was chosen */
uint32_t kd_vk_validation_messages(const struct kd_vk *vk); /* number of warnings and errors so far */
/* When the driver compiles a kernel. EARLY: when the kernel's pipeline is created. LATE: at the kernel's first
 * dispatch, on the device's queue; the driver then stores the compiled kernel in files for other devices of the
 * process, as lavapipe does. LATE_KEEPS_NOTHING: like LATE, but the driver stores nothing. dir: the folder of these
 * files, "" if it is unknown. Any thread. */
enum kd_vk_compiling { KD_VK_COMPILES_EARLY, KD_VK_COMPILES_LATE, KD_VK_COMPILES_LATE_KEEPS_NOTHING };
enum kd_vk_compiling kd_vk_compiling(const struct kd_vk *vk, char dir[4096]);
/* Identifies the folders in which the driver stores compiled kernels. The result changes if the folders are removed and
 * made again. 0: there are none. Any thread. */
uint64_t kd_vk_compiled_id(const struct kd_vk *vk);
/* Path of a file in the cache directory; malloc'd. Like the pipeline cache, the file belongs to this device and driver
 * version. NULL if there is no such directory. Any thread. */
char *kd_vk_cache_file(const struct kd_vk *vk, const char *suffix);

/* Buffers are suballocated from a few large allocations. Each can be bound as any kind, and copied from and to. UPLOAD
 * and READBACK are host-visible and persistently mapped. A submission sees what the host has written to an UPLOAD
 * buffer before kd_vk_submit. After kd_vk_wait the host sees what the device has written to an UPLOAD or READBACK
 * buffer. Both statements hold even if the memory is not coherent. Only the device may write a READBACK buffer. */
enum kd_vk_memory { KD_VK_DEVICE, KD_VK_UPLOAD, KD_VK_READBACK };
enum kd_status kd_vk_buffer_create(struct kd_vk *vk, uint64_t size, enum kd_vk_memory memory, const char *name,
                                   struct kd_vk_buffer **out, struct kd_error *error);
/* May be called at any time: buffers and pipelines in use are freed when the device has finished with them. */
void kd_vk_buffer_destroy(struct kd_vk *vk, struct kd_vk_buffer *buffer);
void *kd_vk_buffer_map(struct kd_vk_buffer *buffer); /* NULL for KD_VK_DEVICE, if the host cannot access that memory */
uint64_t kd_vk_buffer_size(const struct kd_vk_buffer *buffer);
uint64_t kd_vk_allocated(const struct kd_vk *vk); /* bytes allocated from the device, for all buffers */

/* The way in which a kernel accesses a binding. A software device reads a storage buffer separately for each lane, with
 * a check for each word. It reads uniform buffers and texels by vector gathers. On other devices the kinds differ
 * little. Only storage can be written or be as large as max_binding_bytes. So a kernel that reads bands of pixels as
 * texels needs a variant that reads them as storage. */
enum kd_vk_kind {
    KD_VK_STORAGE,     /* buffer { } */
    KD_VK_UNIFORM,     /* uniform { }, std140 or std430; at most max_uniform_bytes */
    KD_VK_TEXELS_R,    /* uniform textureBuffer of R32_SFLOAT, one float in each texel; at most max_texels */
    KD_VK_TEXELS_RGBA, /* uniform textureBuffer of R32G32B32A32_SFLOAT, four floats in each texel */
    KD_VK_TEXELS_WORD, /* uniform utextureBuffer of R32_UINT, one word in each texel */
    KD_VK_TEXELS_PAIR, /* uniform utextureBuffer of R32G32_UINT, two words in each texel */
    KD_VK_TEXELS_QUAD, /* uniform utextureBuffer of R32G32B32A32_UINT, four words in each texel */
};
#define KD_VK_MAX_BINDINGS 12
#define KD_VK_MAX_STORAGE 8 /* largest number of storage bindings of a kernel; a usable device permits that many */

/* Pipelines. Set 0 has one buffer for each binding 0..n_buffers-1; it is storage unless `kinds` says otherwise. There
 * are push constants, and specialisation constants of 4 bytes. */
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

/* To run work, record it with the functions below, then call kd_vk_submit. Commands run in the order of recording.
 * From the declared accesses, the layer derives barriers and inserts them. The barriers stand between commands that
 * touch the same buffer if one of them writes, before reads by the host, and after earlier submissions. Passes are
 * timed. The times of passes with the same name add up over dispatches and submissions. */
struct kd_vk_binding {
    struct kd_vk_buffer *buffer;
    /* size 0: up to the end of the buffer, or up to its last complete texel; offset: a multiple of 256 */
    uint64_t offset, size;
    bool write; /* true if the shader writes the buffer, and may read it; storage only */
};
struct kd_vk_dispatch {
    const char *pass; /* must outlive the submission, for example a literal */
    const struct kd_vk_pipeline *pipeline;
    struct kd_vk_binding bindings[KD_VK_MAX_BINDINGS];
    const void *push;
    uint32_t groups[3]; /* 0 counts as 1 group */
    /* If not NULL, three words in this buffer replace `groups`. The words begin at the offset counts_at, a multiple
     * of 4. Earlier kernels have written the words, within the device's limits. If one of the words is 0, nothing is
     * dispatched. */
    struct kd_vk_buffer *counts;
    uint64_t counts_at;
};
enum kd_status kd_vk_dispatch(struct kd_vk *vk, const struct kd_vk_dispatch *dispatch, struct kd_error *error);
enum kd_status kd_vk_copy(struct kd_vk *vk, const char *pass, struct kd_vk_buffer *to, uint64_t to_offset,
                          struct kd_vk_buffer *from, uint64_t from_offset, uint64_t size, struct kd_error *error);
enum kd_status kd_vk_fill(struct kd_vk *vk, const char *pass, struct kd_vk_buffer *buffer, uint64_t offset,
                          uint64_t size, uint32_t value, struct kd_error *error);

/* Submits what was recorded, if anything, and returns at once. *ticket is the timeline value; ticket may be NULL. If
 * KD_VK_IN_FLIGHT submissions are under way, kd_vk_submit waits for the oldest. */
#define KD_VK_IN_FLIGHT 4
enum kd_status kd_vk_submit(struct kd_vk *vk, uint64_t *ticket, struct kd_error *error);
/* Waits for a ticket (0: everything submitted). Returns KD_EDEVICE if the deadline passes; the device is then lost. */
enum kd_status kd_vk_wait(struct kd_vk *vk, uint64_t ticket, struct kd_error *error);
/* Drops what was recorded but not submitted. */
void kd_vk_discard(struct kd_vk *vk);

/* Device time by the name of the pass, since the last reset. Only finished submissions count, as far as kd_vk_submit
 * or kd_vk_wait has found them finished. pass: a copy of the caller's name, valid while the device lives. Beyond
 * KD_VK_MAX_PASSES names, the others are added up as "other". There are no times if the device has no timestamps. */
struct kd_vk_time {
    const char *pass;
    double ms;
    uint32_t dispatches;
};
#define KD_VK_MAX_PASSES 24
size_t kd_vk_times(const struct kd_vk *vk, struct kd_vk_time out[KD_VK_MAX_PASSES]);
void kd_vk_times_reset(struct kd_vk *vk);

#endif
