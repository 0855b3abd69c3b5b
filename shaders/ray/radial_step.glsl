/* Radial motion w'' = A w + 3K w^2 - 2D w^3, integrated by steps, and the azimuth by which the hole drags a ray. */
#ifndef KD_RADIAL_STEP_GLSL
#define KD_RADIAL_STEP_GLSL

#include "shared/math.glsl"
#include "ray/nystroem.glsl"
#include "ray/hole.glsl"

struct kd_state { float w, dw; };

float kd_acceleration(kd_geodesic m, float w) { return w * (m.a2 + w * (3.0 * m.k - 2.0 * m.d * w)); }

kd_state kd_radial_step(kd_geodesic m, kd_state y, float h)
{
    kd_state o;
    KD_NYSTROEM_STEP(float, kd_acceleration, m, y.w, y.dw, h, o.w, o.dw)
    return o;
}

/* W + |w'| of a ray that does not turn, with W = E (1 + a^2 w^2) - a L w^2. The lower bounds matter only inside the
 * horizon, where the values have no meaning. */
float kd_one_way(kd_geodesic m, kd_state y, float e, float a, float way)
{
    return max(e + a * (a * e - m.momentum) * y.w * y.w + max(way * y.dw, 0.0), 1e-12);
}

/* w'^2 from W^2 - D K w^2, a form that keeps its precision next to the horizon. */
float kd_radial_potential(kd_geodesic m, float w, float e, float a, float root)
{
    precise float w2 = w * w, all = e + a * (a * e - m.momentum) * w2,
                  square = all * all - kd_delta(w, root) * m.k * w2;
    return square;
}

/* Rate chi' of the azimuth chi by which the hole drags a ray: chi' = a (W/D - E), with D = 1 - 2w + (a^2 + q^2) w^2.
 *
 * Towards the horizon chi' diverges as 1/D, and so would its quadrature. For a falling ray the azimuth of ingoing
 * Kerr-Schild coordinates is regular. Its rate lacks the term a w'/D, whose integral is elementary; kd_drag_fall adds
 * that integral. Because w'^2 = W^2 - D K w^2, the rate is a (K w^2/(W + w') - E), which has neither a pole nor a
 * difference of large numbers. The same holds with the other sign of w' for a ray that comes from next to the horizon.
 * way: 1 for a ray that goes straight in, -1 for a ray that goes straight out, otherwise 0. */
float kd_drag(kd_geodesic m, kd_state y, float e, float a, float root, float way)
{
    float w = y.w, w2 = w * w;
    if (way != 0.0)
        return a * (m.k * w2 / kd_one_way(m, y, e, a, way) - e);
    return a * w * (2.0 * e - m.drag * w) / kd_horizons(w, root);
}

/* kd_drag for a ray that may come from inside the horizon or return to it. The function uses ingoing coordinates (way =
 * -1) while the ray goes outwards, and outgoing ones (way = 1) while the ray returns. With this choice neither rate
 * divides by D. Both azimuths are smooth where the ray turns, because w'^2 = W^2 - D K w^2. */
float kd_drag_ingoing(kd_geodesic m, kd_state y, float e, float a, float root, float way)
{
    float w2 = y.w * y.w, speed = abs(y.dw), sum = max(e + a * (a * e - m.momentum) * w2 + speed, 1e-12);
    bool along = way * y.dw >= 0.0;
    return a * ((along ? m.k * w2 : sum) / (along ? sum : kd_horizons(y.w, root)) - e);
}

/* True if the light that an observer at w receives comes from outside. Only an observer on or inside the horizon
 * receives other light. Such light crosses the horizon with W < 0. It comes from the other side of the hole's past, and
 * is taken as dark. W has no meaning at a horizon that a ray does not cross. */
bool kd_from_outside(kd_geodesic m, float w, float e, float a, float horizon)
{
    return w < horizon || e + a * (a * e - m.momentum) * horizon * horizon > 0.0;
}

float kd_drag_fall(float w, float a, float root) { return a * kd_fall(w, root); }

/* The turning point of the radial motion, which together with the constants of motion decides where a ray ends. R' = 2w
 * (A + 3Kw - 2Dw^2) vanishes at one place between infinity and the photon region, and at the horizon R = W^2. So a ray
 * passes that place if and only if R > 0 at the place. The form R = W^2 - D K w^2 keeps its precision next to the
 * horizon too. */
struct kd_turning_point {
    /* w of the turning point, or of the horizon if the turning point is inside the horizon; R at that w */
    float w, r;
    float noise; /* bound of the rounding error of r */
    bool open;   /* true if the turning point is clearly inside the horizon, so that the ray does not turn */
};

kd_turning_point kd_turning_point_of(kd_geodesic m, kd_ray ray, float a, float horizon, float root, kd_rounding off)
{
    kd_turning_point o;
    float by = kd_squared_by(m), k = by * m.k,
          disc = sqrt(max(9.0 * k * k + 8.0 * (by * m.d) * (by * m.a2), 0.0)) * kd_squared_back(by);
    float w = m.a2 < 0.0 ? -2.0 * m.a2 / (3.0 * m.k + disc) : 2.0;
    o.open = w > 1.01 * horizon;
    o.w = min(w, horizon);
    float w2 = o.w * o.w, dw2 = max(kd_delta(o.w, root), 0.0) * w2, l = abs(ray.l), p = abs(ray.p);
    precise float fall = ray.e + a * (a * ray.e - m.momentum) * w2;
    precise float r = fall * fall - dw2 * m.k;
    o.r = r;
    o.noise =
        off.unit * (abs(fall) * (off.w + off.wl * l) + dw2 * (l * (l + off.l) + p * (p + off.p) + off.k) + off.least);
    return o;
}

/* Bound of the rounding error of w' at the start of a ray. */
float kd_speed_noise(kd_geodesic m, kd_state y, kd_rounding off)
{
    return off.unit * (off.size_e + sqrt(max(m.k, 0.0)) * y.w);
}

/* Computes the turning point for an observer next to the photon orbits. It starts from the observer's place, where R =
 * w'^2. R' vanishes at the turning point, so between the two places R changes by x^2 (A + 6Kw - 6Dw^2 + x (2K - 4Dw) -
 * x^2 D), where x is their distance. The function uses this form, because w'^2 is more precise than R where w' is close
 * to 0. */
kd_turning_point kd_turning_point_beside(kd_geodesic m, kd_turning_point b, kd_state y, float horizon, kd_rounding off)
{
    float x = y.w - b.w, c2 = m.a2 + 6.0 * b.w * (m.k - m.d * b.w),
          hump = x * x * (c2 + x * (2.0 * m.k - 4.0 * m.d * b.w - x * m.d));
    float dw = kd_speed_noise(m, y, off), noise = dw * (abs(y.dw) + dw) + off.unit * (abs(x * c2) * b.w + abs(hump));
    if (b.w < horizon && noise < b.noise) {
        b.r = y.dw * y.dw - hump;
        b.noise = noise;
    }
    return b;
}

/* Error of R = w'^2 along a ray traced by steps, due to rounding of w and of w' at the start of the ray. */
float kd_start_noise(kd_geodesic m, kd_state y, kd_rounding off)
{
    float dw = kd_speed_noise(m, y, off);
    return dw * (abs(y.dw) + dw) + off.unit * abs(y.w * kd_acceleration(m, y.w));
}

/* True if a ray in this state falls into the horizon without turning. */
bool kd_falls_in(kd_turning_point b, kd_state y) { return y.dw > 0.0 && (b.open || y.w > b.w || b.r > 0.0); }

/* The value of `way` for kd_drag from this state on. */
float kd_direction_of_motion(kd_turning_point b, kd_state y)
{
    return kd_falls_in(b, y) ? 1.0 : y.dw < 0.0 && (b.open || y.w < b.w || b.r > 0.0) ? -1.0 : 0.0;
}

/* True if a ray in this state escapes. */
bool kd_escapes(kd_turning_point b, kd_state y)
{
    return y.dw < 0.0 ? b.open || y.w < b.w || b.r > 0.0 : !b.open && y.w < b.w && b.r <= 0.0;
}

/* True if the ray's end is certain in spite of rounding. start: the value of kd_start_noise for the state y. */
bool kd_is_decided(kd_turning_point b, kd_state y, float start)
{
    bool ahead = y.dw < 0.0 ? y.w > b.w : y.w < b.w;
    return (!b.open && abs(b.r) > b.noise) || ((b.open || !ahead) && y.dw * y.dw > max(b.noise, start));
}

#endif
