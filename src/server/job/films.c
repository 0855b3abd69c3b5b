#include "server/job/films.h"

#include "scene/sha256.h"
#include "server/job/job_internal.h"

#include <dirent.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* Finds a film in the list. Returns NULL if it is not there. Called with the lock held. */
static struct kd_job_stored_film *find(struct kd_job *job, const char *format, unsigned rate)
{
    for (unsigned i = 0; i < job->n_films; i++)
        if (job->films[i].name.rate == rate && !strcmp(job->films[i].name.format, format))
            return &job->films[i];
    return NULL;
}

/* Removes a film from the list. Called with the lock held. */
static void drop(struct kd_job *job, struct kd_job_stored_film *film)
{
    job->bytes -= film->bytes;
    job->all->bytes -= film->bytes;
    job->n_films--;
    memmove(film, film + 1, sizeof *film * (job->n_films - (size_t)(film - job->films)));
}

bool kd_job_film_open(struct kd_job *job, const char *format, unsigned rate, struct kd_job_file *out)
{
    char name[KD_JOB_FILM_NAME];
    struct kd_job_film_name film = { 0 };
    pthread_mutex_lock(&job->all->lock);
    const struct kd_job_stored_film *kept = find(job, format, rate);
    if (kept)
        film = kept->name;
    pthread_mutex_unlock(&job->all->lock);
    if (!film.rate)
        return false;
    kd_job_folder_film(&film, name);
    int folder = kd_job_store_folder(job->all->store, job->record.id);
    const bool there = folder >= 0 && kd_job_store_open_file(folder, name, out);
    if (folder >= 0)
        close(folder);
    if (there)
        memcpy(out->mark, film.hash, sizeof film.hash);
    return there;
}

bool kd_job_film_claim(struct kd_job_film_writer *w, struct kd_job *job, const char *format, unsigned rate)
{
    *w = (struct kd_job_film_writer) { .job = job, .folder = -1, .film.name.rate = rate };
    snprintf(w->film.name.format, sizeof w->film.name.format, "%s", format);
    sha256_init(&w->hash);
    pthread_mutex_lock(&job->all->lock);
    w->claimed = !job->filming && !find(job, format, rate);
    job->filming |= w->claimed;
    pthread_mutex_unlock(&job->all->lock);
    return w->claimed;
}

static enum kd_status begin(struct kd_job_film_writer *w, struct kd_error *error)
{
    char name[KD_JOB_FILM_NAME];
    kd_job_folder_new_film(w->film.name.format, w->film.name.rate, name);
    w->folder = kd_job_store_folder(w->job->all->store, w->job->record.id);
    w->begun = w->folder >= 0 && kd_replace_begin(w->folder, name, &w->file);
    return w->begun ? KD_OK : kd_job_store_failed(error, "the film cannot be stored");
}

enum kd_status kd_job_film_append(struct kd_job_film_writer *w, const void *data, size_t size, struct kd_error *error)
{
    enum kd_status status = KD_OK;
    if (!w->begun)
        KD_TRY(begin(w, error));
    if (!kd_replace_append(&w->file, data, size))
        KD_TRY(kd_job_store_failed(error, "the film cannot be stored"));
    sha256_update(&w->hash, size, data);
    w->film.bytes += size;
done:
    return status;
}

/* Reserves the bytes of the film, if the limit permits that. */
static enum kd_status reserve(const struct kd_job_film_writer *w, struct kd_error *error)
{
    struct kd_jobs *all = w->job->all;
    enum kd_status status = KD_OK;
    pthread_mutex_lock(&all->lock);
    if (!w->job->listed)
        status = kd_error_set(error, KD_EIO, "the job has been deleted");
    else if (w->film.bytes > all->params.bytes || all->bytes > all->params.bytes - w->film.bytes)
        status = kd_error_set(
            error, KD_EFULL, "the film has %.1f MB; with the %.1f MB of all jobs it exceeds the limit of %.1f MB",
            1e-6 * (double)w->film.bytes, 1e-6 * (double)all->bytes, 1e-6 * (double)all->params.bytes);
    else {
        all->bytes += w->film.bytes;
        w->job->bytes += w->film.bytes;
    }
    pthread_mutex_unlock(&all->lock);
    return status;
}

static void give_back(const struct kd_job_film_writer *w)
{
    pthread_mutex_lock(&w->job->all->lock);
    w->job->all->bytes -= w->film.bytes;
    w->job->bytes -= w->film.bytes;
    pthread_mutex_unlock(&w->job->all->lock);
}

/* Adds the film to the list. *oldest: name of the film that it replaces, or "". */
static void enter(const struct kd_job_film_writer *w, char oldest[KD_JOB_FILM_NAME])
{
    struct kd_job *job = w->job;
    *oldest = 0;
    pthread_mutex_lock(&job->all->lock);
    if (job->n_films == KD_JOB_FILMS) {
        kd_job_folder_film(&job->films[0].name, oldest);
        drop(job, &job->films[0]);
    }
    job->films[job->n_films++] = w->film;
    job->revision++;
    pthread_mutex_unlock(&job->all->lock);
}

enum kd_status kd_job_film_keep(struct kd_job_film_writer *w, struct kd_error *error)
{
    uint8_t digest[SHA256_DIGEST_SIZE];
    char name[KD_JOB_FILM_NAME], oldest[KD_JOB_FILM_NAME];
    enum kd_status status;
    sha256_digest(&w->hash, sizeof digest, digest);
    kd_sha256_text(digest, w->film.name.hash);
    kd_job_folder_film(&w->film.name, name);
    KD_TRY(reserve(w, error));
    w->begun = false;
    if (!kd_replace_commit(&w->file, name)) {
        status = kd_job_store_failed(error, "the film cannot be stored");
        unlinkat(w->folder, name, 0);
        give_back(w);
        return status;
    }
    enter(w, oldest);
    if (*oldest)
        unlinkat(w->folder, oldest, 0);
done:
    return status;
}

void kd_job_film_end(struct kd_job_film_writer *w)
{
    if (w->begun)
        kd_replace_abandon(&w->file);
    if (w->folder >= 0)
        close(w->folder);
    w->begun = false;
    w->folder = -1;
    if (!w->claimed)
        return;
    w->claimed = false;
    pthread_mutex_lock(&w->job->all->lock);
    w->job->filming = false;
    pthread_mutex_unlock(&w->job->all->lock);
}

static bool is_kept(int folder, const char *name, struct kd_job_stored_film *out)
{
    struct stat about;
    if (!kd_job_folder_read_film(name, &out->name) || fstatat(folder, name, &about, AT_SYMLINK_NOFOLLOW) ||
        !S_ISREG(about.st_mode))
        return false;
    out->bytes = (uint64_t)about.st_size;
    return true;
}

void kd_job_films_find(struct kd_job *job)
{
    struct kd_job_stored_film film;
    int folder = kd_job_store_folder(job->all->store, job->record.id);
    DIR *d = folder < 0 ? NULL : fdopendir(folder);
    for (struct dirent *entry; d && (entry = readdir(d));) {
        if (!is_kept(folder, entry->d_name, &film))
            continue;
        if (job->n_films == KD_JOB_FILMS || find(job, film.name.format, film.name.rate)) {
            unlinkat(folder, entry->d_name, 0);
            continue;
        }
        job->films[job->n_films++] = film;
        job->bytes += film.bytes;
    }
    if (d)
        closedir(d);
    else if (folder >= 0)
        close(folder);
}
