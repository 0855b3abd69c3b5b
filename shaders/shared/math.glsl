/* Elementary functions with known errors in both precisions. Vulkan allows an error of 4096 ulp in atan and of 2^-11 in
 * the sine, and has neither function in double. With KD_DOUBLE the functions are accurate to 1e-16 instead of 1e-7. */
#ifndef KD_MATH_GLSL
#define KD_MATH_GLSL

#define KD_PI 3.14159265358979323846

/* True if x is finite. The function tests the bits of the exponent, because a comparison is not reliable: a compiler
 * that need not preserve NaN (Vulkan 1.2, shaderSignedZeroInfNanPreserve) may treat any comparison with NaN as true. */
bool kd_is_finite(float x)
{
#ifdef KD_DOUBLE
    return (unpackDouble2x32(x).y & 0x7ff00000u) != 0x7ff00000u;
#else
    return (floatBitsToUint(x) & 0x7f800000u) != 0x7f800000u;
#endif
}

/* Arc tangent for |x| <= tan(pi/8). In double it is Moshier's rational function (Cephes, 1984). */
float kd_atan_small(float x)
{
    float z = x * x;
#ifdef KD_DOUBLE
    float p =
        -6.485021904942025371773e1 +
        z * (-1.228866684490136173410e2 +
             z * (-7.500855792314704667340e1 + z * (-1.615753718733365076637e1 + z * -8.750608600031904122785e-1)));
    float q =
        1.945506571482613964425e2 +
        z * (4.853903996359136964868e2 +
             z * (4.328810604912902668951e2 + z * (1.650270098316988542046e2 + z * (2.485846490142306297962e1 + z))));
    return x + x * z * p / q;
#else
    return x + x * z * (-0.333329491539 + z * (0.199777106478 + z * (-0.138776856032 + z * 0.0805374449538)));
#endif
}

/* Angle of the point (x, y), in [0, pi], for y >= 0 and x of any sign. */
float kd_angle_upper(float x, float y)
{
    float ax = abs(x), mx = max(ax, y), mn = min(ax, y);
    bool wide = mn > 0.41421356237309504880 * mx;
    float num = wide ? mn - mx : mn, den = wide ? mn + mx : mx;
    float t = kd_atan_small(num / max(den, 1e-30)) + (wide ? KD_PI * 0.25 : 0.0);
    t = ax < y ? KD_PI * 0.5 - t : t;
    return x < 0.0 ? KD_PI - t : t;
}

/* Reduces an angle to [-pi, pi) by whole turns. */
float kd_turned(float d) { return d - 2.0 * KD_PI * floor(d / (2.0 * KD_PI) + 0.5); }

float kd_atan2(float y, float x) { return y < 0.0 ? -kd_angle_upper(x, -y) : kd_angle_upper(x, y); }

/* A power of ten that brings a number x > 0 into the range in which its square is a normal 32-bit number. Squares of
 * numbers below 1e-19 or above 1e19 are outside that range. */
float kd_squarable(float x) { return x < 1e-10 ? 1e25 : x > 1e10 ? 1e-20 : 1.0; }

/* Length of v divided by `whole` > 0. Neither very small nor very large numbers overflow or underflow. */
float kd_part_of(vec3 v, float whole)
{
    float by = kd_squarable(whole);
    return length(v * by) / (whole * by);
}

/* Cosine and sine of a number of quarter turns, accurate to 1e-7. Taylor's series are used within half a quarter turn.
 */
vec2 kd_quarter_turns(float turns)
{
    float whole = floor(turns + 0.5), f = (turns - whole) * (0.5 * KD_PI), z = f * f;
    float s = f * (1.0 + z * (-1.0 / 6.0 + z * (1.0 / 120.0 + z * (-1.0 / 5040.0 + z / 362880.0))));
    float c = 1.0 + z * (-0.5 + z * (1.0 / 24.0 + z * (-1.0 / 720.0 + z * (1.0 / 40320.0 - z / 3628800.0))));
    int k = int(whole);
    vec2 at = (k & 1) != 0 ? vec2(-s, c) : vec2(c, s);
    return (k & 2) != 0 ? -at : at;
}

float kd_log(float x)
{
#ifdef KD_DOUBLE
    int e;
    float m = frexp(x, e);
    if (m < 0.70710678118654752440) {
        m *= 2.0;
        e--;
    }
    /* log(m) = 2 atanh((m - 1)/(m + 1)) by its series. The argument is below 0.172, and the first omitted term is below
     * 1e-17. */
    float s = (m - 1.0) / (m + 1.0), z = s * s, sum = 0.0;
    for (int k = 10; k >= 0; k--)
        sum = sum * z + 1.0 / float(2 * k + 1);
    return 2.0 * s * sum + float(e) * 0.69314718055994530942;
#else
    return log(x);
#endif
}

struct kd_phasor { float c, s; }; /* cosine and sine of an angle */

/* Cosine and sine of an angle, by their series on [-pi/4, pi/4]. */
kd_phasor kd_cos_sin(float angle)
{
    float n = floor(angle * (2.0 / KD_PI) + 0.5), x = angle - n * (KD_PI * 0.5), z = x * x;
#ifdef KD_DOUBLE
    float c = 0.0, s = 0.0;
    for (int k = 9; k >= 1; k--) {
        c = (1.0 + c) * -z / float(2 * k * (2 * k - 1));
        s = (1.0 + s) * -z / float(2 * k * (2 * k + 1));
    }
    c += 1.0;
    s = x * (1.0 + s);
#else
    float c = 1.0 + z * (-0.5 + z * (4.166664568e-2 + z * (-1.388731625e-3 + z * 2.443315711e-5)));
    float s = x + x * z * (-1.6666654611e-1 + z * (8.3321608736e-3 + z * -1.9515295891e-4));
#endif
    int quarter = int(n) & 3;
    kd_phasor o;
    o.c = quarter == 0 ? c : quarter == 1 ? -s : quarter == 2 ? -c : s;
    o.s = quarter == 0 ? s : quarter == 1 ? c : quarter == 2 ? -s : -c;
    return o;
}

#endif
