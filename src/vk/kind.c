#include "vk/kind.h"

static const struct kd_vk_kind_info kinds[] = {
    [KD_VK_STORAGE] = { .descriptor = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER },
    [KD_VK_UNIFORM] = { .descriptor = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER },
    [KD_VK_TEXELS_R] = { VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER, VK_FORMAT_R32_SFLOAT, 4 },
    [KD_VK_TEXELS_RGBA] = { VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER, VK_FORMAT_R32G32B32A32_SFLOAT, 16 },
    [KD_VK_TEXELS_WORD] = { VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER, VK_FORMAT_R32_UINT, 4 },
    [KD_VK_TEXELS_PAIR] = { VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER, VK_FORMAT_R32G32_UINT, 8 },
    [KD_VK_TEXELS_QUAD] = { VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER, VK_FORMAT_R32G32B32A32_UINT, 16 },
};

const struct kd_vk_kind_info *kd_vk_kind_info(enum kd_vk_kind kind)
{
    return (uint32_t)kind < sizeof kinds / sizeof *kinds ? &kinds[kind] : NULL;
}
