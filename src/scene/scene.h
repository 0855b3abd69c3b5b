/* A scene describes what to render. It is a plain value: it may be copied, compared by its hash, and shared between
 * threads if it is const. Fields, defaults, ranges and units are in scene/fields.h. */
#ifndef KD_SCENE_SCENE_H
#define KD_SCENE_SCENE_H

#include "base/buffer.h"
#include "base/error.h"
#include "document/asset_name.h"
#include "document/words.h"
#include "physics/spacetime/observer.h"
#include "scene/fields.h"

#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define KD_SCENE_VERSION 1

#define KD_M_REAL(s, name, ...) double name;
#define KD_M_INT(s, name, ...) int32_t name;
#define KD_M_BOOL(s, name, ...) bool name;
#define KD_M_ENUM(s, name, ...) int32_t name;
#define KD_M_ASSET(s, name, ...) char name[KD_ASSET_NAME];
#define KD_M_WORDS(s, name, ...) struct kd_words name;
#define KD_M_ROWS(ROWS) ROWS(KD_M_REAL, KD_M_REAL, KD_M_INT, KD_M_BOOL, KD_M_ENUM, KD_M_ASSET, KD_M_WORDS)
#define KD_M_SECTION(name, ROWS, group, help) \
    struct kd_##name { KD_M_ROWS(ROWS) } name;
#define KD_M_LIST(name, element, ROWS, group, most, help) \
    struct kd_##name { \
        size_t count; \
        struct kd_##element { KD_M_ROWS(ROWS) } at[most]; \
    } name;

/* The struct has one member for each section, such as struct kd_camera camera. Members of the document itself are in
 * `top`. A list has, for example, the form struct kd_spots { size_t count; struct kd_spot at[KD_SPOTS]; } spots. All
 * elements from index count on have their defaults, so that equal scenes have equal bytes. */
struct kd_dynamic_bodies;
/* Description of a grid of matter. The struct has no padding, because scenes are compared by their bytes. */
struct kd_scene_matter {
    /* nodes: number of nodes of all frames together; frames: number of frames in time, 1 if the grid shows one
     * moment */
    uint64_t nodes, frames;
    /* 1: `first` and `last` are times of ingoing Kerr-Schild coordinates; 0: of Boyer-Lindquist coordinates */
    uint64_t late;
    double first, last; /* times of the first and the last frame, in M */
    double outer;       /* r of the last row of the grid, in M */
};
struct kd_scene {
    KD_SCENE_SECTIONS(KD_M_SECTION, KD_M_LIST)
    struct kd_scene_dynamic {
        const struct kd_dynamic_bodies *at;
        uint64_t generation;
        /* moving content that is shown in addition to the scene (scene/dynamic_bodies.h); NULL and 0 if there is none
         */
    } dynamic;
    /* description of the grid in volume.grid, set by kd_scene_resolve; all 0 if there is none */
    struct kd_scene_matter matter;
};

/* Sets every field to its default. This is the scene of an empty document. */
void kd_scene_defaults(struct kd_scene *scene);

/* Sets the scene to the preset with this name. If there is no such preset, returns KD_EINVAL with a list of all
 * presets. */
enum kd_status kd_scene_preset(struct kd_scene *scene, const char *name, struct kd_error *error);

/* Returns the present name of a preset whose name has changed since an older version. Any other name is returned
 * unchanged. */
const char *kd_scene_preset_name_now(const char *name);
/* Sets the preset "smooth": the defaults without turbulence and without lens effects, for measuring a disk instead
 * of showing it. Documents of older versions also mean this scene, because those versions had neither turbulence nor
 * lens effects. */
void kd_scene_smooth(struct kd_scene *scene);
size_t kd_scene_preset_count(void);
const char *kd_scene_preset_name(size_t index);
const char *kd_scene_preset_title(size_t index);

/* Merges a JSON document into *scene. Fields that are not in the document keep their values, so start from the
 * defaults or a preset. An array replaces a whole list. An object {"0": {...}} changes elements of a list by index,
 * and the next free index appends an element. If a document names a style, the fields of that style get the style's
 * values, except for fields that the document sets itself (scene/style.h).
 *
 * The following are errors, which have a JSON pointer and state what is accepted: text after the document, duplicate
 * keys, unknown fields, wrong types, NaN and numbers that overflow, depth over 32, text over KD_SCENE_JSON_MAX
 * bytes, a version other than 1. On error *scene is unchanged. Rules about several fields are not checked: call
 * kd_scene_validate after all documents have been merged. */
#define KD_SCENE_JSON_MAX (1u << 20)
enum kd_status kd_scene_from_json(struct kd_scene *scene, const char *text, size_t length, struct kd_error *error);

/* Merges a patch (RFC 7396), like kd_scene_from_json, except that null has a meaning. null resets a field, or all
 * fields of a section or element, to the default. For a list, null removes all elements. */
enum kd_status kd_scene_patch(struct kd_scene *scene, const char *text, size_t length, struct kd_error *error);

/* Sets one scalar field from text. path is dotted ("camera.inclination_deg", "spots.0.r"). The next free index of a
 * list appends an element. Setting style.name sets all fields of that style. */
enum kd_status kd_scene_set(struct kd_scene *scene, const char *path, const char *value, struct kd_error *error);

/* True if both paths name the same field. A path may use a former name. */
bool kd_scene_same_path(const char *a, const char *b);

/* Checks all ranges, and all rules about several fields. Examples of such rules: a static observer is outside the
 * ergosphere; a pinhole camera is at a finite radius; the disk's edges are in order and outside the ISCO; the bit
 * depth is 8 or 16. */
enum kd_status kd_scene_validate(const struct kd_scene *scene, struct kd_error *error);

/* These functions are for live sessions. kd_scene_advance moves azimuth, time and the observer by their rates for
 * `seconds`. The other three return whether time advances, whether azimuth advances, and whether the observer falls.
 * (The emitters decide whether such a movement changes the picture: render/emit/emitter.h.) */
void kd_scene_advance(struct kd_scene *scene, double seconds);
/* Adds `time`, in M, to the scene's time. The result is limited to the range of the field `time`. */
void kd_scene_pass(struct kd_scene *scene, double time);
bool kd_scene_time_goes_on(const struct kd_scene *scene);
bool kd_scene_azimuth_goes_on(const struct kd_scene *scene);
bool kd_scene_falls(const struct kd_scene *scene);

/* Moves the observer along its own path for a proper time (0 or more). This changes camera.r, camera.azimuth_deg and
 * time. The scene must be valid, and its observer must follow a path of its own (physics/spacetime/worldline.h).
 * `time` advances in Boyer-Lindquist coordinates if slow light is on and the observer is outside the horizon;
 * otherwise it advances in ingoing Kerr-Schild coordinates. */
void kd_scene_go_on(struct kd_scene *scene, double proper_time);

/* kd_scene_is_slow_volume: true if matter on a grid is shown as it was when its light left. kd_scene_is_slow: true
 * in this case, and also if disk.slow_light does the same for the disk. */
bool kd_scene_is_slow_volume(const struct kd_scene *scene);
bool kd_scene_is_slow(const struct kd_scene *scene);
/* With slow light, the scene's time is that of the observer, and light from the hole's vicinity has left earlier.
 * Returns this difference, about the observer's r in M. Returns 0 without slow light, and for an observer at
 * infinity. */
double kd_scene_lead(const struct kd_scene *scene);

/* Clock of a falling observer. to_horizon: proper time in M until the observer reaches the outer horizon (NAN inside
 * it). to_end: proper time in M until the end of the model. second: 1 M in seconds. kd_scene_clock returns false if
 * the observer does not fall, or if its latitude changes. It takes some 20 us. */
struct kd_fall_clock { double to_horizon, to_end, second; };
bool kd_scene_clock(const struct kd_scene *scene, struct kd_fall_clock *out);

/* True if the picture shows areas to scale, as the plane and pinhole projections do. */
bool kd_scene_is_flat(const struct kd_scene *scene);

/* Makes the scene for one eye: -1 is the left one, 1 the right one. The scene must be valid, at a finite radius, and
 * with camera.stereo "pair". The camera of the eye belongs to the same observer at the same time, but is shifted
 * sideways by half of camera.eye_distance. The shift is along an axis of the observer's tetrad, to first order. The
 * viewing axis and the up direction of both eyes are parallel, as in flat space. The result has camera.stereo
 * "none". */
struct kd_scene kd_scene_eye(const struct kd_scene *scene, int side);

/* The pixels that are rendered: those of image.tile, or all of them. */
struct kd_window { uint32_t left, top, width, height; };
bool kd_scene_has_tile(const struct kd_scene *scene);
struct kd_window kd_scene_window(const struct kd_scene *scene);
/* kd_scene_tile returns the scene with this window as its tile; kd_scene_whole returns it without a tile. */
struct kd_scene kd_scene_tile(const struct kd_scene *scene, struct kd_window window);
struct kd_scene kd_scene_whole(const struct kd_scene *scene);

/* Place and motion of the observer. */
struct kd_vantage kd_scene_vantage(const struct kd_scene *scene);
struct kd_observer_motion kd_scene_observer(const struct kd_scene *scene);

/* kd_scene_side: number of rays along each side of every pixel. kd_scene_adapts: true if some pixels may get more
 * rays than that. */
int32_t kd_scene_side(const struct kd_scene *scene);
bool kd_scene_adapts(const struct kd_scene *scene);

/* Width of the picture on the sky in microarcseconds, from the hole's mass and distance; NAN unless the projection
 * is flat. For a pinhole camera, the width is 2 r tan(fov/2), which the field of view spans at the hole, as seen
 * from spacetime.distance_pc. For large r this gives the same picture as the plane projection. */
double kd_scene_width_uas(const struct kd_scene *scene);

/* The value of sky.brightness, in which "auto" is replaced by a number. */
double kd_scene_sky_brightness(const struct kd_scene *scene);

/* Upper limit of style.exposure "auto", in stops. It keeps empty sky from becoming grey if there is nothing brighter
 * in the picture: a surface brightness of 21 magnitudes per square arcsecond becomes at most a quarter of white. The
 * result is INFINITY in three cases: there are no stars and no Milky Way; the picture is in false colour; or
 * sky.brightness is given and something other than the sky shines, because then the given ratio of brightness is
 * kept. */
double kd_scene_exposure_most(const struct kd_scene *scene);

/* kd_scene_volume_inner: inner edge of the scene's volume in M. kd_scene_is_radio: true if the volume is seen at one
 * radio frequency, volume.frequency_ghz, so that its light is in physical units. */
double kd_scene_volume_inner(const struct kd_scene *scene);
bool kd_scene_is_radio(const struct kd_scene *scene);
/* True if the volume's light comes from electrons in a magnetic field. */
bool kd_scene_is_magnetic(const struct kd_scene *scene);
/* True if all light has the same frequency, so that the picture's flux is physical. This is so if nothing is visible
 * except a volume at a radio frequency, or except a disk with disk.band "frequency". */
bool kd_scene_is_radio_alone(const struct kd_scene *scene);
/* For a scene for which kd_scene_is_radio_alone is true: the frequency of the light in GHz, and the path of the
 * field that contains it. Undefined for all other scenes. */
double kd_scene_frequency_ghz(const struct kd_scene *scene);
const char *kd_scene_frequency_path(const struct kd_scene *scene);
void kd_scene_set_frequency(struct kd_scene *scene, double ghz);
/* True if the scene has a disk that is seen at one frequency. */
bool kd_scene_has_disk_frequency(const struct kd_scene *scene);
/* Upper limit of disk.frequency_ghz: KD_DISK_QUANTA k T/h, where T is the disk's highest colour temperature. Light
 * that returns to the disk may raise this temperature, which is ignored here. */
#define KD_DISK_QUANTA 64
double kd_scene_disk_most_ghz(const struct kd_scene *scene);

/* kd_scene_spots lists the spots with a brightness other than zero. kd_scene_bodies lists the bodies with a radius
 * other than zero. Both keep the order of the scene, and return the number of entries. */
size_t kd_scene_spots(const struct kd_scene *scene, const struct kd_spot *on[KD_SPOTS]);
size_t kd_scene_bodies(const struct kd_scene *scene, const struct kd_body *on[KD_SCENE_BODIES]);

/* Place and motion of a body. */
struct kd_vantage kd_body_vantage(const struct kd_scene *scene, const struct kd_body *body);
struct kd_observer_motion kd_body_motion(const struct kd_body *body);

/* The ringdown of a hole that was struck, at the scene's time. *wave = A(t) = e^(Im(omega) t) cos(Re(omega) t) of
 * the mode l = m = 2, n = 0; t is counted from style.ringdown_time. Returns false if the hole is not struck at all,
 * or if it is struck later. Takes up to 1 ms. */
bool kd_scene_ringdown(const struct kd_scene *scene, double *wave);

/* Writes the canonical document. It contains every field in the order of the table, without spaces. Each number has
 * the shortest form that reads back exactly. */
enum kd_status kd_scene_to_json(const struct kd_scene *scene, struct kd_buffer *out);

/* Writes the SHA-256 of the canonical document as 64 hexadecimal digits and a NUL. */
enum kd_status kd_scene_hash(const struct kd_scene *scene, char hash[65]);

/* These functions write the JSON Schema (draft 2020-12) of the document, and docs/scene.md. Both are made from the
 * table of fields. */
enum kd_status kd_scene_schema(struct kd_buffer *out);
enum kd_status kd_scene_reference(struct kd_buffer *out);

#endif
