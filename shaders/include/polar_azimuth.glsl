/* The azimuth that the polar motion contributes, psi = integral of L/(1 - u^2) dtau, in closed form.
 *
 * The integrand peaks as 1/sin^2(theta) near the axis. With u^2 = U+ cos^2 x, y = b + e u^2 and c = b + e one has
 * c (1 - U+) = L^2, so that
 *   L dx / ((1 - u^2) sqrt(y)) = sign(L) d atan(tan x / sqrt(1 - U+)) + L e dx / (sqrt(y) sqrt(c) (sqrt(y) + sqrt(c))):
 * the first term holds the whole peak and is exact; between crossings it gives pi. The second is smooth, small and even and
 * periodic in x: a cosine series through five points. Its terms fall as ((p - q)/(p + q))^k, below 1/6 for all rays with an
 * impact parameter above the spin. */
#ifndef KD_POLAR_AZIMUTH_GLSL
#define KD_POLAR_AZIMUTH_GLSL

struct kd_azimuth {
    real first;  /* psi from the observer to the first crossing */
    real half_;  /* from each crossing to the next */
};

/* 1 / (sqrt(y) (sqrt(y) + sqrt(c))). */
KD_FN real kd_azimuth_rate(real y, real root_c)
{
    real root = sqrt(y);
    return KD_R(1) / (root * (root + root_c));
}

KD_FN kd_azimuth kd_azimuth_of(kd_motion m, kd_ray ray, kd_polar polar, real u, real s)
{
    kd_azimuth o;
    real dp = u < KD_R(0) || (u == KD_R(0) && ray.p < KD_R(0)) ? -ray.p : ray.p;
    real root = sqrt(polar.b + m.energy2 * u * u);
    real cx = abs(u), sx = -(s * dp) / root;
    real n = KD_R(1) / max(cx * cx + sx * sx, KD_R(1e-30));
    real c = polar.b + m.energy2, sc = sqrt(c);
    real eu = m.energy2 / max(n, KD_R(1e-30)); /* e U+ */
    /* At x = 0, pi/8, pi/4, 3 pi/8, pi/2; the ends count half. */
    real j0 = KD_R(0.5) * kd_azimuth_rate(polar.b + eu, sc), j4 = KD_R(0.5) * kd_azimuth_rate(polar.b, sc);
    real j1 = kd_azimuth_rate(polar.b + KD_R(0.853553391) * eu, sc);
    real j2 = kd_azimuth_rate(polar.b + KD_R(0.5) * eu, sc);
    real j3 = kd_azimuth_rate(polar.b + KD_R(0.146446609) * eu, sc);
    real le = KD_R(0.25) * m.momentum * m.energy2 / sc, tilt = KD_R(0.707106781) * (j1 - j3);
    real f0 = le * (j0 + j1 + j2 + j3 + j4);
    real f1 = le * KD_R(2) * (j0 - j4 + tilt);
    real f2 = le * KD_R(2) * (j0 - j2 + j4);
    real f3 = le * KD_R(2) * (j0 - j4 - tilt);
    real f4 = le * (j0 - j1 + j2 - j3 + j4);
    real sin2 = KD_R(2) * sx * cx * n, cos2 = (cx * cx - sx * sx) * n, cos4 = KD_R(2) * cos2 * cos2 - KD_R(1);
    real wave = sin2 * (KD_R(0.5) * f1 + cos2 * (KD_R(0.5) * f2 + cos4 * KD_R(0.5) * f4) +
                        f3 * (KD_R(0.5) - KD_R(2.0 / 3.0) * sin2 * sin2));
    real side = ray.l < KD_R(0) ? KD_R(-1) : KD_R(1);
    /* tan x / sqrt(1 - U+) at the observer, free of the sine of the polar angle that both sides share: exact on the axis. */
    o.first = side * kd_angle_upper(-dp / root, cx * abs(ray.l) / sc) + f0 * kd_angle_upper(sx, cx) - wave;
    o.half_ = KD_PI * (side + f0);
    return o;
}

#endif
