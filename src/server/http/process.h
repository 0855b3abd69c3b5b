/* Metrics of the process, with the names that Prometheus's client libraries use, such as
 * process_resident_memory_bytes. Reads /proc. Any thread. */
#ifndef KD_SERVER_HTTP_PROCESS_H
#define KD_SERVER_HTTP_PROCESS_H

#include "base/buffer.h"

/* Writes the metrics. Values that /proc does not provide are left out. */
enum kd_status kd_process_write(struct kd_buffer *out);

#endif
