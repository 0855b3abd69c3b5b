/* What a job makes of its frames: a file for each (pictures, or arrays of their layers), one file of all, or one table
 * with a row for each. Any thread.
 *
 * A series is one C file that defines it, and its line in the table of series.c. */
#ifndef KD_RENDER_OUTPUT_SERIES_H
#define KD_RENDER_OUTPUT_SERIES_H

#include "render/output/gather.h"

/* A document that holds the rows of all frames. */
struct kd_table_format {
    const char *name, *media_type; /* "csv", "text/csv": as those of kd_format */
    const char *file;              /* name to save it under; NULL: it is shown */
    /* rows: n of them, each as the series' frames are; sweep: whose scenes they are, NULL: of none. Fails with
     * KD_ENOMEM alone. */
    enum kd_status (*write)(const void *rows, size_t n, const struct kd_sweep *sweep, struct kd_buffer *out);
};

struct kd_series {
    const char *name;              /* "light-curve": a job's "output" */
    const char *noun;              /* "light curve": in sentences */
    const char *each;              /* "the rows of a light curve": what its frames are, in sentences */
    const struct kd_format *frame; /* what each frame becomes; of a table a row, which is not offered by itself */
    size_t row_bytes;              /* of a row; 0: the frames are files */
    const struct kd_table_format *tables; /* of rows; the first where nobody says otherwise */
    size_t n_tables;
    const struct kd_gather_format *const *wholes; /* of frames that are files: what all of them become, the first where
                                                     nobody says otherwise; NULL at the end */
    bool swept;                                   /* they are of a sweep alone */
};

extern const struct kd_series *const kd_series_all[]; /* the first: where nobody says otherwise */
extern const size_t kd_n_series;

const struct kd_series *kd_series_named(const char *name); /* NULL: there is none */
const struct kd_table_format *kd_series_table(const struct kd_series *series,
                                              const char *name); /* NULL: it has none of that name */

#endif
