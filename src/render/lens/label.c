#include "render/lens/label.h"

#include "render/view/layout.h"
#include "render/view/ring.h"

#include <math.h>

/* The labels of a pixel's ray as the kernel makes them, in its own arithmetic: what it loses there is a shift of
 * some 1e-7 of the picture and no error of the map. */
static void label_in_single(const struct kd_camera_block *c, bool finite, uint32_t px, uint32_t py,
                            struct kd_camera_label *out)
{
    double off_x = (float)px - c->middle_x, off_y = c->middle_y - (float)py;
    const float ahead = (float)kd_camera_ahead(c->sight, c->turn_x, c->turn_y, &off_x, &off_y), x = (float)off_x,
                y = (float)off_y;
    float kx = ahead * c->c0x + x * c->cxx + y * c->cyx, ky = ahead * c->c0y + x * c->cxy + y * c->cyy;
    *out = (struct kd_camera_label) { .alpha = kx, .beta = ky, .energy = 1 };
    if (!finite)
        return;
    float kz = ahead * c->c0z + x * c->cxz + y * c->cyz, n = 1 / sqrtf(kx * kx + ky * ky + kz * kz);
    double m_r = -kx * n, m_theta = -ky * n, m_phi = -kz * n;
    kd_camera_label_of(c->e_t + c->e_r * m_r + c->e_theta * m_theta + c->e_phi * m_phi,
                       c->l_t + c->l_r * m_r + c->l_theta * m_theta + c->l_phi * m_phi,
                       c->p_t - (c->p_r * kx + c->p_theta * ky + c->p_phi * kz) * n,
                       c->dw_t - (c->dw_r * kx + c->dw_theta * ky + c->dw_phi * kz) * n < 0, out);
}

void kd_lens_label(const struct kd_scene *scene, const struct kd_plan *plan, uint32_t x, uint32_t y,
                   struct kd_camera_label *out)
{
    if (plan->ring) {
        const struct kd_ring ring = kd_ring_of(scene);
        const struct kd_critical_point column = kd_ring_column(&ring, x);
        *out = kd_ring_label(&ring, &column, y);
    } else if (plan->path == KD_LENS_LISTED) {
        const struct kd_camera_exact exact = kd_camera_exact(scene);
        kd_camera_label(&exact, x, y, out);
    } else {
        const struct kd_camera_block rounded = kd_camera_block(scene);
        label_in_single(&rounded, !isinf(scene->camera.r), x, y, out);
    }
}
