/* A sweep is a scene with axes: fields, each of which takes some values, and a scene of every combination. Nothing
 * changes a sweep once it has been read: any thread may use it.
 *
 *     {"spacetime.spin": [0, 0.5, 0.9], "camera.inclination_deg": "10:80:15", "disk.model": ["novikov-thorne",
 *       "particles"]}
 *
 * Scenes are numbered from 0 on in the order of the axes, the last one fastest, as the elements of an array in C. A
 * field is named by its path, as for kd_scene_set, and the axes set theirs one after the other: a style before all
 * others, since it sets many fields.
 *
 * A range START:STOP:STEP is START, START + STEP, ... as far as STOP, which is one of them if a whole number of
 * steps leads there: "10:80:15" is 10, 25, 40, 55, 70, and "10:70:15" the same. START:STOP/N is N values, evenly
 * spaced, of which both ends are the first and the last. They are rounded to 15 digits. */
#ifndef KD_SCENE_SWEEP_H
#define KD_SCENE_SWEEP_H

#include "base/json.h"
#include "scene/asset.h"
#include "scene/scene.h"

#include <cjson/cJSON.h>

enum { KD_SWEEP_AXES = 8 };
#define KD_SWEEP_MOST 100000 /* scenes: what lists of them hold; what they cost is limited by whoever renders them */

struct kd_sweep_axis {
    char *path;       /* "camera.inclination_deg" */
    const char *unit; /* of the field: "deg"; "1": a pure number; "": none */
    bool numeric;     /* all of its values are numbers */
    bool even;        /* and each is a step more than the one before, to 1e-12 of the larger end */
    size_t n;
    struct kd_sweep_value {
        char *text;    /* as kd_scene_set takes it; of an asset its hash, once it is resolved */
        double number; /* NAN: it is none */
    } *values;
};

struct kd_sweep {
    struct kd_scene base;
    struct kd_sweep_axis axes[KD_SWEEP_AXES];
    size_t n_axes;
    unsigned scenes;
};

/* Reads an object of axes over a valid scene. Every value is one that its field takes; whether the scenes are valid
 * says kd_sweep_scene. assets: those that scenes may name; NULL: hashes are taken as they are. KD_EINVAL with the
 * pointer /axes/FIELD/NUMBER, KD_ENOMEM. */
enum kd_status kd_sweep_read(const cJSON *axes, const struct kd_scene *base, const struct kd_assets *assets,
                             struct kd_sweep **out, struct kd_error *error);

/* The same of a command line: n texts FIELD=VALUE,VALUE,... or FIELD=RANGE. */
enum kd_status kd_sweep_typed(const char *const *axes, size_t n, const struct kd_scene *base,
                              const struct kd_assets *assets, struct kd_sweep **out, struct kd_error *error);
void kd_sweep_free(struct kd_sweep *sweep); /* accepts NULL */

/* The value that an axis has in a scene. */
const struct kd_sweep_value *kd_sweep_at(const struct kd_sweep *sweep, unsigned scene, size_t axis);
/* Makes a scene, valid; KD_EINVAL at /axes, with its values, where a combination is not. */
enum kd_status kd_sweep_scene(const struct kd_sweep *sweep, unsigned scene, struct kd_scene *out,
                              struct kd_error *error);

/* Writes a value as JSON; KD_ENOMEM. */
enum kd_status kd_sweep_value_json(const struct kd_sweep_value *value, struct kd_buffer *out);
/* Writes a member: the axes as kd_sweep_read takes them, each a list. */
void kd_sweep_axes_json(const struct kd_sweep *sweep, struct kd_json *json, const char *name);
/* Writes the name of a scene's file without its end: "000012 spin=0.9 inclination_deg=40". What no file name should
 * hold is "_"; a long one is cut. */
enum { KD_SWEEP_NAME = 160 };
void kd_sweep_name(const struct kd_sweep *sweep, unsigned scene, char out[KD_SWEEP_NAME]);

#endif
