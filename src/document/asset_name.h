/* Names of assets: bytes that a document refers to. Pure, any thread. */
#ifndef KD_DOCUMENT_ASSET_NAME_H
#define KD_DOCUMENT_ASSET_NAME_H

#include <stdbool.h>

/* Room for the SHA-256 of an asset in hexadecimal digits, or for the name of an asset; both with a NUL. */
#define KD_ASSET_NAME 65

bool kd_asset_is_hash(const char *text);
/* True if the text may be a name: a letter, then letters, digits, '.', '_' and '-', fewer than 64 characters. */
bool kd_asset_is_name(const char *text);

#endif
