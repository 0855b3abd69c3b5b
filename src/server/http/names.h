/* Host names under which a server that listens on every address is reached. */
#ifndef KD_SERVER_HTTP_NAMES_H
#define KD_SERVER_HTTP_NAMES_H

#include <stdbool.h>

/* Whether a numeric address stands for every one of its family: 0.0.0.0, ::, [::]. */
bool kd_names_any(const char *listen);

/* The machine's own addresses of that family, as a URL has them ("192.168.1.7", "[2001:db8::7]"), and its host name
 * where that leads to one of them. NULL-terminated, one malloc'd block each; NULL when out of memory. It may ask the
 * resolver. */
char **kd_names_own(const char *listen);
void kd_names_free(char **names); /* accepts NULL */

#endif
