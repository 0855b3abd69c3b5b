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
    float first;  /* psi from the observer to the first crossing */
    float half_;  /* from each crossing to the next */
};

/* 1 / (sqrt(y) (sqrt(y) + sqrt(c))). */
float kd_azimuth_rate(float y, float root_c)
{
    float root = sqrt(y);
    return 1.0 / (root * (root + root_c));
}

kd_azimuth kd_azimuth_of(kd_motion m, kd_ray ray, kd_polar polar, float u, float s)
{
    kd_azimuth o;
    float dp = u < 0.0 || (u == 0.0 && ray.p < 0.0) ? -ray.p : ray.p;
    float root = sqrt(polar.b + m.energy2 * u * u);
    float cx = abs(u), sx = -(s * dp) / root;
    float n = 1.0 / max(cx * cx + sx * sx, 1e-30);
    float c = polar.b + m.energy2, sc = sqrt(c);
    float eu = m.energy2 / max(n, 1e-30); /* e U+ */
    /* At x = 0, pi/8, pi/4, 3 pi/8, pi/2; the ends count half. */
    float j0 = 0.5 * kd_azimuth_rate(polar.b + eu, sc), j4 = 0.5 * kd_azimuth_rate(polar.b, sc);
    float j1 = kd_azimuth_rate(polar.b + 0.853553391 * eu, sc);
    float j2 = kd_azimuth_rate(polar.b + 0.5 * eu, sc);
    float j3 = kd_azimuth_rate(polar.b + 0.146446609 * eu, sc);
    float le = 0.25 * m.momentum * m.energy2 / sc, tilt = 0.707106781 * (j1 - j3);
    float f0 = le * (j0 + j1 + j2 + j3 + j4);
    float f1 = le * 2.0 * (j0 - j4 + tilt);
    float f2 = le * 2.0 * (j0 - j2 + j4);
    float f3 = le * 2.0 * (j0 - j4 - tilt);
    float f4 = le * (j0 - j1 + j2 - j3 + j4);
    float sin2 = 2.0 * sx * cx * n, cos2 = (cx * cx - sx * sx) * n, cos4 = 2.0 * cos2 * cos2 - 1.0;
    float wave = sin2 * (0.5 * f1 + cos2 * (0.5 * f2 + cos4 * 0.5 * f4) +
                        f3 * (0.5 - (2.0 / 3.0) * sin2 * sin2));
    float side = ray.l < 0.0 ? -1.0 : 1.0;
    /* tan x / sqrt(1 - U+) at the observer, free of the sine of the polar angle that both sides share: exact on the axis. */
    o.first = side * kd_angle_upper(-dp / root, cx * abs(ray.l) / sc) + f0 * kd_angle_upper(sx, cx) - wave;
    o.half_ = KD_PI * (side + f0);
    return o;
}

#endif
