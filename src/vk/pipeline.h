/* Struct of a compute pipeline, private to this layer. */
#ifndef KD_VK_PIPELINE_H
#define KD_VK_PIPELINE_H

#include "vk/functions.h"
#include "vk/retire.h"
#include "vk/vk.h"

struct kd_vk_pipeline {
    struct kd_vk_retired retired; /* must be the first member, because retire.c accesses only this part */
    VkDescriptorSetLayout set_layout;
    VkPipelineLayout layout;
    VkPipeline handle;
    uint32_t n_buffers, push_bytes;
    enum kd_vk_kind kinds[KD_VK_MAX_BINDINGS];
    char name[64];
};

#endif
