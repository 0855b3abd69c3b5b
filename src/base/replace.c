#include "base/replace.h"

#include <errno.h>
#include <fcntl.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static bool make_directories(char *path)
{
    for (char *slash = strchr(path + 1, '/'); slash; slash = strchr(slash + 1, '/')) {
        *slash = 0;
        int failed = mkdir(path, 0700) && errno != EEXIST;
        *slash = '/';
        if (failed)
            return false;
    }
    return true;
}

static bool write_all(int fd, const void *data, size_t size)
{
    const uint8_t *at = data;
    while (size) {
        ssize_t n = write(fd, at, size);
        if (n < 0 && errno == EINTR)
            continue;
        if (n <= 0)
            return false;
        at += n;
        size -= (size_t)n;
    }
    return true;
}

bool kd_replace_file(const char *path, const void *data, size_t size)
{
    char *temporary = NULL, *directories = strdup(path);
    bool good = directories && make_directories(directories);
    if (good && asprintf(&temporary, "%s.XXXXXX", path) < 0)
        temporary = NULL, good = false;
    int fd = good ? mkostemp(temporary, O_CLOEXEC) : -1;
    if (fd >= 0) {
        good = write_all(fd, data, size) && !fsync(fd);
        good = !close(fd) && good && !rename(temporary, path);
        int cause = errno;
        if (!good)
            unlink(temporary);
        errno = cause;
    }
    free(directories);
    free(temporary);
    return good && fd >= 0;
}
