#include "render/rays/answer.h"

#include "base/decimal.h"
#include "base/pause.h"
#include "image/npy.h"
#include "render/rays/hold.h"
#include "render/rays/rows.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

size_t kd_rays_answer_bytes(const struct kd_rays_params *params, size_t n)
{
    return n * (2 * sizeof(double) + params->orders * sizeof(struct kd_ray_crossing) + sizeof(struct kd_ray_end));
}

enum kd_status kd_rays_answer_init(struct kd_rays_answer *answer, const struct kd_rays_params *params,
                                   double *alpha_beta, size_t n, struct kd_error *error)
{
    *answer = (struct kd_rays_answer) { .params = *params, .n = n, .alpha_beta = alpha_beta };
    answer->crossings = calloc(n * params->orders, sizeof *answer->crossings);
    answer->ends = calloc(n, sizeof *answer->ends);
    if (answer->crossings && answer->ends)
        return KD_OK;
    kd_rays_answer_finish(answer);
    return kd_error_set(error, KD_ENOMEM, "out of memory for %zu rays at %u orders", n, params->orders);
}

void kd_rays_answer_finish(struct kd_rays_answer *answer)
{
    free(answer->alpha_beta);
    free(answer->crossings);
    free(answer->ends);
    *answer = (struct kd_rays_answer) { 0 };
}

static int ascending(const void *a, const void *b)
{
    static _Thread_local uint64_t compared;
    kd_pause_every(compared++, 65536);
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

enum kd_status kd_rays_answer_summarise(struct kd_rays_answer *answer, struct kd_error *error)
{
    double *errors = malloc((answer->n + 1) * sizeof *errors);
    size_t n = 0;
    if (!errors)
        return kd_error_set(error, KD_ENOMEM, "out of memory for %zu errors", answer->n);
    answer->undecided = answer->followed_again = answer->beyond = 0;
    for (size_t i = 0; i < answer->n; i++) {
        kd_pause_every(i, 65536);
        answer->undecided += answer->ends[i].fate == KD_RAY_UNDECIDED;
        answer->followed_again += answer->ends[i].again;
        answer->beyond += answer->params.tolerance > 0 && !kd_rays_held(&answer->ends[i], answer->params.tolerance);
        if (isfinite(answer->ends[i].error))
            errors[n++] = answer->ends[i].error;
    }
    qsort(errors, n, sizeof *errors, ascending);
    answer->worst_error = n ? errors[n - 1] : NAN;
    answer->median_error = n ? errors[(n - 1) / 2] : NAN;
    free(errors);
    return KD_OK;
}

static enum kd_status add_number(struct kd_buffer *out, const char *before, double value)
{
    char text[KD_DECIMAL_SIZE];
    if (!isfinite(value))
        return KD_OK;
    kd_decimal_print(text, value);
    return kd_buffer_printf(out, "%s%s", before, text);
}

static enum kd_status json_accuracy(const struct kd_rays_answer *answer, struct kd_buffer *out)
{
    const struct kd_rays_params *p = &answer->params;
    enum kd_status status;
    KD_TRY(kd_buffer_printf(out, "{\"engine\":\"%s\",\"precision\":\"%s\",\"steps\":%u,\"rays\":%zu,\"undecided\":%zu",
                            kd_engine_name(p->engine), kd_precision_name(p->precision), p->steps, answer->n,
                            answer->undecided));
    if (p->tolerance > 0) {
        KD_TRY(add_number(out, ",\"tolerance\":", p->tolerance));
        KD_TRY(kd_buffer_printf(out, ",\"followed_again\":%zu,\"beyond\":%zu", answer->followed_again, answer->beyond));
    }
    if (p->holds > 0)
        KD_TRY(add_number(out, ",\"holds\":", p->holds));
    KD_TRY(add_number(out, ",\"worst_error\":", answer->worst_error));
    KD_TRY(add_number(out, ",\"median_error\":", answer->median_error));
    KD_TRY(kd_buffer_printf(out, "}"));
done:
    return status;
}

#define WHEN(name, condition) \
    static bool name(const struct kd_rays_params *params) { return condition; }
WHEN(is_labelled, !isinf(params->r) && !params->observer)
WHEN(is_single, params->precision == KD_PRECISION_F32 && !(params->tolerance > 0))
WHEN(is_compared, params->engine >= KD_ENGINE_KS_EULER)
WHEN(is_held, params->tolerance > 0 && params->engine != KD_ENGINE_CLOSED)

static const struct {
    struct kd_approximation is;
    bool (*in_force)(const struct kd_rays_params *params); /* NULL: always */
} approximations[] = {
    { { "rays.vacuum", "rays are null geodesics in vacuum: no plasma, no scattering, no absorption at a crossing" },
      NULL },
    { { "rays.gas", "g is for gas on circular equatorial orbits outside the ISCO; inside the ISCO it is for gas that "
                    "falls with the energy and angular momentum of the ISCO; pressure is ignored" },
      NULL },
    { { "rays.infinity",
        "g is relative to infinity; for an observer at a finite radius, multiply it by the observer's nu/E_infinity" },
      is_labelled },
    { { "rays.f32",
        "rays are followed in 32-bit arithmetic; within about 1e-5 of the critical curve their fate may be wrong" },
      is_single },
    { { "rays.from-1000",
        "the engine starts rays from infinity at 1000 M, at the exact position given by their constants; the direction "
        "of escape is that of the momentum at 1000 M, accurate to 1e-6 rad" },
      is_compared },
    { { "rays.again", "rays whose error exceeds the tolerance were traced again in double precision and, if needed, in "
                      "closed form; each ray has its error, which may still exceed the tolerance" },
      is_held },
};

bool kd_rays_approximation(const struct kd_rays_params *params, size_t index, struct kd_approximation *out)
{
    for (size_t i = 0; i < sizeof approximations / sizeof *approximations; i++)
        if ((!params || !approximations[i].in_force || approximations[i].in_force(params)) && !index--)
            return *out = approximations[i].is, true;
    /* without params no approximation of the hole is added, because the page of all approximations lists these with
     * the approximations of pictures */
    const struct kd_hole_sentence *of_hole = params ? kd_hole_sentence(kd_hole_given(params), index) : NULL;
    if (of_hole)
        *out = (struct kd_approximation) { of_hole->name, of_hole->text };
    return of_hole;
}

/* Writes the observer's motion and its parameters. Parameters whose value is the word for INFINITY are left out. */
static enum kd_status json_motion(const struct kd_rays_params *p, struct kd_buffer *out)
{
    const int of = p->observer - 1;
    enum kd_status status;
    KD_TRY(kd_buffer_printf(out, ",\"motion\":\"%s\"", kd_observers[of].word));
    if (of == KD_OBSERVER_VELOCITY) {
        KD_TRY(add_number(out, ",\"velocity_r\":", p->velocity[0]));
        KD_TRY(add_number(out, ",\"velocity_theta\":", p->velocity[1]));
        KD_TRY(add_number(out, ",\"velocity_phi\":", p->velocity[2]));
    }
    if (of == KD_OBSERVER_INFALL) {
        KD_TRY(add_number(out, ",\"infall_from\":", p->fall_from));
        KD_TRY(add_number(out, ",\"infall_energy\":", p->fall_energy));
        KD_TRY(add_number(out, ",\"infall_momentum\":", p->fall_momentum));
    }
done:
    return status;
}

static enum kd_status json_head(const struct kd_rays_answer *answer, struct kd_buffer *out)
{
    const struct kd_rays_params *p = &answer->params;
    struct kd_approximation one;
    enum kd_status status;
    KD_TRY(add_number(out, "{\"spin\":", p->spin));
#define MORE(x, name, ...) \
    if (p->name != 0) \
        KD_TRY(add_number(out, ",\"" #name "\":", p->name));
    KD_HOLE_MORE(MORE, )
#undef MORE
    KD_TRY(isinf(p->r) ? kd_buffer_printf(out, ",\"observer\":{\"r\":\"infinity\"")
                       : add_number(out, ",\"observer\":{\"r\":", p->r));
    KD_TRY(add_number(out, ",\"inclination_deg\":", p->inclination_deg));
    if (p->observer)
        KD_TRY(json_motion(p, out));
    KD_TRY(kd_buffer_printf(out, "},\"orders\":%u,\"accuracy\":", p->orders));
    KD_TRY(json_accuracy(answer, out));
    KD_TRY(kd_buffer_printf(out, ",\"approximations\":["));
    for (size_t i = 0; kd_rays_approximation(p, i, &one); i++)
        KD_TRY(kd_buffer_printf(out, "%s\"%s\"", i ? "," : "", one.text));
    KD_TRY(kd_buffer_printf(out, "],\"rays\":["));
done:
    return status;
}

static enum kd_status npy_head(const struct kd_rays_answer *answer, struct kd_buffer *out)
{
    uint32_t orders = answer->params.orders;
    const struct kd_npy array = {
        .fields = { { "fate", KD_NPY_U1, 0 },
                    { "n_crossings", KD_NPY_U1, 0 },
                    { "error", KD_NPY_F8, 0 },
                    { "sky_theta", KD_NPY_F8, 0 },
                    { "sky_phi", KD_NPY_F8, 0 },
                    { "r", KD_NPY_F8, orders },
                    { "phi", KD_NPY_F8, orders },
                    { "delay", KD_NPY_F8, orders },
                    { "g", KD_NPY_F8, orders },
                    { "energy", KD_NPY_F8, 0 } },
        .n_fields = answer->params.observer ? 10 : 9,
        .shape = { answer->n },
        .n_dimensions = 1,
    };
    return kd_npy_write_header(&array, out);
}

static enum kd_status csv_head(const struct kd_rays_answer *answer, struct kd_buffer *out)
{
    enum kd_status status;
    KD_TRY(kd_buffer_printf(out, "%s,fate,n_crossings,error,sky_theta,sky_phi",
                            answer->params.observer ? "yaw_deg,pitch_deg" : "alpha,beta"));
    for (uint32_t n = 0; n < answer->params.orders; n++)
        KD_TRY(kd_buffer_printf(out, ",r%u,phi%u,delay%u,g%u", n, n, n, n));
    KD_TRY(kd_buffer_printf(out, answer->params.observer ? ",energy\n" : "\n"));
done:
    return status;
}

enum kd_status kd_rays_stream_init(struct kd_rays_stream *stream, const struct kd_rays_answer *answer,
                                   enum kd_rays_format format, struct kd_error *error)
{
    static enum kd_status (*const heads[])(const struct kd_rays_answer *, struct kd_buffer *) = {
        [KD_RAYS_JSON] = json_head,
        [KD_RAYS_NPY] = npy_head,
        [KD_RAYS_CSV] = csv_head,
    };
    stream->answer = answer;
    stream->format = format;
    stream->head = (struct kd_buffer) { 0 };
    stream->head_at = stream->next = stream->row_size = stream->row_at = 0;
    stream->tail_done = false;
    if (heads[format](answer, &stream->head))
        return kd_error_set(error, KD_ENOMEM, "out of memory for the answer");
    return KD_OK;
}

void kd_rays_stream_finish(struct kd_rays_stream *stream) { kd_buffer_finish(&stream->head); }

size_t kd_rays_stream_size(const struct kd_rays_stream *stream)
{
    if (stream->format != KD_RAYS_NPY)
        return 0;
    const struct kd_rays_params *p = &stream->answer->params;
    return stream->head.size + stream->answer->n * (2 + 8 * (3 + 4 * (size_t)p->orders + (p->observer ? 1 : 0)));
}

/* Writes the next ray, or the end of the list, to stream->row. Returns false after the end. */
static bool refill(struct kd_rays_stream *stream)
{
    static const char tail[] = "]}\n";
    stream->row_at = stream->row_size = 0;
    if (stream->next < stream->answer->n) {
        stream->row_size = kd_rays_row(stream->answer, stream->format, stream->next++, stream->row);
        return true;
    }
    if (stream->tail_done || stream->format != KD_RAYS_JSON)
        return false;
    stream->tail_done = true;
    stream->row_size = sizeof tail - 1;
    memcpy(stream->row, tail, sizeof tail - 1);
    return true;
}

static size_t hand_out(char *to, size_t room, const void *from, size_t size, size_t *at)
{
    size_t n = size - *at < room ? size - *at : room;
    if (n)
        memcpy(to, (const char *)from + *at, n);
    *at += n;
    return n;
}

size_t kd_rays_stream_read(struct kd_rays_stream *stream, void *to, size_t size)
{
    size_t used = hand_out(to, size, stream->head.data, stream->head.size, &stream->head_at);
    while (used < size) {
        if (stream->row_at == stream->row_size && !refill(stream))
            break;
        used += hand_out((char *)to + used, size - used, stream->row, stream->row_size, &stream->row_at);
    }
    return used;
}
