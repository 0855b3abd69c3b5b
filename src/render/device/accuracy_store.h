/* Stores the accuracy table of a device on disk, beside the device's pipeline cache. Each version of the driver has a
 * file of its own. */
#ifndef KD_RENDER_DEVICE_ACCURACY_STORE_H
#define KD_RENDER_DEVICE_ACCURACY_STORE_H

#include "render/accuracy/table.h"
#include "render/device/renderer.h"

/* Path of the file: malloc'd, NULL if there is no cache directory. Any thread. */
char *kd_accuracy_path(const struct kd_renderer *renderer);

/* Replaces the stored table atomically. */
enum kd_status kd_accuracy_save(const struct kd_accuracy_table *table, const char *path, struct kd_error *error);

/* Returns KD_EIO if the file is missing or cannot be read. Returns KD_EINVAL if the file is damaged or has another
 * format. The message says how to make a table. path may be NULL. Any thread. */
enum kd_status kd_accuracy_load(const char *path, struct kd_accuracy_table *out, struct kd_error *error);

/* Appends the document of GET /v1/accuracy. Errors are those of kd_accuracy_load. Any thread. */
enum kd_status kd_renderer_accuracy_json(const struct kd_renderer *renderer, struct kd_buffer *out,
                                         struct kd_error *error);

#endif
