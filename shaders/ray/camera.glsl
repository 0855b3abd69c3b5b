/* From a ray's place in the picture to its constants of motion. Needs the camera's push constants as `cam` and the
 * specialisation constant FINITE (observer at a finite radius). */
#ifndef KD_CAMERA_GLSL
#define KD_CAMERA_GLSL

kd_ray kd_camera_ray(uint px, uint py)
{
    float x = float(px) - cam.middle_x, y = cam.middle_y - float(py);
    float kx = cam.c0x + x * cam.cxx + y * cam.cyx;
    float ky = cam.c0y + x * cam.cxy + y * cam.cyy;
    kd_ray ray;
    if (!FINITE) { /* (alpha, beta) */
        ray.e = 1.0;
        ray.l = -kx;
        ray.p = ky;
        ray.w = 0.0;
        ray.dw = 1.0;
    } else { /* (k_r, k_theta, k_phi); the photon flies along -k */
        float kz = cam.c0z + x * cam.cxz + y * cam.cyz;
        float n = inversesqrt(kx * kx + ky * ky + kz * kz);
        float m_phi = -kz * n;
        ray.e = cam.e0 + cam.e1 * m_phi;
        ray.l = cam.l0 + cam.l1 * m_phi;
        ray.p = -cam.cp * ky * n;
        ray.w = cam.w0;
        ray.dw = cam.cw * kx * n;
    }
    return ray;
}

#endif
