#include "render/rays/rows.h"

#include "base/decimal.h"

#include <math.h>
#include <string.h>

/* A row has at most 16 orders of `,{"order":15,"r":,"phi":,"delay":,"g":}` with four numbers, and some 150 bytes
 * more. */
_Static_assert(KD_RAYS_ROW_MAX >= KD_RAYS_MAX_ORDERS * (40 + 4 * KD_DECIMAL_SIZE) + 300, "a row may not fit");

struct row { char *at; };

static void text(struct row *row, const char *s)
{
    size_t n = strlen(s);
    memcpy(row->at, s, n);
    row->at += n;
}

static void number(struct row *row, double value) { row->at += kd_decimal_print(row->at, value); }

/* Writes "name":value if the value is finite, with a comma before it unless it is the first of its object. */
static void member(struct row *row, const char *name, double value)
{
    if (!isfinite(value))
        return;
    if (row->at[-1] != '{')
        *row->at++ = ',';
    *row->at++ = '"';
    text(row, name);
    text(row, "\":");
    number(row, value);
}

static size_t json(const struct kd_rays_answer *answer, size_t i, char *out)
{
    const struct kd_ray_end *end = &answer->ends[i];
    const struct kd_ray_crossing *c = answer->crossings + i * answer->params.orders;
    struct row row = { out };
    text(&row, i ? ",{\"fate\":\"" : "{\"fate\":\"");
    text(&row, kd_ray_fate_name(end->fate));
    text(&row, "\",\"crossings\":[");
    for (uint32_t n = 0; n < end->n_crossings; n++) {
        text(&row, n ? ",{" : "{");
        member(&row, "order", n);
        member(&row, "r", c[n].r);
        member(&row, "phi", c[n].phi);
        member(&row, "delay", c[n].delay);
        member(&row, "g", c[n].g);
        *row.at++ = '}';
    }
    *row.at++ = ']';
    if (isfinite(end->theta)) {
        text(&row, ",\"sky\":{");
        member(&row, "theta", end->theta);
        member(&row, "phi", end->phi);
        *row.at++ = '}';
    }
    member(&row, "energy", answer->params.observer ? end->energy : NAN);
    member(&row, "error", end->error);
    *row.at++ = '}';
    return (size_t)(row.at - out);
}

/* Writes a little-endian number whatever the machine's byte order is. */
static void put(struct row *row, double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    for (int i = 0; i < 8; i++)
        *row->at++ = (char)(bits >> 8 * i);
}

static size_t npy(const struct kd_rays_answer *answer, size_t i, char *out)
{
    const struct kd_ray_end *end = &answer->ends[i];
    uint32_t orders = answer->params.orders;
    const struct kd_ray_crossing *c = answer->crossings + i * orders;
    struct row row = { out };
    *row.at++ = (char)end->fate;
    *row.at++ = (char)end->n_crossings;
    put(&row, end->error);
    put(&row, end->theta);
    put(&row, end->phi);
    for (uint32_t n = 0; n < orders; n++)
        put(&row, c[n].r);
    for (uint32_t n = 0; n < orders; n++)
        put(&row, c[n].phi);
    for (uint32_t n = 0; n < orders; n++)
        put(&row, c[n].delay);
    for (uint32_t n = 0; n < orders; n++)
        put(&row, c[n].g);
    if (answer->params.observer)
        put(&row, end->energy);
    return (size_t)(row.at - out);
}

static void cell(struct row *row, double value)
{
    *row->at++ = ',';
    if (isfinite(value))
        number(row, value);
}

static size_t csv(const struct kd_rays_answer *answer, size_t i, char *out)
{
    const struct kd_ray_end *end = &answer->ends[i];
    uint32_t orders = answer->params.orders;
    const struct kd_ray_crossing *c = answer->crossings + i * orders;
    struct row row = { out };
    number(&row, answer->alpha_beta[2 * i]);
    cell(&row, answer->alpha_beta[2 * i + 1]);
    *row.at++ = ',';
    text(&row, kd_ray_fate_name(end->fate));
    cell(&row, end->n_crossings);
    cell(&row, end->error);
    cell(&row, end->theta);
    cell(&row, end->phi);
    for (uint32_t n = 0; n < orders; n++) {
        cell(&row, c[n].r);
        cell(&row, c[n].phi);
        cell(&row, c[n].delay);
        cell(&row, c[n].g);
    }
    if (answer->params.observer)
        cell(&row, end->energy);
    *row.at++ = '\n';
    return (size_t)(row.at - out);
}

size_t kd_rays_row(const struct kd_rays_answer *answer, enum kd_rays_format format, size_t ray,
                   char out[KD_RAYS_ROW_MAX])
{
    switch (format) {
    case KD_RAYS_JSON: return json(answer, ray, out);
    case KD_RAYS_NPY: return npy(answer, ray, out);
    case KD_RAYS_CSV: return csv(answer, ray, out);
    }
    return 0;
}
