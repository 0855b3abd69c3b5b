/* kerrd particles: writes the positions of a scene's particles as an array for NumPy. */
#include "cli/cli.h"
#include "cli/ending.h"
#include "cli/file.h"
#include "cli/scene_command.h"
#include "image/npy.h"
#include "render/output/particle_list.h"
#include "render/render.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const names[] = { "fields", "first", "stride", "count" };
enum { KEY_FIELDS = 256, N_OPTIONS = sizeof names / sizeof *names };

struct arguments {
    struct kd_scene_command base;
    const char *given[N_OPTIONS]; /* NULL: not given */
};

static const struct argp_option table[] = {
    { "output", 'o', "FILE.npy", 0, "output file; - for standard output", 0 },
    { "fields", KEY_FIELDS, "COLUMN,...", 0, "columns, separated by commas (default: x,y,z)", 0 },
    { "first", KEY_FIELDS + 1, "N", 0, "number of the first particle (default: 0)", 0 },
    { "stride", KEY_FIELDS + 2, "N", 0, "step from one particle number to the next (default: 1)", 0 },
    { "count", KEY_FIELDS + 3, "N", 0, "number of particles (default: all)", 0 },
    { 0 },
};

static error_t parse(int key, char *text, struct argp_state *state)
{
    struct arguments *arguments = state->input;
    if (key >= KEY_FIELDS && key < KEY_FIELDS + N_OPTIONS) {
        arguments->given[key - KEY_FIELDS] = text;
        return 0;
    }
    switch (key) {
    case ARGP_KEY_END:
        if (!arguments->base.output)
            argp_error(state, "-o FILE.npy is missing");
        else
            kd_cli_ending(state, "--output", arguments->base.output, KD_ENDINGS("npy"));
        return 0;
    }
    return kd_scene_command_parse(key, text, state);
}

/* Source of the bytes of the file, which are made in slices. */
struct source {
    struct kd_renderer *renderer;
    struct kd_particle_list list;
    struct kd_buffer ready;
    size_t at, listed;
    enum kd_status status;
    struct kd_error error;
};

static enum kd_status header(struct source *s)
{
    struct kd_npy array = { .shape = { s->list.n }, .n_dimensions = 1, .n_fields = s->list.n_columns };
    for (size_t i = 0; i < s->list.n_columns; i++) {
        snprintf(array.fields[i].name, sizeof array.fields[i].name, "%s", kd_particle_column_name(s->list.columns[i]));
        array.fields[i].type = KD_NPY_F4;
    }
    return kd_npy_write_header(&array, &s->ready) ? kd_error_set(&s->error, KD_ENOMEM, "out of memory for the header")
                                                  : KD_OK;
}

static enum kd_status more(struct source *s)
{
    size_t left = s->list.n - s->listed, n = left < KD_PARTICLE_LIST_SLICE ? left : KD_PARTICLE_LIST_SLICE;
    size_t bytes = n * kd_particle_list_row(&s->list);
    float *rows = malloc(bytes);
    s->ready.size = s->at = 0;
    enum kd_status status =
        rows ? kd_particle_list_fill(s->renderer, &s->list, s->listed, n, rows, &s->error) : KD_ENOMEM;
    if (!rows || (!status && kd_buffer_append(&s->ready, rows, bytes)))
        status = kd_error_set(&s->error, KD_ENOMEM, "out of memory for %zu particles", n);
    free(rows);
    s->listed += n;
    return status;
}

static size_t produce(void *user, void *to, size_t size)
{
    struct source *s = user;
    if (s->at == s->ready.size && s->listed == s->list.n)
        return 0;
    if (s->at == s->ready.size && (s->status = more(s)))
        return KD_FILE_STOP;
    size_t left = s->ready.size - s->at, n = left < size ? left : size;
    memcpy(to, s->ready.data + s->at, n);
    s->at += n;
    return n;
}

static enum kd_status prepare(struct kd_scene_command *base, struct source *s)
{
    const struct arguments *arguments = (struct arguments *)base;
    enum kd_status status;
    KD_TRY(kd_scene_command_load(base, &s->error));
    KD_TRY(kd_particle_list_init(&s->list, &base->scene, &s->error));
    for (size_t i = 0; i < N_OPTIONS; i++)
        if (arguments->given[i])
            KD_TRY(kd_particle_list_set(&s->list, names[i], arguments->given[i], &s->error));
    KD_TRY(kd_particle_list_settle(&s->list, 0, &s->error));
    KD_TRY(kd_file_check(base->output, &s->error));
    KD_TRY(kd_scene_command_open(base, &s->error));
    s->renderer = base->renderer;
    KD_TRY(header(s));
done:
    return status;
}

static enum kd_status run(struct kd_scene_command *base, struct kd_error *error)
{
    struct source source = { 0 };
    source.status = prepare(base, &source);
    enum kd_status status = source.status ? KD_OK : kd_file_stream(base->output, produce, &source, error);
    if (source.status == KD_EDEVICE && source.renderer)
        kd_cli_device_lost(&source.error);
    if (source.status)
        status = source.status, *error = source.error;
    kd_buffer_finish(&source.ready);
    return status;
}

const struct argp *kd_cli_particles_argp(void)
{
    static const struct argp argp = {
        .options = table,
        .parser = parse,
        .args_doc = KD_SCENE_ARGS_DOC,
        .doc = "Write positions and velocities of a scene's particles at its time as an NPY array with one record for "
               "each particle.\vColumns: x, y, z, r, phi, latitude, energy, angular_momentum, dr_dt, dphi_dt, "
               "dlatitude_dt; docs/live.md defines them.",
        .children = kd_scene_device_children,
    };
    return &argp;
}

int kd_cli_particles(int argc, char **argv)
{
    struct arguments arguments = { 0 };
    return kd_scene_command_run(&arguments.base, kd_cli_particles_argp(), argc, argv, run);
}
