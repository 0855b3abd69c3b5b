/* Integrates the azimuth by which the hole drags a ray, chi' = a (W/D - E) (radial_step.glsl), over a stretch of its
 * path. The rule is Gauss-Legendre quadrature with seven nodes (Abramowitz & Stegun 25.4.29): the middle, and three on
 * each side of it. */
#ifndef KD_ARC_DRAG_GLSL
#define KD_ARC_DRAG_GLSL

#include "ray/arc.glsl"

/* g and g' for the times from an end of the stretch to the nodes of the quadrature. */
struct kd_nodes { kd_arc outer, between, inner, middle; };

kd_nodes kd_nodes_of(kd_lattice l, float z)
{
    kd_nodes o;
    o.outer = kd_arc_short(l, 0.0254460438286207 * z);
    o.between = kd_arc_short(l, 0.129234407200303 * z);
    o.inner = kd_arc_short(l, 0.297077424311301 * z);
    o.middle = kd_arc_short(l, 0.5 * z);
    return o;
}

struct kd_drag_terms {
    float a, k, e, root, unit;
    float e2, al; /* 2E, and a L + q^2 E */
    float all;    /* factor of w^2 in W = E + `all` w^2 */
    bool falls;   /* true if the ray falls straight into the horizon */
};

kd_drag_terms kd_drag_terms_of(kd_geodesic m, float e, float a, float root, float unit, bool falls)
{
    kd_drag_terms o;
    o.a = a;
    o.k = m.k;
    o.e = e;
    o.root = root;
    o.unit = unit;
    o.e2 = 2.0 * e;
    o.al = m.drag;
    o.all = a * (a * e - m.momentum);
    o.falls = falls;
    return o;
}

/* The integrand without the factor a. For a ray that falls in, it is the integrand in ingoing coordinates without its
 * term -E. Both forms are always computed, because a driver may run both branches of an if. */
float kd_drag_at(kd_drag_terms t, float v)
{
    float w = v * t.unit, w2 = w * w, d = kd_delta(w, t.root), kw = t.k * w2;
    precise float one_way = t.e + t.all * w2, square = one_way * one_way - d * kw;
    float num = t.falls ? kw : w * (t.e2 - t.al * w);
    float den = t.falls ? one_way + sqrt(max(square, 0.0)) : d;
    return num / max(den, 1e-12);
}

/* Integrates between two points of a path. z: scaled time between the two points. n: the nodes for that time. */
float kd_drag_between(kd_drag_terms t, kd_centre from, kd_centre to, kd_nodes n, float z)
{
    float sum =
        0.208979591836735 * kd_drag_at(t, kd_around(from, n.middle).x) +
        0.190915025252559 * (kd_drag_at(t, kd_around(from, n.inner).x) + kd_drag_at(t, kd_around(to, n.inner).y)) +
        0.139852695744638 * (kd_drag_at(t, kd_around(from, n.between).x) + kd_drag_at(t, kd_around(to, n.between).y)) +
        0.0647424830844348 * (kd_drag_at(t, kd_around(from, n.outer).x) + kd_drag_at(t, kd_around(to, n.outer).y));
    return t.a * z * t.unit * (t.falls ? sum - t.e : sum);
}

/* The term of the azimuth at w that ingoing coordinates leave out; 0 for a ray that does not fall. */
float kd_drag_fallen(kd_drag_terms t, float w) { return t.falls ? t.a * kd_fall(w, t.root) : 0.0; }

#endif
