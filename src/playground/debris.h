/* Debris torn off bodies by tides: massless pieces that move in the hole's potential alone and do not interact.
 *
 * Pieces are kept in a ring buffer, in which a new piece replaces the oldest. Between two common times each piece is
 * moved in sub-steps of the length C (r - 2), with its own r. Coordinates are double, because far out the distance
 * moved in a stride is below the resolution of a float. A piece belongs to a source, which is the tidal pass in which
 * it was torn off.
 *
 * A source counts the pieces that come back. A piece has come back when it is at the pericentre after its first
 * apocentre (or when the hole captures it after that). The counts are a histogram over the time since the source's
 * first piece: KD_DEBRIS_BINS bins, sixteen a decade, from 1 M on. They are integers, so that they do not depend on the
 * order of counting. One thread at a time. */
#ifndef KD_PLAYGROUND_DEBRIS_H
#define KD_PLAYGROUND_DEBRIS_H

#include "playground/body.h"

#include "base/buffer.h"

#include <stdbool.h>
#include <stddef.h>

enum { KD_DEBRIS_SOURCES = 256, KD_DEBRIS_BINS = 128, KD_DEBRIS_PER_DECADE = 16 };

/* Stage of a piece. LEAVES: it is before its first apocentre. RETURNS: it falls back. BACK: it has come back. FREE: the
 * slot has no piece. */
enum kd_debris_stage { KD_DEBRIS_FREE, KD_DEBRIS_LEAVES, KD_DEBRIS_RETURNS, KD_DEBRIS_BACK };

struct kd_debris_piece {
    double x[3], v[3];
    uint32_t source, stage; /* source: index of the piece's source in `sources` */
};

struct kd_debris_source {
    uint32_t number; /* number of the source, from 1 on; 0 if this slot is free */
    char name[KD_PLAYGROUND_NAME];
    double t;          /* time at which the source's first piece was torn off */
    double piece_mass; /* mass of each piece of this source */
    double worth;      /* weight of a piece for pictures, as a fraction of a whole body */
    double spread;     /* half width of the range of the pieces' energies, R/r_t^2 */
    uint32_t pieces;   /* number of pieces that were torn off so far */
    /* captured: number of pieces that the hole captured. lost: number of pieces that newer ones replaced */
    uint32_t captured, lost;
    uint32_t back[KD_DEBRIS_BINS], all_back;
};

struct kd_playground_debris {
    struct kd_debris_piece *pieces;
    /* capacity: number of slots. used: number of slots ever used. next: slot of the next piece */
    uint32_t capacity, used, next;
    uint32_t last_source; /* number of the newest source, whose index is number % KD_DEBRIS_SOURCES */
    uint32_t alive;
    /* sum of 1/(r - 2) over the pieces at time t. Divided by C, it is the number of sub-steps that all pieces need for
     * 1 M */
    double haste;
    double t; /* time of all pieces, M */
    struct kd_debris_source sources[KD_DEBRIS_SOURCES];
};

/* Changes the capacity and keeps the newest pieces. Returns KD_ENOMEM, and changes nothing, if memory is short. */
enum kd_status kd_debris_resize(struct kd_playground_debris *debris, uint32_t capacity, struct kd_error *error);
void kd_debris_finish(struct kd_playground_debris *debris);

/* Starts a source at debris->t. mass: mass of the body. pieces: number of pieces into which the body splits. If all
 * slots are taken, the oldest source and its pieces are dropped. */
struct kd_debris_source *kd_debris_source_begin(struct kd_playground_debris *debris, const char *name, double mass,
                                                uint32_t pieces, double spread);
/* The source with this number; NULL if it was dropped. */
struct kd_debris_source *kd_debris_source_of(struct kd_playground_debris *debris, uint32_t number);

/* Parameters for tearing n pieces off a body of the given radius at x with the velocity v. The energies of the pieces
 * are spread evenly from -spread to +spread about the body's energy. Pieces of lower energy start nearer to the hole,
 * pieces of higher energy farther away. After that the energies do not change, and each piece moves freely (M. Rees
 * 1988, Nature 333, 523; N. Stone et al. 2013, MNRAS 435, 1809). */
struct kd_debris_shed {
    const double *x, *v;
    double radius;
    uint32_t n, seed;
    uint64_t *random;
};
void kd_debris_shed(struct kd_playground_debris *debris, struct kd_debris_source *source,
                    const struct kd_debris_shed *shed);

/* Moves all pieces to time t. If `feeds` is true, a piece that comes back is counted and then removed, because it joins
 * the disk. */
void kd_debris_advance(struct kd_playground_debris *debris, double t, double safety, bool feeds);
/* Longest stride for which the sub-steps of all pieces together take a fraction of a second; INFINITY if there are no
 * pieces. */
double kd_debris_stride(const struct kd_playground_debris *debris, double safety);

/* For each bin: central time, width, and rate at which mass came back. line: the rate of Rees for a flat distribution
 * of energies, (m/(2 spread)) (2 pi)^(2/3)/3 t^(-5/3), where m is the mass of all pieces of the source. */
struct kd_debris_rate {
    double t, width, rate, line;
    uint32_t pieces;
};
struct kd_debris_rate kd_debris_rate(const struct kd_debris_source *source, int bin);
/* Writes the rates of all sources as text/csv with the columns source,t,width,pieces,rate,line,whole. whole is 0 for
 * bins that are only partly covered: the first bin in which pieces came back, and the current one. Returns KD_ENOMEM if
 * memory is short. */
enum kd_status kd_debris_csv(const struct kd_playground_debris *debris, struct kd_buffer *out);
/* Writes the same rates as an NPY array of records with these fields. Returns KD_ENOMEM if memory is short. */
enum kd_status kd_debris_npy(const struct kd_playground_debris *debris, struct kd_buffer *out);

#endif
