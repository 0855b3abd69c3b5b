/* Functions shared by the subcommands of kerrd, which commands.h lists. Main thread only.
 *
 * A subcommand gets its own arguments, argv[0] being "kerrd NAME", and returns an exit code. Usage errors leave through
 * argp with KD_EXIT_USAGE. */
#ifndef KD_CLI_CLI_H
#define KD_CLI_CLI_H

#include "base/error.h"
#include "cli/commands.h"

#include <argp.h>
#include <stdbool.h>
#include <stdint.h>

enum { KD_EXIT_OK = 0, KD_EXIT_FAILURE = 1, KD_EXIT_USAGE = 2, KD_EXIT_DEVICE = 3 };

/* argp children: --log-level, without input; and --device, whose input is a `const char *` that starts as $KERRD_DEVICE
 * or "auto". */
extern const struct argp kd_cli_log_argp, kd_cli_device_argp;
extern const struct argp_child kd_cli_device_children[]; /* both, the device first */
#define KD_CLI_LOG_LEVELS "error|warn|info|debug"
#define KD_CLI_LOG_LEVEL_DOC "what is written to standard error (default: warn)"
#define KD_CLI_DEVICE_DOC "auto, an index of `kerrd doctor`, or part of a name (default: $KERRD_DEVICE, else auto)"
/* Sets the log level by name. Returns false if there is no such level. */
bool kd_cli_set_log_level(const char *word);

/* Reports an error: "kerrd: MESSAGE (at /pointer)" on stderr, or a line of the JSON log. Returns the exit code of the
 * status. */
int kd_cli_fail(const struct kd_error *error);

/* Inserts "name: " before the message, to identify one of several inputs. Returns the error's status. */
enum kd_status kd_cli_prefix(struct kd_error *error, const char *name);

/* Reports a lost or hanging device and exits with KD_EXIT_DEVICE, without destructors: a device that hangs cannot be
 * closed. */
_Noreturn void kd_cli_device_lost(const struct kd_error *error);

/* Writes to stdout and flushes it, together with earlier output. Returns an exit code. */
int kd_cli_print(const void *data, size_t size);

/* Reports a failed write to stdout by its errno, once. If the reader has left, as in `kerrd plan | head`, it ends the
 * program by SIGPIPE without a message, like other tools. */
void kd_cli_stdout_failed(int number);

/* For atexit: flushes stdout, so that a failure to write help and lists also gives exit code 1. */
void kd_cli_close_stdout(void);

/* Parse an option's text. Return false and leave *out unchanged if it is invalid. KD_CLI_BYTES_ALLOWED describes sizes
 * for messages. */
bool kd_cli_read_number(const char *text, unsigned minimum, unsigned maximum, unsigned *out);
bool kd_cli_read_bytes(const char *text, uint64_t *out);
#define KD_CLI_BYTES_ALLOWED "a size from 64M to 1024T, as 1536M or 2G"

/* Parses a size such as 1536M or 2G (powers of 1024), at least 64M; else a usage error. */
uint64_t kd_cli_bytes(const struct argp_state *state, const char *option, const char *text);
#define KD_CLI_MEMORY_DOC \
    "most memory for pictures, as 1536M or 2G (default: what the device and this machine have left)"
#define KD_CLI_MEMORY { "memory", 'M', "SIZE", 0, KD_CLI_MEMORY_DOC, 0 }

/* Appends an axis, FIELD=VALUES, to a list that the caller frees. */
void kd_cli_add_axis(const char ***axes, size_t *n, const char *text, const struct argp_state *state);

/* Parses a whole number; else a usage error. */
unsigned kd_cli_number(const struct argp_state *state, const char *option, const char *text, unsigned minimum,
                       unsigned maximum);

#endif
