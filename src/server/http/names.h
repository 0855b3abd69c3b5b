/* Host names by which clients can reach a server that listens on all addresses. */
#ifndef KD_SERVER_HTTP_NAMES_H
#define KD_SERVER_HTTP_NAMES_H

#include <stdbool.h>

/* True if listen is a wildcard address: 0.0.0.0, :: or [::]. */
bool kd_names_any(const char *listen);

/* Returns the machine's own addresses of the same family as `listen`, in the form for URLs ("192.168.1.7",
 * "[2001:db8::7]"). The host name is included if it resolves to one of them. The list ends with NULL; list and names
 * are malloc'd. Returns NULL when out of memory. May query the resolver. */
char **kd_names_own(const char *listen);
void kd_names_free(char **names); /* accepts NULL */

#endif
