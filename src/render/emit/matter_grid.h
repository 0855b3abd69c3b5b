/* Matter on a grid is read here from an NPZ file, as numpy.savez writes it, for volume.model "grid".
 * docs/physics/volume.md says what is in the file. Pure, any thread.
 *
 *   header        JSON: {"format": "kerrd-grid", "version": 1, "spin": a, "azimuth": "boyer-lindquist" or
 *                 "kerr-schild", "units": {array: unit}}
 *   r theta phi   of rows, columns and layers: even in log r, in theta and in phi; phi, which goes round once or a
 *                 whole part of that, may be missing
 *   density temperature u_con_r u_con_theta u_cov_phi b_con_r b_con_theta b_cov_phi   (rows, columns) or (rows,
 *     columns, layers)
 *   u_con_t       may be missing; where it is there the velocity must be a unit vector
 *
 * Components are of Boyer and Lindquist's coordinates, con contravariant and cov covariant: those that are finite at
 * the horizon. u^t follows from the norm, and b^t, b being the field in the frame of the matter, from b.u = 0. */
#ifndef KD_RENDER_EMIT_MATTER_GRID_H
#define KD_RENDER_EMIT_MATTER_GRID_H

#include "base/error.h"
#include "physics/spacetime/hole.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum {
    KD_MATTER_SIDE = 4096,     /* rows, columns or layers at most, */
    KD_MATTER_NODES = 1 << 21, /* and nodes: 256 x 128 x 64 */
    KD_MATTER_FLOATS = 8,      /* of a node */
};
#define KD_MATTER_TYPE "application/x-npz"

struct kd_matter_grid {
    uint32_t rows, columns, layers; /* layers 1: the same all round */
    double spin;
    double r[2], theta[2]; /* of the first and of the last row and column; r in M */
    double phi, turn;      /* of the first layer; radians of all of them together, one turn or a whole part of it */
    bool ingoing;          /* phi is that of Kerr and Schild's ingoing coordinates, else Boyer and Lindquist's */
    double field;          /* the largest component of the field, gauss; 1 where there is none */
    /* Of each node, layers next to one another: log2 of density in cm^-3 and of k T/(m_e c^2), u^r, r u^theta,
     * u_phi/(r sin^2 theta), and b^r, r b^theta and b_phi/(r sin^2 theta) over `field`: numbers that change little
     * from node to node, and are finite on the axis. */
    float *nodes;
};

/* Says whether bytes begin as an NPZ file does. */
bool kd_matter_grid_is(const void *data, size_t size);
/* Reads a file and checks all of it. KD_EINVAL says what is wrong, and what is allowed; KD_ENOMEM. */
enum kd_status kd_matter_grid_read(const void *data, size_t size, struct kd_matter_grid *out, struct kd_error *error);
/* The same, of which only the number of nodes in r, theta and phi and the spin are kept. */
enum kd_status kd_matter_grid_look(const void *data, size_t size, uint32_t nodes[3], double *spin,
                                   struct kd_error *error);
void kd_matter_grid_told(const struct kd_matter_grid *grid, uint32_t nodes[3], double *spin);
void kd_matter_grid_finish(struct kd_matter_grid *grid);

/* The same by pieces of some milliseconds, none of which unpacks more than one array. The file's bytes must stay
 * meanwhile. One thread at a time. */
struct kd_matter_reader;
/* Reads the header and the places of the nodes. look: the numbers are checked, and what comes is no grid to be
 * rendered. */
enum kd_status kd_matter_reader_open(const void *data, size_t size, bool look, struct kd_matter_reader **out,
                                     struct kd_error *error);
/* Bytes that the rest takes until the reader is closed: nodes, and the longest array that is unpacked. */
size_t kd_matter_reader_bytes(const struct kd_matter_reader *reader);
const struct kd_matter_grid *kd_matter_reader_grid(const struct kd_matter_reader *reader);
/* Goes on until that time of kd_clock_ms, with one array at least begun. */
enum kd_status kd_matter_reader_go_on(struct kd_matter_reader *reader, double until_ms, bool *over,
                                      struct kd_error *error);
void kd_matter_reader_close(struct kd_matter_reader *reader); /* accepts NULL */
/* Makes a grid of no matter at all, as of a scene that names none. */
enum kd_status kd_matter_grid_none(const struct kd_hole *hole, struct kd_matter_grid *out, struct kd_error *error);

#endif
