/* The camera, the rows of this dispatch, and the constants of motion of a ray from its place in the picture. This file
 * needs KD_CAMERA_BINDING and the specialisation constant SIGHT (KD_SIGHT_). With KD_CAMERA_ONLY it declares no rows:
 * such kernels have push constants of their own and read `cam` themselves. */
#ifndef KD_CAMERA_GLSL
#define KD_CAMERA_GLSL

#include "shared/math.glsl"

const bool FINITE = SIGHT != KD_SIGHT_PLANE; /* true if the observer is at a finite radius */

#define F(name) float name;
#define U(name) uint name;
struct kd_camera_block { KD_CAMERA_FIELDS_(F, U) };
layout(set = 0, binding = KD_CAMERA_BINDING, std140) uniform Camera { kd_camera_block camera_; };
kd_camera_block cam;

#ifndef KD_CAMERA_ONLY
struct kd_slice { KD_SLICE_FIELDS_(F, U) };
layout(push_constant) uniform Slice { kd_slice slice_; };

/* kd_camera_read copies the blocks into `cam` and `slice`. It must be called before the first branch, because after a
 * branch lavapipe reads a block again for each lane and each use. */
kd_slice slice;
void kd_camera_read()
{
    cam = camera_;
    slice = slice_;
}
#endif

/* Returns the component of a direction along c0. Sets x and y to the components along cx and cy. */
float kd_camera_ahead(inout float x, inout float y)
{
    if (SIGHT == KD_SIGHT_SPHERE) {
        vec2 longitude = kd_quarter_turns(x * cam.turn_x), latitude = kd_quarter_turns(y * cam.turn_y);
        x = latitude.x * longitude.y;
        y = latitude.y;
        return latitude.x * longitude.x;
    }
    if (SIGHT == KD_SIGHT_DOME) {
        float d = sqrt(x * x + y * y);
        vec2 off = kd_quarter_turns(d * cam.turn_x);
        /* the quotient is limited, because only the middle ray itself is nearer to the middle than half a step */
        x *= off.y / max(d, 0.25);
        y *= off.y / max(d, 0.25);
        return off.x;
    }
    return 1.0;
}

/* Bounds of the rounding errors of the camera's rays. */
kd_rounding kd_camera_rounding()
{
    return kd_rounding(cam.size_e, cam.noise_w, cam.noise_wl, cam.noise_p, cam.noise_l, cam.noise_k, cam.noise_0,
                       16.0 * KD_ROUNDOFF);
}

kd_ray kd_camera_ray(uint px, uint py)
{
    float x = float(int(px)) - cam.middle_x, y = cam.middle_y - float(int(py)), ahead = kd_camera_ahead(x, y);
    float kx = ahead * cam.c0x + x * cam.cxx + y * cam.cyx;
    float ky = ahead * cam.c0y + x * cam.cxy + y * cam.cyy;
    kd_ray ray;
    if (!FINITE) { /* at infinity the direction k is (alpha, beta) */
        ray.e = 1.0;
        ray.l = -kx;
        ray.p = ky;
        ray.w = 0.0;
        ray.dw = 1.0;
    } else { /* at a finite radius the direction k is (k_r, k_theta, k_phi), and the photon moves along -k */
        float kz = ahead * cam.c0z + x * cam.cxz + y * cam.cyz;
        float n = inversesqrt(kx * kx + ky * ky + kz * kz), m_r = -kx * n, m_theta = -ky * n, m_phi = -kz * n;
        ray.e = cam.e_t + cam.e_r * m_r + cam.e_theta * m_theta + cam.e_phi * m_phi;
        ray.l = cam.l_t + cam.l_r * m_r + cam.l_theta * m_theta + cam.l_phi * m_phi;
        ray.p = cam.p_t - (cam.p_r * kx + cam.p_theta * ky + cam.p_phi * kz) *
                              /* multiplied by n here instead of through m, which saves one rounding */
                              n;
        ray.w = cam.w0;
        ray.dw = cam.dw_t - (cam.dw_r * kx + cam.dw_theta * ky + cam.dw_phi * kz) * n;
    }
    return ray;
}

#endif
