#include "server/job_store.h"

#include "base/log.h"
#include "base/replace.h"

#include <cjson/cJSON.h>
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

struct kd_job_store {
    char *directory;
    bool temporary;
    int lock;
};

static const char *const states[] = { [KD_JOB_ACTIVE] = "active", [KD_JOB_DONE] = "done", [KD_JOB_FAILED] = "failed" };

static enum kd_status failed(struct kd_error *error, const char *what, const char *where)
{
    return kd_error_set(error, KD_EIO, "%s in %.300s: %s", what, where, strerror(errno));
}

static bool path_of(const struct kd_job_store *store, const char *id, const char *name, char out[PATH_MAX])
{
    return snprintf(out, PATH_MAX, "%s/%s%s%s", store->directory, id, *name ? "/" : "", name) < PATH_MAX;
}

static bool frame_path(const struct kd_job_store *store, const char *id, unsigned frame, char out[PATH_MAX])
{
    char name[20];
    snprintf(name, sizeof name, "%06u.png", frame);
    return path_of(store, id, name, out);
}

static bool is_id(const char *name) { return strlen(name) == KD_SECRET_ID - 1 && strspn(name, "0123456789abcdef") == KD_SECRET_ID - 1; }

static enum kd_status open_temporary(struct kd_job_store *store, struct kd_error *error)
{
    const char *parent = getenv("TMPDIR");
    if (asprintf(&store->directory, "%s/kerrd-jobs-XXXXXX", parent && *parent ? parent : "/tmp") < 0) {
        store->directory = NULL;
        return kd_error_set(error, KD_ENOMEM, "out of memory");
    }
    if (!mkdtemp(store->directory))
        return failed(error, "a folder for jobs cannot be made", parent && *parent ? parent : "/tmp");
    store->temporary = true;
    return KD_OK;
}

/* Two servers that went on with the same jobs would do everything twice. */
static enum kd_status open_state(struct kd_job_store *store, const char *state, struct kd_error *error)
{
    char path[PATH_MAX];
    if (asprintf(&store->directory, "%s/jobs", state) < 0) {
        store->directory = NULL;
        return kd_error_set(error, KD_ENOMEM, "out of memory");
    }
    if (!path_of(store, "lock", "", path))
        return kd_error_set(error, KD_EINVAL, "the path of the state folder is too long");
    if (((mkdir(state, 0700) && errno != EEXIST) || (mkdir(store->directory, 0700) && errno != EEXIST)))
        return failed(error, "jobs cannot be kept", state);
    store->lock = open(path, O_CREAT | O_RDWR | O_CLOEXEC, 0600);
    if (store->lock < 0)
        return failed(error, "jobs cannot be kept", state);
    if (flock(store->lock, LOCK_EX | LOCK_NB))
        return kd_error_set(error, KD_EIO, "another server keeps its jobs in %.300s", state);
    return KD_OK;
}

enum kd_status kd_job_store_open(const char *state, struct kd_job_store **out, struct kd_error *error)
{
    struct kd_job_store *store = calloc(1, sizeof *store);
    if (!store)
        return kd_error_set(error, KD_ENOMEM, "out of memory");
    store->lock = -1;
    enum kd_status status = state ? open_state(store, state, error) : open_temporary(store, error);
    if (status)
        kd_job_store_close(store);
    else
        *out = store;
    return status;
}

/* True when there is nothing left, or nothing that could be removed. */
static bool remove_files(const char *directory, unsigned most)
{
    DIR *d = opendir(directory);
    for (struct dirent *entry; d && (entry = readdir(d));) {
        if (!strcmp(entry->d_name, ".") || !strcmp(entry->d_name, ".."))
            continue;
        if (!most--) {
            closedir(d);
            return false;
        }
        unlinkat(dirfd(d), entry->d_name, 0);
    }
    if (d)
        closedir(d);
    if (d && rmdir(directory))
        kd_log(KD_LOG_WARN, "%s cannot be removed: %s", directory, strerror(errno));
    return true;
}

void kd_job_store_forget(struct kd_job_store *store, const char *id)
{
    char path[PATH_MAX];
    if (path_of(store, id, "request.json", path))
        unlink(path);
}

bool kd_job_store_remove(struct kd_job_store *store, const char *id, unsigned most)
{
    char path[PATH_MAX];
    kd_job_store_forget(store, id);
    return !path_of(store, id, "", path) || remove_files(path, most);
}

void kd_job_store_close(struct kd_job_store *store)
{
    if (!store)
        return;
    DIR *d = store->temporary ? opendir(store->directory) : NULL;
    for (struct dirent *entry; d && (entry = readdir(d));)
        if (is_id(entry->d_name))
            kd_job_store_remove(store, entry->d_name, UINT_MAX);
    if (d)
        closedir(d);
    if (store->temporary)
        rmdir(store->directory);
    if (store->lock >= 0)
        close(store->lock);
    free(store->directory);
    free(store);
}

static bool read_file(const char *path, struct kd_buffer *out)
{
    char part[65536];
    size_t n;
    FILE *file = fopen(path, "re");
    bool good = file;
    while (good && (n = fread(part, 1, sizeof part, file)))
        good = !kd_buffer_append(out, part, n);
    good = good && !ferror(file);
    if (file)
        fclose(file);
    return good;
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

static bool read_record(const cJSON *o, const char *id, struct kd_job_record *out)
{
    char state[10];
    *out = (struct kd_job_record) { .created = number(o, "created"), .ended = number(o, "ended") };
    if (number(o, "format") != 1 || !copy_text(o, "id", out->id, sizeof out->id) || strcmp(out->id, id) ||
        !copy_text(o, "token", out->token, sizeof out->token) || strlen(out->token) != KD_SECRET_TOKEN - 1 ||
        !copy_text(o, "error", out->error, sizeof out->error) || !copy_text(o, "state", state, sizeof state))
        return false;
    if (!copy_text(o, "preset", out->preset, sizeof out->preset)) /* jobs of versions without have none */
        *out->preset = 0;
    double attempts = number(o, "attempts");
    out->attempts = attempts > 0 && attempts < 1e6 ? (unsigned)attempts : 0;
    for (int i = 0; i < (int)(sizeof states / sizeof *states); i++)
        if (!strcmp(state, states[i])) {
            out->state = (enum kd_job_state)i;
            return true;
        }
    return false;
}

struct found {
    struct kd_job_record record;
    struct kd_buffer request;
};

static bool load(struct kd_job_store *store, const char *id, struct found *out)
{
    char path[PATH_MAX];
    struct kd_buffer text = { 0 };
    *out = (struct found) { 0 };
    bool good = path_of(store, id, "job.json", path) && read_file(path, &text);
    cJSON *o = good ? cJSON_ParseWithLength((const char *)text.data, text.size) : NULL;
    good = o && read_record(o, id, &out->record) && path_of(store, id, "request.json", path) && read_file(path, &out->request);
    if (!good)
        kd_buffer_finish(&out->request);
    cJSON_Delete(o);
    kd_buffer_finish(&text);
    return good;
}

static int by_age(const void *a, const void *b)
{
    double x = ((const struct found *)a)->record.created, y = ((const struct found *)b)->record.created;
    return x < y ? -1 : x > y;
}

enum kd_status kd_job_store_load(struct kd_job_store *store,
                                 void (*found)(void *user, const struct kd_job_record *record, struct kd_buffer *request), void *user,
                                 struct kd_error *error)
{
    struct found *all = NULL;
    size_t n = 0;
    enum kd_status status = KD_OK;
    DIR *d = opendir(store->directory);
    if (!d)
        return failed(error, "jobs cannot be read", store->directory);
    for (struct dirent *entry; !status && (entry = readdir(d));) {
        if (!is_id(entry->d_name))
            continue;
        struct found *more = realloc(all, (n + 1) * sizeof *all);
        if (!more) {
            status = kd_error_set(error, KD_ENOMEM, "out of memory for the jobs in %.300s", store->directory);
            break;
        }
        all = more;
        if (load(store, entry->d_name, &all[n]))
            n++;
        else
            kd_job_store_remove(store, entry->d_name, UINT_MAX);
    }
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

enum kd_status kd_job_store_update(struct kd_job_store *store, const struct kd_job_record *record, struct kd_error *error)
{
    char path[PATH_MAX];
    cJSON *o = cJSON_CreateObject();
    cJSON_AddNumberToObject(o, "format", 1);
    cJSON_AddStringToObject(o, "id", record->id);
    cJSON_AddStringToObject(o, "token", record->token);
    cJSON_AddStringToObject(o, "state", states[record->state]);
    cJSON_AddNumberToObject(o, "created", record->created);
    cJSON_AddNumberToObject(o, "ended", record->ended);
    cJSON_AddNumberToObject(o, "attempts", record->attempts);
    cJSON_AddStringToObject(o, "preset", record->preset);
    cJSON_AddStringToObject(o, "error", record->error);
    char *text = cJSON_PrintUnformatted(o);
    cJSON_Delete(o);
    enum kd_status status = text ? KD_OK : kd_error_set(error, KD_ENOMEM, "out of memory for a job");
    if (!status && !(path_of(store, record->id, "job.json", path) && kd_replace_file(path, text, strlen(text))))
        status = failed(error, "a job cannot be kept", store->directory);
    cJSON_free(text);
    return status;
}

enum kd_status kd_job_store_create(struct kd_job_store *store, const struct kd_job_record *record, const void *request, size_t size,
                                   struct kd_error *error)
{
    char path[PATH_MAX];
    enum kd_status status = kd_job_store_update(store, record, error); /* makes the folder */
    if (!status && !(path_of(store, record->id, "request.json", path) && kd_replace_file(path, request, size)))
        status = failed(error, "a job cannot be kept", store->directory);
    if (status)
        kd_job_store_remove(store, record->id, UINT_MAX);
    return status;
}

enum kd_status kd_job_store_put(struct kd_job_store *store, const char *id, unsigned frame, const struct kd_buffer *png,
                                struct kd_error *error)
{
    char path[PATH_MAX];
    if (frame_path(store, id, frame, path) && kd_replace_file(path, png->data, png->size))
        return KD_OK;
    return failed(error, "a frame cannot be kept", store->directory);
}

uint64_t kd_job_store_size(const struct kd_job_store *store, const char *id, unsigned frame)
{
    char path[PATH_MAX];
    struct stat about;
    return frame_path(store, id, frame, path) && !stat(path, &about) ? (uint64_t)about.st_size : 0;
}

int kd_job_store_get(const struct kd_job_store *store, const char *id, unsigned frame, uint64_t *size)
{
    char path[PATH_MAX];
    struct stat about;
    int fd = frame_path(store, id, frame, path) ? open(path, O_RDONLY | O_CLOEXEC) : -1;
    if (fd >= 0 && fstat(fd, &about)) {
        close(fd);
        return -1;
    }
    if (fd >= 0)
        *size = (uint64_t)about.st_size;
    return fd;
}
