/* The end of a file's name, and the format that it names. Main thread only. */
#ifndef KD_CLI_ENDING_H
#define KD_CLI_ENDING_H

#include <argp.h>

/* Names of formats, NULL behind the last. */
#define KD_ENDINGS(...) ((const char *const[]) { __VA_ARGS__, NULL })

/* Returns the format that a file's name ends as, one of `known`. Case does not matter, and .fit is as good as .fits.
 * Returns "" if the name says nothing: it is NULL, has no ending, is "-", or ends like a.tmp or v1.5. Any other ending
 * is a usage error: a file of one format under the name of another would be noticed too late. option: "--output". */
const char *kd_cli_ending(const struct argp_state *state, const char *option, const char *path,
                          const char *const known[]);

/* The same, but a name that says nothing is a usage error as well. */
const char *kd_cli_ending_required(const struct argp_state *state, const char *option, const char *path,
                                   const char *const known[]);

#endif
