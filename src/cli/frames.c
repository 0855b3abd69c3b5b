#include "cli/frames.h"

#include "base/replace.h"
#include "cli/file.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#define WAIT_NS 5000000 /* time in ns between two calls of go_on while another program works */

static enum kd_status make_room(struct kd_frames *f, struct kd_error *error)
{
    f->places = calloc(f->n, sizeof *f->places);
    f->sizes = calloc(f->n, sizeof *f->sizes);
    return f->places && f->sizes ? KD_OK : kd_error_set(error, KD_ENOMEM, "out of memory for %u %ss", f->n, f->noun);
}

enum kd_status kd_frames_open(struct kd_frames *f, struct kd_error *error)
{
    const char *parent = getenv("TMPDIR");
    char path[4096];
    snprintf(path, sizeof path, "%s/kerrd-frames-XXXXXX", parent && *parent ? parent : "/tmp");
    f->store = mkostemp(path, O_CLOEXEC);
    if (f->store < 0)
        return kd_error_set(error, KD_EIO, "cannot create a file for the %ss in TMPDIR: %s", f->noun, strerror(errno));
    unlink(path);
    return make_room(f, error);
}

enum kd_status kd_frames_open_folder(struct kd_frames *f, const char *path, bool shared, struct kd_error *error)
{
    if (mkdir(path, 0777) && errno != EEXIST)
        return kd_error_set(error, KD_EINVAL, "cannot create the folder %s: %s", path, strerror(errno));
    if ((f->folder = open(path, O_RDONLY | O_DIRECTORY | O_CLOEXEC)) < 0 ||
        (f->lock = openat(f->folder, "lock", O_RDWR | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0600)) < 0)
        return kd_error_set(error, KD_EINVAL, "cannot store the %ss in %s: %s", f->noun, path, strerror(errno));
    f->shared = shared;
    if (flock(f->lock, (shared ? LOCK_SH : LOCK_EX) | LOCK_NB))
        return kd_error_set(error, KD_EINVAL,
                            errno == EWOULDBLOCK ? "another process stores its %ss in %s"
                                                 : "the %ss in %s cannot be locked",
                            f->noun, path);
    return make_room(f, error);
}

static void name_of(const struct kd_frames *f, unsigned frame, char out[32])
{
    snprintf(out, 32, "%06u.%s", frame, f->format->name);
}

/* Removes unfinished files that killed processes have left behind. */
static void remove_halves(const struct kd_frames *f)
{
    int fd = openat(f->folder, ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    DIR *d = fd < 0 ? NULL : fdopendir(fd);
    char name[32];
    for (struct dirent *entry; d && (entry = readdir(d));) {
        const char *digits = entry->d_name + strcspn(entry->d_name, "0123456789");
        name_of(f, (unsigned)strtoul(digits, NULL, 10), name);
        if (kd_replace_is_temporary(entry->d_name, name))
            unlinkat(f->folder, entry->d_name, 0);
    }
    if (d)
        closedir(d);
    else if (fd >= 0)
        close(fd);
}

enum kd_status kd_frames_find(struct kd_frames *f, unsigned *found, struct kd_error *error)
{
    struct stat about;
    char name[32];
    *found = 0;
    if (!f->shared)
        remove_halves(f);
    for (unsigned i = 0; i < f->n; i++) {
        name_of(f, i, name);
        if (fstatat(f->folder, name, &about, AT_SYMLINK_NOFOLLOW))
            continue;
        if (!S_ISREG(about.st_mode))
            return kd_error_set(error, KD_EINVAL, "%s in the folder of the %ss was not written by kerrd: remove it",
                                name, f->noun);
        f->sizes[i] = (uint64_t)about.st_size;
        *found += about.st_size > 0;
    }
    return KD_OK;
}

static enum kd_status append(struct kd_frames *f, unsigned frame, const struct kd_buffer *file, struct kd_error *error)
{
    f->places[frame] = f->end;
    for (size_t done = 0; done < file->size;) {
        ssize_t n = pwrite(f->store, file->data + done, file->size - done, (off_t)(f->end + done));
        if (n <= 0)
            return kd_error_set(error, KD_EIO, "cannot store %s %u in TMPDIR: %s", f->noun, frame, strerror(errno));
        done += (size_t)n;
    }
    f->end += file->size;
    return KD_OK;
}

enum kd_status kd_frames_put(struct kd_frames *f, unsigned frame, const struct kd_buffer *file, struct kd_error *error)
{
    char name[32];
    enum kd_status status = KD_OK;
    if (f->folder < 0) {
        status = append(f, frame, file, error);
    } else {
        name_of(f, frame, name);
        if (!kd_replace_file_at(f->folder, name, file->data, file->size))
            status = kd_error_set(error, KD_EIO, "cannot store %s %u: %s", f->noun, frame, strerror(errno));
    }
    if (!status)
        f->sizes[frame] = file->size;
    return status;
}

static bool read_all(int fd, uint64_t at, void *to, size_t size)
{
    for (size_t done = 0; done < size;) {
        ssize_t n = pread(fd, (char *)to + done, size - done, (off_t)(at + done));
        if (n <= 0)
            return false;
        done += (size_t)n;
    }
    return true;
}

bool kd_frames_read(void *user, unsigned frame, uint64_t at, void *to, size_t size)
{
    const struct kd_frames *f = user;
    char name[32];
    if (at + size > f->sizes[frame])
        return false;
    if (f->folder < 0)
        return read_all(f->store, f->places[frame] + at, to, size);
    name_of(f, frame, name);
    int fd = openat(f->folder, name, O_RDONLY | O_NOFOLLOW | O_CLOEXEC);
    const bool read = fd >= 0 && read_all(fd, at, to, size);
    if (fd >= 0)
        close(fd);
    return read;
}

static bool size_of(void *user, unsigned frame, uint64_t *out)
{
    *out = ((const struct kd_frames *)user)->sizes[frame];
    return *out > 0;
}

/* State of writing the combined file. */
struct pour {
    const struct kd_frames_whole *whole;
    struct kd_gather gather;
    struct kd_buffer out;
    size_t at;
    bool over;
    enum kd_status status;
    struct kd_error *error;
};

static enum kd_status wait(const struct kd_frames_whole *whole, struct kd_error *error)
{
    if (whole->go_on && !whole->go_on(whole->user))
        return kd_error_set(error, KD_ECANCELLED, "stopped while the frames were joined to one file");
    nanosleep(&(struct timespec) { .tv_nsec = WAIT_NS }, NULL);
    return KD_OK;
}

static size_t pour(void *user, void *to, size_t size)
{
    struct pour *p = user;
    while (p->at == p->out.size && !p->over) {
        p->out.size = p->at = 0;
        p->status = kd_gather_next(&p->gather, &p->out, &p->over, p->error);
        if (!p->status && !p->out.size && !p->over && p->whole->format->waits)
            p->status = wait(p->whole, p->error);
        if (p->status)
            return KD_FILE_STOP;
    }
    size_t left = p->out.size - p->at, n = left < size ? left : size;
    if (n)
        memcpy(to, p->out.data + p->at, n);
    p->at += n;
    return n;
}

enum kd_status kd_frames_save(struct kd_frames *f, const struct kd_frames_whole *whole, const char *path,
                              struct kd_error *error)
{
    const struct kd_gather_source source = { .user = f,
                                             .sweep = whole->sweep,
                                             .frame = f->format,
                                             .n = f->n,
                                             .rate = whole->rate,
                                             .size = size_of,
                                             .read = kd_frames_read };
    struct kd_error made = { 0 };
    struct pour p = { .whole = whole, .error = &made };
    enum kd_status status;
    KD_TRY(kd_gather_open(whole->format, &source, &p.gather, error));
    status = kd_file_stream(path, pour, &p, error);
    if (p.status) {
        *error = made;
        status = p.status;
    }
done:
    kd_gather_close(&p.gather);
    kd_buffer_finish(&p.out);
    return status;
}

void kd_frames_finish(struct kd_frames *f)
{
    const int open[] = { f->store, f->folder, f->lock };
    for (size_t i = 0; i < sizeof open / sizeof *open; i++)
        if (open[i] >= 0)
            close(open[i]);
    free(f->places);
    free(f->sizes);
    *f = (struct kd_frames)KD_FRAMES_NONE;
}
