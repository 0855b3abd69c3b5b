#include "base/percent.h"

#include <stdbool.h>
#include <string.h>

#define UNRESERVED "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-._~"

enum kd_status kd_percent_append(const void *bytes, size_t size, const char *also, struct kd_buffer *out)
{
    const unsigned char *text = bytes;
    enum kd_status status = KD_OK;
    for (size_t i = 0; i < size && !status; i++) {
        const bool plain = text[i] && (strchr(UNRESERVED, text[i]) || strchr(also, text[i]));
        status = plain ? kd_buffer_append(out, &text[i], 1) : kd_buffer_printf(out, "%%%02X", text[i]);
    }
    return status ? status : kd_buffer_printf(out, "%s", "");
}
