#include "document/asset_name.h"

#include <string.h>

#define DIGITS "0123456789"
#define LETTERS "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"

bool kd_asset_is_hash(const char *text)
{
    return strlen(text) == KD_ASSET_NAME - 1 && strspn(text, DIGITS "abcdef") == KD_ASSET_NAME - 1;
}

bool kd_asset_is_name(const char *text)
{
    size_t length = strlen(text);
    return length && length < KD_ASSET_NAME - 1 && strcmp(text, "null") && strchr(LETTERS, *text) &&
           strspn(text, LETTERS DIGITS "._-") == length;
}
