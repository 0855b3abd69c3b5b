/* A ray is a null geodesic of the Kerr metric, or with charge q of the Kerr-Newman metric. It is traced from the
 * observer in Mino time tau, with w = M/r, u = cos(theta) and M = 1. The equations of motion are
 *
 *   w'^2 = R(w) = E^2 + A w^2 + 2 K w^3 - D w^4     A = a^2 E^2 - L^2 - Q,  K = Q + (L - aE)^2,  D = a^2 Q + q^2 K
 *   u'^2 = U(u) = Q + A u^2 - a^2 E^2 u^4
 *
 * (Carter 1968, with w and u for r and theta.) With l = L / sin(theta_o) and p = p_theta at the observer, L^2 + Q = l^2
 * + p^2 - a^2 E^2 cos^2(theta_o), so that no term is singular for an observer on the axis. At infinity l = -alpha and p
 * = beta. E is the ratio of the photon's energy at infinity to the energy that the observer measures. */
#ifndef KD_KERR_RAY_GLSL
#define KD_KERR_RAY_GLSL

#include "ray/hole.glsl"

struct kd_ray {
    float e, l, p; /* E, L / sin(theta_o) and p_theta of the arriving photon */
    float w, dw;   /* w = M/r of the observer, and dw/dtau there along the traced path */
};

/* Bounds of the rounding error of R = W^2 - D K w^2, for all rays of an observer. E, L and p_theta are sums of terms,
 * whose sizes are at most size_e, |L| + d_l and |p| + d_p. The error of a sum is some roundoffs of these sizes. Let j =
 * |a| size_e, and let h be w at the horizon. Then the error of W is at most w + wl |l|, and the error of K is at most
 * l^2 + p^2 + p |p| + l |l| + k:
 *   w = size_e + |a| h^2 (j + s d_l),  wl = |a| s h^2,  p = d_p,  l = d_l + 2 s j,  k = j ((1 + u^2) j + s d_l),
 * and `least` is of second order (kd_camera_exact of src/render/view/camera.c). */
struct kd_rounding {
    float size_e, w, wl, p, l, k, least;
    float unit; /* unit of these bounds, which is several roundoffs */
};

/* The bounds for a single ray that is given by its exact labels (alpha, beta and the direction). */
kd_rounding kd_rounding_of_labels(kd_ray ray, float a, float u, float s, float horizon, float epsilon)
{
    float j = abs(a) * ray.e, wl = abs(a) * s * horizon * horizon, w = ray.e + abs(a) * j * horizon * horizon,
          all = w + wl * abs(ray.l);
    return kd_rounding(ray.e, w, wl, 0.0, 2.0 * s * j, (1.0 + u * u + 4.0 * epsilon) * j * j, 4.0 * epsilon * all * all,
                       16.0 * epsilon);
}

/* Constants of motion of a ray, and the coefficients of R(w) and U(u). */
struct kd_geodesic {
    float momentum, q, energy2; /* L, Q and a^2 E^2 */
    float a2, k, d;             /* A, K and D of R(w) */
    float drag;                 /* aL + q^2 E    */
};

/* The constants of a ray. u, s: cosine and sine of the observer's polar angle. */
kd_geodesic kd_geodesic_of(kd_ray ray, kd_hole_numbers hole, float u, float s)
{
    kd_geodesic m;
    float ae = hole.spin * ray.e;
    m.energy2 = ae * ae;
    m.momentum = ray.l * s;
    m.q = ray.p * ray.p + u * u * (ray.l * ray.l - m.energy2);
    m.a2 = m.energy2 * (1.0 + u * u) - ray.l * ray.l - ray.p * ray.p;
    precise float j = m.momentum - ae, k = m.q + j * j; /* a product of small factors, which must not be expanded */
    m.k = k;
    m.d = kd_quartic_of(hole, m.q, m.k);
    m.drag = kd_drag_of(hole, m.momentum, ray.e);
    return m;
}

/* Factor by which A, K and Q are multiplied before they are squared, so that the squares do not overflow. The result is
 * later multiplied by the inverse factor. The factor is 1 unless the squares exceed a float's range, as for a fast
 * observer far away. It is a power of two, so that no digit changes. */
float kd_squared_by(kd_geodesic m) { return max(abs(m.a2), abs(m.k)) > 1e15 ? 8.673617379884035e-19 : 1.0; }
float kd_squared_back(float by) { return by < 1.0 ? 1152921504606846976.0 : 1.0; }

#endif
