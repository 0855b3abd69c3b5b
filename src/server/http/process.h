/* What every program tells of itself to Prometheus, by the names that its client libraries use:
 * process_resident_memory_bytes and so on. Any thread; it reads /proc. */
#ifndef KD_SERVER_HTTP_PROCESS_H
#define KD_SERVER_HTTP_PROCESS_H

#include "base/buffer.h"

/* What /proc does not tell is left out. */
enum kd_status kd_process_write(struct kd_buffer *out);

#endif
