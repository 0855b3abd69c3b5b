#include "server/http/secret.h"

#include <string.h>
#include <sys/random.h>

bool kd_secret_make(char *out, size_t size)
{
    static const char digits[] = "0123456789abcdef";
    unsigned char bytes[KD_SECRET_TOKEN / 2];
    size_t n = (size - 1) / 2;
    if (getrandom(bytes, n, 0) != (ssize_t)n)
        return false;
    for (size_t i = 0; i < n; i++) {
        out[2 * i] = digits[bytes[i] >> 4];
        out[2 * i + 1] = digits[bytes[i] & 15];
    }
    out[2 * n] = 0;
    return true;
}

bool kd_secret_equal(const char token[KD_SECRET_TOKEN], const char *given)
{
    unsigned differ = 0;
    if (!given || strlen(given) != KD_SECRET_TOKEN - 1)
        return false;
    for (size_t i = 0; i < KD_SECRET_TOKEN - 1; i++)
        differ |= (unsigned)(token[i] ^ given[i]);
    return !differ;
}
