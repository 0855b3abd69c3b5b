/* A scene is what to render, as a plain value: copy it, compare it by its hash, share it between threads as const.
 * Fields, defaults, ranges and units are in scene/fields.h. */
#ifndef KD_SCENE_SCENE_H
#define KD_SCENE_SCENE_H

#include "base/buffer.h"
#include "base/error.h"
#include "physics/spacetime/observer.h"
#include "scene/fields.h"

#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define KD_SCENE_VERSION 1
#define KD_ASSET_NAME \
    65 /* room for the SHA-256 of an asset in hexadecimal digits, or for its name, with the NUL; "": no asset at all \
        */

/* The value of a WORDS field. number: the N of a word "b_N", -1 for none. Entries beyond count are 0, so that equal
 * scenes have equal bytes. */
#define KD_WORDS_MOST 16
struct kd_words {
    int32_t count;
    struct kd_numbered_word { int16_t word, number; } at[KD_WORDS_MOST];
};

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

/* A member for each section: struct kd_camera camera, ... Members of the document itself are in `top`. A list is
 * struct kd_spots { size_t count; struct kd_spot at[KD_SPOTS]; } spots; elements from count on hold their defaults,
 * so that equal scenes have equal bytes. */
struct kd_dynamic_bodies;
struct kd_scene {
    KD_SCENE_SECTIONS(KD_M_SECTION, KD_M_LIST)
    struct kd_scene_crowd {
        const struct kd_dynamic_bodies *at;
        uint64_t generation;
    } crowd; /* moving content shown beside the fields (scene/crowd.h); NULL and 0: none */
};

/* Sets every field to its default, as an empty document does. */
void kd_scene_defaults(struct kd_scene *scene);

/* Sets a preset by name. KD_EINVAL, with a list of all presets, if there is none of this name. */
enum kd_status kd_scene_preset(struct kd_scene *scene, const char *name, struct kd_error *error);

/* Maps an older name of a preset to its present name; any other name stays. */
const char *kd_scene_preset_name_now(const char *name);
/* Sets the preset "smooth": the defaults without turbulence and without lens effects, for measuring a disk rather
 * than showing it. It is also the meaning of documents from older versions, which had neither. */
void kd_scene_smooth(struct kd_scene *scene);
size_t kd_scene_preset_count(void);
const char *kd_scene_preset_name(size_t index);
const char *kd_scene_preset_title(size_t index);

/* Merges a JSON document into *scene. Fields that it does not name keep their values, so start from the defaults or
 * a preset. An array replaces a whole list; an object {"0": {...}} changes its elements by index, and the next free
 * index appends one. A document that names a style sets the fields of that style, except those that it sets itself
 * (scene/style.h).
 *
 * Rejects, with a JSON pointer and what is allowed: text after the document, duplicate keys, unknown fields, wrong
 * types, NaN and numbers that overflow, depth over 32, text over KD_SCENE_JSON_MAX bytes, a version other than 1. On
 * error *scene is unchanged. Does not check rules across fields: call kd_scene_validate after all documents have
 * been merged. */
#define KD_SCENE_JSON_MAX (1u << 20)
enum kd_status kd_scene_from_json(struct kd_scene *scene, const char *text, size_t length, struct kd_error *error);

/* Merges a patch (RFC 7396) in the same way. null resets a field, or all fields of a section or element, to the
 * default, and empties a list. */
enum kd_status kd_scene_patch(struct kd_scene *scene, const char *text, size_t length, struct kd_error *error);

/* Sets one scalar field by its dotted path ("camera.inclination_deg", "spots.0.r") from text. The next free index of
 * a list appends an element; a style sets all of its fields. */
enum kd_status kd_scene_set(struct kd_scene *scene, const char *path, const char *value, struct kd_error *error);

/* True if both paths name the same field, perhaps one of them by an old name. */
bool kd_scene_same_path(const char *a, const char *b);

/* Checks all ranges, and the rules that tie fields together: a static observer outside the ergosphere, a pinhole at
 * a finite radius, disk edges in order and outside the ISCO, bit depth 8 or 16, ... */
enum kd_status kd_scene_validate(const struct kd_scene *scene, struct kd_error *error);

/* Live sessions: kd_scene_advance moves azimuth, time and the observer by their rates for `seconds`. The others tell
 * whether time advances, whether azimuth does, and whether the observer falls. Whether that changes the picture
 * depends on the emitters (render/emit/emitter.h). */
void kd_scene_advance(struct kd_scene *scene, double seconds);
/* Adds `time` (M) to the scene's time, which stops at the ends of its range. */
void kd_scene_pass(struct kd_scene *scene, double time);
bool kd_scene_time_goes_on(const struct kd_scene *scene);
bool kd_scene_azimuth_goes_on(const struct kd_scene *scene);
bool kd_scene_falls(const struct kd_scene *scene);

/* Moves the observer along its own path by a proper time of 0 or more: changes camera.r, camera.azimuth_deg and
 * time. The scene is valid, and its observer has such a path (physics/spacetime/worldline.h). With disk.slow_light,
 * and outside the horizon, `time` advances in Boyer-Lindquist coordinates, otherwise in ingoing Kerr-Schild
 * coordinates. */
void kd_scene_go_on(struct kd_scene *scene, double proper_time);

/* Proper times, in M, at which a falling observer reaches the outer horizon (NAN inside it) and the end of the
 * model; second: one M in seconds. False if the observer does not fall, or its latitude changes. Takes some 20 us. */
struct kd_fall_clock { double to_horizon, to_end, second; };
bool kd_scene_clock(const struct kd_scene *scene, struct kd_fall_clock *out);

/* True if areas in the picture are to scale: plane or pinhole projection. */
bool kd_scene_is_flat(const struct kd_scene *scene);

/* Makes the scene of one eye, -1 the left one, 1 the right one. The scene is valid, at a finite radius, and its
 * camera.stereo is "pair". The eye is the same observer's camera at the same time, moved sideways by half of
 * camera.eye_distance along a leg of its local frame, to first order; its axis and its up direction are kept as in
 * flat space. The result has camera.stereo "none". */
struct kd_scene kd_scene_eye(const struct kd_scene *scene, int side);

/* The pixels that are rendered: image.tile of the picture, or all of it. */
struct kd_window { uint32_t left, top, width, height; };
bool kd_scene_has_tile(const struct kd_scene *scene);
struct kd_window kd_scene_window(const struct kd_scene *scene);
/* The scene with this window as its tile, and the scene without a tile. */
struct kd_scene kd_scene_tile(const struct kd_scene *scene, struct kd_window window);
struct kd_scene kd_scene_whole(const struct kd_scene *scene);

/* Place and motion of the observer. */
struct kd_vantage kd_scene_vantage(const struct kd_scene *scene);
struct kd_observer_motion kd_scene_observer(const struct kd_scene *scene);

/* Rays along each side of a pixel that all pixels have; and whether some pixels may get more. */
int32_t kd_scene_side(const struct kd_scene *scene);
bool kd_scene_adapts(const struct kd_scene *scene);

/* Width of the picture on the sky, in microarcseconds, from the mass and the distance of the hole; NAN unless the
 * projection is flat. For a pinhole: the width 2 r tan(fov/2) that the middle of the picture spans at the hole's
 * distance, seen from spacetime.distance_pc; for large r the picture is then the same as in the plane projection. */
double kd_scene_width_uas(const struct kd_scene *scene);

/* sky.brightness, with "auto" resolved. */
double kd_scene_sky_brightness(const struct kd_scene *scene);

/* Upper limit of style.exposure "auto", in stops, so that a sky with nothing brighter before it is not lifted to
 * grey: 21 magnitudes a square arcsecond become a quarter of white. INFINITY without stars or a Milky Way, in false
 * colour, and where sky.brightness is given and something else shines: then the given ratio counts. */
double kd_scene_exposure_most(const struct kd_scene *scene);

/* Inner edge of the scene's volume, M; and whether the volume is seen at one radio frequency, volume.frequency_ghz,
 * in physical units. */
double kd_scene_volume_inner(const struct kd_scene *scene);
bool kd_scene_is_radio(const struct kd_scene *scene);
/* True if the volume's light comes from electrons in a magnetic field. */
bool kd_scene_is_magnetic(const struct kd_scene *scene);
/* True if, in addition, nothing else is visible, so that the picture's flux is physical. */
bool kd_scene_is_radio_alone(const struct kd_scene *scene);

/* Lists the spots of non-zero brightness, and the bodies of non-zero radius, in order; returns their number. */
size_t kd_scene_spots(const struct kd_scene *scene, const struct kd_spot *on[KD_SPOTS]);
size_t kd_scene_bodies(const struct kd_scene *scene, const struct kd_body *on[KD_SCENE_BODIES]);

/* Place and motion of a body. */
struct kd_vantage kd_body_vantage(const struct kd_scene *scene, const struct kd_body *body);
struct kd_observer_motion kd_body_motion(const struct kd_body *body);

/* Ringdown of a struck hole at the scene's time: *wave = A(t) = e^(Im(omega) t) cos(Re(omega) t) of the mode l = m =
 * 2, n = 0, with t counted from style.ringdown_time. False: the hole is not struck, or not yet. Up to 1 ms. */
bool kd_scene_ringdown(const struct kd_scene *scene, double *wave);

/* Writes the canonical document: every field, in table order, shortest numbers that read back exactly, no spaces. */
enum kd_status kd_scene_to_json(const struct kd_scene *scene, struct kd_buffer *out);

/* Writes the SHA-256 of the canonical document as 64 hexadecimal digits and a NUL. */
enum kd_status kd_scene_hash(const struct kd_scene *scene, char hash[65]);

/* Write the JSON Schema (draft 2020-12) of the document, and docs/scene.md, from the table of fields. */
enum kd_status kd_scene_schema(struct kd_buffer *out);
enum kd_status kd_scene_reference(struct kd_buffer *out);

#endif
