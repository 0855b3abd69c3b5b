/* The polar motion in closed form: when a ray crosses the equatorial plane.
 *
 * With B (the larger root pairing) u = sqrt(U+) cos(x) turns u'^2 = Q + A u^2 - e u^4, e = a^2 E^2, into
 *   x'^2 = p^2 cos^2 x + q^2 sin^2 x,    q^2 = (s - A)/2,  p^2 = q^2 + e U+ = s,  s = sqrt(A^2 + 4 e Q),
 * Gauss's own form of the elliptic integral: a half period takes pi / AGM(p, q), and Landen's transformation
 * tan(x_{n+1} - x_n) = (q_n/p_n) tan x_n (Abramowitz & Stegun 17.6.8) does the incomplete one. Three iterations leave
 * less than 1e-11 for q/p > 0.5. */
#ifndef KD_POLAR_GLSL
#define KD_POLAR_GLSL

/* Arc tangent for |x| <= tan(pi/8), relative error 1e-7 (Taylor to x^15 telescoped to x^9). */
KD_FN real kd_atan_small(real x)
{
    real z = x * x;
    return x + x * z * (KD_R(-0.333329491539) + z * (KD_R(0.199777106478) + z * (KD_R(-0.138776856032) + z * KD_R(0.0805374449538))));
}

/* Angle of (x, y) in [0, pi] for y >= 0, where `x` may have any sign; built-in atan may be off by 4096 ulp. */
KD_FN real kd_angle_upper(real x, real y)
{
    real ax = abs(x), mx = max(ax, y), mn = min(ax, y);
    bool wide = mn > KD_R(0.414213562) * mx;
    real num = wide ? mn - mx : mn, den = wide ? mn + mx : mx;
    real t = kd_atan_small(num / max(den, KD_R(1e-30))) + (wide ? KD_PI * KD_R(0.25) : KD_R(0));
    t = ax < y ? KD_PI * KD_R(0.5) - t : t;
    return x < KD_R(0) ? KD_PI - t : t;
}

struct kd_polar {
    real first;  /* Mino time from the observer to the first crossing */
    real half_;  /* from each crossing to the next                    */
    real b;      /* q^2 above                                         */
    bool crosses; /* false: the motion stays on one side of the plane, or in it */
};

/* u: cosine of the observer's polar angle; s: its sine. The traced path starts with u' = s p. */
KD_FN kd_polar kd_polar_of(kd_motion m, kd_ray ray, real u, real s)
{
    kd_polar o;
    real root = sqrt(max(m.a2 * m.a2 + KD_R(4) * m.energy2 * m.q, KD_R(0)));
    o.crosses = m.q > KD_R(0);
    /* (s - A)/2 without cancellation for either sign of A. */
    real b = m.a2 < KD_R(0) ? KD_R(0.5) * (root - m.a2) : KD_R(2) * m.energy2 * m.q / (root + m.a2);
    o.b = max(b, KD_R(1e-30));

    /* By symmetry let the observer be above the plane, and one in it start upwards. */
    real du = u < KD_R(0) || (u == KD_R(0) && ray.p < KD_R(0)) ? -(s * ray.p) : s * ray.p;
    real cx = abs(u), sx = -du / sqrt(o.b + m.energy2 * u * u); /* sqrt(U+) (cos x, sin x) */
    real angle = kd_angle_upper(sx, cx);                         /* pi/2 - x */

    real k0 = sqrt(o.b / max(root, KD_R(1e-30)));
    real p = sqrt(root), q = k0 * p;
    real n = KD_R(1) / max(cx * cx + sx * sx, KD_R(1e-30));
    /* Landen, on the direction (cx, sx) alone. */
    real y = (k0 - KD_R(1)) * sx * cx * n, x = (cx * cx + k0 * sx * sx) * n;
    real d = abs(y) > KD_R(0.4) * x ? kd_angle_upper(x, abs(y)) * sign(y) : kd_atan_small(y / x);
    real correction = KD_R(0.5) * d;
    real c1 = (cx * cx - k0 * sx * sx) * n, s1 = (KD_R(1) + k0) * sx * cx * n;
    real p1 = KD_R(0.5) * (p + q), q1 = sqrt(p * q), k1 = q1 / p1;
    d = kd_atan_small((k1 - KD_R(1)) * s1 * c1 / (c1 * c1 + k1 * s1 * s1));
    correction += KD_R(0.25) * d;
    real c2 = c1 * c1 - k1 * s1 * s1, s2 = (KD_R(1) + k1) * s1 * c1;
    real p2 = KD_R(0.5) * (p1 + q1), q2 = sqrt(p1 * q1), k2 = q2 / p2;
    correction += KD_R(0.125) * (k2 - KD_R(1)) * s2 * c2 / (c2 * c2 + k2 * s2 * s2); /* atan x = x here */
    real mean = KD_R(0.5) * (p2 + q2);
    real inv = KD_R(1) / mean;
    o.first = (angle - correction) * inv;
    o.half_ = KD_PI * inv;
    return o;
}

#endif
