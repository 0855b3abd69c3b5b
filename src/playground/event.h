/* Numbered events of a playground, such as mergers and captures. The last KD_PLAYGROUND_EVENTS are kept. One thread
 * at a time. */
#ifndef KD_PLAYGROUND_EVENT_H
#define KD_PLAYGROUND_EVENT_H

#include "playground/body.h"

#include "base/json.h"

enum { KD_PLAYGROUND_EVENTS = 4096 };

/* Kinds of events: X(NAME, word, description of the event and of its energy) */
#define KD_PLAYGROUND_EVENT_KINDS(X) \
    X(MERGER, merger, "two bodies have merged; energy: the energy that became heat") \
    X(SHEDDING, shedding, \
      "the tide has removed part of a star; energy: the energy of the shed mass in the hole's field") \
    X(DISRUPTION, disruption, "the tide has torn a star apart; energy: the energy of the debris in the hole's field") \
    X(CAPTURED, capture, "the hole has captured a body; energy: the energy of the body in the hole's field") \
    X(INSPIRAL, inspiral, \
      "gravitational waves have brought a body inside 6 M; energy: the energy that the waves carried away") \
    X(ESCAPE, escape, "a test body has left the simulated space; energy: none")

#define KD_EVENT_(NAME, ...) KD_PLAYGROUND_##NAME,
enum kd_playground_event_kind { KD_PLAYGROUND_EVENT_KINDS(KD_EVENT_) KD_PLAYGROUND_EVENT_N_KINDS };
#undef KD_EVENT_
const char *kd_playground_event_word(enum kd_playground_event_kind kind);

struct kd_playground_event {
    uint64_t number; /* number of the event, from 1 on */
    double t;
    enum kd_playground_event_kind kind;
    uint32_t body, other; /* ids of the bodies of the event; `other` is 0 if there is only one body */
    char name[KD_PLAYGROUND_NAME], other_name[KD_PLAYGROUND_NAME];
    /* For a merger: masses of the two bodies before it. For shedding and disruption: the lost mass, and the mass that
     * is left. */
    double mass, other_mass;
    double r, energy;
    /* For shedding and disruption: tidal radius r_t, and half width of the debris' energies. NAN for other events. */
    double tidal_radius, spread;
};

struct kd_playground_events {
    struct kd_playground_event ring[KD_PLAYGROUND_EVENTS]; /* event number k is at index k % KD_PLAYGROUND_EVENTS */
    uint64_t last;                                         /* number of the newest event; 0 if there was none yet */
};

void kd_playground_event_add(struct kd_playground_events *events, struct kd_playground_event event);
/* The event with this number; NULL if it is no longer kept, or has not happened yet. */
const struct kd_playground_event *kd_playground_event_at(const struct kd_playground_events *events, uint64_t number);
void kd_playground_event_json(const struct kd_playground_event *event, struct kd_json *json, const char *name);

#endif
