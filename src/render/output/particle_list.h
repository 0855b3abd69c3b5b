/* Lists the particles of a disk as numbers: one row for each particle, 32-bit floats, in the order of the requested
 * columns.
 *
 *     struct kd_particle_list list;
 *     kd_particle_list_init(&list, &scene, &error)                    a valid scene
 *     kd_particle_list_set(&list, "fields", "r,phi,energy", &error)   and "first", "stride", "count", "time"
 *     kd_particle_list_settle(&list, most_bytes, &error)
 *     for (size_t i = 0; i < list.n; i += n)
 *         kd_particle_list_fill(renderer, &list, i, n = ..., rows, &error);
 *
 * Coordinates are Boyer-Lindquist t, r, theta, phi; x = sqrt(r^2 + a^2) cos(latitude) cos(phi), y likewise with
 * sin(phi), z = r sin(latitude): the ellipsoidal coordinates that Boyer-Lindquist ones become for M -> 0. Any thread,
 * except _fill. */
#ifndef KD_RENDER_OUTPUT_PARTICLE_LIST_H
#define KD_RENDER_OUTPUT_PARTICLE_LIST_H

#include "physics/orbit/plunge.h"
#include "render/emit/particles.h"
#include "render/device/renderer.h"

/* COLUMN(name, unit, help) */
#define KD_PARTICLE_COLUMNS(COLUMN) \
    COLUMN(x, "M", "sqrt(r^2 + a^2) cos(latitude) cos(phi)") \
    COLUMN(y, "M", "sqrt(r^2 + a^2) cos(latitude) sin(phi)") \
    COLUMN(z, "M", "r sin(latitude)") \
    COLUMN(r, "M", "Boyer-Lindquist radius") \
    COLUMN(phi, "radians", "azimuth, 0 to 2 pi") \
    COLUMN(latitude, "radians", "pi/2 - theta") \
    COLUMN(energy, "1", "constant energy: that of the guiding orbit, or of the ISCO from which it fell") \
    COLUMN(angular_momentum, "M", "constant L: that of the guiding orbit, or of the ISCO from which it fell") \
    COLUMN(dr_dt, "1", "derivative of r by coordinate time") \
    COLUMN(dphi_dt, "1/M", "derivative of phi by coordinate time") \
    COLUMN(dlatitude_dt, "1/M", "derivative of the latitude by coordinate time")

enum kd_particle_column {
#define COLUMN(name, ...) KD_PARTICLE_##name,
    KD_PARTICLE_COLUMNS(COLUMN)
#undef COLUMN
        KD_PARTICLE_N_COLUMNS
};
const char *kd_particle_column_name(enum kd_particle_column column);

#define KD_PARTICLE_LIST_SLICE 131072u /* rows of one fill: about 20 ms of the render thread */

struct kd_particle_list {
    struct kd_scene scene; /* the scene at the requested time */
    struct kd_particle_grid grid;
    uint32_t first, stride;
    size_t n; /* number of rows; 0 before settle means all */
    enum kd_particle_column columns[KD_PARTICLE_N_COLUMNS];
    size_t n_columns;
    bool orbits;             /* true if some column needs the orbits */
    struct kd_plunge plunge; /* the curve of falling particles; set if `orbits` is true */
};

/* Returns KD_EINVAL at /disk/model if the scene has no particles. */
enum kd_status kd_particle_list_init(struct kd_particle_list *list, const struct kd_scene *scene,
                                     struct kd_error *error);
/* Returns KD_EINVAL with "/name", the value and its valid range. */
enum kd_status kd_particle_list_set(struct kd_particle_list *list, const char *name, const char *text,
                                    struct kd_error *error);
/* Returns KD_EINVAL if more rows are requested than exist, or if they take more than `most` bytes (0: no limit). */
enum kd_status kd_particle_list_settle(struct kd_particle_list *list, uint64_t most, struct kd_error *error);

size_t kd_particle_list_row(const struct kd_particle_list *list); /* bytes of a row */
/* "x,y,z" */
enum { KD_PARTICLE_NAMES = 120 };
void kd_particle_list_names(const struct kd_particle_list *list, char out[KD_PARTICLE_NAMES]);

/* Computes n <= KD_PARTICLE_LIST_SLICE rows, from row `from` on. Render thread only. */
enum kd_status kd_particle_list_fill(struct kd_renderer *renderer, const struct kd_particle_list *list, size_t from,
                                     size_t n, float *rows, struct kd_error *error);
/* Requests the kernel that _fill needs, for kd_kernels_note. */
enum kd_status kd_particle_list_ask(struct kd_renderer *renderer, const struct kd_particle_list *list);

#endif
