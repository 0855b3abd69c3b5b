/* A sweep is a scene with axes. Each axis is a field with a list of values. The sweep has one scene for every
 * combination of the axes' values. A sweep is immutable once it is read; any thread may use it.
 *
 *     {"spacetime.spin": [0, 0.5, 0.9], "camera.inclination_deg": "10:80:15",
 *      "disk.model": ["novikov-thorne", "particles"]}
 *
 * Scenes are numbered from 0. The last axis changes fastest, like the last index of an array in C. A field is named
 * by its path, as for kd_scene_set. The axes are applied in order, except that a style is always applied first,
 * because it sets many fields.
 *
 * A range START:STOP:STEP is START, START + STEP, ... up to STOP. STOP is included if a whole number of steps
 * reaches it: "10:80:15" is 10, 25, 40, 55, 70, and so is "10:70:15". START:STOP/N has N evenly spaced values,
 * including both ends. Values of ranges are rounded to 15 digits. */
#ifndef KD_SCENE_SWEEP_H
#define KD_SCENE_SWEEP_H

#include "base/json.h"
#include "scene/asset.h"
#include "scene/scene.h"

#include <cjson/cJSON.h>

enum { KD_SWEEP_AXES = 8 };
/* limit of the number of scenes, which bounds lists of scenes; the cost is limited by renderers */
#define KD_SWEEP_MOST 100000

struct kd_sweep_axis {
    char *path;       /* path of the field, such as "camera.inclination_deg" */
    const char *unit; /* unit of the field: "deg" for example; "1" for a pure number; "" if there is none */
    bool numeric;     /* true if all values are numbers */
    bool even;        /* true if the values are evenly spaced, to 1e-12 of the larger end */
    size_t n;
    struct kd_sweep_value {
        /* the value as text, in the form for kd_scene_set; the name of an asset is replaced by its hash when it is
         * resolved */
        char *text;
        double number; /* the value as a number; NAN if it is not a number */
        /* description of the grid if the value is a resolved volume.grid; all 0 for any other value */
        struct kd_scene_matter matter;
    } *values;
};

struct kd_sweep {
    struct kd_scene base;
    struct kd_sweep_axis axes[KD_SWEEP_AXES];
    size_t n_axes;
    unsigned scenes;
};

/* Reads a JSON object of axes for a valid scene. Each value is checked against its field; combinations of values are
 * checked later, by kd_sweep_scene. assets: provider in which names and hashes are looked up; NULL: hashes are not
 * looked up. Returns KD_EINVAL with the pointer /axes/FIELD/NUMBER, or KD_ENOMEM. Free *out with kd_sweep_free. */
enum kd_status kd_sweep_read(const cJSON *axes, const struct kd_scene *base, const struct kd_assets *assets,
                             struct kd_sweep **out, struct kd_error *error);

/* Like kd_sweep_read, but for n texts of a command line: FIELD=VALUE,VALUE,... or FIELD=RANGE. */
enum kd_status kd_sweep_typed(const char *const *axes, size_t n, const struct kd_scene *base,
                              const struct kd_assets *assets, struct kd_sweep **out, struct kd_error *error);
void kd_sweep_free(struct kd_sweep *sweep); /* accepts NULL */

/* Returns the value of an axis in a scene. */
const struct kd_sweep_value *kd_sweep_at(const struct kd_sweep *sweep, unsigned scene, size_t axis);
/* Makes a scene of the sweep, and validates it. If the combination of values is not valid, returns KD_EINVAL with
 * the pointer /axes and a message with the values. */
enum kd_status kd_sweep_scene(const struct kd_sweep *sweep, unsigned scene, struct kd_scene *out,
                              struct kd_error *error);

/* Writes a value as JSON. The only error is KD_ENOMEM. */
enum kd_status kd_sweep_value_json(const struct kd_sweep_value *value, struct kd_buffer *out);
/* Writes the axes as a member, in the form for kd_sweep_read, each as a list of values. */
void kd_sweep_axes_json(const struct kd_sweep *sweep, struct kd_json *json, const char *name);
/* Writes the name of a scene's file, without the extension, such as "000012 spin=0.9 inclination_deg=40". Characters
 * that are unsuitable for file names become "_". A name that is too long is truncated. */
enum { KD_SWEEP_NAME = 160 };
void kd_sweep_name(const struct kd_sweep *sweep, unsigned scene, char out[KD_SWEEP_NAME]);

#endif
