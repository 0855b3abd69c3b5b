/* Generates unguessable identifiers. Any thread. */
#ifndef KD_SERVER_HTTP_SECRET_H
#define KD_SERVER_HTTP_SECRET_H

#include <stdbool.h>
#include <stddef.h>

#define KD_SECRET_ID 17    /* hexadecimal digits and NUL: who knows it may watch */
#define KD_SECRET_TOKEN 33 /* who knows it may change and end */

/* size - 1 hexadecimal digits and NUL; an even number of them, at most KD_SECRET_TOKEN - 1. False: there are no
 * random numbers. */
bool kd_secret_make(char *out, size_t size);
/* In constant time; given may be NULL. */
bool kd_secret_equal(const char token[KD_SECRET_TOKEN], const char *given);

#endif
