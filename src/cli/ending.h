/* Finds the format of a file from its extension. Main thread only. */
#ifndef KD_CLI_ENDING_H
#define KD_CLI_ENDING_H

#include <argp.h>

/* List of formats, ended by NULL. */
#define KD_ENDINGS(...) ((const char *const[]) { __VA_ARGS__, NULL })

/* Returns the format in `known` that belongs to a file's extension. Case is ignored, and .fit means .fits. Returns
 * "" for NULL, "-", names without an extension, and names like a.tmp or v1.5. Any other extension is a usage error,
 * because otherwise users would notice only later that the file's format does not match its name. option: name of
 * the option for messages, such as "--output". */
const char *kd_cli_ending(const struct argp_state *state, const char *option, const char *path,
                          const char *const known[]);

/* Like kd_cli_ending, but a name without an extension is a usage error as well. */
const char *kd_cli_ending_required(const struct argp_state *state, const char *option, const char *path,
                                   const char *const known[]);

#endif
