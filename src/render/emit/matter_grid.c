#include "render/emit/matter_grid.h"

#include "base/clock.h"
#include "image/npy.h"
#include "physics/math/constants.h"
#include "physics/spacetime/kerr.h"
#include "render/emit/matter_array.h"
#include "document/tree.h"

#include <cjson/cJSON.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define NEVER -1e6 /* log2 of zero */
#define COLD -24.0 /* log2 of k T/(m_e c^2) below which no fit is valid: 354 K */
/* An empty node is given a density. Its log2 is lower than that of the densest node by at least this number. The light
 * then falls to nothing within a cell. */
#define EMPTY 40.0
#define EVEN 1e-3 /* tolerance for the even spacing of rows, as a fraction of a step */
/* tolerance for the even spacing of times, as a fraction of a step. The tolerance is larger than EVEN, because
 * simulations write a dump at the first of their steps after the intended time */
#define STEADY 1e-2
#define LATEST 1e12 /* largest time, M; the same limit as that of the scene's time */
#define AXIS 1e-9   /* sin^2(theta) below which azimuth is undefined */
#define UNIT 1e-2   /* largest accepted |u.u + 1| */
/* largest number of rows per factor of e in r; it bounds the work of the march, whose stretches are two cells long */
#define FINEST 1024
#define PARTS 64 /* largest permitted k of a grid that covers 1/k of a turn */
#define PLACES 4 /* number of table cells per column, if the columns are unevenly spaced */
#define PLACES_LEAST 256
#define HEADER_MOST 65536

/* Arrays in the order of their numbers in a node. `scale`: power of r by which an array is multiplied. */
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

struct kd_matter_reader {
    struct kd_unzip zip;
    struct kd_matter_grid grid;
    double *r, *theta;            /* r: radius of each row; theta: angle of each column, or of each node of a layer */
    size_t theta_rows;            /* number of rows that have angles of their own; 1: all rows have the same angles */
    bool look;                    /* true if the numbers are only checked, and not prepared for a renderer */
    struct kd_matter_array array; /* the current array */
    size_t kind, done;            /* kind: index of the current array; done: number of its elements that are done */
};

bool kd_matter_grid_is(const void *data, size_t size) { return size > 4 && !memcmp(data, "PK\3\4", 4); }

static size_t frame_of(const struct kd_matter_grid *g) { return (size_t)g->rows * g->columns * g->layers; }
static size_t nodes_of(const struct kd_matter_grid *g) { return g->frames * frame_of(g); }
static size_t row_of(const struct kd_matter_grid *g, size_t i) { return i / g->layers / g->columns % g->rows; }

static const char *text_of(const cJSON *header, const char *name)
{
    const char *text = cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(header, name));
    return text ? text : "";
}

static enum kd_status check_units(const cJSON *units, bool times, struct kd_error *error)
{
    static const char *const others[][2] = { { "r", "M" }, { "theta", "rad" }, { "time", "M" } };
    char name[60], what[200];
    const size_t n = times ? 3 : 2;
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds + n; i++) {
        const char *of = i < n ? others[i][0] : kinds[i - n].name, *unit = i < n ? others[i][1] : kinds[i - n].unit,
                   *is = text_of(units, of);
        if (!strcmp(is, unit))
            continue;
        snprintf(name, sizeof name, "header.units.%s", of);
        snprintf(what, sizeof what, "%s%.60s%s; it must be \"%s\"", *is ? "is \"" : "is missing", is, *is ? "\"" : "",
                 unit);
        return kd_matter_refuse(name, what, error);
    }
    return KD_OK;
}

/* Reads a parameter of the hole. A missing parameter is 0. */
static enum kd_status take_parameter(struct kd_matter_grid *grid, const cJSON *given, double least, const char *field,
                                     double *out, struct kd_error *error)
{
    char what[120];
    if (!given)
        return KD_OK;
    *out = cJSON_GetNumberValue(given);
    const struct kd_hole hole = kd_hole_in(grid);
    if (*out >= least && (*out == 0 || kd_hole_exists(&hole)))
        return KD_OK;
    snprintf(what, sizeof what, "is not a number from %.9g to below %.9g, as spin %.9g requires", least,
             sqrt((1 - grid->spin) * (1 + grid->spin)), grid->spin);
    return kd_matter_refuse(field, what, error);
}

static enum kd_status take_parameters(struct kd_matter_grid *grid, const cJSON *header, struct kd_error *error)
{
    enum kd_status status = KD_OK;
#define TAKE(x, name, member, least, ...) \
    KD_TRY(take_parameter(grid, cJSON_GetObjectItemCaseSensitive(header, #name), least, "header." #name, &grid->name, \
                          error));
    KD_HOLE_MORE(TAKE, )
#undef TAKE
done:
    return status;
}

static enum kd_status check_header(struct kd_matter_grid *grid, const cJSON *header, bool times, struct kd_error *error)
{
    const cJSON *spin = cJSON_GetObjectItemCaseSensitive(header, "spin"),
                *version = cJSON_GetObjectItemCaseSensitive(header, "version");
    const char *azimuth = text_of(header, "azimuth");
    if (strcmp(text_of(header, "format"), "kerrd-grid") || !cJSON_IsNumber(version) || version->valuedouble != 1)
        return kd_matter_refuse("header", "is not of the format \"kerrd-grid\", version 1", error);
    if (!cJSON_IsNumber(spin) || !(fabs(spin->valuedouble) <= 1))
        return kd_matter_refuse("header.spin", "is not a number from -1 to 1", error);
    grid->spin = spin->valuedouble;
    const enum kd_status status = take_parameters(grid, header, error);
    if (status)
        return status;
    grid->ingoing = !strcmp(azimuth, "kerr-schild");
    if (!grid->ingoing && strcmp(azimuth, "boyer-lindquist"))
        return kd_matter_refuse("header.azimuth", "is neither \"boyer-lindquist\" nor \"kerr-schild\"", error);
    const cJSON *time = cJSON_GetObjectItemCaseSensitive(header, "time");
    grid->late = time ? !strcmp(text_of(header, "time"), "kerr-schild") : grid->ingoing;
    if (time && !grid->late && strcmp(text_of(header, "time"), "boyer-lindquist"))
        return kd_matter_refuse("header.time", "is neither \"boyer-lindquist\" nor \"kerr-schild\"", error);
    const cJSON *packed = cJSON_GetObjectItemCaseSensitive(header, "packed");
    if (packed && !cJSON_IsBool(packed))
        return kd_matter_refuse("header.packed", "is neither true nor false", error);
    grid->packed = cJSON_IsTrue(packed);
    grid->whole = cJSON_IsFalse(packed);
    return check_units(cJSON_GetObjectItemCaseSensitive(header, "units"), times, error);
}

static enum kd_status take_header(struct kd_matter_reader *r, struct kd_error *error)
{
    struct kd_buffer bytes = { 0 }, text = { 0 };
    struct kd_error why = { 0 };
    enum kd_status status = kd_matter_member(&r->zip, "header", HEADER_MOST, &bytes, error);
    if (!status && (status = kd_npy_read_text(bytes.data, bytes.size, &text, &why)))
        status = status == KD_ENOMEM ? kd_matter_no_memory(error) : kd_matter_refuse("header", why.message, error);
    bool starved = false;
    cJSON *header = status ? NULL : kd_tree_read(text.data ? (const char *)text.data : "", text.size, &starved);
    if (starved)
        status = kd_matter_no_memory(error);
    else if (!status)
        status = cJSON_IsObject(header) ? check_header(&r->grid, header, kd_matter_has(&r->zip, "time"), error)
                                        : kd_matter_refuse("header", "is not a JSON object", error);
    cJSON_Delete(header);
    kd_buffer_finish(&bytes);
    kd_buffer_finish(&text);
    return status;
}

/* Checks that coordinates grow in even steps. If `logarithmic` is true, their logarithms must grow in even steps. */
static enum kd_status check_even(const char *name, const struct kd_matter_array *a, bool logarithmic, double least,
                                 double most, struct kd_error *error)
{
    char what[200];
    const double begin = kd_matter_array_at(a, 0), end = kd_matter_array_at(a, a->n - 1);
    const double first = logarithmic ? log(begin) : begin, last = logarithmic ? log(end) : end,
                 step = (last - first) / (double)(a->n - 1);
    if (a->dimensions != 1 || a->n < 2)
        return kd_matter_refuse(name, "is not a list of 2 numbers or more", error);
    for (size_t i = 0; i < a->n; i++) {
        const double value = kd_matter_array_at(a, i), at = logarithmic ? log(value) : value,
                     want = first + step * (double)i;
        if (value >= least && value <= most && fabs(at - want) <= EVEN * step)
            continue;
        snprintf(what, sizeof what, "%zu is %.9g; it must be a number from %.4g to %.4g in equal steps%s, here %.9g", i,
                 value, least, most, logarithmic ? " of their logarithm" : "", logarithmic ? exp(want) : want);
        return kd_matter_refuse(name, what, error);
    }
    return step > 0 ? KD_OK : kd_matter_refuse(name, "is not in ascending order", error);
}

static enum kd_status take_round(struct kd_matter_reader *r, struct kd_error *error)
{
    struct kd_matter_grid *g = &r->grid;
    struct kd_matter_array a = { 0 };
    enum kd_status status;
    g->layers = 1;
    g->turn = 2 * M_PI;
    if (!kd_matter_has(&r->zip, "phi"))
        return KD_OK;
    KD_TRY(kd_matter_array_take(&r->zip, "phi", KD_MATTER_SIDE, &a, error));
    KD_TRY(check_even("phi", &a, false, -4 * M_PI, 4 * M_PI, error));
    const double begin = kd_matter_array_at(&a, 0), end = kd_matter_array_at(&a, a.n - 1);
    const double turn = (end - begin) / (double)(a.n - 1) * (double)a.n, parts = rint(2 * M_PI / turn);
    if (!(parts >= 1 && parts <= PARTS && fabs(turn * parts / (2 * M_PI) - 1) < EVEN))
        KD_TRY(kd_matter_refuse("phi",
                                "must cover a full turn, or 1/n of it with n up to 64; its last node must be one step "
                                "before the first repeats",
                                error));
    g->layers = (uint32_t)a.n;
    g->phi = begin;
    g->turn = 2 * M_PI / parts;
done:
    kd_matter_array_finish(&a);
    return status;
}

/* Reads the times of a series. */
static enum kd_status take_times(struct kd_matter_reader *r, struct kd_error *error)
{
    struct kd_matter_grid *g = &r->grid;
    struct kd_matter_array a = { 0 };
    enum kd_status status;
    char name[40], what[160];
    g->frames = 1;
    if (!kd_matter_has(&r->zip, "time"))
        return KD_OK;
    KD_TRY(kd_matter_array_take(&r->zip, "time", KD_MATTER_FRAMES, &a, error));
    if (a.dimensions != 1 || a.n < 2)
        KD_TRY(
            kd_matter_refuse("time", "is not a list of 2 to 1024 numbers; a grid of one moment has no times", error));
    const double begin = kd_matter_array_at(&a, 0),
                 step = (kd_matter_array_at(&a, a.n - 1) - begin) / (double)(a.n - 1);
    for (size_t i = 0; i < a.n; i++) {
        const double at = kd_matter_array_at(&a, i), want = begin + step * (double)i;
        snprintf(name, sizeof name, "time[%zu]", i);
        if (!(fabs(at) <= LATEST))
            snprintf(what, sizeof what, "is %.9g; it must be a number from -1e12 to 1e12", at);
        else if (i && !(at > kd_matter_array_at(&a, i - 1)))
            snprintf(what, sizeof what, "is %.9g; it must be greater than the one before it, %.9g", at,
                     kd_matter_array_at(&a, i - 1));
        else if (step > 0 && fabs(at - want) > STEADY * step)
            snprintf(what, sizeof what, "is %.9g; with equal steps it must be %.9g, to a hundredth of a step", at,
                     want);
        else
            continue;
        KD_TRY(kd_matter_refuse(name, what, error));
    }
    g->frames = (uint32_t)a.n;
    g->time[0] = begin;
    g->time[1] = kd_matter_array_at(&a, a.n - 1);
done:
    kd_matter_array_finish(&a);
    return status;
}

static enum kd_status copy(const struct kd_matter_array *a, double **out, struct kd_error *error)
{
    *out = malloc(a->n * sizeof **out);
    for (size_t i = 0; *out && i < a->n; i++)
        (*out)[i] = kd_matter_array_at(a, i);
    return *out ? KD_OK : kd_matter_no_memory(error);
}

static enum kd_status take_radii(struct kd_matter_reader *r, struct kd_error *error)
{
    struct kd_matter_array a = { 0 };
    enum kd_status status;
    KD_TRY(kd_matter_array_take(&r->zip, "r", KD_MATTER_SIDE, &a, error));
    KD_TRY(check_even("r", &a, true, 0.1, 1e6, error));
    KD_TRY(copy(&a, &r->r, error));
    r->grid.rows = (uint32_t)a.n;
    r->grid.r[0] = r->r[0];
    r->grid.r[1] = r->r[a.n - 1];
done:
    kd_matter_array_finish(&a);
    return status;
}

static bool is_even(const double *at, size_t n)
{
    const double step = (at[n - 1] - at[0]) / (double)(n - 1);
    for (size_t i = 0; i < n; i++)
        if (!(fabs(at[i] - (at[0] + step * (double)i)) <= EVEN * step))
            return false;
    return true;
}

/* Checks that the angles of a row ascend from pole to pole. */
static enum kd_status check_angles(const double *at, size_t n, size_t row, bool alone, struct kd_error *error)
{
    char name[60], what[120];
    for (size_t i = 0; i < n; i++) {
        if (at[i] >= 0 && at[i] <= M_PI + 1e-6 && (!i || at[i] > at[i - 1]))
            continue;
        if (alone)
            snprintf(name, sizeof name, "theta[%zu]", i);
        else
            snprintf(name, sizeof name, "theta[%zu, %zu]", row, i);
        snprintf(what, sizeof what, "is %.9g; it must be a number from 0 to pi, and greater than the one before it",
                 at[i]);
        return kd_matter_refuse(name, what, error);
    }
    if (at[0] > 1.001 * (at[1] - at[0]) || at[n - 1] < M_PI - 1.001 * (at[n - 1] - at[n - 2]))
        return kd_matter_refuse(
            "theta",
            "must go from pole to pole; its first is more than a step from 0, or its last more than a step from pi",
            error);
    return KD_OK;
}

static enum kd_status take_angles(struct kd_matter_reader *r, struct kd_error *error)
{
    struct kd_matter_grid *g = &r->grid;
    struct kd_matter_array a = { 0 };
    enum kd_status status;
    char what[120];
    KD_TRY(kd_matter_array_take(&r->zip, "theta", KD_MATTER_ANGLES, &a, error));
    r->theta_rows = a.dimensions == 2 ? g->rows : 1;
    g->columns = (uint32_t)(a.n / r->theta_rows);
    if (a.dimensions > 2 || g->columns > KD_MATTER_SIDE || (a.dimensions == 2 && a.shape[0] != g->rows)) {
        snprintf(what, sizeof what,
                 "has %zu numbers in %zu dimensions; it must have a number for each column, or %u rows"
                 " of them, and at most %d columns",
                 a.n, a.dimensions, g->rows, KD_MATTER_SIDE);
        KD_TRY(kd_matter_refuse("theta", what, error));
    }
    if (g->columns < 3)
        KD_TRY(kd_matter_refuse("theta", "must have at least 3 columns, so that one is off the axis", error));
    KD_TRY(copy(&a, &r->theta, error));
    for (size_t row = 0; row < r->theta_rows; row++) {
        const double *at = r->theta + row * g->columns;
        KD_TRY(check_angles(at, g->columns, row, r->theta_rows == 1, error));
        /* the column beside a column on the axis must lie off the axis (over_sine) */
        if (sin(at[1]) * sin(at[1]) <= AXIS || sin(at[g->columns - 2]) * sin(at[g->columns - 2]) <= AXIS)
            KD_TRY(kd_matter_refuse(
                "theta", "must have its second and its last but one angle at least 3.2e-5 from the axis", error));
    }
    g->theta[0] = r->theta[0];
    g->theta[1] = r->theta[g->columns - 1];
done:
    kd_matter_array_finish(&a);
    return status;
}

static double theta_at(const struct kd_matter_reader *r, size_t row, size_t column)
{
    return r->theta[(r->theta_rows > 1 ? row * r->grid.columns : 0) + column];
}

/* Computes the column number, with its fraction, at each boundary between cells of a table. It interpolates linearly
 * between the angles of the columns. */
static void columns_at(const double *theta, size_t columns, uint32_t steps, float *out, size_t stride)
{
    size_t below = 0;
    for (uint32_t i = 0; i <= steps; i++) {
        const double at = i * M_PI / steps;
        while (below + 2 < columns && theta[below + 1] <= at)
            below++;
        const double column = (double)below + (at - theta[below]) / (theta[below + 1] - theta[below]);
        const float bounded = (float)fmin(fmax(column, 0), (double)(columns - 1));
        if (i < steps)
            out[stride * i] = bounded;
        if (i > 0)
            out[stride * (i - 1) + 1] = bounded;
    }
}

static enum kd_status make_places(struct kd_matter_reader *r, struct kd_error *error)
{
    struct kd_matter_grid *g = &r->grid;
    if (r->look || (r->theta_rows == 1 && is_even(r->theta, g->columns)))
        return KD_OK;
    g->place_rows = r->theta_rows > 1 ? g->rows - 1 : 1;
    g->steps = PLACES * g->columns < PLACES_LEAST ? PLACES_LEAST : PLACES * g->columns;
    if (g->steps > KD_MATTER_PLACES / g->place_rows)
        g->steps = KD_MATTER_PLACES / g->place_rows;
    g->places = malloc(kd_matter_grid_places(g) * sizeof *g->places);
    if (!g->places)
        return kd_matter_no_memory(error);
    for (size_t row = 0; row < g->place_rows; row++)
        for (size_t next = 0; next < 2; next++)
            columns_at(r->theta + (r->theta_rows > 1 ? (row + next) * g->columns : 0), g->columns, g->steps,
                       g->places + 4 * row * g->steps + 2 * next, 4);
    return KD_OK;
}

static enum kd_status take_places(struct kd_matter_reader *r, struct kd_error *error)
{
    struct kd_matter_grid *g = &r->grid;
    enum kd_status status;
    KD_TRY(take_radii(r, error));
    KD_TRY(take_angles(r, error));
    KD_TRY(take_round(r, error));
    KD_TRY(take_times(r, error));
    if (frame_of(g) > KD_MATTER_NODES || nodes_of(g) > KD_MATTER_NODES) {
        char what[160], times[40] = "";
        if (g->frames > 1)
            snprintf(times, sizeof times, " in %u frames", g->frames);
        snprintf(what, sizeof what, "x theta x phi is %u x %u x %u nodes%s: it must be at most %d in all", g->rows,
                 g->columns, g->layers, times, KD_MATTER_NODES);
        KD_TRY(kd_matter_refuse("r", what, error));
    }
    if (g->whole && nodes_of(g) > KD_MATTER_WHOLE)
        KD_TRY(
            kd_matter_refuse("header.packed", "is false; it must be true in a grid of more than 2097152 nodes", error));
    g->packed |= nodes_of(g) > KD_MATTER_WHOLE;
    if ((g->rows - 1) / log(g->r[1] / g->r[0]) > FINEST)
        KD_TRY(kd_matter_refuse("r", "must have at most 1024 rows per factor e in r", error));
    KD_TRY(make_places(r, error));
done:
    return status;
}

static enum kd_status check_shape(const struct kd_matter_grid *g, const char *name, const struct kd_matter_array *a,
                                  struct kd_error *error)
{
    const size_t lead = g->frames > 1; /* 1 if arrays have a leading axis of frames */
    const bool flat = a->dimensions == 2 + lead && g->layers == 1,
               round = a->dimensions == 3 + lead && a->shape[2 + lead] == g->layers;
    char what[200], frames[20] = "", layers[20] = "";
    if ((flat || round) && a->shape[lead] == g->rows && a->shape[1 + lead] == g->columns &&
        (!lead || a->shape[0] == g->frames))
        return KD_OK;
    if (lead)
        snprintf(frames, sizeof frames, "%u, ", g->frames);
    if (g->layers > 1)
        snprintf(layers, sizeof layers, ", %u", g->layers);
    snprintf(what, sizeof what,
             "has %zu numbers in %zu dimensions; it must have the shape (%s%u, %u%s) of %sr, theta%s", a->n,
             a->dimensions, frames, g->rows, g->columns, layers, lead ? "time, " : "", g->layers > 1 ? " and phi" : "");
    return kd_matter_refuse(name, what, error);
}

static enum kd_status refuse_number(const struct kd_matter_grid *g, const char *name, size_t i, double value,
                                    const char *allowed, struct kd_error *error)
{
    char at[120], what[200], frame[30] = "";
    const size_t layer = i % g->layers, column = i / g->layers % g->columns, row = row_of(g, i);
    if (g->frames > 1)
        snprintf(frame, sizeof frame, "%zu, ", i / frame_of(g));
    if (g->layers > 1)
        snprintf(at, sizeof at, "%s[%s%zu, %zu, %zu]", name, frame, row, column, layer);
    else
        snprintf(at, sizeof at, "%s[%s%zu, %zu]", name, frame, row, column);
    snprintf(what, sizeof what, "is %.9g; it must be %s", value, allowed);
    return kd_matter_refuse(at, what, error);
}

/* Stores a number of a node at its place, scaled so that it varies little with r. */
static enum kd_status take_number(struct kd_matter_reader *r, size_t i, struct kd_error *error)
{
    struct kd_matter_grid *g = &r->grid;
    const size_t kind = r->kind;
    const int scale = kinds[kind].scale;
    const double radius = r->r[row_of(g, i)], read = kd_matter_array_at(&r->array, i);
    const double value = read * (scale > 0 ? radius : scale < 0 ? 1 / radius : 1);
    char allowed[80];
    if (value >= kinds[kind].least && value <= kinds[kind].most) {
        g->nodes[KD_MATTER_FLOATS * i + kind] = (float)value;
        return KD_OK;
    }
    snprintf(allowed, sizeof allowed, "%.4g to %.4g %s%s", kinds[kind].least, kinds[kind].most, kinds[kind].unit,
             scale > 0   ? " over r"
             : scale < 0 ? " times r"
                         : "");
    return refuse_number(g, kinds[kind].name, i, read, allowed, error);
}

/* Checks that -lapse^2 (u^t)^2 + U^2 = -1 at nodes outside the horizon. U is the spatial part for observers of zero
 * angular momentum (Bardeen, Press & Teukolsky 1972). */
static enum kd_status check_velocity(struct kd_matter_reader *r, size_t i, struct kd_error *error)
{
    const struct kd_matter_grid *g = &r->grid;
    const struct kd_hole hole = kd_hole_in(g);
    const double edge = 1.001 * hole.outer, t = kd_matter_array_at(&r->array, i);
    const size_t row = row_of(g, i);
    const double radius = r->r[row], theta = theta_at(r, row, i / g->layers % g->columns), s2 = sin(theta) * sin(theta);
    const struct kd_metric_scalars m = kd_metric_at(&hole, radius, cos(theta));
    const float *n = g->nodes + KD_MATTER_FLOATS * i;
    const double out = n[VELOCITY], down = n[VELOCITY + 1] / radius, round = n[VELOCITY + 2] * radius;
    const double norm = out * out * m.sigma / m.delta + down * down * m.sigma +
                        round * round * m.sigma / (m.area * s2) - t * t * m.lapse2;
    if (!(radius > edge && s2 > AXIS) || fabs(norm + 1) <= UNIT)
        return KD_OK;
    return refuse_number(g, "the velocity's u.u at u_con_t", i, norm,
                         "-1 within a hundredth, as for a four-velocity in the coordinates that the grid names", error);
}

/* Gets a temperature for an empty node, which has none of its own: the mean over its non-empty neighbours.
 * Interpolation then leaves the temperature of matter at an edge unchanged. */
static float filled(const struct kd_matter_grid *g, const float *nodes, size_t i)
{
    const size_t layers = g->layers, row = row_of(g, i), column = i / layers % g->columns, layer = i % layers,
                 stride = layers * g->columns;
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

/* Divides stored azimuthal components by sin^2 theta, because near the axis they fall as sin^2 theta. Nodes on the
 * axis get the quotient of the node beside them. */
static void over_sine(struct kd_matter_reader *r)
{
    static const int kind[] = { VELOCITY + 2, FIELD + 2 };
    struct kd_matter_grid *g = &r->grid;
    for (int pass = 0; pass < 2; pass++) /* first the nodes off the axis, then those on it */
        for (size_t i = 0; i < nodes_of(g); i++) {
            const size_t column = i / g->layers % g->columns, beside = column ? i - g->layers : i + g->layers;
            const double theta = theta_at(r, row_of(g, i), column), s2 = sin(theta) * sin(theta);
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

/* Returns the half nearest to x, for numbers within the range of halves. Infinity becomes the largest half. */
static uint32_t half_of(float x)
{
    uint32_t bits, sign;
    memcpy(&bits, &x, 4);
    sign = bits >> 16 & 0x8000;
    bits &= 0x7fffffff;
    if (bits >= 0x477ff000)
        return sign | 0x7bff;
    if (bits < 0x38800000) { /* adding 1/2 rounds to a multiple of 2^-24 */
        x = fabsf(x) + 0.5f;
        memcpy(&bits, &x, 4);
        return sign | (bits - 0x3f000000);
    }
    return sign | (bits - 0x38000000 + 0xfff + (bits >> 13 & 1)) >> 13;
}

static uint32_t part_of(double x, double least, double range)
{
    return range > 0 ? (uint32_t)lrint(65535 * fmin(fmax((x - least) / range, 0), 1)) : 0;
}

static void measure(struct kd_matter_grid *g)
{
    double most[2] = { -INFINITY, -INFINITY }, fastest = 0;
    g->least[0] = g->least[1] = INFINITY;
    for (size_t i = 0; i < nodes_of(g); i++) {
        const float *n = g->nodes + KD_MATTER_FLOATS * i;
        for (int k = 0; k < 2; k++) {
            g->least[k] = fmin(g->least[k], n[k]);
            most[k] = fmax(most[k], n[k]);
        }
        for (int k = 0; k < 3; k++)
            fastest = fmax(fastest, fabs((double)n[VELOCITY + k]));
    }
    for (int k = 0; k < 2; k++)
        g->range[k] = most[k] - g->least[k];
    g->speed = fastest > 1024 ? fastest / 1024 : 1;
}

/* Packs the nodes in place. */
static void pack(struct kd_matter_grid *g)
{
    uint32_t words[KD_MATTER_FLOATS / 2];
    measure(g);
    for (size_t i = 0; i < nodes_of(g); i++) {
        const float *n = g->nodes + KD_MATTER_FLOATS * i;
        words[0] = part_of(n[DENSITY], g->least[0], g->range[0]) | part_of(n[TEMPERATURE], g->least[1], g->range[1])
                                                                       << 16;
        for (int k = 0; k < 6; k += 2) {
            uint32_t halves[2];
            for (int m = 0; m < 2; m++)
                halves[m] = half_of(
                    (float)(k + m < 3 ? n[VELOCITY + k + m] / g->speed : n[VELOCITY + k + m] * KD_MATTER_FIELD));
            words[1 + k / 2] = halves[0] | halves[1] << 16;
        }
        memcpy(g->nodes + (KD_MATTER_FLOATS / 2) * i, words, sizeof words);
    }
    float *less = realloc(g->nodes, kd_matter_grid_bytes(g));
    g->nodes = less ? less : g->nodes;
}

size_t kd_matter_grid_bytes(const struct kd_matter_grid *g)
{
    return nodes_of(g) * KD_MATTER_FLOATS * sizeof *g->nodes / (g->packed ? 2 : 1);
}

enum kd_status kd_matter_reader_open(const void *data, size_t size, bool look, struct kd_matter_reader **out,
                                     struct kd_error *error)
{
    struct kd_matter_reader *r = calloc(1, sizeof *r);
    struct kd_error why = { 0 };
    enum kd_status status;
    *out = NULL;
    if (!r)
        return kd_matter_no_memory(error);
    r->look = look;
    if ((status = kd_unzip_open(data, size, &r->zip, &why)))
        KD_TRY(status == KD_EINVAL
                   ? kd_error_set(error, KD_EINVAL, "the file is not a grid of matter (an NPZ file of arrays): %s",
                                  why.message)
                   : kd_matter_no_memory(error));
    KD_TRY(take_header(r, error));
    KD_TRY(take_places(r, error));
done:
    if (status)
        kd_matter_reader_close(r);
    else
        *out = r;
    return status;
}

size_t kd_matter_reader_bytes(const struct kd_matter_reader *r)
{
    return nodes_of(&r->grid) * (KD_MATTER_FLOATS * sizeof *r->grid.nodes + sizeof(double)) +
           r->theta_rows * r->grid.columns * sizeof *r->theta;
}

const struct kd_matter_grid *kd_matter_reader_grid(const struct kd_matter_reader *r) { return &r->grid; }

/* Unpacks the next array. Returns false if the next array is the last one, u_con_t, and the file does not have it. */
static bool begin_array(struct kd_matter_reader *r, enum kd_status *status, struct kd_error *error)
{
    const char *name = r->kind < KD_MATTER_FLOATS ? kinds[r->kind].name : "u_con_t";
    if (r->kind == KD_MATTER_FLOATS && !kd_matter_has(&r->zip, name))
        return false;
    *status = kd_matter_array_take(&r->zip, name, nodes_of(&r->grid), &r->array, error);
    if (!*status)
        *status = check_shape(&r->grid, name, &r->array, error);
    r->done = 0;
    return true;
}

/* Continues with the current array, a stretch at a time. */
static enum kd_status take_numbers(struct kd_matter_reader *r, double until_ms, struct kd_error *error)
{
    enum { STRETCH = 16384 }; /* about 0.3 ms */
    enum kd_status status = KD_OK;
    do
        for (size_t n = 0; n < STRETCH && r->done < r->array.n; n++, r->done++)
            KD_TRY((r->kind < KD_MATTER_FLOATS ? take_number : check_velocity)(r, r->done, error));
    while (r->done < r->array.n && kd_clock_ms() < until_ms);
done:
    return status;
}

enum kd_status kd_matter_reader_go_on(struct kd_matter_reader *r, double until_ms, bool *over, struct kd_error *error)
{
    enum kd_status status = KD_OK;
    *over = false;
    if (!r->grid.nodes && !(r->grid.nodes = malloc(nodes_of(&r->grid) * KD_MATTER_FLOATS * sizeof *r->grid.nodes)))
        return kd_matter_no_memory(error);
    for (bool more = true; more && r->kind <= KD_MATTER_FLOATS; more = kd_clock_ms() < until_ms) {
        if (!r->array.n && !begin_array(r, &status, error)) {
            r->kind++;
            break;
        }
        KD_TRY(status);
        KD_TRY(take_numbers(r, until_ms, error));
        if (r->done == r->array.n) {
            kd_matter_array_finish(&r->array);
            r->kind++;
        }
    }
    *over = r->kind > KD_MATTER_FLOATS;
    if (*over && !r->look) {
        over_sine(r);
        to_logarithms(&r->grid);
        if (r->grid.packed)
            pack(&r->grid);
    }
done:
    return status;
}

void kd_matter_reader_close(struct kd_matter_reader *r)
{
    if (!r)
        return;
    kd_matter_array_finish(&r->array);
    kd_matter_grid_finish(&r->grid);
    kd_unzip_finish(&r->zip);
    free(r->r);
    free(r->theta);
    free(r);
}

static enum kd_status read_all(const void *data, size_t size, bool look, struct kd_matter_reader **out,
                               struct kd_error *error)
{
    bool over = false;
    enum kd_status status = kd_matter_reader_open(data, size, look, out, error);
    while (!status && !over)
        status = kd_matter_reader_go_on(*out, INFINITY, &over, error);
    return status;
}

enum kd_status kd_matter_grid_read(const void *data, size_t size, struct kd_matter_grid *out, struct kd_error *error)
{
    struct kd_matter_reader *r;
    enum kd_status status = read_all(data, size, false, &r, error);
    *out = (struct kd_matter_grid) { 0 };
    if (!status) {
        *out = r->grid;
        r->grid.nodes = r->grid.places = NULL;
    }
    kd_matter_reader_close(r);
    return status;
}

enum kd_status kd_matter_grid_look(const void *data, size_t size, struct kd_asset_grid *out, struct kd_error *error)
{
    struct kd_matter_reader *r;
    enum kd_status status = read_all(data, size, true, &r, error);
    if (!status)
        *out = kd_matter_grid_told(&r->grid);
    kd_matter_reader_close(r);
    return status;
}

size_t kd_matter_grid_places(const struct kd_matter_grid *grid) { return (size_t)4 * grid->place_rows * grid->steps; }

struct kd_asset_grid kd_matter_grid_told(const struct kd_matter_grid *grid)
{
    return (struct kd_asset_grid) { .nodes = { grid->rows, grid->columns, grid->layers },
                                    .frames = grid->frames,
                                    .late = grid->late,
                                    .time = { grid->time[0], grid->time[1] },
                                    .outer = grid->r[1],
                                    KD_HOLE_FROM(grid) };
}

enum kd_status kd_matter_grid_none(const struct kd_hole *hole, struct kd_matter_grid *out, struct kd_error *error)
{
    const struct kd_hole_given told = kd_hole_told(hole);
    *out = (struct kd_matter_grid) { .rows = 2,
                                     .columns = 2,
                                     .layers = 1,
                                     .frames = 1,
                                     KD_HOLE_FROM(&told),
                                     .r = { 0.1, 1e6 },
                                     .theta = { 0, M_PI },
                                     .turn = 2 * M_PI };
    out->nodes = calloc(4 * KD_MATTER_FLOATS, sizeof *out->nodes);
    if (!out->nodes)
        return kd_error_set(error, KD_ENOMEM, "out of memory for a grid of matter");
    to_logarithms(out);
    return KD_OK;
}

void kd_matter_grid_finish(struct kd_matter_grid *grid)
{
    free(grid->nodes);
    free(grid->places);
    grid->nodes = grid->places = NULL;
}
