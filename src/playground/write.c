#include "base/pause.h"
#include "playground/fields.h"
#include "playground/json.h"
#include "playground/state.h"

#include <math.h>

static void vector(const double v[3], struct kd_json *json, const char *name)
{
    kd_json_array(json, name);
    for (int k = 0; k < 3; k++)
        kd_json_number(json, NULL, v[k]);
    kd_json_end(json);
}

static void bodies(const struct kd_playground *p, bool ids, struct kd_json *json)
{
    kd_json_array(json, "bodies");
    for (size_t i = 0; i < p->n; i++) {
        kd_pause_every(i, 64);
        kd_json_object(json, NULL);
        if (ids)
            kd_json_number(json, "id", p->bodies[i].id);
        kd_json_string(json, "name", p->bodies[i].name);
        kd_document_write(json, &kd_playground_body_fields, &p->bodies[i]);
        vector(p->bodies[i].x, json, "position");
        vector(p->bodies[i].v, json, "velocity");
        kd_json_end(json);
    }
    kd_json_end(json);
}

enum kd_status kd_playground_write(struct kd_playground *p, bool snapshot, struct kd_buffer *out)
{
    struct kd_json json = kd_json_begin(out);
    enum kd_status status = KD_OK;
    kd_playground_settle(p);
    kd_json_object(&json, NULL);
    kd_document_write(&json, &kd_playground_settings, &p->params);
    bodies(p, false, &json);
    if (snapshot)
        status = kd_state_write(p, &json);
    kd_json_end(&json);
    return kd_json_finish_line(&json) || status ? KD_ENOMEM : KD_OK;
}

static void spent(const struct kd_playground_spent *s, struct kd_json *json)
{
    kd_json_object(json, "spent");
    kd_json_number(json, "captured_mass", s->captured_mass);
    kd_json_number(json, "captured_energy", s->captured_energy);
    vector(s->captured_momentum, json, "captured_angular_momentum");
    kd_json_number(json, "merged_energy", s->merged);
    kd_json_number(json, "capped_energy", s->capped);
    vector(s->capped_momentum, json, "capped_momentum");
    kd_json_number(json, "radiated_energy", s->radiated);
    kd_json_number(json, "torn_mass", s->torn_mass);
    kd_json_number(json, "torn_energy", s->torn_energy);
    kd_json_end(json);
}

static void totals(struct kd_playground *p, struct kd_json *json)
{
    const struct kd_playground_totals sum = kd_playground_totals(p);
    kd_json_object(json, "totals");
    kd_json_number(json, "mass", sum.mass);
    kd_json_number(json, "energy", sum.energy);
    vector(sum.momentum, json, "momentum");
    vector(sum.angular, json, "angular_momentum");
    kd_json_number(json, "separation", sum.separation);
    kd_json_number(json, "wave_frequency", sum.wave_frequency);
    kd_json_end(json);
}

static void debris(const struct kd_playground_debris *d, struct kd_json *json)
{
    kd_json_object(json, "debris");
    kd_json_number(json, "t", d->t);
    kd_json_number(json, "pieces", d->alive);
    kd_json_array(json, "sources");
    for (int i = 0; i < KD_DEBRIS_SOURCES; i++) {
        const struct kd_debris_source *s = &d->sources[i];
        if (!s->number)
            continue;
        kd_json_object(json, NULL);
        kd_json_number(json, "number", s->number);
        kd_json_string(json, "name", s->name);
        kd_json_number(json, "t", s->t);
        kd_json_number(json, "piece_mass", s->piece_mass);
        kd_json_number(json, "energy_spread", s->spread);
        kd_json_number(json, "pieces", s->pieces);
        kd_json_number(json, "back", s->all_back);
        kd_json_number(json, "captured", s->captured);
        kd_json_number(json, "lost", s->lost);
        kd_json_end(json);
    }
    kd_json_end(json);
    kd_json_end(json);
}

void kd_playground_status_json(struct kd_playground *p, struct kd_json *json)
{
    kd_json_number(json, "t", p->t);
    kd_json_number(json, "steps", (double)p->steps);
    kd_json_object(json, "settings");
    kd_document_write(json, &kd_playground_settings, &p->params);
    kd_json_end(json);
    bodies(p, true, json);
    totals(p, json);
    spent(&p->spent, json);
    debris(&p->debris, json);
    kd_json_number(json, "events", (double)p->events.last);
    kd_playground_approximations(p, json, "approximations");
}
