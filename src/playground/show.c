#include "playground/show.h"

#include "base/pause.h"
#include "playground/hole.h"
#include "playground/json.h"
#include "scene/sha256.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define LIMB 0.6    /* the default of bodies.limb_darkening */
#define PER_CELL 6. /* least number of pieces, on average, in an occupied cell */

/* Factor that converts a Newtonian velocity to the velocity relative to the observer of zero angular momentum (show.h).
 */
static double slower(const double v[3], bool approximate)
{
    const double v2 = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
    return approximate ? 1 / sqrt(1 + v2) : 1;
}

static void show_body(const struct kd_playground_body *body, uint32_t which, bool approximate, double albedo,
                      struct kd_seen_body *out)
{
    const struct kd_playground_spherical at = kd_playground_spherical(body->x, body->v);
    const double slow = slower(at.v, approximate);
    *out = (struct kd_seen_body) {
        .r = at.r,
        .u = cos(at.theta),
        .s = sin(at.theta),
        .phi = at.phi,
        .velocity = { slow * at.v[0], slow * at.v[1], slow * at.v[2] },
        .radius = body->radius,
        .which = which,
        .temperature_k = body->temperature_k,
        .brightness = 1,
        .limb_darkening = LIMB,
        .albedo = albedo,
    };
}

void kd_show_places(const struct kd_debris_piece *pieces, size_t n, struct kd_show_place *out)
{
    const float cells = (float)(KD_SHOW_TURN_MOST / (2 * M_PI)), turn = KD_SHOW_TURN_MOST;
    for (size_t i = 0; i < n; i++) {
        kd_pause_every(i, 4096);
        const float x = (float)pieces[i].x[0], y = (float)pieces[i].x[1], z = (float)pieces[i].x[2],
                    r2 = x * x + y * y + z * z, across2 = x * x + y * y;
        float column = cells * atan2f(y, x);
        column += column < 0 ? turn : 0;
        const bool somewhere = pieces[i].stage != KD_DEBRIS_FREE && across2 > 0 && r2 > 1 &&
                               /* false for a piece inside the hole, or beyond the rows of the coarsest grid */
                               r2 < 1e30f;
        out[i] = somewhere ? (struct kd_show_place) { 0.5f * cells * logf(r2), column < turn ? column : 0 }
                           : (struct kd_show_place) { NAN, NAN };
    }
}

/* Occupied cells of the coarsest grid. They are described by their number, and by the columns and rows that have such
 * cells. */
struct taken {
    size_t cells, pieces;
    int32_t rows[2];
    bool column[KD_SHOW_TURN_LEAST];
};

enum {
    COARSER = KD_SHOW_TURN_MOST / KD_SHOW_TURN_LEAST,
    LOW = -1024,
    HIGH = 3072
}; /* these rows cover every valid r */

static bool take(const struct kd_show_place *places, size_t n, struct taken *out)
{
    uint8_t *seen = calloc((size_t)(HIGH - LOW) * KD_SHOW_TURN_LEAST / 8, 1);
    *out = (struct taken) { .rows = { INT32_MAX, INT32_MIN } };
    for (size_t i = 0; seen && i < n; i++) {
        kd_pause_every(i, 4096);
        if (isnan(places[i].row))
            continue;
        const int32_t row = (int32_t)floorf(places[i].row / COARSER), column = (int32_t)(places[i].column / COARSER);
        const size_t cell = (size_t)(row - LOW) * KD_SHOW_TURN_LEAST + (size_t)column;
        out->cells += !(seen[cell / 8] >> cell % 8 & 1);
        seen[cell / 8] |= (uint8_t)(1 << cell % 8);
        out->pieces++;
        out->column[column] = true;
        out->rows[0] = row < out->rows[0] ? row : out->rows[0];
        out->rows[1] = row > out->rows[1] ? row : out->rows[1];
    }
    free(seen);
    return seen;
}

/* Finds the range of columns outside the widest empty gap: its first column and number of columns. */
static void beside_gap(const bool column[KD_SHOW_TURN_LEAST], uint32_t *first, uint32_t *count)
{
    uint32_t widest = 0, run = 0;
    *first = 0;
    for (uint32_t i = 0; i < 2 * KD_SHOW_TURN_LEAST; i++) {
        run = column[i % KD_SHOW_TURN_LEAST] ? 0 : run + 1;
        if (run > widest && run < KD_SHOW_TURN_LEAST) {
            widest = run;
            *first = (i + 1) % KD_SHOW_TURN_LEAST;
        }
    }
    if (widest < 2) /* a gap as narrow as this is ignored */
        *first = widest = 0;
    *count = KD_SHOW_TURN_LEAST - widest;
}

/* Chooses the smallest cells that leave enough pieces in each occupied cell. The number of occupied cells is
 * estimated from the coarsest grid. A stream of debris is narrower than the cells of that grid, so the stream
 * occupies a smaller fraction of smaller cells. A grid that does not go all round has one more column of nodes at
 * its end. */
void kd_show_grid(const struct kd_show_place *places, size_t n, struct kd_dynamic_bodies_debris *out)
{
    struct taken taken;
    uint32_t first, columns, finer = 1;
    *out = (struct kd_dynamic_bodies_debris) { 0 };
    if (!take(places, n, &taken) || !taken.pieces)
        return;
    beside_gap(taken.column, &first, &columns);
    const double rows = fmin(taken.rows[1] - taken.rows[0] + 1, KD_SHOW_NODES / (columns + 1) - 1),
                 mean = (double)taken.pieces / (double)taken.cells;
    const bool round_ = columns == KD_SHOW_TURN_LEAST;
    while (finer < COARSER && mean >= PER_CELL * 4 * finer * finer &&
           (2 * finer * rows + 1) * (2 * finer * columns + 1) <= KD_SHOW_NODES)
        finer *= 2;
    *out = (struct kd_dynamic_bodies_debris) {
        .turn = finer * KD_SHOW_TURN_LEAST,
        .rows = finer * (uint32_t)rows + 1,
        .columns = finer * columns + !round_,
        .first_row = (int32_t)finer * taken.rows[0],
        .first_column = finer * first,
    };
}

/* Adds a piece's weight and momentum to two nodes of one row. */
static void add(float *left, float *right, float share, float worth, float vr, float vphi)
{
    float *const to[2] = { left, right }, shares[2] = { worth * (1 - share), worth * share };
    for (int k = 0; k < 2; k++) {
        to[k][0] += shares[k];
        to[k][1] += shares[k] * vr;
        to[k][2] += shares[k] * vphi;
    }
}

/* Velocity of a piece along e_r and e_phi, relative to the observer of zero angular momentum. */
static void seen_velocity(const struct kd_debris_piece *p, bool approximate, float out[2])
{
    const float x[3] = { (float)p->x[0], (float)p->x[1], (float)p->x[2] },
                v[3] = { (float)p->v[0], (float)p->v[1], (float)p->v[2] };
    const float across = hypotf(x[0], x[1]), r = hypotf(across, x[2]), v2 = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
    const float slow = approximate ? 1 / sqrtf(1 + v2) : 1;
    out[0] = slow * (x[0] * v[0] + x[1] * v[1] + x[2] * v[2]) / r;
    out[1] = slow * (x[0] * v[1] - x[1] * v[0]) / across;
}

void kd_show_share_out(const struct kd_debris_piece *pieces, const struct kd_show_place *places, size_t n,
                       const float worth[KD_DEBRIS_SOURCES], bool approximate, struct kd_dynamic_bodies_debris *to)
{
    const float scale = (float)to->turn / KD_SHOW_TURN_MOST, turn = (float)to->turn;
    const size_t width = KD_CROWD_NODE * (size_t)to->columns;
    double thick = 0;
    for (size_t i = 0; i < n; i++) {
        kd_pause_every(i, 4096);
        const float row = scale * places[i].row - (float)to->first_row;
        if (isnan(row) || row > (float)(to->rows - 1)) {
            to->hidden += pieces[i].stage != KD_DEBRIS_FREE;
            continue;
        }
        const float from = scale * places[i].column - (float)to->first_column;
        const float column = from < 0 ? from + turn : from, own = worth[pieces[i].source];
        const uint32_t k = (uint32_t)fminf(fmaxf(row, 0), (float)(to->rows - 2)),
                       j = (uint32_t)fminf(column, (float)(to->columns - (to->columns == to->turn ? 1 : 2)));
        const float upper = row - (float)k, right = column - (float)j;
        float *node = to->nodes + k * width + KD_CROWD_NODE * (size_t)j,
              *next = j + 1 < to->columns ? node + KD_CROWD_NODE : to->nodes + k * width, v[2];
        seen_velocity(&pieces[i], approximate, v);
        add(node, next, right, own * (1 - upper), v[0], v[1]);
        add(node + width, next + width, right, own * upper, v[0], v[1]);
        thick += fabs(pieces[i].x[2]) / kd_playground_radius(pieces[i].x);
        to->pieces++;
    }
    to->thick = to->pieces ? thick / to->pieces : 0;
}

enum kd_status kd_playground_show(const struct kd_playground *p, struct kd_dynamic_bodies **out, struct kd_error *error)
{
    const bool approximate = p->params.gravity == KD_GRAVITY_PACZYNSKI_WIITA;
    const size_t n = p->debris.used;
    float worth[KD_DEBRIS_SOURCES];
    struct kd_show_place *places = malloc((n + 1) * sizeof *places);
    struct kd_dynamic_bodies_debris grid = { 0 };
    struct kd_dynamic_bodies *dynamic = NULL;
    enum kd_status status =
        places ? KD_OK : kd_error_set(error, KD_ENOMEM, "out of memory for the picture of a playground");
    KD_TRY(status);
    kd_show_places(p->debris.pieces, n, places);
    if (p->debris.alive)
        kd_show_grid(places, n, &grid);
    KD_TRY(kd_dynamic_bodies_create(p->n, grid.rows, grid.columns, &dynamic, error));
    for (size_t i = 0; i < p->n; i++)
        show_body(&p->bodies[i], (uint32_t)i, approximate, p->params.albedo, &dynamic->bodies[i]);
    grid.nodes = dynamic->debris.nodes;
    grid.temperature_k = p->params.debris_temperature_k;
    grid.depth = p->params.debris_depth;
    dynamic->debris = grid;
    dynamic->time = p->t;
    dynamic->approximate = approximate;
    for (int i = 0; i < KD_DEBRIS_SOURCES; i++)
        worth[i] = (float)p->debris.sources[i].worth;
    if (grid.rows)
        kd_show_share_out(p->debris.pieces, places, n, worth, approximate, &dynamic->debris);
    *out = dynamic;
done:
    free(places);
    return status;
}

enum kd_status kd_playground_show_named(struct kd_playground *p, struct kd_dynamic_bodies **out, struct kd_error *error)
{
    struct kd_buffer text = { 0 };
    enum kd_status status;
    KD_TRY(kd_playground_show(p, out, error));
    status = kd_playground_write(p, true, &text);
    if (status) {
        kd_error_set(error, status, "out of memory for a snapshot");
        kd_dynamic_bodies_release(*out);
        *out = NULL;
        goto done;
    }
    kd_sha256(text.data, text.size, (*out)->snapshot);
done:
    kd_buffer_finish(&text);
    return status;
}

#define THAT_HOLE "spacetime.%s is %.9g; it must be %.9g, because the playground's bodies move round a hole of that %s"

enum kd_status kd_playground_may_show(const struct kd_playground *p, const struct kd_scene *scene,
                                      struct kd_error *error)
{
    const bool kerr = p->params.gravity == KD_GRAVITY_KERR;
#define MORE(x, name, ...) \
    if (!kerr && scene->spacetime.name != 0) \
        return kd_error_field(error, "/spacetime/" #name, \
                              "spacetime.%s is %.9g; it must be 0, because the playground's bodies and debris move " \
                              "in the potential of an uncharged hole", \
                              #name, scene->spacetime.name); \
    if (kerr && scene->spacetime.name != p->params.name) \
        return kd_error_field(error, "/spacetime/" #name, THAT_HOLE, #name, scene->spacetime.name, p->params.name, \
                              #name);
    KD_HOLE_MORE(MORE, )
#undef MORE
    if (kerr && p->params.spin != scene->spacetime.spin)
        return kd_error_field(error, "/spacetime/spin", THAT_HOLE, "spin", scene->spacetime.spin, p->params.spin,
                              "spin");
    return KD_OK;
}

/* The radius within which nine pieces in ten are, with an error of one per cent; 0 if there are no pieces. */
static double most_within(const struct kd_playground_debris *debris)
{
    enum { BINS = 4200 }; /* number of bins in ln r, up to 1e18 M */
    uint32_t count[BINS] = { 0 }, all = 0, sum = 0;
    for (uint32_t i = 0; i < debris->used; i++) {
        const float bin = 100 * logf((float)kd_playground_radius(debris->pieces[i].x));
        if (debris->pieces[i].stage == KD_DEBRIS_FREE || !(bin >= 0 && bin < BINS))
            continue;
        count[(int)bin]++;
        all++;
    }
    for (int k = 0; all && k < BINS; k++) {
        sum += count[k];
        if (sum >= 0.9 * all)
            return exp(0.01 * (k + 1));
    }
    return 0;
}

enum kd_status kd_playground_widen(const struct kd_playground *p, struct kd_scene *scene, struct kd_error *error)
{
    double farthest = most_within(&p->debris);
    char text[40];
    for (size_t i = 0; i < p->n; i++)
        farthest = fmax(farthest, kd_playground_radius(p->bodies[i].x) + p->bodies[i].radius);
    snprintf(text, sizeof text, "%.9g", fmin(fmax(2.4 * farthest, scene->camera.field_m), 1e6));
    return kd_scene_set(scene, "camera.field_m", text, error);
}

enum kd_status kd_playground_usual_scene(const struct kd_playground_preset *preset, const struct kd_playground *p,
                                         struct kd_scene *out, struct kd_error *error)
{
    static const char size[] = "{\"image\":{\"width\":640,\"height\":360}}";
    enum kd_status status;
    kd_scene_defaults(out);
    KD_TRY(kd_scene_patch(out, size, sizeof size - 1, error));
    if (preset)
        KD_TRY(kd_scene_patch(out, preset->scene, strlen(preset->scene), error));
    KD_HOLE_COPY(&out->spacetime, &p->params);
    if (!preset)
        KD_TRY(kd_playground_widen(p, out, error));
    KD_TRY(kd_scene_validate(out, error));
done:
    return status;
}
