#include "scene/scene.h"

bool kd_scene_has_tile(const struct kd_scene *scene) { return scene->tile.width > 0; }

struct kd_window kd_scene_window(const struct kd_scene *scene)
{
    const struct kd_tile *t = &scene->tile;
    if (!kd_scene_has_tile(scene))
        return (struct kd_window) { .width = (uint32_t)scene->image.width, .height = (uint32_t)scene->image.height };
    return (struct kd_window) { (uint32_t)t->left, (uint32_t)t->top, (uint32_t)t->width, (uint32_t)t->height };
}

struct kd_scene kd_scene_tile(const struct kd_scene *scene, struct kd_window window)
{
    struct kd_scene tile = *scene;
    tile.tile.left = (int32_t)window.left, tile.tile.top = (int32_t)window.top;
    tile.tile.width = (int32_t)window.width, tile.tile.height = (int32_t)window.height;
    return tile;
}

struct kd_scene kd_scene_whole(const struct kd_scene *scene) { return kd_scene_tile(scene, (struct kd_window) { 0 }); }
