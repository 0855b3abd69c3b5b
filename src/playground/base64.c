#include "playground/base64.h"

#include <nettle/base64.h>
#include <string.h>

void kd_base64_write(char *to, const void *data, size_t n)
{
    base64_encode_raw(to, n, data);
    to[kd_base64_length(n)] = 0;
}

bool kd_base64_read(void *to, size_t n, const char *text)
{
    const size_t length = strlen(text);
    struct base64_decode_ctx decoder;
    size_t read = n;
    /* Refuses text of another length, and text without the = characters that n bytes need: the decoder would write more
     * bytes than `to` has room for. */
    if (length != kd_base64_length(n) || (n % 3 && text[length - 1] != '=') || (n % 3 == 1 && text[length - 2] != '='))
        return false;
    base64_decode_init(&decoder);
    return base64_decode_update(&decoder, &read, to, length, text) && base64_decode_final(&decoder) && read == n;
}
