/* Polarised synchrotron light of hot electrons in a magnetic field, and the effects of these electrons on passing
 * light: absorption of each polarisation, rotation of its direction (Faraday rotation), and conversion between linear
 * and circular polarisation. Q > 0 is light whose electric field is perpendicular to the magnetic field. All
 * coefficients are fits:
 *
 *   thermal     j_I and j_Q of A. Pandya et al. 2016 (ApJ 822, 34, equation 31); j_V/j_I and rho_Q of J. Dexter 2016
 *               (MNRAS 462, 115, A1 to A3, B4 to B13); rho_V of R. V. Shcherbakov 2008 (ApJ 688, 695, equation 33), or
 *               of L. Huang & R. V. Shcherbakov 2011 (MNRAS 416, 2574) as given by Dexter 2016 (B14, B15), with Bessel
 *               functions by M. Abramowitz & I. A. Stegun 1964, 9.8.1 to 9.8.8; absorption by Kirchhoff's law
 *   kappa       Pandya et al. 2016, equations 35 to 44; rho_Q and rho_V of A. Marszewski, B. S. Prather, A. V.
 *               Joshi, A. Pandya & C. F. Gammie 2021 (ApJ 921, 17), which are for kappa 3.5, 4, 4.5 and 5, with linear
 *               interpolation between them
 *   power law   Pandya et al. 2016, equations 33 and 34; rho_Q and rho_V of T. W. Jones & S. L. O'Dell 1977 (ApJ
 *               214, 522), as given by Dexter 2016 (B1 to B3), rho_Q with the sign of thermal electrons of the same
 *               mean energy: both are 2 <gamma> times the same numbers at high frequencies
 *
 * V > 0 means that the electric field rotates anticlockwise on the sky (IAU 1973). Electrons emit such light where the
 * magnetic field points to the observer. rho_V > 0 rotates the angle from north to east.
 *
 * The constant of Walker & Penrose carries the direction of the field to the observer, as in emit/polarization.glsl.
 * Across the ray the field is b + cos(theta_B) u, up to a multiple of k. */
#ifndef KD_BLOCK_stokes
/* clang-format off */
#define KD_BLOCK_stokes(F, U, A) \
    F(turn) F(convert) /* power law: log2 of the factors of rho_V and of rho_Q */ \
    F(gamma2)          /* log2 of the squared least gamma of the power law */ \
    /* parameters of a kappa distribution, as in physics/disk/synchrotron.h */ \
    F(kappa_light_q) F(kappa_light_q_sharp) F(kappa_light_v_low) F(kappa_light_v_high) \
    F(kappa_depth_q) F(kappa_depth_q_sharp) F(kappa_depth_v_low) F(kappa_depth_v_high) F(kappa_depth_v_sharp) \
    U(kappa_node) F(kappa_past) /* index of the fits' next lower kappa; fraction of the way to the next higher one */ \
    F(whole)           /* fraction of linear polarisation that remains in a disordered field */
/* clang-format on */
#define KD_TABLES_stokes(T)
#define KD_TRAIT_STOKES_FARADAY 2u
#define KD_TRAIT_STOKES_DEXTER 4u /* rho_V of thermal electrons follows Dexter 2016 */
#define KD_TRAITS_stokes(T) T(STOKES_FARADAY) T(STOKES_DEXTER)
#define KD_BUFFERS_stokes(B)
#define KD_PASS_stokes(P)
#endif

#if defined(KD_EMIT_CODE) && defined(KD_MARCH)
#include "light/stokes.glsl"

#define KD_STOKES_MOST \
    0.99 /* largest polarised fraction of emission and of absorption: Q and V of the fits are reduced in proportion to \
          * it */

/* State along the ray. here: the medium at the current place, per unit of the affine parameter. right: kappa of the
 * unit vector that points right in the picture. seen: Q, U and V of the light so far. front: transfer of the medium
 * passed so far, for light from behind that medium. */
kd_stokes kd_stokes_here = kd_stokes(vec4(0.0), 0.0, vec3(0.0), vec3(0.0));
vec2 kd_stokes_right = vec2(0.0);
vec3 kd_stokes_seen = vec3(0.0);
kd_jones kd_stokes_front = kd_jones(vec2(1.0, 0.0), vec3(0.0), vec3(0.0));

/* Ratios of modified Bessel functions K0, K1, K2 of the argument 1/Theta: K0/K2, K1/K2, and 1/K2 (set to 0 if 1/Theta
 * is above 2). */
vec3 kd_stokes_bessel(float log2_heat)
{
    float x = exp2(clamp(-log2_heat, -40.0, 40.0)), y = min(0.25 * x * x, 1.0), t = y * 0.28444444,
          z = 2.0 / max(x, 2.0), l = log(0.5 * min(x, 2.0));
    float i0 =
        1.0 + t * (3.5156229 + t * (3.0899424 + t * (1.2067492 + t * (0.2659732 + t * (0.0360768 + t * 0.0045813)))));
    float i1 = 0.5 + t * (0.87890594 +
                          t * (0.51498869 + t * (0.15084934 + t * (0.02658733 + t * (0.00301532 + t * 0.00032411)))));
    float k0 =
        -l * i0 - 0.57721566 +
        y * (0.42278420 + y * (0.23069756 + y * (0.03488590 + y * (0.00262698 + y * (0.00010750 + y * 0.00000740)))));
    float k1 = 4.0 * y * l * i1 + 1.0 +
               y * (0.15443144 + y * (-0.67278579 +
                                      /* the polynomial, times x */
                                      y * (-0.18156897 + y * (-0.01919402 + y * (-0.00110404 - y * 0.00004686)))));
    float p0 =
        1.25331414 + z * (-0.07832358 +
                          z * (0.02189568 + z * (-0.01062446 + z * (0.00587872 + z * (-0.00251540 + z * 0.00053208)))));
    float p1 =
        1.25331414 +
        z * (0.23498619 + z * (-0.03655620 + z * (0.01504268 + z * (-0.00780353 + z * (0.00325614 - z * 0.00068245)))));
    return x < 2.0 ? vec3(4.0 * y * k0, x * k1, 4.0 * y) / (4.0 * y * k0 + 2.0 * k1)
                   : vec3(p0, p1, 0.0) / (p0 + z * p1);
}

/* rho_Q at high temperatures divided by its limit for high frequencies (Dexter 2016, B8 and B13). */
float kd_stokes_converts(float log2_x)
{
    float x = exp2(clamp(log2_x, -40.0, 40.0)), far = max(x, 30.0);
    float most = clamp((log(far) - 4.78749174) * 10.0, -9.0, 9.0), step_ = x > 30.0 ? 0.5 + 0.5 * tanh(most) : 0.0,
          tail = 0.011 * exp(-x / 47.2);
    return 2.011 * exp(-pow(x, 1.035) / 4.7) - kd_cos_sin(0.5 * min(x, 200.0)).c * exp(-pow(x, 1.2) / 2.73) - tail +
           step_ * (tail - 369.7 * pow(far, -8.0 / 3.0));
}

/* rho_V of thermal electrons, divided by 2 n e^2 nu_c cos(theta)/(m_e c nu^2):
 *
 *   Shcherbakov 2008   K0/K2 (1 - 0.11 ln(1 + 0.035 X))
 *   Dexter 2016        (K0 - 0.43793091 ln(1 + 0.00185777 X^1.50316886))/K2
 *
 * Dexter's form is a fit for hot electrons. For Theta below 1/2, where both forms are nearly K0/K2, Shcherbakov's is
 * used. k: result of kd_stokes_bessel. */
float kd_stokes_rotates(vec3 k, float log2_x)
{
    float x = exp2(clamp(log2_x, -60.0, 60.0));
    if ((TRAITS_stokes & KD_TRAIT_STOKES_DEXTER) != 0u && k.z > 0.0)
        return k.x - 0.43793091 * log(1.0 + 0.00185777 * exp2(1.50316886 * clamp(log2_x, -60.0, 60.0))) * k.z;
    return k.x * max(1.0 - 0.11 * log(1.0 + 0.035 * x), 0.0);
}

/* light, depth: ratios of Q and V to I, for emission and for absorption. turns, signs: log2 of the absolute values of
 * rho_Q and rho_V, and their signs. */
struct kd_polarises { vec2 light, depth, turns, signs; };

vec2 kd_stokes_held(vec2 part)
{
    part = clamp(part, vec2(-1e15), vec2(1e15));
    return part * min(1.0, KD_STOKES_MOST / max(length(part), 1e-30));
}

kd_polarises kd_stokes_thermal(kd_electrons e, float frequency)
{
    float turn = e.field + KD_LOG2_GYRO, slant = 0.5 * log2(max(e.sine2, 1e-30)),
          cotangent = e.cosine * inversesqrt(max(e.sine2, 1e-30)), x = frequency - turn - slant - 2.0 * e.heat;
    float y = exp2(clamp((x + 2.169925) * (1.0 / 3.0), -30.0, 30.0)), hot = exp2(0.96 * clamp(e.heat, -60.0, 60.0));
    float q = (y + (7.0 * hot + 35.0) / (10.0 * hot + 75.0) * 1.887748625) / (y + 1.887748625),
          z = exp2(clamp(-(x - 0.5849625) * (1.0 / 3.0), -30.0, 30.0));
    float v =
        z * (2.03773 + 0.0292545 * sqrt(z) + z * (3.42319 + z * 1.81348)) / (2.5651 * (1.0 + z * (1.92 + z * 0.9977)));
    kd_polarises p;
    p.light = kd_stokes_held(vec2(q * q, (4.0 / 3.0) * cotangent * exp2(-clamp(e.heat, -40.0, 40.0)) * v));
    p.depth = p.light;
    float xf = e.heat + 0.5 * (0.5 + 9.96578428 + slant + turn - frequency), f = kd_stokes_converts(xf);
    vec3 k = kd_stokes_bessel(e.heat);
    float rotates = kd_stokes_rotates(k, xf), heat = 6.0 * exp2(min(e.heat, 100.0));
    p.turns = vec2(2.0 * turn - 3.0 * frequency + 2.0 * slant + log2(max(abs(f) * (k.y + heat), 1e-37)),
                   1.0 + turn - 2.0 * frequency + log2(max(abs(rotates) * abs(e.cosine), 1e-37)));
    p.signs = vec2(sign(f), sign(e.cosine) * (rotates < 0.0 ? -1.0 : 1.0));
    return p;
}

kd_polarises kd_stokes_by_power(kd_electrons e, float frequency, float index)
{
    float turn = e.field + KD_LOG2_GYRO, slant = 0.5 * log2(max(e.sine2, 1e-30)),
          cotangent = e.cosine * inversesqrt(max(e.sine2, 1e-30)), x = frequency - turn - slant;
    float root = exp2(clamp(-0.5 * x, -40.0, 40.0)), way = sign(e.cosine),
          open_ = exp2(min(-1.92 * slant, 100.0)) - 1.0;
    kd_polarises p;
    p.light = kd_stokes_held(
        vec2((index + 1.0) / (index + 7.0 / 3.0), 0.684 * pow(index, 0.49) * 1.73205081 * cotangent * root));
    p.depth = kd_stokes_held(vec2(pow(0.034 * index - 0.0344, 0.086), way * pow(0.71 * index + 0.0352, 0.394) *
                                                                          pow(max(3.1 * open_, 1e-30), 0.512) * root));
    /* l: (1 - y^n)/n with n = p/2 - 1 and y = gamma_min^2 nu_c sin(theta)/nu; 0 below the frequency of the slowest
     * electrons. */
    float n = 0.5 * index - 1.0, l = 0.69314718 * min(emission.stokes.gamma2 - x, 0.0), nl = n * l,
          less = abs(nl) < 0.01 ? -l * (1.0 + 0.5 * nl) : (1.0 - exp(min(nl, 80.0))) / n;
    p.turns = vec2(emission.stokes.convert + 2.0 * turn - 3.0 * frequency + 2.0 * slant + log2(max(less, 1e-37)),
                   emission.stokes.turn + turn - 2.0 * frequency + log2(max(abs(e.cosine), 1e-37)));
    p.signs = vec2(1.0, way);
    return p;
}

/* Fits of Marszewski et al. 2021 for kappa = 3.5 + node/2, at w = exp2(log2_w) and X. First result: rho_Q divided by n
 * e^2 nu_c^2 sin^2(theta)/(m_e c nu^3). Second: rho_V divided by 2 n e^2 nu_c cos(theta)/(m_e c nu^2) K0/K2. */
vec2 kd_stokes_marszewski(uint node, float log2_w, float log2_x)
{
    const vec3 widths[4] = vec3[](vec3(17.0, 3.0, 7.0), vec3(46.0 / 3.0, 5.0 / 3.0, 17.0 / 3.0), vec3(14.0, 1.625, 4.5),
                                  vec3(12.5, 1.0, 5.0));
    const vec4 shapes[4] = vec4[](vec4(1.0 / 30.0, 0.1, 1.5, 0.471), vec4(1.0 / 18.0, 1.0 / 6.0, 1.75, 0.5),
                                  vec4(1.0 / 12.0, 0.25, 2.0, 0.525), vec4(0.125, 0.375, 2.25, 0.541));
    const vec4 ratios[4] =
        vec4[](vec4(2.0, 1.0, 3.125, 4.0), vec4(54.0, 50.0, 30.0 / 11.0, 134.0), vec4(43.0, 38.0, 7.0 / 3.0, 92.5),
               vec4(13.0 / 14.0, 0.0, 2.0, 13.0 / 14.0)); /* the second column is divided by w */
    const float slows[4] = float[](0.447, 0.391, 0.348, 0.313);
    vec3 width = widths[node];
    vec4 shape = shapes[node], ratio = ratios[node];
    float w = exp2(clamp(log2_w, -40.0, 40.0)), root = sqrt(w), x = exp2(clamp(log2_x, -40.0, 40.0));
    /* beyond 1e3 the exponential is 0 */
    float bend = exp(-shape.z * pow(x, shape.w)) * kd_cos_sin(shape.y * min(x, 1e3)).s;
    float q =
        (1.0 - exp(-shape.x * pow(x, 0.84)) - bend) * (width.x * w - width.y * root + width.z * root * exp(-5.0 * w));
    float v = max(1.0 - 0.17 * log(1.0 + slows[node] * inversesqrt(x)), 0.0) * (w + ratio.x + ratio.y / w) /
              (ratio.z * w + ratio.w + ratio.y / w);
    return vec2(q, v);
}

kd_polarises kd_stokes_by_kappa(kd_electrons e, float frequency)
{
    float turn = e.field + KD_LOG2_GYRO, slant = 0.5 * log2(max(e.sine2, 1e-30)), way = sign(e.cosine), log2_w = 0.0;
    kd_kappa_laws of = kd_kappa_of(e, frequency);
    log2_w = of.z - log2(emission.plasma.kappa);
    /* log2 of sin^-n(theta) - 1, for the four powers n in the fits of V. */
    vec4 open_ = log2(max(exp2(min(-slant * vec4(2.4, 2.5, 2.28, 2.05), vec4(100.0))) - 1.0, vec4(1e-30)));
    float light = kd_log2_joined(of.light_low, of.light_high, emission.plasma.kappa_light_sharp),
          depth = kd_log2_joined(of.depth_low, of.depth_high, emission.plasma.kappa_depth_sharp);
    float light_q = kd_log2_joined(of.light_low - 1.0, of.light_high + emission.stokes.kappa_light_q,
                                   emission.stokes.kappa_light_q_sharp);
    float light_v =
        kd_log2_joined(of.light_low + emission.stokes.kappa_light_v_low - log2_w + 0.48 * open_.x - 0.35 * of.x,
                       of.light_high + emission.stokes.kappa_light_v_high - log2_w + 0.44 * open_.y - 0.5 * of.x,
                       emission.plasma.kappa_light_sharp);
    float depth_q = kd_log2_joined(of.depth_low - 0.9411063, of.depth_high + emission.stokes.kappa_depth_q,
                                   emission.stokes.kappa_depth_q_sharp);
    float depth_v =
        kd_log2_joined(of.depth_low + emission.stokes.kappa_depth_v_low - log2_w + 0.446 * open_.z - 0.35 * of.x,
                       of.depth_high + emission.stokes.kappa_depth_v_high - 0.928 * log2_w + 0.5 * open_.w - 0.5 * of.x,
                       emission.stokes.kappa_depth_v_sharp);
    kd_polarises p;
    p.light = kd_stokes_held(exp2(min(vec2(light_q, light_v) - light, vec2(40.0))) * vec2(1.0, way));
    p.depth = kd_stokes_held(exp2(min(vec2(depth_q, depth_v) - depth, vec2(40.0))) * vec2(1.0, way));
    vec2 turns =
        mix(kd_stokes_marszewski(emission.stokes.kappa_node, log2_w, of.x),
            kd_stokes_marszewski(min(emission.stokes.kappa_node + 1u, 3u), log2_w, of.x), emission.stokes.kappa_past);
    p.turns =
        vec2(2.0 * turn - 3.0 * frequency + 2.0 * slant + log2(max(abs(turns.x), 1e-37)),
             1.0 + turn - 2.0 * frequency + log2(max(kd_stokes_bessel(log2_w).x * turns.y * abs(e.cosine), 1e-37)));
    p.signs = vec2(sign(turns.x), way);
    return p;
}

/* Walker & Penrose's constant of k ^ f for the direction f, up to a positive factor. f: contravariant components t, r,
 * theta and phi in Boyer-Lindquist coordinates. */
vec2 kd_stokes_kappa(kd_midst p, kd_metric g, vec4 f)
{
    float a = cam.spin, aw2 = a * p.w * p.w, s2 = max(1.0 - p.u * p.u, 1e-12), s = sqrt(s2), size = sqrt(g.sigma),
          delta = kd_horizons(p.w, cam.root);
    float k_t = p.energy * (1.0 + a * aw2) - aw2 * p.momentum;
    vec2 ab =
        vec2(k_t * size * f.y / delta - p.dw * (f.x - a * s2 * f.w) / size,
             p.du * ((1.0 + a * aw2) * f.w - aw2 * f.x) / size - (p.momentum / s - a * p.energy * s) * size * f.z);
    float turn = -a * p.u * p.w;
    return vec2(ab.x - turn * ab.y, ab.y + turn * ab.x);
}

/* exp(2 i EVPA) on the sky, for light whose electric field is perpendicular to the magnetic field. */
vec2 kd_stokes_direction(kd_plasma m, kd_midst p)
{
    vec4 u =
        vec4(m.flow.time, m.flow.out_, m.flow.down, m.around.omega * m.flow.time + m.flow.round_ / m.around.round_);
    vec2 kappa = kd_stokes_kappa(p, m.around, m.field + m.electrons.cosine * u), right = kd_stokes_right;
    vec2 z = vec2(kappa.x * right.x + kappa.y * right.y, kappa.y * right.x - kappa.x * right.y);
    float size = max(abs(z.x), abs(z.y));
    z = size > 0.0 ? z / size : vec2(1.0, 0.0);
    return vec2(z.x * z.x - z.y * z.y, -2.0 * z.x * z.y) / dot(z, z);
}

/* Sets the medium at the current place. light, depth: emission and absorption of I. depth_log2: log2 of the depth;
 * where this exceeds 40, all coefficients are reduced by the same factor. */
void kd_stokes_at(kd_plasma m, kd_midst p, float light, float depth, float depth_log2)
{
    kd_polarises of;
    if ((TRAITS_plasma & KD_TRAIT_PLASMA_POWER) != 0u)
        of = kd_stokes_by_power(m.electrons, m.frequency, emission.plasma.power_index);
    else if ((TRAITS_plasma & KD_TRAIT_PLASMA_KAPPA) != 0u)
        of = kd_stokes_by_kappa(m.electrons, m.frequency);
    else
        of = kd_stokes_thermal(m.electrons, m.frequency);
    vec2 c = kd_stokes_direction(m, p);
    float base = m.electrons.density + 1.0 + KD_LOG2_QUANTUM + emission.plasma.depth + m.frequency -
                 emission.plasma.frequency - max(depth_log2 - 40.0, 0.0);
    vec2 turns = (TRAITS_stokes & KD_TRAIT_STOKES_FARADAY) != 0u ? of.signs * exp2(clamp(base + of.turns, -125.0, 40.0))
                                                                 : vec2(0.0);
    float whole = emission.stokes.whole;
    kd_stokes_here = kd_stokes(light * vec4(1.0, whole * of.light.x * c, of.light.y), depth,
                               depth * vec3(whole * of.depth.x * c, of.depth.y), vec3(whole * turns.x * c, turns.y));
}

/* A stretch of the ray that is not accepted yet. front: transfer of all matter in front of the stretch. light: light of
 * the stretch as it arrives. one, two, three: matter at the three nodes of the stretch. */
struct kd_stokes_trial {
    kd_jones front;
    vec4 light;
    kd_stokes one, two, three;
};

/* K S, the loss of the Stokes vector S per length in the medium. */
vec4 kd_stokes_less(kd_stokes m, vec4 s)
{
    return m.depth * s + vec4(dot(m.takes, s.yzw), s.x * m.takes - cross(m.turns, s.yzw));
}

kd_stokes_trial kd_stokes_begin()
{
    kd_stokes none = kd_stokes(vec4(0.0), 0.0, vec3(0.0), vec3(0.0));
    return kd_stokes_trial(kd_stokes_front, vec4(0.0), none, none, none);
}

void kd_stokes_along(inout kd_stokes_trial trial, float way)
{
    kd_stokes m = kd_stokes_here;
    float i = min(way * m.light.x, KD_BEAM_MOST);
    m = kd_stokes(m.light.x > 0.0 ? m.light / m.light.x : vec4(0.0), way * m.depth, way * m.takes, way * m.turns);
    kd_stokes_cell cell = kd_stokes_cell_of(m);
    trial.light += i * kd_jones_on(trial.front, cell.light);
    trial.front = kd_jones_times(trial.front, cell.passes);
    trial.one = trial.two;
    trial.two = trial.three;
    trial.three = kd_stokes(i * m.light, m.depth, m.takes, m.turns);
}

/* First-order remainder of the light of a stretch. The light of each node is attenuated and rotated by half of that
 * node's own matter and by all matter before it. The remainder is the difference to Gauss's method, as in
 * kd_march_rest. */
vec4 kd_stokes_rest(kd_stokes_trial t)
{
    vec4 rest = 0.0809475 * (kd_stokes_less(t.two, t.one.light) - kd_stokes_less(t.one, t.two.light) +
                             kd_stokes_less(t.three, t.two.light) - kd_stokes_less(t.two, t.three.light)) -
                0.0352425 * (kd_stokes_less(t.three, t.one.light) - kd_stokes_less(t.one, t.three.light));
    float x = t.one.depth + t.two.depth + t.three.depth, turn = length(t.one.turns + t.two.turns + t.three.turns);
    return x < 8.0 && turn < 2.0 ? exp(-0.5 * x) * rest : vec4(0.0);
}

/* Second-order remainder of the product of the three nodes' factors: the sum of commutators [c_i, c_j] with the
 * coefficients of kd_stokes_rest (W. Magnus 1954). The result is a further factor, which multiplies that product. */
kd_jones kd_stokes_order(kd_stokes_trial t)
{
    const float near = 0.0809475, far = 0.0352425;
    vec3 a1 = t.one.takes, a2 = t.two.takes, a3 = t.three.takes, r1 = t.one.turns, r2 = t.two.turns, r3 = t.three.turns;
    vec3 re =
        near * (cross(a1, r2) + cross(r1, a2) + cross(a2, r3) + cross(r2, a3)) - far * (cross(a1, r3) + cross(r1, a3));
    vec3 im =
        near * (cross(r1, r2) - cross(a1, a2) + cross(r2, r3) - cross(a2, a3)) - far * (cross(r1, r3) - cross(a1, a3));
    float size = dot(re, re) + dot(im, im), turn = length(r1 + r2 + r3);
    /* The remainder is a series in powers of the stretch's rotation angle, and it does not preserve lengths. Over many
     * stretches with angles of many radians, such factors would amplify light. For large angles the factor is therefore
     * 1. */
    return size < 0.25 && turn < 2.0 ? kd_jones(vec2(1.0, 0.0), -0.5 * re, -0.5 * im) : kd_jones_one();
}

/* Accepts the stretch: adds its matter to `front`. Returns its light as it arrives. */
vec4 kd_stokes_take(kd_stokes_trial t)
{
    vec4 light = t.light + kd_jones_on(kd_stokes_front, kd_stokes_rest(t));
    kd_stokes_front = kd_jones_times(t.front, kd_stokes_order(t));
    return kd_stokes_sound(light);
}
#endif
