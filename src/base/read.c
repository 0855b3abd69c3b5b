#include "base/read.h"

#include <errno.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

static bool read_all(int fd, size_t most, struct kd_buffer *out)
{
    char part[16384];
    size_t before = out->size;
    for (;;) {
        ssize_t n = read(fd, part, sizeof part);
        if (!n)
            return true;
        if (n < 0 && errno == EINTR)
            continue;
        if (n < 0)
            return false;
        if (out->size - before + (size_t)n > most) { /* the file has grown since the call of fstat */
            errno = EFBIG;
            return false;
        }
        if (kd_buffer_append(out, part, (size_t)n)) {
            errno = ENOMEM;
            return false;
        }
    }
}

bool kd_read_file(int folder, const char *name, int flags, size_t most, struct kd_buffer *out)
{
    struct stat about;
    size_t before = out->size;
    /* O_NONBLOCK, because otherwise opening a pipe would wait for a writer. */
    int fd = openat(folder, name, O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY | flags);
    if (fd < 0)
        return false;
    bool good = !fstat(fd, &about);
    if (good && (!S_ISREG(about.st_mode) || (uint64_t)about.st_size > most)) {
        errno = S_ISREG(about.st_mode) ? EFBIG : EINVAL;
        good = false;
    }
    good = good && read_all(fd, most, out);
    int cause = errno;
    close(fd);
    if (!good)
        out->size = before;
    errno = cause;
    return good;
}
