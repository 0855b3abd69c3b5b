/* Options that choose a scene, common to render, plan and scene. Main thread only.
 *
 * The scene is merged in this order: the defaults or --preset; the document SCENE, or the scene in the picture of
 * --from; every --set and --size in the order given. Then the names of assets are resolved by --asset. */
#ifndef KD_CLI_SCENE_OPTIONS_H
#define KD_CLI_SCENE_OPTIONS_H

#include "cli/asset_options.h"
#include "scene/scene.h"

#include <argp.h>
#include <stdbool.h>

struct kd_scene_options {
    const char *document; /* a path or "-"; NULL: none */
    const char *preset, *from;
    /* the document is not a scene but is merged over one, so that it can be combined with --from */
    bool document_is_over;
    const char **set; /* texts "path=value" */
    size_t n_set;
    struct kd_asset_options assets;
    char width[32], height[32]; /* values of --size in that list */
    char tile[4][40];           /* values of --tile in that list */
};

#define KD_SCENE_ARGS_DOC "[SCENE.json|-]"

/* An argp child; its input is a struct kd_scene_options initialised to 0. Takes the positional argument. */
extern const struct argp kd_scene_options_argp;
/* These options and the two of cli.h, the scene's first. */
extern const struct argp_child kd_scene_device_children[];

/* Loads and validates the merged scene. */
enum kd_status kd_scene_options_load(struct kd_scene_options *options, struct kd_scene *out, struct kd_error *error);
/* The same over *scene, for options without --preset and --from. */
enum kd_status kd_scene_options_merge(struct kd_scene_options *options, struct kd_scene *scene, struct kd_error *error);
/* Applies every --set and --size to *scene, without validation. */
enum kd_status kd_scene_options_set(const struct kd_scene_options *options, struct kd_scene *scene,
                                    struct kd_error *error);
/* Append "path=value", and a size "1920x1080" or tile as its fields. Return false when out of memory or malformed. */
bool kd_scene_options_add_set(struct kd_scene_options *options, const char *text);
bool kd_scene_options_add_size(struct kd_scene_options *options, const char *text);
bool kd_scene_options_add_tile(struct kd_scene_options *options, const char *text);
void kd_scene_options_finish(struct kd_scene_options *options);

#endif
