/* A program of the system works on a file: it reads from us and writes to a descriptor of ours. One thread at a time.
 *
 *     kd_program_start(argv, fd, &p, &error)       argv says "/dev/fd/3" where the program is to write
 *     while (more) kd_program_write(&p, ...)       never waits: it takes what fits
 *     kd_program_hang_up(&p)                       there is no more to read
 *     while (!kd_program_over(&p, &code)) ...      ask again a little later
 *     kd_program_end(&p)                           ends it where it is not over */
#ifndef KD_BASE_PROGRAM_H
#define KD_BASE_PROGRAM_H

#include "base/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <sys/types.h>

struct kd_program {
    pid_t pid;    /* 0: it was not started, or is over */
    int in, told; /* ends of pipes: its standard input, and its standard error; -1: closed */
    size_t n_said, n_last;
    char said[1000];                    /* the first that it said on its standard error, ends with 0 */
    char last[1000];                    /* the last that it said there, likewise */
    double idle_ms, looked_ms, used_ms; /* of kd_program_idle_ms */
};
#define KD_PROGRAM_NONE { .in = -1, .told = -1 }

/* Whether there is a program of this name on the PATH that we may run. */
bool kd_program_known(const char *name);
/* argv[0] is looked for on the PATH. out: becomes descriptor 3; it stays ours; a file of
 * more than `most` bytes ends the program. The program is nice to others, has none of our other descriptors, and
 * what it prints goes nowhere. KD_EABSENT: there is no such program here. KD_EIO. */
enum kd_status kd_program_start(const char *const argv[], int out, uint64_t most, struct kd_program *program,
                                struct kd_error *error);
/* How many of these bytes it has taken; 0: none now, or none any more, as kd_program_over will say. */
size_t kd_program_write(struct kd_program *program, const void *data, size_t size);
void kd_program_hang_up(struct kd_program *program);
/* Whether it has ended, and what with: its exit code, or -1 where a signal ended it. Reads what it says, too.
 * Programs that it has started end with it. */
bool kd_program_over(struct kd_program *program, int *code);
/* How long it has done nothing, now being now_ms: it has used no time of a processor, and the caller has seen none
 * of its work (moved). It is asked again and again; time between two questions counts for a second at most, as a
 * machine may have been held. */
double kd_program_idle_ms(struct kd_program *program, bool moved, double now_ms);
/* The first line that it said, fit to be shown: without control characters, and without paths and addresses of this
 * machine. "": it said nothing. */
void kd_program_reason(const struct kd_program *program, char out[300]);
void kd_program_end(struct kd_program *program); /* one that was never started too */

#endif
