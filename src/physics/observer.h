/* Observers at a finite radius: what they are called, where they exist, and the frame in which they measure. Whoever offers a choice of
 * observers offers these, by this table: camera.observer of a scene, /v1/physics, the frame of an orbit's velocity.
 *
 * One is added by a row here and by the function of its frame, frame_WORD in observer.c; words, enumerators, help, rules
 * and the sentences of errors follow. Double precision, pure functions, any thread. */
#ifndef KD_PHYSICS_OBSERVER_H
#define KD_PHYSICS_OBSERVER_H

#include "physics/tetrad.h"

#include <stdbool.h>

/* X(NAME, word, what it is, where it exists, edge(a, cos(theta)) of that, what the edge is called, why not inside): it exists at larger
 * radii than its edge. */
#define KD_OBSERVERS(X)                                                                                        \
    X(STATIC, static, "at rest with respect to infinity", "outside the ergosphere, r > 1 + sqrt(1 - a^2 cos^2 i)", \
      kd_kerr_ergosphere(a, u), "the ergosphere", "nothing is at rest")                                        \
    X(ZAMO, zamo, "with zero angular momentum", "outside the horizon", kd_kerr_horizon(a), "the horizon", "everything falls")

#define KD_OBSERVER_NAME_(NAME, word, ...) KD_OBSERVER_##NAME,
enum kd_observer { KD_OBSERVERS(KD_OBSERVER_NAME_) KD_OBSERVER_COUNT };

/* String constants: "static|zamo", as a row of enumerated words has it; "; static: at rest ...; zamo: ..."; and where each exists. */
#define KD_OBSERVER_WORD_(NAME, word, ...) "|" #word
#define KD_OBSERVER_WORDS (&(KD_OBSERVERS(KD_OBSERVER_WORD_))[1])
#define KD_OBSERVER_IS_(NAME, word, what, ...) "; " #word ": " what
#define KD_OBSERVER_HELP KD_OBSERVERS(KD_OBSERVER_IS_)
#define KD_OBSERVER_WHERE_(NAME, word, what, where, ...) "; \"" #word "\": " where
#define KD_OBSERVER_PLACES KD_OBSERVERS(KD_OBSERVER_WHERE_)

struct kd_observer_row {
    const char *word, *edge, *why; /* "static", "the ergosphere", "nothing is at rest" */
    double (*outside)(double a, double u);
    struct kd_tetrad (*tetrad)(const struct kd_vantage *at);
};
extern const struct kd_observer_row kd_observers[KD_OBSERVER_COUNT];

bool kd_observer_exists(enum kd_observer observer, const struct kd_vantage *at);

/* Its frame; only where it exists. r > r+ for now: the tetrads are those of Boyer-Lindquist coordinates. */
struct kd_tetrad kd_observer_tetrad(enum kd_observer observer, const struct kd_vantage *at);

/* The words of those that exist there, in quotes and joined by " or ". */
enum { KD_OBSERVER_TEXT = 16 * KD_OBSERVER_COUNT };
const char *kd_observer_others(const struct kd_vantage *at, char out[KD_OBSERVER_TEXT]);

#endif
