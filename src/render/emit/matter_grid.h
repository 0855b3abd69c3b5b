/* Reads matter on a grid from an NPZ file, as numpy.savez writes it, for volume.model "grid". docs/physics/volume.md
 * describes the file. Pure, any thread.
 *
 *   header        JSON: {"format": "kerrd-grid", "version": 1, "spin": a, "azimuth": "boyer-lindquist" or
 *                 "kerr-schild", "units": {array: unit}, and optionally "charge": Q of the hole in M, 0 if missing, and
 *                 "packed": true or false; the default is true in a grid of more than 2^21 nodes}
 *   r theta phi   coordinates of rows, columns and layers. r is evenly spaced in log r, and phi in phi. theta has an
 *                 angle for each column, or, with the shape (rows, columns), for each node. phi covers a full
 *                 turn, or 1/k of it, where k is a whole number, and may be missing
 *   time          optional: the times of the frames of a series, in even steps. Each array below then has a leading
 *                 axis of frames. The header's "time" names the time that is constant in a frame, "boyer-lindquist" or
 *                 "kerr-schild"; if it is missing, it is the time that "azimuth" names
 *   density temperature u_con_r u_con_theta u_cov_phi b_con_r b_con_theta b_cov_phi
 *                 arrays of the shape (rows, columns) or (rows, columns, layers)
 *   u_con_t       optional; if present, the velocity must be a unit vector
 *
 * Components are in Boyer-Lindquist coordinates (con: contravariant, cov: covariant), namely those that are finite
 * at the horizon. u^t follows from the norm. b is the field in the frame of the matter, so b^t follows from b.u = 0. */
#ifndef KD_RENDER_EMIT_MATTER_GRID_H
#define KD_RENDER_EMIT_MATTER_GRID_H

#include "base/error.h"
#include "physics/spacetime/hole.h"
#include "scene/asset.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum {
    KD_MATTER_SIDE = 4096,     /* limit for rows, columns and layers */
    KD_MATTER_NODES = 1 << 25, /* limit for nodes of all frames: 512 x 256 x 256 */
    KD_MATTER_FRAMES = 1024,   /* limit for frames */
    KD_MATTER_WHOLE = 1 << 21, /* largest number of nodes of a grid that is not packed */
    KD_MATTER_FLOATS = 8,      /* floats of a node; a packed node has half as many words */
    /* limit for the number of angles theta, if each pair of row and column has an angle of its own */
    KD_MATTER_ANGLES = 1 << 21,
    KD_MATTER_PLACES = 1 << 20 /* limit for the number of cells of `places`; a cell has four floats */
};

struct kd_matter_grid {
    uint32_t rows, columns, layers; /* layers 1: axisymmetric */
    uint32_t frames;                /* number of frames in time; 1: the grid has no times */
    double time[2];                 /* times of the first and the last frame, M */
    bool late;                      /* true if the frames are slices of constant ingoing Kerr-Schild time */
    KD_HOLE_MEMBERS
    double r[2], theta[2]; /* r of the first and the last row, in M; theta of the first and the last column, if columns
                              are evenly spaced */
    /* phi: azimuth of the first layer. turn: angle covered by all layers, in radians; it is a full turn divided by a
     * whole number */
    double phi, turn;
    bool ingoing; /* true if phi is the ingoing Kerr-Schild azimuth; false: the Boyer-Lindquist azimuth */
    double field; /* the largest component of the field, in gauss; 1 if there is no field */
    /* For each node, with layers adjacent, then columns, rows and frames: log2 of density in cm^-3 and of k T/(m_e
     * c^2), u^r, r u^theta, u_phi/(r sin^2 theta), then b^r, r b^theta and b_phi/(r sin^2 theta), each divided by
     * `field`. These numbers vary little from node to node and are finite on the axis. */
    float *nodes;
    /* A packed node has four words. The first has density and Theta as fractions of their ranges, in 16 bits each. The
     * others have six halves in the order above: u divided by `speed`, and b times KD_MATTER_FIELD. Theta is k T/(m_e
     * c^2). least and range: least value and range of log2 of density and of Theta. */
    bool packed, whole; /* whole: true if the file requests nodes that are not packed */
    double least[2], range[2], speed;
    /* For columns that are not evenly spaced: a table that gives the column at theta, as a number with a fraction, by
     * bilinear interpolation. The table has `steps` cells in theta from 0 to pi for each pair of adjacent rows. If
     * all rows have the same angles, it has only one such set of cells. A cell has four floats: the column at the
     * cell's beginning and at its end, each in both adjacent rows. NULL: the columns are evenly spaced. */
    float *places;
    uint32_t steps, place_rows;
};

/* half-precision number that stands for the largest component of the field, so that smaller components also keep their
 * 11 bits */
#define KD_MATTER_FIELD 16384.0

/* True if bytes begin as an NPZ file does. */
bool kd_matter_grid_is(const void *data, size_t size);
/* Reads and checks a whole file. Returns KD_ENOMEM, or KD_EINVAL with a message that says what is wrong and what is
 * valid. */
enum kd_status kd_matter_grid_read(const void *data, size_t size, struct kd_matter_grid *out, struct kd_error *error);
/* Like kd_matter_grid_read, but returns only the numbers of nodes in r, theta and phi, the frames and the hole. */
enum kd_status kd_matter_grid_look(const void *data, size_t size, struct kd_asset_grid *out, struct kd_error *error);
/* Number of bytes that the nodes take on the device. */
size_t kd_matter_grid_bytes(const struct kd_matter_grid *grid);
struct kd_asset_grid kd_matter_grid_told(const struct kd_matter_grid *grid);
/* number of floats of `places`; 0: the columns are evenly spaced */
size_t kd_matter_grid_places(const struct kd_matter_grid *grid);
void kd_matter_grid_finish(struct kd_matter_grid *grid);

/* Reads a file in pieces of some milliseconds. No piece unpacks more than one array. The file's bytes must remain
 * valid until the reader is closed. One thread at a time. */
struct kd_matter_reader;
/* Reads the header and the coordinates of the nodes. look: the numbers will only be checked, and the grid cannot be
 * rendered. */
enum kd_status kd_matter_reader_open(const void *data, size_t size, bool look, struct kd_matter_reader **out,
                                     struct kd_error *error);
/* Memory that the reader needs until it is closed: nodes, and the longest unpacked array. */
size_t kd_matter_reader_bytes(const struct kd_matter_reader *reader);
const struct kd_matter_grid *kd_matter_reader_grid(const struct kd_matter_reader *reader);
/* Continues until the time until_ms of kd_clock_ms. Begins at least one array, even if that time has passed. *over:
 * true if the whole file is read. */
enum kd_status kd_matter_reader_go_on(struct kd_matter_reader *reader, double until_ms, bool *over,
                                      struct kd_error *error);
void kd_matter_reader_close(struct kd_matter_reader *reader); /* accepts NULL */
/* Makes a grid without matter, for a scene that names no file. */
enum kd_status kd_matter_grid_none(const struct kd_hole *hole, struct kd_matter_grid *out, struct kd_error *error);

#endif
