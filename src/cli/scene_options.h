/* Options that choose a scene; several subcommands have them. Main thread only.
 *
 * The scene is merged in this order: the defaults or --preset; the document SCENE, or the scene in the picture of
 * --from; every --set and --size in the order in which they are given. Then --asset replaces the names of assets. */
#ifndef KD_CLI_SCENE_OPTIONS_H
#define KD_CLI_SCENE_OPTIONS_H

#include "cli/asset_options.h"
#include "scene/scene.h"

#include <argp.h>
#include <stdbool.h>

struct kd_scene_options {
    const char *document; /* a path or "-"; NULL: none */
    const char *preset, *from;
    /* true if the document is a patch for another scene, so that it may be combined with --from */
    bool document_is_over;
    const char **set; /* texts "path=value" from --set, --size and --tile */
    size_t n_set;
    struct kd_asset_options assets;
    char width[32], height[32]; /* storage for the entries of `set` that come from --size */
    char tile[4][40];           /* storage for the entries of `set` that come from --tile */
};

#define KD_SCENE_ARGS_DOC "[SCENE.json|-]"

/* A child for argp, with these options. Its input is a struct kd_scene_options, initialised to 0. It also parses the
 * positional argument. */
extern const struct argp kd_scene_options_argp;
/* Children for argp: these options first, and then the two children of cli.h. */
extern const struct argp_child kd_scene_device_children[];

/* Loads and validates the merged scene. */
enum kd_status kd_scene_options_load(struct kd_scene_options *options, struct kd_scene *out, struct kd_error *error);
/* Like kd_scene_options_load, but the options are merged over *scene. For commands without --preset and --from. */
enum kd_status kd_scene_options_merge(struct kd_scene_options *options, struct kd_scene *scene, struct kd_error *error);
/* Applies all --set and --size options to *scene, without validation. */
enum kd_status kd_scene_options_set(const struct kd_scene_options *options, struct kd_scene *scene,
                                    struct kd_error *error);
/* Each appends texts "path=value": the text itself, the fields of a size such as "1920x1080", or the fields of a
 * tile. Returns false when out of memory, or if the text is malformed. */
bool kd_scene_options_add_set(struct kd_scene_options *options, const char *text);
bool kd_scene_options_add_size(struct kd_scene_options *options, const char *text);
bool kd_scene_options_add_tile(struct kd_scene_options *options, const char *text);
void kd_scene_options_finish(struct kd_scene_options *options);

#endif
