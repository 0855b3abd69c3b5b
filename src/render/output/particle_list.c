#include "render/output/particle_list.h"

#include "physics/spacetime/kerr.h"
#include "document/number.h"
#include "scene/hole.h"
#include "scene/table.h"
#include "document/text.h"
#include "render/device/prepare.h"
#include "render/emit/deposit.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char *const names[] = {
#define COLUMN(name, ...) #name,
    KD_PARTICLE_COLUMNS(COLUMN)
#undef COLUMN
};

/* Cache of the guiding orbit of the previous row, because particles are in order of radius and many share an orbit. */
struct guide {
    uint32_t number; /* UINT32_MAX: none yet */
    struct kd_particle_orbit orbit;
    double energy, momentum;
};

const char *kd_particle_column_name(enum kd_particle_column column) { return names[column]; }

enum kd_status kd_particle_list_init(struct kd_particle_list *list, const struct kd_scene *scene,
                                     struct kd_error *error)
{
    *list = (struct kd_particle_list) {
        .scene = *scene,
        .grid = kd_particle_grid(scene),
        .stride = 1,
        .columns = { KD_PARTICLE_x, KD_PARTICLE_y, KD_PARTICLE_z },
        .n_columns = 3,
    };
    if (list->grid.count)
        return KD_OK;
    const struct kd_word word = kd_word(kd_field_find("disk", "model")->words, scene->disk.model);
    return kd_error_field(error, "/disk/model",
                          "disk.model is \"%.*s\"; for a list of particles it must be \"particles\"", word.length,
                          word.text);
}

static bool number(const char *text, double *out)
{
    size_t length = strlen(text);
    if (!length || kd_number_span_typed(text, length) != length)
        return false;
    *out = kd_number_parse(text);
    return true;
}

static enum kd_status set_fields(struct kd_particle_list *list, const char *text, struct kd_error *error)
{
    list->n_columns = 0;
    for (const char *at = text;; at++) {
        size_t n = strcspn(at, ","), k = 0, i = 0;
        while (k < KD_PARTICLE_N_COLUMNS && (strlen(names[k]) != n || strncmp(names[k], at, n)))
            k++;
        while (i < list->n_columns && list->columns[i] != k)
            i++;
        if (k == KD_PARTICLE_N_COLUMNS || i < list->n_columns) {
            char name[40], all[KD_PARTICLE_NAMES];
            struct kd_particle_list every = { .n_columns = KD_PARTICLE_N_COLUMNS };
            for (k = 0; k < KD_PARTICLE_N_COLUMNS; k++)
                every.columns[k] = (enum kd_particle_column)k;
            kd_particle_list_names(&every, all);
            kd_text_clip(name, sizeof name, text);
            return kd_error_field(error, "/fields",
                                  "fields is \"%s\"; it must hold some of these, each once, with commas between: %s",
                                  name, all);
        }
        list->columns[list->n_columns++] = (enum kd_particle_column)k;
        at += n;
        if (!*at)
            return KD_OK;
    }
}

enum kd_status kd_particle_list_set(struct kd_particle_list *list, const char *name, const char *text,
                                    struct kd_error *error)
{
    const bool first = !strcmp(name, "first"), stride = !strcmp(name, "stride"), count = !strcmp(name, "count");
    char given[40], pointer[sizeof error->pointer] = "";
    double value = NAN, least = first ? 0 : 1, most = (double)list->grid.count - first;
    kd_text_clip(given, sizeof given, text);
    if (!strcmp(name, "fields"))
        return set_fields(list, text, error);
    if (!strcmp(name, "time")) {
        if (!number(text, &value) || !(fabs(value) <= 1e12))
            return kd_error_field(error, "/time", "time is %s; it must be -1e12 to 1e12 M", given);
        list->scene.top.time = value;
        return KD_OK;
    }
    kd_text_pointer(pointer, sizeof pointer, name);
    if (!first && !stride && !count) {
        kd_text_clip(given, sizeof given, name);
        return kd_error_field(error, pointer,
                              "there is no parameter %s here; the parameters are first, stride, count, fields and time",
                              given);
    }
    if (!number(text, &value) || !(value >= least && value <= most) || value != floor(value))
        return kd_error_field(error, pointer,
                              "%s is %s; it must be a whole number from %g to %.0f of the scene's %u particles", name,
                              given, least, most, list->grid.count);
    if (count)
        list->n = (size_t)value;
    else
        *(first ? &list->first : &list->stride) = (uint32_t)value;
    return KD_OK;
}

static bool needs_orbits(const struct kd_particle_list *list)
{
    for (size_t i = 0; i < list->n_columns; i++)
        if (list->columns[i] >= KD_PARTICLE_energy)
            return true;
    return false;
}

enum kd_status kd_particle_list_settle(struct kd_particle_list *list, uint64_t most, struct kd_error *error)
{
    size_t there = (list->grid.count - list->first + list->stride - 1) / list->stride, row = kd_particle_list_row(list);
    list->n = list->n ? list->n : there;
    if (list->n > there)
        return kd_error_field(error, "/count",
                              "count is %zu; it must be 1 to %zu for %u particles with first %u and stride %u", list->n,
                              there, list->grid.count, list->first, list->stride);
    if (most && list->n * row > most)
        return kd_error_field(error, "/count",
                              "count is %zu with %zu bytes a particle; it must be 1 to %llu in one answer; first "
                              "selects the rest, and a larger stride selects fewer",
                              list->n, row, (unsigned long long)(most / row));
    list->orbits = needs_orbits(list);
    if (list->orbits)
        list->plunge = kd_plunge_of(kd_scene_hole(&list->scene));
    return KD_OK;
}

size_t kd_particle_list_row(const struct kd_particle_list *list) { return list->n_columns * sizeof(float); }

void kd_particle_list_names(const struct kd_particle_list *list, char out[KD_PARTICLE_NAMES])
{
    char *to = out;
    for (size_t i = 0; i < list->n_columns; i++) {
        if (i)
            *to++ = ',';
        to = stpcpy(to, names[list->columns[i]]);
    }
}

/* Fills in the derivatives of the formulas in particles.h. */
static void fill_rates(double *row, const struct kd_particle_list *list, uint32_t particle,
                       const struct kd_particle_orbit *o)
{
    const struct kd_particle_swing s = kd_particle_swing(&list->scene, particle);
    double t = list->scene.top.time, radial = o->kappa * t + s.radial_phase,
           vertical = o->vertical * t + s.vertical_phase;
    row[KD_PARTICLE_dr_dt] = -row[KD_PARTICLE_r] * o->swing_r * s.radial * o->kappa * sin(radial);
    row[KD_PARTICLE_dphi_dt] = o->omega + o->swing_phi * s.radial * o->kappa * cos(radial);
    row[KD_PARTICLE_dlatitude_dt] = -list->scene.disk.epicycles * s.vertical * o->vertical * sin(vertical);
}

static void fill_fall(double *row, const struct kd_plunge *plunge)
{
    const struct kd_plunge_velocity u = kd_plunge_velocity(plunge, row[KD_PARTICLE_r]);
    row[KD_PARTICLE_energy] = plunge->energy;
    row[KD_PARTICLE_angular_momentum] = plunge->momentum;
    row[KD_PARTICLE_dr_dt] = u.ur / u.ut;
    row[KD_PARTICLE_dphi_dt] = u.uphi / u.ut;
    row[KD_PARTICLE_dlatitude_dt] = 0;
}

static void find_guide(struct guide *guide, const struct kd_particle_list *list, uint32_t particle)
{
    uint32_t number = kd_particle_guide(&list->grid, particle);
    if (guide->number == number)
        return;
    const struct kd_particle_orbit o = kd_particle_orbit(&list->scene, list->grid.radii, number);
    const struct kd_hole *hole = kd_scene_hole(&list->scene);
    *guide = (struct guide) { number, o, kd_kerr_energy(hole, o.r), kd_kerr_momentum(hole, o.r) };
}

static void fill_row(double *row, const struct kd_particle_list *list, uint32_t particle,
                     const struct kd_particle_place *place, struct guide *guide)
{
    double r = place->r, phi = place->phi * (2 * M_PI / 4294967296.0), a = list->scene.spacetime.spin;
    double around = sqrt(r * r + a * a) * cos(place->latitude);
    row[KD_PARTICLE_r] = r;
    row[KD_PARTICLE_phi] = phi;
    row[KD_PARTICLE_latitude] = place->latitude;
    row[KD_PARTICLE_x] = around * cos(phi);
    row[KD_PARTICLE_y] = around * sin(phi);
    row[KD_PARTICLE_z] = r * sin(place->latitude);
    if (!list->orbits)
        return;
    if (place->plunging) {
        fill_fall(row, &list->plunge);
        return;
    }
    find_guide(guide, list, particle);
    row[KD_PARTICLE_energy] = guide->energy;
    row[KD_PARTICLE_angular_momentum] = guide->momentum;
    fill_rates(row, list, particle, &guide->orbit);
}

enum kd_status kd_particle_list_ask(struct kd_renderer *renderer, const struct kd_particle_list *list)
{
    struct kd_emitter_buffers_work work;
    const enum kd_status status = kd_prepare_asked(renderer, KD_EMITTER_particles, &work, NULL);
    return status ? status : kd_particles_ask(&work, &list->scene);
}

enum kd_status kd_particle_list_fill(struct kd_renderer *renderer, const struct kd_particle_list *list, size_t from,
                                     size_t n, float *rows, struct kd_error *error)
{
    struct kd_particle_place *places = malloc(n * sizeof *places);
    if (!places)
        return kd_error_set(error, KD_ENOMEM, "out of memory for %zu particles", n);
    uint32_t first = list->first + (uint32_t)from * list->stride;
    struct kd_emitter_buffers_work work;
    enum kd_status status = kd_prepare_asked(renderer, KD_EMITTER_particles, &work, error);
    if (!status)
        status = kd_particles_places(&work, &list->scene, first, list->stride, n, places, error);
    struct guide guide = { .number = UINT32_MAX };
    for (size_t i = 0; i < n && !status; i++) {
        double row[KD_PARTICLE_N_COLUMNS];
        fill_row(row, list, first + (uint32_t)i * list->stride, &places[i], &guide);
        for (size_t k = 0; k < list->n_columns; k++)
            *rows++ = (float)row[list->columns[k]];
    }
    free(places);
    return status;
}
