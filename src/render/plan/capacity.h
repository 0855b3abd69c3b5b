/* The limits of a device, and its measured speed. A plan is made for a capacity. Plain data; any thread. */
#ifndef KD_RENDER_PLAN_CAPACITY_H
#define KD_RENDER_PLAN_CAPACITY_H

#include "render/accuracy/engine.h"
#include "render/plan/pass.h"

#include <stdbool.h>
#include <stdint.h>

#define KD_COST_CLASSES 16

struct kd_capacity {
    uint64_t max_binding_bytes, memory_bytes; /* max_binding_bytes: limit of one storage-buffer binding; memory_bytes:
                                                 limit of all device memory together */
    /* who or what sets the limit memory_bytes, such as "--memory"; NULL: the device */
    const char *memory_by;
    bool host_memory;              /* true if device memory is host memory, so that pixels on the host count as well */
    uint64_t host_bytes;           /* if device memory is not host memory: memory for pixels on the host; 0: unknown */
    uint64_t max_allocation_bytes; /* limit of one buffer; 0 stands for 2^30, the least that Vulkan 1.2 guarantees */
    /* limits of the workgroups of one dispatch; 0 stands for 65535, the least that Vulkan guarantees */
    uint32_t max_groups_x, max_groups_y;
    double ns[KD_FIGURE_COUNT]; /* cost of an item for each KD_NS_... of pass.h */
    struct kd_class_cost {
        /* class: key of a cost class (cost_class.h); 0: the entry is unused. learned: number of measurements when
         * this class was last updated */
        uint64_t class, learned;
        double ns[KD_PASS_COUNT];
    } classes[KD_COST_CLASSES]; /* cost of an item in pictures of a class */
    uint64_t learned;           /* number of measurements of classes so far */
    /* true if the figures were measured; false: they are defaults for this type of device */
    bool measured;
    bool float64;   /* true if the device has double precision */
    unsigned cores; /* number of cores of the host, on which the closed form in double runs */
    /* the device's table, or the built-in one; valid as long as the renderer */
    const struct kd_accuracy_table *accuracy;
    bool accuracy_measured; /* false: built in */
};

#endif
