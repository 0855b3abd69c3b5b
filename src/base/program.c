#include "base/program.h"

#include "base/utf8.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

/* capacity of the pipe in bytes; it should hold everything that is written between two polls */
#define PIPE_BYTES (1 << 20)
#define NICE 10 /* niceness of the program, because pictures that users wait for are more urgent */

extern char **environ;

static void shut(int *fd)
{
    if (*fd >= 0)
        close(*fd);
    *fd = -1;
}

/* Makes a pipe. Both ends are closed on exec, and kerrd's end is non-blocking. */
static bool make_pipe(int *ours, int *its, bool we_write)
{
    int ends[2];
    if (pipe2(ends, O_CLOEXEC))
        return false;
    *ours = ends[we_write];
    *its = ends[!we_write];
    return fcntl(*ours, F_SETFL, O_NONBLOCK) == 0;
}

/* Closes all descriptors from 4 on, because libraries may have opened some without closing them on exec. */
/* tests define KD_PROGRAM_LISTS */
#if defined(__GLIBC__) && (__GLIBC__ > 2 || __GLIBC_MINOR__ >= 34) && !defined(KD_PROGRAM_LISTS)
static int close_others(posix_spawn_file_actions_t *files)
{
    return posix_spawn_file_actions_addclosefrom_np(files, 4);
}
#else
static int close_others(posix_spawn_file_actions_t *files)
{
    DIR *all = opendir("/proc/self/fd");
    int code = all ? 0 : errno;
    for (struct dirent *one; !code && (one = readdir(all));) {
        const int fd = atoi(one->d_name); /* atoi gives 0 for "." and ".." */
        if (fd >= 4 && fd != dirfd(all) && !(fcntl(fd, F_GETFD) & FD_CLOEXEC))
            code = posix_spawn_file_actions_addclose(files, fd);
    }
    if (all)
        closedir(all);
    return code;
}
#endif

/* If kerrd was started without descriptors 0 to 2, the given descriptors may have numbers up to 3, and would be
 * overwritten here. kd_program_start therefore moves them first. */
static int spawn(const char *const argv[], int in, int told, int out, pid_t *pid)
{
    posix_spawn_file_actions_t files;
    posix_spawnattr_t how;
    sigset_t none, usual;
    int code = posix_spawn_file_actions_init(&files);
    if (code)
        return code;
    if ((code = posix_spawnattr_init(&how))) {
        posix_spawn_file_actions_destroy(&files);
        return code;
    }
    sigemptyset(&none);
    sigemptyset(&usual);
    sigaddset(&usual, SIGPIPE);
    sigaddset(&usual, SIGXFSZ);
    posix_spawnattr_setsigmask(&how, &none);
    posix_spawnattr_setsigdefault(&how, &usual);
    /* The program gets its own process group, so that Ctrl-C reaches only kerrd, which then ends the program. */
    posix_spawnattr_setflags(&how, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP);
    if (!(code = posix_spawn_file_actions_adddup2(&files, in, 0)) &&
        !(code = posix_spawn_file_actions_adddup2(&files, told, 2)) &&
        !(code = posix_spawn_file_actions_adddup2(&files, out, 3)) &&
        !(code = posix_spawn_file_actions_addopen(&files, 1, "/dev/null", O_WRONLY, 0)) &&
        !(code = close_others(&files)))
        code = posix_spawnp(pid, argv[0], &files, &how, (char *const *)argv, environ);
    posix_spawnattr_destroy(&how);
    posix_spawn_file_actions_destroy(&files);
    return code;
}

/* Moves a descriptor to a number from 4 on, because the program uses the lower ones. */
static bool lift(int *fd)
{
    int high = fcntl(*fd, F_DUPFD_CLOEXEC, 4);
    if (high < 0)
        return false;
    close(*fd);
    *fd = high;
    return true;
}

bool kd_program_known(const char *name)
{
    const char *path = getenv("PATH");
    char file[4096];
    struct stat about;
    for (const char *at = path ? path : "/bin:/usr/bin", *end; at; at = *end ? end + 1 : NULL) {
        end = strchrnul(at, ':');
        snprintf(file, sizeof file, "%.*s/%s", end > at ? (int)(end - at) : 1, end > at ? at : ".", name);
        if (!access(file, X_OK) && !stat(file, &about) && S_ISREG(about.st_mode))
            return true;
    }
    return false;
}

enum kd_status kd_program_start(const char *const argv[], int out, uint64_t most, struct kd_program *program,
                                struct kd_error *error)
{
    int in = -1, told = -1, to = fcntl(out, F_DUPFD_CLOEXEC, 4);
    *program = (struct kd_program)KD_PROGRAM_NONE;
    int code = to >= 0 && make_pipe(&program->in, &in, true) && make_pipe(&program->told, &told, false) && lift(&in) &&
                       lift(&told)
                   ? 0
                   : errno;
    if (!code) {
        (void)fcntl(program->in, F_SETPIPE_SZ, PIPE_BYTES); /* if the kernel refuses this, the capacity stays 64 KiB */
        code = spawn(argv, in, told, to, &program->pid);
    }
    shut(&in);
    shut(&told);
    shut(&to);
    if (!code) {
        (void)setpriority(PRIO_PROCESS, (id_t)program->pid, NICE);
        (void)prlimit(program->pid, RLIMIT_FSIZE, &(struct rlimit) { most, most }, NULL);
        return KD_OK;
    }
    program->pid = 0;
    kd_program_end(program);
    return code == ENOENT ? kd_error_set(error, KD_EABSENT, "there is no %.40s on the PATH of this machine", argv[0])
                          : kd_error_set(error, KD_EIO, "%.40s cannot be started: %s", argv[0], strerror(code));
}

size_t kd_program_write(struct kd_program *program, const void *data, size_t size)
{
    size_t taken = 0;
    for (ssize_t n = 1; program->in >= 0 && taken < size && n > 0; taken += n > 0 ? (size_t)n : 0)
        n = write(program->in, (const char *)data + taken, size - taken);
    return taken;
}

void kd_program_hang_up(struct kd_program *program) { shut(&program->in); }

/* Reads the program's standard error. Keeps its beginning, which usually states the reason for a failure, and its
 * end, which reports a full disk. Closes the pipe at the end of file. */
static void listen_to(struct kd_program *p)
{
    char part[256];
    ssize_t n = 0;
    while (p->told >= 0 && (n = read(p->told, part, sizeof part)) > 0) {
        const size_t room = sizeof p->said - 1 - p->n_said, keep = (size_t)n < room ? (size_t)n : room;
        memcpy(p->said + p->n_said, part, keep);
        p->n_said += keep;
        p->said[p->n_said] = 0;
        if (p->n_last + (size_t)n >= sizeof p->last) { /* drops the older half to make room for more */
            const size_t kept = sizeof p->last / 2;
            memmove(p->last, p->last + p->n_last - kept, kept);
            p->n_last = kept;
        }
        memcpy(p->last + p->n_last, part, (size_t)n);
        p->n_last += (size_t)n;
        p->last[p->n_last] = 0;
    }
    if (p->told >= 0 && n == 0)
        shut(&p->told);
}

/* Kills the program's process group. The kernel cannot reuse the group's id before waitpid. */
static void end_group(const struct kd_program *p)
{
    kill(-p->pid, SIGKILL);
    kill(p->pid, SIGKILL); /* kills the process itself, which may not be in a process group of its own yet */
}

bool kd_program_over(struct kd_program *p, int *code)
{
    siginfo_t about = { 0 };
    int status;
    *code = -1;
    if (p->pid <= 0) /* the program has already ended */
        return true;
    listen_to(p);
    if (!waitid(P_PID, (id_t)p->pid, &about, WEXITED | WNOHANG | WNOWAIT) && !about.si_pid)
        return false;
    listen_to(p);
    end_group(p);
    pid_t done = waitpid(p->pid, &status, 0);
    *code = done == p->pid && WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    p->pid = 0;
    shut(&p->told);
    shut(&p->in);
    return true;
}

/* Processor time in ms that the program has used. Its children are not included. */
static double used_ms(const struct kd_program *p)
{
    clockid_t clock;
    struct timespec t;
    return p->pid > 0 && !clock_getcpuclockid(p->pid, &clock) && !clock_gettime(clock, &t)
               ? 1e3 * (double)t.tv_sec + 1e-6 * (double)t.tv_nsec
               : 0;
}

double kd_program_idle_ms(struct kd_program *p, bool moved, double now_ms)
{
    const double used = used_ms(p), passed = now_ms - p->looked_ms;
    if (moved || used > p->used_ms || !(p->looked_ms > 0))
        p->idle_ms = 0;
    else
        p->idle_ms += passed < 1e3 ? passed : 1e3;
    p->used_ms = used;
    p->looked_ms = now_ms;
    return p->idle_ms;
}

static bool begins_path(const char *at)
{
    const char *const ways[] = { "./", "../", "~/" };
    for (size_t i = 0; i < sizeof ways / sizeof *ways; i++)
        if (!strncmp(at, ways[i], strlen(ways[i])))
            return true;
    return *at == '/' && (unsigned char)at[1] > ' ';
}

/* Skips one control character or one whole escape sequence (ECMA-48, section 5.4). */
static const char *skip_control(const char *at)
{
    if (at[0] != '\x1b' || at[1] != '[')
        return at + 1;
    at += 2;
    return at + strcspn(at, "@ABCDEFGHIJKLMNOPQRSTUVWXYZ[\\]^_`abcdefghijklmnopqrstuvwxyz{|}~\n") + (*at != 0);
}

void kd_program_reason(const struct kd_program *p, char out[300])
{
    static const char before[] = " \t'\"([{<=,;:", after[] = " \t\r\n'\")]}>,;";
    const char *at = p->said + strspn(p->said, "\r\n \t");
    char last = ' ';
    size_t n = 0;
    while (*at && *at != '\n' && *at != '\r' && n < 300 - 5) {
        if ((unsigned char)*at < ' ' || *at == 0x7f)
            at = skip_control(at);
        else if (!strncmp(at, " @ 0x", 5)) /* this text precedes an address in the program's memory */
            at += 5 + strspn(at + 5, "0123456789abcdefABCDEF");
        else if (strchr(before, last) && begins_path(at)) {
            at += strcspn(at, after);
            memcpy(out + n, "FILE", 4);
            n += 4;
            if (at[-1] == ':')
                out[n++] = ':';
            last = 'E';
        } else
            out[n++] = last = *at++;
    }
    while (n && out[n - 1] == ' ')
        n--;
    out[n] = 0;
    kd_utf8_sanitize(out);
}

void kd_program_end(struct kd_program *p)
{
    shut(&p->in);
    shut(&p->told);
    if (p->pid > 0) {
        end_group(p);
        while (waitpid(p->pid, NULL, 0) < 0 && errno == EINTR)
            ;
    }
    p->pid = 0;
}
