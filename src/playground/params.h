/* Settings of a playground, with one row for each. The struct, its defaults, reading and writing of JSON and of --set,
 * and the schema are generated from the rows. Any thread. */
#ifndef KD_PLAYGROUND_PARAMS_H
#define KD_PLAYGROUND_PARAMS_H

#include "document/document.h"
#include "physics/spacetime/hole.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum kd_playground_gravity { KD_GRAVITY_PACZYNSKI_WIITA, KD_GRAVITY_KERR };

#define KD_PLAYGROUND_BODIES_MAX 4096u
#define KD_PLAYGROUND_DEBRIS_MAX 1000000u

/* Rows of settings: REAL or INT(NAME, default, least, most, help), BOOL(NAME, default, help), WORD(NAME, default,
 * "a|b", help). gravity and the hole cannot be changed after a playground is made. */
#define KD_PLAYGROUND_HOLE_(REAL, name, member, least, most, shown, unit, card, what, bound, ...) \
    REAL(name, 0, least, 0.999, what " in " unit " (gravity \"kerr\" only); the bodies are neutral; " bound)
#define KD_PLAYGROUND_SETTINGS(REAL, INT, BOOL, WORD) \
    WORD(gravity, KD_GRAVITY_PACZYNSKI_WIITA, "paczynski-wiita|kerr", \
         "gravity of the hole: a potential, in which bodies also attract one another, or exact geodesics of test " \
         "bodies") \
    REAL(spin, 0, -0.999, 0.999, "spin of the hole (gravity \"kerr\" only)") \
    KD_HOLE_MORE(KD_PLAYGROUND_HOLE_, REAL) \
    REAL(softening, 0.05, 1e-4, 1e3, "softening length in M of the bodies' mutual attraction") \
    REAL(h_max, 1, 1e-6, 1e6, "longest sub-step in M, and the interval at which debris is advanced") \
    REAL(safety, 0.03, 1e-4, 0.2, \
         "factor C of the limit C (r - 2) of the sub-step, and of its limit for two close bodies") \
    INT(budget, 20000, 1, 100000000, \
        "limit of the sub-steps of one advance; if it is reached, the advance is shorter than requested") \
    BOOL(mergers, true, "bodies that touch merge") \
    BOOL(tides, true, "the hole's tide sheds a star's mass, and tears it apart") \
    BOOL(waves, false, "bodies lose energy to gravitational waves") \
    REAL(amplification, 1, 0, 1e9, "factor on the loss to gravitational waves; 1: the physical value") \
    BOOL(feeds, true, "debris that has returned is counted as accreted and removed; otherwise it moves on") \
    INT(debris_capacity, 100000, 0, KD_PLAYGROUND_DEBRIS_MAX, \
        "largest number of pieces of debris; beyond it, a new piece replaces the oldest") \
    INT(debris_per_body, 20000, 16, KD_PLAYGROUND_DEBRIS_MAX, \
        "number of pieces of debris of a body that is torn apart") \
    REAL(debris_temperature_k, 5000, 300, 1e9, "temperature in K of the debris, a black body in pictures") \
    REAL(debris_depth, 1, 0, 1e6, \
         "optical depth in pictures that the debris of one body has if it is spread over 1000 M^2") \
    REAL(albedo, 0, 0, 1, "share of the disk's light that bodies reflect in pictures; 0: reflection is not computed") \
    INT(seed, 1, 0, 4294967295u, "seed of the random directions of debris")

struct kd_playground_params {
#define KD_REAL_(name, ...) double name;
#define KD_WHOLE_(name, ...) uint32_t name;
#define KD_TRUTH_(name, ...) bool name;
#define KD_WORD_(name, ...) int name;
    KD_PLAYGROUND_SETTINGS(KD_REAL_, KD_WHOLE_, KD_TRUTH_, KD_WORD_)
#undef KD_REAL_
#undef KD_WHOLE_
#undef KD_TRUTH_
#undef KD_WORD_
};

extern const struct kd_document kd_playground_settings; /* document of struct kd_playground_params */
/* document of the fields of struct kd_playground_body that are numbers */
extern const struct kd_document kd_playground_body_fields;

struct kd_playground_params kd_playground_defaults(void);
/* The hole of gravity "kerr", for use as a function's argument. The value lives until the end of the enclosing block.
 */
#define kd_playground_hole(params) ((const struct kd_hole[]) { kd_hole_in(params) })

bool kd_playground_params_same(const struct kd_playground_params *a,
                               /* compares all settings; defined in playground.c */
                               const struct kd_playground_params *b);

#endif
