/* Which kernels the driver has compiled and keeps in its files (kd_vk_compiling), so that they are not compiled beside
 * the device again. Kept in a file beside the pipeline cache, as numbers of 8 bytes; a number names a kernel and the
 * folder of the driver's files, so that none holds once that was removed. One thread at a time. */
#ifndef KD_RENDER_DEVICE_COMPILED_H
#define KD_RENDER_DEVICE_COMPILED_H

#include "render/device/kernels.h"

struct kd_renderer;

bool kd_compiled_has(const struct kd_renderer *renderer, const struct kd_kernel_wishes *kernels);
void kd_compiled_add(const struct kd_renderer *renderer, const struct kd_kernel_wishes *kernels);

#endif
