/* Preloaded into a server under test: memory, disk, descriptors and the clock on the wall as a file in KD_FAULTS says, which the test
 * has mapped too (faults.py). */
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

struct control {
    _Atomic int64_t fail_at;     /* allocations before one fails; below 0: none does */
    _Atomic int64_t allocations; /* since the start */
    _Atomic int64_t live;        /* blocks */
    _Atomic int64_t failed;      /* allocations that have */
    _Atomic int64_t by_library;  /* of those: asked for by libmicrohttpd, which then closes the connection */
    _Atomic int64_t full;        /* nothing can be written to files */
    _Atomic int64_t descriptors; /* 1: none is left for files */
    _Atomic int64_t shift_s;     /* of the clock on the wall */
    _Atomic int64_t slow;        /* files are not opened for reading before it is 0 again */
    _Atomic int64_t waiting;     /* for that */
};

void *__libc_malloc(size_t size);
void *__libc_calloc(size_t n, size_t size);
void *__libc_realloc(void *old, size_t size);
void __libc_free(void *block);

static struct control unused = { .fail_at = -1 }, *control = &unused;

__attribute__((constructor)) static void begin(void)
{
    const char *path = getenv("KD_FAULTS");
    int fd = path ? open(path, O_RDWR | O_CLOEXEC) : -1;
    void *map = fd < 0 ? MAP_FAILED : mmap(NULL, sizeof unused, PROT_READ | PROT_WRITE, MAP_SHARED, fd, 0);
    if (map != MAP_FAILED)
        control = map;
    if (fd >= 0)
        close(fd);
}

static int fails(const void *caller)
{
    Dl_info from;
    atomic_fetch_add(&control->allocations, 1);
    if (atomic_load(&control->fail_at) < 0 || atomic_fetch_sub(&control->fail_at, 1) != 0)
        return 0;
    atomic_fetch_add(&control->failed, 1);
    if (dladdr(caller, &from) && from.dli_fname && strstr(from.dli_fname, "libmicrohttpd"))
        atomic_fetch_add(&control->by_library, 1);
    errno = ENOMEM;
    return 1;
}

static void *counted(void *block)
{
    if (block)
        atomic_fetch_add(&control->live, 1);
    return block;
}

void *malloc(size_t size) { return fails(__builtin_return_address(0)) ? NULL : counted(__libc_malloc(size)); }
void *calloc(size_t n, size_t size) { return fails(__builtin_return_address(0)) ? NULL : counted(__libc_calloc(n, size)); }

void *realloc(void *old, size_t size)
{
    if (fails(__builtin_return_address(0)))
        return NULL;
    void *block = __libc_realloc(old, size);
    return old ? block : counted(block);
}

void free(void *block)
{
    if (block)
        atomic_fetch_sub(&control->live, 1);
    __libc_free(block);
}

ssize_t write(int fd, const void *data, size_t size)
{
    static ssize_t (*real)(int, const void *, size_t);
    struct stat about;
    if (!real)
        real = (ssize_t(*)(int, const void *, size_t))(uintptr_t)dlsym(RTLD_NEXT, "write");
    if (atomic_load(&control->full) && !fstat(fd, &about) && S_ISREG(about.st_mode)) {
        errno = ENOSPC;
        return -1;
    }
    return real(fd, data, size);
}

int openat(int folder, const char *path, int flags, ...)
{
    static int (*real)(int, const char *, int, ...);
    va_list arguments;
    va_start(arguments, flags);
    unsigned mode = flags & (O_CREAT | O_TMPFILE) ? va_arg(arguments, unsigned) : 0;
    va_end(arguments);
    if (!real)
        real = (int (*)(int, const char *, int, ...))(uintptr_t)dlsym(RTLD_NEXT, "openat");
    if (atomic_load(&control->descriptors)) {
        errno = EMFILE;
        return -1;
    }
    bool waits = (flags & O_ACCMODE) == O_RDONLY && !(flags & O_DIRECTORY) && atomic_load(&control->slow);
    atomic_fetch_add(&control->waiting, waits);
    while (waits && atomic_load(&control->slow))
        nanosleep(&(struct timespec) { .tv_nsec = 1000000 }, NULL);
    atomic_fetch_sub(&control->waiting, waits);
    return real(folder, path, flags, mode);
}

int clock_gettime(clockid_t clock, struct timespec *out)
{
    static int (*real)(clockid_t, struct timespec *);
    if (!real)
        real = (int (*)(clockid_t, struct timespec *))(uintptr_t)dlsym(RTLD_NEXT, "clock_gettime");
    int result = real(clock, out);
    if (clock == CLOCK_REALTIME)
        out->tv_sec += (time_t)atomic_load(&control->shift_s);
    return result;
}
