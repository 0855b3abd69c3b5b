/* Table of observers at a finite radius: their names, the places where they exist, and the frames in which they
 * measure. It is used for camera.observer of a scene, for /v1/physics, and for the frame of an orbit's velocity.
 *
 * To add an observer, add a row here, and the function of its frame, frame_WORD, in observer.c. Words, enumerators,
 * help, rules and error messages are generated. Double precision, pure functions, any thread. */
#ifndef KD_PHYSICS_SPACETIME_OBSERVER_H
#define KD_PHYSICS_SPACETIME_OBSERVER_H

#include "physics/spacetime/hole.h"
#include "physics/spacetime/tetrad.h"

#include <stdbool.h>

/* A row is X(NAME, word, description, where it exists, edge(a, cos(theta)), name of the edge, what holds inside). The
 * observer exists at radii larger than its edge. The last observer's velocity is a parameter, so its frame cannot be
 * the one in which other velocities are measured. */
#define KD_OBSERVERS_OF_NO_NUMBERS(X) \
    X(STATIC, static, "at rest with respect to infinity", \
      "outside the ergosphere, r > 1 + sqrt(1 - Q^2 - a^2 cos^2 i)", kd_kerr_ergosphere(hole, u), "the ergosphere", \
      "nothing is at rest") \
    X(ZAMO, zamo, "with zero angular momentum", "outside the horizon", hole->outer, "the horizon", "everything falls") \
    X(KEPLERIAN, keplerian, "on a circular orbit towards +phi like the disk, at its highest latitude", \
      "outside the photon orbit that co-rotates with the disk", kd_observer_light_orbit(hole, u, 1), \
      "the photon orbit", "there is no circular orbit") \
    X(RETROGRADE, retrograde, "on a circular orbit towards -phi, against the disk, at its highest latitude", \
      "outside the photon orbit that counter-rotates", kd_observer_light_orbit(hole, u, -1), "the photon orbit", \
      "there is no circular orbit") \
    X(INFALL, infall, "in free fall, by default from rest at infinity", \
      "outside the inner horizon, r > 1 - sqrt(1 - a^2 - Q^2)", hole->inner, "the inner horizon", "the model ends")
#define KD_OBSERVERS(X) \
    KD_OBSERVERS_OF_NO_NUMBERS(X) \
    X(VELOCITY, velocity, "with any velocity relative to the observer of zero angular momentum", \
      "outside the horizon", hole->outer, "the horizon", "everything falls")

#define KD_OBSERVER_NAME_(NAME, word, ...) KD_OBSERVER_##NAME,
enum kd_observer { KD_OBSERVERS(KD_OBSERVER_NAME_) KD_OBSERVER_COUNT };
/* number of observers before KD_OBSERVER_VELOCITY, which have no parameters */
enum { KD_OBSERVER_FRAMES = KD_OBSERVER_VELOCITY };

/* String constants made from the table. WORDS: "static|zamo|...", as in a row of enumerated words. HELP: "; static: at
 * rest ...; zamo: ...". PLACES: the places where each observer exists. */
#define KD_OBSERVER_WORD_(NAME, word, ...) "|" #word
#define KD_OBSERVER_WORDS (&(KD_OBSERVERS(KD_OBSERVER_WORD_))[1])
#define KD_OBSERVER_FRAME_WORDS (&(KD_OBSERVERS_OF_NO_NUMBERS(KD_OBSERVER_WORD_))[1])
#define KD_OBSERVER_IS_(NAME, word, what, ...) "; " #word ": " what
#define KD_OBSERVER_HELP KD_OBSERVERS(KD_OBSERVER_IS_)
#define KD_OBSERVER_WHERE_(NAME, word, what, where, ...) "; \"" #word "\": " where
#define KD_OBSERVER_PLACES KD_OBSERVERS(KD_OBSERVER_WHERE_)

/* Sense of an observer on a circular orbit: 1 in the direction of the disk, -1 against it. 0 for all other observers.
 */
static inline int kd_observer_sense(enum kd_observer observer)
{
    return (observer == KD_OBSERVER_KEPLERIAN) - (observer == KD_OBSERVER_RETROGRADE);
}
/* words of the two observers on circular orbits, for messages */
#define KD_OBSERVER_CIRCULAR "keplerian and retrograde"

/* Motion of an observer. All members except the first are parameters of one kind of observer, and are ignored for the
 * others. */
struct kd_observer_motion {
    enum kd_observer observer;
    /* for "velocity": components along e_r, e_theta and e_phi, measured by the observer of zero angular momentum; the
     * speed must be less than 1 */
    double velocity[3];
    /* for "infall": the radius from which the observer falls; there it is at rest except for its angular momentum; may
     * be INFINITY */
    double fall_from;
    double fall_energy;   /* for "infall": E per mass; INFINITY if it is computed from fall_from */
    double fall_momentum; /* for "infall": L per mass */
};

/* Name of the largest component, "velocity_r", "velocity_theta" or "velocity_phi", for a message about an excessive
 * speed. Sets *component to its value. */
const char *kd_observer_fastest(const double velocity[3], double *component);

/* The motion of an observer with default parameters: infall from rest at infinity without angular momentum, and
 * velocity 0. */
struct kd_observer_motion kd_observer_motion_of(enum kd_observer observer);

struct kd_observer_row {
    const char *word, *edge, *why; /* texts such as "static", "the ergosphere" and "nothing is at rest" */
    double (*outside)(const struct kd_hole *hole, double u);
    struct kd_tetrad (*tetrad)(const struct kd_observer_motion *motion, const struct kd_vantage *at);
};
extern const struct kd_observer_row kd_observers[KD_OBSERVER_COUNT];

/* True if this kind of observer exists at the place. */
bool kd_observer_exists(enum kd_observer observer, const struct kd_vantage *at);

/* Checks the parameters of an observer. Its kind must exist at the place. */
enum kd_observer_fault {
    KD_OBSERVER_SOUND,
    KD_OBSERVER_TOO_FAST,    /* the speed is 1 or more; `bound` is 1 */
    KD_OBSERVER_FROM_INSIDE, /* fall_from is less than the radius of the place, which is `bound` */
    /* The body's energy is too low for this place, or the body turns back on its way from fall_from. Its energy must
     * exceed `bound`. */
    KD_OBSERVER_TURNS,
    KD_OBSERVER_TWO_ENERGIES, /* both fall_energy and fall_from are given */
};
enum kd_observer_fault kd_observer_check(const struct kd_observer_motion *motion, const struct kd_vantage *at,
                                         double *bound);

/* The observer's frame. The observer must exist there and have no fault. For infall the frame is regular at the outer
 * horizon and inside.
 *
 * If the observer moves relative to the frame of zero angular momentum, the frame's legs are those of the frame of zero
 * angular momentum, boosted without rotation (kd_tetrad_boosted). */
struct kd_tetrad kd_observer_tetrad(const struct kd_observer_motion *motion, const struct kd_vantage *at);

/* Energy per mass of an infalling observer. */
double kd_observer_energy(const struct kd_observer_motion *motion, const struct kd_vantage *at);

/* Radius of the photon orbit whose highest latitude is at cos(theta) = u. sense: 1 towards +phi, -1 towards -phi.
 * Inside this radius there are no circular orbits with that latitude. */
double kd_observer_light_orbit(const struct kd_hole *hole, double u, int sense);

/* Writes the words of the observers that exist at the place, in quotes and joined by " or ". */
enum { KD_OBSERVER_TEXT = 17 * KD_OBSERVER_COUNT };
const char *kd_observer_others(const struct kd_vantage *at, char out[KD_OBSERVER_TEXT]);

#endif
