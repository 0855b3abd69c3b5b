/* Lets emitters fill their device buffers, which the transfer pass reads (render/emit/own.h). The code iterates over
 * the table of emitters and contains no emitter's name. Render thread only. */
#ifndef KD_RENDER_DEVICE_PREPARE_H
#define KD_RENDER_DEVICE_PREPARE_H

#include "render/emit/emitter.h"
#include "render/emit/own.h"

struct kd_capacity;
struct kd_error;
struct kd_plan_light;
struct kd_renderer;
struct kd_vk;
struct kd_vk_buffer;

/* State of each emitter, as large as the emitter requests; NULL: none yet. */
struct kd_prepared { void *own[KD_EMITTER_COUNT]; };

/* Starts the work that emitters do on the host, on threads of their own. */
void kd_prepare_begin(struct kd_renderer *renderer, const struct kd_scene *scene, const struct kd_plan_light *light);
/* Calls `tell` of all emitters of the scene. Call this after kd_emit_update. */
enum kd_status kd_prepare_tell(struct kd_renderer *renderer, const struct kd_scene *scene,
                               const struct kd_plan_light *light, struct kd_emission *out, char *credit, size_t size,
                               struct kd_error *error);
/* Calls `prepare` of all emitters of the scene. */
enum kd_status kd_prepare(struct kd_renderer *renderer, struct kd_prepared *prepared, const struct kd_scene *scene,
                          const struct kd_plan_light *light, const struct kd_capacity *capacity,
                          struct kd_error *error);
/* Sets *out to the renderer's own state of one emitter that has buffers, for requests other than frames. */
enum kd_status kd_prepare_asked(struct kd_renderer *renderer, enum kd_emitter_number number,
                                struct kd_emitter_buffers_work *out, struct kd_error *error);
/* Lists the buffers for the kernels of light, by number. Buffers of emitters that the scene does not have are NULL. */
void kd_prepared_buffers(const struct kd_prepared *prepared, const struct kd_plan_light *light,
                         struct kd_vk_buffer *out[KD_OWN_COUNT]);
void kd_prepared_forget(struct kd_prepared *prepared);
void kd_prepared_finish(struct kd_prepared *prepared, struct kd_vk *vk);

#endif
