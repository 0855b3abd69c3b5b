/* One step of the radial motion w'' = A w + 3K w^2 - 2D w^3 by Albrecht's Runge-Kutta-Nystroem method of order 6 in five
 * stages (J. Albrecht 1955, ZAMM 35, 100; its order conditions are checked in tests/unit). */
#ifndef KD_RADIAL_STEP_GLSL
#define KD_RADIAL_STEP_GLSL

struct kd_state { real w, dw; };

KD_FN real kd_pull(kd_motion m, real w) { return w * (m.a2 + w * (KD_R(3) * m.k - KD_R(2) * m.d * w)); }

KD_FN kd_state kd_radial_step(kd_motion m, kd_state y, real h)
{
    real h2 = h * h, hv = h * y.dw;
    real k1 = kd_pull(m, y.w);
    real k2 = kd_pull(m, y.w + KD_R(0.25) * hv + h2 * (KD_R(1.0 / 32.0) * k1));
    real k3 = kd_pull(m, y.w + KD_R(0.5) * hv + h2 * KD_R(1.0 / 24.0) * (KD_R(4) * k2 - k1));
    real k4 = kd_pull(m, y.w + KD_R(0.75) * hv + h2 * KD_R(1.0 / 32.0) * (KD_R(3) * k1 + KD_R(4) * k2 + KD_R(2) * k3));
    real k5 = kd_pull(m, y.w + hv + h2 * KD_R(1.0 / 14.0) * (KD_R(6) * k2 - k3 + KD_R(2) * k4));
    kd_state o;
    o.w = y.w + (hv + h2 * KD_R(1.0 / 90.0) * (KD_R(7) * k1 + KD_R(24) * k2 + KD_R(6) * k3 + KD_R(8) * k4));
    o.dw = y.dw + h * KD_R(1.0 / 90.0) * (KD_R(7) * (k1 + k5) + KD_R(32) * (k2 + k4) + KD_R(12) * k3);
    return o;
}

/* d(chi)/dtau, the azimuth by which the hole drags the ray: a (2 E w - a L w^2) / (1 - 2w + a^2 w^2). */
KD_FN real kd_drag(kd_motion m, real e, real a, real w)
{
    return a * w * (KD_R(2) * e - a * m.momentum * w) / (KD_R(1) - w * (KD_R(2) - a * a * w));
}

#endif
