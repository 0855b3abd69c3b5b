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

/* The azimuth chi by which the hole drags a ray, chi' = a (2 E w - a L w^2) / ((1 - r+ w)(1 - r- w)).
 *
 * On the way into the horizon chi' diverges as 1/(1 - r+ w), and its quadrature with it. What a falling ray leaves regular is
 * the azimuth of ingoing Kerr-Schild coordinates: less a w' over the same denominator, whose integral is elementary and
 * is put back by kd_drag_fall. falling: 1 for a ray that goes straight in, else 0. */
KD_FN real kd_drag(kd_motion m, kd_state y, real e, real a, real r_plus, real r_minus, real falling)
{
    return a * (y.w * (KD_R(2) * e - a * m.momentum * y.w) - falling * y.dw) /
           ((KD_R(1) - r_plus * y.w) * (KD_R(1) - r_minus * y.w));
}

/* Integral from 0 to w of a dw / ((1 - r+ w)(1 - r- w)) = a/(r+ - r-) log(1 + x), x = (r+ - r-) w / (1 - r+ w); by its
 * series where x is small, as for a hole that is nearly extremal. */
KD_FN real kd_drag_fall(real w, real a, real r_plus, real r_minus)
{
    real first = w / (KD_R(1) - r_plus * w), x = (r_plus - r_minus) * first, y = x / (KD_R(2) + x), y2 = y * y;
    real series = KD_R(2) * (KD_R(1) + y2 * (KD_R(1.0 / 3.0) + y2 * (KD_R(1.0 / 5.0) + y2 * KD_R(1.0 / 7.0)))) / (KD_R(2) + x);
    return a * first * (x < KD_R(0.25) ? series : log(KD_R(1) + x) / x);
}

/* Whether a ray at w, falling (dw > 0), meets no turning point before the horizon: radial_closed.glsl has the argument. */
KD_FN bool kd_falls_in(kd_motion m, kd_state y, real e, real horizon)
{
    real disc = sqrt(max(KD_R(9) * m.k * m.k + KD_R(8) * m.d * m.a2, KD_R(0)));
    real wm = KD_R(-2) * m.a2 / (KD_R(3) * m.k + disc);
    real rm = e * e + wm * wm * (m.a2 + wm * (KD_R(2) * m.k - m.d * wm));
    return y.dw > KD_R(0) && (m.a2 >= KD_R(0) || wm >= horizon || y.w > wm || rm > KD_R(0));
}

#endif
