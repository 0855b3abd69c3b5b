#include "render/emit/tables.h"

#include "physics/colour.h"
#include "physics/disk.h"
#include "physics/kerr.h"
#include "render/emit/particles.h"
#include "render/emit/plunging.h"

#include <math.h>

_Static_assert(KD_SPOT_MAX == KD_SPOTS, "those of a scene");

static kd_disk_flux_fn flux_of(const struct kd_scene *scene)
{
    return scene->disk.model == KD_DISK_SHAKURA_SUNYAEV ? kd_disk_flux_shakura_sunyaev : kd_disk_flux_page_thorne;
}

static double largest_flux(const struct kd_scene *scene)
{
    double a = scene->spacetime.spin;
    bool newton = scene->disk.model == KD_DISK_SHAKURA_SUNYAEV;
    return flux_of(scene)(a, newton ? kd_disk_peak_shakura_sunyaev(a) : kd_disk_peak_page_thorne(a));
}

double kd_tables_peak_temperature(const struct kd_scene *scene)
{
    double a = scene->spacetime.spin;
    if (scene->disk.colour == KD_COLOUR_PEAK)
        return scene->disk.peak_temperature_k;
    return kd_disk_temperature(largest_flux(scene), a, scene->spacetime.mass_msun, scene->disk.mdot_edd);
}

/* T r^(3/4) is smooth and bounded in y = sqrt(1 - r_isco/r): linear at the ISCO, where the flux has a double zero, and
 * finite at infinity, where T falls as r^(-3/4). */
static void fill_disk(float *table, const struct kd_scene *scene)
{
    kd_disk_flux_fn flux = flux_of(scene);
    double a = scene->spacetime.spin, isco = kd_kerr_isco(a), peak = largest_flux(scene);
    for (int i = 0; i < KD_DISK_TABLE; i++) {
        double y = fmin((double)i / (KD_DISK_TABLE - 1), 1 - 1e-6), r = isco / (1 - y * y);
        table[i] = (float)(pow(flux(a, r) / peak, 0.25) * pow(r, 0.75));
    }
}

static void fill_colours(float (*table)[4])
{
    for (int i = 0; i < KD_COLOUR_TABLE; i++) {
        double t = exp2(KD_COLOUR_LOG_MIN + i * (KD_COLOUR_LOG_MAX - KD_COLOUR_LOG_MIN) / (KD_COLOUR_TABLE - 1));
        struct kd_colour_rgb c = kd_colour_blackbody_unit(t);
        table[i][0] = (float)c.r;
        table[i][1] = (float)c.g;
        table[i][2] = (float)c.b;
    }
}

/* Fourth column: log2 of the luminous fraction over its value at the disk's hottest place. */
static void fill_luminous(float (*table)[4], double peak)
{
    double reference = log2(fmax(kd_colour_luminous_fraction(peak), 1e-300));
    for (int i = 0; i < KD_COLOUR_TABLE; i++) {
        double t = exp2(KD_COLOUR_LOG_MIN + i * (KD_COLOUR_LOG_MAX - KD_COLOUR_LOG_MIN) / (KD_COLOUR_TABLE - 1));
        table[i][3] = (float)fmax(log2(fmax(kd_colour_luminous_fraction(t), 1e-300)) - reference, -120);
    }
}

/* Beyond this many sizes there is less than 1e-9 of the peak. */
#define SPOT_REACH 6.44

static void fill_spots(struct kd_spot_block *out, const struct kd_scene *scene)
{
    const struct kd_spot *on[KD_SPOTS];
    size_t n = kd_scene_spots(scene, on);
    double degrees = M_PI / 180, time = scene->top.time - kd_particle_delay(scene);
    for (size_t i = 0; i < n; i++) {
        double omega = kd_kerr_omega(scene->spacetime.spin, on[i]->r), size = on[i]->size;
        double phase = remainder(omega * time, 2 * M_PI) + (on[i]->phase_deg - scene->camera.azimuth_deg) * degrees;
        out[i] = (struct kd_spot_block) {
            .r = (float)on[i]->r,
            .phi = (float)remainder(phase, 2 * M_PI),
            .omega = (float)omega,
            .sharp = (float)(M_LOG2E / (2 * size * size)),
            .reach = (float)(SPOT_REACH * SPOT_REACH * size * size),
            .brightness = (float)on[i]->brightness,
            .power = (float)(3 + on[i]->index),
            .log_t = (float)log2(on[i]->temperature_k),
        };
    }
}

static double ringing(const struct kd_scene *scene)
{
    double wave;
    return kd_scene_ringdown(scene, &wave) ? 1 + scene->style.ringdown * wave : 1;
}

/* Both t and phi of the plunge are smooth in log (r_isco - r)/(r - r+): powers near one end, logarithms at the other. */
static void fill_plunge(struct kd_transfer_data *out, const struct kd_scene *scene, const struct kd_particle_grid *grid)
{
    const struct kd_plunging p = kd_plunging_of(scene);
    double r0 = p.curve.isco, r_h = p.curve.horizon;
    double first = log2((r0 - p.start) / (p.start - r_h)), last = log2((r0 - p.end) / (p.end - r_h));
    for (int i = 0; i < KD_PLUNGE_TABLE; i++) {
        double ratio = exp2(first + (last - first) * i / (KD_PLUNGE_TABLE - 1)), r = (r0 + ratio * r_h) / (1 + ratio);
        const struct kd_plunging_place at = kd_plunging_at(&p, r);
        out->plunge[i][0] = (float)at.phase;
        out->plunge[i][1] = (float)at.turns;
    }
    struct kd_transfer_block *b = &out->block;
    b->plunge_first = (float)(1 / p.start);
    b->plunge_last = (float)(1 / p.end);
    b->plunge_energy = (float)p.curve.energy;
    b->plunge_j = (float)(p.curve.momentum - scene->spacetime.spin * p.curve.energy);
    b->plunge_temperature = (float)scene->disk.plunging_temperature;
    b->plunge_depth = (float)kd_particle_plunge_depth(scene);
    b->plunge_log = (float)first;
    b->plunge_step = (float)((KD_PLUNGE_TABLE - 1) / (last - first));
    b->plunge_laps = (float)(1 / p.time);
    b->plunge_turns = (float)(p.omega / (2 * M_PI));
    b->plunge_at = (grid->rows + 1) * grid->columns;
    b->plunge_rows = grid->plunge_rows;
    b->plunge_columns = grid->plunge_columns;
    b->lap_rows = grid->lap_rows;
    b->lead_rows = grid->lead_rows;
}

void kd_tables_fill(struct kd_transfer_data *out, const struct kd_scene *scene, bool fill_colour)
{
    const struct kd_disk *disk = &scene->disk;
    double isco = kd_kerr_isco(scene->spacetime.spin), r_in = isinf(disk->inner) ? isco : disk->inner;
    double peak = kd_tables_peak_temperature(scene) * disk->hardening;

    if (fill_colour)
        fill_colours(out->colour);
    if (disk->model != KD_DISK_NONE) {
        fill_disk(out->disk, scene);
        if (disk->band == KD_BAND_VISIBLE)
            fill_luminous(out->colour, peak);
    }
    fill_spots(out->spots, scene);
    const struct kd_particle_grid grid = kd_particle_grid(scene);
    out->block = (struct kd_transfer_block){
        .r_isco = (float)isco,
        .r_in = (float)r_in,
        .r_out = (float)disk->outer,
        .taper_r = (float)(disk->outer * (1 - disk->taper)),
        .opacity = (float)disk->opacity,
        .log_t_peak = (float)log2(peak),
        .sky_brightness = (float)scene->sky.brightness,
        .sky_grid = (float)(scene->sky.grid_deg * (M_PI / 180)),
        .azimuth = (float)(scene->camera.azimuth_deg * (M_PI / 180)),
        .one_minus_a = (float)(1 - scene->spacetime.spin),
        .pixels_x = (uint32_t)scene->image.width,
        .rows = grid.rows,
        .columns = grid.columns,
        .delay = (float)kd_particle_delay(scene),
        .rows_octave = (float)(grid.rows / log2(disk->outer / r_in)),
        .ringing = (float)ringing(scene),
    };
    if (grid.plunging)
        fill_plunge(out, scene, &grid);
}
