/* Runs an external program such as an encoder. kerrd writes to the program's standard input, and the program writes
 * to a descriptor of kerrd's. One thread at a time.
 *
 *     kd_program_start(argv, fd, &p, &error)      in argv, "/dev/fd/3" is the file that the program writes to
 *     while (more) kd_program_write(&p, ...) never blocks: writes as much as fits into the pipe
 *     kd_program_hang_up(&p)                      end of input
 *     while (!kd_program_over(&p, &code)) ...     poll
 *     kd_program_end(&p)                          kills the program if it still runs */
#ifndef KD_BASE_PROGRAM_H
#define KD_BASE_PROGRAM_H

#include "base/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <sys/types.h>

struct kd_program {
    pid_t pid;    /* process id; 0: the program was not started, or has ended */
    int in, told; /* in: pipe to the program's standard input; told: pipe from its standard error; -1: closed */
    size_t n_said, n_last;
    char said[1000];                    /* the first bytes of the program's standard error, NUL-terminated */
    char last[1000];                    /* the last bytes of the program's standard error, NUL-terminated */
    double idle_ms, looked_ms, used_ms; /* state of kd_program_idle_ms */
};
#define KD_PROGRAM_NONE { .in = -1, .told = -1 }

/* True if the PATH contains a program of this name that kerrd may execute. */
bool kd_program_known(const char *name);
/* Starts argv[0], which is searched for on the PATH. out becomes the program's descriptor 3; the caller still owns
 * out. If the program writes a file of more than `most` bytes, it is ended. The program runs at a lower priority and
 * inherits no other descriptors. Its standard output goes to /dev/null. KD_EABSENT: there is no such program.
 * KD_EIO. */
enum kd_status kd_program_start(const char *const argv[], int out, uint64_t most, struct kd_program *program,
                                struct kd_error *error);
/* Returns the number of bytes that were written to the pipe. 0: the pipe is full now, or the program has closed it;
 * kd_program_over distinguishes these cases. */
size_t kd_program_write(struct kd_program *program, const void *data, size_t size);
void kd_program_hang_up(struct kd_program *program);
/* True if the program has ended. *code: its exit code, or -1 if a signal ended it. This call also reads the
 * program's standard error. It kills children that the program has left behind. */
bool kd_program_over(struct kd_program *program, int *code);
/* Milliseconds for which the program has been idle at the time now_ms. A program is idle while it uses no processor
 * time and produces no output. moved: true if the caller has seen output since the last call. Call this function
 * regularly: the time between two calls counts as at most one second, because the machine may have been suspended. */
double kd_program_idle_ms(struct kd_program *program, bool moved, double now_ms);
/* Gets the first line of the program's standard error in a form that may be shown to clients: without control
 * characters, and without paths and addresses of this machine. Gets "" if the program has printed nothing. */
void kd_program_reason(const struct kd_program *program, char out[300]);
void kd_program_end(struct kd_program *program); /* also permitted for a program that was never started */

#endif
