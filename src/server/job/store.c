#include "server/job/store.h"

#include "base/json.h"
#include "base/log.h"
#include "base/read.h"
#include "base/replace.h"
#include "server/job/folder.h"
#include "job/spec.h"
#include "document/tree.h"

#include <cjson/cJSON.h>
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#define RECORD_MAX ((size_t)64 << 10) /* maximum size of job.json in bytes; usually it has some 500 */
#define TEMPORARY "kerrd-jobs-"

struct kd_job_store {
    /* only for a temporary store: parent is TMPDIR, and name is the name of the store's folder there */
    char *parent, *name;
    int folder, lock;
};

static const char *const states[] = { [KD_JOB_ACTIVE] = "active", [KD_JOB_DONE] = "done", [KD_JOB_FAILED] = "failed" };

/* Logs the failure with its path. Returns KD_EFULL or KD_ENOMEM for failures that may be temporary, and KD_EIO for
 * all others. */
enum kd_status kd_job_store_failed(struct kd_error *error, const char *what)
{
    int cause = errno;
    bool full = cause == ENOSPC || cause == EDQUOT || cause == EFBIG,
         scarce = cause == EMFILE || cause == ENFILE || cause == ENOMEM;
    return kd_error_set(error, full ? KD_EFULL : scarce ? KD_ENOMEM : KD_EIO, "%s: %s", what, strerror(cause));
}

static enum kd_status failed_at(struct kd_error *error, const char *what, const char *where)
{
    return kd_error_set(error, KD_EIO, "%s in %.300s: %s", what, where, strerror(errno));
}

/* Opens and locks the lock file of a folder. Returns -1 with errno on failure; EWOULDBLOCK: another process holds
 * the lock. */
static int take_lock(int folder, int flags)
{
    int fd = openat(folder, "lock", O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC | flags, 0600);
    struct stat about;
    if (fd < 0)
        return -1;
    errno = EINVAL;
    if (!fstat(fd, &about) && S_ISREG(about.st_mode) && !flock(fd, LOCK_EX | LOCK_NB) && !fstat(fd, &about)) {
        if (about.st_nlink)
            return fd;
        errno = EWOULDBLOCK; /* the file was deleted after it was opened and before it was locked */
    }
    int cause = errno;
    close(fd);
    errno = cause;
    return -1;
}

static const char *temporary_parent(void)
{
    const char *parent = getenv("TMPDIR");
    return parent && *parent ? parent : "/tmp";
}

void kd_job_store_tidy(void)
{
    int parent = open(temporary_parent(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    DIR *d = parent < 0 ? NULL : fdopendir(parent);
    struct stat about;
    for (struct dirent *entry; d && (entry = readdir(d));) {
        if (strncmp(entry->d_name, TEMPORARY, strlen(TEMPORARY)) || strlen(entry->d_name) != strlen(TEMPORARY "XXXXXX"))
            continue;
        int folder = kd_job_folder_open(parent, entry->d_name);
        int lock = folder >= 0 && !fstat(folder, &about) && about.st_uid == geteuid() ? take_lock(folder, 0) : -1;
        if (lock >= 0) { /* the lock was free, so the server that created the folder has ended */
            kd_job_folder_empty(folder);
            if (!unlinkat(parent, entry->d_name, AT_REMOVEDIR))
                kd_log(KD_LOG_INFO, "%s, which a server that has ended left behind, is removed", entry->d_name);
            close(lock);
        }
        if (folder >= 0)
            close(folder);
    }
    if (d)
        closedir(d);
    else if (parent >= 0)
        close(parent);
}

static enum kd_status open_temporary(struct kd_job_store *store, struct kd_error *error)
{
    const char *parent = temporary_parent();
    char path[PATH_MAX];
    for (int attempt = 0; attempt < 10; attempt++) {
        if (snprintf(path, sizeof path, "%s/" TEMPORARY "XXXXXX", parent) >= (int)sizeof path)
            return kd_error_set(error, KD_EINVAL, "the path in TMPDIR is too long");
        if (!mkdtemp(path))
            return kd_job_store_failed(error, "cannot create a folder for jobs");
        store->folder = open(path, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
        store->lock = store->folder < 0 ? -1 : take_lock(store->folder, O_CREAT);
        if (store->lock >= 0)
            break;
        int cause = errno;
        if (store->folder >= 0) {
            unlinkat(store->folder, "lock", 0);
            close(store->folder);
        }
        rmdir(path);
        store->folder = -1;
        errno = cause;
        /* EWOULDBLOCK and ENOENT mean that another server has just removed the new folder, because it looked left over.
         * A further attempt is then made. */
        if (cause != EWOULDBLOCK && cause != ENOENT)
            return kd_job_store_failed(error, "cannot create a folder for jobs");
    }
    store->parent = strdup(parent);
    store->name = strdup(strrchr(path, '/') + 1);
    if (store->lock < 0 || !store->parent || !store->name)
        return kd_error_set(error, KD_ENOMEM, "out of memory for a folder of jobs");
    return KD_OK;
}

/* Locks the state folder, because two servers that share one would both do all of its jobs. The path may contain
 * symbolic links, but its last part must not be one. */
static enum kd_status open_state(struct kd_job_store *store, const char *state, struct kd_error *error)
{
    if (mkdir(state, 0700) && errno != EEXIST)
        return failed_at(error, "jobs cannot be stored", state);
    int parent = open(state, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (parent >= 0 && (!mkdirat(parent, "jobs", 0700) || errno == EEXIST))
        store->folder = kd_job_folder_open(parent, "jobs");
    int cause = errno;
    if (parent >= 0)
        close(parent);
    errno = cause;
    if (store->folder < 0)
        return failed_at(error, "jobs cannot be stored", state);
    store->lock = take_lock(store->folder, O_CREAT);
    if (store->lock >= 0)
        return KD_OK;
    return errno == EWOULDBLOCK ? kd_error_set(error, KD_EIO, "another server uses %.300s for its jobs", state)
                                : failed_at(error, "jobs cannot be stored", state);
}

enum kd_status kd_job_store_open(const char *state, struct kd_job_store **out, struct kd_error *error)
{
    struct kd_job_store *store = calloc(1, sizeof *store);
    if (!store)
        return kd_error_set(error, KD_ENOMEM, "out of memory");
    store->lock = store->folder = -1;
    enum kd_status status = state ? open_state(store, state, error) : open_temporary(store, error);
    if (status)
        kd_job_store_close(store);
    else
        *out = store;
    return status;
}

void kd_job_store_forget(struct kd_job_store *store, const char *id)
{
    int folder = kd_job_folder_open(store->folder, id);
    if (folder < 0)
        return;
    unlinkat(folder, "request.json", 0);
    fsync(folder);
    close(folder);
}

bool kd_job_store_remove(struct kd_job_store *store, const char *id, unsigned most)
{
    return kd_job_folder_remove(store->folder, id, most);
}

static void remove_temporary(struct kd_job_store *store)
{
    int parent = open(store->parent, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    kd_job_folder_empty(store->folder);
    if (parent >= 0) {
        unlinkat(parent, store->name, AT_REMOVEDIR);
        close(parent);
    }
}

void kd_job_store_close(struct kd_job_store *store)
{
    if (!store)
        return;
    if (store->name && store->parent && store->folder >= 0)
        remove_temporary(store);
    if (store->folder >= 0)
        close(store->folder);
    if (store->lock >= 0)
        close(store->lock);
    free(store->parent);
    free(store->name);
    free(store);
}

static bool copy_text(const cJSON *o, const char *name, char *out, size_t size)
{
    const char *text = cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(o, name));
    return text && (size_t)snprintf(out, size, "%s", text) < size;
}

static double number(const cJSON *o, const char *name)
{
    const cJSON *item = cJSON_GetObjectItemCaseSensitive(o, name);
    return cJSON_IsNumber(item) ? item->valuedouble : 0;
}

static bool read_state(const cJSON *o, enum kd_job_state *out)
{
    char state[10];
    if (!copy_text(o, "state", state, sizeof state))
        return false;
    for (int i = 0; i < (int)(sizeof states / sizeof *states); i++)
        if (!strcmp(state, states[i])) {
            *out = (enum kd_job_state)i;
            return true;
        }
    return false;
}

/* Returns the series of a record; NULL if only newer versions know it. */
static const struct kd_series *series_of(const cJSON *o)
{
    const char *name = cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(o, "output"));
    if (!name) /* records of older versions do not name the series; there were two at that time */
        name = cJSON_IsTrue(cJSON_GetObjectItemCaseSensitive(o, "curve")) ? "light-curve" : "pictures";
    return kd_series_named(name);
}

static bool read_record(const cJSON *o, const char *id, struct kd_job_record *out)
{
    *out = (struct kd_job_record) { .created = number(o, "created"),
                                    .ended = number(o, "ended"),
                                    .exposure = cJSON_HasObjectItem(o, "exposure") ? number(o, "exposure") : NAN };
    if (number(o, "format") != 1 || !copy_text(o, "id", out->id, sizeof out->id) || strcmp(out->id, id) ||
        !copy_text(o, "token", out->token, sizeof out->token) || strlen(out->token) != KD_SECRET_TOKEN - 1 ||
        !copy_text(o, "error", out->error, sizeof out->error) || !read_state(o, &out->state))
        return false;
    if (!copy_text(o, "preset", out->preset, sizeof out->preset)) /* records of older versions lack this member */
        *out->preset = 0;
    if (!copy_text(o, "idempotency_key", out->once.key, sizeof out->once.key) ||
        !copy_text(o, "idempotency_request", out->once.request, sizeof out->once.request))
        out->once = (struct kd_once) { 0 };
    double attempts = number(o, "attempts"), frames = number(o, "frames"), traced = number(o, "lens_maps_traced");
    out->attempts = attempts > 0 && attempts < 1e6 ? (unsigned)attempts : 0;
    out->frames = frames > 0 && frames <= KD_SWEEP_MOST ? (unsigned)frames : 0;
    out->traced = traced > 0 && traced < 1e9 ? (unsigned)traced : 0;
    out->series = series_of(o);
    return out->series;
}

struct found {
    struct kd_job_record record;
    struct kd_buffer request;
};

enum fate { KEPT, GONE, ASIDE };

/* Parses a job.json of this version. If it returns false, *why is the reason. */
static bool parse_record(const struct kd_buffer *text, const char *id, struct kd_job_record *out, const char **why)
{
    bool starved;
    cJSON *o = kd_tree_read((const char *)text->data, text->size, &starved);
    bool good = o && read_record(o, id, out);
    if (starved)
        *why = "out of memory for its job.json";
    else if (!good)
        *why = o && number(o, "format") > 0 && (number(o, "format") != 1 || !series_of(o))
                   ? "its job.json is of another version of kerrd"
                   : "its job.json is damaged";
    cJSON_Delete(o);
    return good;
}

/* Examines the folder of a job. A job that cannot be read now may be readable later, or by another version of kerrd.
 * The result is GONE only for a deleted job. */
static enum fate look(int folder, const char *id, struct found *out, const char **why)
{
    struct kd_buffer text = { 0 };
    *out = (struct found) { 0 };
    if (!kd_read_file(folder, "job.json", O_NOFOLLOW, RECORD_MAX, &text)) {
        *why = errno == EINVAL ? "its job.json is not a file" : strerror(errno);
        kd_buffer_finish(&text);
        return ASIDE;
    }
    bool known = parse_record(&text, id, &out->record, why);
    kd_buffer_finish(&text);
    if (!known)
        return ASIDE;
    if (kd_read_file(folder, "request.json", O_NOFOLLOW, KD_JOB_FILM_MAX, &out->request))
        return KEPT;
    int cause = errno;
    kd_buffer_finish(&out->request);
    *why = cause == EINVAL ? "its request.json is not a file" : strerror(cause);
    return cause == ENOENT ? GONE : ASIDE;
}

static bool load(struct kd_job_store *store, const char *name, struct found *out)
{
    const char *why = "";
    if (kd_job_folder_is_new(name)) { /* the server was killed before it had accepted the job */
        kd_job_folder_remove(store->folder, name, UINT_MAX);
        return false;
    }
    if (!kd_job_folder_is_id(name))
        return false;
    int folder = kd_job_folder_open(store->folder, name);
    enum fate fate = ASIDE;
    if (folder < 0)
        why = strerror(errno);
    else
        fate = look(folder, name, out, &why);
    if (fate == KEPT)
        kd_job_folder_tidy(folder);
    if (folder >= 0)
        close(folder);
    if (fate == GONE)
        kd_job_folder_remove(store->folder, name, UINT_MAX);
    if (fate == ASIDE)
        kd_log(KD_LOG_WARN, "job %.4s... is skipped: %s", name, why);
    return fate == KEPT;
}

/* Compares records by the number of attempts, and then by age. */
static int by_age(const void *a, const void *b)
{
    const struct kd_job_record *x = &((const struct found *)a)->record, *y = &((const struct found *)b)->record;
    if (x->attempts != y->attempts)
        return x->attempts < y->attempts ? -1 : 1;
    return x->created < y->created ? -1 : x->created > y->created;
}

static enum kd_status find_all(struct kd_job_store *store, DIR *d, struct found **all, size_t *n,
                               struct kd_error *error)
{
    struct found one;
    for (struct dirent *entry; (entry = readdir(d));) {
        if (!load(store, entry->d_name, &one))
            continue;
        struct found *more = realloc(*all, (*n + 1) * sizeof **all);
        if (!more) {
            kd_buffer_finish(&one.request);
            return kd_error_set(error, KD_ENOMEM, "out of memory for the jobs of the state folder");
        }
        *all = more;
        more[(*n)++] = one;
    }
    return KD_OK;
}

enum kd_status kd_job_store_load(struct kd_job_store *store,
                                 void (*found)(void *user, const struct kd_job_record *record,
                                               struct kd_buffer *request),
                                 void *user, struct kd_error *error)
{
    struct found *all = NULL;
    size_t n = 0;
    int fd = openat(store->folder, ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    DIR *d = fd < 0 ? NULL : fdopendir(fd);
    if (!d) {
        enum kd_status status = kd_job_store_failed(error, "the jobs of the state folder cannot be read");
        if (fd >= 0)
            close(fd);
        return status;
    }
    enum kd_status status = find_all(store, d, &all, &n, error);
    closedir(d);
    if (n)
        qsort(all, n, sizeof *all, by_age);
    for (size_t i = 0; i < n; i++)
        if (status)
            kd_buffer_finish(&all[i].request);
        else
            found(user, &all[i].record, &all[i].request);
    free(all);
    return status;
}

static enum kd_status record_json(const struct kd_job_record *record, struct kd_buffer *out)
{
    struct kd_json json = kd_json_begin(out);
    kd_json_object(&json, NULL);
    kd_json_number(&json, "format", 1);
    kd_json_string(&json, "id", record->id);
    kd_json_string(&json, "token", record->token);
    kd_json_string(&json, "state", states[record->state]);
    kd_json_number(&json, "created", record->created);
    kd_json_number(&json, "ended", record->ended);
    kd_json_number(&json, "attempts", record->attempts);
    kd_json_number(&json, "frames", record->frames);
    kd_json_number(&json, "lens_maps_traced", record->traced);
    if (!isnan(record->exposure))
        kd_json_number(&json, "exposure", record->exposure);
    kd_json_string(&json, "output", record->series->name);
    kd_json_string(&json, "preset", record->preset);
    if (*record->once.key) {
        kd_json_string(&json, "idempotency_key", record->once.key);
        kd_json_string(&json, "idempotency_request", record->once.request);
    }
    kd_json_string(&json, "error", record->error);
    kd_json_end(&json);
    return kd_json_finish(&json);
}

static enum kd_status write_record(int folder, const struct kd_job_record *record, struct kd_error *error)
{
    struct kd_buffer text = { 0 };
    enum kd_status status =
        record_json(record, &text) ? kd_error_set(error, KD_ENOMEM, "out of memory for a job") : KD_OK;
    if (!status && !kd_replace_file_at(folder, "job.json", text.data, text.size))
        status = kd_job_store_failed(error, "the job cannot be stored");
    kd_buffer_finish(&text);
    return status;
}

enum kd_status kd_job_store_update(struct kd_job_store *store, const struct kd_job_record *record,
                                   struct kd_error *error)
{
    int folder = kd_job_folder_open(store->folder, record->id);
    if (folder < 0)
        return kd_job_store_failed(error, "the job cannot be stored");
    enum kd_status status = write_record(folder, record, error);
    close(folder);
    return status;
}

/* The folder has a temporary name until both documents are written, so that a job is stored either completely or not
 * at all. */
enum kd_status kd_job_store_create(struct kd_job_store *store, const struct kd_job_record *record, const void *request,
                                   size_t size, struct kd_error *error)
{
    char name[KD_JOB_NAME];
    snprintf(name, sizeof name, "%s.new", record->id);
    int folder = mkdirat(store->folder, name, 0700) ? -1 : kd_job_folder_open(store->folder, name);
    enum kd_status status;
    if (folder < 0)
        KD_TRY(kd_job_store_failed(error, "the job cannot be stored"));
    KD_TRY(write_record(folder, record, error));
    if (!kd_replace_file_at(folder, "request.json", request, size))
        KD_TRY(kd_job_store_failed(error, "the job cannot be stored"));
    if (renameat(store->folder, name, store->folder, record->id) || fsync(store->folder))
        KD_TRY(kd_job_store_failed(error, "the job cannot be stored"));
done:
    if (folder >= 0)
        close(folder);
    if (status) {
        kd_job_folder_remove(store->folder, name, UINT_MAX);
        kd_job_folder_remove(store->folder, record->id, UINT_MAX);
    }
    return status;
}

enum kd_status kd_job_store_request(const struct kd_job_store *store, const char *id, struct kd_buffer *out,
                                    struct kd_error *error)
{
    int folder = kd_job_folder_open(store->folder, id);
    bool good = folder >= 0 && kd_read_file(folder, "request.json", O_NOFOLLOW, KD_JOB_FILM_MAX, out);
    enum kd_status status = good ? KD_OK : kd_job_store_failed(error, "the request of a job cannot be read");
    if (folder >= 0)
        close(folder);
    return status;
}

enum kd_status kd_job_store_put(struct kd_job_store *store, const char *id, unsigned frame, const struct kd_buffer *png,
                                struct kd_error *error)
{
    char name[20];
    kd_job_folder_frame(frame, name);
    int folder = kd_job_folder_open(store->folder, id);
    bool good = folder >= 0 && kd_replace_file_at(folder, name, png->data, png->size);
    enum kd_status status = good ? KD_OK : kd_job_store_failed(error, "a frame cannot be stored");
    if (folder >= 0)
        close(folder);
    return status;
}

int kd_job_store_folder(const struct kd_job_store *store, const char *id)
{
    return kd_job_folder_open(store->folder, id);
}

bool kd_job_store_open_file(int folder, const char *name, struct kd_job_file *out)
{
    struct stat about;
    out->fd = openat(folder, name, O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (out->fd < 0)
        return false;
    if (fstat(out->fd, &about) || !S_ISREG(about.st_mode)) {
        close(out->fd);
        out->fd = -1;
        return false;
    }
    out->size = (uint64_t)about.st_size;
    /* Files are never modified; each write replaces the file by a new one. */
    snprintf(out->mark, sizeof out->mark, "%llx-%llx-%llx", (unsigned long long)about.st_ino,
             (unsigned long long)about.st_size,
             1000000000ull * (unsigned long long)about.st_mtim.tv_sec + (unsigned long long)about.st_mtim.tv_nsec);
    return true;
}

bool kd_job_store_get(const struct kd_job_store *store, const char *id, unsigned frame, struct kd_job_file *out)
{
    char name[20];
    kd_job_folder_frame(frame, name);
    int folder = kd_job_folder_open(store->folder, id);
    const bool there = folder >= 0 && kd_job_store_open_file(folder, name, out);
    if (folder >= 0)
        close(folder);
    return there;
}
