#include "render/emit/matter_grid.h"

#include "base/json.h"
#include "image/npy.h"
#include "image/zip.h"
#include "physics/constants.h"
#include "physics/kerr.h"

#include <cjson/cJSON.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define NEVER -1e6 /* log2 of nothing */
#define COLD -24.0 /* log2 of k T/(m_e c^2), below which no fit holds: 354 K */
#define EMPTY \
    40.0 /* octaves that a node without matter has less than the fullest: light falls to nothing within a cell */
#define EVEN 1e-3   /* of a step: so far from their places rows may be */
#define AXIS 1e-9   /* sin^2(theta), below which no azimuth is known */
#define UNIT 1e-2   /* of 1: so far from it u.u may be */
#define FINEST 1024 /* rows where r grows by a factor of e: a stretch of the march is two cells */
#define PARTS 64    /* of a turn, one of which a grid may be */
#define HEADER_MOST 65536

/* Arrays by their places in a node; `scale`: times r to this power. */
static const struct {
    const char *name, *unit;
    double least, most;
    int scale;
} kinds[] = {
    { "density", "cm^-3", 0, 1e30, 0 },       { "temperature", "K", 0, 1e30, 0 },
    { "u_con_r", "c", -1e6, 1e6, 0 },         { "u_con_theta", "c/M", -1e6, 1e6, 1 },
    { "u_cov_phi", "c M", -1e6, 1e6, -1 },    { "b_con_r", "G", -1e15, 1e15, 0 },
    { "b_con_theta", "G/M", -1e15, 1e15, 1 }, { "b_cov_phi", "G M", -1e15, 1e15, -1 },
};
enum { DENSITY, TEMPERATURE, VELOCITY, FIELD = 5 };
_Static_assert(sizeof kinds / sizeof *kinds == KD_MATTER_FLOATS, "a float for each");

struct reader {
    const void *data;
    size_t size;
    struct kd_matter_grid *grid;
    double *r, *theta;
    struct kd_error *error;
};

/* An array of doubles, whatever it was. */
struct array {
    double *at;
    uint64_t shape[4];
    size_t n, dimensions;
};

bool kd_matter_grid_is(const void *data, size_t size) { return size > 4 && !memcmp(data, "PK\3\4", 4); }

/* A ZIP file ends with the record of its directory, of 22 bytes without a comment: libarchive reads what has lost
 * that, too. */
static bool is_whole(const void *data, size_t size)
{
    return size >= 22 && !memcmp((const uint8_t *)data + size - 22, "PK\5\6", 4);
}

static enum kd_status refuse(struct reader *r, const char *name, const char *what)
{
    return kd_error_set(r->error, KD_EINVAL, "a grid of matter is an NPZ file of arrays: %s %s", name, what);
}

static enum kd_status no_memory(struct reader *r)
{
    return kd_error_set(r->error, KD_ENOMEM, "out of memory for a grid of matter");
}

static enum kd_status member(struct reader *r, const char *name, size_t most, struct kd_buffer *out)
{
    char file[40], what[100];
    snprintf(file, sizeof file, "%s.npy", name);
    snprintf(what, sizeof what, "is missing, damaged or longer than %zu bytes", most);
    enum kd_status status = kd_zip_find(r->data, r->size, file, most, out);
    return status == KD_ENOMEM ? no_memory(r) : status ? refuse(r, name, what) : KD_OK;
}

static bool has(const struct reader *r, const char *name)
{
    char file[40];
    snprintf(file, sizeof file, "%s.npy", name);
    return kd_zip_has(r->data, r->size, file);
}

/* Takes an array of at most so many numbers. */
static enum kd_status take(struct reader *r, const char *name, size_t most, struct array *out)
{
    struct kd_buffer bytes = { 0 };
    struct kd_npy npy;
    struct kd_error why = { 0 };
    *out = (struct array) { 0 };
    enum kd_status status = member(r, name, 8 * most + KD_NPY_HEADER_MAX + 12, &bytes);
    if (status)
        return status;
    if (kd_npy_read(bytes.data, bytes.size, &npy, &why))
        status = refuse(r, name, why.message);
    else if (npy.n_fields != 1 || npy.fields[0].name[0] || npy.fields[0].type > KD_NPY_F4 || !npy.items ||
             npy.items > most)
        status = refuse(r, name, "has no plain numbers <f8 or <f4, or has none, or too many of them");
    else if (!(out->at = malloc(npy.items * sizeof *out->at)))
        status = no_memory(r);
    for (size_t i = 0; !status && i < npy.items; i++) {
        const uint8_t *p = bytes.data + npy.header_size + i * npy.item_size;
        float single;
        if (npy.fields[0].type == KD_NPY_F8)
            memcpy(&out->at[i], p, 8);
        else {
            memcpy(&single, p, 4);
            out->at[i] = single;
        }
    }
    out->n = npy.items;
    out->dimensions = npy.n_dimensions;
    memcpy(out->shape, npy.shape, sizeof out->shape);
    kd_buffer_finish(&bytes);
    return status;
}

static const char *text_of(const cJSON *header, const char *name)
{
    const char *text = cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(header, name));
    return text ? text : "";
}

static enum kd_status check_units(struct reader *r, const cJSON *units)
{
    static const char *const others[][2] = { { "r", "M" }, { "theta", "rad" } };
    char name[60], what[200];
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds + 2; i++) {
        const char *of = i < 2 ? others[i][0] : kinds[i - 2].name, *unit = i < 2 ? others[i][1] : kinds[i - 2].unit,
                   *is = text_of(units, of);
        if (!strcmp(is, unit))
            continue;
        snprintf(name, sizeof name, "header.units.%s", of);
        snprintf(what, sizeof what, "%s%.60s%s, allowed is \"%s\"", *is ? "is \"" : "is missing", is, *is ? "\"" : "",
                 unit);
        return refuse(r, name, what);
    }
    return KD_OK;
}

static enum kd_status check_header(struct reader *r, const cJSON *header)
{
    const cJSON *spin = cJSON_GetObjectItemCaseSensitive(header, "spin"),
                *version = cJSON_GetObjectItemCaseSensitive(header, "version");
    const char *azimuth = text_of(header, "azimuth");
    if (strcmp(text_of(header, "format"), "kerrd-grid") || !cJSON_IsNumber(version) || version->valuedouble != 1)
        return refuse(r, "header", "has not the format \"kerrd-grid\" of version 1");
    if (!cJSON_IsNumber(spin) || !(fabs(spin->valuedouble) <= 1))
        return refuse(r, "header.spin", "is no number from -1 to 1");
    r->grid->spin = spin->valuedouble;
    r->grid->ingoing = !strcmp(azimuth, "kerr-schild");
    if (!r->grid->ingoing && strcmp(azimuth, "boyer-lindquist"))
        return refuse(r, "header.azimuth", "is neither \"boyer-lindquist\" nor \"kerr-schild\"");
    return check_units(r, cJSON_GetObjectItemCaseSensitive(header, "units"));
}

static enum kd_status take_header(struct reader *r)
{
    struct kd_buffer bytes = { 0 }, text = { 0 };
    struct kd_error why = { 0 };
    enum kd_status status = member(r, "header", HEADER_MOST, &bytes);
    if (!status && (status = kd_npy_read_text(bytes.data, bytes.size, &text, &why)))
        status = status == KD_ENOMEM ? no_memory(r) : refuse(r, "header", why.message);
    cJSON *header = status ? NULL : cJSON_ParseWithLength(text.data ? (const char *)text.data : "", text.size);
    if (!status)
        status = cJSON_IsObject(header) ? check_header(r, header) : refuse(r, "header", "is no JSON object");
    cJSON_Delete(header);
    kd_buffer_finish(&bytes);
    kd_buffer_finish(&text);
    return status;
}

/* Checks that places grow in even steps, by their logarithm where they are to. */
static enum kd_status check_even(struct reader *r, const char *name, const struct array *a, bool logarithmic,
                                 double least, double most)
{
    char what[200];
    const double first = logarithmic ? log(a->at[0]) : a->at[0],
                 last = logarithmic ? log(a->at[a->n - 1]) : a->at[a->n - 1],
                 step = (last - first) / (double)(a->n - 1);
    if (a->dimensions != 1 || a->n < 2)
        return refuse(r, name, "is no list of 2 numbers or more");
    for (size_t i = 0; i < a->n; i++) {
        const double at = logarithmic ? log(a->at[i]) : a->at[i], want = first + step * (double)i;
        if (a->at[i] >= least && a->at[i] <= most && fabs(at - want) <= EVEN * step)
            continue;
        snprintf(what, sizeof what, "%zu is %.9g, allowed are numbers from %.4g to %.4g in even steps%s, here %.9g", i,
                 a->at[i], least, most, logarithmic ? " of their logarithm" : "", logarithmic ? exp(want) : want);
        return refuse(r, name, what);
    }
    return step > 0 ? KD_OK : refuse(r, name, "does not grow");
}

static enum kd_status take_round(struct reader *r)
{
    struct kd_matter_grid *g = r->grid;
    struct array a = { 0 };
    enum kd_status status;
    g->layers = 1;
    g->turn = 2 * M_PI;
    if (!has(r, "phi"))
        return KD_OK;
    KD_TRY(take(r, "phi", KD_MATTER_SIDE, &a));
    KD_TRY(check_even(r, "phi", &a, false, -4 * M_PI, 4 * M_PI));
    const double turn = (a.at[a.n - 1] - a.at[0]) / (double)(a.n - 1) * (double)a.n, parts = rint(2 * M_PI / turn);
    if (!(parts >= 1 && parts <= PARTS && fabs(turn * parts / (2 * M_PI) - 1) < EVEN))
        KD_TRY(refuse(r, "phi",
                      "does not go round once, nor a whole part of that, down to a 64th: its last is a step before the "
                      "first again"));
    g->layers = (uint32_t)a.n;
    g->phi = a.at[0];
    g->turn = 2 * M_PI / parts;
done:
    free(a.at);
    return status;
}

static enum kd_status take_places(struct reader *r)
{
    struct kd_matter_grid *g = r->grid;
    struct array radii = { 0 }, angles = { 0 };
    enum kd_status status;
    KD_TRY(take(r, "r", KD_MATTER_SIDE, &radii));
    KD_TRY(check_even(r, "r", &radii, true, 0.1, 1e6));
    KD_TRY(take(r, "theta", KD_MATTER_SIDE, &angles));
    KD_TRY(check_even(r, "theta", &angles, false, 0, M_PI + 1e-6));
    g->rows = (uint32_t)radii.n;
    g->columns = (uint32_t)angles.n;
    g->r[0] = radii.at[0], g->r[1] = radii.at[radii.n - 1];
    g->theta[0] = angles.at[0], g->theta[1] = angles.at[angles.n - 1];
    const double step = (g->theta[1] - g->theta[0]) / (double)(angles.n - 1);
    if (g->theta[0] > 1.001 * step || g->theta[1] < M_PI - 1.001 * step)
        KD_TRY(refuse(r, "theta",
                      "does not go from pole to pole: its first is more than a step from 0, or its last from pi"));
    KD_TRY(take_round(r));
    if ((uint64_t)g->rows * g->columns * g->layers > KD_MATTER_NODES) {
        char what[120];
        snprintf(what, sizeof what, "x theta x phi is %u x %u x %u nodes, allowed are %d in all", g->rows, g->columns,
                 g->layers, KD_MATTER_NODES);
        KD_TRY(refuse(r, "r", what));
    }
    if ((g->rows - 1) / log(g->r[1] / g->r[0]) > FINEST)
        KD_TRY(refuse(r, "r", "has more than 1024 rows where r grows by a factor of e"));
    if (g->columns < 3)
        KD_TRY(refuse(r, "theta", "has fewer than 3 numbers: there must be one off the axis"));
done:
    r->r = radii.at;
    r->theta = angles.at;
    return status;
}

static size_t nodes_of(const struct kd_matter_grid *g) { return (size_t)g->rows * g->columns * g->layers; }

static enum kd_status check_shape(struct reader *r, const char *name, const struct array *a)
{
    const struct kd_matter_grid *g = r->grid;
    const bool flat = a->dimensions == 2 && g->layers == 1, round = a->dimensions == 3 && a->shape[2] == g->layers;
    char what[200];
    if ((flat || round) && a->shape[0] == g->rows && a->shape[1] == g->columns)
        return KD_OK;
    snprintf(what, sizeof what, "has %zu numbers in %zu dimensions, allowed is the shape (%u, %u%s%.0u) of r, theta%s",
             a->n, a->dimensions, g->rows, g->columns, g->layers > 1 ? ", " : "", g->layers > 1 ? g->layers : 0,
             g->layers > 1 ? " and phi" : "");
    return refuse(r, name, what);
}

static enum kd_status refuse_number(struct reader *r, const char *name, size_t i, double value, const char *allowed)
{
    const struct kd_matter_grid *g = r->grid;
    char at[80], what[200];
    const size_t layer = i % g->layers, column = i / g->layers % g->columns, row = i / g->layers / g->columns;
    if (g->layers > 1)
        snprintf(at, sizeof at, "%s[%zu, %zu, %zu]", name, row, column, layer);
    else
        snprintf(at, sizeof at, "%s[%zu, %zu]", name, row, column);
    snprintf(what, sizeof what, "is %.9g, allowed %s", value, allowed);
    return refuse(r, at, what);
}

/* Puts an array into its places of the nodes, as numbers that vary little with r. */
static enum kd_status take_kind(struct reader *r, size_t kind)
{
    struct kd_matter_grid *g = r->grid;
    struct array a = { 0 };
    char allowed[80];
    enum kd_status status;
    KD_TRY(take(r, kinds[kind].name, KD_MATTER_NODES, &a));
    KD_TRY(check_shape(r, kinds[kind].name, &a));
    for (size_t i = 0; i < a.n; i++) {
        const double radius = r->r[i / g->layers / g->columns], value = a.at[i] * (kinds[kind].scale > 0   ? radius
                                                                                   : kinds[kind].scale < 0 ? 1 / radius
                                                                                                           : 1);
        if (!(value >= kinds[kind].least && value <= kinds[kind].most)) {
            snprintf(allowed, sizeof allowed, "are %.4g to %.4g %s%s", kinds[kind].least, kinds[kind].most,
                     kinds[kind].unit,
                     kinds[kind].scale > 0   ? " over r"
                     : kinds[kind].scale < 0 ? " times r"
                                             : "");
            KD_TRY(refuse_number(r, kinds[kind].name, i, a.at[i], allowed));
        }
        g->nodes[KD_MATTER_FLOATS * i + kind] = (float)value;
    }
done:
    free(a.at);
    return status;
}

/* -lapse^2 (u^t)^2 + U^2 = -1 past observers of zero angular momentum (Bardeen, Press & Teukolsky 1972), outside the
 * horizon. */
static enum kd_status check_velocity(struct reader *r)
{
    const struct kd_matter_grid *g = r->grid;
    const double a = g->spin, edge = 1.001 * kd_kerr_horizon(a);
    struct array t = { 0 };
    enum kd_status status = KD_OK;
    if (!has(r, "u_con_t"))
        return KD_OK;
    KD_TRY(take(r, "u_con_t", KD_MATTER_NODES, &t));
    KD_TRY(check_shape(r, "u_con_t", &t));
    for (size_t i = 0; i < t.n; i++) {
        const double radius = r->r[i / g->layers / g->columns], theta = r->theta[i / g->layers % g->columns],
                     s2 = sin(theta) * sin(theta), r2 = radius * radius;
        const double sigma = r2 + a * a * (1 - s2), delta = r2 - 2 * radius + a * a,
                     area = (r2 + a * a) * (r2 + a * a) - a * a * delta * s2;
        const float *n = g->nodes + KD_MATTER_FLOATS * i;
        const double out = n[VELOCITY], down = n[VELOCITY + 1] / radius, round = n[VELOCITY + 2] * radius;
        const double norm = out * out * sigma / delta + down * down * sigma + round * round * sigma / (area * s2) -
                            t.at[i] * t.at[i] * sigma * delta / area;
        if (radius > edge && s2 > AXIS && !(fabs(norm + 1) <= UNIT))
            KD_TRY(refuse_number(
                r, "the velocity's u.u at u_con_t", i, norm,
                "is -1 within a hundredth: it is timelike, of unit length, and in the components that are told"));
    }
done:
    free(t.at);
    return status;
}

/* The temperature of an empty node is none: it is the mean of its neighbours' that are not empty, so that what is
 * next to it has its own up to the edge. */
static float filled(const struct kd_matter_grid *g, const float *nodes, size_t i)
{
    const size_t layers = g->layers, row = i / layers / g->columns, column = i / layers % g->columns,
                 layer = i % layers, stride = layers * g->columns;
    const size_t beside[] = { row ? i - stride : i,
                              row + 1 < g->rows ? i + stride : i,
                              column ? i - layers : i,
                              column + 1 < g->columns ? i + layers : i,
                              i - layer + (layer + layers - 1) % layers,
                              i - layer + (layer + 1) % layers };
    double sum = 0;
    int n = 0;
    for (size_t k = 0; k < 6; k++)
        if (nodes[KD_MATTER_FLOATS * beside[k] + DENSITY] > 0) {
            sum += log2(fmax(nodes[KD_MATTER_FLOATS * beside[k] + TEMPERATURE], 1e-30));
            n++;
        }
    return n ? (float)exp2(sum / n) : nodes[KD_MATTER_FLOATS * i + TEMPERATURE];
}

/* What turns about the axis goes as sin^2 theta there: over that it has on the axis itself what its neighbour has. */
static void over_sine(struct kd_matter_grid *g, const double *theta)
{
    static const int kind[] = { VELOCITY + 2, FIELD + 2 };
    for (int pass = 0; pass < 2; pass++) /* the neighbours first */
        for (size_t i = 0; i < nodes_of(g); i++) {
            const size_t column = i / g->layers % g->columns, beside = column ? i - g->layers : i + g->layers;
            const double s2 = sin(theta[column]) * sin(theta[column]);
            for (int k = 0; k < 2 && (s2 > AXIS) == (pass == 0); k++) {
                float *at = g->nodes + KD_MATTER_FLOATS * i + kind[k];
                *at = pass ? g->nodes[KD_MATTER_FLOATS * beside + kind[k]] : (float)(*at / s2);
            }
        }
}

static void to_logarithms(struct kd_matter_grid *g)
{
    const double theta = KD_K_J_K / (KD_ELECTRON_KG * KD_C_M_S * KD_C_M_S);
    double most = 0, least = INFINITY, field = 0;
    for (size_t i = 0; i < nodes_of(g); i++) {
        const float *n = g->nodes + KD_MATTER_FLOATS * i;
        most = fmax(most, n[DENSITY]);
        least = n[DENSITY] > 0 ? fmin(least, n[DENSITY]) : least;
        for (int k = 0; k < 3; k++)
            field = fmax(field, fabs((double)n[FIELD + k]));
    }
    g->field = field > 0 ? field : 1;
    const double empty = most > 0 ? fmin(log2(most) - EMPTY, log2(least)) : NEVER;
    for (size_t i = 0; i < nodes_of(g); i++)
        if (!(g->nodes[KD_MATTER_FLOATS * i + DENSITY] > 0))
            g->nodes[KD_MATTER_FLOATS * i + TEMPERATURE] = filled(g, g->nodes, i);
    for (size_t i = 0; i < nodes_of(g); i++) {
        float *n = g->nodes + KD_MATTER_FLOATS * i;
        n[DENSITY] = (float)(n[DENSITY] > 0 ? log2((double)n[DENSITY]) : empty);
        n[TEMPERATURE] = (float)(n[TEMPERATURE] > 0 ? fmax(log2(theta * n[TEMPERATURE]), COLD) : COLD);
        for (int k = 0; k < 3; k++)
            n[FIELD + k] = (float)(n[FIELD + k] / g->field);
    }
}

enum kd_status kd_matter_grid_read(const void *data, size_t size, struct kd_matter_grid *out, struct kd_error *error)
{
    struct reader r = { data, size, out, .error = error };
    enum kd_status status;
    *out = (struct kd_matter_grid) { 0 };
    if (!is_whole(data, size))
        KD_TRY(refuse(&r, "the file", "ends before its directory does, or bytes follow that"));
    KD_TRY(take_header(&r));
    KD_TRY(take_places(&r));
    out->nodes = malloc(nodes_of(out) * KD_MATTER_FLOATS * sizeof *out->nodes);
    if (!out->nodes)
        KD_TRY(no_memory(&r));
    for (size_t i = 0; i < KD_MATTER_FLOATS; i++)
        KD_TRY(take_kind(&r, i));
    KD_TRY(check_velocity(&r));
    over_sine(out, r.theta);
    to_logarithms(out);
done:
    if (status)
        kd_matter_grid_finish(out);
    free(r.r);
    free(r.theta);
    return status;
}

enum kd_status kd_matter_grid_look(const void *data, size_t size, uint32_t nodes[3], double *spin,
                                   struct kd_error *error)
{
    struct kd_matter_grid grid;
    enum kd_status status = kd_matter_grid_read(data, size, &grid, error);
    if (status)
        return status;
    nodes[0] = grid.rows;
    nodes[1] = grid.columns;
    nodes[2] = grid.layers;
    *spin = grid.spin;
    kd_matter_grid_finish(&grid);
    return KD_OK;
}

enum kd_status kd_matter_grid_none(double spin, struct kd_matter_grid *out, struct kd_error *error)
{
    *out = (struct kd_matter_grid) {
        .rows = 2, .columns = 2, .layers = 1, .spin = spin, .r = { 0.1, 1e6 }, .theta = { 0, M_PI }, .turn = 2 * M_PI
    };
    out->nodes = calloc(4 * KD_MATTER_FLOATS, sizeof *out->nodes);
    if (!out->nodes)
        return kd_error_set(error, KD_ENOMEM, "out of memory for a grid of matter");
    to_logarithms(out);
    return KD_OK;
}

void kd_matter_grid_finish(struct kd_matter_grid *grid)
{
    free(grid->nodes);
    grid->nodes = NULL;
}
