/* A tile of a picture (image.tile) is the same to the byte as there. It is made with a margin of the pixels round
 * it, as far as the picture has them, since light at its edges depends on rays beyond them, and cut out of that.
 * What is made of all pixels at once no tile can have: exposure "auto", what a lens or a beam spreads, rays chosen
 * by what the picture shows. Pure; any thread. */
#ifndef KD_RENDER_PLAN_TILE_H
#define KD_RENDER_PLAN_TILE_H

#include "base/error.h"
#include "scene/scene.h"

struct kd_needs;

/* KD_EINVAL where what is asked for cannot be made of a tile alone; the message says what would do. */
enum kd_status kd_tile_check(const struct kd_scene *scene, const struct kd_needs *needs, struct kd_error *error);

/* The scene whose tile is that of `scene` and its margin; *cut, unless NULL: where the tile lies in it. */
struct kd_scene kd_tile_with_margin(const struct kd_scene *scene, struct kd_window *cut);

/* Strip i of n of what a scene's window is, rows from the top, and how many are not empty. */
struct kd_scene kd_tile_strip(const struct kd_scene *scene, uint32_t n, uint32_t i);
uint32_t kd_tile_strips(const struct kd_scene *scene, uint32_t n);

#endif
