/* A playground has bodies that move round the hole and pull one another, and says what becomes of them. Double
 * precision; a playground belongs to one thread at a time. Units G = c = M = 1 (body.h).
 *
 *     struct kd_playground *p;
 *     kd_playground_create(&params, &p, error);
 *     kd_playground_add(p, &body, &id, error);
 *     kd_playground_advance(p, 1000, &progress);              p->t is 1000 or a sub-step more, or less where the
 *       budget was spent
 *     kd_playground_destroy(p);
 *
 * Gravity "paczynski-wiita": the hole stands still at the origin and pulls by its potential (hole.h), bodies pull
 * one another (mutual.h). Kick, drift, kick with one sub-step for all,
 *
 *     h <= min(h_max, C (r - 2) of each body, C (sum of (m_i + m_j)/s^3 over a body's pairs)^(-1/2)),
 *
 * the bound at the begin of the step and at its end taken together so that a step backwards would have the same
 * length: with 1/h = G the rate that the bound demands, 1/h_n + 1/h_(n-1) = 2 G(x_n) (T. Holder, B. Leimkuhler & S.
 * Reich 2001, Appl. Numer. Math. 39, 367). Time-symmetric, the method has no drift of energy. Steps are never
 * stretched or cut to meet a time that is asked for: how the time is divided into calls changes nothing, to the bit.
 * Speeds are held at 1, which takes energy and never gives any; what it took is in the books (`spent`).
 *
 * Gravity "kerr": bodies follow geodesics (geodesic.h) and do not know of one another, of tides or of waves. They
 * are told where they are once every h_max, or oftener where the budget is short, and all at the same time: an
 * advance whose budget is spent in between has not moved them, and the next one goes on with what has been computed.
 * What has not led anywhere yet is not in a snapshot.
 *
 * All results depend on the state alone, the seed included; on this machine and another with IEEE arithmetic they
 * are the same as far as its C library's sqrt, cbrt and pow are. */
#ifndef KD_PLAYGROUND_PLAYGROUND_H
#define KD_PLAYGROUND_PLAYGROUND_H

#include "playground/debris.h"
#include "playground/event.h"
#include "playground/geodesic.h"
#include "playground/mutual.h"
#include "playground/params.h"
#include "playground/series.h"

#include "base/error.h"

#define KD_PLAYGROUND_TIME 1e12 /* M: the end of time, in scenes too */

/* What has left the motion of the bodies since the begin: with it the books balance. */
struct kd_playground_spent {
    double captured_mass, captured_energy, captured_momentum[3]; /* angular momentum */
    double merged;                                               /* energy: heat of mergers */
    double capped;                                               /* energy: speeds held at c */
    double capped_momentum[3];     /* where the pull of other bodies had brought them above it */
    double radiated;               /* energy: gravitational waves */
    double torn_mass, torn_energy; /* became debris */
    double
        given; /* energy of what was added, removed or changed from outside, and of restarts of the mutual potential */
};

struct kd_playground {
    struct kd_playground_params params;
    double t;
    uint64_t steps;
    struct kd_playground_body *bodies; /* n of them, in the order in which they came */
    size_t n, room;
    uint32_t last_id;
    double rate;     /* 1/h of the step before; 0: there is none, the next one begins anew */
    uint64_t random; /* numbers drawn */
    bool held;       /* the loss to waves was held back at a tenth of the pull, at some time */
    struct kd_playground_spent spent;
    struct kd_playground_events events;
    struct kd_playground_debris debris;
    struct kd_playground_series series;
    struct kd_playground_geodesic *geodesics; /* gravity "kerr": one a body */
    /* From here on what follows from the above. */
    struct kd_playground_mutual mutual;
    bool disturbed;
    double before; /* bodies were changed from outside since the last step, and the energy then was this */
    double aim;
    size_t approached; /* the time after t that geodesics approach, and how many have; bodies are told where they are
                          when all have */
    bool forced;       /* `mutual` is that of the bodies as they are */
    double margin;     /* that it was made with */
    double last_row[KD_SERIES_N]; /* a row of the series, before the step under way */
};

enum kd_status kd_playground_create(const struct kd_playground_params *params, struct kd_playground **out,
                                    struct kd_error *error);
void kd_playground_destroy(struct kd_playground *p); /* accepts NULL */

/* KD_EINVAL with the pointer "/position", "/velocity", ... where there can be no such body; KD_ETOOBIG: there are
 * KD_PLAYGROUND_BODIES_MAX. body->id is not looked at; an empty name becomes "body ID". *id may be NULL. */
enum kd_status kd_playground_add(struct kd_playground *p, const struct kd_playground_body *body, uint32_t *id,
                                 struct kd_error *error);
struct kd_playground_body *kd_playground_find(struct kd_playground *p, uint32_t id); /* NULL: there is none */
enum kd_status kd_playground_remove(struct kd_playground *p, uint32_t id, struct kd_error *error);
/* Puts another body in the place of the one with this id, which the new one keeps. */
enum kd_status kd_playground_change(struct kd_playground *p, uint32_t id, const struct kd_playground_body *body,
                                    struct kd_error *error);
/* Other settings from now on; gravity and spin stay what they are: KD_EINVAL. */
enum kd_status kd_playground_set(struct kd_playground *p, const struct kd_playground_params *params,
                                 struct kd_error *error);

struct kd_playground_progress {
    double asked, done; /* in M */
    uint32_t steps;
    bool slowed; /* the budget was spent before the time was over, or that would lead past KD_PLAYGROUND_TIME */
    bool ended;  /* it has come to KD_PLAYGROUND_TIME, and stands */
};

/* Moves all on by `time` > 0, or by as many sub-steps as the budget has. */
void kd_playground_advance(struct kd_playground *p, double time, struct kd_playground_progress *progress);

/* The same in pieces, for who has other things to do in between: begin, then go on until that says that it is over.
 * The outcome is that of kd_playground_advance to the bit. A piece is at most so many sub-steps; one sub-step with a
 * million pieces of debris takes tens of milliseconds. With gravity "kerr" a piece is 256 steps of geodesics. */
struct kd_playground_run {
    double begin, end;
    double stride; /* gravity "kerr": the bodies are told where they are so often */
    uint64_t first;
    uint32_t left; /* sub-steps, or of gravity "kerr" steps of geodesics; whoever wants fewer may set it after
                      kd_playground_begin */
    bool stuck;    /* time cannot tell so little */
};
void kd_playground_begin(struct kd_playground *p, double time, struct kd_playground_run *run);
bool kd_playground_go_on(struct kd_playground *p, struct kd_playground_run *run,
                         uint32_t pieces); /* false: it is over */
struct kd_playground_progress kd_playground_progress(const struct kd_playground *p,
                                                     const struct kd_playground_run *run);

/* Whether bodies' pull on one another has brought speeds above c: what was taken from them there is momentum that no
 * other body has got. Bodies that touch below 2 (m1 + m2) of each other fall that fast from rest. */
bool kd_playground_lost_momentum(const struct kd_playground *p);

/* Sums over the bodies as they are now. */
struct kd_playground_totals {
    double mass, kinetic, potential, mutual; /* the last two: in the hole's field, and of the pairs */
    double energy, momentum[3], angular[3];
    double h_plus, h_cross; /* strain times distance, seen along +z: the second derivative of their quadrupole */
    double separation,
        wave_frequency; /* of the closest bound pair of bodies, else of the innermost body and the hole; NAN: no body */
};
struct kd_playground_totals kd_playground_totals(struct kd_playground *p);

/* What a row of `series` would hold now. */
void kd_playground_series_row(struct kd_playground *p, double row[KD_SERIES_N]);
/* Begins the series anew, here: over the next `span` M, or with 0 open (series.h), as it is where nobody begins it. */
void kd_playground_series_begin(struct kd_playground *p, double span);

/* The sentences that are in force, as an array of strings. */
void kd_playground_approximations(const struct kd_playground *p, struct kd_json *json, const char *name);

/* Private to src/playground from here on. */

/* Makes `mutual` that of the bodies as they are, if it is not. */
void kd_playground_force(struct kd_playground *p);
/* Books what was given and taken from outside. */
void kd_playground_settle(struct kd_playground *p);
/* Takes body i out of the list. */
void kd_playground_drop(struct kd_playground *p, size_t i);
/* What has become of the bodies in the step of h that has just been made. */
void kd_playground_capture(struct kd_playground *p);
void kd_playground_merge(struct kd_playground *p, double h);
void kd_playground_tides(struct kd_playground *p);

#endif
