/* Names and removes the files of a job, and no others; never follows a link. Private to store.c.
 *
 * The folder of all jobs holds a file `lock` and one folder for each job, named by the job's ID. Until a new job is
 * completely written, its folder is named ID.new. */
#ifndef KD_SERVER_JOB_FOLDER_H
#define KD_SERVER_JOB_FOLDER_H

#include "server/http/secret.h"

#include <stdbool.h>

enum { KD_JOB_NAME = KD_SECRET_ID + 4 }; /* size of the name of a job's folder, including ".new" */

bool kd_job_folder_is_id(const char *name);
bool kd_job_folder_is_new(const char *name); /* true if the name has the form ID.new */

void kd_job_folder_frame(unsigned frame, char name[20]); /* "000000.png" */

/* Name of a film: "film-024-HASH.mp4". 024 is the frame rate in 1/s, and HASH the SHA-256 of the bytes. */
enum { KD_JOB_FILM_NAME = 5 + 3 + 1 + 64 + 1 + 4 + 1 };
struct kd_job_film_name {
    unsigned rate;
    char hash[65], format[5];
};
void kd_job_folder_film(const struct kd_job_film_name *film, char name[KD_JOB_FILM_NAME]);
/* returns false if this is not the name of a film */
bool kd_job_folder_read_film(const char *name, struct kd_job_film_name *out);
/* Name of a film while it is written, before its hash is known: "film-024.mp4". */
void kd_job_folder_new_film(const char *format, unsigned rate, char name[KD_JOB_FILM_NAME]);

/* Opens a job's folder. Returns a descriptor, or -1 with errno, which is ELOOP or ENOTDIR if this is not a folder. */
int kd_job_folder_open(int jobs, const char *name);

/* Removes at most `most` files of a job. job.json is removed last, because it identifies the folder as that of a
 * job. Then removes the folder, unless it contains other files. Returns true when no more files can be removed. */
bool kd_job_folder_remove(int jobs, const char *name, unsigned most);

/* Removes unfinished files that a killed server has left in a job's folder. All other files stay, even if their
 * names begin in the same way. */
void kd_job_folder_tidy(int folder);
/* Removes all jobs in a folder, and then the lock file. */
void kd_job_folder_empty(int jobs);

#endif
