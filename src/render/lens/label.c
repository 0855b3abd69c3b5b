#include "render/lens/label.h"

#include "render/view/ring.h"

void kd_lens_label(const struct kd_scene *scene, const struct kd_plan_lens *lens, uint32_t x, uint32_t y,
                   struct kd_camera_label *out)
{
    if (lens->ring) {
        const struct kd_ring ring = kd_ring_of(scene);
        const struct kd_critical_point column = kd_ring_column(&ring, x);
        *out = kd_ring_label(&ring, &column, y);
        return;
    }
    const struct kd_camera_exact exact = kd_camera_exact(scene);
    kd_camera_label(&exact, x, y, out);
}
