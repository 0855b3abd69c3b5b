/* kerrd table: makes an additive table model of a line's profile, for XSPEC and other programs that fit X-ray
 * spectra. */
#include "integral/table.h"
#include "base/parallel.h"
#include "cli/cli.h"
#include "cli/ending.h"
#include "cli/file.h"
#include "cli/progress.h"
#include "image/fits.h"
#include "integral/request.h"

#include <errno.h>
#include <fcntl.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

/* PIECE: number of nodes in one work item; PIECES: number of work items between two writes */
enum { SET_MOST = 32, PIECE = 32, PIECES = 64 };

struct arguments {
    const char *input, *output, *name, **axes;
    const char *set[SET_MOST];
    size_t n_axes, n_set;
    bool stats, plan;
};

static const struct argp_option options[] = {
    { "axis", 'x', "FIELD=VALUES", 0,
      "makes FIELD a parameter of the table. VALUES are numbers and ranges START:STOP/COUNT, separated by commas. A "
      "reader interpolates linearly between them; if log: precedes VALUES, it interpolates in their logarithm. Fields "
      "are spin" KD_HOLE_MORE_NAMES ", inclination_deg, inner, inner_isco (inner over the ISCO), outer, index, "
      "outer_index, break_r, height, photon_index. May be repeated",
      0 },
    { "set", 's', "FIELD=VALUE", 0, "a field of kerrd line that has one value; may be repeated", 0 },
    { "output", 'o', "FILE", 0, "file to write, .fits (required); unfinished work is FILE.part", 0 },
    { "name", 'n', "NAME", 0, "name of the model, at most 12 ASCII characters (default: kerrdline)", 0 },
    { "plan", 'p', NULL, 0, "print the axes, the number of nodes and the size as JSON, and compute nothing", 0 },
    { "stats", 't', NULL, 0,
      "print nodes, time and the largest error of a profile as one line of JSON on standard error", 0 },
    { 0 },
};

static bool is_printed(const char *text)
{
    while (*text >= ' ' && *text <= '~')
        text++;
    return !*text;
}

static error_t parse(int key, char *text, struct argp_state *state)
{
    struct arguments *a = state->input;
    switch (key) {
    case 'x': kd_cli_add_axis(&a->axes, &a->n_axes, text, state); return 0;
    case 's':
        if (a->n_set == SET_MOST)
            argp_error(state, "--set is given more than %d times", SET_MOST);
        else if (!strchr(text, '='))
            argp_error(state, "--set is %s; it must be FIELD=VALUE", text);
        else
            a->set[a->n_set++] = text;
        return 0;
    case 'o': a->output = text; return 0;
    case 'n':
        if (!*text || strlen(text) > KD_TABLE_NAME || !is_printed(text))
            argp_error(state, "--name is %s; it must have 1 to %d ASCII characters", text, KD_TABLE_NAME);
        a->name = text;
        return 0;
    case 'p': a->plan = true; return 0;
    case 't': a->stats = true; return 0;
    case ARGP_KEY_ARG:
        if (a->input)
            argp_error(state, "%s cannot be used with %s, because the command takes one file", text, a->input);
        a->input = text;
        return 0;
    case ARGP_KEY_END:
        if (a->n_axes > KD_TABLE_AXES)
            argp_error(state, "there are %zu axes; there must be at most %d", a->n_axes, KD_TABLE_AXES);
        else if (a->plan)
            return 0;
        else if (!a->output || !strcmp(a->output, "-"))
            argp_error(state, "-o FILE is missing; it names the table");
        else
            kd_cli_ending_required(state, "--output", a->output, KD_ENDINGS("fits"));
        return 0;
    }
    return ARGP_ERR_UNKNOWN;
}

static enum kd_status read_request(const struct arguments *a, struct kd_integral_request *request,
                                   struct kd_error *error)
{
    struct kd_buffer file = { 0 };
    enum kd_status status = KD_OK;
    if (a->input) {
        KD_TRY(kd_file_read(a->input, KD_INTEGRAL_BODY_MAX, &file, error));
        if ((status = kd_integral_request_read(request, file.data ? (const char *)file.data : "", file.size, error))) {
            kd_cli_prefix(error, strcmp(a->input, "-") ? a->input : "standard input");
            goto done;
        }
    }
    for (size_t i = 0; i < a->n_set; i++) {
        char name[64];
        const char *value = strchr(a->set[i], '=');
        snprintf(name, sizeof name, "%.*s", (int)(value - a->set[i]), a->set[i]);
        KD_TRY(kd_integral_request_set(request, name, value + 1, error));
    }
done:
    kd_buffer_finish(&file);
    return status;
}

/* The unfinished file: the header of a table without rows, followed by the rows so far. */
struct part {
    char *path;
    int file;
    struct kd_buffer head;
    size_t rows, resumed; /* rows: number of complete rows; resumed: number of these that earlier runs have made */
    uint32_t sum;
};

static enum kd_status write_at(const struct part *part, const void *bytes, size_t size, uint64_t at,
                               struct kd_error *error)
{
    for (size_t n = 0; n < size;) {
        const ssize_t wrote = pwrite(part->file, (const char *)bytes + n, size - n, (off_t)(at + n));
        if (wrote < 0 && errno == EINTR)
            continue;
        if (wrote <= 0)
            return kd_error_set(error, wrote < 0 && errno == ENOSPC ? KD_EFULL : KD_EIO, "cannot write %s: %s",
                                part->path, wrote < 0 ? strerror(errno) : "nothing was written");
        n += (size_t)wrote;
    }
    return KD_OK;
}

static enum kd_status read_at(const struct part *part, void *bytes, size_t size, uint64_t at, struct kd_error *error)
{
    for (size_t n = 0; n < size;) {
        const ssize_t got = pread(part->file, (char *)bytes + n, size - n, (off_t)(at + n));
        if (got < 0 && errno == EINTR)
            continue;
        if (got <= 0)
            return kd_error_set(error, KD_EIO, "cannot read %s: %s", part->path,
                                got < 0 ? strerror(errno) : "it ends too soon");
        n += (size_t)got;
    }
    return KD_OK;
}

/* True if the file begins with the header that this table has for this checksum of its rows. bytes: a buffer with
 * room for the header. */
static enum kd_status begins_with(const struct part *part, const struct kd_table *table, uint32_t sum, uint8_t *bytes,
                                  bool *does, struct kd_error *error)
{
    struct kd_buffer head = { 0 };
    enum kd_status status;
    KD_TRY(kd_table_head(table, sum, &head, error));
    KD_TRY(read_at(part, bytes, head.size, 0, error));
    *does = !memcmp(bytes, head.data, head.size);
done:
    kd_buffer_finish(&head);
    return status;
}

/* Adds up the checksum of the rows in the file, and checks that the file begins with this table's header. This may
 * be the header of an unfinished table. It is the final header if only the renaming of the file was missing. */
static enum kd_status resume(struct part *part, const struct kd_table *table, uint64_t size, struct kd_error *error)
{
    const size_t row = kd_table_row_bytes(table), room = part->head.size > row ? part->head.size : row;
    bool is_ours = false;
    enum kd_status status = KD_OK;
    uint8_t *bytes = malloc(room);
    if (!bytes)
        return kd_error_set(error, KD_ENOMEM, "out of memory for a row");
    if (size >= part->head.size) {
        part->rows = (size_t)((size - part->head.size) / row);
        part->rows = part->rows < table->nodes ? part->rows : table->nodes;
        for (size_t i = 0; i < part->rows; i++) {
            KD_TRY(read_at(part, bytes, row, part->head.size + (uint64_t)i * row, error));
            part->sum = kd_fits_sum(part->sum, bytes, row);
        }
        KD_TRY(begins_with(part, table, 0, bytes, &is_ours, error));
        if (!is_ours && part->rows == table->nodes)
            KD_TRY(begins_with(part, table, part->sum, bytes, &is_ours, error));
    }
    if (!is_ours)
        KD_TRY(kd_error_set(error, KD_EINVAL,
                            "%s belongs to another table or version; remove it, or write to another file", part->path));
    part->resumed = part->rows;
done:
    free(bytes);
    return status;
}

static enum kd_status open_part(struct part *part, const char *path, const struct kd_table *table,
                                struct kd_error *error)
{
    struct stat info, named;
    enum kd_status status;
    if (asprintf(&part->path, "%s.part", path) < 0) {
        part->path = NULL;
        return kd_error_set(error, KD_ENOMEM, "out of memory for a file's name");
    }
    KD_TRY(kd_table_head(table, 0, &part->head, error));
    part->file = open(part->path, O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (part->file < 0)
        KD_TRY(kd_error_set(error, KD_EIO, "cannot open %s: %s", part->path, strerror(errno)));
    if (flock(part->file, LOCK_EX | LOCK_NB))
        KD_TRY(kd_error_set(error, KD_EINVAL, "%s is in use by another process", part->path));
    /* another process may have completed the table since the file was opened */
    if (fstat(part->file, &info) || !info.st_nlink || stat(part->path, &named) || named.st_ino != info.st_ino)
        KD_TRY(kd_error_set(error, KD_EINVAL, "%s is in use by another process", part->path));
    if (info.st_size > 0)
        KD_TRY(resume(part, table, (uint64_t)info.st_size, error));
    else
        KD_TRY(write_at(part, part->head.data, part->head.size, 0, error));
done:
    return status;
}

/* Pads the file, writes the header with the checksum of the rows, and renames the file to its final name. */
static enum kd_status finish_part(struct part *part, const char *path, const struct kd_table *table,
                                  struct kd_error *error)
{
    static const uint8_t zeros[KD_FITS_BLOCK];
    const uint64_t rows = (uint64_t)table->nodes * kd_table_row_bytes(table), end = part->head.size + rows;
    const size_t padding = kd_fits_padding(rows);
    struct kd_buffer head = { 0 };
    enum kd_status status;
    KD_TRY(write_at(part, zeros, padding, end, error));
    if (ftruncate(part->file, (off_t)(end + padding)))
        KD_TRY(kd_error_set(error, KD_EIO, "cannot write %s: %s", part->path, strerror(errno)));
    KD_TRY(kd_table_head(table, part->sum, &head, error));
    KD_TRY(write_at(part, head.data, head.size, 0, error));
    if (fsync(part->file) || rename(part->path, path))
        KD_TRY(kd_error_set(error, KD_EIO, "cannot write %s: %s", path, strerror(errno)));
done:
    kd_buffer_finish(&head);
    return status;
}

/* The rows between two writes. They belong to consecutive nodes with the same hole and inclination, and are computed
 * in parallel, in pieces. */
struct batch {
    const struct kd_table *table;
    uint8_t *rows;
    size_t first, n; /* first: first node of the batch; n: number of nodes */
    struct piece {
        size_t first, n; /* nodes */
        enum kd_status status;
        struct kd_error error;
        double worst;
    } pieces[PIECES];
};

static void compute_piece(void *user, size_t item)
{
    struct batch *b = user;
    struct piece *p = &b->pieces[item];
    p->status = kd_table_rows(b->table, p->first, p->n, b->rows + (p->first - b->first) * kd_table_row_bytes(b->table),
                              &p->worst, &p->error);
}

static size_t cut_pieces(struct batch *b, size_t first)
{
    size_t at = first;
    b->first = first;
    for (b->n = 0; b->n < PIECES && at < b->table->nodes; b->n++) {
        const size_t left = b->table->run - at % b->table->run;
        b->pieces[b->n] = (struct piece) { .first = at, .n = left < PIECE ? left : PIECE };
        at += b->pieces[b->n].n;
    }
    return at - first;
}

static enum kd_status make_rows(const struct kd_table *table, struct part *part, double *worst, struct kd_error *error)
{
    const size_t row = kd_table_row_bytes(table);
    struct batch *b = calloc(1, sizeof *b);
    struct kd_progress progress;
    enum kd_status status = KD_OK;
    if (!b || !(b->rows = malloc(row * PIECE * PIECES))) {
        free(b);
        return kd_error_set(error, KD_ENOMEM, "out of memory for the rows of a table");
    }
    b->table = table;
    kd_progress_begin(&progress, 1);
    while (part->rows < table->nodes) {
        if (!kd_progress_update(&progress, (double)part->rows / (double)table->nodes))
            KD_TRY(kd_error_set(error, KD_ECANCELLED, "cancelled; the same command continues the table"));
        const size_t n = cut_pieces(b, part->rows);
        kd_parallel(b->n, compute_piece, b);
        for (size_t i = 0; i < b->n; i++) {
            *worst = fmax(*worst, b->pieces[i].worst);
            if (b->pieces[i].status) {
                *error = b->pieces[i].error;
                KD_TRY(b->pieces[i].status);
            }
        }
        KD_TRY(write_at(part, b->rows, n * row, part->head.size + (uint64_t)part->rows * row, error));
        part->sum = kd_fits_sum(part->sum, b->rows, n * row);
        part->rows += n;
    }
done:
    kd_progress_finish(&progress);
    free(b->rows);
    free(b);
    return status;
}

static enum kd_status print_plan(const struct kd_table *table, struct kd_error *error)
{
    struct kd_buffer text = { 0 }, head = { 0 };
    const uint64_t rows = (uint64_t)table->nodes * kd_table_row_bytes(table);
    enum kd_status status = kd_table_head(table, 0, &head, error);
    struct kd_json json = kd_json_begin_lines(&text);
    kd_json_object(&json, NULL);
    kd_json_number(&json, "nodes", (double)table->nodes);
    kd_json_number(&json, "bins", table->base.bins);
    kd_json_number(&json, "bytes", (double)(head.size + rows + kd_fits_padding(rows)));
    kd_table_axes_json(table, &json, "axes");
    kd_json_end(&json);
    if (!status && (status = kd_json_finish_line(&json)))
        kd_error_set(error, status, "out of memory for a plan");
    if (!status && kd_cli_print(text.data, text.size))
        status = kd_error_set(error, KD_EIO, "cannot write to standard output");
    kd_buffer_finish(&text);
    kd_buffer_finish(&head);
    return status;
}

static enum kd_status make(const struct arguments *a, struct kd_error *error)
{
    struct kd_integral_request request;
    struct kd_table table = { 0 };
    struct part part = { .file = -1 };
    const double started = kd_progress_clock();
    double worst = 0;
    enum kd_status status;
    kd_integral_request_init(&request, KD_INTEGRAL_LINE);
    if (!a->plan)
        KD_TRY(kd_file_check(a->output, error));
    KD_TRY(read_request(a, &request, error));
    KD_TRY(kd_table_init(&table, &request, a->axes, a->n_axes, a->name, error));
    if (a->plan) {
        KD_TRY(print_plan(&table, error));
        goto done;
    }
    KD_TRY(open_part(&part, a->output, &table, error));
    KD_TRY(make_rows(&table, &part, &worst, error));
    KD_TRY(finish_part(&part, a->output, &table, error));
    if (a->stats)
        fprintf(stderr, "{\"nodes\":%zu,\"resumed\":%zu,\"bins\":%u,\"seconds\":%.3f,\"error\":%.2g}\n", table.nodes,
                part.resumed, table.base.bins, kd_progress_clock() - started, worst);
done:
    if (part.file >= 0)
        close(part.file);
    kd_buffer_finish(&part.head);
    free(part.path);
    kd_table_finish(&table);
    kd_integral_request_finish(&request);
    return status;
}

static const char doc[] =
    "Additive table model of the profile of a line from a thin disk, for XSPEC and other programs that fit X-ray "
    "spectra.\vFILE is a request of POST /v1/line. A table has axes for spin and inclination, unless --set gives the "
    "field one value or --axis other values; other fields have axes if --axis names them. Energies are in keV, by "
    "default around 6.4 keV. An interrupted table is continued by the same command. docs/xspec.md explains the use of "
    "a table. No device is needed.";

const struct argp *kd_cli_table_argp(void)
{
    static const struct argp_child children[] = { { &kd_cli_log_argp, 0, NULL, 3 }, { 0 } };
    static const struct argp argp = {
        .options = options, .parser = parse, .args_doc = "[FILE.json|-]", .doc = doc, .children = children
    };
    return &argp;
}

int kd_cli_table(int argc, char **argv)
{
    struct arguments arguments = { .name = "kerrdline" };
    struct kd_error error = { 0 };
    argp_parse(kd_cli_table_argp(), argc, argv, 0, NULL, &arguments);
    const enum kd_status status = make(&arguments, &error);
    free(arguments.axes);
    return status ? kd_progress_exit(status, &error) : KD_EXIT_OK;
}
