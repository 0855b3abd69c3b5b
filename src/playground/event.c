#include "playground/event.h"

#include <math.h>

const char *kd_playground_event_word(enum kd_playground_event_kind kind)
{
#define WORD(NAME, word, ...) #word,
    static const char *const words[] = { KD_PLAYGROUND_EVENT_KINDS(WORD) };
#undef WORD
    return words[kind];
}

void kd_playground_event_add(struct kd_playground_events *events, struct kd_playground_event event)
{
    event.number = ++events->last;
    events->ring[event.number % KD_PLAYGROUND_EVENTS] = event;
}

const struct kd_playground_event *kd_playground_event_at(const struct kd_playground_events *events, uint64_t number)
{
    const struct kd_playground_event *event = &events->ring[number % KD_PLAYGROUND_EVENTS];
    return number && number <= events->last && event->number == number ? event : NULL;
}

void kd_playground_event_json(const struct kd_playground_event *event, struct kd_json *json, const char *name)
{
    kd_json_object(json, name);
    kd_json_number(json, "number", (double)event->number);
    kd_json_number(json, "t", event->t);
    kd_json_string(json, "kind", kd_playground_event_word(event->kind));
    kd_json_number(json, "body", event->body);
    kd_json_string(json, "name", event->name);
    kd_json_number(json, "mass", event->mass);
    if (event->other) {
        kd_json_number(json, "other", event->other);
        kd_json_string(json, "other_name", event->other_name);
    }
    if (event->other || isfinite(event->tidal_radius))
        kd_json_number(json, event->other ? "other_mass" : "mass_left", event->other_mass);
    kd_json_number(json, "r", event->r);
    kd_json_number(json, "energy", event->energy);
    if (isfinite(event->tidal_radius)) {
        kd_json_number(json, "tidal_radius", event->tidal_radius);
        kd_json_number(json, "energy_spread", event->spread);
    }
    kd_json_end(json);
}
