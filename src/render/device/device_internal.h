/* Internals of a renderer, shared by the files of src/render. */
#ifndef KD_RENDER_DEVICE_INTERNAL_H
#define KD_RENDER_DEVICE_INTERNAL_H

#include "render/device/verdict.h"
#include "render/device/kernels.h"
#include "render/device/grids.h"
#include "render/device/memory_share.h"
#include "render/device/panoramas.h"
#include "render/device/prepare.h"
#include "render/device/renderer.h"
#include "render/device/rest.h"
#include "render/device/skies.h"
#include "render/device/slice_pace.h"
#include "render/device/store.h"
#include "render/emit/emitter.h"
#include "render/device/normalised.h"

#include <pthread.h>
#include <stdatomic.h>

/* Working set of one kd_render_in_background. Its lens maps stay cached for other pictures until the memory is
 * needed. */
struct kd_background_render {
    struct kd_store store;
    struct kd_prepared prepared;
    bool busy;
    uint64_t used; /* the value of a counter at the last use, to find the least recently used */
};

struct kd_renderer {
    struct kd_vk *vk; /* NULL: the device was lost and could not be reopened */
    struct kd_opening {
        char *device, *cache_dir;
        bool validate, compiles_only;
        uint32_t deadline_ms;
    } opening;                /* the parameters with which the device was opened */
    struct kd_vk_info opened; /* description of the opened device */
    /* path of the device's cache files without a suffix (kd_vk_cache_file); NULL: there is no cache folder */
    char *files;
    struct kd_kernels kernels;
    struct kd_store store;
    struct kd_prepared prepared;
    struct kd_background_render background_renders[KD_BACKGROUND_RENDERS];
    uint64_t backgrounds_used;
    /* two sets of buffers, reused for the next list of rays (rays/device.c). A set has the rays in a buffer that the
     * host writes, their ends on the device, and their ends on the host */
    struct kd_vk_buffer *rays[2][3];
    struct kd_rays_pace {
        enum kd_engine engine;
        enum kd_precision precision;
        uint32_t steps, orders, size;
    } rays_pace;
    bool passing; /* `passing`, `lacks` and `lacks_user` have the same meaning as in kd_renderer_params */
    bool (*lacks)(void *user, struct kd_compilation *compilation, bool background);
    void *lacks_user;
    struct kd_emit_state *emit; /* numbers and tables of the emitters after the last frame */
    struct kd_panoramas panoramas;
    struct kd_grids grids;
    struct kd_normalised normalised;
    pthread_mutex_t lock;        /* guards capacity and memory */
    struct kd_capacity capacity; /* capacity without the host's limit, which kd_renderer_capacity applies */
    struct kd_memory_watch memory;
    _Atomic uint64_t held; /* bytes of device buffers after the last frame */
    _Atomic uint64_t kept_bytes[KD_N_CACHE_KINDS];
    _Atomic uint64_t opened_bytes; /* bytes that were resident after the device was last opened */
    /* values right after the device was first opened. started_bytes: resident bytes; started_heap: heap bytes in use */
    _Atomic uint64_t started_bytes, started_heap;
    /* accuracy table of this device, read from disk when the renderer was created; NULL: none */
    struct kd_accuracy_table *accuracy;
    struct kd_verdict verdict;
    struct kd_capacity stored;       /* capacity as it is stored in the file */
    struct kd_slice_pace slice_pace; /* pace of pictures that release the device between slices */
    uint32_t frames;                 /* number of frames so far, counted by learn.c */
    /* if true, the cost of a pass is the smallest of its measured costs; if false, it is their running mean */
    bool probing;
    char name[800]; /* `device` and `driver`, joined */
    char device[256], driver[520];
};

#endif
