#include "render/emit/particles.h"

#include "render/emit/emitter.h"

#include "physics/spacetime/epicyclic.h"
#include "physics/spacetime/kerr.h"
#include "render/emit/deposit.h"
#include "render/emit/plunging.h"
#include "render/view/layout.h"
#include "scene/hole.h"

#include <math.h>
#include <stdio.h>

/* mean number of particles in a cell. With this number the density fluctuates by a third, in spots some pixels wide */
#define PER_CELL 5.0

static double inner(const struct kd_scene *scene)
{
    return isinf(scene->disk.inner) ? kd_kerr_isco(kd_scene_hole(scene)) : scene->disk.inner;
}

/* Range of guiding orbits. The range exceeds the edges of the disk by the particles' swing, so that as many particles
 * cross the edges inwards as outwards. */
struct span { double low, high, s; };
static struct span span_of(const struct kd_scene *scene)
{
    double reach = scene->disk.epicycles;
    return (struct span) {
        .low = fmax(kd_kerr_isco(kd_scene_hole(scene)), inner(scene) * (1 - reach)),
        .high = scene->disk.outer * (1 + reach),
        /* particles per area fall as r^-p, so the number inside r is proportional to r^s - low^s */
        .s = 2 - scene->disk.density_index,
    };
}

double kd_particle_radius(const struct kd_scene *scene, double q)
{
    const struct span o = span_of(scene);
    double all = log(o.high / o.low);
    return o.low * exp(o.s == 0 ? q * all : log1p(q * expm1(o.s * all)) / o.s);
}

/* Fraction of the particles per unit of ln r. */
static double density(const struct kd_scene *scene, double r)
{
    const struct span o = span_of(scene);
    double all = log(o.high / o.low);
    return o.s == 0 ? 1 / all : o.s * exp(o.s * log(r / o.low)) / expm1(o.s * all);
}

/* Each cell of the plunge's grid is a parcel of falling gas that holds one particle on average. Columns are parcels
 * round the ISCO, and rows are parcels from start to end. There are three times as many columns as rows, so that
 * half-way down a parcel is about as wide as it is long. Slow light needs further rows. Light with a longer delay shows
 * parcels that fell in earlier. Light from the near side of the disk shows parcels that have not started yet. The
 * constants are the longest such times in M. LATE grows with the order, because light takes half a turn longer for each
 * order. */
#define EARLY 20.0
#define LATE 50.0
#define LATE_PER_ORDER 25.0

static void plunge_grid(struct kd_particle_grid *g, const struct kd_scene *scene)
{
    g->plunging = kd_plunging_is_on(scene) ? (uint32_t)round(scene->disk.plunging * g->count) : 0;
    if (!g->plunging)
        return;
    double columns = sqrt(3.0 * g->plunging);
    g->plunge_columns = 64;
    while (g->plunge_columns < 2048 && g->plunge_columns * M_SQRT2 < columns)
        g->plunge_columns *= 2;
    g->lap_rows = (uint32_t)fmax(16, fmin((double)g->plunging / g->plunge_columns, 1024));
    g->plunge_rows = g->lap_rows;
    if (!scene->disk.slow_light)
        return;
    double rate = g->lap_rows / kd_plunging_of(scene).time;
    g->lead_rows = (uint32_t)ceil(EARLY * rate);
    double more = ceil((LATE + LATE_PER_ORDER * scene->accuracy.orders) * rate);
    g->plunge_rows = (uint32_t)fmin(g->lead_rows + g->lap_rows + more, KD_PARTICLE_ROWS);
}

/* Number of guiding radii. Each row of the grid has at least five radii, and each radius at least one particle. The
 * radii are spread evenly: a node gets its expected number of particles within 1 %. That is the Poisson error of a row
 * of 10 000 particles, the most that a row has. The row with the fewest radii is at one of the edges. */
static uint32_t radii_of(const struct kd_particle_grid *g, const struct kd_scene *scene)
{
    double all = log(scene->disk.outer / inner(scene));
    double share = fmin(density(scene, inner(scene)), density(scene, scene->disk.outer)) * all / g->rows;
    double radii = fmax(KD_PARTICLE_RADII, fmin(5 / share, KD_PARTICLE_RADII_MAX));
    return (uint32_t)fmin(radii, g->count - g->plunging);
}

/* Sizes in bytes. kd_particle_tables_bytes: of the buffer that holds the guiding orbits, the expected numbers of the
 * grid's rows, and the expected numbers of the plunge's rows. Each of the three begins at a multiple of 256 bytes.
 * kd_particle_guides_bytes: of the first of the three. */
uint64_t kd_particle_guides_bytes(const struct kd_particle_grid *g)
{
    return (g->radii * sizeof(struct kd_guide) + 255) / 256 * 256;
}
uint64_t kd_particle_tables_bytes(const struct kd_particle_grid *g)
{
    return kd_particle_guides_bytes(g) + 2 * KD_PARTICLE_EXPECTED_BYTES;
}

/* Number of words of each grid. */
uint64_t kd_particle_words(const struct kd_particle_grid *g) { return (g->rows + 1ull) * g->columns; }
uint64_t kd_particle_plunge_words(const struct kd_particle_grid *g)
{
    return g->plunging ? (g->plunge_rows + 1ull) * g->plunge_columns : 0;
}

struct kd_particle_grid kd_particle_grid(const struct kd_scene *scene)
{
    if (scene->disk.model != KD_DISK_PARTICLES)
        return (struct kd_particle_grid) { 0 };
    struct kd_particle_grid g = { .count = (uint32_t)scene->disk.particles };
    double all = log(scene->disk.outer / inner(scene)), columns = sqrt(g.count * (2 * M_PI / PER_CELL) / all);
    g.columns = 64;
    while (g.columns < KD_PARTICLE_ROWS && g.columns * M_SQRT2 < columns)
        g.columns *= 2;
    g.rows = (uint32_t)fmax(4, fmin(g.count / (PER_CELL * g.columns), KD_PARTICLE_ROWS));
    plunge_grid(&g, scene);
    g.radii = radii_of(&g, scene);
    /* Particles are scattered at random, but a node practically never gets more than 64 plus twice the mean of the
     * fullest row. */
    double fullest = fmax(density(scene, inner(scene)), density(scene, scene->disk.outer)) * all;
    double unit = 65535 / (2 * fullest * g.count / ((double)g.rows * g.columns) + 64);
    g.unit = (uint32_t)fmax(1, fmin(unit, 1024));
    g.bytes = 8 * (kd_particle_words(&g) + kd_particle_plunge_words(&g)) + kd_particle_tables_bytes(&g);
    return g;
}

/* 2^31 radii/particles, rounded down. The kernel multiplies by the same factor, so that both round in the same way. */
static uint32_t per_particle(const struct kd_particle_grid *grid)
{
    return (uint32_t)(((uint64_t)grid->radii << 31) / (grid->count - grid->plunging));
}

uint32_t kd_particle_guide(const struct kd_particle_grid *grid, uint32_t particle)
{
    return (uint32_t)((2ull * (particle - grid->plunging) + 1) * per_particle(grid) >> 32);
}

struct kd_particle_orbit kd_particle_orbit(const struct kd_scene *scene, uint32_t radii, uint32_t k)
{
    const struct kd_hole *hole = kd_scene_hole(scene);
    double r = kd_particle_radius(scene, (k + 0.5) / radii);
    struct kd_particle_orbit o = {
        .r = r,
        .omega = kd_kerr_omega(hole, r),
        .kappa = kd_epicyclic_radial(hole, r),
        .vertical = kd_epicyclic_vertical(hole, r),
    };
    double share = o.kappa / o.omega, reach = scene->disk.epicycles * r * share * share;
    o.swing_r = reach / r;
    o.swing_phi = o.kappa > 0 ? reach / o.kappa * kd_epicyclic_shear(hole, r) : 0;
    return o;
}

static uint32_t hash(uint32_t x)
{
    x = (x ^ x >> 16) * 0x7feb352du;
    x = (x ^ x >> 15) * 0x846ca68bu;
    return x ^ x >> 16;
}

static uint32_t key_of(const struct kd_scene *scene) { return hash((uint32_t)scene->disk.seed + 0x9e3779b9u); }

/* Draws the same random numbers as the kernel. */
struct kd_particle_swing kd_particle_swing(const struct kd_scene *scene, uint32_t particle)
{
    uint32_t key = key_of(scene), random = hash(particle ^ key);
    uint32_t radial = hash(random + 0x9e3779b9u), vertical = hash(random + 0x3c6ef372u);
    return (struct kd_particle_swing) {
        .radial = sqrt((hash(radial ^ key) >> 8) * 0x1p-24),
        .radial_phase = radial * (2 * M_PI / 4294967296.0),
        .vertical = sqrt((hash(vertical ^ key) >> 8) * 0x1p-24),
        .vertical_phase = vertical * (2 * M_PI / 4294967296.0),
    };
}

/* The phase rate t modulo one turn, in units of 2^-32 turns. */
static uint32_t turns(double rate, double t)
{
    double phase = rate * t / (2 * M_PI);
    return (uint32_t)(uint64_t)((phase - floor(phase)) * 4294967296.0);
}

static double rows_of(const struct kd_scene *scene, const struct kd_particle_grid *grid)
{
    return grid->rows / log(scene->disk.outer / inner(scene));
}

static void fill_guides(struct kd_guide *out, const struct kd_scene *scene, const struct kd_particle_grid *grid,
                        double time)
{
    double rows = rows_of(scene, grid), r_in = inner(scene);
    for (uint32_t k = 0; k < grid->radii; k++) {
        struct kd_particle_orbit o = kd_particle_orbit(scene, grid->radii, k);
        out[k] = (struct kd_guide) {
            .phi = turns(o.omega, time),
            .radial = turns(o.kappa, time),
            .vertical = turns(o.vertical, time),
            .row = (float)(rows * log(o.r / r_in)),
            .swing_row = (float)(rows * o.swing_r),
            .swing_phi = (float)(o.swing_phi / (2 * M_PI)),
        };
    }
}

/* Fills in, for each row, the reciprocal of the expected weight of a node. A particle contributes to a node if it is
 * within one row of the node. The particle's weight depends on its distance from the node. */
static void fill_expected(float *out, const struct kd_scene *scene, const struct kd_particle_grid *grid)
{
    enum { PARTS = 8 }; /* number of parts into which each side of the triangular weight is divided */
    double rows = rows_of(scene, grid), weight = (double)(grid->count - grid->plunging) * grid->unit / grid->columns;
    for (uint32_t i = 0; i <= grid->rows; i++) {
        double sum = 0;
        for (int k = -PARTS; k < PARTS; k++) {
            double off = (k + 0.5) / PARTS, x = i + off;
            if (x > 0 && x < grid->rows)
                sum += (1 - fabs(off)) / PARTS * density(scene, inner(scene) * exp(x / rows)) / rows;
        }
        out[i] = (float)(1 / (weight * sum));
    }
}

/* Like fill_expected, for the plunge, whose particles are evenly spread in phase. */
static void fill_plunge_expected(float *out, const struct kd_particle_grid *grid)
{
    double weight = (double)grid->plunging * grid->unit / grid->plunge_columns / grid->lap_rows;
    for (uint32_t i = 0; i <= grid->plunge_rows; i++)
        out[i] = (float)((i == 0 || i == grid->plunge_rows ? 2 : 1) / weight);
}

/* A stream of N particles in a time P has N/(P 2 pi r |u^r|) particles per area in the particles' own frame. For
 * particles on circular orbits, n per ln r, the number per area is n/(2 pi r^2 u^t). */
double kd_particle_plunge_depth(const struct kd_scene *scene)
{
    const struct kd_hole *hole = kd_scene_hole(scene);
    double isco = kd_kerr_isco(hole), share = scene->disk.plunging;
    return share / (1 - share) * isco * isco * kd_kerr_ut(hole, isco) /
           (density(scene, isco) * kd_plunging_of(scene).time);
}

double kd_particle_delay(const struct kd_scene *scene)
{
    return scene->disk.slow_light && isfinite(scene->camera.r) ? scene->camera.r : 0;
}

void kd_particle_tables_fill(void *out, const struct kd_scene *scene, const struct kd_particle_grid *grid, double time)
{
    char *expected = (char *)out + kd_particle_guides_bytes(grid);
    fill_guides(out, scene, grid, time);
    fill_expected((float *)expected, scene, grid);
    if (grid->plunging)
        fill_plunge_expected((float *)(expected + KD_PARTICLE_EXPECTED_BYTES), grid);
}

struct kd_particles_push kd_particle_push(const struct kd_scene *scene, const struct kd_particle_grid *grid,
                                          double time)
{
    struct kd_particles_push push = {
        .key = key_of(scene),
        .stride = 1,
        .per_particle = per_particle(grid),
        .rows = grid->rows,
        .columns_log2 = (uint32_t)__builtin_ctz(grid->columns),
        .unit = grid->unit,
        .tilt = (float)scene->disk.epicycles,
    };
    if (!grid->plunging)
        return push;
    const struct kd_plunging p = kd_plunging_of(scene);
    double laps = time / p.time, whole = floor(laps);
    push.plunging = grid->plunging;
    push.lap = (uint32_t)(int64_t)whole;
    push.phase = (uint32_t)(uint64_t)((laps - whole) * 4294967296.0);
    push.turn = turns(p.omega, time);
    push.plunge_at = (uint32_t)kd_particle_words(grid);
    push.plunge_rows = grid->plunge_rows;
    push.plunge_columns_log2 = (uint32_t)__builtin_ctz(grid->plunge_columns);
    push.lap_rows = grid->lap_rows;
    push.lead_rows = grid->lead_rows;
    return push;
}

void kd_particle_places_of(const struct kd_scene *scene, const struct kd_particle_grid *grid,
                           const struct kd_particle_listed *got, uint32_t first, uint32_t stride, size_t n,
                           struct kd_particle_place *out)
{
    double rows = rows_of(scene, grid), edge = inner(scene);
    struct kd_plunging_path path;
    if (first < grid->plunging) {
        const struct kd_plunging plunging = kd_plunging_of(scene);
        kd_plunging_path(&plunging, &path);
    }
    for (size_t i = 0; i < n; i++) {
        struct kd_particle_place *o = &out[i];
        *o = (struct kd_particle_place) {
            .phi = got[i].phi,
            .latitude = got[i].latitude,
            .plunging = first + i * stride < grid->plunging,
        };
        if (o->plunging) {
            double turned, r = kd_plunging_radius(&path, got[i].phase / 4294967296.0, &turned);
            o->r = (float)r;
            o->phi += turns(2 * M_PI, turned);
        } else {
            o->r = (float)(edge * exp(got[i].row / rows));
        }
    }
}

/* Particles as an emitter: shaders/emit/particles.glsl. */
static bool present(const struct kd_scene *scene) { return scene->disk.model == KD_DISK_PARTICLES; }

static uint32_t traits(const struct kd_scene *scene)
{
    return kd_disk_traits(scene) | (scene->disk.slow_light ? KD_TRAIT_SLOW : 0);
}

static void fill(struct kd_emission *out, const struct kd_scene *scene)
{
    const struct kd_particle_grid grid = kd_particle_grid(scene);
    out->particles = (struct kd_particles_block) {
        .rows = grid.rows,
        .columns = grid.columns,
        .rows_octave = (float)(grid.rows / log2(scene->disk.outer / inner(scene))),
    };
}

static uint32_t needs(const struct kd_scene *scene) { return kd_orbit_needs(scene) | kd_disk_needs(scene); }

static void tell(const struct kd_scene *scene, char out[KD_EMIT_TOLD])
{
    char noun[64];
    snprintf(noun, sizeof noun, "disk of %d particles", scene->disk.particles);
    kd_disk_tell(scene, noun, out);
}

static uint64_t device_bytes(const struct kd_scene *scene) { return kd_particle_grid(scene).bytes; }
static uint64_t invocations(const struct kd_scene *scene) { return kd_particle_grid(scene).count; }

static bool fast(const struct kd_scene *scene, const struct kd_setting *rays)
{
    return (void)rays, !scene->disk.slow_light;
}
static bool slow(const struct kd_scene *scene, const struct kd_setting *rays)
{
    return (void)rays, scene->disk.slow_light;
}

static const struct kd_sentence sentences[] = {
    { "particles.count",
      "particles: brightness is that of the smooth disk times the ratio of the number of particles to its mean; "
      "opacity is that of the smooth disk",
      NULL },
    { "particles.epicycles",
      "particles: particles move on epicycles, to first order, about circular orbits; their radial distribution is "
      "chosen; pressure and collisions are ignored",
      NULL },
    { "particles.fast",
      "particles: the whole disk is shown at one coordinate time, and the delay of its light is ignored (fast light)",
      fast },
    { "particles.slow",
      "particles: for the delay of their light they are moved on their guiding circles, without epicycles", slow },
};

const struct kd_emitter kd_emit_particles = {
    .name = "particles",
    .title = "particles",
    .tell = tell,
    .present = present,
    .traits = traits,
    .needs = needs,
    .varies = kd_orbit_varies,
    .own = &kd_emitter_buffers_particles,
    .device_bytes = device_bytes,
    .invocations = invocations,
    .reach = kd_disk_reach,
    .fill = fill,
    .depends = { KD_SCENE_PART(spacetime), KD_SCENE_PART(disk), KD_SCENE_PART(accuracy) },
    .sentences = sentences,
    .n_sentences = sizeof sentences / sizeof *sentences,
    .kind = &kd_emit_disk,
    .reads = &kd_emit_disk,
};
