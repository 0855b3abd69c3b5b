/* Turbulent gas as an emitter: shaders/emit/gas.glsl. */
#include "render/emit/emitter.h"

#include "physics/spacetime/kerr.h"
#include "render/emit/particles.h"
#include "scene/hole.h"

#include <math.h>

/* Displacement of each octave where the octave before it is one standard deviation from its mean. The unit is the
 * width of the displaced octave's cells. With this value streaks bend but do not tear. */
#define WARP 0.2
/* Mean square slope of each of the two noises, along an axis and per cell. The amount by which a displacement
 * steepens an octave is proportional to this slope. */
#define STEEPNESS 16.6
/* Ratio of the amplitudes of successive octaves of the logarithm. Each octave has KD_GAS_FINER times as many cells as
 * the octave before. By Kolmogorov's law its amplitude is smaller by the cube root of KD_GAS_FINER. */
#define PERSISTENCE 0.72

static bool present(const struct kd_scene *scene)
{
    int model = scene->disk.model;
    return (model == KD_DISK_NOVIKOV_THORNE || model == KD_DISK_SHAKURA_SUNYAEV) &&
           (scene->gas.amplitude > 0 || scene->disk.emission_opacity > 0) && scene->disk.height == 0;
}

static bool stirs(const struct kd_scene *scene) { return scene->gas.amplitude > 0; }

static uint32_t traits(const struct kd_scene *scene)
{
    return kd_disk_traits(scene) | (scene->disk.slow_light ? KD_TRAIT_SLOW : 0) |
           (scene->disk.emission_opacity > 0 ? KD_TRAIT_GAS_DEEP : 0) |
           (stirs(scene) ? (uint32_t)scene->gas.octaves << KD_TRAIT_GAS_SHIFT : 0);
}

/* if rays are not on a grid, Carter's Q is computed from their slope */
static uint32_t needs(const struct kd_scene *scene)
{
    return kd_disk_needs(scene) | (stirs(scene) ? kd_orbit_needs(scene) | KD_LENS_SHAPE : 0) |
           (scene->disk.emission_opacity > 0 && scene->camera.projection == KD_PROJECTION_RING ? KD_LENS_SLOPE : 0);
}

static unsigned varies(const struct kd_scene *scene) { return stirs(scene) ? kd_orbit_varies(scene) : 0; }

static double inner_radius(const struct kd_scene *scene)
{
    return isinf(scene->disk.inner) ? kd_kerr_isco(kd_scene_hole(scene)) : scene->disk.inner;
}

/* Amplitude of the first octave. With it, the logarithm (the sum of all octaves) has the standard deviation
 * `amplitude`. */
static double loudness(const struct kd_scene *scene)
{
    double sum = 0;
    for (int k = 0; k < scene->gas.octaves; k++)
        sum += pow(PERSISTENCE, 2 * k);
    return scene->gas.amplitude / sqrt(sum);
}

static void tell(const struct kd_scene *scene, char out[KD_EMIT_TOLD])
{
    kd_disk_tell(scene, stirs(scene) ? "thin disk of turbulent gas" : "thin disk", out);
}

static void fill(struct kd_emission *out, const struct kd_scene *scene)
{
    out->gas = (struct kd_gas_block) {
        .first = (float)log2(inner_radius(scene)),
        .cells = (float)(1 / scene->gas.scale),
        .shear = (float)scene->gas.shear,
        .warp = (float)WARP,
        .loudness = (float)loudness(scene),
        .persistence = (float)PERSISTENCE,
        .finer = (float)(KD_GAS_FINER * KD_GAS_FINER * (1 + WARP * WARP * STEEPNESS)),
        .depth = (float)scene->disk.emission_opacity,
    };
}

/* A random number, uniform in [0, 1): splitmix64 (Steele, Lea & Flood 2014) of a counter. */
static double random_of(uint64_t seed, uint64_t n)
{
    uint64_t x = (seed << 32) + n * 0x9e3779b97f4a7c15u;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return (double)((x ^ (x >> 31)) >> 11) * 0x1p-53;
}

/* A place on the lattice, which repeats after 65536 cells, split into whole cells and the fraction of a cell. */
static void place(double at, float *part, float *whole)
{
    at -= 65536 * floor(at / 65536);
    *whole = (float)floor(at);
    *part = (float)(at - floor(at));
}

/* Computes, for each ring, the complex factor that converts a place in the ring's plane to the same place in the next
 * ring's plane. The factor rotates and shrinks. */
static void next_rings(struct kd_emit_tables *out, const struct kd_scene *scene)
{
    for (int j = 0; j + 1 < KD_GAS_RINGS; j++) {
        float *row = out->gas[j * (KD_GAS_OCTAVES + 1)];
        const double turn =
            (double)row[0] - out->gas[(j + 1) * (KD_GAS_OCTAVES + 1)][0] - scene->gas.shear * KD_GAS_RING;
        row[2] = (float)(exp(-KD_GAS_RING) * cos(turn));
        row[3] = (float)(exp(-KD_GAS_RING) * sin(turn));
    }
}

static void tables(struct kd_emit_tables *out, const struct kd_scene *scene)
{
    double r_in = inner_radius(scene), time = scene->top.time - kd_particle_delay(scene);
    uint64_t n = 0, seed = (uint64_t)scene->gas.seed;
    for (int j = 0; j < KD_GAS_RINGS; j++) {
        float (*row)[4] = &out->gas[j * (KD_GAS_OCTAVES + 1)];
        double omega = kd_kerr_omega(kd_scene_hole(scene), r_in * exp(KD_GAS_RING * j)), turned = omega * time;
        double phase =
            2 * M_PI * random_of(seed, ++n) + remainder(turned, 2 * M_PI) - scene->camera.azimuth_deg * (M_PI / 180);
        row[0][0] = (float)remainder(phase, 2 * M_PI);
        row[0][1] = (float)omega;
        for (int k = 0; k < KD_GAS_OCTAVES; k++) {
            double way = turned * KD_GAS_DRIFT * pow(KD_GAS_HASTE, k), angle = 2.4 * k;
            place(65536 * random_of(seed, ++n) + way * cos(angle), &row[1 + k][0], &row[1 + k][2]);
            place(65536 * random_of(seed, ++n) + way * sin(angle), &row[1 + k][1], &row[1 + k][3]);
        }
    }
    next_rings(out, scene);
}

#define WHEN(name, condition) \
    static bool name(const struct kd_scene *scene, const struct kd_setting *rays) { return (void)rays, condition; }
WHEN(turbulent, stirs(scene))
WHEN(deep, scene->disk.emission_opacity > 0 && scene->disk.height == 0)
WHEN(fast, stirs(scene) && !scene->disk.slow_light)

static const struct kd_sentence sentences[] = {
    { "gas.turbulence",
      "gas: turbulence is procedural noise, not a solution of magnetohydrodynamics; it multiplies the flux, which "
      "changes temperature and colour, and the optical depth if disk.emission_opacity is not 0",
      turbulent },
    { "gas.rings",
      "gas: the pattern consists of rigid rings that blend into each other; each ring turns with the angular velocity "
      "of its middle, so that the pattern does not shear",
      turbulent },
    { "gas.octaves",
      "gas: octaves of the turbulence that are finer than a ray's footprint on the disk are replaced by their mean; "
      "the light then varies with time up to a tenth less than with 64 rays a pixel",
      turbulent },
    { "gas.fast", "gas: the gas is shown at one coordinate time, and the delay of its light is ignored (fast light)",
      fast },
    { "gas.depth",
      "gas: the disk's optical depth is grey and proportional to its flux, with a chosen value at the brightest "
      "radius; at a crossing it is divided by the cosine of the angle of emission",
      deep },
};

const struct kd_emitter kd_emit_gas = {
    .name = "gas",
    .title = "gas",
    .tell = tell,
    .present = present,
    .traits = traits,
    .needs = needs,
    .varies = varies,
    .reach = kd_disk_reach,
    .fill = fill,
    .tables = tables,
    .depends = { KD_SCENE_PART(spacetime), KD_SCENE_PART(camera), KD_SCENE_PART(disk), KD_SCENE_PART(gas),
                 KD_SCENE_PART(top) },
    .sentences = sentences,
    .n_sentences = sizeof sentences / sizeof *sentences,
    .kind = &kd_emit_disk,
    .reads = &kd_emit_disk,
    .replaces = &kd_emit_disk,
};
