#include "playground/playground.h"

#include "playground/hole.h"
#include "playground/wave.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define FAR 1e6 /* largest initial distance of a body, M */

static bool kerr(const struct kd_playground *p) { return p->params.gravity == KD_GRAVITY_KERR; }

static enum kd_status check_hole(const struct kd_playground_params *params, struct kd_error *error)
{
    if (params->gravity == KD_GRAVITY_KERR)
        return kd_hole_check(kd_playground_hole(params), error);
#define MORE(x, name, ...) \
    if (params->name != 0) \
        return kd_error_field( \
            error, "/" #name, \
            "%s is %.9g; without gravity \"kerr\" it must be 0, because the potential is that of an uncharged hole", \
            #name, params->name);
    KD_HOLE_MORE(MORE, )
#undef MORE
    return KD_OK;
}

enum kd_status kd_playground_create(const struct kd_playground_params *params, struct kd_playground **out,
                                    struct kd_error *error)
{
    struct kd_playground *p = calloc(1, sizeof *p);
    if (!p)
        return kd_error_set(error, KD_ENOMEM, "no memory for a playground");
    p->params = *params;
    enum kd_status status = check_hole(params, error);
    KD_TRY(status);
    KD_TRY(kd_debris_resize(&p->debris, params->debris_capacity, error));
    KD_TRY(kd_playground_mutual_reserve(&p->mutual, 1, error));
done:
    if (status)
        kd_playground_destroy(p);
    else
        *out = p;
    return status;
}

void kd_playground_destroy(struct kd_playground *p)
{
    if (!p)
        return;
    kd_debris_finish(&p->debris);
    kd_playground_mutual_finish(&p->mutual);
    free(p->bodies);
    free(p->geodesics);
    free(p);
}

static enum kd_status reserve(struct kd_playground *p, struct kd_error *error)
{
    if (p->n < p->room)
        return KD_OK;
    const size_t room = p->room ? 2 * p->room : 16;
    struct kd_playground_body *bodies = realloc(p->bodies, room * sizeof *bodies);
    if (bodies)
        p->bodies = bodies;
    struct kd_playground_geodesic *geodesics = kerr(p) ? realloc(p->geodesics, room * sizeof *geodesics) : NULL;
    if (geodesics)
        p->geodesics = geodesics;
    if (!bodies || (kerr(p) && !geodesics) || kd_playground_mutual_reserve(&p->mutual, room, NULL))
        return kd_error_set(error, KD_ENOMEM, "no memory for %zu bodies", room);
    p->room = room;
    p->forced = false;
    return KD_OK;
}

/* Checks that such a body can exist. With gravity "kerr" its geodesic decides. */
static enum kd_status check(const struct kd_playground *p, const struct kd_playground_body *body,
                            struct kd_error *error)
{
    const double r = kd_playground_radius(body->x), v = kd_playground_radius(body->v);
    for (int k = 0; k < 3; k++)
        if (!(fabs(body->x[k]) <= FAR))
            return kd_error_field(error, "/position", "position holds %g; it must be -%g to %g M", body->x[k], FAR,
                                  FAR);
    if (!(v <= 1 + 1e-12) || (kerr(p) && !(v < 1)))
        return kd_error_field(error, "/velocity", "velocity is %.9g c; it must be %s", v,
                              kerr(p) ? "less than c" : "at most c");
    if (!kerr(p) && !(r > KD_PLAYGROUND_CAPTURE))
        return kd_error_field(
            error, "/position",
            "position is %.9g M from the hole; it must be more than %g M, inside which the hole captures everything", r,
            KD_PLAYGROUND_CAPTURE);
    return KD_OK;
}

/* Records the energy, unless an earlier change has done so. Call it before the list of bodies, or a body, is changed
 * from outside. */
static void disturb(struct kd_playground *p)
{
    if (!p->disturbed && !kerr(p))
        p->before = kd_playground_totals(p).energy;
    p->disturbed = true;
}

/* Makes the next step start afresh. Call it after a change from outside. */
static void begin_anew(struct kd_playground *p)
{
    p->forced = false;
    p->rate = 0;
    p->approached = 0;
}

void kd_playground_settle(struct kd_playground *p)
{
    if (p->disturbed && !kerr(p))
        p->spent.given += kd_playground_totals(p).energy - p->before;
    p->disturbed = false;
}

static enum kd_status put(struct kd_playground *p, size_t i, const struct kd_playground_body *body, uint32_t id,
                          struct kd_error *error)
{
    enum kd_status status = check(p, body, error);
    if (!status && kerr(p))
        status = kd_geodesic_begin(&p->geodesics[i], kd_playground_hole(&p->params), body->x, body->v, p->t, error);
    if (status)
        return status;
    p->bodies[i] = *body;
    p->bodies[i].id = id;
    if (!*body->name)
        snprintf(p->bodies[i].name, sizeof p->bodies[i].name, "body %u", id);
    return KD_OK;
}

enum kd_status kd_playground_add(struct kd_playground *p, const struct kd_playground_body *body, uint32_t *id,
                                 struct kd_error *error)
{
    enum kd_status status;
    if (p->n >= KD_PLAYGROUND_BODIES_MAX)
        return kd_error_set(error, KD_ETOOBIG, "too many bodies (limit %zu for a playground)", p->n);
    disturb(p);
    KD_TRY(reserve(p, error));
    KD_TRY(put(p, p->n, body, p->last_id + 1, error));
    p->n++;
    p->last_id++;
    if (id)
        *id = p->last_id;
    begin_anew(p);
done:
    return status;
}

struct kd_playground_body *kd_playground_find(struct kd_playground *p, uint32_t id)
{
    for (size_t i = 0; i < p->n; i++)
        if (p->bodies[i].id == id)
            return &p->bodies[i];
    return NULL;
}

void kd_playground_drop(struct kd_playground *p, size_t i)
{
    p->n--;
    memmove(&p->bodies[i], &p->bodies[i + 1], (p->n - i) * sizeof *p->bodies);
    if (kerr(p))
        memmove(&p->geodesics[i], &p->geodesics[i + 1], (p->n - i) * sizeof *p->geodesics);
    begin_anew(p);
}

static enum kd_status absent(uint32_t id, struct kd_error *error)
{
    return kd_error_field(error, "/id", "there is no body %u, or it no longer exists", id);
}

enum kd_status kd_playground_remove(struct kd_playground *p, uint32_t id, struct kd_error *error)
{
    struct kd_playground_body *body = kd_playground_find(p, id);
    if (!body)
        return absent(id, error);
    disturb(p);
    kd_playground_drop(p, (size_t)(body - p->bodies));
    begin_anew(p);
    return KD_OK;
}

enum kd_status kd_playground_change(struct kd_playground *p, uint32_t id, const struct kd_playground_body *body,
                                    struct kd_error *error)
{
    struct kd_playground_body *old = kd_playground_find(p, id);
    if (!old)
        return absent(id, error);
    disturb(p);
    enum kd_status status = put(p, (size_t)(old - p->bodies), body, id, error);
    if (!status)
        begin_anew(p);
    return status;
}

bool kd_playground_params_same(const struct kd_playground_params *a, const struct kd_playground_params *b)
{
#define KD_SAME_(name, ...) &&a->name == b->name
    return true KD_PLAYGROUND_SETTINGS(KD_SAME_, KD_SAME_, KD_SAME_, KD_SAME_);
#undef KD_SAME_
}

enum kd_status kd_playground_set(struct kd_playground *p, const struct kd_playground_params *params,
                                 struct kd_error *error)
{
    if (params->gravity != p->params.gravity)
        return kd_error_field(error, "/gravity", "gravity cannot change after a playground is made");
    if (params->spin != p->params.spin)
        return kd_error_field(error, "/spin", "spin cannot change after a playground is made");
#define MORE(x, name, ...) \
    if (params->name != p->params.name) \
        return kd_error_field(error, "/" #name, "%s cannot change after a playground is made", #name);
    KD_HOLE_MORE(MORE, )
#undef MORE
    /* copy of the settings, in which only settings of the appearance may differ */
    struct kd_playground_params looks = *params;
    looks.debris_temperature_k = p->params.debris_temperature_k;
    looks.debris_depth = p->params.debris_depth;
    looks.albedo = p->params.albedo;
    const bool moves_on = kd_playground_params_same(&looks, &p->params);
    if (!moves_on)
        disturb(p);
    enum kd_status status = kd_debris_resize(&p->debris, params->debris_capacity, error);
    if (status)
        return status;
    p->params = *params;
    if (!moves_on)
        begin_anew(p);
    return KD_OK;
}

bool kd_playground_lost_momentum(const struct kd_playground *p)
{
    const double *lost = p->spent.capped_momentum;
    return lost[0] != 0 || lost[1] != 0 || lost[2] != 0;
}

void kd_playground_approximations(const struct kd_playground *p, struct kd_json *json, const char *name)
{
    const struct kd_playground_params *s = &p->params;
    kd_json_array(json, name);
    if (!(p->t < KD_PLAYGROUND_TIME))
        kd_json_string(json, NULL, "The simulation has reached its end, 1e12 M.");
    if (kerr(p)) {
        kd_json_string(
            json, NULL,
            "Bodies are test bodies: no mutual attraction, no collisions, no tides, no gravitational waves.");
    } else {
        kd_json_string(json, NULL,
                       "The hole's gravity is the potential of Paczynski and Wiita, with Schwarzschild's last stable "
                       "orbit, but without frame dragging and time dilation; its r is taken as Schwarzschild's.");
        kd_json_string(json, NULL, "The hole does not move, and captured bodies do not increase its mass.");
        kd_json_string(json, NULL, "Bodies attract one another by Newton's law, softened and without delay.");
        kd_json_string(json, NULL, "Speeds of bodies are limited to c.");
        if (kd_playground_lost_momentum(p))
            kd_json_string(
                json, NULL,
                "Bodies accelerated one another to the speed limit c; limiting their speeds removed momentum.");
        if (s->waves)
            kd_json_string(json, NULL,
                           "The loss to gravitational waves follows Peters' formula, which is of leading order: at r = "
                           "10 M its power is 4 % too high for a = 0 and 27 % too high for a = 0.9; the error falls "
                           "below 1 % only near 300 M.");
        if (s->waves && s->amplification != 1) {
            char text[120];
            snprintf(text, sizeof text, "The loss to gravitational waves is exaggerated %g times.", s->amplification);
            kd_json_string(json, NULL, text);
        }
        if (p->held)
            kd_json_string(json, NULL, "The exaggerated loss to waves was limited to a tenth of the attraction.");
        if (s->waves && p->n > KD_WAVE_PAIRS_MAX)
            kd_json_string(
                json, NULL,
                "There are too many bodies to compute waves of all pairs: each body radiates only with the hole.");
        if (s->tides && p->debris.last_source)
            kd_json_string(
                json, NULL,
                "Debris starts with a flat distribution of energies, and moves in the hole's potential alone.");
    }
    kd_json_end(json);
}
