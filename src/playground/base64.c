#include "playground/base64.h"

#include <stdint.h>
#include <string.h>

static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

void kd_base64_write(char *to, const void *data, size_t n)
{
    const uint8_t *from = data;
    for (size_t i = 0; i < n; i += 3) {
        const uint32_t three = (uint32_t)from[i] << 16 | (i + 1 < n ? from[i + 1] : 0u) << 8 | (i + 2 < n ? from[i + 2] : 0u);
        *to++ = digits[three >> 18];
        *to++ = digits[three >> 12 & 63];
        *to++ = i + 1 < n ? digits[three >> 6 & 63] : '=';
        *to++ = i + 2 < n ? digits[three & 63] : '=';
    }
    *to = 0;
}

bool kd_base64_read(void *to, size_t n, const char *text)
{
    uint8_t *bytes = to, value[256];
    if (strlen(text) != kd_base64_length(n))
        return false;
    memset(value, 64, sizeof value);
    for (int i = 0; i < 64; i++)
        value[(uint8_t)digits[i]] = (uint8_t)i;
    for (size_t i = 0; i < n; i += 3, text += 4) {
        uint32_t three = 0;
        const size_t given = n - i < 3 ? n - i + 1 : 4; /* digits; the rest is = */
        for (size_t k = 0; k < 4; k++) {
            const uint8_t digit = value[(uint8_t)text[k]];
            if (k < given ? digit > 63 : text[k] != '=')
                return false;
            three = three << 6 | (k < given ? digit : 0);
        }
        for (size_t k = 0; k + 1 < given; k++)
            bytes[i + k] = (uint8_t)(three >> (16 - 8 * k));
    }
    return true;
}
