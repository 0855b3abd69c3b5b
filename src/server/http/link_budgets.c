#include "server/http/link_budgets.h"

#include "base/log.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* The file consists of this header and the entries, in the byte order of the machine. */
static const char HEAD[24] = "kerrd link budgets 1\n";

struct place {
    uint64_t id, expires_s; /* expires_s 0: unused */
    double ms;
};
_Static_assert(sizeof(struct place) == 24, "places in the file have no padding");

struct kd_link_budgets {
    pthread_mutex_t lock; /* guards the entries; held for some 10 us at a time */
    /* held while an entry is written to the file, so that an older state never overwrites a newer one */
    pthread_mutex_t write;
    int fd;      /* -1: no file */
    bool failed; /* true if a write failure was already logged; guarded by `write` */
    struct place places[KD_LINK_BUDGETS];
};

struct kd_link_budgets *kd_link_budgets_create(void)
{
    struct kd_link_budgets *all = calloc(1, sizeof *all);
    if (!all)
        return NULL;
    all->fd = -1;
    pthread_mutex_init(&all->lock, NULL);
    pthread_mutex_init(&all->write, NULL);
    return all;
}

void kd_link_budgets_destroy(struct kd_link_budgets *all)
{
    if (!all)
        return;
    if (all->fd >= 0)
        close(all->fd);
    pthread_mutex_destroy(&all->lock);
    pthread_mutex_destroy(&all->write);
    free(all);
}

static bool is_sound(const struct place *p)
{
    return p->expires_s <= KD_LINK_LATEST_S && p->ms >= 0 && isfinite(p->ms);
}

/* Reads the entries, or writes the header of a new file. On failure returns false with errno; EILSEQ means that this
 * is not a file of link budgets. */
static bool read_places(struct kd_link_budgets *all)
{
    char head[sizeof HEAD];
    const ssize_t n = pread(all->fd, head, sizeof head, 0);
    if (!n)
        return pwrite(all->fd, HEAD, sizeof HEAD, 0) == sizeof HEAD;
    if (n < 0)
        return false;
    errno = EILSEQ;
    if (n < (ssize_t)sizeof head || memcmp(head, HEAD, sizeof head))
        return false;
    char *const to = (char *)all->places;
    for (size_t done = 0; done < sizeof all->places;) {
        const ssize_t got = pread(all->fd, to + done, sizeof all->places - done, (off_t)(sizeof HEAD + done));
        if (got < 0)
            return false;
        if (!got)
            break;
        done += (size_t)got;
    }
    for (struct place *p = all->places; p < all->places + KD_LINK_BUDGETS; p++)
        if (!is_sound(p))
            *p = (struct place) { 0 };
    return true;
}

enum kd_status kd_link_budgets_open(struct kd_link_budgets *all, const char *state, struct kd_error *error)
{
    struct stat about;
    const int folder = open(state, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (folder >= 0)
        all->fd = openat(folder, KD_LINK_BUDGETS_FILE, O_RDWR | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0600);
    bool done = all->fd >= 0 && !fstat(all->fd, &about);
    if (done && !S_ISREG(about.st_mode)) {
        errno = EILSEQ;
        done = false;
    }
    done = done && read_places(all);
    const int why = errno;
    if (folder >= 0)
        close(folder);
    if (done)
        return KD_OK;
    return kd_error_set(error, KD_EINVAL, why == EILSEQ ? "%s/%s is not a file of link budgets%s" : "%s/%s: %s", state,
                        KD_LINK_BUDGETS_FILE, why == EILSEQ ? "; remove it, or use another folder" : strerror(why));
}

/* Returns the entry of a link. If the link has none, returns an unused entry, or the entry of an expired link.
 * Returns NULL if there is none of these. */
static struct place *place_of(struct kd_link_budgets *all, const struct kd_link *link, uint64_t now_s)
{
    struct place *unused = NULL;
    for (size_t i = 0; i < KD_LINK_BUDGETS; i++) {
        struct place *place = &all->places[i];
        if (place->expires_s && place->id == link->id)
            return place;
        if (!unused && (!place->expires_s || place->expires_s + KD_LINK_LEEWAY_S < now_s))
            unused = place;
    }
    return unused;
}

enum kd_link_left kd_link_budget(struct kd_link_budgets *all, const struct kd_link *link, uint64_t now_s)
{
    if (!link->terms.budget_ms)
        return KD_LINK_LEFT;
    pthread_mutex_lock(&all->lock);
    const struct place *place = place_of(all, link, now_s);
    const bool spent = place && place->id == link->id && place->ms >= (double)link->terms.budget_ms;
    pthread_mutex_unlock(&all->lock);
    return !place ? KD_LINK_CROWDED : spent ? KD_LINK_SPENT : KD_LINK_LEFT;
}

/* Writes the present content of an entry to the file. */
static void keep(struct kd_link_budgets *all, size_t i)
{
    if (all->fd < 0)
        return;
    pthread_mutex_lock(&all->write);
    pthread_mutex_lock(&all->lock);
    const struct place now = all->places[i];
    pthread_mutex_unlock(&all->lock);
    const bool failed = pwrite(all->fd, &now, sizeof now, (off_t)(sizeof HEAD + i * sizeof now)) != sizeof now;
    if (failed && !all->failed)
        kd_log(KD_LOG_WARN, "the device time that signed links have used cannot be written: %s", strerror(errno));
    all->failed = failed;
    pthread_mutex_unlock(&all->write);
}

void kd_link_charge(struct kd_link_budgets *all, const struct kd_link *link, double ms, uint64_t now_s)
{
    if (!link->terms.budget_ms)
        return;
    pthread_mutex_lock(&all->lock);
    struct place *const place = place_of(all, link, now_s);
    if (place && (place->id != link->id || !place->expires_s))
        *place = (struct place) { link->id, link->terms.expires_s, 0 };
    if (place)
        place->ms += ms;
    pthread_mutex_unlock(&all->lock);
    if (place)
        keep(all, (size_t)(place - all->places));
}
