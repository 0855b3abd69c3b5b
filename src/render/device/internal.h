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
#include "render/device/store.h"
#include "render/emit/emitter.h"
#include "render/device/normalised.h"

#include <pthread.h>
#include <stdatomic.h>

/* One kd_render_aside works in this. Its lens maps are kept for whoever can use them, until their memory is needed. */
struct kd_aside {
    struct kd_store store;
    struct kd_prepared prepared;
    bool busy;
    uint64_t used; /* the larger, the later */
};

struct kd_renderer {
    struct kd_vk *vk; /* NULL: it was lost, and could not be opened again */
    struct kd_opening {
        char *device, *cache_dir;
        bool validate, compiles_only;
        uint32_t deadline_ms;
    } opening;                /* how it was opened, */
    struct kd_vk_info opened; /* and what it is */
    char *files;              /* kd_vk_cache_file without a suffix; NULL: there is no folder */
    struct kd_kernels kernels;
    struct kd_store store;
    struct kd_prepared prepared;
    struct kd_aside asides[KD_ASIDES];
    uint64_t asides_used;
    struct kd_vk_buffer
        *rays[2][3]; /* a list, its ends, and those on the host: rays/device.c's, kept for the next list */
    struct kd_rays_pace {
        enum kd_engine engine;
        enum kd_precision precision;
        uint32_t steps, orders, size;
    } rays_pace;
    bool passing; /* as kd_renderer_params, like the next */
    bool (*lacks)(void *user, struct kd_compilation *compilation, bool aside);
    void *lacks_user;
    struct kd_emit_state *emit; /* numbers and tables of the emitters, as of the last frame */
    struct kd_panoramas panoramas;
    struct kd_grids grids;
    struct kd_normalised normalised;
    pthread_mutex_t lock;        /* guards capacity and memory */
    struct kd_capacity capacity; /* but for what the host leaves, which kd_renderer_capacity sees to */
    struct kd_memory_watch memory;
    _Atomic uint64_t held; /* bytes of device buffers, as of the last frame */
    _Atomic uint64_t kept_bytes[KD_N_KEPT_KINDS];
    _Atomic uint64_t opened_bytes; /* resident when the device had been opened, the last time; and the first: */
    _Atomic uint64_t started_bytes, started_heap; /* resident, and in use of the heap */
    struct kd_accuracy_table *accuracy; /* of this device, as on disk when the renderer was made; NULL: none */
    struct kd_verdict verdict;
    struct kd_capacity kept; /* as it is in the file */
    uint32_t frames;         /* so far, as learn.c counts them */
    bool probing;            /* of what frames cost the least counts, not a mean */
    char name[800];          /* both of what follows */
    char device[256], driver[520];
};

#endif
