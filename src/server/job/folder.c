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

/* A file that kerrd writes into a job's folder, or the beginning of one. */
static bool is_ours(const char *name)
{
    static const char *const documents[] = { "job.json", "request.json" };
    for (size_t i = 0; i < sizeof documents / sizeof *documents; i++)
        if (!strcmp(name, documents[i]) || kd_replace_is_temporary(name, documents[i]))
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
        kd_log(KD_LOG_WARN, "the folder of job %.4s... is left: %s", name, strerror(errno));
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
