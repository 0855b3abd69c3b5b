#include "server/job/folder.h"

#include "base/log.h"
#include "base/replace.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#define NEW ".new"
#define DIGITS "0123456789"

bool kd_job_folder_is_id(const char *name)
{
    return strlen(name) == KD_SECRET_ID - 1 && strspn(name, DIGITS "abcdef") == KD_SECRET_ID - 1;
}

bool kd_job_folder_is_new(const char *name)
{
    return strlen(name) == KD_SECRET_ID - 1 + strlen(NEW) && strspn(name, DIGITS "abcdef") == KD_SECRET_ID - 1 &&
           !strcmp(name + KD_SECRET_ID - 1, NEW);
}

void kd_job_folder_frame(unsigned frame, char name[20]) { snprintf(name, 20, "%06u.png", frame); }

int kd_job_folder_open(int jobs, const char *name)
{
    return openat(jobs, name, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
}

static const char *const films[] = { "mp4", "webm" };

void kd_job_folder_film(const struct kd_job_film_name *film, char name[KD_JOB_FILM_NAME])
{
    snprintf(name, KD_JOB_FILM_NAME, "film-%03u-%s.%s", film->rate, film->hash, film->format);
}

void kd_job_folder_new_film(const char *format, unsigned rate, char name[KD_JOB_FILM_NAME])
{
    snprintf(name, KD_JOB_FILM_NAME, "film-%03u.%s", rate, format);
}

bool kd_job_folder_read_film(const char *name, struct kd_job_film_name *out)
{
    char again[KD_JOB_FILM_NAME];
    *out = (struct kd_job_film_name) { 0 };
    if (sscanf(name, "film-%3u-%64[0-9a-f].%4s", &out->rate, out->hash, out->format) != 3 || strlen(out->hash) != 64)
        return false;
    kd_job_folder_film(out, again);
    return !strcmp(again, name) && (!strcmp(out->format, films[0]) || !strcmp(out->format, films[1]));
}

/* True if a finished or unfinished film has this name. */
static bool is_film(const char *name)
{
    struct kd_job_film_name film;
    char beginning[KD_JOB_FILM_NAME];
    if (kd_job_folder_read_film(name, &film))
        return true;
    for (size_t i = 0; i < sizeof films / sizeof *films && sscanf(name, "film-%3u.", &film.rate) == 1; i++) {
        kd_job_folder_new_film(films[i], film.rate, beginning);
        if (kd_replace_is_temporary(name, beginning))
            return true;
    }
    return false;
}

/* True if this is the name of a file that kerrd writes, finished or unfinished. */
static bool is_ours(const char *name)
{
    static const char *const documents[] = { "job.json", "request.json" };
    for (size_t i = 0; i < sizeof documents / sizeof *documents; i++)
        if (!strcmp(name, documents[i]) || kd_replace_is_temporary(name, documents[i]))
            return true;
    if (is_film(name))
        return true;
    char frame[11];
    if (strspn(name, DIGITS) != 6 || strncmp(name + 6, ".png", 4))
        return false;
    memcpy(frame, name, 10);
    frame[10] = 0;
    return !name[10] || kd_replace_is_temporary(name, frame);
}

static bool is_temporary(const char *name) { return is_ours(name) && strstr(name, KD_TEMPORARY_MARK); }

static DIR *list(int folder)
{
    int fd = openat(folder, ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    DIR *d = fd < 0 ? NULL : fdopendir(fd);
    if (fd >= 0 && !d)
        close(fd);
    return d;
}

bool kd_job_folder_remove(int jobs, const char *name, unsigned most)
{
    int folder = kd_job_folder_open(jobs, name);
    DIR *d = folder < 0 ? NULL : list(folder);
    bool all = true;
    for (struct dirent *entry; d && all && (entry = readdir(d));)
        if (strcmp(entry->d_name, "job.json") && is_ours(entry->d_name)) {
            all = most > 0;
            if (most) {
                most--;
                unlinkat(folder, entry->d_name, 0);
            }
        }
    if (d && all)
        unlinkat(folder, "job.json", 0);
    if (d && all && unlinkat(jobs, name, AT_REMOVEDIR) && errno != ENOENT)
        kd_log(KD_LOG_WARN, "the folder of job %.4s... cannot be removed: %s", name, strerror(errno));
    if (d)
        closedir(d);
    if (folder >= 0)
        close(folder);
    return all;
}

void kd_job_folder_tidy(int folder)
{
    DIR *d = list(folder);
    for (struct dirent *entry; d && (entry = readdir(d));)
        if (is_temporary(entry->d_name))
            unlinkat(folder, entry->d_name, 0);
    if (d)
        closedir(d);
}

void kd_job_folder_empty(int jobs)
{
    DIR *d = list(jobs);
    for (struct dirent *entry; d && (entry = readdir(d));)
        if (kd_job_folder_is_id(entry->d_name) || kd_job_folder_is_new(entry->d_name))
            kd_job_folder_remove(jobs, entry->d_name, UINT_MAX);
    if (d)
        closedir(d);
    unlinkat(jobs, "lock", 0);
}
