/* Gas that plunges from the ISCO as an emitter: shaders/emit/plunge.glsl. */
#include "render/emit/emitter.h"

#include "render/emit/particles.h"
#include "render/emit/plunging.h"

#include <math.h>

/* A small share of the particles may be rounded to 0; there is no grid in that case. */
static bool present(const struct kd_scene *scene)
{
    return scene->disk.plunging_temperature > 0 && kd_plunging_is_on(scene) && kd_particle_grid(scene).plunging > 0;
}

static uint32_t needs(const struct kd_scene *scene) { return kd_orbit_needs(scene) | KD_LENS_SLOPE; }

/* t and phi of the plunge are smooth in log (r_isco - r)/(r - r+). At one end of this range t and phi are powers of
 * that ratio; at the other end they are logarithms of it. */
struct range { double first, last; };
static struct range range_of(const struct kd_plunging *p)
{
    double r0 = p->curve.isco, r_h = p->curve.hole.outer;
    return (struct range) { log2((r0 - p->start) / (p->start - r_h)), log2((r0 - p->end) / (p->end - r_h)) };
}

static void fill(struct kd_emission *out, const struct kd_scene *scene)
{
    const struct kd_particle_grid grid = kd_particle_grid(scene);
    const struct kd_plunging p = kd_plunging_of(scene);
    const struct range range = range_of(&p);
    out->plunge = (struct kd_plunge_block) {
        .first = (float)(1 / p.start),
        .last = (float)(1 / p.end),
        .energy = (float)p.curve.energy,
        .j = (float)(p.curve.momentum - scene->spacetime.spin * p.curve.energy),
        .stretch = (float)p.curve.stretch,
        .bend = (float)p.curve.bend,
        .temperature = (float)scene->disk.plunging_temperature,
        .depth = (float)kd_particle_plunge_depth(scene),
        .log_first = (float)range.first,
        .step_ = (float)((KD_PLUNGE_TABLE - 1) / (range.last - range.first)),
        .laps = (float)(1 / p.time),
        .turns = (float)(p.omega / (2 * M_PI)),
        .at = (grid.rows + 1) * grid.columns,
        .rows = grid.plunge_rows,
        .columns = grid.plunge_columns,
        .lap_rows = grid.lap_rows,
        .lead_rows = grid.lead_rows,
    };
}

static void tables(struct kd_emit_tables *out, const struct kd_scene *scene)
{
    const struct kd_plunging p = kd_plunging_of(scene);
    const struct range range = range_of(&p);
    for (int i = 0; i < KD_PLUNGE_TABLE; i++) {
        double ratio = exp2(range.first + (range.last - range.first) * i / (KD_PLUNGE_TABLE - 1));
        const struct kd_plunging_place at =
            kd_plunging_at(&p, (p.curve.isco + ratio * p.curve.hole.outer) / (1 + ratio));
        out->plunge[i][0] = (float)at.phase;
        out->plunge[i][1] = (float)at.turns;
    }
}

static void reach(const struct kd_scene *scene, double radii[2])
{
    const struct kd_plunging p = kd_plunging_of(scene);
    radii[0] = p.curve.hole.outer;
    radii[1] = p.curve.isco;
}

static const struct kd_sentence sentences[] = {
    { "plunge.free",
      "particles: inside the ISCO gas falls freely with the energy and angular momentum of the ISCO; it is grey and "
      "has one chosen temperature; its optical depth is the ratio of its surface density to the disk's at the ISCO; "
      "stress and heating are ignored",
      NULL },
};

const struct kd_emitter kd_emit_plunge = {
    .name = "plunge",
    .title = "plunging gas",
    .present = present,
    .traits = kd_disk_traits,
    .needs = needs,
    .varies = kd_orbit_varies,
    .reach = reach,
    .fill = fill,
    .tables = tables,
    .depends = { KD_SCENE_PART(spacetime), KD_SCENE_PART(disk), KD_SCENE_PART(accuracy) },
    .sentences = sentences,
    .n_sentences = sizeof sentences / sizeof *sentences,
    .reads = &kd_emit_disk,
};
