/* Tables of line profiles for fits of X-ray spectra: additive table models for XSPEC and for programs that use its
 * models, as FITS files (K. A. Arnaud, OGIP Memo 92-009, "The File Format for XSPEC Table Models"). A table holds the
 * profile of a line (physics/disk/line_profile.h) at each node. The nodes are all combinations of the values of the
 * table's axes. Fitting programs interpolate between nodes, linearly in each axis or in the axis's logarithm.
 *
 * Nodes are numbered from 0; the last axis varies fastest. The file consists of the output of kd_table_head, the rows
 * of all nodes in order, and zeros up to a whole block. Any thread may use a table. Several may read the same table at
 * once. */
#ifndef KD_INTEGRAL_TABLE_H
#define KD_INTEGRAL_TABLE_H

#include "base/buffer.h"
#include "base/error.h"
#include "base/json.h"
#include "integral/asked.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { KD_TABLE_AXES = 10, KD_TABLE_VALUES = 2000, KD_TABLE_NAME = 12 };
#define KD_TABLE_NODES 10000000u

/* An axis of a table: a field of the request, or the ratio of the inner edge to the ISCO's radius (inner_isco). */
struct kd_table_axis {
    const struct kd_row *field;
    /* isco: true if the axis is inner_isco. log: true if interpolation uses the logarithm of the value */
    bool isco, log;
    size_t n;
    /* values in ascending order; each is representable in 32 bits, as the file stores it */
    double values[KD_TABLE_VALUES];
};

struct kd_table {
    struct kd_integral_request base; /* the checked request of the first node */
    struct kd_table_axis *axes;      /* all axes; those of the hole and of the inclination come first */
    size_t n_axes, nodes;
    /* number of successive nodes with the same hole and inclination, which therefore share the disk's image */
    size_t run;
    char name[KD_TABLE_NAME + 1];
};

/* Makes a table from a request for a line. The request need not be checked. The table takes ownership of the request,
 * even on failure. axes: texts FIELD=VALUES. VALUES are numbers and ranges START:STOP/COUNT, separated by commas; the
 * prefix "log:" makes the axis logarithmic. Spin and inclination get default axes if they have neither an axis nor a
 * given value. All nodes are checked. Returns KD_EINVAL at the pointer of the field, or KD_ENOMEM. Free the table with
 * kd_table_finish, also after a failure. */
enum kd_status kd_table_init(struct kd_table *table, struct kd_integral_request *request, const char *const *axes,
                             size_t n_axes, const char *name, struct kd_error *error);
void kd_table_finish(struct kd_table *table);

/* Appends the part of the file that precedes the rows. rows_sum: kd_fits_sum of all rows (image/fits.h). The only error
 * is KD_ENOMEM. */
enum kd_status kd_table_head(const struct kd_table *table, uint32_t rows_sum, struct kd_buffer *out,
                             struct kd_error *error);

/* Writes the axes as a member: the field, the interpolation and the values of each axis. */
void kd_table_axes_json(const struct kd_table *table, struct kd_json *json, const char *name);

/* Number of bytes of a row, which is a multiple of four. */
size_t kd_table_row_bytes(const struct kd_table *table);

/* Computes the rows of n successive nodes, which must have the same hole and inclination. Raises *worst to the largest
 * error estimate of these profiles, if that is larger. Takes some milliseconds a row. */
enum kd_status kd_table_rows(const struct kd_table *table, size_t first, size_t n, uint8_t *rows, double *worst,
                             struct kd_error *error);

/* The default axes, for spin and inclination, as texts for kd_table_init. */
enum { KD_TABLE_DEFAULTS = 2 };
const char *const *kd_table_defaults(void);

#endif
