/* Pictures made of parts that are rendered one after the other (render/plan/parts.c): a pair of eyes, a tile with
 * its margin, strips. Render thread only. */
#ifndef KD_RENDER_FRAME_PARTS_H
#define KD_RENDER_FRAME_PARTS_H

#include "render/frame/frame.h"
#include "render/plan/plan.h"

struct kd_parted {
    struct kd_renderer *renderer;
    const struct kd_scene *scene;
    const struct kd_plan *plan;
    bool background; /* true for kd_render_in_background; parts have no previews */
    kd_progress_fn progress;
    void *user;
};

/* kd_plan_is_parted: true if a plan consists of parts. kd_frame_parted: renders such a plan into *out, the whole
 * picture. In a pair the left eye's picture is on the left, and both pictures have the left eye's exposure. */
static inline bool kd_plan_is_parted(const struct kd_plan_picture *picture)
{
    return picture->eyes == 2 || picture->cut.width || picture->strips;
}
enum kd_status kd_frame_parted(const struct kd_parted *parted, struct kd_frame *out, struct kd_error *error);

/* Renders one part, by its own plan. */
enum kd_status kd_frame_render_part(const struct kd_parted *parted, const struct kd_scene *scene,
                                    const struct kd_plan *plan, kd_progress_fn progress, void *user,
                                    struct kd_frame *out, struct kd_error *error);

/* Merges the report of a further part (times, accuracy, whether the part's lens map was cached) into *to. Counts are
 * added; the larger of two errors is kept. */
void kd_frame_probe_both(struct kd_frame *to, const struct kd_frame *from);

enum kd_status kd_frame_pair(const struct kd_parted *parted, struct kd_frame *out, struct kd_error *error);
enum kd_status kd_frame_tile(const struct kd_parted *parted, struct kd_frame *out, struct kd_error *error);
enum kd_status kd_frame_strips(const struct kd_parted *parted, struct kd_frame *out, struct kd_error *error);

#endif
