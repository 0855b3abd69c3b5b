#include "base/replace.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

/* A temporary file that has not changed for this number of seconds counts as left over. No write takes that long,
 * even to a slow disk. */
#define STALE_S 3600

static const char letters[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789";

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
        if (!n)
            errno = ENOSPC;
        if (n <= 0)
            return false;
        at += n;
        size -= (size_t)n;
    }
    return true;
}

/* Creates an empty temporary file next to the file `name`. */
static int open_temporary(int folder, const char *name, char out[NAME_MAX + 1])
{
    unsigned char random[KD_TEMPORARY_TAIL - (sizeof KD_TEMPORARY_MARK - 1)];
    for (int attempt = 0; attempt < 100; attempt++) {
        if (getrandom(random, sizeof random, 0) != (ssize_t)sizeof random)
            return -1;
        int n = snprintf(out, NAME_MAX + 1, "%s" KD_TEMPORARY_MARK, name);
        if (n < 0 || (size_t)n + sizeof random > NAME_MAX) {
            errno = ENAMETOOLONG;
            return -1;
        }
        for (size_t i = 0; i < sizeof random; i++)
            out[(size_t)n + i] = letters[random[i] % (sizeof letters - 1)];
        out[(size_t)n + sizeof random] = 0;
        int fd = openat(folder, out, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0600);
        if (fd >= 0 || errno != EEXIST)
            return fd;
    }
    return -1;
}

bool kd_replace_is_temporary(const char *other, const char *name)
{
    const size_t n = strlen(name), mark = sizeof KD_TEMPORARY_MARK - 1;
    return !strncmp(other, name, n) && !strncmp(other + n, KD_TEMPORARY_MARK, mark) &&
           strlen(other + n) == KD_TEMPORARY_TAIL && strspn(other + n + mark, letters) == KD_TEMPORARY_TAIL - mark;
}

bool kd_replace_begin(int folder, const char *name, struct kd_replacing *out)
{
    out->folder = folder;
    out->fd = open_temporary(folder, name, out->temporary);
    return out->fd >= 0;
}

bool kd_replace_append(struct kd_replacing *file, const void *data, size_t size)
{
    return write_all(file->fd, data, size);
}

bool kd_replace_commit(struct kd_replacing *file, const char *name)
{
    bool good = !fsync(file->fd);
    good = !close(file->fd) && good && !renameat(file->folder, file->temporary, file->folder, name);
    int cause = errno;
    if (!good)
        unlinkat(file->folder, file->temporary, 0);
    /* Makes the rename durable; otherwise a power cut may bring the old file back. Some file systems do not support
     * fsync of folders. */
    if (good && fsync(file->folder) && errno != EINVAL && errno != EROFS)
        cause = errno, good = false;
    errno = cause;
    return good;
}

void kd_replace_abandon(struct kd_replacing *file)
{
    int cause = errno;
    close(file->fd);
    unlinkat(file->folder, file->temporary, 0);
    errno = cause;
}

bool kd_replace_file_at(int folder, const char *name, const void *data, size_t size)
{
    struct kd_replacing file;
    if (!kd_replace_begin(folder, name, &file))
        return false;
    if (kd_replace_append(&file, data, size))
        return kd_replace_commit(&file, name);
    kd_replace_abandon(&file);
    return false;
}

/* Removes temporary files that killed processes have left behind. A file that has changed recently is kept, because
 * a process may still be writing it. */
static void remove_stale(int folder, const char *name)
{
    int fd = openat(folder, ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    DIR *d = fd < 0 ? NULL : fdopendir(fd);
    struct stat about;
    if (fd >= 0 && !d)
        close(fd);
    for (struct dirent *entry; d && (entry = readdir(d));)
        if (kd_replace_is_temporary(entry->d_name, name) &&
            !fstatat(folder, entry->d_name, &about, AT_SYMLINK_NOFOLLOW) && S_ISREG(about.st_mode) &&
            about.st_mtime < time(NULL) - STALE_S)
            unlinkat(folder, entry->d_name, 0);
    if (d)
        closedir(d);
}

bool kd_replace_file(const char *path, const void *data, size_t size)
{
    char *copy = strdup(path), *slash = copy ? strrchr(copy, '/') : NULL;
    const char *name = slash ? slash + 1 : path;
    int folder = -1;
    if (copy && make_directories(copy)) {
        if (slash)
            *slash = 0;
        folder = open(!slash ? "." : *copy ? copy : "/", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    }
    bool good = folder >= 0 && kd_replace_file_at(folder, name, data, size);
    int cause = errno;
    if (good)
        remove_stale(folder, name);
    if (folder >= 0)
        close(folder);
    free(copy);
    errno = cause;
    return good;
}
