/* The azimuth that the polar motion contributes, psi = integral of L/(1 - u^2) dtau, in closed form.
 *
 * The integrand peaks as 1/sin^2(theta) near the axis. With u^2 = U+ cos^2 x, y = b + e u^2 and c = b + e one has
 * c (1 - U+) = L^2, so that
 *   L dx / ((1 - u^2) sqrt(y)) = sign(L) d atan(tan x / sqrt(1 - U+)) + L e dx / (sqrt(y) sqrt(c) (sqrt(y) + sqrt(c))):
 * the first term holds the whole peak and is exact; between crossings it gives pi. The second is smooth, small and even and
 * periodic in x: a cosine series through three points, with a relative error of (e/4c)^3. */
#ifndef KD_POLAR_AZIMUTH_GLSL
#define KD_POLAR_AZIMUTH_GLSL

struct kd_azimuth {
    real first;  /* psi from the observer to the first crossing */
    real half_;  /* from each crossing to the next */
};

KD_FN kd_azimuth kd_azimuth_of(kd_motion m, kd_ray ray, kd_polar polar, real u, real s)
{
    kd_azimuth o;
    real du = u < KD_R(0) || (u == KD_R(0) && ray.p < KD_R(0)) ? -(s * ray.p) : s * ray.p;
    real cx = abs(u), sx = -du / sqrt(polar.b + m.energy2 * u * u);
    real n = KD_R(1) / max(cx * cx + sx * sx, KD_R(1e-30));
    real c = polar.b + m.energy2, sc = sqrt(c);
    real eu = m.energy2 / max(n, KD_R(1e-30)); /* e U+ */
    real y0 = sqrt(polar.b + eu), y1 = sqrt(polar.b + KD_R(0.5) * eu), y2 = sqrt(polar.b);
    real j0 = KD_R(1) / (y0 * (y0 + sc)), j1 = KD_R(1) / (y1 * (y1 + sc)), j2 = KD_R(1) / (y2 * (y2 + sc));
    real le = m.momentum * m.energy2 / sc;
    real f0 = le * KD_R(0.25) * (j0 + KD_R(2) * j1 + j2);
    real f1 = le * KD_R(0.5) * (j0 - j2);
    real f2 = le * KD_R(0.25) * (j0 - KD_R(2) * j1 + j2);
    real sin2 = KD_R(2) * sx * cx * n, cos2 = (cx * cx - sx * sx) * n;
    real side = m.momentum < KD_R(0) ? KD_R(-1) : KD_R(1);
    o.first = side * kd_angle_upper(sx, cx * abs(m.momentum) / sc) + f0 * kd_angle_upper(sx, cx) -
              KD_R(0.5) * sin2 * (f1 + f2 * cos2);
    o.half_ = KD_PI * (side + f0);
    return o;
}

#endif
