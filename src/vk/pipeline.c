#include "vk/pipeline.h"

#include "base/clock.h"
#include "base/log.h"
#include "vk/device.h"
#include "vk/kind.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define SPIRV_MAGIC 0x07230203u
#define MAX_SPEC 32

static enum kd_status check(const struct kd_vk *vk, const struct kd_vk_pipeline_params *params, struct kd_error *error)
{
    const char *name = params->name ? params->name : "unnamed";
    uint32_t max_push = vk->core.physical.info.max_push_bytes;
    if (!params->spirv || params->spirv_bytes < 20 || params->spirv_bytes % 4 || params->spirv[0] != SPIRV_MAGIC)
        return kd_error_set(error, KD_EINTERNAL, "pipeline '%s': this is not SPIR-V", name);
    if (params->n_buffers > KD_VK_MAX_BINDINGS)
        return kd_error_set(error, KD_EINTERNAL, "pipeline '%s': %u buffers; there must be at most %u", name,
                            params->n_buffers, KD_VK_MAX_BINDINGS);
    for (uint32_t i = 0; i < params->n_buffers; i++)
        if (!kd_vk_kind_info(params->kinds[i]))
            return kd_error_set(error, KD_EINTERNAL, "pipeline '%s': binding %u has the unknown kind %u", name, i,
                                (uint32_t)params->kinds[i]);
    if (params->push_bytes > max_push || params->push_bytes % 4)
        return kd_error_set(error, KD_EINTERNAL,
                            "pipeline '%s': %u bytes of push constants; there must be at most %u, in multiples of 4",
                            name, params->push_bytes, max_push);
    if (params->n_spec > MAX_SPEC)
        return kd_error_set(error, KD_EINTERNAL,
                            "pipeline '%s': %zu specialisation constants; there must be at most %u", name,
                            params->n_spec, MAX_SPEC);
    return KD_OK;
}

static enum kd_status make_layout(struct kd_vk *vk, struct kd_vk_pipeline *pipeline, struct kd_error *error)
{
    enum kd_status status;
    VkDescriptorSetLayoutBinding bindings[KD_VK_MAX_BINDINGS];
    for (uint32_t i = 0; i < pipeline->n_buffers; i++)
        bindings[i] =
            (VkDescriptorSetLayoutBinding) { .binding = i,
                                             .descriptorType = kd_vk_kind_info(pipeline->kinds[i])->descriptor,
                                             .descriptorCount = 1,
                                             .stageFlags = VK_SHADER_STAGE_COMPUTE_BIT };
    const VkDescriptorSetLayoutCreateInfo set = { .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
                                                  .bindingCount = pipeline->n_buffers,
                                                  .pBindings = bindings };
    KD_VK_TRY(&vk->core.fn, CreateDescriptorSetLayout, vk->core.device, &set, NULL, &pipeline->set_layout);
    kd_vk_name(&vk->core, VK_OBJECT_TYPE_DESCRIPTOR_SET_LAYOUT, KD_VK_HANDLE(pipeline->set_layout), "%s",
               pipeline->name);
    const VkPushConstantRange push = { VK_SHADER_STAGE_COMPUTE_BIT, 0, pipeline->push_bytes };
    const VkPipelineLayoutCreateInfo layout = { .sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                                                .setLayoutCount = 1,
                                                .pSetLayouts = &pipeline->set_layout,
                                                .pushConstantRangeCount = pipeline->push_bytes > 0,
                                                .pPushConstantRanges = &push };
    KD_VK_TRY(&vk->core.fn, CreatePipelineLayout, vk->core.device, &layout, NULL, &pipeline->layout);
    kd_vk_name(&vk->core, VK_OBJECT_TYPE_PIPELINE_LAYOUT, KD_VK_HANDLE(pipeline->layout), "%s", pipeline->name);
done:
    return status;
}

static enum kd_status make_pipeline(struct kd_vk *vk, struct kd_vk_pipeline *pipeline, VkShaderModule module,
                                    const struct kd_vk_pipeline_params *params, struct kd_error *error)
{
    enum kd_status status;
    VkSpecializationMapEntry entries[MAX_SPEC];
    uint32_t values[MAX_SPEC];
    for (uint32_t i = 0; i < params->n_spec; i++) {
        entries[i] = (VkSpecializationMapEntry) { params->spec[i].id, i * 4, 4 };
        values[i] = params->spec[i].value;
    }
    const VkSpecializationInfo spec = { (uint32_t)params->n_spec, entries, params->n_spec * 4, values };
    const VkComputePipelineCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO,
        .stage = { .sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                   .stage = VK_SHADER_STAGE_COMPUTE_BIT,
                   .module = module,
                   .pName = "main",
                   .pSpecializationInfo = params->n_spec ? &spec : NULL },
        .layout = pipeline->layout,
    };
    KD_VK_TRY(&vk->core.fn, CreateComputePipelines, vk->core.device, vk->cache.handle, 1, &info, NULL,
              &pipeline->handle);
    kd_vk_name(&vk->core, VK_OBJECT_TYPE_PIPELINE, KD_VK_HANDLE(pipeline->handle), "%s", pipeline->name);
    vk->cache.grown = true;
done:
    return status;
}

static enum kd_status pipeline_init(struct kd_vk *vk, struct kd_vk_pipeline *pipeline,
                                    const struct kd_vk_pipeline_params *params, struct kd_error *error)
{
    VkShaderModule module = VK_NULL_HANDLE;
    const VkShaderModuleCreateInfo info = { .sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO,
                                            .codeSize = params->spirv_bytes,
                                            .pCode = params->spirv };
    enum kd_status status;
    KD_TRY(make_layout(vk, pipeline, error));
    KD_VK_TRY(&vk->core.fn, CreateShaderModule, vk->core.device, &info, NULL, &module);
    kd_vk_name(&vk->core, VK_OBJECT_TYPE_SHADER_MODULE, KD_VK_HANDLE(module), "%s", pipeline->name);
    KD_TRY(make_pipeline(vk, pipeline, module, params, error));
done:
    if (module)
        vk->core.fn.DestroyShaderModule(vk->core.device, module, NULL);
    return status;
}

static void pipeline_free(struct kd_vk *vk, struct kd_vk_retired *object)
{
    struct kd_vk_pipeline *pipeline = (struct kd_vk_pipeline *)object;
    vk->core.fn.DestroyPipeline(vk->core.device, pipeline->handle, NULL);
    vk->core.fn.DestroyPipelineLayout(vk->core.device, pipeline->layout, NULL);
    vk->core.fn.DestroyDescriptorSetLayout(vk->core.device, pipeline->set_layout, NULL);
    vk->n_pipelines--;
    free(pipeline);
}

enum kd_status kd_vk_pipeline_create(struct kd_vk *vk, const struct kd_vk_pipeline_params *params,
                                     struct kd_vk_pipeline **out, struct kd_error *error)
{
    *out = NULL;
    enum kd_status status = kd_vk_alive(&vk->core, error);
    if (!status)
        status = check(vk, params, error);
    if (status)
        return status;
    struct kd_vk_pipeline *pipeline = calloc(1, sizeof *pipeline);
    if (!pipeline)
        return kd_error_set(error, KD_ENOMEM, "no memory for a pipeline");
    pipeline->retired.free = pipeline_free;
    pipeline->n_buffers = params->n_buffers;
    pipeline->push_bytes = params->push_bytes;
    memcpy(pipeline->kinds, params->kinds, sizeof pipeline->kinds);
    snprintf(pipeline->name, sizeof pipeline->name, "%s", params->name ? params->name : "unnamed");
    vk->n_pipelines++;
    struct kd_error why = { 0 };
    const double start = kd_clock_ms();
    status = pipeline_init(vk, pipeline, params, &why);
    if (status) {
        pipeline_free(vk, &pipeline->retired);
        return kd_error_set(error, status, "pipeline '%s': %.400s", params->name ? params->name : "unnamed",
                            why.message);
    }
    *out = pipeline;
    kd_log(KD_LOG_DEBUG, "pipeline '%s': made in %.1f ms", pipeline->name, kd_clock_ms() - start);
    return KD_OK;
}

void kd_vk_pipeline_destroy(struct kd_vk *vk, struct kd_vk_pipeline *pipeline)
{
    if (pipeline)
        kd_vk_retire(vk, &pipeline->retired);
}
