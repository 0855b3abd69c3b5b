/* Makes ticks. A tick contains numbers as JSON, and bodies and debris as packed words. */
#include "base/json.h"
#include "server/playground/playground_internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void kd_playground_session_tick_release(struct kd_playground_session_tick *tick)
{
    if (!tick || atomic_fetch_sub(&tick->references, 1) > 1)
        return;
    kd_buffer_finish(&tick->event);
    kd_buffer_finish(&tick->bodies);
    kd_buffer_finish(&tick->debris);
    free(tick);
}

static void put_word(uint8_t *to, uint32_t word)
{
    for (int i = 0; i < 4; i++)
        to[i] = (uint8_t)(word >> 8 * i);
}

static void put_float(uint8_t *to, double x)
{
    const float f = (float)x;
    uint32_t word;
    memcpy(&word, &f, 4);
    put_word(to, word);
}

static enum kd_status reserve(struct kd_buffer *buffer, size_t bytes)
{
    buffer->data = malloc(bytes ? bytes : 1);
    buffer->size = buffer->capacity = buffer->data ? bytes : 0;
    return buffer->data ? KD_OK : KD_ENOMEM;
}

static enum kd_status pack_bodies(struct kd_playground_session_tick *tick, const struct kd_playground *p)
{
    tick->n_bodies = p->n;
    if (reserve(&tick->bodies, p->n * KD_PLAY_BODY_WORDS * 4))
        return KD_ENOMEM;
    for (size_t i = 0; i < p->n; i++) {
        const struct kd_playground_body *body = &p->bodies[i];
        const double row[KD_PLAY_BODY_WORDS] = {
            0,          body->x[0], body->x[1], body->x[2],   body->v[0],
            body->v[1], body->v[2], body->mass, body->radius, body->temperature_k
        };
        uint8_t *to = tick->bodies.data + i * KD_PLAY_BODY_WORDS * 4;
        put_word(to, body->id);
        for (int k = 1; k < KD_PLAY_BODY_WORDS; k++)
            put_float(to + 4 * k, row[k]);
    }
    return KD_OK;
}

/* Packs every k-th piece of debris. k is chosen so that at most tick->most pieces are packed. */
static enum kd_status pack_debris(struct kd_playground_session_tick *tick, const struct kd_playground_debris *debris)
{
    const size_t all = debris->alive, every = all > tick->most ? (all + tick->most - 1) / tick->most : 1;
    size_t seen = 0, n = 0;
    tick->all_debris = all;
    tick->has_debris = true;
    if (reserve(&tick->debris, (all + every - 1) / every * KD_PLAY_DEBRIS_WORDS * 4))
        return KD_ENOMEM;
    for (uint32_t i = 0; i < debris->used && seen < all; i++) {
        const struct kd_debris_piece *piece = &debris->pieces[i];
        if (piece->stage == KD_DEBRIS_FREE || seen++ % every)
            continue;
        uint8_t *to = tick->debris.data + n++ * KD_PLAY_DEBRIS_WORDS * 4;
        for (int k = 0; k < 3; k++)
            put_float(to + 4 * k, piece->x[k]);
        put_word(to + 12, (uint32_t)piece->stage << 16 | piece->source);
    }
    tick->n_debris = n;
    tick->debris.size = n * KD_PLAY_DEBRIS_WORDS * 4;
    return KD_OK;
}

/* Fallback rate: the mass that falls back, per M of time. It is taken from the last complete bin and summed over all
 * sources; NAN if there is none. */
static double fallback_rate(const struct kd_playground_debris *debris)
{
    double sum = NAN;
    for (int i = 0; i < KD_DEBRIS_SOURCES; i++) {
        const struct kd_debris_source *source = &debris->sources[i];
        const double age = debris->t - source->t, bin = age >= 1 ? floor(KD_DEBRIS_PER_DECADE * log10(age)) - 1 : -1;
        if (!source->number || bin < 0)
            continue;
        const double rate = kd_debris_rate(source, (int)fmin(bin, KD_DEBRIS_BINS - 1)).rate;
        sum = isnan(sum) ? rate : sum + rate;
    }
    return sum;
}

static unsigned lost_pieces(const struct kd_playground_debris *debris)
{
    unsigned lost = 0;
    for (int i = 0; i < KD_DEBRIS_SOURCES; i++)
        lost += debris->sources[i].number ? debris->sources[i].lost : 0;
    return lost;
}

static void add_row(struct kd_json *json, struct kd_playground *p)
{
    double row[KD_SERIES_N];
    kd_playground_series_row(p, row);
    for (int i = 0; i < KD_SERIES_N; i++) {
        if (i == KD_SERIES_angular_momentum_x)
            kd_json_array(json, "angular_momentum");
        const bool part = i >= KD_SERIES_angular_momentum_x && i <= KD_SERIES_angular_momentum_z;
        kd_json_number(json, part ? NULL : kd_series_column(i), row[i]);
        if (i == KD_SERIES_angular_momentum_z)
            kd_json_end(json);
    }
}

static enum kd_status describe(struct kd_playground_session_tick *tick, struct kd_playground *p,
                               const struct kd_playground_session_state *state)
{
    struct kd_json json = kd_json_begin(&tick->event);
    kd_json_object(&json, NULL);
    kd_json_number(&json, "generation", (double)tick->generation);
    kd_json_number(&json, "rate", state->pace.rate);
    kd_json_number(&json, "rate_reached", state->reached);
    kd_json_bool(&json, "paused", state->pace.paused);
    kd_json_bool(&json, "slowed", state->slowed);
    kd_json_bool(&json, "resting", state->resting);
    kd_json_number(&json, "watchers", state->watchers);
    add_row(&json, p);
    kd_json_number(&json, "debris_lost", lost_pieces(&p->debris));
    kd_json_number(&json, "fallback_rate", fallback_rate(&p->debris));
    kd_json_number(&json, "event", (double)p->events.last);
    kd_json_end(&json);
    return kd_json_finish(&json);
}

struct kd_playground_session_tick *kd_playground_session_tick_make(struct kd_playground *p,
                                                                   const struct kd_playground_session_state *state,
                                                                   uint32_t debris)
{
    struct kd_playground_session_tick *tick = calloc(1, sizeof *tick);
    enum kd_status status;
    if (!tick)
        return NULL;
    tick->references = 1;
    tick->generation = state->generation;
    tick->t = p->t;
    tick->most = debris;
    KD_TRY(describe(tick, p, state));
    KD_TRY(pack_bodies(tick, p));
    if (debris)
        KD_TRY(pack_debris(tick, &p->debris));
done:
    if (!status)
        return tick;
    kd_playground_session_tick_release(tick);
    return NULL;
}
