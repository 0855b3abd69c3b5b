/* These options choose a scene, and are the same for render, plan and scene. Main thread only.
 *
 * Merged in this order, each over what came before: the defaults or --preset; the document SCENE, or
 * the one inside the picture of --from; every --set and --size as given. Then names of assets are resolved by
 * --asset. */
#ifndef KD_CLI_SCENE_OPTIONS_H
#define KD_CLI_SCENE_OPTIONS_H

#include "cli/asset_options.h"
#include "scene/scene.h"

#include <argp.h>
#include <stdbool.h>

struct kd_scene_options {
    const char *document; /* a path or "-"; NULL: none */
    const char *preset, *from;
    bool document_is_over; /* the document is no scene, but is merged over one: --from goes with it */
    const char **set;      /* "path=value" */
    size_t n_set;
    struct kd_asset_options assets;
    char width[32], height[32]; /* what --size is in that list, */
    char tile[4][40];           /* and --tile */
};

#define KD_SCENE_ARGS_DOC "[SCENE.json|-]"

/* An argp child; its input is a struct kd_scene_options that starts zeroed. Takes the positional argument. */
extern const struct argp kd_scene_options_argp;
/* That and the two of cli.h, the scene first. */
extern const struct argp_child kd_scene_device_children[];

/* The merged scene, valid. */
enum kd_status kd_scene_options_load(struct kd_scene_options *options, struct kd_scene *out, struct kd_error *error);
/* The same of options without --preset and --from, over what *scene is. */
enum kd_status kd_scene_options_merge(struct kd_scene_options *options, struct kd_scene *scene, struct kd_error *error);
/* Every --set and --size, in what *scene is; it need not be valid afterwards. */
enum kd_status kd_scene_options_set(const struct kd_scene_options *options, struct kd_scene *scene,
                                    struct kd_error *error);
/* Append one "path=value", and a size "1920x1080" as the two that it is; false: no memory, or no size. */
bool kd_scene_options_add_set(struct kd_scene_options *options, const char *text);
bool kd_scene_options_add_size(struct kd_scene_options *options, const char *text);
bool kd_scene_options_add_tile(struct kd_scene_options *options, const char *text);
void kd_scene_options_finish(struct kd_scene_options *options);

#endif
