/* Preloaded: makes the program's own file operations fail when a test requests it (control.h). */
#include "control.h"

#include <dirent.h>
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#define HERE __builtin_return_address(0)

static bool fails(int what, const void *caller)
{
    uint64_t where;
    if (!(atomic_load(&kd_faults->files_mask) & what) || !kd_fault_ours(caller, &where))
        return false;
    atomic_fetch_add(&kd_faults->files_count, 1);
    if (!kd_fault_next(&kd_faults->files_at, &kd_faults->files_for))
        return false;
    atomic_fetch_add(&kd_faults->files_failed, 1);
    atomic_store(&kd_faults->failed_from, (int64_t)where);
    errno = (int)atomic_load(&kd_faults->files_errno);
    return true;
}

static bool is_file(int fd)
{
    struct stat about;
    return !fstat(fd, &about) && S_ISREG(about.st_mode);
}

static void wait_while_slow(int64_t kind)
{
    const bool waits = atomic_load(&kd_faults->files_slow) == kind;
    atomic_fetch_add(&kd_faults->files_waiting, waits);
    while (waits && atomic_load(&kd_faults->files_slow))
        nanosleep(&(struct timespec) { .tv_nsec = 1000000 }, NULL);
    atomic_fetch_sub(&kd_faults->files_waiting, waits);
}

static void wait_for_disk(int flags)
{
    if ((flags & O_ACCMODE) == O_RDONLY && !(flags & O_DIRECTORY))
        wait_while_slow(1);
}

static int open_at(int folder, const char *path, int flags, unsigned mode, const void *caller)
{
    uint64_t where;
    KD_FAULT_REAL(int, "openat", int, const char *, int, ...);
    if (fails(flags & O_CREAT ? KD_FAULT_CREATE : KD_FAULT_OPEN, caller))
        return -1;
    if (kd_fault_ours(caller, &where))
        wait_for_disk(flags);
    return real(folder, path, flags, mode);
}

static unsigned mode_of(int flags, va_list arguments)
{
    return flags & (O_CREAT | O_TMPFILE) ? va_arg(arguments, unsigned) : 0;
}

#define OPEN(name) \
    int name(const char *path, int flags, ...) \
    { \
        va_list arguments; \
        va_start(arguments, flags); \
        unsigned mode = mode_of(flags, arguments); \
        va_end(arguments); \
        return open_at(AT_FDCWD, path, flags, mode, HERE); \
    }
#define OPENAT(name) \
    int name(int folder, const char *path, int flags, ...) \
    { \
        va_list arguments; \
        va_start(arguments, flags); \
        unsigned mode = mode_of(flags, arguments); \
        va_end(arguments); \
        return open_at(folder, path, flags, mode, HERE); \
    }
OPEN(open)
OPEN(open64)
OPENAT(openat)
OPENAT(openat64)

int __open64_2(const char *path, int flags);
int __open64_2(const char *path, int flags) { return open_at(AT_FDCWD, path, flags, 0, HERE); }
int __openat64_2(int folder, const char *path, int flags);
int __openat64_2(int folder, const char *path, int flags) { return open_at(folder, path, flags, 0, HERE); }

int mkostemp64(char *pattern, int flags)
{
    KD_FAULT_REAL(int, "mkostemp64", char *, int);
    return fails(KD_FAULT_CREATE, HERE) ? -1 : real(pattern, flags);
}

char *mkdtemp(char *pattern)
{
    KD_FAULT_REAL(char *, "mkdtemp", char *);
    return fails(KD_FAULT_CREATE, HERE) ? NULL : real(pattern);
}

int mkdir(const char *path, mode_t mode)
{
    KD_FAULT_REAL(int, "mkdir", const char *, mode_t);
    return fails(KD_FAULT_CREATE, HERE) ? -1 : real(path, mode);
}

int mkdirat(int folder, const char *path, mode_t mode)
{
    KD_FAULT_REAL(int, "mkdirat", int, const char *, mode_t);
    return fails(KD_FAULT_CREATE, HERE) ? -1 : real(folder, path, mode);
}

FILE *fopen64(const char *path, const char *mode)
{
    KD_FAULT_REAL(FILE *, "fopen64", const char *, const char *);
    return fails(*mode == 'r' ? KD_FAULT_OPEN : KD_FAULT_CREATE, HERE) ? NULL : real(path, mode);
}

DIR *opendir(const char *path)
{
    KD_FAULT_REAL(DIR *, "opendir", const char *);
    return fails(KD_FAULT_OPEN, HERE) ? NULL : real(path);
}

DIR *fdopendir(int fd)
{
    KD_FAULT_REAL(DIR *, "fdopendir", int);
    return fails(KD_FAULT_OPEN, HERE) ? NULL : real(fd);
}

ssize_t write(int fd, const void *data, size_t size)
{
    KD_FAULT_REAL(ssize_t, "write", int, const void *, size_t);
    return atomic_load(&kd_faults->files_mask) & KD_FAULT_WRITE && is_file(fd) && fails(KD_FAULT_WRITE, HERE)
               ? -1
               : real(fd, data, size);
}

ssize_t pwrite64(int fd, const void *data, size_t size, off64_t at)
{
    KD_FAULT_REAL(ssize_t, "pwrite64", int, const void *, size_t, off64_t);
    return fails(KD_FAULT_WRITE, HERE) ? -1 : real(fd, data, size, at);
}

ssize_t read(int fd, void *data, size_t size)
{
    KD_FAULT_REAL(ssize_t, "read", int, void *, size_t);
    return atomic_load(&kd_faults->files_mask) & KD_FAULT_READ && is_file(fd) && fails(KD_FAULT_READ, HERE)
               ? -1
               : real(fd, data, size);
}

ssize_t pread64(int fd, void *data, size_t size, off64_t at)
{
    KD_FAULT_REAL(ssize_t, "pread64", int, void *, size_t, off64_t);
    return fails(KD_FAULT_READ, HERE) ? -1 : real(fd, data, size, at);
}

int fsync(int fd)
{
    uint64_t where;
    KD_FAULT_REAL(int, "fsync", int);
    if (kd_fault_ours(HERE, &where))
        wait_while_slow(2);
    return fails(KD_FAULT_SYNC, HERE) ? -1 : real(fd);
}

int rename(const char *from, const char *to)
{
    KD_FAULT_REAL(int, "rename", const char *, const char *);
    return fails(KD_FAULT_RENAME, HERE) ? -1 : real(from, to);
}

int renameat(int from_folder, const char *from, int to_folder, const char *to)
{
    KD_FAULT_REAL(int, "renameat", int, const char *, int, const char *);
    return fails(KD_FAULT_RENAME, HERE) ? -1 : real(from_folder, from, to_folder, to);
}

static bool is_written(int fd)
{
    const int flags = fcntl(fd, F_GETFL);
    return flags >= 0 && (flags & O_ACCMODE) != O_RDONLY && is_file(fd);
}

/* A failed close still closes the descriptor, as on network file systems, which report write errors late. Closing a
 * file that was only read never fails. */
int close(int fd)
{
    KD_FAULT_REAL(int, "close", int);
    const bool late =
        atomic_load(&kd_faults->files_mask) & KD_FAULT_CLOSE && is_written(fd) && fails(KD_FAULT_CLOSE, HERE);
    const int cause = errno, result = real(fd);
    if (late)
        errno = cause;
    return late ? -1 : result;
}

int unlinkat(int folder, const char *path, int flags)
{
    uint64_t where;
    KD_FAULT_REAL(int, "unlinkat", int, const char *, int);
    if (kd_fault_ours(HERE, &where))
        wait_while_slow(2);
    return real(folder, path, flags);
}
