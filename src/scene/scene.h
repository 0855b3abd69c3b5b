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
    65 /* room for the SHA-256 of an asset in hexadecimal digits, or for a name of one; "": there is none */

/* Words of a row of words, in an order of their own; number: what stands behind it, -1: nothing. Beyond count all is
 * 0, so that equal scenes are equal bytes. */
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
 * so that equal scenes are equal bytes. */
struct kd_crowd;
struct kd_scene {
    KD_SCENE_SECTIONS(KD_M_SECTION, KD_M_LIST)
    struct kd_scene_crowd {
        const struct kd_crowd *at;
        uint64_t generation;
    } crowd; /* what it shows besides (scene/crowd.h); NULL and 0: nothing */
};

/* Sets every field to its default: the picture of an empty document. */
void kd_scene_defaults(struct kd_scene *scene);

/* Finds a preset by name; KD_EINVAL names the known ones otherwise. */
enum kd_status kd_scene_preset(struct kd_scene *scene, const char *name, struct kd_error *error);

/* What a preset is called now that scripts may know by an older name; any other name as it is. */
const char *kd_scene_preset_name_now(const char *name);
/* Sets the preset "smooth": the defaults without gas and without what a lens does, for what measures a disk rather
 * than showing it; and what older versions, which had neither, meant by the fields that they did not know. */
void kd_scene_smooth(struct kd_scene *scene);
size_t kd_scene_preset_count(void);
const char *kd_scene_preset_name(size_t index);
const char *kd_scene_preset_title(size_t index);

/* Merge a JSON document into *scene. Fields it does not name keep the value they had, so
 * start from the defaults or a preset. An array takes the place of a whole list, an object {"0": {...}} changes
 * elements of it by their index, of which the next free one makes an element. Rejects, with a JSON pointer and what
 * is allowed: text after the document, duplicate keys, unknown fields, wrong types, NaN and numbers that overflow,
 * depth over 32, text over KD_SCENE_JSON_MAX bytes, a version other than 1. On error *scene is unchanged. A document
 * that names a style sets the fields of that style, but for those that it sets itself (scene/style.h). Does not look
 * across fields: call kd_scene_validate when every source has been merged. */
#define KD_SCENE_JSON_MAX (1u << 20)
enum kd_status kd_scene_from_json(struct kd_scene *scene, const char *text, size_t length, struct kd_error *error);

/* Merges a patch (RFC 7396) in the same way: null takes a field, or all fields of a section or element, back to the
 * default; it empties a list. */
enum kd_status kd_scene_patch(struct kd_scene *scene, const char *text, size_t length, struct kd_error *error);

/* Set one scalar field by its dotted path ("camera.inclination_deg", "spots.0.r") from text; one of the next free
 * index of a list makes that element, and a style sets all of its fields. */
enum kd_status kd_scene_set(struct kd_scene *scene, const char *path, const char *value, struct kd_error *error);

/* Says whether both name the same field, one of them by an old name perhaps. */
bool kd_scene_same_path(const char *a, const char *b);

/* Rules that tie fields together: a static observer outside the ergosphere, a pinhole at a finite
 * radius, disk edges in order and outside the ISCO, bit depth 8 or 16, ... */
enum kd_status kd_scene_validate(const struct kd_scene *scene, struct kd_error *error);

/* Move what goes on by itself in a live session, azimuth, time and the observer, by so many seconds; say whether
 * time goes on, whether azimuth does, and whether the observer falls. Whether anything of time and azimuth can be
 * seen is for the emitters to say (render/emit/emitter.h). */
void kd_scene_advance(struct kd_scene *scene, double seconds);
/* Lets so many M go by in what moves in it: adds them to `time`, which stops at the ends of its range. */
void kd_scene_pass(struct kd_scene *scene, double time);
bool kd_scene_time_goes_on(const struct kd_scene *scene);
bool kd_scene_azimuth_goes_on(const struct kd_scene *scene);
bool kd_scene_falls(const struct kd_scene *scene);

/* Moves the observer on along its own path by so much of its own time, 0 or more: camera.r, camera.azimuth_deg and
 * time. A valid scene whose observer has such a path (physics/spacetime/worldline.h). `time` is then that of Boyer and
 * Lindquist with disk.slow_light, as far as the horizon, else that of ingoing Kerr-Schild coordinates. */
void kd_scene_go_on(struct kd_scene *scene, double proper_time);

/* The clock of a falling observer to the outer horizon (NAN within) and to where the model ends, in M; second: one M
 * in seconds. False: it does not fall, or its latitude does not stay. Some 20 us. */
struct kd_fall_clock { double to_horizon, to_end, second; };
bool kd_scene_clock(const struct kd_scene *scene, struct kd_fall_clock *out);

/* Says whether areas of the picture are to scale: it is of the plane or the pinhole projection. */
bool kd_scene_is_flat(const struct kd_scene *scene);

/* Makes the scene of one eye, -1 the left one, 1 the right one, of a valid scene at a finite radius whose
 * camera.stereo is "pair": a camera of the same observer half of camera.eye_distance to the side, along a leg of its
 * local frame by the first order, with its axis and its up as they would be in flat space, at the same time.
 * camera.stereo is "none" in it. */
struct kd_scene kd_scene_eye(const struct kd_scene *scene, int side);

/* The pixels that are made: image.tile of the picture, or all of it. */
struct kd_window { uint32_t left, top, width, height; };
bool kd_scene_has_tile(const struct kd_scene *scene);
struct kd_window kd_scene_window(const struct kd_scene *scene);
/* The scene whose tile is that window, and that without one. */
struct kd_scene kd_scene_tile(const struct kd_scene *scene, struct kd_window window);
struct kd_scene kd_scene_whole(const struct kd_scene *scene);

/* Say where the observer is, and how it moves. */
struct kd_vantage kd_scene_vantage(const struct kd_scene *scene);
struct kd_observer_motion kd_scene_observer(const struct kd_scene *scene);

/* Count rays along each side of a pixel, those that all pixels have; and whether some may have more. */
int32_t kd_scene_side(const struct kd_scene *scene);
bool kd_scene_adapts(const struct kd_scene *scene);

/* Says how wide the picture is on the sky, in microarcseconds, from the mass and the distance of the hole; NAN
 * unless it is flat. In pinhole it is the width of what the middle of the picture shows at the hole's distance, 2 r
 * tan(fov/2), as if that were seen from spacetime.distance_pc: the same picture as in plane where r is large. */
double kd_scene_width_uas(const struct kd_scene *scene);

/* Gives sky.brightness, and what "auto" stands for. */
double kd_scene_sky_brightness(const struct kd_scene *scene);

/* Gives the stops that style.exposure "auto" does not go beyond, so that a sky without anything brighter before it
 * is not lifted to grey: those at which 21 magnitudes a square arcsecond are a quarter of white. INFINITY without
 * stars or a Milky Way, in false colour, and where sky.brightness is given beside what shines more: then that ratio
 * is what is wanted. */
double kd_scene_exposure_most(const struct kd_scene *scene);

/* Gives the inner edge of the scene's volume, M; and says whether that is seen at one radio frequency,
 * volume.frequency_ghz, in units of physics. */
double kd_scene_volume_inner(const struct kd_scene *scene);
bool kd_scene_is_radio(const struct kd_scene *scene);
/* Says whether that has electrons in a magnetic field, of which its light is. */
bool kd_scene_is_magnetic(const struct kd_scene *scene);
/* The same, and nothing else is to be seen: then its flux has a meaning. */
bool kd_scene_is_radio_alone(const struct kd_scene *scene);

/* Finds the spots that are on, and the bodies that have a size, in order. */
size_t kd_scene_spots(const struct kd_scene *scene, const struct kd_spot *on[KD_SPOTS]);
size_t kd_scene_bodies(const struct kd_scene *scene, const struct kd_body *on[KD_SCENE_BODIES]);

/* Say where a body is, and how it moves. */
struct kd_vantage kd_body_vantage(const struct kd_scene *scene, const struct kd_body *body);
struct kd_observer_motion kd_body_motion(const struct kd_body *body);

/* Computes how a struck hole rings at the scene's time: *wave = A(t) = e^(Im(omega) t) cos(Re(omega) t) of the mode
 * l = m = 2, n = 0, t from style.ringdown_time on. False: it was not struck, or not yet. Up to 1 ms. */
bool kd_scene_ringdown(const struct kd_scene *scene, double *wave);

/* Writes the canonical document: every field, in table order, shortest numbers that read back exactly, no spaces. */
enum kd_status kd_scene_to_json(const struct kd_scene *scene, struct kd_buffer *out);

/* Writes the SHA-256 of the canonical document as 64 hexadecimal digits and a NUL. */
enum kd_status kd_scene_hash(const struct kd_scene *scene, char hash[65]);

/* Write the JSON Schema (draft 2020-12) of the document, and docs/scene.md, from the same table. */
enum kd_status kd_scene_schema(struct kd_buffer *out);
enum kd_status kd_scene_reference(struct kd_buffer *out);

#endif
