/* Functions that the subcommands of kerrd share; commands.h lists the subcommands. Main thread only. A subcommand
 * gets its own arguments; argv[0] is "kerrd NAME". It returns an exit code. On a usage error, argp ends the program
 * with KD_EXIT_USAGE. */
#ifndef KD_CLI_CLI_H
#define KD_CLI_CLI_H

#include "base/error.h"
#include "cli/commands.h"

#include <argp.h>
#include <stdbool.h>
#include <stdint.h>

enum { KD_EXIT_OK = 0, KD_EXIT_FAILURE = 1, KD_EXIT_USAGE = 2, KD_EXIT_DEVICE = 3 };

/* Children for argp with the options --log-level and --device. The first has no input. The input of the second is a
 * `const char *`, which the parser initialises to $KERRD_DEVICE or "auto". */
extern const struct argp kd_cli_log_argp, kd_cli_device_argp;
/* an array of both argp structs above, for use as children; the one for --device comes first */
extern const struct argp_child kd_cli_device_children[];
#define KD_CLI_LOG_LEVELS "error|warn|info|debug"
#define KD_CLI_LOG_LEVEL_DOC "lowest level of messages on standard error (default: warn)"
#define KD_CLI_DEVICE_DOC "auto, an index of `kerrd doctor`, or part of a name (default: $KERRD_DEVICE, otherwise auto)"
/* Sets the log level by name. Returns false if there is no such level. */
bool kd_cli_set_log_level(const char *word);

/* Reports an error on stderr, as "kerrd: MESSAGE (at /pointer)" or as a line of the JSON log. Returns the exit code
 * that belongs to the status. */
int kd_cli_fail(const struct kd_error *error);

/* Inserts "name: " before the message, to say which of several inputs is meant. Returns the error's status. */
enum kd_status kd_cli_prefix(struct kd_error *error, const char *name);

/* Reports a device that was lost or hangs, and exits with KD_EXIT_DEVICE. No destructors run, because a device that
 * hangs cannot be closed. */
_Noreturn void kd_cli_device_lost(const struct kd_error *error);

/* Writes to stdout and flushes it, together with earlier output. Returns an exit code. */
int kd_cli_print(const void *data, size_t size);

/* Reports why a write to stdout has failed, once only. number: errno of the write. If the reader has closed the
 * pipe, as in `kerrd plan | head`, the function ends kerrd by SIGPIPE without a message, as is usual for
 * command-line tools. */
void kd_cli_stdout_failed(int number);

/* For atexit: flushes stdout. If help or a list could not be written, the exit code is 1. */
void kd_cli_close_stdout(void);

/* Two parsers for the text of an option. If the text is not valid, they return false and leave *out unchanged.
 * KD_CLI_BYTES_ALLOWED describes the accepted sizes in messages. */
bool kd_cli_read_number(const char *text, unsigned minimum, unsigned maximum, unsigned *out);
bool kd_cli_read_bytes(const char *text, uint64_t *out);
#define KD_CLI_BYTES_ALLOWED "a size from 64M to 1024T, as in 1536M or 2G"

/* Parses a size of at least 64M, such as 1536M or 2G (powers of 1024). Anything else is a usage error. */
uint64_t kd_cli_bytes(const struct argp_state *state, const char *option, const char *text);
#define KD_CLI_MEMORY_DOC \
    "limit of the memory for pictures, as in 1536M or 2G (default: the free memory of the device and the machine)"
#define KD_CLI_MEMORY { "memory", 'M', "SIZE", 0, KD_CLI_MEMORY_DOC, 0 }

/* Appends an axis, FIELD=VALUES, to a list. The caller frees the list. */
void kd_cli_add_axis(const char ***axes, size_t *n, const char *text, const struct argp_state *state);

/* Parses a whole number. Anything else is a usage error. */
unsigned kd_cli_number(const struct argp_state *state, const char *option, const char *text, unsigned minimum,
                       unsigned maximum);

#endif
