/* The subcommands of kerrd, which are listed in commands.h, share this. Main thread only.
 *
 * A subcommand gets its own arguments, argv[0] being "kerrd NAME", and returns an exit code. Usage errors
 * leave through argp with KD_EXIT_USAGE. */
#ifndef KD_CLI_CLI_H
#define KD_CLI_CLI_H

#include "base/error.h"
#include "cli/commands.h"

#include <argp.h>
#include <stdbool.h>
#include <stdint.h>

enum { KD_EXIT_OK = 0, KD_EXIT_FAILURE = 1, KD_EXIT_USAGE = 2, KD_EXIT_DEVICE = 3 };

/* Children for argp: --log-level (no input), and --device with a `const char *` as its input, which
 * starts as $KERRD_DEVICE or "auto". */
extern const struct argp kd_cli_log_argp, kd_cli_device_argp;
extern const struct argp_child kd_cli_device_children[]; /* both, the device first */
#define KD_CLI_LOG_LEVELS "error|warn|info|debug"
#define KD_CLI_LOG_LEVEL_DOC "what is told on standard error (default: warn)"
#define KD_CLI_DEVICE_DOC "auto, an index of `kerrd doctor`, or part of a name (default: $KERRD_DEVICE, else auto)"
/* Sets the level by its word; false: there is no such level. */
bool kd_cli_set_log_level(const char *word);

/* "kerrd: MESSAGE (at /pointer)" on stderr, or the same as a line of a log of JSON; returns the exit code for the
 * status. */
int kd_cli_fail(const struct kd_error *error);

/* Put "name: " before the message, to say which of several inputs is meant. Returns the error's status. */
enum kd_status kd_cli_prefix(struct kd_error *error, const char *name);

/* A device that hangs cannot be torn down, and one that is lost need not be: report and leave at once, without
 * destructors, with KD_EXIT_DEVICE. */
_Noreturn void kd_cli_device_lost(const struct kd_error *error);

/* Write to stdout and make sure that it arrived, with what was printed before. */
int kd_cli_print(const void *data, size_t size);

/* Reports, by its errno, that stdout could not be written. A reader that left, as in `kerrd plan | head`, ends the
 * program by SIGPIPE without a word, as it does other tools; all else is said, once. */
void kd_cli_stdout_failed(int number);

/* Called at exit, whatever was printed: help and lists too must have arrived, or the exit code is 1. */
void kd_cli_close_stdout(void);

/* The same without the error: false, and *out as it was. What is allowed, in words, says KD_CLI_BYTES_ALLOWED. */
bool kd_cli_read_number(const char *text, unsigned minimum, unsigned maximum, unsigned *out);
bool kd_cli_read_bytes(const char *text, uint64_t *out);
#define KD_CLI_BYTES_ALLOWED "a size from 64M to 1024T, as 1536M or 2G"

/* A size from an option's text, as 1536M or 2G (powers of 1024), at least 64M; or a usage error. */
uint64_t kd_cli_bytes(const struct argp_state *state, const char *option, const char *text);
#define KD_CLI_MEMORY_DOC \
    "most memory for pictures, as 1536M or 2G (default: what the device and this machine have left)"
#define KD_CLI_MEMORY { "memory", 'M', "SIZE", 0, KD_CLI_MEMORY_DOC, 0 }

/* One more axis, FIELD=VALUES, to a list that the caller frees. */
void kd_cli_add_axis(const char ***axes, size_t *n, const char *text, const struct argp_state *state);

/* A whole number from an option's text, or a usage error. */
unsigned kd_cli_number(const struct argp_state *state, const char *option, const char *text, unsigned minimum,
                       unsigned maximum);

#endif
