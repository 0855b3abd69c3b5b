/* Azimuth from the polar motion, psi = integral of L/(1 - u^2) dtau, in closed form.
 *
 * The integrand peaks as 1/sin^2(theta) near the axis. With u^2 = U+ cos^2 x, y = b + e u^2 and c = b + e one has c (1
 * - U+) = L^2, so that
 *
 *   L dx / ((1 - u^2) sqrt(y)) =
 *     sign(L) d atan(tan x / sqrt(1 - U+)) + L e dx / (sqrt(y) sqrt(c) (sqrt(y) + sqrt(c))).
 *
 * The first term contains the whole peak and is exact; between crossings it is pi. The second term is small and smooth,
 * and is even and periodic in x. It is computed as a cosine series through five points, whose terms decrease as ((p -
 * q)/(p + q))^k. Rays with an impact parameter below about twice the spin would need many more terms. Such rays are few
 * in a picture, and their second term is integrated in time. */
#ifndef KD_POLAR_AZIMUTH_GLSL
#define KD_POLAR_AZIMUTH_GLSL

#include "ray/nystroem.glsl"

struct kd_azimuth {
    float first;              /* psi from the observer to the first crossing */
    float half_;              /* psi from each crossing to the next */
    float f0, f1, f2, f3, f4; /* coefficients of the cosine series */
    float b, root_c, side;    /* b: b above. root_c: sqrt(c). side: sign of L */
    bool uneven;              /* true if the cosine series is not accurate enough */
};

/* 1 / (sqrt(y) (sqrt(y) + sqrt(c))). */
float kd_azimuth_rate(float y, float root_c)
{
    float root = sqrt(y);
    return 1.0 / (root * (root + root_c));
}

float kd_azimuth_pull(kd_geodesic m, float u) { return u * (m.a2 - 2.0 * m.energy2 * u * u); }

/* Integral of the smooth part L e/(sqrt(c) (sqrt(y) + sqrt(c))) over a time of at most half a period, by Boole's rule.
 * The motion starts at (u, du). */
float kd_azimuth_smooth(kd_geodesic m, float b, float u, float du, float time)
{
    const uint steps = 32;
    float c = sqrt(b + m.energy2), h = time * (1.0 / float(steps)), sum = 7.0 / (sqrt(b + m.energy2 * u * u) + c);
    for (uint i = 1; i <= steps; i++) {
        float next, dnext;
        KD_NYSTROEM_STEP(float, kd_azimuth_pull, m, u, du, h, next, dnext)
        u = next;
        du = dnext;
        float weight = (i & 1u) == 1u ? 32.0 : (i & 3u) == 2u ? 12.0 : i == steps ? 7.0 : 14.0;
        sum += weight / (sqrt(b + m.energy2 * u * u) + c);
    }
    return m.momentum * m.energy2 / c * sum * h * (2.0 / 45.0);
}

/* psi, by the series, from a point of the path to the nearest crossing of the plane in one direction, which is less
 * than a half period away. (cx, sx) is proportional to (cos x, sin x) at the point; the angle of (tx, ty) is pi/2 -
 * atan(tan x / sqrt(1 - U+)). */
float kd_azimuth_part(kd_azimuth o, float cx, float sx, float tx, float ty)
{
    /* the lower bound is harmless, because an observer outside the plane is at least 1e-16 from it */
    float n = 1.0 / max(cx * cx + sx * sx, 1e-37);
    float sin2 = 2.0 * sx * cx * n, cos2 = (cx * cx - sx * sx) * n, cos4 = 2.0 * cos2 * cos2 - 1.0;
    float wave =
        sin2 * (0.5 * o.f1 + cos2 * (0.5 * o.f2 + cos4 * 0.5 * o.f4) + o.f3 * (0.5 - (2.0 / 3.0) * sin2 * sin2));
    return o.side * kd_angle_upper(tx, ty) + (o.f0 * kd_angle_upper(sx, cx) - wave);
}

kd_azimuth kd_azimuth_of(kd_geodesic m, kd_ray ray, kd_polar polar, float u, float s)
{
    kd_azimuth o;
    float dp = u < 0.0 || (u == 0.0 && ray.p < 0.0) ? -ray.p : ray.p;
    float root = sqrt(polar.b + m.energy2 * u * u);
    float cx = abs(u), sx = -(s * dp) / root;
    float c = polar.b + m.energy2, sc = sqrt(c);
    float eu = m.energy2 * (cx * cx + sx * sx); /* e U+ */
    /* The integrand at the nodes x = 0, pi/8, pi/4, 3 pi/8 and pi/2; both ends have the weight 1/2. */
    float j0 = 0.5 * kd_azimuth_rate(polar.b + eu, sc), j4 = 0.5 * kd_azimuth_rate(polar.b, sc);
    float j1 = kd_azimuth_rate(polar.b + 0.853553391 * eu, sc);
    float j2 = kd_azimuth_rate(polar.b + 0.5 * eu, sc);
    float j3 = kd_azimuth_rate(polar.b + 0.146446609 * eu, sc);
    float le = 0.25 * m.momentum * m.energy2 / sc, tilt = 0.707106781 * (j1 - j3);
    o.f0 = le * (j0 + j1 + j2 + j3 + j4);
    o.f1 = le * 2.0 * (j0 - j4 + tilt);
    o.f2 = le * 2.0 * (j0 - j2 + j4);
    o.f3 = le * 2.0 * (j0 - j4 - tilt);
    o.f4 = le * (j0 - j1 + j2 - j3 + j4);
    o.b = polar.b;
    o.root_c = sc;
    o.side = ray.l < 0.0 ? -1.0 : 1.0;
    /* true if (p - q)/(p + q) is above 0.04, where the fifth term is above 1e-7 */
    o.uneven = polar.b < 0.85 * (polar.b + eu);
    /* (tx, ty) gives tan x / sqrt(1 - U+) at the observer. The sine of the polar angle cancels and is left out, so this
     * is exact on the axis. */
    float tx = -dp / root, ty = cx * abs(ray.l) / sc;
    o.first = kd_azimuth_part(o, cx, sx, tx, ty);
    o.half_ = KD_PI * (o.side + o.f0);
    if (o.uneven) {
        o.first = o.side * kd_angle_upper(tx, ty) + kd_azimuth_smooth(m, polar.b, u, s * ray.p, polar.first);
        o.half_ = KD_PI * o.side + kd_azimuth_smooth(m, polar.b, 0.0, sqrt(max(m.q, 0.0)), polar.half_);
    }
    return o;
}

#endif
