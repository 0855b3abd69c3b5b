/* The result that a job makes of its frames. It is a file for each frame (pictures, or arrays of their layers), one
 * file of all frames, or one table with a row for each frame. Any thread.
 *
 * A series is one C file that defines it, and its line in the table of series.c. */
#ifndef KD_RENDER_OUTPUT_SERIES_H
#define KD_RENDER_OUTPUT_SERIES_H

#include "render/output/gather.h"

/* Format of a table: a document with the rows of all frames. */
struct kd_table_format {
    const char *name, *media_type; /* "csv", "text/csv": as in kd_format */
    const char *file;              /* file name for saving the document; NULL: the document is displayed */
    /* rows: n rows, one for each frame of the series. sweep: the sweep of the frames' scenes; NULL: there is no
     * sweep. The only error is KD_ENOMEM. */
    enum kd_status (*write)(const void *rows, size_t n, const struct kd_sweep *sweep, struct kd_buffer *out);
};

struct kd_series {
    const char *name; /* "light-curve": value of a job's "output" */
    const char *noun; /* "light curve": for sentences */
    const char *each; /* name of the series' frames, for sentences: "the rows of a light curve" */
    /* format of each frame; for a table, the format of a row, which cannot be requested by itself */
    const struct kd_format *frame;
    size_t row_bytes;                     /* size of a row; 0: the frames are files */
    const struct kd_table_format *tables; /* formats of the table; the first is the default */
    size_t n_tables;
    /* formats for gathering files, the first is the default; ends with NULL */
    const struct kd_gather_format *const *wholes;
    bool swept; /* true if the series exists for sweeps only */
};

extern const struct kd_series *const kd_series_all[]; /* all series; the first is the default */
extern const size_t kd_n_series;

const struct kd_series *kd_series_named(const char *name); /* returns NULL if there is no such series */
const struct kd_table_format *kd_series_table(const struct kd_series *series,
                                              const char *name); /* returns NULL if the series has no such format */

#endif
