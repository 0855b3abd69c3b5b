/* Metrics of the render queue and of the device: its name, the memory in use, and whether it is lost. */
#include "render/device/rest.h"
#include "server/render/render_internal.h"

/* Appends NAME="VALUE". Backslashes and quotes are escaped; characters other than printable ASCII become "?". */
static enum kd_status add_label(struct kd_buffer *out, const char *name, const char *value)
{
    enum kd_status status;
    KD_TRY(kd_buffer_printf(out, "%s=\"", name));
    for (; *value; value++)
        KD_TRY(*value == '"' || *value == '\\'
                   ? kd_buffer_printf(out, "\\%c", *value)
                   : kd_buffer_printf(out, "%c", *value >= ' ' && *value <= '~' ? *value : '?'));
    KD_TRY(kd_buffer_append(out, "\"", 1));
done:
    return status;
}

static enum kd_status add_build(struct kd_buffer *out, const struct kd_renderer *renderer)
{
    enum kd_status status;
    KD_TRY(kd_buffer_printf(out, "# HELP kerrd_build_info 1; its labels are the version of kerrd, the device and the "
                                 "driver.\n# TYPE kerrd_build_info gauge\nkerrd_build_info{"));
    KD_TRY(add_label(out, "version", KD_VERSION));
    KD_TRY(kd_buffer_append(out, ",", 1));
    KD_TRY(add_label(out, "device", kd_renderer_device(renderer)));
    KD_TRY(kd_buffer_append(out, ",", 1));
    KD_TRY(add_label(out, "driver", kd_renderer_driver(renderer)));
    KD_TRY(kd_buffer_printf(out, "} 1\n"));
done:
    return status;
}

static enum kd_status add_kept(struct kd_buffer *out, const struct kd_renderer *renderer)
{
    uint64_t bytes[KD_N_CACHE_KINDS];
    enum kd_status status =
        kd_buffer_printf(out, "# HELP kerrd_kept_bytes Bytes in caches, by kind.\n# TYPE kerrd_kept_bytes gauge\n");
    kd_renderer_cached(renderer, bytes);
    for (size_t i = 0; kd_cached_documents_word(i) && !status; i++)
        status = kd_buffer_printf(out, "kerrd_kept_bytes{kind=\"%s\"} %llu\n", kd_cached_documents_word(i),
                                  (unsigned long long)bytes[i]);
    return status;
}

enum kd_status kd_render_queue_metrics(struct kd_render_queue *queue, struct kd_buffer *out)
{
    enum kd_status status;
    KD_TRY(add_build(out, queue->renderer));
    KD_TRY(kd_buffer_printf(out,
                            "# HELP kerrd_device_memory_bytes Device memory in buffers, after the latest picture.\n# "
                            "TYPE kerrd_device_memory_bytes gauge\nkerrd_device_memory_bytes %llu\n",
                            (unsigned long long)kd_renderer_held(queue->renderer)));
    KD_TRY(add_kept(out, queue->renderer));
    KD_TRY(kd_buffer_printf(out,
                            "# HELP kerrd_device_lost 1: the device is lost, and the server ends.\n# TYPE "
                            "kerrd_device_lost gauge\nkerrd_device_lost %d\n",
                            kd_render_queue_lost(queue, NULL)));
    KD_TRY(kd_render_measures_write(&queue->measures, out));
done:
    return status;
}
