/* Emitters: everything that adds light to a ray, absorbs it or changes it. This is the C side of the table in
 * shaders/shared/emitters.h; each emitter has a file of its own. Five parts of the program iterate over the table and
 * name no emitter: plans, needs of the lens map, motion, device data and approximations.
 *
 * To add an emitter, write its line in that table, and its section in the field table. Write shaders/emit/NAME.glsl,
 * and src/render/emit/NAME.c with `const struct kd_emitter kd_emit_NAME`. Constant data and pure functions of valid
 * scenes; any thread. */
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

/* An approximation (approximation.h). in_force: true if the approximation applies to a scene that has the emitter, with
 * these rays. NULL: it always applies. */
struct kd_sentence {
    const char *name, *text;
    bool (*in_force)(const struct kd_scene *scene, const struct kd_setting *rays);
};

struct kd_scene_part { size_t at, size; };
#define KD_SCENE_PART(section) { offsetof(struct kd_scene, section), sizeof(((struct kd_scene *)0)->section) }
#define KD_EMITTER_PARTS 8

#define KD_EMIT_TOLD 256

struct kd_emitter {
    const char *name;
    const char *title; /* the emitter's common name without an article: "spots" */
    /* Writes one sentence, without quotation marks, about the appearance of the emitter. NULL: the emitter has no
     * such sentence. */
    void (*tell)(const struct kd_scene *scene, char out[KD_EMIT_TOLD]);
    bool (*present)(const struct kd_scene *scene);
    /* flags KD_TRAIT_... of the emitter's GLSL file; NULL: no flags */
    uint32_t (*traits)(const struct kd_scene *scene);
    uint32_t (*needs)(
        const struct kd_scene *scene); /* KD_LENS_... quantities of the lens map that the emitter reads; NULL: none */
    /* flags of enum kd_varies: the causes that change the emitter's light; NULL: its light never changes */
    unsigned (*varies)(const struct kd_scene *scene);
    /* own: the emitter's own device buffers. device_bytes: their size. invocations: number of invocations of the pass
     * that fills them (KD_PASS_name of its GLSL file) before light is computed. NULL: the emitter has no buffers. If
     * only `invocations` is NULL, the host fills the buffers. */
    const struct kd_emitter_buffers *own;
    uint32_t quads; /* traits with which the emitter reads a buffer of quads; 0: it never reads one */
    uint64_t (*device_bytes)(const struct kd_scene *scene);
    uint64_t (*making_bytes)(
        const struct kd_scene *scene); /* peak of the host memory needed to make the buffers; NULL: little */
    uint64_t (*invocations)(const struct kd_scene *scene);
    /* Least and largest r at which the emitter emits or absorbs, M; NULL: anywhere. Crossings outside the range of all
     * emitters are skipped. */
    void (*reach)(const struct kd_scene *scene, double radii[2]);
    /* For ALONG emitters: the least and the largest |cos(theta)| at which they emit or absorb; NULL: 0 and 1. The march
     * takes the outermost bounds that `reach`, `hollow` and `height` give for the scene's volumes, and resolves these
     * bounds to a float's accuracy. The march resolves an edge inside these bounds only as finely as the emitter's
     * grain requires. */
    double (*hollow)(const struct kd_scene *scene), (*height)(const struct kd_scene *scene);
    /* Radius in M of a sphere within `reach` at which light or optical depth has an edge. The march finds this edge
     * as well. 0 or NULL: none. */
    double (*knot)(const struct kd_scene *scene);
    /* Computes numbers and tables; tables may take milliseconds. Called again when a part of the scene in `depends`
     * has changed. */
    void (*fill)(struct kd_emission *out, const struct kd_scene *scene);
    void (*tables)(struct kd_emit_tables *out, const struct kd_scene *scene);
    /* parts of the scene on which the numbers and tables depend; the list ends at the first part of size 0 */
    struct kd_scene_part depends[KD_EMITTER_PARTS];
    const struct kd_sentence *sentences;
    size_t n_sentences;
    const struct kd_emitter *kind; /* another emitter, whose approximations apply to this emitter too; NULL: none */
    /* another emitter, whose numbers and tables this emitter reads, together with all that the other one reads; NULL:
     * none */
    const struct kd_emitter *reads;
    /* an emitter that is left out of a scene if this emitter is present; NULL: none */
    const struct kd_emitter *replaces;
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

/* True if a scene has an emitter: the emitter is present, and no emitter that replaces it is present. */
bool kd_emit_has(const struct kd_scene *scene, const struct kd_emitter *emitter);
/* Computes the words of the specialisation constants. The words of emitters that the scene does not have are 0. */
void kd_emit_traits(const struct kd_scene *scene, uint32_t out[KD_EMITTER_COUNT]);
/* Sets KD_TRAIT_TEXELS in the words of emitters that read a buffer of quads. Call this for a device that reads the
 * buffer as texels. */
void kd_emit_as_texels(uint32_t traits[KD_EMITTER_COUNT]);
/* Needs of the scene's emitters. kd_emit_needs: quantities of the lens map. kd_emit_at_crossings: true if there is
 * light at crossings of the plane. kd_emit_at_ends: at the ends of rays. kd_emit_separate_photometry: with a luminance
 * of its own. kd_emit_points: from points. */
uint32_t kd_emit_needs(const struct kd_scene *scene);
bool kd_emit_at_crossings(const struct kd_scene *scene);
bool kd_emit_along(const struct kd_scene *scene); /* true if there are volumes */
/* true if a volume is shown as it was when its light left the volume (slow light) */
bool kd_emit_slow_along(const struct kd_scene *scene);
bool kd_emit_met(const struct kd_scene *scene); /* true if there are surfaces off the plane */
bool kd_emit_at_ends(const struct kd_scene *scene);
bool kd_emit_separate_photometry(const struct kd_scene *scene);
bool kd_emit_points(const struct kd_scene *scene);
/* Bytes of all device buffers of the scene's emitters. */
uint64_t kd_emit_device_bytes(const struct kd_scene *scene);
/* Peak of the host memory needed to make the contents of these buffers. */
uint64_t kd_emit_making_bytes(const struct kd_scene *scene);
/* Invocations of an emitter's own pass; 0 if it has none or the scene does not have the emitter. */
uint64_t kd_emit_invocations(const struct kd_scene *scene, enum kd_emitter_number number);
/* Costs of the scene's emitters. kind: hash of the set of emitters, of their traits, and of the quantities of the
 * lens map that they need. log2_of: two logarithms for each emitter: of the bytes of its own buffers, and of the
 * invocations of its own pass; 0: the emitter has no buffers or no pass. */
struct kd_work {
    uint64_t kind;
    float log2_of[KD_EMITTER_COUNT][2];
};
struct kd_work kd_emit_work(const struct kd_scene *scene);
/* True if the emitters take about the same time in a picture of the same size. This holds if the kinds are equal and no
 * number differs by more than a factor of two. */
bool kd_work_alike(const struct kd_work *a, const struct kd_work *b);
/* Calls take(user, approximation) for each approximation that is in force. */
void kd_emit_sentences(const struct kd_scene *scene, const struct kd_setting *rays,
                       void (*take)(void *user, struct kd_approximation approximation), void *user);
size_t kd_emit_sentence_count(void); /* number of all approximations, in force or not */

/* Numbers and tables of all emitters, and the scenes for which they were computed. Set to {0} before the first use.
 * Not shared between threads. */
struct kd_emit_state {
    struct kd_emit_data data;
    struct kd_scene of[KD_EMITTER_COUNT]; /* scene for which each emitter was last filled */
    bool filled[KD_EMITTER_COUNT];        /* true if each emitter was filled */
    bool colours, luminous;               /* true if the tables that depend on no scene are filled */
};
/* Brings the data up to date. band_pixels: pixels of the picture's bands (emit/frame.glsl). The first call takes 15
 * ms, and the first scene of a visible band 15 ms more. Later calls compute only data whose part of the scene has
 * changed. */
void kd_emit_update(struct kd_emit_state *state, const struct kd_scene *scene, uint32_t band_pixels);

extern const struct kd_emitter kd_emit_disk;
/* Traits of the smooth disk, which apply also to emitters that use the disk's numbers and tables. */
uint32_t kd_disk_traits(const struct kd_scene *scene);
/* Quantities of the lens map that an emitter needs if it emits light as the disk does. If rays are not on a grid,
 * Carter's Q is computed from the ray's slope. */
uint32_t kd_disk_needs(const struct kd_scene *scene);
/* kd_disk_reach: radii of the smooth disk's edges. kd_disk_tell: writes a sentence such as "A thin disk from the ISCO
 * to 22 M." for the noun "thin disk". */
void kd_disk_reach(const struct kd_scene *scene, double radii[2]);
void kd_disk_tell(const struct kd_scene *scene, const char *noun, char out[KD_EMIT_TOLD]);
/* Functions that all emitters on orbits share. They return the KD_TRAIT_... for Doppler shift and redshift, the
 * quantities of the lens map that are needed, and the causes that change the light. */
uint32_t kd_orbit_traits(const struct kd_scene *scene);
uint32_t kd_orbit_needs(const struct kd_scene *scene);
unsigned kd_orbit_varies(const struct kd_scene *scene);
/* The largest effective temperature of the disk, in K, in the frame of the gas. Returning light is included. */
double kd_disk_peak_temperature(const struct kd_scene *scene);
/* Computes, for n radii r, the temperature of a black body that is as bright as the smooth disk there, including fade
 * and opacity. The temperatures are relative to kd_disk_peak_temperature. If light returns, this makes a table in 0.1
 * to 0.3 s, so it must not be called with a lock. */
void kd_disk_heats(const struct kd_scene *scene, size_t n, const double r[], double out[]);
static inline double kd_disk_heat(const struct kd_scene *scene, double r)
{
    double heat;
    kd_disk_heats(scene, 1, &r, &heat);
    return heat;
}
/* The inner edge of the disk, M. */
double kd_disk_inner(const struct kd_scene *scene);
/* Fill in the tables of the colours and of the luminous efficiency of black bodies. The tables do not depend on the
 * scene. Each takes 15 ms. */
void kd_colour_tables(struct kd_emit_tables *out);
void kd_luminous_table(struct kd_emit_tables *out);

#endif
