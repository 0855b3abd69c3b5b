/* Generates unguessable identifiers. Any thread. */
#ifndef KD_SERVER_HTTP_SECRET_H
#define KD_SERVER_HTTP_SECRET_H

#include <stdbool.h>
#include <stddef.h>

#define KD_SECRET_ID 17 /* 16 hexadecimal digits and NUL; anybody who has an id may watch the object */
/* 32 hexadecimal digits and NUL; anybody who has a token may change and delete the object */
#define KD_SECRET_TOKEN 33

/* Writes size - 1 hexadecimal digits and NUL; size - 1 is even and at most KD_SECRET_TOKEN - 1. Returns false if no
 * random numbers are available. */
bool kd_secret_make(char *out, size_t size);
/* Compares in constant time. given may be NULL. */
bool kd_secret_equal(const char token[KD_SECRET_TOKEN], const char *given);

#endif
