/* The radial motion in closed form, w(tau) of w'^2 = R(w), without roots, turning points or cases.
 *
 * Biermann's formula (Whittaker & Watson 20.6) gives the solution through w = 0 in Weierstrass functions whose
 * invariants are polynomials in the coefficients of R. With P = wp - A/12 and q = 1/(4P), E = 1:
 *   q'^2 = N(q) = q + A q^2 + 4 D q^3 + 16 G q^4,  G = (K^2 + A D)/4,    w = (2 q' + 4 K q^2) / (1 + 4 D q^2).
 * q starts as tau^2/4; the duplication formula q(2z) = 4 N / M with M = 1 - 8 D q^2 - 128 G q^3 - 64 (A G - D^2/4) q^4
 * carries a short series at tau/2^n to tau. All that in units of sqrt|A|, some b: in M its fifth power overflows from b = 1e4.
 * For an observer at infinity only: there q has no pole outside the horizon,
 * since w = K/D >= 1/a^2 at the pole. */
#ifndef KD_RADIAL_CLOSED_GLSL
#define KD_RADIAL_CLOSED_GLSL

struct kd_radial {
    float scale;              /* b: what follows belongs to the time b tau and to w/b */
    float a2, k, d;           /* A, K, D of the motion */
    float g16;                /* 16 G */
    float m3, m4;             /* M = 1 - 8 D q^2 + m3 q^3 + m4 q^4 */
    float s1, s2, s3, s4, s5; /* z^2 / (4 q) = 1 + s1 z^2 + s2 z^4 + ... */
    float horizon;            /* w of the outer horizon, in M */
    float limit;              /* captured rays: an upper bound of the Mino time to the horizon; 0: the ray scatters */
};

/* horizon: 1/r+. */
kd_radial kd_radial_of(kd_geodesic m, float horizon)
{
    kd_radial o;
    o.scale = sqrt(max(abs(m.a2), 1.0));
    float unit = 1.0 / o.scale, unit2 = unit * unit;
    o.a2 = m.a2 * unit2;
    o.k = m.k * unit2 * unit;
    o.d = m.d * unit2 * unit2;
    float g = 0.25 * (o.k * o.k + o.d * o.a2);
    o.g16 = 16.0 * g;
    o.m3 = -128.0 * g;
    o.m4 = -64.0 * (o.a2 * g - 0.25 * o.d * o.d);
    float g2 = o.a2 * o.a2 * (1.0 / 12.0) - o.d;
    float g3 = o.a2 * (o.a2 * o.a2 * (1.0 / 432.0) - g2 * (1.0 / 12.0)) - g;
    o.s1 = o.a2 * (-1.0 / 12.0);
    o.s2 = g2 * (1.0 / 20.0);
    o.s3 = g3 * (1.0 / 28.0);
    o.s4 = g2 * g2 * (1.0 / 1200.0);
    o.s5 = g2 * g3 * (3.0 / 6160.0);

    /* R' = 2w (A + 3Kw - 2Dw^2) vanishes once between infinity and the photon region; R(1/r+) >= 0 always. So the ray is
     * captured exactly if R > 0 there, or if that point lies behind the horizon, and meanwhile R is above its least value. */
    float disc = sqrt(max(9.0 * m.k * m.k + 8.0 * m.d * m.a2, 0.0));
    float wm = min(-2.0 * m.a2 / (3.0 * m.k + disc), horizon);
    float rm = 1.0 + wm * wm * (m.a2 + wm * (2.0 * m.k - m.d * wm));
    bool captured = m.a2 >= 0.0 || wm >= horizon || rm > 0.0;
    float least = m.a2 >= 0.0 ? 1.0 : max(rm, 1e-6);
    o.horizon = horizon;
    o.limit = captured ? horizon / sqrt(least) : 0.0;
    return o;
}

float kd_duplicate(kd_radial o, float q)
{
    float n = q * (1.0 + q * (o.a2 + q * (4.0 * o.d + q * o.g16)));
    return 4.0 * n / (1.0 + q * q * (-8.0 * o.d + q * (o.m3 + q * o.m4)));
}

struct kd_radius { float w; bool valid; };

/* w after Mino time tau; valid while the ray is outside the horizon and has not escaped. The series starts at
 * tau/2^(3 + extra), whose argument should stay below 0.6: |A|^(1/2) tau is at most about (n + 1) pi at order n, so that
 * extra = 0, 1, 3 serve n = 0, up to 2, up to 8; a compile-time constant, for the loop to unroll. Beyond the horizon the closed form goes on, turns inside and comes back out, so that w
 * alone cannot tell: a captured ray must still be falling, and within its bound of time. An escaped one has w < 0. */
kd_radius kd_radial_at(kd_radial o, float tau, int extra)
{
    kd_radius r;
    float z = tau * o.scale * (0.125 / float(1 << extra)), z2 = z * z;
    float q = 0.25 * z2 / (1.0 + z2 * (o.s1 + z2 * (o.s2 + z2 * (o.s3 + z2 * (o.s4 + z2 * o.s5)))));
    float low = q;
    for (int i = 0; i < extra; i++) {
        q = kd_duplicate(o, q);
        low = min(low, q);
    }
    q = kd_duplicate(o, q);
    low = min(low, q);
    q = kd_duplicate(o, q);
    low = min(low, q);
    /* The last duplication with its derivative. */
    float n = q * (1.0 + q * (o.a2 + q * (4.0 * o.d + q * o.g16)));
    float mm = 1.0 + q * q * (-8.0 * o.d + q * (o.m3 + q * o.m4));
    float nq = 1.0 + q * (2.0 * o.a2 + q * (12.0 * o.d + q * 4.0 * o.g16));
    float mq = q * (-16.0 * o.d + q * (3.0 * o.m3 + q * 4.0 * o.m4));
    float inv = 1.0 / mm;
    float q2 = 4.0 * n * inv;
    float dq = 2.0 * sqrt(max(n, 0.0)) * inv * inv * (nq * mm - n * mq);
    float ddq = 0.5 + q2 * (o.a2 + q2 * (6.0 * o.d + q2 * 2.0 * o.g16));
    float den = 1.0 / (1.0 + 4.0 * o.d * q2 * q2);
    float v = (2.0 * dq + 4.0 * o.k * q2 * q2) * den;
    float dw = ddq + 4.0 * q2 * dq * (o.k - o.d * v); /* half of dw/dtau, over den */
    r.w = v / o.scale;
    r.valid = min(low, q2) > 0.0 && r.w > 0.0 && r.w < o.horizon && (o.limit == 0.0 || (dw > 0.0 && tau < o.limit));
    return r;
}

#endif
