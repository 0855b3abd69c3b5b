/* Emitters make things on the device before light is: buffers of their own, which the transfer pass reads. The device's side of
 * struct kd_emitter (render/emit/emitter.h): one that says by `device_bytes` that it has any has a line in the table of prepare.c, a
 * member in struct kd_prepared (internal.h), and a file here like deposit.c. Frames fold over the table and know no names. Render
 * thread only. */
#ifndef KD_RENDER_DEVICE_PREPARE_H
#define KD_RENDER_DEVICE_PREPARE_H

#include "render/emit/emitter.h"

struct kd_capacity;
struct kd_error;
struct kd_plan;
struct kd_prepared; /* the emitters' buffers, {0} while there are none: render/device/internal.h */
struct kd_renderer;
struct kd_vk;
struct kd_vk_buffer;

struct kd_preparation {
    /* Record, and submit, what brings the buffers to what the scene shows now. */
    enum kd_status (*prepare)(struct kd_renderer *r, struct kd_prepared *own, const struct kd_scene *scene, const struct kd_capacity *c,
                              struct kd_error *error);
    void (*buffers)(const struct kd_prepared *own, struct kd_vk_buffer *out[KD_OWN_COUNT]); /* sets its own, by KD_OWN_... (emission.h) */
    void (*forget)(struct kd_prepared *own); /* what was recorded may not have come to the device: work was given up */
    void (*finish)(struct kd_prepared *own, struct kd_vk *vk);
};
/* NULL: the emitter has no buffers. */
extern const struct kd_preparation *const kd_preparations[KD_EMITTER_COUNT];

/* Prepares all emitters that the plan's scene has. */
enum kd_status kd_prepare(struct kd_renderer *renderer, struct kd_prepared *prepared, const struct kd_scene *scene,
                          const struct kd_plan *plan, const struct kd_capacity *capacity, struct kd_error *error);
/* Buffers for the kernels of light, by their numbers; NULL: of emitters that the scene has not. */
void kd_prepared_buffers(const struct kd_prepared *prepared, const struct kd_plan *plan, struct kd_vk_buffer *out[KD_OWN_COUNT]);
void kd_prepared_forget(struct kd_prepared *prepared);
void kd_prepared_finish(struct kd_prepared *prepared, struct kd_vk *vk);

#endif
