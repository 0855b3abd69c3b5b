/* Names of assets. An asset is a block of bytes to which a document refers. Pure, any thread. */
#ifndef KD_DOCUMENT_ASSET_NAME_H
#define KD_DOCUMENT_ASSET_NAME_H

#include <stdbool.h>

/* Room for the name of an asset or for its SHA-256 in hexadecimal digits, with a NUL. */
#define KD_ASSET_NAME 65

bool kd_asset_is_hash(const char *text);
/* True if the text may be a name: it has fewer than 64 characters, begins with a letter, and contains only letters,
 * digits, '.', '_' and '-'. */
bool kd_asset_is_name(const char *text);

#endif
