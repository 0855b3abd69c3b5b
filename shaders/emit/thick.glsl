/* The smooth disk's gas with a height. At each distance R = r sin(theta) from the axis, its density is Gaussian in the
 * height z = r cos(theta) above the plane,
 *
 *   density ~ exp(-z^2/2H^2) (1 - (z/4.5 H)^8)^3,   H = height R (R/10)^flare,
 *
 * It fills the range between the spheres of the disk's edges, where R is beyond the ISCO. The gas ends smoothly at a
 * height of 4.5 H, because samples would either hit or miss a sharp edge. The gas emits as the thin disk does at R,
 * with the same temperature and flux. At any height it rotates with the Omega of the circular orbit at R; u^t follows
 * from the metric: -1/u^t^2 = g_tt + 2 Omega g_tphi + Omega^2 g_phiphi (Bardeen, Press & Teukolsky 1972).
 *
 * From top to bottom the gas has the optical depth of the thin disk. Light that crosses at an angle theta to the
 * normal, in the frame of the gas, is attenuated by the same factor as in the thin disk, including opacity and fade.
 * For a small height the picture is therefore the thin disk's. Turbulence is that of gas.glsl, with a third coordinate
 * in its noise. */
#ifndef KD_BLOCK_thick
#define KD_THICK_REACH 4.5 /* height at which the gas ends, in units of H */
/* density in the middle of a column of height H = 1 whose integral over the column is 1 */
#define KD_THICK_AMID 0.399624938
/* reciprocal standard deviation of gradient noise with the gradients of a cube */
#define KD_THICK_NOISE 5.237147522273636
#define KD_THICK_FAINT 0.15 /* an octave fainter than this fraction of the first octave does not shorten stretches */
#define KD_THICK_HASTE \
    4.0 /* slow light: largest time, in M per M along the ray, that shortens a grain. Beyond that, next to the \
         * horizon, the gas is hardly visible */
/* Streaks fade out where the gas is thin: where its optical depth along the normal is less than this fraction of that
 * at the ray's innermost crossing of the plane. Light is proportional to depth times flux, that is, to the square of
 * depth. The first octave thus ends where 3e-9 of that crossing's light is left. Otherwise rays along a disk of 5e5 M
 * would take thousands of stretches in the dark. */
#define KD_THICK_AFAR 1e-3
#define KD_THICK_LAYERS \
    3.0 /* number of cells in height per cell in the plane: streaks are longer than high by this factor */
/* clang-format off */
#define KD_BLOCK_thick(F, U, A) \
    F(height) F(flare)     /* H/R at R = 10 M; exponent of its growth with R/10 */ \
    F(inner) F(outer)      /* M */
/* clang-format on */
#define KD_TABLES_thick(T)
#define KD_TRAITS_thick(T) KD_TRAITS_disk(T) T(SLOW) T(GAS_DEEP) T(GAS_OCTAVES) T(AZIMUTH)
#define KD_BUFFERS_thick(B)
#define KD_PASS_thick(P)
#endif

#ifdef KD_EMIT_CODE
#ifdef KD_MARCH
const uint KD_THICK_TAKEN = (TRAITS_thick & KD_TRAIT_GAS_OCTAVES) >> KD_TRAIT_GAS_SHIFT;

/* u^t and Omega of the circular orbit at a distance from the axis; matter at any height rotates with this Omega. */
struct kd_thick_orbit { float ut, omega; };

kd_thick_orbit kd_thick_orbit_of(kd_midst p, float r, float axis)
{
    float a = cam.spin, s2 = 1.0 - p.u * p.u, omega = 1.0 / kd_circle_time(axis), sigma = r * r + a * a * p.u * p.u;
    float turn = 1.0 - a * omega * s2;
    float rest = 1.0 - (r * r + a * a) * s2 * omega * omega - kd_mass(r) / sigma * turn * turn;
    return kd_thick_orbit(inversesqrt(max(rest, 1e-6)), omega);
}

/* t', the derivative of the light's time by Mino time along the ray: how much earlier the light was at a place. */
float kd_thick_time(kd_midst p, float s2)
{
    float a = cam.spin, w2 = p.w * p.w, all = p.energy + a * (a * p.energy - p.momentum) * w2;
    return (1.0 + a * a * w2) * all / (w2 * kd_horizons(p.w, cam.root)) + a * (p.momentum - a * p.energy * s2);
}

/* Gradient at a point of the lattice, times 2^31. */
vec3 kd_thick_gradient(uint point)
{
    uint h = (point ^ (point >> 15)) * 0x2c1b3c6du;
    h = (h ^ (h >> 12)) * 0x297a2d39u;
    return vec3(float(int(h)), float(int(h << 10)), float(int(h << 20)));
}

/* Noise on one plane of the lattice. The first result uses the gradients; the second uses the gradients rotated by a
 * quarter turn about the third axis. */
vec2 kd_thick_plane(uint x0, uint x1, uint y0, uint y1, uint z, vec3 d, vec2 t)
{
    vec3 a = kd_thick_gradient(x0 ^ y0 ^ z), b = kd_thick_gradient(x1 ^ y0 ^ z), c = kd_thick_gradient(x0 ^ y1 ^ z),
         f = kd_thick_gradient(x1 ^ y1 ^ z);
    vec2 e = d.xy - 1.0;
    vec2 low = mix(vec2(a.x * d.x + a.y * d.y + a.z * d.z, a.x * d.y - a.y * d.x),
                   vec2(b.x * e.x + b.y * d.y + b.z * d.z, b.x * d.y - b.y * e.x), t.x);
    vec2 high = mix(vec2(c.x * d.x + c.y * e.y + c.z * d.z, c.x * e.y - c.y * d.x),
                    vec2(f.x * e.x + f.y * e.y + f.z * d.z, f.x * e.y - f.y * e.x), t.x);
    return mix(low, high, t.y);
}

/* Gradient noise of variance 1 (Perlin 2002) in three dimensions. The lattice is shifted by the fraction at.xy of a
 * cell and by at.zw whole cells. The second result is the noise of the rotated gradients, which is uncorrelated with
 * the first and has the variance 2/3. */
vec2 kd_thick_noise(vec3 p, vec4 at)
{
    p.xy += at.xy;
    vec3 corner = floor(p), d = p - corner, t = d * d * d * (d * (d * 6.0 - 15.0) + 10.0);
    uvec2 i = uvec2(ivec2(corner.xy + at.zw));
    uint x0 = i.x * 0x8da6b343u, x1 = x0 + 0x8da6b343u, y0 = i.y * 0xd8163841u, y1 = y0 + 0xd8163841u,
         z0 = uint(int(corner.z)) * 0xcb1ab31fu;
    vec2 low = kd_thick_plane(x0, x1, y0, y1, z0, d, t.xy),
         high = kd_thick_plane(x0, x1, y0, y1, z0 + 0xcb1ab31fu, vec3(d.xy, d.z - 1.0), t.xy);
    /* this factor makes the mean of n^2 equal to 1, averaged over the gradients and over all places in a cell */
    return mix(low, high, t.z) * (KD_THICK_NOISE / 2147483648.0);
}

/* The result of kd_gas_excess for gas with a height. finest: number of cells, per cell of the first octave, of the
 * finest octave that matters for the grain. */
struct kd_thick_stir { float excess, finest; };

kd_thick_stir kd_thick_excess(kd_midst p, float axis, float z, float counts)
{
    float u = max((log2(axis) - emission.gas.first) * (0.69314718 / KD_GAS_RING), 0.0), j = floor(u), x = u - j;
    float x3 = x * x * x,
          share = x3 * x3 * (462.0 + x * (-1980.0 + x * (3465.0 + x * (-3080.0 + x * (1386.0 - 252.0 * x)))));
    float w1 = sqrt(max(1.0 - share, 0.0)), w2 = sqrt(share);
    uint k = min(uint(j), KD_GAS_RINGS - 2u);
    vec4 ring = kd_table_row(gas, k * (KD_GAS_OCTAVES + 1u));
    kd_phasor psi =
        kd_cos_sin(p.phi - ring.x + (KD_GAS_SLOW ? ring.y * p.ago : 0.0) + emission.gas.shear * (x * KD_GAS_RING));
    vec2 in_one = emission.gas.cells * exp(x * KD_GAS_RING) * vec2(psi.c, psi.s);
    kd_gas_ring one = kd_gas_ring(in_one, k * (KD_GAS_OCTAVES + 1u), KD_GAS_SLOW ? ring.y * p.ago : 0.0);
    kd_gas_ring two = kd_gas_ring(vec2(ring.z * in_one.x - ring.w * in_one.y, ring.w * in_one.x + ring.z * in_one.y),
                                  (k + 1u) * (KD_GAS_OCTAVES + 1u), 0.0);
    if (KD_GAS_SLOW) { /* the angle between the rings is taken at the time when the light left the gas */
        vec4 next_ring = kd_table_row(gas, two.row);
        two.ahead = next_ring.y * p.ago;
        psi = kd_cos_sin(p.phi - next_ring.x + two.ahead + emission.gas.shear * ((x - 1.0) * KD_GAS_RING));
        two.p = emission.gas.cells * exp((x - 1.0) * KD_GAS_RING) * vec2(psi.c, psi.s);
    }
    float up = KD_THICK_LAYERS * emission.gas.cells * z / axis, sum = 0.0, loud = emission.gas.loudness, finest = 1.0;
    float shear = emission.gas.shear, per = emission.gas.cells / axis;
    /* The trace of an ellipse's matrix, in cells (dr, dphi + shear dr, layers dz), is the sum of its squared semi-axes.
     * The sum of the matrix's minors replaces the product of the squared semi-axes. */
    vec3 plane = p.spread.plane, rise = KD_THICK_LAYERS * p.spread.rise;
    float rr = plane.x, rf = plane.y + shear * rr, ff = plane.z + shear * (2.0 * plane.y + shear * rr), rz = rise.x,
          fz = rise.y + shear * rise.x, zz = KD_THICK_LAYERS * rise.z;
    kd_gas_steps steps =
        kd_gas_steps(per * per * (rr + ff + zz),
                     per * per * per * per * max(rr * ff - rf * rf + (rr + ff) * zz - rz * rz - fz * fz, 0.0));
    mat2 next = KD_GAS_FINER * mat2(cos(KD_GAS_TURN), sin(KD_GAS_TURN), -sin(KD_GAS_TURN), cos(KD_GAS_TURN));
    for (uint octave = 0u; octave < KD_THICK_TAKEN; octave++) {
        float left = kd_gas_left(steps), part = loud * left;
        float seen = part * counts / (slice.unseen * emission.gas.loudness) -
                     /* visibility of the octave, which depends on the amount of gas; octaves begin to fade at three
                      * times the limit */
                     1.0;
        if (!(seen > 0.0))
            break;
        seen = min(0.5 * seen, 1.0);
        part *= seen * seen * seen * (10.0 + seen * (6.0 * seen - 15.0));
        vec2 a = kd_thick_noise(vec3(one.p, up), kd_gas_lattice(one, octave)),
             b = kd_thick_noise(vec3(two.p, up), kd_gas_lattice(two, octave));
        sum += part * (w1 * a.x + w2 * b.x) - 0.5 * part * part;
        finest *= octave > 0u && part > KD_THICK_FAINT * emission.gas.loudness ? KD_GAS_FINER : 1.0;
        loud *= emission.gas.persistence;
        steps = kd_gas_steps(steps.sum * emission.gas.finer, steps.product * emission.gas.finer * emission.gas.finer);
        one.p = next * (one.p + emission.gas.warp * a);
        two.p = next * (two.p + emission.gas.warp * b);
        up = KD_GAS_FINER * up + 17.3;
    }
    return kd_thick_stir(sum, finest);
}

/* Weight of gas of a given flux in the ray's light, relative to gas in the plane at the ray's innermost crossing. The
 * radius of that crossing is taken to be at least about the radius of the largest flux. */
float kd_thick_counts(float nearest, float flux)
{
    float w = min(nearest, 0.5 / emission.frame.r_isco), t = kd_disk_heat(w), near = t * t * t * t * w * w * w;
    bool deep = (TRAITS_thick & KD_TRAIT_GAS_DEEP) != 0u;
    float depth = min(emission.gas.depth * near, 1.0);
    return deep && depth > 0.0 ? min(emission.gas.depth * flux / (KD_THICK_AFAR * depth), 1.0) : 1.0;
}

kd_medium kd_thick_along(kd_midst p)
{
    float r = 1.0 / p.w, s2 = max(1.0 - p.u * p.u, 1e-6), s = sqrt(s2), axis = r * s, z = r * p.u;
    float height = axis * emission.thick.height *
                   (emission.thick.flare == 0.0 ? 1.0 : pow(0.1 * axis, emission.thick.flare)),
          x = z / height;
    /* Change of height, distance from the axis and azimuth along the ray, per length. */
    float per = 1.0 / p.speed, dr = -p.dw * r * r * per, dz = dr * p.u + r * p.du * per,
          out_ = dr * s - r * p.u * p.du / s * per, round_ = -p.momentum / s * r * per;
    float off = max(abs(x) - KD_THICK_REACH, 0.0) * height;
    float fades = (emission.thick.outer - r) * emission.disk.fade < 1.0 ? emission.disk.fade : 0.0;
    float grain = 1.0 / (abs(dz) / (1.2 * height) +
                         abs(out_) * (4.0 / max(axis - 0.7 * emission.thick.inner, 0.05 * axis) + fades) + 2.5 / axis);
    if (off > 0.0 || axis <= emission.frame.r_isco || r < emission.thick.inner || r > emission.thick.outer)
        return kd_medium(vec3(0.0), 0.0, max(grain, 0.7 * off / max(abs(dz), 0.1)));

    kd_thick_orbit orbit = kd_thick_orbit_of(p, r, axis);
    bool doppler = (TRAITS_thick & KD_TRAIT_DOPPLER) != 0u, redshift = (TRAITS_thick & KD_TRAIT_REDSHIFT) != 0u;
    float seen = max(orbit.ut * (p.energy - orbit.omega * p.momentum), 1e-6);
    float shown = doppler && redshift ? seen
                                      : (redshift ? orbit.ut : 1.0) * max(doppler  ? p.energy - orbit.omega * p.momentum
                                                                          : FINITE ? p.energy
                                                                                   : 1.0,
                                                                          1e-6);
    float t = kd_disk_heat(1.0 / axis) * inversesqrt(axis * sqrt(axis)), flux = t * t * t * t;
    kd_thick_stir stir = KD_THICK_TAKEN > 0u
                             ? kd_thick_excess(p, axis, z, exp(-0.25 * x * x) * kd_thick_counts(p.nearest, flux))
                             : kd_thick_stir(0.0, 0.0);
    float more = KD_THICK_TAKEN > 0u ? exp(stir.excess) : 1.0;

    /* Optical depth along the normal that gives the thin disk's opacity for light at this angle. The transmission is
     * computed without a difference of nearly equal numbers. */
    float f = clamp((emission.disk.r_out - r) * emission.disk.fade, 0.0, 1.0), on = f * f * (3.0 - 2.0 * f),
          off_ = (1.0 - f) * (1.0 - f) * (1.0 + 2.0 * f);
    float c = p.du / s / (r * seen), slant = sqrt(c * c + emission.thick.height * emission.thick.height),
          depth = emission.gas.depth * flux * more;
    bool deep = (TRAITS_thick & KD_TRAIT_GAS_DEEP) != 0u;
    float y = depth / slant, passes = deep ? exp(-y) : 0.0,
          stops = !deep      ? 1.0
                  : y < 0.02 ? y * (1.0 - y * (0.5 - y * (1.0 / 6.0)))
                             : 1.0 - passes;
    float taken = emission.disk.opacity * on * stops,
          left = 1.0 - emission.disk.opacity + emission.disk.opacity * (off_ + on * passes);
    if (!deep || emission.disk.opacity * on < 1.0)
        depth =
            slant *
            (taken < 0.1
                 ? taken * (1.0 +
                            taken * (0.5 + taken * (1.0 / 3.0 + taken * (0.25 + taken * (0.2 + taken * (1.0 / 6.0))))))
                 : -log(max(left, deep ? 1e-30 : 1e-6)));
    float edge = x * x * (1.0 / (KD_THICK_REACH * KD_THICK_REACH)), ends = max(1.0 - edge * edge * edge * edge, 0.0);
    depth *= KD_THICK_AMID / height * exp(-0.5 * x * x) * ends * ends * ends * seen;
    if (KD_THICK_TAKEN > 0u) {
        if (KD_GAS_SLOW) /* the pattern moves while the ray goes back in time */
            round_ += orbit.omega * axis * min(per * kd_thick_time(p, s2), KD_THICK_HASTE);
        float across = out_ * out_ + (round_ + emission.gas.shear * out_) * (round_ + emission.gas.shear * out_) +
                       KD_THICK_LAYERS * KD_THICK_LAYERS * dz * dz;

        grain = 1.0 / (1.0 / grain + 0.5 * sqrt(across) * emission.gas.cells * stir.finest / axis);
    }
    return kd_medium(depth * kd_black_body(t * sqrt(sqrt(more)) / shown, TRAITS_thick), depth, grain);
}
#endif
#endif
