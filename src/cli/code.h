/* A terminal shows the address of the server as a QR code, for a telephone on the same network. */
#ifndef KD_CLI_CODE_H
#define KD_CLI_CODE_H

#include "base/error.h"

#include <stdio.h>

/* Writes the code of a text (byte mode, error correction M) as half blocks, two rows of modules a line, black on
 * white by ANSI colours. KD_ENOMEM if there is no memory for it. */
enum kd_status kd_cli_code(FILE *to, const char *text);

/* Of names under which this machine is reached (NULL-terminated, or NULL) the one that another machine on the
 * network most likely reaches: an address of a private network, then any other address, then a name. NULL if there
 * is none but loopback. */
const char *kd_cli_code_of(const char *const *names);

#endif
