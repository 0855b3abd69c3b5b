/* A tile (image.tile) is a part of a picture. It is identical, byte by byte, to the same part of the whole picture.
 * Light at the tile's edges depends on rays beyond the edges. So a tile is rendered with a margin of surrounding
 * pixels, as far as the picture has them. Then the margin is cut off. A tile cannot use anything that depends on all
 * pixels at once. This excludes exposure "auto", bloom, a beam, and rays chosen by the displayed picture. Pure; any
 * thread. */
#ifndef KD_RENDER_PLAN_TILE_H
#define KD_RENDER_PLAN_TILE_H

#include "base/error.h"
#include "scene/scene.h"

struct kd_needs;

/* Returns KD_EINVAL if a tile cannot meet a request by itself; the message names an alternative. */
enum kd_status kd_tile_check(const struct kd_scene *scene, const struct kd_needs *needs, struct kd_error *error);

/* The scene whose tile includes the margin. *cut (may be NULL): place of the original tile within the larger tile. */
struct kd_scene kd_tile_with_margin(const struct kd_scene *scene, struct kd_window *cut);

/* kd_tile_strip: strip i of n of a scene's window, counted from the top. kd_tile_strips: number of these strips that
 * are not empty. */
struct kd_scene kd_tile_strip(const struct kd_scene *scene, uint32_t n, uint32_t i);
uint32_t kd_tile_strips(const struct kd_scene *scene, uint32_t n);

#endif
