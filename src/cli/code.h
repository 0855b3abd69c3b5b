/* QR code of the server's address in the terminal, for a telephone on the same network. */
#ifndef KD_CLI_CODE_H
#define KD_CLI_CODE_H

#include "base/error.h"

#include <stdio.h>

/* Writes the QR code of a text (byte mode, error correction M), black on white with ANSI colours. Each line of
 * output has half-block characters for two rows of modules. Returns KD_ENOMEM when out of memory. */
enum kd_status kd_cli_code(FILE *to, const char *text);

/* Chooses, of the names of this machine, the one that other machines can most probably reach. The order of
 * preference is: an address of a private network, any other address, a name. names: NULL-terminated, or NULL.
 * Returns NULL if all are loopback names. */
const char *kd_cli_code_of(const char *const *names);

#endif
