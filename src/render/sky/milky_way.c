/* The procedural Milky Way: a smooth band and a bulge, star clouds, and dust in front of them, from noise with a
 * seed.
 *
 * The profiles are fits by eye to photographs. The optical depth of the dust relative to green light is 1.35 for blue
 * light and 0.72 for red light (J. Cardelli, G. Clayton & J. Mathis 1989, ApJ 345, 245). The band is as bright as the
 * real one. At its brightest place it has some 21 magnitudes per square arcsecond, and 30 degrees from there it is a
 * tenth as bright (C. Leinert et al. 1998, A&AS 127, 1, section 10). The details of the picture correspond to nothing
 * in the real sky. */
#include "render/sky/panorama.h"

#include "base/random.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define DEGREE ((float)M_PI / 180)
enum { SIDE = 64 }; /* number of lattice points along each axis; beyond them the noise repeats */

struct clouds { float *lattice; }; /* SIDE^3 numbers in [-1, 1] */

static float at(const struct clouds *c, int x, int y, int z)
{
    return c->lattice[((z & (SIDE - 1)) * SIDE + (y & (SIDE - 1))) * SIDE + (x & (SIDE - 1))];
}

static float mix(float a, float b, float t) { return a + t * (b - a); }
static float eased(float t) { return t * t * (3 - 2 * t); }

/* Noise of mean 0 in [-1, 1]. The coordinates must be positive. */
static float noise(const struct clouds *c, const float p[3])
{
    const int x = (int)p[0], y = (int)p[1], z = (int)p[2];
    const float u = eased(p[0] - (float)x), v = eased(p[1] - (float)y), w = eased(p[2] - (float)z);
    const float low =
        mix(mix(at(c, x, y, z), at(c, x + 1, y, z), u), mix(at(c, x, y + 1, z), at(c, x + 1, y + 1, z), u), v);
    const float high = mix(mix(at(c, x, y, z + 1), at(c, x + 1, y, z + 1), u),
                           mix(at(c, x, y + 1, z + 1), at(c, x + 1, y + 1, z + 1), u), v);
    return mix(low, high, w);
}

/* Filaments: the value is largest where noise passes through 0. */
static float ridge(float value) { return 0.5f - 2 * fabsf(value); }

/* Octaves from `first` up to but not including `end`, each rotated against the one before to hide the lattice.
 * cells: number of cells of octave 0. */
struct octaves {
    float cells, falls;
    int first, end;
    bool ridged;
};

static float octaves(const struct clouds *c, const float n[3], const struct octaves *which)
{
    float sum = 0, loud = 1, p[3] = { which->cells * n[0], which->cells * n[1], which->cells * n[2] };
    for (int o = 0; o < which->end; o++) {
        const float shifted[3] = { p[0] + 4096.5f, p[1] + 4096.5f, p[2] + 4096.5f },
                    value = o < which->first ? 0 : noise(c, shifted);
        const float x = p[0], y = p[1], z = p[2];
        sum += o < which->first ? 0 : loud * (which->ridged ? ridge(value) : value);
        loud *= which->falls;
        p[0] = 2.05f * (0.36f * x + 0.48f * y - 0.80f * z) + 11.7f;
        p[1] = 2.05f * (-0.80f * x + 0.60f * y) + 5.3f;
        p[2] = 2.05f * (0.48f * x + 0.64f * y + 0.60f * z) + 23.1f;
    }
    return sum;
}

/* Values that all directions of one longitude, or of one latitude, share. Angles are in degrees. */
struct along { float l, cos, sin, inwards, inner; };
struct across { float b, cos, sin, near, far, contrast, halo; };

static struct along along_of(float l)
{
    const float deg = l / DEGREE;
    return (struct along) { deg, cosf(l), sinf(l), expf(-deg * deg / (2 * 62 * 62)),
                            0.45f + 0.55f * expf(-deg * deg / (2 * 75 * 75)) };
}

/* The contrast of star clouds; there are none far from the plane. */
static struct across across_of(float b)
{
    const float deg = b / DEGREE, above = fabsf(deg);
    return (struct across) { deg,
                             cosf(b),
                             sinf(b),
                             expf(-above / 4.2f),
                             expf(-above / 11),
                             1.1f * expf(-above / 22),
                             0.018f * expf(-above / 26) };
}

/* Smooth components. Noise with few cells changes little from texel to texel. So it is computed at every STEP-th column
 * and row, and interpolated between these nodes. Each cell has at least five nodes. FIRST, SECOND: octaves of the
 * filaments, before `ridge`. */
enum { STEP = 4, FEW = 2, NODES = KD_MILKY_WAY_WIDTH / STEP };
enum smooth { CLOUDS, BENT, WARP_X, WARP_Y, PATCHES, FIRST, SECOND, SMOOTH };
#define DUSTY 32.0f /* distance from the plane, in degrees, beyond which there is no dust */
#define FALLS 0.66f /* amplitude ratio of the filaments' octaves */
static const struct octaves few_clouds = { 7, 0.62f, 0, FEW, false }, more_clouds = { 7, 0.62f, FEW, 5, false };
static const struct octaves filaments[] = { { 5, 1, 0, 1, false },
                                            { 5, 1, 1, FEW, false },
                                            { 5, FALLS, FEW, 6, true } };

static void smooth_at(const struct clouds *c, const float n[3], bool dusty, float out[SMOOTH])
{
    static const struct octaves bends = { 2.3f, 0.5f, 0, 2, false }, warps = { 9, 0.55f, 0, 3, false },
                                patches = { 3.1f, 0.6f, 0, 3, false };
    out[CLOUDS] = octaves(c, n, &few_clouds);
    if (!dusty)
        return;
    out[BENT] = 2.2f * octaves(c, n, &bends);
    out[WARP_X] = 0.05f * octaves(c, n, &warps);
    out[WARP_Y] = 0.05f * noise(c, (float[]) { 20 * n[0] + 900, 20 * n[1] + 300, 20 * n[2] + 500 });
    out[PATCHES] = octaves(c, n, &patches);
    const float warped[3] = { n[0] + out[WARP_X], n[1] + out[WARP_Y], n[2] };
    out[FIRST] = octaves(c, warped, &filaments[0]);
    out[SECOND] = octaves(c, warped, &filaments[1]);
}

/* Starlight from a direction, before extinction by dust: the band, which is redder towards the galactic centre. */
static void starlight(const struct clouds *c, const float n[3], const float smooth[SMOOTH], const struct along *l,
                      const struct across *b, float rgb[3])
{
    static const float band[] = { 0.97f, 1.0f, 1.06f }, old[] = { 1.22f, 0.97f, 0.68f };
    const float bulge2 = l->l * l->l / (15 * 15) + b->b * b->b / (7.5f * 7.5f);
    const float thin = (0.16f + 0.62f * l->inwards) * (0.75f * b->near + 0.25f * b->far);
    const float star_clouds =
        b->contrast > 0.1f
            ? expf(b->contrast * (smooth[CLOUDS] + octaves(c, n, &more_clouds)) - 0.17f * b->contrast * b->contrast)
            : 1;
    /* the bulge is smaller than 1e-7 where it is cut off */
    const float bulge = bulge2 < 40 ? 1.25f * expf(-powf(bulge2, 0.75f)) : 0;
    for (int k = 0; k < 3; k++)
        rgb[k] = band[k] * (thin * star_clouds + b->halo) + old[k] * bulge * (0.6f + 0.4f * star_clouds);
}

/* Optical depth of the dust for green light. Lanes wander about the plane; spurs leave it. */
static float dust(const struct clouds *c, const float n[3], const float smooth[SMOOTH], const struct along *l, float b)
{
    if (fabsf(b) > DUSTY)
        return 0;
    const float off = b - smooth[BENT], warped[3] = { n[0] + smooth[WARP_X], n[1] + smooth[WARP_Y], n[2] };
    const float threads = ridge(smooth[FIRST]) + FALLS * ridge(smooth[SECOND]) + octaves(c, warped, &filaments[2]);
    const float lane = expf(-off * off / (2 * 3.6f * 3.6f)), spurs = 0.38f * expf(-fabsf(off) / 9);
    return l->inner * (lane + spurs) * expf(fminf(1.55f * threads + 1.1f * smooth[PATCHES], 2.2f));
}

static void look(const struct clouds *c, const float smooth[SMOOTH], const struct along *l, const struct across *b,
                 float rgb[3])
{
    static const float reddening[] = { 0.72f, 1, 1.35f };
    const float n[3] = { b->cos * l->cos, b->cos * l->sin, b->sin };
    starlight(c, n, smooth, l, b, rgb);
    const float depth = 1.5f * dust(c, n, smooth, l, b->b);
    for (int k = 0; depth > 0 && k < 3; k++)                   /* no dust beyond 32 degrees from the plane */
        rgb[k] *= 0.06f + 0.94f * expf(-reddening[k] * depth); /* 6 % of the stars are in front of the dust */
}

static struct across row_at(uint32_t y)
{
    return across_of((float)M_PI * (0.5f - ((float)y + 0.5f) / KD_MILKY_WAY_HEIGHT));
}

/* Computes the nodes of a row; the last node repeats the first. */
static void make_nodes(const struct clouds *c, const struct along *columns, uint32_t y, float nodes[NODES + 1][SMOOTH])
{
    const struct across b = row_at(y);
    for (uint32_t i = 0; i < NODES; i++)
        smooth_at(c, (float[]) { b.cos * columns[STEP * i].cos, b.cos * columns[STEP * i].sin, b.sin },
                  fabsf(b.b) < DUSTY + 1, nodes[i]);
    memcpy(nodes[NODES], nodes[0], sizeof nodes[0]);
}

static void paint_row(const struct clouds *c, const struct along *columns, uint32_t y, float (*const nodes[2])[SMOOTH],
                      float *texels)
{
    const struct across row = row_at(y);
    const int many = fabsf(row.b) > DUSTY ? 1 : SMOOTH;
    const float down = (float)(y % STEP) / STEP;
    float left[SMOOTH], right[SMOOTH], smooth[SMOOTH];
    for (uint32_t x = 0; x < KD_MILKY_WAY_WIDTH; x++) {
        const float share = (float)(x % STEP) / STEP;
        for (int k = 0; x % STEP == 0 && k < many; k++) {
            left[k] = mix(nodes[0][x / STEP][k], nodes[1][x / STEP][k], down);
            right[k] = mix(nodes[0][x / STEP + 1][k], nodes[1][x / STEP + 1][k], down);
        }
        for (int k = 0; k < many; k++)
            smooth[k] = mix(left[k], right[k], share);
        look(c, smooth, &columns[x], &row, &texels[3 * x]);
    }
}

/* State shared by all rows. */
struct painter {
    struct clouds clouds;
    struct along *columns;
    float (*nodes)[SMOOTH]; /* nodes of two rows */
};

static void finish(struct painter *p)
{
    free(p->nodes);
    free(p->columns);
    free(p->clouds.lattice);
}

static enum kd_status init(struct painter *p, int32_t seed, struct kd_error *error)
{
    const size_t n = (size_t)SIDE * SIDE * SIDE;
    struct kd_random random = { ((uint64_t)(uint32_t)seed << 32) + 1 };
    *p = (struct painter) { { malloc(n * sizeof(float)) },
                            malloc(KD_MILKY_WAY_WIDTH * sizeof *p->columns),
                            calloc(2 * (NODES + 1), sizeof *p->nodes) };
    if (!p->clouds.lattice || !p->columns || !p->nodes) {
        finish(p);
        return kd_error_set(error, KD_ENOMEM, "out of memory for the Milky Way");
    }
    for (size_t i = 0; i < n; i++)
        p->clouds.lattice[i] = (float)(2 * kd_random(&random) - 1);
    for (uint32_t x = 0; x < KD_MILKY_WAY_WIDTH; x++)
        p->columns[x] = along_of((float)M_PI * (1 - 2 * ((float)x + 0.5f) / KD_MILKY_WAY_WIDTH));
    return KD_OK;
}

static void paint(const struct painter *p, const struct kd_sky_picture *out)
{
    float (*at[2])[SMOOTH] = { p->nodes, p->nodes + NODES + 1 };
    make_nodes(&p->clouds, p->columns, 0, at[1]);
    for (uint32_t y = 0; y < out->height; y++) {
        if (y % STEP == 0) {
            float (*const kept)[SMOOTH] = at[0];
            at[0] = at[1];
            at[1] = kept;
            make_nodes(&p->clouds, p->columns, y + STEP, at[1]);
        }
        paint_row(&p->clouds, p->columns, y, at, &out->texels[3 * (size_t)y * out->width]);
    }
}

enum kd_status kd_milky_way(int32_t seed, struct kd_sky_picture *out, struct kd_error *error)
{
    struct painter p;
    *out = (struct kd_sky_picture) { KD_MILKY_WAY_WIDTH, KD_MILKY_WAY_HEIGHT,
                                     malloc(12ull * KD_MILKY_WAY_WIDTH * KD_MILKY_WAY_HEIGHT) };
    enum kd_status status =
        out->texels ? init(&p, seed, error) : kd_error_set(error, KD_ENOMEM, "out of memory for the Milky Way");
    if (status) {
        kd_sky_picture_finish(out);
        return status;
    }
    paint(&p, out);
    finish(&p);
    return KD_OK;
}

enum kd_status kd_milky_way_rows(int32_t seed, const uint32_t *rows, size_t n, float *texels, struct kd_error *error)
{
    struct painter p;
    enum kd_status status = init(&p, seed, error);
    if (status)
        return status;
    float (*at[2])[SMOOTH] = { p.nodes, p.nodes + NODES + 1 };
    for (size_t i = 0; i < n; i++) {
        const uint32_t first = rows[i] / STEP * STEP;
        make_nodes(&p.clouds, p.columns, first, at[0]);
        make_nodes(&p.clouds, p.columns, first + STEP, at[1]);
        paint_row(&p.clouds, p.columns, rows[i], at, &texels[3 * i * KD_MILKY_WAY_WIDTH]);
    }
    finish(&p);
    return KD_OK;
}
