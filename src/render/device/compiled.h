/* Records which kernels the driver has compiled into its own cache (kd_vk_compiling). The device that only compiles
 * (frame/compilation.h) does not compile these kernels again. A file beside the pipeline cache holds 8 bytes for each
 * kernel: a hash of the kernel and of the driver's cache folder. An entry thus becomes invalid when that folder is
 * removed. One thread at a time. */
#ifndef KD_RENDER_DEVICE_COMPILED_H
#define KD_RENDER_DEVICE_COMPILED_H

#include "render/device/kernels.h"

struct kd_renderer;

bool kd_compiled_has(const struct kd_renderer *renderer, const struct kd_kernel_requests *kernels);
void kd_compiled_add(const struct kd_renderer *renderer, const struct kd_kernel_requests *kernels);

#endif
