/* This table says of observers at a finite radius what they are called, where they exist, and in which frame they
 * measure. Whoever offers a choice of observers offers these, by this table: camera.observer of a scene,
 * /v1/physics, the frame of an orbit's velocity.
 *
 * One is added by a row here and by the function of its frame, frame_WORD in observer.c; words, enumerators, help,
 * rules and the sentences of errors follow. Double precision, pure functions, any thread. */
#ifndef KD_PHYSICS_SPACETIME_OBSERVER_H
#define KD_PHYSICS_SPACETIME_OBSERVER_H

#include "physics/spacetime/hole.h"
#include "physics/spacetime/tetrad.h"

#include <stdbool.h>

/* X(NAME, word, what it is, where it exists, edge(a, cos(theta)) of that, what the edge is called, why not inside):
 * it exists at larger radii than its edge. The last one has a velocity of its own choice, and is none to measure
 * others' velocities by. */
#define KD_OBSERVERS_OF_NO_NUMBERS(X) \
    X(STATIC, static, "at rest with respect to infinity", "outside the ergosphere, r > 1 + sqrt(1 - a^2 cos^2 i)", \
      kd_kerr_ergosphere(hole, u), "the ergosphere", "nothing is at rest") \
    X(ZAMO, zamo, "with zero angular momentum", "outside the horizon", hole->outer, "the horizon", "everything falls") \
    X(KEPLERIAN, keplerian, "on a circular orbit towards +phi, as the disk, whose highest latitude is here", \
      "outside the orbit of light that goes round with the disk", kd_observer_light_orbit(hole, u, 1), \
      "the orbit of light", "nothing goes round freely") \
    X(RETROGRADE, retrograde, "on a circular orbit towards -phi, against the disk, whose highest latitude is here", \
      "outside the orbit of light that goes round against the disk", kd_observer_light_orbit(hole, u, -1), \
      "the orbit of light", "nothing goes round freely") \
    X(INFALL, infall, "in free fall, by default from rest at infinity", \
      "outside the inner horizon, r > 1 - sqrt(1 - a^2)", hole->inner, "the inner horizon", "the model ends")
#define KD_OBSERVERS(X) \
    KD_OBSERVERS_OF_NO_NUMBERS(X) \
    X(VELOCITY, velocity, "with any velocity past the one of zero angular momentum", "outside the horizon", \
      hole->outer, "the horizon", "everything falls")

#define KD_OBSERVER_NAME_(NAME, word, ...) KD_OBSERVER_##NAME,
enum kd_observer { KD_OBSERVERS(KD_OBSERVER_NAME_) KD_OBSERVER_COUNT };
enum { KD_OBSERVER_FRAMES = KD_OBSERVER_VELOCITY }; /* those before it need no numbers */

/* String constants: "static|zamo", as a row of enumerated words has it; "; static: at rest ...; zamo: ..."; and
 * where each exists. */
#define KD_OBSERVER_WORD_(NAME, word, ...) "|" #word
#define KD_OBSERVER_WORDS (&(KD_OBSERVERS(KD_OBSERVER_WORD_))[1])
#define KD_OBSERVER_FRAME_WORDS (&(KD_OBSERVERS_OF_NO_NUMBERS(KD_OBSERVER_WORD_))[1])
#define KD_OBSERVER_IS_(NAME, word, what, ...) "; " #word ": " what
#define KD_OBSERVER_HELP KD_OBSERVERS(KD_OBSERVER_IS_)
#define KD_OBSERVER_WHERE_(NAME, word, what, where, ...) "; \"" #word "\": " where
#define KD_OBSERVER_PLACES KD_OBSERVERS(KD_OBSERVER_WHERE_)

/* In which sense one on a circular orbit goes round: 1 with the disk, -1 against it; 0: it is on none. */
static inline int kd_observer_sense(enum kd_observer observer)
{
    return (observer == KD_OBSERVER_KEPLERIAN) - (observer == KD_OBSERVER_RETROGRADE);
}
#define KD_OBSERVER_CIRCULAR "keplerian and retrograde" /* their words */

/* How an observer moves. All but the first member are numbers of one kind of observer; the others read none of them. */
struct kd_observer_motion {
    enum kd_observer observer;
    double velocity[3]; /* velocity: along e_r, e_theta, e_phi of the observer of zero angular momentum, less than 1 in
                           all */
    double fall_from;   /* infall: the radius from which it falls, there at rest but for its angular momentum; INFINITY
                           allowed */
    double fall_energy; /* infall: E per mass; INFINITY: that which follows from fall_from */
    double fall_momentum; /* infall: L per mass */
};

/* "velocity_r", "velocity_theta" or "velocity_phi": whichever component is the greatest, to be named where a speed
 * is too high; and *component. */
const char *kd_observer_fastest(const double velocity[3], double *component);

/* One that has no numbers, or the usual ones: from rest at infinity without angular momentum; velocity 0. */
struct kd_observer_motion kd_observer_motion_of(enum kd_observer observer);

struct kd_observer_row {
    const char *word, *edge, *why; /* "static", "the ergosphere", "nothing is at rest" */
    double (*outside)(const struct kd_hole *hole, double u);
    struct kd_tetrad (*tetrad)(const struct kd_observer_motion *motion, const struct kd_vantage *at);
};
extern const struct kd_observer_row kd_observers[KD_OBSERVER_COUNT];

/* Says whether the place is one of this kind of observer. */
bool kd_observer_exists(enum kd_observer observer, const struct kd_vantage *at);

/* Says what is wrong with the numbers of an observer at a place where its kind exists. */
enum kd_observer_fault {
    KD_OBSERVER_SOUND,
    KD_OBSERVER_TOO_FAST,    /* |velocity| >= 1: `bound` is 1 */
    KD_OBSERVER_FROM_INSIDE, /* it falls from `bound`, the place itself, or from further out */
    KD_OBSERVER_TURNS, /* it has too little energy to be here, or turns on its way from fall_from: more than `bound`
                          would do */
    KD_OBSERVER_TWO_ENERGIES, /* fall_energy and fall_from */
};
enum kd_observer_fault kd_observer_check(const struct kd_observer_motion *motion, const struct kd_vantage *at,
                                         double *bound);

/* Its frame; only where it exists and nothing is wrong. That of what falls is regular at the outer horizon and
 * within.
 *
 * The legs of one that moves past that of zero angular momentum are the latter's by a boost without rotation
 * (kd_tetrad_boosted). */
struct kd_tetrad kd_observer_tetrad(const struct kd_observer_motion *motion, const struct kd_vantage *at);

/* E of infall. */
double kd_observer_energy(const struct kd_observer_motion *motion, const struct kd_vantage *at);

/* The radius of the orbit of light whose highest latitude is at cos(theta) = u, towards +phi (sense 1) or -phi (-1):
 * inside, nothing goes round there on a circular orbit. */
double kd_observer_light_orbit(const struct kd_hole *hole, double u, int sense);

/* The words of those that exist there, in quotes and joined by " or ". */
enum { KD_OBSERVER_TEXT = 17 * KD_OBSERVER_COUNT };
const char *kd_observer_others(const struct kd_vantage *at, char out[KD_OBSERVER_TEXT]);

#endif
