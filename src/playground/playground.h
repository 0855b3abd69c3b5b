/* A playground: bodies that move round the hole and attract one another, their mergers, captures and debris. Double
 * precision; one thread at a time. Units G = c = M = 1 (body.h).
 *
 *     struct kd_playground *p;
 *     kd_playground_create(&params, &p, error);
 *     kd_playground_add(p, &body, &id, error);
 *     kd_playground_advance(p, 1000, &progress);   p->t is now 1000, or more by up to a sub-step, or less if the budget
 *                                                  was spent
 *     kd_playground_destroy(p);
 *
 * Gravity "paczynski-wiita": the hole rests at the origin and attracts by its potential (hole.h), and bodies attract
 * one another (mutual.h). Leapfrog (kick, drift, kick) with one sub-step for all,
 *
 *     h <= min(h_max, C (r - 2) of each body, C (sum of (m_i + m_j)/s^3 over a body's pairs)^(-1/2)).
 *
 * The step is chosen so that a step backwards has the same length. Let R(x) be 1/h for the largest h that the bound
 * allows at the positions x; then 1/h_n + 1/h_(n-1) = 2 R(x_n) (T. Holder, B. Leimkuhler & S. Reich 2001, Appl. Numer.
 * Math. 39, 367). The method is time-symmetric and so has no drift of energy. Steps are never stretched or cut to meet
 * a requested time: dividing the time into calls differently gives the same bits. Speeds are capped at 1, which only
 * removes energy; `spent` counts the removed energy.
 *
 * Gravity "kerr": bodies follow geodesics (geodesic.h) without mutual gravity, tides or waves. The positions of all
 * bodies are updated together, once every h_max, or more often if the budget is short. If the budget of an advance is
 * spent between two updates, no body has moved yet, and the next advance continues the computation. Such unfinished
 * work is not in a snapshot.
 *
 * Results depend on the state alone, including the seed. They are the same on other machines with IEEE arithmetic,
 * provided that the C library's sqrt, cbrt and pow are. */
#ifndef KD_PLAYGROUND_PLAYGROUND_H
#define KD_PLAYGROUND_PLAYGROUND_H

#include "playground/debris.h"
#include "playground/event.h"
#include "playground/geodesic.h"
#include "playground/mutual.h"
#include "playground/params.h"
#include "playground/series.h"

#include "base/error.h"

#define KD_PLAYGROUND_TIME 1e12 /* latest time of a playground and of a scene, M */

/* Sums of everything that has been removed from the motion of the bodies since the beginning. With these sums, energy
 * and momentum are conserved. */
struct kd_playground_spent {
    /* mass, energy and angular momentum of captured bodies */
    double captured_mass, captured_energy, captured_momentum[3];
    double merged;                 /* energy that became heat in mergers of bodies */
    double capped;                 /* energy removed by the cap of speeds at c */
    double capped_momentum[3];     /* momentum removed by this cap where the attraction of other bodies dominated */
    double radiated;               /* energy lost to gravitational waves */
    double torn_mass, torn_energy; /* mass and energy of the matter that became debris */
    /* Energy that was added or removed from outside: by adding, removing or changing bodies, and by recomputing the
     * mutual potential. */
    double given;
};

struct kd_playground {
    struct kd_playground_params params;
    double t;
    uint64_t steps;
    struct kd_playground_body *bodies; /* the n bodies, in order of creation */
    size_t n, room;
    uint32_t last_id;
    double rate;     /* 1/h of the previous step; 0 if the next step is chosen without regard to a previous one */
    uint64_t random; /* number of random numbers drawn so far */
    bool held;       /* true if the acceleration by waves was limited, at least once, to a tenth of the attraction */
    struct kd_playground_spent spent;
    struct kd_playground_events events;
    struct kd_playground_debris debris;
    struct kd_playground_series series;
    struct kd_playground_geodesic *geodesics; /* for gravity "kerr": a geodesic for each body */
    /* The members below are computed from those above. */
    struct kd_playground_mutual mutual;
    bool disturbed;
    double before; /* energy before the first change from outside since the last step */
    double aim;
    /* For gravity "kerr": the time that the geodesics approach, and the number of geodesics that have reached it. When
     * all have reached it, the bodies move. */
    size_t approached;
    bool forced;                  /* true if `mutual` is up to date */
    double margin;                /* margin with which `mutual` was computed */
    double last_row[KD_SERIES_N]; /* row of the series at the time before the current step */
};

enum kd_status kd_playground_create(const struct kd_playground_params *params, struct kd_playground **out,
                                    struct kd_error *error);
void kd_playground_destroy(struct kd_playground *p); /* p may be NULL */

/* Adds a body. Returns KD_EINVAL with the pointer "/position", "/velocity" and so on if such a body cannot exist, or
 * KD_ETOOBIG if there are already KD_PLAYGROUND_BODIES_MAX bodies. body->id is ignored. An empty name becomes "body
 * ID". id may be NULL. */
enum kd_status kd_playground_add(struct kd_playground *p, const struct kd_playground_body *body, uint32_t *id,
                                 struct kd_error *error);
/* returns NULL if there is no such body */
struct kd_playground_body *kd_playground_find(struct kd_playground *p, uint32_t id);
enum kd_status kd_playground_remove(struct kd_playground *p, uint32_t id, struct kd_error *error);
/* Replaces the body with this id. The id stays the same. */
enum kd_status kd_playground_change(struct kd_playground *p, uint32_t id, const struct kd_playground_body *body,
                                    struct kd_error *error);
/* Changes the settings. Returns KD_EINVAL if gravity or the hole would change. */
enum kd_status kd_playground_set(struct kd_playground *p, const struct kd_playground_params *params,
                                 struct kd_error *error);

struct kd_playground_progress {
    double asked, done; /* time requested, and time done, M */
    uint32_t steps;
    /* true if the budget was spent before the time was over, or if the time ends beyond KD_PLAYGROUND_TIME */
    bool slowed;
    bool ended; /* true if KD_PLAYGROUND_TIME is reached, so that the motion has stopped */
};

/* Advances by `time` > 0, or by less if the budget of sub-steps is spent earlier. */
void kd_playground_advance(struct kd_playground *p, double time, struct kd_playground_progress *progress);

/* State of an advance in pieces, which allows other work in between: call begin, then go_on until it returns false. The
 * result is identical to that of kd_playground_advance. A piece is a sub-step, or 256 steps of geodesics with gravity
 * "kerr". A sub-step with a million pieces of debris takes tens of milliseconds. */
struct kd_playground_run {
    double begin, end;
    double stride; /* gravity "kerr": time between updates of the bodies, M */
    uint64_t first;
    /* Remaining sub-steps or, for gravity "kerr", remaining steps of geodesics. The caller may lower this after
     * kd_playground_begin. */
    uint32_t left;
    bool stuck; /* true if the sub-step is below the resolution of t, so that time cannot advance */
};
void kd_playground_begin(struct kd_playground *p, double time, struct kd_playground_run *run);
bool kd_playground_go_on(struct kd_playground *p, struct kd_playground_run *run,
                         /* runs up to `pieces` pieces; returns false when the advance is finished */
                         uint32_t pieces);
struct kd_playground_progress kd_playground_progress(const struct kd_playground *p,
                                                     const struct kd_playground_run *run);

/* True if mutual gravity has accelerated bodies above c. Capping their speeds removed momentum that no other body
 * received. This happens if bodies fall from rest and touch at a distance below 2 (m1 + m2). */
bool kd_playground_lost_momentum(const struct kd_playground *p);

/* Sums over all bodies at present. */
struct kd_playground_totals {
    /* masses and energies; potential: energy in the hole's field; mutual: energy of the pairs */
    double mass, kinetic, potential, mutual;
    double energy, momentum[3], angular[3];
    /* gravitational-wave strain times distance, seen along +z, from the second derivative of the quadrupole */
    double h_plus, h_cross;
    double separation,
        /* Distance and wave frequency of the closest bound pair of bodies or, if there is no such pair, of the
         * innermost body and the hole; NAN without bodies. */
        wave_frequency;
};
struct kd_playground_totals kd_playground_totals(struct kd_playground *p);

/* Writes the present values as a row of `series`. */
void kd_playground_series_row(struct kd_playground *p, double row[KD_SERIES_N]);
/* Restarts the series at the present time. span: its length in M, or 0 (the default) for an open-ended series
 * (series.h). */
void kd_playground_series_begin(struct kd_playground *p, double span);

/* Writes the approximations that are in use, as an array of strings. */
void kd_playground_approximations(const struct kd_playground *p, struct kd_json *json, const char *name);

/* Private to src/playground from here on. */

/* Updates `mutual` if it is out of date. */
void kd_playground_force(struct kd_playground *p);
/* Adds the changes from outside to the sums. */
void kd_playground_settle(struct kd_playground *p);
/* Removes body i from the list. */
void kd_playground_drop(struct kd_playground *p, size_t i);
/* Handles captures, mergers and tides after a step of length h. */
void kd_playground_capture(struct kd_playground *p);
void kd_playground_merge(struct kd_playground *p, double h);
void kd_playground_tides(struct kd_playground *p);

#endif
