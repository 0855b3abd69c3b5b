/* Matter that radiates at one radio frequency. It follows the analytic model of R. Gold et al. 2020 (ApJ 897, 148), or
 * consists of hot electrons in a magnetic field. Power laws give the electrons' density and temperature, as in work by
 * A. E. Broderick, H.-Y. Pu and others. The struct kd_plasma is the state at a point; light and, if requested,
 * polarisation follow from it.
 *
 * nu_obs is the observed frequency, and nu the frequency in the frame of the matter; nu/nu_obs is -k.u. The affine
 * parameter is scaled such that the observer measures the photon energy 1. Per unit of that parameter, light grows by
 * (nu_obs/nu)^2 j_nu and optical depth by (nu/nu_obs) alpha_nu, because I/nu^3, j/nu^2 and alpha nu are invariant
 * (Rybicki & Lightman 1979, 4.9). */
#ifndef KD_BLOCK_plasma
/* clang-format off */
#define KD_BLOCK_plasma(F, U, A) \
    F(inner) F(outer)      /* M */ \
    F(frequency)           /* log2 of the observed frequency in GHz */ \
    F(light) F(depth)      /* log2 of the units, per M, of light and of depth in kd_radiates */ \
    F(gold_light) F(gold_depth) /* model of Gold et al.: log2 of light and of depth per M, at density 1 and 230 GHz */ \
    F(gold_index) F(gold_flat) F(gold_momentum) \
    F(density) F(density_index) /* log2 of the density in cm^-3 at r = 1 M; exponent of its decrease with r */ \
    F(heat) F(heat_index)  /* log2 of Theta at r = 1 M; exponent of its decrease with r */ \
    F(steep)                /* ratio of distance from the axis to the layer's height; 0 if there is no layer */ \
    F(field) F(field_index) /* log2 of B^2/n in gauss^2 cm^3 at r = 1 M; exponent of its decrease with r */ \
    F(power_index) F(power_light) F(power_depth) /* electrons' power law: index, factors of light and depth */ \
    F(torus_momentum) F(torus_edge) F(torus_index) /* torus: angular momentum, offset of ln h, exponent of h - 1 */ \
    U(grid_rows) U(grid_columns) U(grid_layers) /* grid: nodes in r, theta and phi (1 in phi if axisymmetric) */ \
    U(grid_steps) U(grid_place_rows) /* uneven columns: cells in theta (0: even); rows of their table */ \
    /* grid, for each of log2 r, theta and phi: coordinate of the first node, and number of nodes per unit */ \
    F(grid_r) F(grid_per_r) F(grid_theta) F(grid_per_theta) F(grid_phi) F(grid_per_phi) \
    F(grid_fall)           /* a if the grid's phi is an ingoing coordinate, otherwise 0 */ \
    F(grid_field)          /* log2 of the unit of the grid's field, gauss */ \
    U(grid_frames)         /* number of frames in time; a frame's nodes are stored together */ \
    F(grid_now) F(grid_per_time) /* number, with a fraction, of the frame at the scene's time; frames per M of time */ \
    F(grid_late)           /* 1 if the grid's time is that of ingoing coordinates, otherwise 0 */ \
    U(grid_packed)         /* 1 if a node is one quad, 0 if it is two */ \
    /* packed nodes: least value and range of log2 density; the same of log2 Theta; units of velocity and of field */ \
    F(grid_density) F(grid_densities) F(grid_heat) F(grid_heats) F(grid_speed) F(grid_scale) \
    F(kappa) F(kappa_width) /* for a kappa distribution. `kappa` is log2(kappa - 3). */ \
    /* constants of the kappa distribution, named as in physics/disk/synchrotron.h */ \
    F(kappa_light_low) F(kappa_light_high) F(kappa_light_sharp) F(kappa_depth_low) F(kappa_depth_high) \
    F(kappa_depth_sharp)
/* clang-format on */
#define KD_KAPPA_FIRST -10.0 /* log2(z) of the table's first row */
#define KD_KAPPA_OCTAVE 16   /* number of rows for each octave of z */
#define KD_KAPPA_ROWS 640
/* log2 of F(z), and the difference from this row to the next */
#define KD_TABLES_plasma(T) T(kappa, KD_KAPPA_ROWS)
#define KD_TRAIT_PLASMA_GOLD 2u
#define KD_TRAIT_PLASMA_VERTICAL 4u /* the field is along the axis */
#define KD_TRAIT_PLASMA_RADIAL 8u   /* the field is along the radius. If neither trait is set, it is round the axis */
#define KD_TRAIT_PLASMA_REST \
    512u /* the matter is at rest for observers of zero angular momentum; otherwise it orbits and falls in */
#define KD_TRAIT_PLASMA_POWER 64u /* the electrons have a power law */
#define KD_TRAIT_PLASMA_TORUS 128u
#define KD_TRAIT_PLASMA_KAPPA 256u   /* the electrons have a kappa distribution */
#define KD_TRAIT_PLASMA_GRID 1024u   /* matter and field are read from a buffer: src/render/emit/matter_grid.h */
#define KD_TRAIT_PLASMA_SERIES 2048u /* the grid may have several frames in time */
/* clang-format off */
#define KD_TRAITS_plasma(T) \
    T(PLASMA_GOLD) \
    T(PLASMA_VERTICAL) T(PLASMA_RADIAL) T(PLASMA_REST) T(PLASMA_POWER) T(PLASMA_TORUS) T(PLASMA_KAPPA) T(PLASMA_GRID) \
        T(PLASMA_SERIES) T(SLOW) T(AZIMUTH)
/* clang-format on */
#define KD_BUFFERS_plasma(B) B(5, quads, plasma_grid) B(6, quad_texels, plasma_texels)
#define KD_GRID_CELLS 2.0 /* largest number of cells of the matter grid that a grain covers */
#define KD_PASS_plasma(P)
#define KD_TORUS_COLD -24.0 /* value in place of log2(h - 1) if h is 1 */
#define KD_PLASMA_SEEN \
    7.0 /* in scale heights; beyond this the density is taken as 0, as it is below 2e-11 of that in the plane */
#endif

#ifdef KD_EMIT_CODE
#include "emit/synchrotron.glsl"

/* The metric at a place, as observers of zero angular momentum measure it (Bardeen, Press & Teukolsky 1972). lapse2:
 * square of their lapse. omega: their angular velocity. round_: g_phiphi. radial: g_rr. sigma: Sigma/r^2. */
struct kd_metric { float lapse2, omega, round_, radial, sigma; };
kd_metric kd_metric_at(float w, float u)
{
    float s2 = max(1.0 - u * u, 1e-12);
    kd_place at = kd_place_at(w, u, s2);
    return kd_metric(at.sigma * at.delta / at.area, at.omega, at.area * s2 / (at.sigma * w * w), at.sigma / at.delta,
                     at.sigma);
}

/* Velocity of matter. time: u^t. round_: u_phi, from which u^phi = omega u^t + u_phi/g_phiphi. out_: u^r. down:
 * u^theta, which is 0 except on a grid. */
struct kd_flow { float time, round_, out_, down; };
const bool KD_PLASMA_GRID = (TRAITS_plasma & KD_TRAIT_PLASMA_GRID) != 0u;

/* The photon's energy -k.u in the frame of the matter, from the photon's E, L and p_r. */
float kd_flow_energy(kd_flow v, kd_metric g, kd_midst p)
{
    float energy = v.time * (p.energy - g.omega * p.momentum) - v.round_ * p.momentum / g.round_ -
                   v.out_ * p.dw * g.radial / g.sigma;
    if (KD_PLASMA_GRID)
        energy -= v.down * p.du * inversesqrt(max(1.0 - p.u * p.u, 1e-12));
    return max(energy, 1e-12);
}

/* Velocity in the model of Gold et al.: u_mu = u_t (1, 0, 0, -l), with l = l0 R^(3/2)/(1 + R) and R = r sin(theta). */
kd_flow kd_flow_gold(kd_metric g, kd_midst p)
{
    float axis = sqrt(max(1.0 - p.u * p.u, 0.0)) / p.w,
          l = emission.plasma.gold_momentum * axis * sqrt(axis) / (1.0 + axis), seen = 1.0 - g.omega * l;
    float scale = inversesqrt(max(seen * seen / g.lapse2 - l * l / g.round_, 1e-30));
    return kd_flow(scale * seen / g.lapse2, scale * l, 0.0, 0.0);
}

/* Velocity of matter that has, at any latitude, the angular velocity of the circular orbit at its r. */
kd_flow kd_flow_round(kd_metric g, float r)
{
    float past = 1.0 / kd_circle_time(r) - g.omega, time = inversesqrt(max(g.lapse2 - g.round_ * past * past, 1e-12));
    return kd_flow(time, g.round_ * past * time, 0.0, 0.0);
}

/* Velocity of matter inside the ISCO. It stays at its latitude, and keeps the energy e and the angular momentum l that
 * it has at the ISCO at that latitude (H.-Y. Pu, K. Akiyama & K. Asada 2016, ApJ 831, 4). Then Sigma^2 (u^r)^2 = A e^2
 * - 2 a m e l - (Sigma - m) l^2/sin^2 - Sigma Delta, with m = 2r - q^2, is a quartic that vanishes at the ISCO. The
 * quartic is computed as a product with r - r_isco, which avoids differences of nearly equal numbers. Off the plane the
 * quartic may be negative; matter there does not fall, and rotates with the angular velocity of e and l. */
kd_flow kd_flow_plunge(kd_metric g, kd_midst p)
{
    float r = 1.0 / p.w, edge = emission.frame.r_isco, a2 = cam.spin * cam.spin, u2 = p.u * p.u,
          s2 = max(1.0 - u2, 1e-12);
    kd_metric there = kd_metric_at(1.0 / edge, p.u);
    kd_flow v = kd_flow_round(there, edge);
    float l = v.round_, e = there.lapse2 * v.time + there.omega * l, l2 = l * l / s2;
    float c3 = 2.0, c4 = e * e - 1.0, c2 = kd_body_quadratic(a2 * (1.0 + u2) * c4 - l2),
          c1 = 2.0 * (a2 * (s2 * e * e + u2) + l2 - 2.0 * cam.spin * e * l);
    float b2 = c3 + edge * c4, b1 = c2 + edge * b2, b0 = c1 + edge * b1;
    float out2 = (r - edge) * (b0 + r * (b1 + r * (b2 + r * c4))) * p.w * p.w * p.w * p.w / (g.sigma * g.sigma);
    float seen = e - g.omega * l,
          rest = out2 < 0.0 ? inversesqrt(max(seen * seen / g.lapse2 - l * l / g.round_, 1e-12)) : 1.0;
    return kd_flow(rest * seen / g.lapse2, rest * l, -sqrt(max(out2, 0.0)), 0.0);
}

/* -ln(1 - z), for z from 0 to 1. GLSL's logarithm has an absolute error of 5e-7 near 1, so 2 artanh(y) is used. The
 * next term of its series is below 1e-8 of the result. */
float kd_less_ln(float z)
{
    float y = z / (2.0 - z), y2 = y * y;
    return y2 < 0.04 ? y * (2.0 + y2 * (2.0 / 3.0 + y2 * (2.0 / 5.0 + y2 * (2.0 / 7.0 + y2 * (2.0 / 9.0)))))
                     : -log(1.0 - z);
}

/* The torus of L. G. Fishbone & V. Moncrief 1976 (ApJ 207, 962), in which u^t u_phi = l everywhere. With u_phi^2 =
 * g_phiphi U^2 and u^t = sqrt(1 + U^2)/lapse this condition is U^2 (1 + U^2) = l^2 lapse^2/g_phiphi = q/4. Their
 * equation 3.6 is ln h = ln((1 + sqrt(1 + q))/lapse^2)/2 - sqrt(1 + q)/2 - omega l. ln h is about a hundredth, a
 * difference of numbers near 1. Therefore the code computes it from two small numbers: from U^2 = (sqrt(1 + q) - 1)/2,
 * which contributes ln(1 + U^2)/2 - U^2, and from 1 - lapse^2 = (2r - q^2) (r^2 + a^2)/A. */
struct kd_equilibrium {
    kd_flow flow;
    float enthalpy;
}; /* ln h */
kd_equilibrium kd_torus_at(kd_metric g, kd_midst p)
{
    float l = emission.plasma.torus_momentum, q = 4.0 * l * l * g.lapse2 / g.round_,
          u2 = 0.5 * q / (1.0 + sqrt(1.0 + q)), b = 1.0 + cam.spin * cam.spin * p.w * p.w;
    float area = g.round_ * g.sigma * p.w * p.w / max(1.0 - p.u * p.u, 1e-12),
          lapsed = min(kd_mass_term(p.w) * b / area, 1.0);
    precise float ln_h =
        0.5 * (kd_less_ln(lapsed) + kd_less_ln(u2 / (1.0 + u2))) - u2 - g.omega * l - emission.plasma.torus_edge;
    return kd_equilibrium(kd_flow(sqrt((1.0 + u2) / g.lapse2), sqrt(g.round_ * u2) * sign(l), 0.0, 0.0), ln_h);
}

/* State of the matter at a place, for a photon that arrives at the observer. energy: -k.u, the ratio of the photon's
 * frequency in the frame of the matter to the observed one. frequency: log2 of the frequency in the frame of the
 * matter, in GHz. field: the unit vector along B, with b.u = 0, as contravariant components t, r, theta, phi of
 * Boyer-Lindquist coordinates. */
struct kd_plasma {
    kd_electrons electrons;
    kd_flow flow;
    kd_metric around;
    float energy, frequency;
    vec4 field;
};

/* Makes a direction e of the field perpendicular to u. The result is b = e + (e.u) u, and k.b = k.e - energy e.u. e has
 * the components along r, theta (times 1/sin(theta)) and phi. */
void kd_plasma_field(inout kd_plasma m, kd_midst p)
{
    float s = sqrt(max(1.0 - p.u * p.u, 1e-12)), r2 = 1.0 / (p.w * p.w), out_ = 0.0, down = 0.0, round_ = 0.0;
    if ((TRAITS_plasma & KD_TRAIT_PLASMA_VERTICAL) != 0u) {
        out_ = p.u;
        down = -p.w; /* component along theta, times sin(theta) */
    } else if ((TRAITS_plasma & KD_TRAIT_PLASMA_RADIAL) != 0u)
        out_ = 1.0;
    else
        round_ = 1.0;
    float in_u = out_ * m.around.radial * m.flow.out_ + round_ * m.flow.round_;
    float length_ = inversesqrt(max(out_ * out_ * m.around.radial + down * down * s * s * m.around.sigma * r2 +
                                        round_ * round_ * m.around.round_ + in_u * in_u,
                                    1e-30));
    float k = out_ * p.dw * m.around.radial / m.around.sigma + down * p.du + round_ * p.momentum;
    m.electrons.cosine = clamp((k / m.energy - in_u) * length_, -1.0, 1.0);
    m.electrons.sine2 = max((1.0 - m.electrons.cosine) * (1.0 + m.electrons.cosine), 0.0);
    float turn = m.around.omega * m.flow.time + m.flow.round_ / m.around.round_;
    m.field = length_ * vec4(in_u * m.flow.time, out_ + in_u * m.flow.out_, down * s, round_ + in_u * turn);
}

#include "emit/grid.glsl"

/* State of the matter on a grid. Any values of u^r, u^theta and u_phi belong to a timelike unit vector, because
 * -lapse^2 (u^t)^2 = -1 - U^2. Here U has the components of the velocity for the observer of zero angular momentum. Let
 * B be the same components of b. Then b.u = 0 gives lapse b^t = B.U/sqrt(1 + U^2), and b^2 = (B^2 + (B x U)^2)/(1 +
 * U^2). These forms have no difference of large numbers near the horizon. */
kd_plasma kd_plasma_of_grid(kd_midst p, float log2_r)
{
    kd_plasma m;
    kd_grid_node n = kd_grid_at(p, log2_r);
    m.around = kd_metric_at(p.w, p.u);
    float s = sqrt(max(1.0 - p.u * p.u, 1e-12)), r = 1.0 / p.w;
    n.rest *= vec4(s * s, 1.0, 1.0, s * s);
    vec3 size = vec3(sqrt(m.around.radial), sqrt(m.around.sigma), r * inversesqrt(m.around.round_));
    vec3 flow = size * vec3(n.matter.zw, n.rest.x), field = size * n.rest.yzw, across = cross(field, flow);
    float all = 1.0 + dot(flow, flow), root = sqrt(all), lapse = sqrt(m.around.lapse2),
          b2 = max((dot(field, field) + dot(across, across)) / all, 1e-36), one = inversesqrt(b2);
    m.flow = kd_flow(root / lapse, r * n.rest.x, n.matter.z, p.w * n.matter.w);
    m.energy = kd_flow_energy(m.flow, m.around, p);
    m.frequency = emission.plasma.frequency + log2(m.energy);
    m.electrons.density = emission.plasma.density + n.matter.x;
    m.electrons.heat = n.matter.y;
    m.electrons.field = emission.plasma.grid_field + 0.5 * (emission.plasma.density + log2(b2));
    float time = dot(field, flow) / (root * lapse), around = r * n.rest.w;
    float k = n.rest.y * p.dw * m.around.radial / m.around.sigma + p.w * n.rest.z * p.du / s +
              around * p.momentum / m.around.round_ - time * (p.energy - m.around.omega * p.momentum);
    m.electrons.cosine = clamp(one * k / m.energy, -1.0, 1.0);
    m.electrons.sine2 = max((1.0 - m.electrons.cosine) * (1.0 + m.electrons.cosine), 0.0);
    m.field = one * vec4(time, n.rest.y, p.w * n.rest.z, m.around.omega * time + around / m.around.round_);
    return m;
}

#ifdef KD_MARCH
void kd_stokes_at(kd_plasma m, kd_midst p, float light, float depth, float depth_log2); /* emit/stokes.glsl */
#endif

/* State of the matter at a place: electrons in a layer about the plane, by power laws of r; or electrons of a torus. */
kd_plasma kd_plasma_at(kd_midst p)
{
    if (KD_PLASMA_GRID)
        return kd_plasma_of_grid(p, -log2(p.w));
    kd_plasma m;
    float log2_r = -log2(p.w),
          x2 = p.u * p.u / max(1.0 - p.u * p.u, 1e-12) * emission.plasma.steep * emission.plasma.steep;
    m.around = kd_metric_at(p.w, p.u);
    float more = 0.0; /* log2(h - 1) */
    if ((TRAITS_plasma & KD_TRAIT_PLASMA_TORUS) != 0u) {
        kd_equilibrium torus = kd_torus_at(m.around, p);
        m.flow = torus.flow;
        more = torus.enthalpy > 0.0 ? kd_log2_expm1(log2(torus.enthalpy)) : KD_LOG2_LEAST;
    } else if ((TRAITS_plasma & KD_TRAIT_PLASMA_REST) != 0u)
        m.flow = kd_flow(inversesqrt(m.around.lapse2), 0.0, 0.0, 0.0);
    else if (p.w * emission.frame.r_isco <= 1.0)
        m.flow = kd_flow_round(m.around, 1.0 / p.w);
    else
        m.flow = kd_flow_plunge(m.around, p);
    m.energy = kd_flow_energy(m.flow, m.around, p);
    m.frequency = emission.plasma.frequency + log2(m.energy);
    m.electrons.density =
        emission.plasma.density - emission.plasma.density_index * log2_r - 0.5 * KD_LOG2_E * min(x2, 1e6);
    m.electrons.heat = emission.plasma.heat - emission.plasma.heat_index * log2_r;
    if ((TRAITS_plasma & KD_TRAIT_PLASMA_TORUS) != 0u) {
        m.electrons.density = emission.plasma.density + emission.plasma.torus_index * more;
        /* no fit is valid at zero temperature, but where it is zero there is no matter */
        m.electrons.heat = emission.plasma.heat + max(more, KD_TORUS_COLD);
        m.electrons.field = 0.5 * (m.electrons.density + emission.plasma.field + more);
    } else
        m.electrons.field = 0.5 * (m.electrons.density + emission.plasma.field - emission.plasma.field_index * log2_r);
    kd_plasma_field(m, p);
    return m;
}

/* Smooth minimum of a and b, which is sharper for larger s: log2((2^-sa + 2^-sb)^(-1/s)). */
float kd_log2_joined(float a, float b, float s)
{
    return min(a, b) - log2(1.0 + exp2(-min(s * abs(a - b), 120.0))) / s;
}

/* Values for a kappa distribution (physics/disk/synchrotron.h): log2 of z, of X, and of the laws of light and depth for
 * low and for high frequencies. */
struct kd_kappa_laws { float z, x, light_low, light_high, depth_low, depth_high; };
kd_kappa_laws kd_kappa_of(kd_electrons e, float frequency)
{
    float turn = e.field + KD_LOG2_GYRO, slant = 0.5 * log2(max(e.sine2, 1e-30)),
          z = e.heat + emission.plasma.kappa_width, k = emission.plasma.kappa;
    float x = clamp(frequency - turn - slant - 2.0 * z, -600.0, 600.0),
          place = clamp((z - KD_KAPPA_FIRST) * float(KD_KAPPA_OCTAVE), 0.0, float(KD_KAPPA_ROWS - 1)),
          row = floor(place);
    vec4 f = kd_table_row(kappa, uint(row));
    float below = min(z - KD_KAPPA_FIRST, 0.0) * (k - 1.0 / 3.0),
          size = f.x + (place - row) * f.y + below; /* below the table's first row F(z) follows the law z^a */
    return kd_kappa_laws(z, x, emission.plasma.kappa_light_low + x * (1.0 / 3.0),
                         emission.plasma.kappa_light_high - 0.5 * (k - 2.0) * x,
                         emission.plasma.kappa_depth_low + size - x * (2.0 / 3.0),
                         emission.plasma.kappa_depth_high - 0.5 * (k + 1.0) * x);
}

kd_radiates kd_plasma_kappa(kd_electrons e, float frequency)
{
    kd_kappa_laws of = kd_kappa_of(e, frequency);
    float light = kd_log2_joined(of.light_low, of.light_high, emission.plasma.kappa_light_sharp),
          depth = kd_log2_joined(of.depth_low, of.depth_high, emission.plasma.kappa_depth_sharp);
    return kd_radiates(e.density + e.field + KD_LOG2_GYRO + 0.5 * log2(max(e.sine2, 1e-30)) + light,
                       e.density - frequency + depth - 3.0 * of.z, 0.5 * emission.plasma.kappa);
}

kd_radiates kd_plasma_gives(kd_plasma m)
{
    if ((TRAITS_plasma & KD_TRAIT_PLASMA_POWER) != 0u)
        return kd_synchrotron_by_power(m.electrons, m.frequency, emission.plasma.power_index,
                                       emission.plasma.power_light, emission.plasma.power_depth);
    if ((TRAITS_plasma & KD_TRAIT_PLASMA_KAPPA) != 0u)
        return kd_plasma_kappa(m.electrons, m.frequency);
    return kd_synchrotron_thermal(m.electrons, m.frequency);
}

/* Makes the medium from the log2 of light and depth. Where the depth exceeds 2^24 per M, light and depth are reduced by
 * the same factor. This changes nothing that is seen, because so opaque matter hides everything behind it. Light of
 * such matter is correct up to 6e28 K. Light of thin matter is limited to 2^99 per length, beyond the range of layers
 * (src/render/frame/layers.c). */
kd_medium kd_plasma_medium(float light, float depth, float grain)
{
    float over = max(depth - 24.0, 0.0);
    light -= over;
    depth -= over;
    return kd_medium(vec3(light > -126.0 ? exp2(min(light, 99.0)) : 0.0), depth > -126.0 ? exp2(depth) : 0.0, grain);
}

/* Distance along the ray, M, over which a layer exp(-x^2/2), x = steep u/sin(theta), and its field vary. Inside the
 * layer it follows from the layer's height and the place. Outside, it is the distance to the layer. sharp: `steep` of
 * kd_radiates. */
float kd_plasma_grain(kd_midst p, float steep, float sharp)
{
    float r = 1.0 / p.w, per = 1.0 / p.speed, s2 = max(1.0 - p.u * p.u, 1e-6), turn = abs(p.du) * per * r,
          along = abs(p.dw) * r * r * per;
    float near_ = 0.6 * max(r - 1.0 / cam.horizon, 1e-4 * r), x = steep * abs(p.u) * inversesqrt(s2);
    float up = steep * turn / s2 * max(1.0, 0.5 * min(x, KD_PLASMA_SEEN) * (1.0 + 0.5 * sharp));
    if (KD_PLASMA_GRID)
        return kd_grid_grain(p, sharp);
    if ((TRAITS_plasma & KD_TRAIT_PLASMA_TORUS) != 0u)
        return r / (4.0 + sharp);
    return 1.0 / ((0.6 + 0.3 * sharp * along) * p.w + along * max(0.4 / near_ - 0.67 * p.w, 0.0) + 0.65 * up * p.w);
}

kd_medium kd_plasma_gold(kd_midst p)
{
    float r = 1.0 / p.w, x = emission.plasma.gold_flat * p.u,
          grain = kd_plasma_grain(p, emission.plasma.gold_flat, 0.0);
    kd_metric g = kd_metric_at(p.w, p.u);
    float up = log2(kd_flow_energy(kd_flow_gold(g, p), g, p)), n = -0.5 * KD_LOG2_E * min(0.01 * r * r + x * x, 1e6),
          index = emission.plasma.gold_index;
    grain = 1.0 / (1.0 / grain + 0.4 * abs(p.dw) * r * r / p.speed * min(0.01 * r, 1.0));
    return kd_plasma_medium(emission.plasma.gold_light + n - (2.0 + index) * up,
                            emission.plasma.gold_depth + n - (1.5 + index) * up, grain);
}

kd_medium kd_plasma_along(kd_midst p)
{
    float r = 1.0 / p.w;
    kd_medium medium;
    if ((TRAITS_plasma & KD_TRAIT_PLASMA_GOLD) != 0u)
        medium = kd_plasma_gold(p);
    else {
        kd_plasma m = kd_plasma_at(p);
        kd_radiates gives = kd_plasma_gives(m);
        float up = m.frequency - emission.plasma.frequency;
        medium =
            kd_plasma_medium(gives.light + emission.plasma.light - 2.0 * up, gives.depth + emission.plasma.depth + up,
                             kd_plasma_grain(p, emission.plasma.steep, gives.steep));
#ifdef KD_MARCH
        if (KD_HAS(stokes) && r >= emission.plasma.inner && r <= emission.plasma.outer)
            kd_stokes_at(m, p, medium.light.x, medium.depth, gives.depth + emission.plasma.depth + up);
#endif
    }
    if (r < emission.plasma.inner || r > emission.plasma.outer)
        return kd_medium(vec3(0.0), 0.0, max(max(emission.plasma.inner - r, r - emission.plasma.outer), 0.1 * r));
    /* Off the plane infall begins as the square root of the distance to the ISCO. Stretches are therefore shorter near
     * the ISCO. */
    if ((TRAITS_plasma &
         (KD_TRAIT_PLASMA_GOLD | KD_TRAIT_PLASMA_REST | KD_TRAIT_PLASMA_TORUS | KD_TRAIT_PLASMA_GRID)) == 0u &&
        r < emission.frame.r_isco)
        medium.grain = min(medium.grain, max(0.8 * (emission.frame.r_isco - r), 2e-3 * r));
    float edge =
        /* distances to the edges; the march does not search for edges that lie inside the bounds of other volumes */
        min(abs(r - emission.plasma.inner), abs(r - emission.plasma.outer));
    medium.grain = KD_VOLUMES > 1 ? min(medium.grain, max(edge, 2.5e-4 * r)) : medium.grain;
    return medium;
}
#endif
