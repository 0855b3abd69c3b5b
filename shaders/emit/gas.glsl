/* Turbulent gas in place of the smooth disk. A procedural pattern multiplies the disk's temperature and optical depth.
 * The opacity of a crossing depends on the length of the ray's path through the gas.
 *
 * Pattern. The disk is divided into rings, KD_GAS_RING apart in ln r. Each ring rotates rigidly with the Omega of its
 * middle, and has its own noise in the plane that rotates with it. The noise is evaluated at K (r/r_j) (cos psi, sin
 * psi), psi = phi - Omega_j t + shear ln(r/r_j). So features grow with r, there is no seam in phi, and the pattern does
 * not wind up with time. The noises b of the two rings about a place are added with weights w_1^2 + w_2^2 = 1, so that
 * the variance is the same everywhere. The noise is a sum of octaves, as in fractional Brownian motion. Each octave's
 * lattice is rotated, is shifted at random, drifts, and is displaced by the octaves before it (domain warp).
 *
 * Let n be the sum of s_k b_k over octaves k, where s_k is the amplitude and b_k is noise of variance 1 that is nearly
 * Gaussian. Flux and depth are multiplied by exp(n - sum s_k^2/2), whose mean is 1. A black body of T^4 proportional to
 * that flux changes colour and brightness consistently.
 *
 * Opacity. A layer of optical depth tau along its normal absorbs 1 - exp(-tau/cos) of light that crosses it at an angle
 * theta to the normal, in the frame of the gas (cosine.glsl). */
#ifndef KD_BLOCK_gas
#define KD_GAS_RING 0.2 /* ln of the ratio of the radii of neighbouring rings */
#define KD_GAS_RINGS 80 /* number of rings for radii from 1 to 1e6 M, including one beyond the end */
#define KD_GAS_OCTAVES 8
#define KD_GAS_DRIFT 0.15 /* cells by which the first octave's lattice drifts while its ring turns by one radian */
#define KD_GAS_HASTE 1.6  /* ratio of an octave's drift to that of the octave before */
#define KD_GAS_FINER 1.9  /* ratio of an octave's number of cells per length to that of the octave before */
#define KD_GAS_TURN 0.9   /* rotation of each octave's lattice against that of the octave before, radians */
#define KD_BLOCK_gas(F, U, A) \
    F(first) /* log2 of the innermost ring's radius */ \
    F(cells) /* K, the number of cells of the first octave over a length equal to r */ \
    F(shear) \
    F(warp)        /* displacement by an octave where its noise is one standard deviation, in cells of this octave */ \
    F(loudness)    /* s_0, the amplitude of the first octave */ \
    F(persistence) /* s_(k+1)/s_k, the ratio of an octave's amplitude to that of the octave before */ \
    F(finer)       /* squared ratio, octave to octave, of a ray's step in cells, including displacement */ \
    F(depth)       /* optical depth along the normal where the flux is largest */
#define KD_GAS_ROWS (KD_GAS_RINGS * (KD_GAS_OCTAVES + 1))
/* The table `gas` has a row for each ring, then one for each octave. A ring's row holds the ring's azimuth minus the
 * observer's in radians, Omega, and the factor that converts a place in the ring's plane to a place in the next ring's
 * plane. An octave's row holds the drift of its lattice: the fraction of a cell, and the whole cells. */
#define KD_TABLES_gas(T) T(gas, KD_GAS_ROWS)
#define KD_TRAIT_GAS_DEEP 64u /* the opacity is computed from the optical depth */
#define KD_TRAIT_GAS_SHIFT 8u /* first bit of the number of octaves in the traits; 0 octaves: no turbulence */
#define KD_TRAIT_GAS_OCTAVES (15u << KD_TRAIT_GAS_SHIFT)
#define KD_TRAITS_gas(T) KD_TRAITS_disk(T) T(SLOW) T(GAS_DEEP) T(GAS_OCTAVES)
#define KD_BUFFERS_gas(B)
#define KD_PASS_gas(P)
#endif

#ifdef KD_EMIT_CODE
const uint KD_GAS_TAKEN = (TRAITS_gas & KD_TRAIT_GAS_OCTAVES) >> KD_TRAIT_GAS_SHIFT;
/* true if the disk's gas, thin or thick, is shown as it was when its light left it */
const bool KD_GAS_SLOW = ((TRAITS_gas | TRAITS_thick) & KD_TRAIT_SLOW) != 0u;

/* Gradient at a point of the lattice, times 32768. The lattice repeats after 65536 cells. */
vec2 kd_gas_gradient(uint point)
{
    uint h = (point ^ (point >> 15)) * 0x2c1b3c6du;
    h = (h ^ (h >> 12)) * 0x297a2d39u;
    return vec2(float(int(h) >> 16), float(int(h << 16) >> 16));
}

/* Gradient noise of variance 1 (Perlin 2002). The lattice is shifted by the fraction at.xy of a cell and by at.zw whole
 * cells. The second result is noise that is uncorrelated with the first: its gradients are rotated by a quarter turn.
 */
vec2 kd_gas_noise(vec2 p, vec4 at)
{
    p += at.xy;
    vec2 corner = floor(p), d = p - corner, e = d - 1.0;
    uvec2 i = uvec2(ivec2(corner + at.zw));
    uint x0 = i.x << 16, x1 = x0 + 0x10000u, y0 = i.y & 0xffffu, y1 = (i.y + 1u) & 0xffffu;
    vec2 a = kd_gas_gradient(x0 | y0), b = kd_gas_gradient(x1 | y0), c = kd_gas_gradient(x0 | y1),
         f = kd_gas_gradient(x1 | y1);
    vec2 t = d * d * d * (d * (d * 6.0 - 15.0) + 10.0);
    vec2 low = mix(vec2(a.x * d.x + a.y * d.y, a.x * d.y - a.y * d.x),
                   vec2(b.x * e.x + b.y * d.y, b.x * d.y - b.y * e.x), t.x);
    vec2 high = mix(vec2(c.x * d.x + c.y * e.y, c.x * e.y - c.y * d.x),
                    vec2(f.x * e.x + f.y * e.y, f.x * e.y - f.y * e.x), t.x);
    /* this factor makes the mean of n^2 equal to 1, averaged over the random gradients and over all places in a cell */
    return mix(low, high, t.y) * (5.677716904867669 / 32768.0);
}

/* A place in a ring's plane, and the motion of the ring. */
struct kd_gas_ring {
    vec2 p;
    uint row;
    float ahead;
};

/* The place of a sample in ring j. off: ln(r/r_j), the distance from the middle of the ring. */
kd_gas_ring kd_gas_ring_of(uint j, float off, kd_sample s)
{
    uint row = j * (KD_GAS_OCTAVES + 1u);
    vec4 ring = kd_table_row(gas, row);
    float ahead = KD_GAS_SLOW ? ring.y * s.ago : 0.0;
    kd_phasor psi = kd_cos_sin(s.phi - ring.x + ahead + emission.gas.shear * off);
    return kd_gas_ring(emission.gas.cells * exp(off) * vec2(psi.c, psi.s), row, ahead);
}

/* Position of an octave's lattice, which drifts with time. */
vec4 kd_gas_lattice(kd_gas_ring ring, uint octave)
{
    vec4 at = kd_table_row(gas, ring.row + 1u + octave);
    if (KD_GAS_SLOW) {
        float way = -ring.ahead * KD_GAS_DRIFT * pow(KD_GAS_HASTE, float(octave)), angle = 2.4 * float(octave);
        at.xy += way * vec2(cos(angle), sin(angle));
    }
    return at;
}

/* Size of the area of the pattern, in cells, that one ray stands for: sum and product of the squared semi-axes of the
 * ray's footprint. A step (dr, r dphi) on the disk is a step of (dr, r dphi + shear dr) K/r cells. */
struct kd_gas_steps { float sum, product; };

kd_gas_steps kd_gas_footprint(kd_sample s)
{
    uint bits = floatBitsToUint(s.shape);
    float i = float(bits & 2047u) * (1.0 / 2047.0), j = float((bits >> 11) & 2047u) * (2.0 / 2047.0) - 1.0;
    float both = i * (1.0 - i), apart = i - 0.5, per = s.w * s.footprint * emission.gas.cells;
    /* M_rr + M_ff, which follows from the long axis of the footprint */
    float all = per * per / (0.5 + sqrt(apart * apart + j * j * both));
    float c = j * sqrt(both), shear = emission.gas.shear;
    return kd_gas_steps(all * (1.0 + shear * (shear * i + 2.0 * c)), all * all * both * (1.0 - j * j));
}

/* Fraction of an octave that remains in the mean over a ray's footprint. The mean of this noise along a line of q cells
 * has about 1/(1 + 0.66 q^2) of the variance at a point. Where the fraction is small, it is set to 0, because aliases
 * would flicker. The loop over octaves ends there. */
float kd_gas_left(kd_gas_steps q)
{
    float fine = 1.0 + 0.66 * q.sum + 0.4356 * q.product, cut = clamp(1.8 - 0.5 * q.sum, 0.0, 1.0);
    return cut * cut * (3.0 - 2.0 * cut) * inversesqrt(fine);
}

/* The exponent n - sum s_k^2/2 of the factor by which flux and depth are multiplied. */
float kd_gas_excess(kd_sample s)
{
    float u = max(-(log2(s.w) + emission.gas.first) * (0.69314718 / KD_GAS_RING), 0.0), j = floor(u), x = u - j;
    /* w_2^2 = x^4 (35 - 84 x + 70 x^2 - 20 x^3) joins 0 and 1 such that both weights have continuous slopes. */
    float x2 = x * x, share = x2 * x2 * (35.0 + x * (-84.0 + x * (70.0 - 20.0 * x)));
    float w1 = sqrt(max(1.0 - share, 0.0)), w2 = sqrt(share);
    uint k = min(uint(j), KD_GAS_RINGS - 2u);
    kd_gas_ring one = kd_gas_ring_of(k, x * KD_GAS_RING, s), two = kd_gas_ring_of(k + 1u, (x - 1.0) * KD_GAS_RING, s);
    float sum = 0.0, loud = emission.gas.loudness;
    kd_gas_steps steps = kd_gas_footprint(s);
    mat2 next = KD_GAS_FINER * mat2(cos(KD_GAS_TURN), sin(KD_GAS_TURN), -sin(KD_GAS_TURN), cos(KD_GAS_TURN));
    float left = kd_gas_left(steps);
    uint octave = 0u;
    do {
        float part = loud * left;
        vec2 a = kd_gas_noise(one.p, kd_gas_lattice(one, octave)), b = kd_gas_noise(two.p, kd_gas_lattice(two, octave));
        if (left > 0.0) /* this test is also false for NaN, which comes from an infinite footprint */
            sum += part * (w1 * a.x + w2 * b.x) - 0.5 * part * part;
        loud *= emission.gas.persistence;
        steps = kd_gas_steps(steps.sum * emission.gas.finer, steps.product * emission.gas.finer * emission.gas.finer);
        left = kd_gas_left(steps);
        one.p = next * (one.p + emission.gas.warp * a);
        two.p = next * (two.p + emission.gas.warp * b);
    } while (left > 0.0 && ++octave < KD_GAS_TAKEN);
    return sum;
}

kd_glow kd_gas_glow(kd_sample s)
{
    kd_gas gas = kd_disk_gas(s, TRAITS_gas);
    float more = KD_GAS_TAKEN > 0u ? exp(kd_gas_excess(s)) : 1.0;
    if ((TRAITS_gas & KD_TRAIT_GAS_DEEP) != 0u) {
        float t = gas.t / kd_orbit_shift(s.w, s.energy, s.momentum, TRAITS_gas), t2 = t * t, flux = t2 * t2;
        /* the depth is computed from the whole flux, including reflected light */
        if ((TRAITS_gas & KD_TRAIT_REFLECTED) != 0u) {
            vec2 light = kd_disk_dilute(s.w), square = light * light;
            flux += light.y * square.x * square.x;
        }
        float taken = 1.0 - exp(-emission.gas.depth * flux * more / max(s.cosine, 1e-6));
        /* an opacity of 0 is kept, because g may be NaN there: u^t does not exist inside the photon orbit
         */
        gas.alpha = gas.alpha > 0.0 ? gas.alpha * taken : 0.0;
    }
    gas.t *= sqrt(sqrt(more));
    return kd_glow(gas.alpha * kd_disk_surface(gas.t, s, TRAITS_gas), gas.alpha, 0.0);
}
#endif
