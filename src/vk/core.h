/* The data that all objects of an open device share: the device's functions, handles and properties, and whether the
 * device is lost. */
#ifndef KD_VK_CORE_H
#define KD_VK_CORE_H

#include "vk/functions.h"
#include "vk/physical.h"

#include <stdbool.h>
#include <stdint.h>

struct kd_vk_core {
    struct kd_vk_functions fn; /* the complete table; kd_vk_instance.fn lacks the functions of the device */
    struct kd_vk_physical physical;
    bool compiles_only, pipelines_only; /* see kd_vk_params */
    VkDevice device;
    VkQueue queue;
    char lost[256]; /* the reason why the device is lost; "" if it is not lost */
    bool hangs;     /* true if the device is lost because a deadline has passed: work under way may never end */
};

/* Returns KD_EDEVICE with the reason if the device is lost. */
enum kd_status kd_vk_alive(const struct kd_vk_core *core, struct kd_error *error);
/* Marks the device as lost for good. Returns KD_EDEVICE. */
enum kd_status kd_vk_lose(struct kd_vk_core *core, struct kd_error *error, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Names an object for messages and captures. Has no effect without validation. */
void kd_vk_name(const struct kd_vk_core *core, VkObjectType type, uint64_t handle, const char *format, ...)
    __attribute__((format(printf, 4, 5)));
#define KD_VK_HANDLE(handle) ((uint64_t)(handle))

#endif
