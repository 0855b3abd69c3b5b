/* Buffers of an emitter's own on the device, which the kernels of light read (KD_BUFFERS_name of
 * shaders/shared/emitters.h). The emitter fills them before the transfer pass: from the host, or by a pass of its own
 * (KD_PASS_name there) with the kernel shaders/comp/NAME.comp. Frames fold over the table of emitters
 * (device/prepare.h) and know no names. Render thread only. */
#ifndef KD_RENDER_EMIT_OWN_H
#define KD_RENDER_EMIT_OWN_H

#include "render/emit/emission.h"
#include "vk/vk.h"

#include <stddef.h>
#include <stdint.h>

struct kd_renderer;
struct kd_scene;

/* An emitter works with these. Slices of a long picture have `own` apart from other pictures' (kd_render_aside). */
struct kd_own_work {
    struct kd_renderer *renderer;
    struct kd_vk *vk;
    void *own; /* struct kd_own says how many bytes, which are 0 at first */
    double ns; /* that an invocation of its pass is estimated at; 0: it has none */
};

struct kd_own {
    size_t bytes; /* of what it keeps: its buffers, and what is in them */
    /* Record, and submit, what brings the buffers to what the scene shows now. Commands are timed under the
     * emitter's name. */
    enum kd_status (*prepare)(const struct kd_own_work *work, const struct kd_scene *scene, struct kd_error *error);
    void (*buffers)(const void *own,
                    struct kd_vk_buffer *out[KD_OWN_COUNT]); /* sets its own, by KD_OWN_... (emission.h) */
    void (*forget)(void *own); /* what was recorded may not have come to the device: work was given up */
    void (*finish)(void *own, struct kd_vk *vk);
    /* Begin what takes long on the host alone, on a thread of its own; `tell` and `prepare` wait for it. NULL:
     * nothing does. */
    void (*begin)(struct kd_renderer *renderer, const struct kd_scene *scene);
    /* Complete the emitter's numbers by what the scene does not say, after its `fill`; and write who is to be named
     * for the picture, whose work is in it. NULL: neither. */
    enum kd_status (*tell)(struct kd_renderer *renderer, const struct kd_scene *scene, struct kd_emission *out,
                           char *credit, size_t size, struct kd_error *error);
};

/* The renderer does these for `prepare`. *buffer, NULL at first, becomes one of at least so many bytes. */
enum kd_status kd_own_at_least(const struct kd_own_work *work, struct kd_vk_buffer **buffer, uint64_t bytes,
                               enum kd_vk_memory memory, const char *name, struct kd_error *error);
/* Makes the pipeline of a kernel with specialisation constants 0..n-1, or finds it. What `kernel` points to is
 * constant data, without a specialisation of its own. */
enum kd_status kd_own_kernel(const struct kd_own_work *work, const struct kd_vk_pipeline_params *kernel,
                             const uint32_t *constants, size_t n, const struct kd_vk_pipeline **out,
                             struct kd_error *error);

/* The sky's is device/skies.c: it keeps panoramas for all pictures of a renderer. That of matter at a radio
 * frequency is device/grids.c, which reads volume.grid. */
extern const struct kd_own kd_own_sky, kd_own_plasma;

#endif
