#include "playground/state.h"

#include "base/pause.h"
#include "playground/base64.h"
#include "playground/fields.h"
#include "playground/hole.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define MOST 1e300
/* latest time of a snapshot, M; the last sub-step may exceed the end of time */
#define LAST (KD_PLAYGROUND_TIME + 1e6)
#define OLD_PIECE ((size_t)32) /* size of a piece in snapshots of an older version, bytes */
#define WHOLE 9e15             /* integers up to this size are exact as doubles */

/* Tables of named numbers, for the playground, for its debris, for a body and for a source. */
struct number {
    const char *name;
    size_t offset;
    enum { REAL, TIME, COUNT, COUNT32, BOOL } kind;
};
#define OF(type, member, kind) { #member, offsetof(struct type, member), kind }
static const struct number whole[] = { OF(kd_playground, t, TIME),          OF(kd_playground, steps, COUNT),
                                       OF(kd_playground, last_id, COUNT32), OF(kd_playground, rate, REAL),
                                       OF(kd_playground, random, COUNT),    OF(kd_playground, held, BOOL) };
static const struct number spent[] = {
    OF(kd_playground_spent, captured_mass, REAL), OF(kd_playground_spent, captured_energy, REAL),
    OF(kd_playground_spent, merged, REAL),        OF(kd_playground_spent, capped, REAL),
    OF(kd_playground_spent, radiated, REAL),      OF(kd_playground_spent, torn_mass, REAL),
    OF(kd_playground_spent, torn_energy, REAL),   OF(kd_playground_spent, given, REAL)
};
static const struct number body[] = {
    OF(kd_playground_body, id, COUNT32),        OF(kd_playground_body, whole_mass, REAL),
    OF(kd_playground_body, whole_radius, REAL), OF(kd_playground_body, depth, REAL),
    OF(kd_playground_body, shed, REAL),         OF(kd_playground_body, told, REAL),
    OF(kd_playground_body, source, COUNT32),    OF(kd_playground_body, radiated, REAL),
    OF(kd_playground_body, told_inspiral, BOOL)
};
static const struct number debris[] = { OF(kd_playground_debris, used, COUNT32),
                                        OF(kd_playground_debris, next, COUNT32),
                                        OF(kd_playground_debris, last_source, COUNT32),
                                        OF(kd_playground_debris, t, TIME), OF(kd_playground_debris, haste, REAL) };
static const struct number source[] = { OF(kd_debris_source, number, COUNT32),   OF(kd_debris_source, t, TIME),
                                        OF(kd_debris_source, piece_mass, REAL),  OF(kd_debris_source, worth, REAL),
                                        OF(kd_debris_source, spread, REAL),      OF(kd_debris_source, pieces, COUNT32),
                                        OF(kd_debris_source, captured, COUNT32), OF(kd_debris_source, lost, COUNT32) };
static const struct number geodesic[] = { OF(kd_playground_geodesic, from_t, TIME) };
#define N(table) (sizeof(table) / sizeof *(table))

static void write_numbers(const void *from, const struct number *table, size_t n, struct kd_json *json)
{
    for (size_t i = 0; i < n; i++) {
        const void *at = (const char *)from + table[i].offset;
        switch (table[i].kind) {
        case REAL:
        case TIME: kd_json_number(json, table[i].name, *(const double *)at); break;
        case COUNT: kd_json_number(json, table[i].name, (double)*(const uint64_t *)at); break;
        case COUNT32: kd_json_number(json, table[i].name, *(const uint32_t *)at); break;
        case BOOL: kd_json_number(json, table[i].name, *(const bool *)at); break;
        }
    }
}

static void write_array(const double *numbers, int n, struct kd_json *json, const char *name)
{
    kd_json_array(json, name);
    for (int i = 0; i < n; i++)
        kd_json_number(json, NULL, numbers[i]);
    kd_json_end(json);
}

static enum kd_status write_debris(const struct kd_playground_debris *d, struct kd_json *json)
{
    const size_t bytes = d->used * sizeof *d->pieces;
    char *text = malloc(kd_base64_length(bytes) + 1);
    if (!text)
        return KD_ENOMEM;
    kd_json_object(json, "debris");
    write_numbers(d, debris, N(debris), json);
    kd_json_array(json, "sources");
    for (int i = 0; i < KD_DEBRIS_SOURCES; i++) {
        double back[KD_DEBRIS_BINS];
        if (!d->sources[i].number)
            continue;
        for (int k = 0; k < KD_DEBRIS_BINS; k++)
            back[k] = d->sources[i].back[k];
        kd_json_object(json, NULL);
        write_numbers(&d->sources[i], source, N(source), json);
        kd_json_string(json, "name", d->sources[i].name);
        write_array(back, KD_DEBRIS_BINS, json, "back");
        kd_json_end(json);
    }
    kd_json_end(json);
    kd_base64_write(text, d->pieces, bytes);
    kd_json_string(json, "pieces", text);
    kd_json_end(json);
    free(text);
    return KD_OK;
}

enum kd_status kd_state_write(const struct kd_playground *p, struct kd_json *json)
{
    kd_json_object(json, "state");
    write_numbers(p, whole, N(whole), json);
    kd_json_number(json, "events", (double)p->events.last);
    kd_json_object(json, "spent");
    write_numbers(&p->spent, spent, N(spent), json);
    write_array(p->spent.captured_momentum, 3, json, "captured_momentum");
    write_array(p->spent.capped_momentum, 3, json, "capped_momentum");
    kd_json_end(json);
    kd_json_array(json, "bodies");
    for (size_t i = 0; i < p->n; i++) {
        kd_pause_every(i, 64);
        kd_json_object(json, NULL);
        write_numbers(&p->bodies[i], body, N(body), json);
        if (p->params.gravity == KD_GRAVITY_KERR) {
            double state[KD_GEODESIC_STATE];
            kd_geodesic_save(&p->geodesics[i], state);
            write_array(p->geodesics[i].from_x, 3, json, "from_position");
            write_array(p->geodesics[i].from_v, 3, json, "from_velocity");
            write_numbers(&p->geodesics[i], geodesic, N(geodesic), json);
            write_array(state, KD_GEODESIC_STATE, json, "geodesic");
        }
        kd_json_end(json);
    }
    kd_json_end(json);
    const enum kd_status status = write_debris(&p->debris, json);
    kd_json_end(json);
    return status;
}

static enum kd_status bad(const char *pointer, const char *name, const char *what, struct kd_error *error)
{
    char at[160];
    kd_playground_pointer(at, pointer, name);
    return kd_error_field(error, at, "%s %s", name, what);
}

static const struct range {
    double least, most;
    bool whole;
} ranges[] = {
    [REAL] = { -MOST, MOST, false },     [TIME] = { 0, LAST, false }, [COUNT] = { 0, WHOLE, true },
    [COUNT32] = { 0, UINT32_MAX, true }, [BOOL] = { 0, 1, true },
};

static enum kd_status read_numbers(void *to, const struct number *table, size_t n, const cJSON *item,
                                   const char *pointer, struct kd_error *error)
{
    for (size_t i = 0; i < n; i++) {
        void *at = (char *)to + table[i].offset;
        const cJSON *one = cJSON_GetObjectItemCaseSensitive(item, table[i].name);
        const struct range *may = &ranges[table[i].kind];
        const double x = cJSON_IsNumber(one) ? one->valuedouble : NAN;
        if (!(x >= may->least && x <= may->most) || (may->whole && x != floor(x))) {
            char what[120];
            snprintf(what, sizeof what, "is %.17g; it must be %s%.17g to %.17g", x,
                     may->whole ? "a whole number from " : "", may->least, may->most);
            return bad(pointer, table[i].name, cJSON_IsNumber(one) ? what : "is not a number", error);
        }
        switch (table[i].kind) {
        case REAL:
        case TIME: *(double *)at = x; break;
        case COUNT: *(uint64_t *)at = (uint64_t)x; break;
        case COUNT32: *(uint32_t *)at = (uint32_t)x; break;
        case BOOL: *(bool *)at = x != 0; break;
        }
    }
    return KD_OK;
}

static enum kd_status read_source(struct kd_playground_debris *d, const cJSON *item, const char *pointer,
                                  struct kd_error *error)
{
    struct kd_debris_source one = { 0 };
    double back[KD_DEBRIS_BINS];
    const cJSON *name = cJSON_GetObjectItemCaseSensitive(item, "name");
    enum kd_status status;
    KD_TRY(read_numbers(&one, source, N(source), item, pointer, error));
    KD_TRY(kd_playground_numbers(back, KD_DEBRIS_BINS, UINT32_MAX, cJSON_GetObjectItemCaseSensitive(item, "back"),
                                 pointer, error));
    if (!one.number || one.number > d->last_source || !(one.spread > 0) || !(one.piece_mass > 0) ||
        !(one.worth > 0 && one.worth <= 1) || !cJSON_IsString(name))
        KD_TRY(bad(pointer, "number", "and the members beside it do not describe a source of debris", error));
    snprintf(one.name, sizeof one.name, "%s", name->valuestring);
    for (int k = 0; k < KD_DEBRIS_BINS; k++) {
        one.back[k] = (uint32_t)fmax(back[k], 0);
        one.all_back += one.back[k];
    }
    d->sources[one.number % KD_DEBRIS_SOURCES] = one;
done:
    return status;
}

/* Counts the pieces again and checks them. Returns false if a piece is impossible. */
static bool look(struct kd_playground_debris *d)
{
    double haste = 0;
    d->alive = 0;
    for (uint32_t i = 0; i < d->used; i++) {
        kd_pause_every(i, 16384);
        const struct kd_debris_piece *piece = &d->pieces[i];
        const double r = kd_playground_radius(piece->x);
        if (piece->stage > KD_DEBRIS_BACK || piece->source >= KD_DEBRIS_SOURCES)
            return false;
        if (piece->stage == KD_DEBRIS_FREE)
            continue;
        if (!(r > KD_PLAYGROUND_CAPTURE && r < 1e18) || !(kd_playground_radius(piece->v) < 1.001) ||
            !d->sources[piece->source].number)
            return false;
        haste += 1 / (r - KD_PLAYGROUND_HORIZON);
        d->alive++;
    }
    /* A wrong value of `haste` is refused, because it determines the sub-steps of all pieces in a stride. */
    return !d->alive || (d->haste > 0.5 * haste && d->haste < 1e9);
}

static enum kd_status read_debris(struct kd_playground_debris *d, const cJSON *item, struct kd_error *error)
{
    const char *pointer = "/state/debris";
    const cJSON *sources = cJSON_GetObjectItemCaseSensitive(item, "sources"),
                *pieces = cJSON_GetObjectItemCaseSensitive(item, "pieces");
    enum kd_status status;
    KD_TRY(read_numbers(d, debris, N(debris), item, pointer, error));
    if (d->used > d->capacity || d->next > d->used || (d->capacity && d->next >= d->capacity)) {
        d->used = d->next = 0;
        KD_TRY(bad(pointer, "used", "exceeds the capacity", error));
    }
    if (cJSON_IsString(pieces) && d->used && strlen(pieces->valuestring) == kd_base64_length(d->used * OLD_PIECE)) {
        d->used = d->next = 0;
        KD_TRY(
            bad(pointer, "pieces",
                "come from an older version with positions in single precision; this version cannot continue from them",
                error));
    }
    for (const cJSON *one = cJSON_IsArray(sources) ? sources->child : NULL; one; one = one->next)
        KD_TRY(read_source(d, one, "/state/debris/sources", error));
    if (!cJSON_IsString(pieces) || !kd_base64_read(d->pieces, d->used * sizeof *d->pieces, pieces->valuestring) ||
        !look(d)) {
        d->used = d->next = d->alive = 0;
        KD_TRY(bad(pointer, "pieces", "are not pieces that a snapshot can have", error));
    }
done:
    return status;
}

static enum kd_status read_body(struct kd_playground *p, size_t i, const cJSON *item, struct kd_error *error)
{
    const char *pointer = "/state/bodies";
    double state[KD_GEODESIC_STATE], x[3], v[3];
    struct kd_playground_geodesic begun = { 0 };
    enum kd_status status;
    KD_TRY(read_numbers(&p->bodies[i], body, N(body), item, pointer, error));
    const struct kd_playground_body *read = &p->bodies[i];
    if (!read->id || read->id > p->last_id || (i && read->id <= p->bodies[i - 1].id))
        KD_TRY(bad(pointer, "id", "must be larger than the id of the body before, and at most last_id", error));
    if (read->whole_mass != 0 &&
        !(read->whole_mass >= KD_PLAYGROUND_LEAST && read->whole_radius >= KD_PLAYGROUND_LEAST))
        KD_TRY(bad(pointer, "whole_mass", "and whole_radius do not describe a star during its passage", error));
    if (p->params.gravity != KD_GRAVITY_KERR)
        return KD_OK;
    KD_TRY(kd_playground_numbers(x, 3, 1e6, cJSON_GetObjectItemCaseSensitive(item, "from_position"), pointer, error));
    KD_TRY(kd_playground_numbers(v, 3, 1, cJSON_GetObjectItemCaseSensitive(item, "from_velocity"), pointer, error));
    KD_TRY(kd_playground_numbers(state, KD_GEODESIC_STATE, MOST, cJSON_GetObjectItemCaseSensitive(item, "geodesic"),
                                 pointer, error));
    KD_TRY(read_numbers(&begun, geodesic, N(geodesic), item, pointer, error));
    KD_TRY(kd_geodesic_begin(&p->geodesics[i], kd_playground_hole(&p->params), x, v, begun.from_t, error));
    kd_geodesic_restore(&p->geodesics[i], state);
done:
    return status;
}

enum kd_status kd_state_read(struct kd_playground *p, const cJSON *state, struct kd_error *error)
{
    const cJSON *bodies = cJSON_GetObjectItemCaseSensitive(state, "bodies"),
                *gone = cJSON_GetObjectItemCaseSensitive(state, "spent"),
                *events = cJSON_GetObjectItemCaseSensitive(state, "events");
    size_t i = 0;
    enum kd_status status;
    KD_TRY(read_numbers(p, whole, N(whole), state, "/state", error));
    KD_TRY(read_numbers(&p->spent, spent, N(spent), gone, "/state/spent", error));
    KD_TRY(kd_playground_numbers(p->spent.captured_momentum, 3, MOST,
                                 cJSON_GetObjectItemCaseSensitive(gone, "captured_momentum"), "/state/spent", error));
    const cJSON *capped = cJSON_GetObjectItemCaseSensitive(gone, "capped_momentum");
    if (capped) /* snapshots of older versions do not have this number */
        KD_TRY(kd_playground_numbers(p->spent.capped_momentum, 3, MOST, capped, "/state/spent", error));
    if (!cJSON_IsArray(bodies) || (size_t)cJSON_GetArraySize(bodies) != p->n || p->rate < 0)
        KD_TRY(bad("/state", "bodies", "and bodies differ in length", error));
    for (const cJSON *one = bodies->child; one; one = one->next) {
        kd_pause_every(i, 64);
        KD_TRY(read_body(p, i++, one, error));
    }
    KD_TRY(read_debris(&p->debris, cJSON_GetObjectItemCaseSensitive(state, "debris"), error));
    p->events.last = cJSON_IsNumber(events) && events->valuedouble >= 0 && events->valuedouble <= WHOLE
                         ? (uint64_t)events->valuedouble
                         : 0;
    p->forced = false;
done:
    return status;
}
