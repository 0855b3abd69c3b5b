/* Device buffers of an emitter, which the kernels of light read (KD_BUFFERS_name of shaders/shared/emitters.h). The
 * emitter fills the buffers before the transfer pass: from the host, or by its own pass (KD_PASS_name there) with the
 * kernel shaders/comp/NAME.comp. A frame iterates over the table of emitters (device/prepare.h) and contains no
 * emitter's name. Render thread only. */
#ifndef KD_RENDER_EMIT_OWN_H
#define KD_RENDER_EMIT_OWN_H

#include "render/emit/emission.h"
#include "vk/vk.h"

#include <stddef.h>
#include <stdint.h>

struct kd_renderer;
struct kd_scene;

/* The working set of an emitter. A long picture that releases the device has its own copy of `own`
 * (kd_render_in_background). */
struct kd_emitter_buffers_work {
    struct kd_renderer *renderer;
    struct kd_vk *vk;
    void *own; /* state of kd_emitter_buffers.bytes bytes, zero at first */
    double ns; /* estimated cost of an invocation of the emitter's pass; 0: the emitter has no pass */
};

struct kd_emitter_buffers {
    size_t bytes; /* size of the emitter's state, which is its buffers and a record of their contents */
    /* Records and submits the commands that bring the buffers up to date with the scene. Kernels are timed under the
     * emitter's name, and copies as "upload". */
    enum kd_status (*prepare)(const struct kd_emitter_buffers_work *work, const struct kd_scene *scene,
                              struct kd_error *error);
    void (*buffers)(const void *own,
                    /* sets the emitter's own entries, indexed by KD_OWN_... (emission.h) */
                    struct kd_vk_buffer *out[KD_OWN_COUNT]);
    void (*forget)(void *own); /* called if work was given up: recorded commands may not have run, so the contents of
                                  the buffers are unknown */
    void (*finish)(void *own, struct kd_vk *vk);
    /* Starts slow work of the host on a thread. `tell` and `prepare` wait for that work. NULL: the emitter has no
     * such work. */
    void (*begin)(struct kd_renderer *renderer, const struct kd_scene *scene);
    /* Completes the emitter's numbers after `fill` with numbers that the scene does not contain, and writes the
     * credit of the picture's sources. NULL: the emitter needs neither. */
    enum kd_status (*tell)(struct kd_renderer *renderer, const struct kd_scene *scene, struct kd_emission *out,
                           char *credit, size_t size, struct kd_error *error);
};

/* Services of the renderer for `prepare`. kd_emitter_buffers_at_least replaces *buffer if it has fewer than `bytes`
 * bytes; *buffer is NULL at first. */
enum kd_status kd_emitter_buffers_at_least(const struct kd_emitter_buffers_work *work, struct kd_vk_buffer **buffer,
                                           uint64_t bytes, enum kd_vk_memory memory, const char *name,
                                           struct kd_error *error);
/* Finds or makes the pipeline of a kernel with specialisation constants 0..n-1. `kernel` points to constant data
 * without a specialisation of its own. */
enum kd_status kd_emitter_buffers_kernel(const struct kd_emitter_buffers_work *work,
                                         const struct kd_vk_pipeline_params *kernel, const uint32_t *constants,
                                         size_t n, const struct kd_vk_pipeline **out, struct kd_error *error);

/* The buffers of the sky are in device/skies.c, which caches panoramas for all pictures of a renderer. The buffers
 * of matter at a radio frequency are in device/grids.c, which reads volume.grid. */
extern const struct kd_emitter_buffers kd_emitter_buffers_sky, kd_emitter_buffers_plasma;

#endif
