/* This makes up a Milky Way: a smooth band and a bulge, star clouds, and dust in front of them, by noise of a seed.
 *
 * The profiles are fits by eye to photographs; the dust takes 1.35 times as much of blue light as of green, and 0.72 times of red (J. Cardelli,
 * G. Clayton & J. Mathis 1989, ApJ 345, 245). The band is as bright as that of the sky: some 21 magnitudes a square arcsecond where it is
 * brightest, a tenth of that at 30 degrees from it (C. Leinert et al. 1998, A&AS 127, 1, section 10). No place in it is a place in the sky. */
#include "render/sky/panorama.h"
#include "render/sky/random.h"

#include <math.h>
#include <stdlib.h>

#define DEGREE ((float)M_PI / 180)
enum { SIDE = 64 }; /* lattice points, after which noise repeats */

struct clouds { float *lattice; }; /* SIDE^3 numbers of [-1, 1] */

static float at(const struct clouds *c, unsigned x, unsigned y, unsigned z)
{
    return c->lattice[((z & (SIDE - 1)) * SIDE + (y & (SIDE - 1))) * SIDE + (x & (SIDE - 1))];
}

static float mix(float a, float b, float t) { return a + t * (b - a); }
static float eased(float t) { return t * t * (3 - 2 * t); }

/* Noise has mean 0 and lies in [-1, 1]. The coordinates are positive. */
static float noise(const struct clouds *c, const float p[3])
{
    const unsigned x = (unsigned)p[0], y = (unsigned)p[1], z = (unsigned)p[2];
    const float u = eased(p[0] - (float)x), v = eased(p[1] - (float)y), w = eased(p[2] - (float)z);
    const float low = mix(mix(at(c, x, y, z), at(c, x + 1, y, z), u), mix(at(c, x, y + 1, z), at(c, x + 1, y + 1, z), u), v);
    const float high = mix(mix(at(c, x, y, z + 1), at(c, x + 1, y, z + 1), u), mix(at(c, x, y + 1, z + 1), at(c, x + 1, y + 1, z + 1), u), v);
    return mix(low, high, w);
}

/* Octaves, each turned against the one before so that the lattice is not seen. ridged: filaments, where noise passes through 0. */
static float octaves(const struct clouds *c, const float n[3], float cells, int count, float falls, bool ridged)
{
    float sum = 0, loud = 1, p[3] = { cells * n[0], cells * n[1], cells * n[2] };
    for (int o = 0; o < count; o++) {
        const float shifted[3] = { p[0] + 4096.5f, p[1] + 4096.5f, p[2] + 4096.5f }, value = noise(c, shifted);
        const float x = p[0], y = p[1], z = p[2];
        sum += loud * (ridged ? 0.5f - 2 * fabsf(value) : value);
        loud *= falls;
        p[0] = 2.05f * (0.36f * x + 0.48f * y - 0.80f * z) + 11.7f;
        p[1] = 2.05f * (-0.80f * x + 0.60f * y) + 5.3f;
        p[2] = 2.05f * (0.48f * x + 0.64f * y + 0.60f * z) + 23.1f;
    }
    return sum;
}

/* What all directions of one longitude have in common, and of one latitude, in degrees. */
struct along { float l, cos, sin, inwards, inner; };
struct across { float b, cos, sin, near, far, contrast, halo; };

static struct along along_of(float l)
{
    const float deg = l / DEGREE;
    return (struct along) { deg, cosf(l), sinf(l), expf(-deg * deg / (2 * 62 * 62)), 0.45f + 0.55f * expf(-deg * deg / (2 * 75 * 75)) };
}

/* The contrast is that of star clouds: far from the plane there are none. */
static struct across across_of(float b)
{
    const float deg = b / DEGREE, above = fabsf(deg);
    return (struct across) { deg, cosf(b), sinf(b), expf(-above / 4.2f), expf(-above / 11), 1.1f * expf(-above / 22), 0.018f * expf(-above / 26) };
}

/* What a direction has before dust: the band, reddish towards the middle. */
static void starlight(const struct clouds *c, const float n[3], const struct along *l, const struct across *b, float rgb[3])
{
    static const float band[] = { 0.97f, 1.0f, 1.06f }, old[] = { 1.22f, 0.97f, 0.68f };
    const float bulge2 = l->l * l->l / (15 * 15) + b->b * b->b / (7.5f * 7.5f);
    const float thin = (0.16f + 0.62f * l->inwards) * (0.75f * b->near + 0.25f * b->far);
    const float star_clouds = b->contrast > 0.1f ? expf(b->contrast * octaves(c, n, 7, 5, 0.62f, false) - 0.17f * b->contrast * b->contrast) : 1;
    const float bulge = 1.25f * expf(-powf(bulge2, 0.75f));
    for (int k = 0; k < 3; k++)
        rgb[k] = band[k] * (thin * star_clouds + b->halo) + old[k] * bulge * (0.6f + 0.4f * star_clouds);
}

/* Optical depth of the dust, of green light. Lanes wander about the plane; spurs leave it. */
static float dust(const struct clouds *c, const float n[3], const struct along *l, float b)
{
    if (fabsf(b) > 32)
        return 0;
    const float bent = 2.2f * octaves(c, n, 2.3f, 2, 0.5f, false), off = b - bent;
    const float warp[3] = { n[0] + 0.05f * octaves(c, n, 9, 3, 0.55f, false), n[1] + 0.05f * noise(c, (float[]) { 20 * n[0] + 900, 20 * n[1] + 300, 20 * n[2] + 500 }), n[2] };
    const float filaments = octaves(c, warp, 5, 6, 0.66f, true), patches = octaves(c, n, 3.1f, 3, 0.6f, false);
    const float lane = expf(-off * off / (2 * 3.6f * 3.6f)), spurs = 0.38f * expf(-fabsf(off) / 9);
    return l->inner * (lane + spurs) * expf(fminf(1.55f * filaments + 1.1f * patches, 2.2f));
}

static void look(const struct clouds *c, const struct along *l, const struct across *b, float rgb[3])
{
    static const float reddening[] = { 0.72f, 1, 1.35f };
    const float n[3] = { b->cos * l->cos, b->cos * l->sin, b->sin };
    starlight(c, n, l, b, rgb);
    const float depth = 1.5f * dust(c, n, l, b->b);
    for (int k = 0; depth > 0 && k < 3; k++) /* dust is at most 32 degrees from the plane */
        rgb[k] *= 0.06f + 0.94f * expf(-reddening[k] * depth); /* some stars are in front */
}

static void paint(const struct clouds *c, const struct along *columns, const struct kd_sky_picture *out)
{
    for (uint32_t y = 0; y < out->height; y++) {
        const struct across row = across_of((float)M_PI * (0.5f - ((float)y + 0.5f) / (float)out->height));
        for (uint32_t x = 0; x < out->width; x++)
            look(c, &columns[x], &row, &out->texels[3 * ((size_t)y * out->width + x)]);
    }
}

enum kd_status kd_milky_way(int32_t seed, struct kd_sky_picture *out, struct kd_error *error)
{
    const size_t n = (size_t)SIDE * SIDE * SIDE;
    struct clouds c = { malloc(n * sizeof *c.lattice) };
    struct kd_random random = { ((uint64_t)(uint32_t)seed << 32) + 1 };
    *out = (struct kd_sky_picture) { KD_MILKY_WAY_WIDTH, KD_MILKY_WAY_HEIGHT, malloc(12ull * KD_MILKY_WAY_WIDTH * KD_MILKY_WAY_HEIGHT) };
    struct along *columns = malloc(KD_MILKY_WAY_WIDTH * sizeof *columns);
    bool good = c.lattice && out->texels && columns;
    for (size_t i = 0; good && i < n; i++)
        c.lattice[i] = (float)(2 * kd_random(&random) - 1);
    for (uint32_t x = 0; good && x < out->width; x++)
        columns[x] = along_of((float)M_PI * (1 - 2 * ((float)x + 0.5f) / (float)out->width));
    if (good)
        paint(&c, columns, out);
    free(columns);
    free(c.lattice);
    if (good)
        return KD_OK;
    kd_sky_picture_finish(out);
    return kd_error_set(error, KD_ENOMEM, "out of memory for the Milky Way");
}
