#include "cli/file.h"

#include "cli/cli.h"

#include <errno.h>
#include <fcntl.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static enum kd_status read_fd(int fd, const char *name, size_t most, struct kd_buffer *out, struct kd_error *error)
{
    uint8_t chunk[64 * 1024];
    for (;;) {
        ssize_t n = read(fd, chunk, sizeof chunk);
        if (n == 0)
            return KD_OK;
        if (n < 0 && errno == EINTR)
            continue;
        if (n < 0)
            return kd_error_set(error, errno == EISDIR ? KD_EINVAL : KD_EIO, "cannot read %s: %s", name,
                                strerror(errno));
        if (out->size + (size_t)n > most)
            return kd_error_set(error, KD_EINVAL, "%s has more than %zu bytes", name, most);
        if (kd_buffer_append(out, chunk, (size_t)n))
            return kd_error_set(error, KD_ENOMEM, "out of memory for %s", name);
    }
}

enum kd_status kd_file_read(const char *path, size_t most, struct kd_buffer *out, struct kd_error *error)
{
    if (strcmp(path, "-") == 0)
        return read_fd(STDIN_FILENO, "standard input", most, out, error);
    int fd = open(path, O_RDONLY | O_CLOEXEC);
    if (fd < 0)
        return kd_error_set(error, KD_EINVAL, "cannot open %s: %s", path, strerror(errno));
    enum kd_status status = read_fd(fd, path, most, out, error);
    close(fd);
    return status;
}

/* The file at the end of a chain of symbolic links. It is found first, because a rename would replace the link
 * instead of the file. */
struct target {
    char *path;    /* malloc'd */
    bool in_place; /* true if the path exists but is not a regular file, so that it must not be replaced */
};

static enum kd_status find_target(const char *path, struct target *out, struct kd_error *error)
{
    struct stat info;
    *out = (struct target) { 0 };
    if (stat(path, &info) == 0) {
        if (S_ISDIR(info.st_mode))
            return kd_error_set(error, KD_EINVAL, "cannot write %s: it is a directory", path);
        out->in_place = !S_ISREG(info.st_mode);
        out->path = realpath(path, NULL);
    } else {
        out->path = strdup(path);
    }
    if (!out->path)
        return kd_error_set(error, KD_EIO, "cannot write %s: %s", path, strerror(errno));
    return KD_OK;
}

/* Creates an empty file in the folder of the target, with the usual permissions of a new file. *temporary is
 * malloc'd. */
static int open_beside(const char *path, char **temporary)
{
    *temporary = NULL;
    const char *slash = strrchr(path, '/');
    int folder = slash ? (int)(slash - path) + 1 : 0;
    if (asprintf(temporary, "%.*s.kerrd-XXXXXX", folder, path) < 0) {
        *temporary = NULL;
        errno = ENOMEM;
        return -1;
    }
    int fd = mkostemp(*temporary, O_CLOEXEC);
    if (fd < 0) {
        free(*temporary);
        *temporary = NULL;
        return -1;
    }
    mode_t mask = umask(0);
    umask(mask);
    fchmod(fd, 0666 & ~mask); /* mkostemp made it private; a picture is an ordinary file */
    return fd;
}

enum kd_status kd_file_check(const char *path, struct kd_error *error)
{
    if (strcmp(path, "-") == 0) {
        if (isatty(STDOUT_FILENO))
            return kd_error_set(error, KD_EINVAL,
                                "-o - would write bytes to the terminal: redirect it, or name "
                                "a file");
        return KD_OK;
    }
    struct target target;
    char *temporary = NULL;
    enum kd_status status = find_target(path, &target, error);
    if (status)
        return status;
    if (target.in_place) {
        if (access(target.path, W_OK))
            status = kd_error_set(error, KD_EIO, "cannot write %s: %s", path, strerror(errno));
    } else {
        int fd = open_beside(target.path, &temporary);
        if (fd < 0)
            status = kd_error_set(error, KD_EIO, "cannot write %s: %s", path, strerror(errno));
        else
            close(fd), unlink(temporary);
    }
    free(temporary);
    free(target.path);
    return status;
}

struct source {
    size_t (*read)(void *user, void *to, size_t size);
    void *user;
};

static bool write_bytes(int fd, const char *from, size_t size)
{
    for (size_t done = 0; done < size;) {
        ssize_t n = write(fd, from + done, size - done);
        if (n < 0 && errno != EINTR)
            return false;
        done += n > 0 ? (size_t)n : 0;
    }
    return true;
}

static bool write_all(int fd, const struct source *source)
{
    char chunk[64 * 1024];
    size_t n;
    while ((n = source->read(source->user, chunk, sizeof chunk))) {
        if (n == KD_FILE_STOP)
            errno = ECANCELED;
        if (n == KD_FILE_STOP || !write_bytes(fd, chunk, n))
            return false;
    }
    return true;
}

static bool replace(const char *path, const struct source *data)
{
    char *temporary;
    int fd = open_beside(path, &temporary);
    if (fd < 0)
        return false;
    bool good = write_all(fd, data) && fsync(fd) == 0;
    good = close(fd) == 0 && good;
    good = good && rename(temporary, path) == 0;
    if (!good) {
        int cause = errno;
        unlink(temporary);
        errno = cause;
    }
    free(temporary);
    return good;
}

static bool write_in_place(const char *path, const struct source *data)
{
    int fd = open(path, O_WRONLY | O_CLOEXEC);
    if (fd < 0)
        return false;
    bool good = write_all(fd, data);
    return close(fd) == 0 && good;
}

enum kd_status kd_file_stream(const char *path, size_t (*read)(void *user, void *to, size_t size), void *user,
                              struct kd_error *error)
{
    const struct source data = { read, user };
    if (strcmp(path, "-") == 0) {
        if (write_all(STDOUT_FILENO, &data))
            return KD_OK;
        int number = errno;
        if (number == EPIPE)
            kd_cli_stdout_failed(number);
        return kd_error_set(error, KD_EIO, "cannot write to standard output: %s", strerror(number));
    }
    struct target target;
    enum kd_status status = find_target(path, &target, error);
    if (status)
        return status;
    if (!(target.in_place ? write_in_place(target.path, &data) : replace(target.path, &data)))
        status = kd_error_set(error, KD_EIO, "cannot write %s: %s", path, strerror(errno));
    free(target.path);
    return status;
}

struct memory {
    const struct kd_buffer *data;
    size_t at;
};

static size_t read_memory(void *user, void *to, size_t size)
{
    struct memory *memory = user;
    size_t left = memory->data->size - memory->at, n = left < size ? left : size;
    if (n)
        memcpy(to, memory->data->data + memory->at, n);
    memory->at += n;
    return n;
}

enum kd_status kd_file_write(const char *path, const struct kd_buffer *data, struct kd_error *error)
{
    return kd_file_stream(path, read_memory, &(struct memory) { data, 0 }, error);
}
