/* Debris is what tides tear off bodies: massless pieces in the hole's potential alone, which neither pull nor meet
 * one another.
 *
 * Pieces lie in a ring: a new one takes the place of the oldest. Each is moved with sub-steps
 * of its own, C (r - 2) long, from one time that all pieces share to the next, in double: far out a float stands
 * still, as what it moves in a stride is less than its last bit. It belongs to a source, the pass in which it was
 * torn off.
 *
 * A source counts when its pieces come back. A piece is back at the pericentre after its first apocentre (or when
 * the hole takes it after that). These counts are a histogram over the time since the source's first piece:
 * KD_DEBRIS_BINS bins, sixteen a decade, from 1 M on. They are whole numbers, so that they do not depend on who
 * counts first. One thread at a time. */
#ifndef KD_PLAYGROUND_DEBRIS_H
#define KD_PLAYGROUND_DEBRIS_H

#include "playground/body.h"

#include "base/buffer.h"

#include <stdbool.h>
#include <stddef.h>

enum { KD_DEBRIS_SOURCES = 256, KD_DEBRIS_BINS = 128, KD_DEBRIS_PER_DECADE = 16 };

/* The first pericentre is before its apocentre; then it falls back; then it is back. A free place holds no piece. */
enum kd_debris_stage { KD_DEBRIS_FREE, KD_DEBRIS_LEAVES, KD_DEBRIS_RETURNS, KD_DEBRIS_BACK };

struct kd_debris_piece {
    double x[3], v[3];
    uint32_t source, stage; /* where its source lies */
};

struct kd_debris_source {
    uint32_t number; /* from 1; 0: free */
    char name[KD_PLAYGROUND_NAME];
    double t;                /* of its first piece */
    double piece_mass;       /* of one of its pieces */
    double worth;            /* of a piece, in whole bodies: in pictures */
    double spread;           /* half the width of their energies, R/r_t^2 */
    uint32_t pieces;         /* torn off so far */
    uint32_t captured, lost; /* taken by the hole; given up for newer ones */
    uint32_t back[KD_DEBRIS_BINS], all_back;
};

struct kd_playground_debris {
    struct kd_debris_piece *pieces;
    uint32_t capacity, used, next; /* places ever used; where the next piece goes */
    uint32_t last_source;          /* number of the newest source; it lies at number % KD_DEBRIS_SOURCES */
    uint32_t alive;
    double haste; /* the sum of 1/(r - 2) over the pieces at t: how many sub-steps they take in 1 M, times C */
    double t;     /* all pieces are where they are at this time */
    struct kd_debris_source sources[KD_DEBRIS_SOURCES];
};

/* Changes the capacity, keeping the newest pieces. KD_ENOMEM leaves all as it was. */
enum kd_status kd_debris_resize(struct kd_playground_debris *debris, uint32_t capacity, struct kd_error *error);
void kd_debris_finish(struct kd_playground_debris *debris);

/* A new source, at debris->t, of a body of some mass that falls into so many pieces; the oldest one's pieces are
 * given up where there are as many as may be. */
struct kd_debris_source *kd_debris_source_begin(struct kd_playground_debris *debris, const char *name, double mass,
                                                uint32_t pieces, double spread);
/* The source of this number; NULL: it is gone. */
struct kd_debris_source *kd_debris_source_of(struct kd_playground_debris *debris, uint32_t number);

/* Tears n pieces off a body of radius R at x, v: their energies lie evenly within `spread` of the body's, those
 * below it nearer the hole, those above farther away. Frozen in: each then goes its own way (M. Rees 1988, Nature
 * 333, 523; N. Stone et al. 2013, MNRAS 435, 1809). */
struct kd_debris_shed {
    const double *x, *v;
    double radius;
    uint32_t n, seed;
    uint64_t *random;
};
void kd_debris_shed(struct kd_playground_debris *debris, struct kd_debris_source *source,
                    const struct kd_debris_shed *shed);

/* Moves all pieces on to t. With `feeds` a piece that is back is counted and leaves: it has become part of the disk. */
void kd_debris_advance(struct kd_playground_debris *debris, double t, double safety, bool feeds);
/* How far they may be moved on at once so that all together take no more sub-steps than a fraction of a second has
 * room for; INFINITY: there is none. */
double kd_debris_stride(const struct kd_playground_debris *debris, double safety);

/* Time in the middle of a bin, its width, the rate at which mass came back in it, and that of Rees for a flat
 * distribution of energies, (m/(2 spread)) (2 pi)^(2/3)/3 t^(-5/3), m being the mass of all its pieces. */
struct kd_debris_rate {
    double t, width, rate, line;
    uint32_t pieces;
};
struct kd_debris_rate kd_debris_rate(const struct kd_debris_source *source, int bin);
/* The same of all sources as text/csv: source,t,width,pieces,rate,line,whole. whole is 0 where a bin is cut: the
 * first one in which pieces came back, and the one that is not over. KD_ENOMEM. */
enum kd_status kd_debris_csv(const struct kd_playground_debris *debris, struct kd_buffer *out);
/* As an NPY array of records with these fields. KD_ENOMEM. */
enum kd_status kd_debris_npy(const struct kd_playground_debris *debris, struct kd_buffer *out);

#endif
