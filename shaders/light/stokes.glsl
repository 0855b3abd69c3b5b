/* Polarised light through a uniform medium: dS/ds = j - K S for S = (I, Q, U, V), in closed form (E. Landi
 * Degl'Innocenti & M. Landi Degl'Innocenti 1985, Sol. Phys. 97, 239; Landi Degl'Innocenti & Landolfi 2004, section
 * 8.3), with
 *
 *   K S = alpha S + (a.v, a I - rho x v),
 *   v = (Q, U, V),   a = (alpha_Q, alpha_U, alpha_V),   rho = (rho_Q, rho_U, rho_V).
 *
 * S is written in Pauli matrices, I + v.sigma. The solution is then a product with a 2 x 2 matrix: exp(-K s) S = A S
 * A*, A = exp(-alpha s/2) (cosh(lambda s/2) - sinh(lambda s/2)/lambda c.sigma), with c = a + i rho and lambda =
 * sqrt(c.c) = Lambda_1 + i Lambda_2. Products of such matrices preserve I^2 >= Q^2 + U^2 + V^2 in spite of rounding,
 * and have half as many numbers as the corresponding 4 x 4 matrices. The medium's own light is the integral of A j A*,
 * whose four functions of the length are means of exponentials. */
#ifndef KD_STOKES_GLSL
#define KD_STOKES_GLSL

/* The 2 x 2 matrix s + (re + i im).sigma, where s is a complex number. */
struct kd_jones {
    vec2 s;
    vec3 re, im;
};
/* Matter along a length of the ray. light: its emission. depth: optical depth for I. takes: absorption of Q, U and V.
 * turns: rotation of Q, U and V. */
struct kd_stokes {
    vec4 light;
    float depth;
    vec3 takes, turns;
};
/* The effect of this matter. light: its own light, as it leaves on the observer's side. through: the matrix that acts
 * on light from behind. */
struct kd_stokes_cell {
    kd_jones passes;
    vec4 light;
};

/* Series replace differences of nearly equal numbers where |lambda| is below this limit, or below a tenth of the depth
 * if that is larger. At this limit both forms are accurate to about 1e-6 */
#define KD_STOKES_NEAR 0.25

vec2 kd_complex_times(vec2 a, vec2 b) { return vec2(a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x); }

kd_jones kd_jones_one() { return kd_jones(vec2(1.0, 0.0), vec3(0.0), vec3(0.0)); }

/* The product of a and b, for light that goes through b first. */
kd_jones kd_jones_times(kd_jones a, kd_jones b)
{
    vec2 s = kd_complex_times(a.s, b.s) + vec2(dot(a.re, b.re) - dot(a.im, b.im), dot(a.re, b.im) + dot(a.im, b.re));
    vec3 re = a.s.x * b.re - a.s.y * b.im + b.s.x * a.re - b.s.y * a.im - cross(a.re, b.im) - cross(a.im, b.re);
    vec3 im = a.s.x * b.im + a.s.y * b.re + b.s.x * a.im + b.s.y * a.re + cross(a.re, b.re) - cross(a.im, b.im);
    return kd_jones(s, re, im);
}

/* The sum `one` S + (b c + (b c)*) S + `two` c S c*, where b c = p + i q and c = re + i im. */
vec4 kd_stokes_forms(vec4 s, float one, vec3 p, vec3 q, float two, vec3 re, vec3 im)
{
    vec3 v = s.yzw, across = cross(re, im);
    float size = dot(re, re) + dot(im, im);
    float i = one * s.x + 2.0 * dot(p, v) + two * (size * s.x - 2.0 * dot(v, across));
    vec3 w = one * v + 2.0 * (s.x * p - cross(q, v)) +
             two * (2.0 * (s.x * across + dot(re, v) * re + dot(im, v) * im) - size * v);
    return vec4(i, w);
}

vec4 kd_jones_on(kd_jones a, vec4 s)
{
    return kd_stokes_forms(s, dot(a.s, a.s), a.s.x * a.re + a.s.y * a.im, a.s.x * a.im - a.s.y * a.re, 1.0, a.re, a.im);
}

/* Transmission of unpolarised light by a. */
float kd_jones_through(kd_jones a) { return dot(a.s, a.s) + dot(a.re, a.re) + dot(a.im, a.im); }

/* Limits the degree of polarisation to 1 in spite of rounding. */
vec4 kd_stokes_sound(vec4 s)
{
    float i = max(s.x, 0.0), part = i > 0.0 ? kd_part_of(s.yzw, i) : 0.0;
    return vec4(i, i > 0.0 ? s.yzw * (part > 1.0 ? 1.0 / part : 1.0) : vec3(0.0));
}

/* The mean of exp(-y s) for s from 0 to 1. y is real. The next function takes a complex y, and exp(-y).
 */
float kd_stokes_mean(float y)
{
    return abs(y) < 0.25 ? 1.0 - y * (0.5 - y * (1.0 / 6.0 - y * (1.0 / 24.0 - y * (1.0 / 120.0 - y * (1.0 / 720.0)))))
                         : (1.0 - exp(-y)) / y;
}
vec2 kd_stokes_mean(vec2 y, vec2 passes)
{
    vec2 sum = vec2(1.0 / 40320.0, 0.0), size = vec2(1.0, 0.0) - passes;
    sum = vec2(1.0 / 5040.0, 0.0) - kd_complex_times(y, sum);
    sum = vec2(1.0 / 720.0, 0.0) - kd_complex_times(y, sum);
    sum = vec2(1.0 / 120.0, 0.0) - kd_complex_times(y, sum);
    sum = vec2(1.0 / 24.0, 0.0) - kd_complex_times(y, sum);
    sum = vec2(1.0 / 6.0, 0.0) - kd_complex_times(y, sum);
    sum = vec2(0.5, 0.0) - kd_complex_times(y, sum);
    sum = vec2(1.0, 0.0) - kd_complex_times(y, sum);
    float y2 = dot(y, y);
    return y2 < 0.25 ? sum : vec2(dot(size, y), size.y * y.x - size.x * y.y) / y2;
}

/* The means of s^k exp(-t s) for k from 1 to 6. The recursion runs in its stable direction: upwards if t is large,
 * otherwise downwards from a sum of positive terms. */
struct kd_stokes_moments { float m1, m2, m3, m4, m5, m6; };
kd_stokes_moments kd_stokes_moments_of(float t)
{
    float e = exp(-t);
    kd_stokes_moments m;
    if (t > 2.5) {
        float per = 1.0 / t;
        m.m1 = ((1.0 - e) * per - e) * per;
        m.m2 = (2.0 * m.m1 - e) * per;
        m.m3 = (3.0 * m.m2 - e) * per;
        m.m4 = (4.0 * m.m3 - e) * per;
        m.m5 = (5.0 * m.m4 - e) * per;
        m.m6 = (6.0 * m.m5 - e) * per;
    } else {
        float sum = 1.0 + t / 16.0;
        for (int n = 15; n > 7; n--)
            sum = 1.0 + sum * t / float(n);
        m.m6 = e / 7.0 * sum;
        m.m5 = (t * m.m6 + e) / 6.0;
        m.m4 = (t * m.m5 + e) / 5.0;
        m.m3 = (t * m.m4 + e) / 4.0;
        m.m2 = (t * m.m3 + e) / 3.0;
        m.m1 = (t * m.m2 + e) / 2.0;
    }
    return m;
}

/* (Lambda_1, Lambda_2), each divided by `size`: the square root of (a + i rho)^2 with Lambda_1 >= 0. */
vec2 kd_stokes_root(vec3 a, vec3 rho)
{
    float re = dot(a, a) - dot(rho, rho), im = 2.0 * dot(a, rho), big = sqrt(0.5 * (sqrt(re * re + im * im) + abs(re)));
    float small_ = big > 0.0 ? 0.5 * abs(im) / big : 0.0;
    return vec2(re < 0.0 ? small_ : big, (im < 0.0 ? -1.0 : 1.0) * (re < 0.0 ? big : small_));
}

kd_stokes_cell kd_stokes_cell_of(kd_stokes m)
{
    vec3 largest = max(abs(m.takes), abs(m.turns));
    float t = m.depth, size = max(max(largest.x, max(largest.y, largest.z)), 1e-30);
    vec2 lambda = size * kd_stokes_root(m.takes / size, m.turns / size);
    /* t - lambda.x, the absorption of the least absorbed polarisation, must not be negative */
    lambda.x = min(lambda.x, t);
    float square = dot(lambda, lambda), per = 1.0 / max(square, 1e-30), around = lambda.y * (0.5 / 6.28318531);
    bool near = square < max(KD_STOKES_NEAR * KD_STOKES_NEAR, 0.01 * t * t);
    kd_phasor half_ = kd_cos_sin(6.28318531 * clamp(around - floor(around), 0.0, 1.0));
    vec2 power = vec2((lambda.x - lambda.y) * (lambda.x + lambda.y), 2.0 * lambda.x * lambda.y),
         c = vec2(half_.c, half_.s);

    float more = exp(0.5 * (lambda.x - t)), less = exp(-0.5 * (lambda.x + t)), both = 0.5 * (more + less),
          apart = 0.5 * (more - less);
    vec2 sinh_ = vec2(apart * c.x, both * c.y),
         direct = per * vec2(dot(sinh_, lambda), sinh_.y * lambda.x - sinh_.x * lambda.y);
    vec2 series = vec2(0.5, 0.0) + kd_complex_times(power, vec2(1.0 / 48.0, 0.0) + power * (1.0 / 3840.0));
    vec2 over = square < KD_STOKES_NEAR * KD_STOKES_NEAR ? exp(-0.5 * t) * series : direct;
    kd_stokes_cell cell;
    cell.passes = kd_jones(vec2(both * c.x, apart * c.y), over.y * m.turns - over.x * m.takes,
                           -over.x * m.turns - over.y * m.takes);

    /* Means, over s from 0 to 1, of exp(-t s) times |cosh|^2, |sinh/lambda|^2 and cosh* sinh/lambda of lambda s/2. */
    float low = kd_stokes_mean(t - lambda.x), high = kd_stokes_mean(t + lambda.x), e = exp(-t);
    vec2 around_ = kd_stokes_mean(vec2(t, -lambda.y), e * vec2(c.x * c.x - c.y * c.y, 2.0 * c.x * c.y));
    float cosh_ = 0.5 * (low + high), one = 0.5 * (cosh_ + around_.x), two = 0.5 * per * (cosh_ - around_.x);
    vec2 odd = 0.5 * vec2(0.5 * (low - high), around_.y),
         w = per * vec2(dot(odd, lambda), odd.y * lambda.x - odd.x * lambda.y);
    if (near) {
        kd_stokes_moments k = kd_stokes_moments_of(t);
        float x = lambda.x * lambda.x, y = lambda.y * lambda.y, xy = lambda.x * lambda.y;
        two = 0.5 * (0.5 * k.m2 + (x - y) * k.m4 / 24.0 + (x * x - x * y + y * y) * k.m6 / 720.0);
        w = 0.5 * vec2(k.m1 + (x - y) * k.m3 / 6.0 + (x * x - x * y + y * y) * k.m5 / 120.0,
                       -xy * k.m3 / 6.0 - xy * (x - y) * k.m5 / 120.0);
    }
    cell.light = kd_stokes_sound(kd_stokes_forms(m.light, one, w.y * m.turns - w.x * m.takes,
                                                 -w.x * m.turns - w.y * m.takes, two, m.takes, m.turns));
    return cell;
}

#endif
