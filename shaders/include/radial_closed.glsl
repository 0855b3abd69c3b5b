/* The radial motion in closed form, w(tau) of w'^2 = R(w), without roots, turning points or cases.
 *
 * Biermann's formula (Whittaker & Watson 20.6) gives the solution through w = 0 in Weierstrass functions whose
 * invariants are polynomials in the coefficients of R. With P = wp - A/12 and q = 1/(4P), E = 1:
 *   q'^2 = N(q) = q + A q^2 + 4 D q^3 + 16 G q^4,  G = (K^2 + A D)/4,    w = (2 q' + 4 K q^2) / (1 + 4 D q^2).
 * q starts as tau^2/4; the duplication formula q(2z) = 4 N / M with M = 1 - 8 D q^2 - 128 G q^3 - 64 (A G - D^2/4) q^4
 * carries a short series at tau/2^n to tau. For an observer at infinity only: there q has no pole outside the horizon,
 * since w = K/D >= 1/a^2 at the pole. */
#ifndef KD_RADIAL_CLOSED_GLSL
#define KD_RADIAL_CLOSED_GLSL

struct kd_radial {
    real a2, k, d;           /* A, K, D of the motion */
    real g16;                /* 16 G */
    real m3, m4;             /* M = 1 - 8 D q^2 + m3 q^3 + m4 q^4 */
    real s1, s2, s3, s4, s5; /* z^2 / (4 q) = 1 + s1 z^2 + s2 z^4 + ... */
    real horizon;            /* w of the outer horizon */
    real limit;              /* captured rays: an upper bound of the Mino time to the horizon; 0: the ray scatters */
};

/* horizon: 1/r+. */
KD_FN kd_radial kd_radial_of(kd_motion m, real horizon)
{
    kd_radial o;
    real g = KD_R(0.25) * (m.k * m.k + m.d * m.a2);
    o.a2 = m.a2;
    o.k = m.k;
    o.d = m.d;
    o.g16 = KD_R(16) * g;
    o.m3 = KD_R(-128) * g;
    o.m4 = KD_R(-64) * (m.a2 * g - KD_R(0.25) * m.d * m.d);
    real g2 = m.a2 * m.a2 * KD_R(1.0 / 12.0) - m.d;
    real g3 = m.a2 * (m.a2 * m.a2 * KD_R(1.0 / 432.0) - g2 * KD_R(1.0 / 12.0)) - g;
    o.s1 = m.a2 * KD_R(-1.0 / 12.0);
    o.s2 = g2 * KD_R(1.0 / 20.0);
    o.s3 = g3 * KD_R(1.0 / 28.0);
    o.s4 = g2 * g2 * KD_R(1.0 / 1200.0);
    o.s5 = g2 * g3 * KD_R(3.0 / 6160.0);

    /* R' = 2w (A + 3Kw - 2Dw^2) vanishes once between infinity and the photon region; R(1/r+) >= 0 always. So the ray is
     * captured exactly if R > 0 there, or if that point lies behind the horizon, and meanwhile R is above its least value. */
    real disc = sqrt(max(KD_R(9) * m.k * m.k + KD_R(8) * m.d * m.a2, KD_R(0)));
    real wm = min(KD_R(-2) * m.a2 / (KD_R(3) * m.k + disc), horizon);
    real rm = KD_R(1) + wm * wm * (m.a2 + wm * (KD_R(2) * m.k - m.d * wm));
    bool captured = m.a2 >= KD_R(0) || wm >= horizon || rm > KD_R(0);
    real least = m.a2 >= KD_R(0) ? KD_R(1) : max(rm, KD_R(1e-6));
    o.horizon = horizon;
    o.limit = captured ? horizon / sqrt(least) : KD_R(0);
    return o;
}

KD_FN real kd_duplicate(kd_radial o, real q)
{
    real n = q * (KD_R(1) + q * (o.a2 + q * (KD_R(4) * o.d + q * o.g16)));
    return KD_R(4) * n / (KD_R(1) + q * q * (KD_R(-8) * o.d + q * (o.m3 + q * o.m4)));
}

struct kd_radius { real w; bool valid; };

/* w after Mino time tau; valid while the ray is outside the horizon and has not escaped. The series starts at
 * tau/2^(3 + extra), whose argument should stay below 0.6: |A|^(1/2) tau is at most about (n + 1) pi at order n, so that
 * extra = 0, 1, 3 serve n = 0, up to 2, up to 8; a compile-time constant, for the loop to unroll. Beyond the horizon the closed form goes on, turns inside and comes back out, so that w
 * alone cannot tell: a captured ray must still be falling, and within its bound of time. An escaped one has w < 0. */
KD_FN kd_radius kd_radial_at(kd_radial o, real tau, int extra)
{
    kd_radius r;
    real z = tau * (KD_R(0.125) / KD_R(1 << extra)), z2 = z * z;
    real q = KD_R(0.25) * z2 / (KD_R(1) + z2 * (o.s1 + z2 * (o.s2 + z2 * (o.s3 + z2 * (o.s4 + z2 * o.s5)))));
    real low = q;
    for (int i = 0; i < extra; i++) {
        q = kd_duplicate(o, q);
        low = min(low, q);
    }
    q = kd_duplicate(o, q);
    low = min(low, q);
    q = kd_duplicate(o, q);
    low = min(low, q);
    /* The last duplication with its derivative. */
    real n = q * (KD_R(1) + q * (o.a2 + q * (KD_R(4) * o.d + q * o.g16)));
    real mm = KD_R(1) + q * q * (KD_R(-8) * o.d + q * (o.m3 + q * o.m4));
    real nq = KD_R(1) + q * (KD_R(2) * o.a2 + q * (KD_R(12) * o.d + q * KD_R(4) * o.g16));
    real mq = q * (KD_R(-16) * o.d + q * (KD_R(3) * o.m3 + q * KD_R(4) * o.m4));
    real inv = KD_R(1) / mm;
    real q2 = KD_R(4) * n * inv;
    real dq = KD_R(2) * sqrt(max(n, KD_R(0))) * inv * inv * (nq * mm - n * mq);
    real ddq = KD_R(0.5) + q2 * (o.a2 + q2 * (KD_R(6) * o.d + q2 * KD_R(2) * o.g16));
    real den = KD_R(1) / (KD_R(1) + KD_R(4) * o.d * q2 * q2);
    r.w = (KD_R(2) * dq + KD_R(4) * o.k * q2 * q2) * den;
    real dw = ddq + KD_R(4) * q2 * dq * (o.k - o.d * r.w); /* half of dw/dtau, over den */
    r.valid = min(low, q2) > KD_R(0) && r.w > KD_R(0) && r.w < o.horizon && (o.limit == KD_R(0) || (dw > KD_R(0) && tau < o.limit));
    return r;
}

#endif
