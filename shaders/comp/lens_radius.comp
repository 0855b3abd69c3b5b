/* The lens map where a scene needs the radii of the crossings alone, for an observer at infinity: closed form, no loop
 * over steps, no divergence. Plane n of the map is w = M/r of the crossing of order n, 0 if there is none. */
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/interface.h"
#include "ray/kerr_ray.glsl"
#include "ray/polar.glsl"
#include "ray/radial_closed.glsl"

layout(constant_id = 0) const uint ORDERS = 3;
layout(constant_id = 1) const uint CRITICAL = 0; /* rays of each listed pixel; 0: the picture's grid */
layout(constant_id = 2) const uint GENERATOR = 1; /* of the lattice that they are on */
layout(constant_id = 3) const uint SHIFT = 0;
layout(local_size_x = KD_GROUP_SIZE) in;
const bool FINITE = false;

#define F(name) float name;
#define U(name) uint name;
layout(push_constant) uniform Camera { KD_CAMERA_FIELDS_(F, U) } cam;
layout(set = 0, binding = 0) buffer LensMap { float lens[]; };
#include "ray/camera.glsl"
#include "ray/place.glsl"

void main()
{
    uvec2 step_;
    uint at;
    if (!kd_this_ray(step_, at))
        return;
    kd_ray ray = kd_camera_ray(step_.x, step_.y);
    kd_geodesic m = kd_geodesic_of(ray, cam.spin, cam.u, cam.s);
    kd_polar polar = kd_polar_of(m, ray, cam.u, cam.s);
    kd_radial radial = kd_radial_of(m, cam.horizon);

    kd_radius r = kd_radial_at(radial, polar.first, 0);
    bool alive = polar.crosses && r.valid;
    lens[at] = alive ? r.w : 0.0;
    float tau = polar.first;
    for (uint n = 1; n < min(ORDERS, 3); n++) {
        at += cam.stride;
        tau += polar.half_;
        r = kd_radial_at(radial, tau, 1);
        alive = alive && r.valid;
        lens[at] = alive ? r.w : 0.0;
    }
    for (uint n = 3; n < ORDERS; n++) {
        at += cam.stride;
        tau += polar.half_;
        r = kd_radial_at(radial, tau, 3);
        alive = alive && r.valid;
        lens[at] = alive ? r.w : 0.0;
    }
}
