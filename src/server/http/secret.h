/* Generates identifiers that nobody can guess. Any thread. */
#ifndef KD_SERVER_HTTP_SECRET_H
#define KD_SERVER_HTTP_SECRET_H

#include <stdbool.h>
#include <stddef.h>

/* size of an id: 16 hexadecimal digits and a NUL; anybody who knows the id may watch the object */
#define KD_SECRET_ID 17
/* size of a token: 32 hexadecimal digits and a NUL; anybody who knows the token may change and delete the object */
#define KD_SECRET_TOKEN 33

/* Writes size - 1 hexadecimal digits and a NUL. size - 1 must be even and at most KD_SECRET_TOKEN - 1. Returns false
 * if there are no random numbers. */
bool kd_secret_make(char *out, size_t size);
/* Compares in constant time. given may be NULL. */
bool kd_secret_equal(const char token[KD_SECRET_TOKEN], const char *given);

#endif
