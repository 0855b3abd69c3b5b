/* Tables of line profiles for fits of X-ray spectra: additive table models of XSPEC and programs with its models, as
 * FITS files (K. A. Arnaud, OGIP Memo 92-009, "The File Format for XSPEC Table Models"). A table is the profile of a
 * line (physics/disk/line_profile.h) at all combinations of the values of its axes, its nodes. Fitting programs
 * interpolate between the nodes, linearly in each axis or in its logarithm.
 *
 * Nodes are numbered from 0; the last axis varies fastest. The file is kd_table_head, the rows of all nodes in order,
 * and zeros up to a whole block. Any thread; a table that is read only may be used by several. */
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

/* An axis: a field of the request, or the inner edge divided by the ISCO's radius (inner_isco). */
struct kd_table_axis {
    const struct kd_row *field;
    bool isco, log; /* log: the interpolation uses the logarithm of the value */
    size_t n;
    double values[KD_TABLE_VALUES]; /* ascending; each is a 32-bit number, as in the file */
};

struct kd_table {
    struct kd_integral_request base; /* the checked request of the first node */
    struct kd_table_axis *axes;      /* axes of the hole and of the inclination, if there are any, come first */
    size_t n_axes, nodes;
    /* number of successive nodes that have the same hole and inclination, and therefore share the disk's image */
    size_t run;
    char name[KD_TABLE_NAME + 1];
};

/* Makes a table from a request for a line. The request need not be checked. The table takes ownership of the
 * request, even on failure. axes: texts FIELD=VALUES; VALUES are numbers and ranges START:STOP/COUNT with commas,
 * with "log:" before them for an axis in the logarithm. Spin and inclination have default axes if they have neither
 * an axis nor a given value. All nodes are checked. Returns KD_EINVAL at the pointer of the field, or KD_ENOMEM.
 * Free the table with kd_table_finish, also after a failure. */
enum kd_status kd_table_init(struct kd_table *table, struct kd_integral_request *request, const char *const *axes,
                             size_t n_axes, const char *name, struct kd_error *error);
void kd_table_finish(struct kd_table *table);

/* Appends everything that precedes the rows. rows_sum: kd_fits_sum of all rows (image/fits.h). The only error is
 * KD_ENOMEM. */
enum kd_status kd_table_head(const struct kd_table *table, uint32_t rows_sum, struct kd_buffer *out,
                             struct kd_error *error);

/* Writes the axes as a member: for each axis the field, the interpolation and the values. */
void kd_table_axes_json(const struct kd_table *table, struct kd_json *json, const char *name);

/* Bytes of a row: a whole number of 32-bit words. */
size_t kd_table_row_bytes(const struct kd_table *table);

/* Computes the rows of n successive nodes, all with the same hole and inclination. *worst becomes the largest error
 * estimate of these profiles, if that is larger than before. Takes some milliseconds a row. */
enum kd_status kd_table_rows(const struct kd_table *table, size_t first, size_t n, uint8_t *rows, double *worst,
                             struct kd_error *error);

/* The default axes, as texts for kd_table_init: spin and inclination. */
enum { KD_TABLE_DEFAULTS = 2 };
const char *const *kd_table_defaults(void);

#endif
