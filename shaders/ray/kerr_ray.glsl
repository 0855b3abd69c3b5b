/* A ray is a null geodesic of Kerr in Mino time tau, with w = M/r and u = cos(theta), M = 1, traced from the observer.
 *
 *   w'^2 = R(w) = E^2 + A w^2 + 2 K w^3 - D w^4     A = a^2 E^2 - L^2 - Q,  K = Q + (L - aE)^2,  D = a^2 Q
 *   u'^2 = U(u) = Q + A u^2 - a^2 E^2 u^4
 *
 * (Carter 1968, with w and u for r and theta.) With l = L / sin(theta_o) and p = p_theta at the observer,
 * L^2 + Q = l^2 + p^2 - a^2 E^2 cos^2(theta_o), so that no term is singular for an observer on the axis. At infinity
 * l = -alpha and p = beta. E is the photon's energy at infinity over the one that the observer measures. */
#ifndef KD_KERR_RAY_GLSL
#define KD_KERR_RAY_GLSL

struct kd_ray {
    float e, l, p;                /* E, L / sin(theta_o), p_theta of the arriving photon         */
    float w, dw;                  /* M/r of the observer, and dw/dtau there along the traced path */
    float size_e, size_l, size_p; /* of the terms that e, l and p are sums of: by so many roundoffs they may be off */
};

/* A ray is its constants of motion and the coefficients of R(w) and U(u). */
struct kd_geodesic {
    float momentum, q, energy2; /* L, Q, a^2 E^2 */
    float a2, k, d;             /* A, K, D       */
};

/* a: spin; u, s: cosine and sine of the observer's polar angle. */
kd_geodesic kd_geodesic_of(kd_ray ray, float a, float u, float s)
{
    kd_geodesic m;
    float ae = a * ray.e;
    m.energy2 = ae * ae;
    m.momentum = ray.l * s;
    m.q = ray.p * ray.p + u * u * (ray.l * ray.l - m.energy2);
    m.a2 = m.energy2 * (1.0 + u * u) - ray.l * ray.l - ray.p * ray.p;
    precise float j = m.momentum - ae, k = m.q + j * j; /* not multiplied out */
    m.k = k;
    m.d = a * a * m.q;
    return m;
}

/* A factor that A, K and Q are taken times where they are squared, and divided by after: 1, but where a float does
 * not hold their squares, as those of a fast observer far away are. A power of two: no digit changes. */
float kd_squared_by(kd_geodesic m) { return max(abs(m.a2), abs(m.k)) > 1e15 ? 8.6736174e-19 : 1.0; }

/* This is Delta/r^2 = 1 - 2w + a^2 w^2 from root = sqrt(1 - a^2): 1 - w is exact near the horizon of a fast hole,
 * and the two factors keep their digits where the horizons all but meet. Precise: multiplied out, as a driver may,
 * they would have lost them. */
float kd_delta(float w, float root)
{
    precise float d = 1.0 - w, h = root * w, delta = (d - h) * (d + h);
    return delta;
}

#endif
