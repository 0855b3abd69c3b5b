/* Closed form of the polar motion, which gives the times at which a ray crosses the equatorial plane.
 *
 * u = sqrt(U+) cos(x) turns u'^2 = Q + A u^2 - e u^4, e = a^2 E^2, into
 *
 *   x'^2 = p^2 cos^2 x + q^2 sin^2 x,    q^2 = (s - A)/2,  p^2 = q^2 + e U+ = s,  s = sqrt(A^2 + 4 e Q),
 *
 * which is Gauss's form of the elliptic integral. A half period takes pi / AGM(p, q), with the arithmetic-geometric
 * mean AGM. Landen's transformation tan(x_{n+1} - x_n) = (q_n/p_n) tan x_n (Abramowitz & Stegun 17.6.8) gives the
 * incomplete integral.
 *
 * For rays with an impact parameter well above a, q/p is near 1, and two iterations would be enough. Pictures use four,
 * with an error of 1e-7 at q/p = 0.05 and of 1e-5 at 0.01. q/p is smaller only for rays that aim at the hole along the
 * plane of the disk, with |alpha| below a and |beta| below a hundredth of a. The kernel of listed rays reports each
 * ray's error. It therefore defines KD_POLAR_LISTED and uses eight iterations. */
#ifndef KD_POLAR_GLSL
#define KD_POLAR_GLSL

#include "shared/math.glsl"

struct kd_polar {
    float first;  /* Mino time from the observer to the first crossing */
    float half_;  /* Mino time from each crossing to the next */
    float b;      /* q^2 of the formula at the top of this file */
    float s;      /* s of the formula at the top of this file */
    bool crosses; /* false if the motion stays on one side of the plane, or in the plane */
};

/* The polar motion of a ray. u, s: cosine and sine of the observer's polar angle. The traced path starts with u' = s p.
 */
kd_polar kd_polar_of(kd_geodesic m, kd_ray ray, float u, float s)
{
    kd_polar o;
    float by = kd_squared_by(m), a2 = by * m.a2,
          root = sqrt(max(a2 * a2 + 4.0 * (by * m.energy2) * (by * m.q), 0.0)) * kd_squared_back(by);
    o.s = root;
    /* for an observer in the plane Q = p^2, which may underflow, so p is tested */
    o.crosses = u == 0.0 ? ray.p != 0.0 : m.q > 0.0;
    /* b is (s - A)/2, computed without cancellation for either sign of A. */
    float b = m.a2 < 0.0 ? 0.5 * (root - m.a2) : 2.0 * m.energy2 * (m.q / (root + m.a2));
    o.b = max(b, 1e-30);

    /* By symmetry the observer is taken to be above the plane. If it is in the plane, the ray is taken to start
     * upwards. */
    float du = u < 0.0 || (u == 0.0 && ray.p < 0.0) ? -(s * ray.p) : s * ray.p;
    float cx = abs(u), sx = -du / sqrt(o.b + m.energy2 * u * u); /* sqrt(U+) (cos x, sin x) at the observer */
    /* scaled, because only the direction of (cx, sx) counts and its squares must not underflow */
    float larger = max(cx, abs(sx));
    sx = larger > 0.0 ? sx / larger : -1.0;
    cx = larger > 0.0 ? cx / larger : 0.0;
    float angle = kd_angle_upper(sx, cx); /* the angle pi/2 - x */

    float k0 = sqrt(o.b / max(root, 1e-30));
    float p = sqrt(root), q = k0 * p;
#ifdef KD_POLAR_LISTED
    /* k is the ratio q/p of the two means. Each step of the mean replaces 1 - k by about (1 - k)^2/8. If k starts above
     * 1e-15, 1 - k is below a roundoff after eight steps. */
    float weight = 0.5, correction = 0.0, k = k0;
    for (int i = 0; i < 8; i++) {
        float n = 1.0 / (cx * cx + sx * sx);
        float y = (k - 1.0) * sx * cx * n, x = (cx * cx + k * sx * sx) * n;
        correction += weight * (abs(y) > 0.4 * x ? kd_angle_upper(x, abs(y)) * sign(y) : kd_atan_small(y / x));
        weight *= 0.5;
        y = (1.0 + k) * sx * cx * n;
        cx = (cx * cx - k * sx * sx) * n;
        sx = y;
        p *= 0.5 + 0.5 * k;
        k = 2.0 * sqrt(k) / (1.0 + k); /* the ratio q/p of the next two means, computed without the product of the
                                        * means, which might exceed a float's range */
    }
    float mean = p;
#else
    float n = 1.0 / (cx * cx + sx * sx);
    /* Landen's transformation, applied to the direction (cx, sx). */
    float y = (k0 - 1.0) * sx * cx * n, x = (cx * cx + k0 * sx * sx) * n;
    float d = abs(y) > 0.4 * x ? kd_angle_upper(x, abs(y)) * sign(y) : kd_atan_small(y / x);
    float correction = 0.5 * d;
    float c1 = (cx * cx - k0 * sx * sx) * n, s1 = (1.0 + k0) * sx * cx * n;
    float p1 = 0.5 * (p + q), q1 = sqrt(p * q), k1 = q1 / p1;
    d = kd_atan_small((k1 - 1.0) * s1 * c1 / (c1 * c1 + k1 * s1 * s1));
    correction += 0.25 * d;
    float c2 = c1 * c1 - k1 * s1 * s1, s2 = (1.0 + k1) * s1 * c1;
    float p2 = 0.5 * (p1 + q1), q2 = sqrt(p1 * q1), k2 = q2 / p2;
    float y2 = (k2 - 1.0) * s2 * c2 / (c2 * c2 + k2 * s2 * s2);
    correction += 0.125 * kd_atan_small(y2);
    float c3 = c2 * c2 - k2 * s2 * s2, s3 = (1.0 + k2) * s2 * c2;
    float p3 = 0.5 * (p2 + q2), q3 = sqrt(p2 * q2), k3 = q3 / p3;
    /* the arc tangent equals its argument here in single precision, because the argument is small */
    correction += 0.0625 * (k3 - 1.0) * s3 * c3 / (c3 * c3 + k3 * s3 * s3);
    float mean = 0.5 * (p3 + q3);
#endif
    float inv = 1.0 / mean;
    o.first = (angle - correction) * inv;
    o.half_ = KD_PI * inv;
    return o;
}

#endif
