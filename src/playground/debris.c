#include "playground/debris.h"

#include "base/pause.h"
#include "base/random.h"
#include "image/npy.h"
#include "playground/hole.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define WORK 1e6        /* largest number of sub-steps of all pieces together in one stride, */
#define WORK_A_PIECE 16 /* or the same number for each piece, if that is more in total */

static void give_up(struct kd_playground_debris *debris, struct kd_debris_piece *piece)
{
    if (piece->stage == KD_DEBRIS_FREE)
        return;
    debris->sources[piece->source].lost++;
    debris->alive--;
    piece->stage = KD_DEBRIS_FREE;
}

enum kd_status kd_debris_resize(struct kd_playground_debris *debris, uint32_t capacity, struct kd_error *error)
{
    if (capacity == debris->capacity && debris->pieces)
        return KD_OK;
    /* allocates one more slot than the capacity, so that the allocation is never empty */
    struct kd_debris_piece *pieces = calloc(capacity + 1, sizeof *pieces);
    if (!pieces)
        return kd_error_set(error, KD_ENOMEM, "no memory for %u pieces of debris", capacity);
    /* Copies pieces backwards from the newest one, which is just before `next`. */
    const uint32_t kept = debris->alive < capacity ? debris->alive : capacity;
    for (uint32_t i = 0, left = kept; i < debris->used; i++) {
        kd_pause_every(i, 65536);
        struct kd_debris_piece *piece = &debris->pieces[(debris->next + debris->capacity - 1 - i) % debris->capacity];
        if (left && piece->stage != KD_DEBRIS_FREE)
            pieces[--left] = *piece;
        else
            give_up(debris, piece);
    }
    free(debris->pieces);
    debris->pieces = pieces;
    debris->capacity = capacity;
    debris->used = kept;
    debris->next = capacity ? kept % capacity : 0;
    return KD_OK;
}

void kd_debris_finish(struct kd_playground_debris *debris)
{
    free(debris->pieces);
    debris->pieces = NULL;
}

struct kd_debris_source *kd_debris_source_of(struct kd_playground_debris *debris, uint32_t number)
{
    struct kd_debris_source *source = &debris->sources[number % KD_DEBRIS_SOURCES];
    return number && source->number == number ? source : NULL;
}

struct kd_debris_source *kd_debris_source_begin(struct kd_playground_debris *debris, const char *name, double mass,
                                                uint32_t pieces, double spread)
{
    const uint32_t number = ++debris->last_source, slot = number % KD_DEBRIS_SOURCES;
    struct kd_debris_source *source = &debris->sources[slot];
    for (uint32_t i = 0; source->number && i < debris->used; i++)
        if (debris->pieces[i].source == slot)
            give_up(debris, &debris->pieces[i]);
    *source = (struct kd_debris_source) {
        .number = number, .t = debris->t, .piece_mass = mass / pieces, .worth = 1.0 / pieces, .spread = spread
    };
    snprintf(source->name, sizeof source->name, "%s", name);
    return source;
}

/* Unit vectors: radially outwards, along the tangential velocity, and normal to both. */
static void directions(const double x[3], const double v[3], double e[3][3])
{
    const double r = kd_playground_radius(x);
    double across[3], length;
    for (int k = 0; k < 3; k++)
        e[0][k] = x[k] / r;
    const double out = v[0] * e[0][0] + v[1] * e[0][1] + v[2] * e[0][2];
    for (int k = 0; k < 3; k++)
        across[k] = v[k] - out * e[0][k];
    length = kd_playground_radius(across);
    if (!(length > 1e-9)) { /* the motion is radial, so any tangential direction serves */
        const int k = fabs(e[0][2]) < 0.9 ? 2 : 0;
        for (int i = 0; i < 3; i++)
            across[i] = (i == k) - e[0][k] * e[0][i];
        length = kd_playground_radius(across);
    }
    for (int k = 0; k < 3; k++)
        e[1][k] = across[k] / length;
    for (int k = 0; k < 3; k++)
        e[2][k] = e[0][(k + 1) % 3] * e[1][(k + 2) % 3] - e[0][(k + 2) % 3] * e[1][(k + 1) % 3];
}

static struct kd_debris_piece piece_of(const struct kd_debris_shed *shed, double e[3][3], double u, double energy)
{
    struct kd_debris_piece piece = { .stage = KD_DEBRIS_LEAVES };
    const double turn = 2 * M_PI * kd_random_drawn(shed->seed, shed->random);
    const double lateral = shed->radius * sqrt((1 - u * u) * kd_random_drawn(shed->seed, shed->random));
    const double at[3] = { u * shed->radius, lateral * cos(turn), lateral * sin(turn) };
    double x[3], speed2 = 0;
    for (int k = 0; k < 3; k++) {
        x[k] = shed->x[k] + at[0] * e[0][k] + at[1] * e[1][k] + at[2] * e[2][k];
        speed2 += shed->v[k] * shed->v[k];
    }
    const double r = kd_playground_radius(x);
    if (!(r > KD_PLAYGROUND_CAPTURE) ||
        !(speed2 > 0)) /* a body inside the hole, or at rest: pieces start at its own position */
        memcpy(x, shed->x, sizeof x);
    const double wanted = 2 * (energy - kd_playground_potential(kd_playground_radius(x)));
    const double factor = speed2 > 0 ? sqrt(fmin(fmax(wanted, 0), 1) / speed2) : 1;
    for (int k = 0; k < 3; k++) {
        piece.x[k] = x[k];
        piece.v[k] = factor * shed->v[k];
    }
    return piece;
}

void kd_debris_shed(struct kd_playground_debris *debris, struct kd_debris_source *source,
                    const struct kd_debris_shed *shed)
{
    double e[3][3];
    directions(shed->x, shed->v, e);
    const double energy = kd_playground_specific(shed->x, shed->v);
    for (uint32_t i = 0; i < shed->n; i++) {
        /* stratified sampling: one number in each of n equal intervals */
        const double u = 2 * (i + kd_random_drawn(shed->seed, shed->random)) / shed->n - 1;
        source->pieces++;
        if (!debris->capacity) {
            source->lost++;
            continue;
        }
        struct kd_debris_piece *piece = &debris->pieces[debris->next];
        give_up(debris, piece);
        *piece = piece_of(shed, e, u, energy + u * source->spread);
        piece->source = source->number % KD_DEBRIS_SOURCES;
        debris->alive++;
        debris->next = (debris->next + 1) % debris->capacity;
        debris->used += debris->used < debris->capacity;
    }
    const double r = fmax(kd_playground_radius(shed->x) - shed->radius, KD_PLAYGROUND_CAPTURE);
    debris->haste += shed->n / (r - KD_PLAYGROUND_HORIZON);
}

/* Counts a piece that has come back. since: time since the piece's source began. */
static void count(struct kd_debris_source *source, struct kd_debris_piece *piece, double since)
{
    const double bin = floor(KD_DEBRIS_PER_DECADE * log10(fmax(since, 1)));
    source->back[(int)fmin(bin, KD_DEBRIS_BINS - 1)]++;
    source->all_back++;
    piece->stage = KD_DEBRIS_BACK;
}

struct motion { double x[3], v[3], r, outwards; };

/* Leapfrog: kick, drift, kick. */
static void move(struct motion *m, double h)
{
    double pull = 0.5 * h * kd_playground_pull(m->r), speed2 = 0;
    for (int k = 0; k < 3; k++) {
        m->v[k] += pull * m->x[k];
        m->x[k] += h * m->v[k];
    }
    m->r = kd_playground_radius(m->x);
    pull = m->r > KD_PLAYGROUND_CAPTURE ? 0.5 * h * kd_playground_pull(m->r) : 0;
    m->outwards = 0;
    for (int k = 0; k < 3; k++) {
        m->v[k] += pull * m->x[k];
        speed2 += m->v[k] * m->v[k];
        m->outwards += m->x[k] * m->v[k];
    }
    for (int k = 0; speed2 > 1 && k < 3; k++)
        m->v[k] /= sqrt(speed2);
}

/* Moves one piece by dt. since: time since the piece's source began. Returns false if the piece is gone. */
static bool advance(struct kd_debris_piece *piece, struct kd_debris_source *source, double since, double dt,
                    double safety, bool feeds, double *radius)
{
    struct motion m = { .outwards = 0 };
    for (int k = 0; k < 3; k++) {
        m.x[k] = piece->x[k];
        m.v[k] = piece->v[k];
        m.outwards += m.x[k] * m.v[k];
    }
    m.r = kd_playground_radius(m.x);
    for (double at = 0; at < dt;) {
        const double h = fmin(safety * (m.r - KD_PLAYGROUND_HORIZON), dt - at), before = m.outwards;
        move(&m, h);
        at += h;
        const bool taken = !(m.r > KD_PLAYGROUND_CAPTURE);
        if (piece->stage == KD_DEBRIS_LEAVES && before > 0 && m.outwards <= 0)
            piece->stage = KD_DEBRIS_RETURNS;
        else if (piece->stage == KD_DEBRIS_RETURNS && (taken || (before < 0 && m.outwards >= 0)))
            count(source, piece, since + at);
        if (taken || (feeds && piece->stage == KD_DEBRIS_BACK)) {
            source->captured += taken;
            return false;
        }
        if (at + 1e-12 * dt >= dt)
            break;
    }
    for (int k = 0; k < 3; k++) {
        piece->x[k] = m.x[k];
        piece->v[k] = m.v[k];
    }
    *radius = m.r;
    return true;
}

void kd_debris_advance(struct kd_playground_debris *debris, double t, double safety, bool feeds)
{
    const double from = debris->t, dt = t - from;
    if (!(dt > 0))
        return;
    debris->t = t;
    debris->haste = 0;
    for (uint32_t i = 0; debris->alive && i < debris->used; i++) {
        struct kd_debris_piece *piece = &debris->pieces[i];
        double radius;
        kd_pause_every(i, 256);
        if (piece->stage == KD_DEBRIS_FREE)
            continue;
        struct kd_debris_source *source = &debris->sources[piece->source];
        if (advance(piece, source, from - source->t, dt, safety, feeds, &radius)) {
            debris->haste += 1 / (radius - KD_PLAYGROUND_HORIZON);
        } else {
            piece->stage = KD_DEBRIS_FREE;
            debris->alive--;
        }
    }
}

double kd_debris_stride(const struct kd_playground_debris *debris, double safety)
{
    return debris->alive ? fmax(WORK, WORK_A_PIECE * (double)debris->alive) * safety / debris->haste : INFINITY;
}

struct kd_debris_rate kd_debris_rate(const struct kd_debris_source *source, int bin)
{
    const double first = pow(10, (double)bin / KD_DEBRIS_PER_DECADE), end = pow(10, (bin + 1.) / KD_DEBRIS_PER_DECADE),
                 t = sqrt(first * end);
    return (struct kd_debris_rate) {
        .t = t,
        .width = end - first,
        .pieces = source->back[bin],
        .rate = source->piece_mass * source->back[bin] / (end - first),
        .line =
            source->piece_mass * source->pieces / (2 * source->spread) * cbrt(4 * M_PI * M_PI) / 3 * pow(t, -5. / 3),
    };
}

/* True if the bin's time is covered completely. This is false for the bin that contains the present, and for the first
 * bin in which a piece came back. The last bin has no upper end. */
static bool is_whole(const struct kd_playground_debris *debris, const struct kd_debris_source *source, int bin)
{
    const double age = debris->t - source->t;
    bool first = true;
    for (int i = 0; i < bin; i++)
        first = first && !source->back[i];
    return !first && age >= pow(10, (bin + 1.) / KD_DEBRIS_PER_DECADE) && bin + 1 < KD_DEBRIS_BINS;
}

enum kd_status kd_debris_csv(const struct kd_playground_debris *debris, struct kd_buffer *out)
{
    enum kd_status status;
    KD_TRY(kd_buffer_printf(out, "source,t,width,pieces,rate,line,whole\n"));
    for (int i = 0; i < KD_DEBRIS_SOURCES; i++) {
        const struct kd_debris_source *source = &debris->sources[i];
        for (int bin = 0; source->number && bin < KD_DEBRIS_BINS; bin++) {
            const struct kd_debris_rate rate = kd_debris_rate(source, bin);
            if (rate.pieces)
                KD_TRY(kd_buffer_printf(out, "%u,%.9g,%.9g,%u,%.9g,%.9g,%d\n", source->number, rate.t, rate.width,
                                        rate.pieces, rate.rate, rate.line, is_whole(debris, source, bin)));
        }
    }
done:
    return status;
}

enum kd_status kd_debris_npy(const struct kd_playground_debris *debris, struct kd_buffer *out)
{
    static const char *const names[] = { "source", "t", "width", "pieces", "rate", "line", "whole" };
    struct kd_npy array = { .n_fields = sizeof names / sizeof *names, .n_dimensions = 1 };
    struct kd_buffer rows = { 0 };
    enum kd_status status;
    for (size_t i = 0; i < array.n_fields; i++) {
        snprintf(array.fields[i].name, sizeof array.fields[i].name, "%s", names[i]);
        array.fields[i].type = KD_NPY_F8;
    }
    for (int i = 0; i < KD_DEBRIS_SOURCES; i++) {
        const struct kd_debris_source *source = &debris->sources[i];
        for (int bin = 0; source->number && bin < KD_DEBRIS_BINS; bin++) {
            const struct kd_debris_rate rate = kd_debris_rate(source, bin);
            if (!rate.pieces)
                continue;
            const double row[] = {
                source->number, rate.t, rate.width, rate.pieces, rate.rate, rate.line, is_whole(debris, source, bin)
            };
            KD_TRY(kd_buffer_append(&rows, row, sizeof row));
            array.shape[0]++;
        }
    }
    KD_TRY(kd_npy_write_header(&array, out));
    KD_TRY(kd_buffer_append(out, rows.data, rows.size));
done:
    kd_buffer_finish(&rows);
    return status;
}
