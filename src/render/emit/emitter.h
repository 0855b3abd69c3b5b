/* Emitters: everything that adds light to a ray, absorbs it or changes it. This is the C side of the table in
 * shaders/shared/emitters.h, one file each. Plan, needs of the lens map, motion, numbers and tables for the device,
 * and approximations fold over it and know no names.
 *
 * To add one: its line in that list, shaders/emit/NAME.glsl, src/render/emit/NAME.c with `const struct kd_emitter
 * kd_emit_NAME`, and its section in the field table. Constant data and pure functions of valid scenes, any thread. */
#ifndef KD_RENDER_EMIT_EMITTER_H
#define KD_RENDER_EMIT_EMITTER_H

#include "lens.h"
#include "render/accuracy/engine.h"
#include "render/emit/approximation.h"
#include "render/emit/emission.h"
#include "render/emit/motion.h"
#include "render/emit/own.h"
#include "scene/scene.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* An approximation (approximation.h), and whether it is in force in a scene that has the emitter, followed by these
 * rays; NULL: always. */
struct kd_sentence {
    const char *name, *text;
    bool (*in_force)(const struct kd_scene *scene, const struct kd_setting *rays);
};

/* Names a part of struct kd_scene. */
struct kd_scene_part { size_t at, size; };
#define KD_SCENE_PART(section) { offsetof(struct kd_scene, section), sizeof(((struct kd_scene *)0)->section) }
#define KD_EMITTER_PARTS 7

#define KD_EMIT_TOLD 256

struct kd_emitter {
    const char *name;
    const char *title; /* what people call it, with the article left out: "spots" */
    /* Writes what is seen of it, a sentence without quotation marks; NULL: nothing that is worth one. */
    void (*tell)(const struct kd_scene *scene, char out[KD_EMIT_TOLD]);
    bool (*present)(const struct kd_scene *scene);
    uint32_t (*traits)(const struct kd_scene *scene); /* KD_TRAIT_... of its GLSL file; NULL: none */
    uint32_t (*needs)(
        const struct kd_scene *scene); /* KD_LENS_...: what the lens map must hold for it; NULL: nothing */
    unsigned (*varies)(const struct kd_scene *scene); /* enum kd_varies; NULL: never */
    /* Buffers of its own on the device, how many bytes they have, and how many invocations the pass that fills them
     * before light is, KD_PASS_name of its GLSL file. NULL: none; the last alone: the host fills them. */
    const struct kd_own *own;
    uint64_t (*device_bytes)(const struct kd_scene *scene);
    uint64_t (*making_bytes)(
        const struct kd_scene *scene); /* on the host, at most, while they are made; NULL: little */
    uint64_t (*invocations)(const struct kd_scene *scene);
    /* Least and largest r at which it shines or hides, M; NULL: anywhere. Crossings beyond those of all emitters are
     * skipped. */
    void (*reach)(const struct kd_scene *scene, double radii[2]);
    /* Emitters that are ALONG rays say here the least and the largest |cos(theta)| at which they are; NULL: 0 and 1.
     * The march finds these edges and those of `reach` to a float's accuracy, of all volumes of a scene together: an
     * edge inside those bounds is as sharp as the emitter's grain tells. */
    double (*hollow)(const struct kd_scene *scene), (*height)(const struct kd_scene *scene);
    /* They say here the r of a sphere within their reach where their light or their depth has an edge, M, which the
     * march finds as well; 0 or NULL: none. */
    double (*knot)(const struct kd_scene *scene);
    /* Fill in numbers; and tables, which may take milliseconds. They are called anew when a part of the scene that
     * they depend on has changed. */
    void (*fill)(struct kd_emission *out, const struct kd_scene *scene);
    void (*tables)(struct kd_emit_tables *out, const struct kd_scene *scene);
    struct kd_scene_part depends[KD_EMITTER_PARTS]; /* up to the first of size 0 */
    const struct kd_sentence *sentences;
    size_t n_sentences;
    const struct kd_emitter *kind; /* whose sentences hold for it as well; NULL: nobody's */
    const struct kd_emitter
        *reads; /* whose numbers and tables it reads beside its own, and whatever that one reads; NULL: nobody's */
    const struct kd_emitter *replaces; /* which is not there where this one is; NULL: none */
};

#define KD_EMIT_NUMBER_(number, name) KD_EMITTER_##name = number,
enum kd_emitter_number {
    KD_EMITTERS(KD_EMIT_NUMBER_, KD_EMIT_NUMBER_, KD_EMIT_NUMBER_, KD_EMIT_NUMBER_, KD_EMIT_NUMBER_, KD_EMIT_NUMBER_)
};
#define KD_EMIT_ONE_(number, name) +1
enum {
    KD_EMITTER_COUNT = 0 KD_EMITTERS(KD_EMIT_ONE_, KD_EMIT_ONE_, KD_EMIT_ONE_, KD_EMIT_ONE_, KD_EMIT_ONE_, KD_EMIT_ONE_)
};
extern const struct kd_emitter *const kd_emitters[KD_EMITTER_COUNT];

/* Whether a scene has an emitter: it is present, and none that is takes its place. */
bool kd_emit_has(const struct kd_scene *scene, const struct kd_emitter *emitter);
/* Makes the words of the specialisation constants, 0 for what the scene has not. */
void kd_emit_traits(const struct kd_scene *scene, uint32_t out[KD_EMITTER_COUNT]);
/* Say what the lens map must hold; whether anything shines at crossings of the plane; whether anything does where
 * rays end; whether the luminance of some of it is kept apart; whether there are points of light. */
uint32_t kd_emit_needs(const struct kd_scene *scene);
bool kd_emit_at_crossings(const struct kd_scene *scene);
bool kd_emit_along(const struct kd_scene *scene);      /* whether there are volumes */
bool kd_emit_slow_along(const struct kd_scene *scene); /* and one is shown as it was when its light left it */
bool kd_emit_met(const struct kd_scene *scene);        /* whether there are surfaces that rays meet off the plane */
bool kd_emit_at_ends(const struct kd_scene *scene);
bool kd_emit_apart(const struct kd_scene *scene);
bool kd_emit_points(const struct kd_scene *scene);
/* Counts the bytes of all buffers that the scene's emitters have on the device. */
uint64_t kd_emit_device_bytes(const struct kd_scene *scene);
/* And those that the host needs, at most, while it makes what is in them. */
uint64_t kd_emit_making_bytes(const struct kd_scene *scene);
/* Invocations of an emitter's own pass there; 0: it has none, or the scene has not the emitter. */
uint64_t kd_emit_invocations(const struct kd_scene *scene, enum kd_emitter_number number);
/* Call take(user, approximation) for each that is in force. */
void kd_emit_sentences(const struct kd_scene *scene, const struct kd_setting *rays,
                       void (*take)(void *user, struct kd_approximation approximation), void *user);
size_t kd_emit_sentence_count(void); /* there are, in force or not */

/* The state holds numbers and tables, and the scenes that they are of: {0} before the first use. Thread of the
 * owner. */
struct kd_emit_state {
    struct kd_emit_data data;
    struct kd_scene of[KD_EMITTER_COUNT]; /* what each emitter was last filled from, */
    bool filled[KD_EMITTER_COUNT];        /* if it was */
    bool colours, luminous;               /* the tables that no scene changes are there */
};
/* Bring the data up to date. band_pixels: of the picture's bands (emit/frame.glsl). 15 ms the first time, as much
 * again for the first scene of a visible band; afterwards what has changed alone. */
void kd_emit_update(struct kd_emit_state *state, const struct kd_scene *scene, uint32_t band_pixels);

extern const struct kd_emitter kd_emit_disk;
/* Emitters that shine by the smooth disk's numbers and tables have its traits. */
uint32_t kd_disk_traits(const struct kd_scene *scene);
/* Gives the radii of its edges; and writes "A thin disk from the ISCO to 22 M." for the noun "thin disk". */
void kd_disk_reach(const struct kd_scene *scene, double radii[2]);
void kd_disk_tell(const struct kd_scene *scene, const char *noun, char out[KD_EMIT_TOLD]);
/* Emitters that go round have these in common: Doppler shift and redshift as KD_TRAIT_..., needs, and how they vary. */
uint32_t kd_orbit_traits(const struct kd_scene *scene);
uint32_t kd_orbit_needs(const struct kd_scene *scene);
unsigned kd_orbit_varies(const struct kd_scene *scene);
/* Finds the largest effective temperature of the disk in K, in the gas's own frame. */
double kd_disk_peak_temperature(const struct kd_scene *scene);
/* Gives the temperature over that at r whose black body is as bright as the smooth disk there, its fade and opacity
 * included. */
double kd_disk_heat(const struct kd_scene *scene, double r);
/* Gives the inner edge of the disk, M. */
double kd_disk_inner(const struct kd_scene *scene);
/* Fill in the colours of black bodies, and how luminous they are. No scene changes them; 15 ms each. */
void kd_colour_tables(struct kd_emit_tables *out);
void kd_luminous_table(struct kd_emit_tables *out);

#endif
