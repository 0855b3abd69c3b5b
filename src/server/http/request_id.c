#include "server/http/request_id.h"

#include "server/http/secret.h"

#include <stdio.h>
#include <string.h>

#define CHARACTERS "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-._+/="

_Static_assert(KD_SECRET_TOKEN <= KD_REQUEST_ID_MAX + 1, "room for one that is made");

bool kd_request_id_is_sane(const char *given)
{
    const size_t n = given ? strlen(given) : 0;
    return n && n <= KD_REQUEST_ID_MAX && !given[strspn(given, CHARACTERS)];
}

void kd_request_id_choose(const char *given, char out[KD_REQUEST_ID_MAX + 1])
{
    if (kd_request_id_is_sane(given))
        snprintf(out, KD_REQUEST_ID_MAX + 1, "%s", given);
    else if (!kd_secret_make(out, KD_SECRET_TOKEN))
        *out = 0;
}
