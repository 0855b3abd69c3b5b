#include "server/http/connections.h"

#include "base/clock.h"
#include "server/http/problem.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <linux/sockios.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

/* deadline in ms of an idle connection; it is longer than libmicrohttpd's idle timeout, so it ends only connections
 * that send single bytes */
#define IDLE_MS 60e3
#define CROWDED_MS 2e3 /* time in ms in which a connection beyond the limit must send its header */
/* time in ms in which a client must read an answer; large answers get more time (BYTES_PER_MS) */
#define REPLY_MS 30e3
/* an answer gets one more millisecond for this number of bytes: 32 kB/s, the speed of a poor mobile connection */
#define BYTES_PER_MS 32

/* time in ms within which a client that reads at all reads some bytes, even over a slow connection */
#define STALL_MS 2e3
/* LINGER_MS: time for which a socket is drained, which is enough for several round trips and a few MiB. LINGER_BYTES:
 * limit of the drained bytes; if the client sends more, the connection is reset. */
#define LINGER_MS 2e3
#define LINGER_BYTES ((size_t)16 << 20)
#define LINGERING 64 /* maximum number of sockets that are drained at a time */
/* silent connections are closed if there are more connections than those of kd_connections_most and this number */
#define SILENT 32

struct kd_connection {
    struct kd_connection *previous, *next;
    int socket;
    char client[KD_CLIENT];
    bool linger, handed_on, health, cut; /* cut: true if the socket was shut down to make room */
    size_t discarded;
    enum kd_stage stage;
    double deadline;   /* time on the clock of kd_clock_ms; 0: there is no deadline */
    int unsent;        /* number of unsent bytes in the socket at the last check */
    double stalled_ms; /* time when `unsent` last changed; 0: it was not checked yet */
};

struct kd_connections {
    pthread_mutex_t lock;
    struct kd_connection *first;
    unsigned count, limit, share; /* count: number of open connections, without those to the health routes */
    unsigned n_handed_on, n_health;
    struct kd_connection *lingering; /* linked list of removed connections whose sockets are being drained */
    unsigned n_lingering;
    double header_ms, body_ms;
};

struct kd_connections *kd_connections_create(unsigned limit, unsigned share, unsigned header_ms, unsigned body_ms)
{
    struct kd_connections *all = calloc(1, sizeof *all);
    if (!all)
        return NULL;
    all->limit = limit;
    all->share = share;
    all->header_ms = header_ms;
    all->body_ms = body_ms;
    pthread_mutex_init(&all->lock, NULL);
    return all;
}

static void drop(struct kd_connections *all, struct kd_connection **link)
{
    struct kd_connection *one = *link;
    *link = one->next;
    all->n_lingering--;
    close(one->socket);
    free(one);
}

void kd_connections_destroy(struct kd_connections *all)
{
    if (!all)
        return;
    while (all->lingering)
        drop(all, &all->lingering);
    pthread_mutex_destroy(&all->lock);
    free(all);
}

static struct kd_connection *find(const struct kd_connections *all, int socket)
{
    struct kd_connection *one = all->first;
    while (one && one->socket != socket)
        one = one->next;
    return one;
}

static void unlink_one(struct kd_connections *all, struct kd_connection *one)
{
    if (one->previous)
        one->previous->next = one->next;
    else
        all->first = one->next;
    if (one->next)
        one->next->previous = one->previous;
    all->count -= !one->health;
    all->n_health -= one->health;
    all->n_handed_on -= one->handed_on && !one->health;
}

struct kd_connection *kd_connections_add(struct kd_connections *all, int socket, const char *client)
{
    struct kd_connection *one = calloc(1, sizeof *one);
    if (!one)
        return NULL;
    one->socket = socket;
    snprintf(one->client, sizeof one->client, "%s", client);
    pthread_mutex_lock(&all->lock);
    /* An old entry with this socket is stale: the library must have closed that connection without a callback,
     * because the number of the socket is in use again. */
    struct kd_connection *stale = find(all, socket);
    if (stale) {
        unlink_one(all, stale);
        free(stale);
    }
    one->next = all->first;
    if (one->next)
        one->next->previous = one;
    all->first = one;
    all->count++;
    bool crowded = all->count > all->limit;
    one->deadline = kd_clock_ms() + (crowded && all->header_ms > CROWDED_MS ? CROWDED_MS : all->header_ms);
    pthread_mutex_unlock(&all->lock);
    return one;
}

/* Shuts down the oldest connection to the health routes. A real health check sends its request at once, so the
 * oldest connection must have been answered long ago. */
static void cut_oldest_health(struct kd_connections *all)
{
    struct kd_connection *oldest = NULL;
    unsigned alive = 0;
    for (struct kd_connection *one = all->first; one; one = one->next)
        if (one->health && !one->cut)
            oldest = one, alive++;
    if (alive <= KD_HEALTH_CONNECTIONS)
        return;
    oldest->cut = true;
    oldest->deadline = 0;
    shutdown(oldest->socket, SHUT_RDWR);
}

/* Counts the connections of the client to which `one` belongs, including `one`. handed_on: true counts only
 * connections that were handed to a daemon. */
static unsigned of_client(const struct kd_connections *all, const struct kd_connection *one, bool handed_on)
{
    unsigned n = 0;
    for (const struct kd_connection *other = all->first; other; other = other->next)
        n += !other->health && (other == one || !handed_on || other->handed_on) && !strcmp(other->client, one->client);
    return n;
}

enum kd_handed kd_connections_hand_on(struct kd_connections *all, struct kd_connection *one, bool health)
{
    pthread_mutex_lock(&all->lock);
    bool over = !health && all->share < all->limit && of_client(all, one, true) > all->share;
    bool yes = health || (!over && all->n_handed_on < kd_connections_most(all->limit));
    one->handed_on = yes;
    if (health) {
        one->health = true;
        one->deadline = kd_clock_ms() + (all->header_ms > CROWDED_MS ? CROWDED_MS : all->header_ms);
        all->count--;
        all->n_health++;
        cut_oldest_health(all);
    } else if (yes) {
        all->n_handed_on++;
    }
    pthread_mutex_unlock(&all->lock);
    return yes ? KD_HANDED_ON : over ? KD_OVER_SHARE : KD_OVER_LIMIT;
}

struct kd_connection *kd_connections_find(struct kd_connections *all, int socket)
{
    pthread_mutex_lock(&all->lock);
    struct kd_connection *one = find(all, socket);
    pthread_mutex_unlock(&all->lock);
    return one;
}

bool kd_connection_is_health(const struct kd_connection *one) { return one && one->health; }

/* Duplicates the socket's descriptor, so that the socket stays open when the library closes its own descriptor. */
static bool keep(struct kd_connections *all, struct kd_connection *one)
{
    int socket = all->n_lingering < LINGERING ? fcntl(one->socket, F_DUPFD_CLOEXEC, 0) : -1;
    if (socket < 0)
        return false;
    shutdown(socket, SHUT_WR);
    one->socket = socket;
    one->deadline = kd_clock_ms() + LINGER_MS;
    one->next = all->lingering;
    all->lingering = one;
    all->n_lingering++;
    return true;
}

void kd_connections_remove(struct kd_connections *all, struct kd_connection *one)
{
    if (!one)
        return;
    pthread_mutex_lock(&all->lock);
    unlink_one(all, one);
    bool kept = one->linger && keep(all, one);
    pthread_mutex_unlock(&all->lock);
    if (!kept)
        free(one);
}

void kd_connection_linger(struct kd_connection *one)
{
    if (one)
        one->linger = true;
}

int kd_connection_socket(const struct kd_connection *one) { return one->socket; }

static double allowance(const struct kd_connections *all, enum kd_stage stage, unsigned long bytes)
{
    switch (stage) {
    case KD_STAGE_OPEN:
    case KD_STAGE_HEADER: return all->header_ms;
    case KD_STAGE_BODY: return all->body_ms + (double)bytes / BYTES_PER_MS;
    case KD_STAGE_WORK: return 0;
    case KD_STAGE_REPLY: return REPLY_MS + (double)bytes / BYTES_PER_MS;
    case KD_STAGE_IDLE: return IDLE_MS;
    }
    return 0;
}

void kd_connections_stage(struct kd_connections *all, struct kd_connection *one, enum kd_stage stage,
                          unsigned long bytes)
{
    if (!one)
        return;
    pthread_mutex_lock(&all->lock);
    double ms = allowance(all, stage, bytes);
    one->stage = stage;
    one->deadline = ms > 0 ? kd_clock_ms() + ms : 0;
    pthread_mutex_unlock(&all->lock);
}

void kd_connections_refuse(struct kd_connections *all, int socket, enum kd_problem_type type, const char *detail)
{
    pthread_mutex_lock(&all->lock);
    struct kd_connection *one = find(all, socket);
    if (one && one->stage != KD_STAGE_WORK && one->stage != KD_STAGE_REPLY) {
        kd_problem_send_raw(socket, type, detail, NULL);
        one->linger = true;
        shutdown(socket, SHUT_WR);
    }
    pthread_mutex_unlock(&all->lock);
}

bool kd_connections_crowded(struct kd_connections *all, const struct kd_connection *one)
{
    pthread_mutex_lock(&all->lock);
    bool crowded = all->count > all->limit && (!one || of_client(all, one, false) > all->limit - all->share);
    pthread_mutex_unlock(&all->lock);
    return crowded;
}

/* The daemon accepts more connections than are served, so that a connection beyond the limit gets an answer with the
 * reason for its refusal. */
unsigned kd_connections_most(unsigned limit) { return limit + limit / 4 + 16; }

bool kd_connections_full(struct kd_connections *all)
{
    pthread_mutex_lock(&all->lock);
    bool full = all->count > kd_connections_most(all->limit) + SILENT;
    pthread_mutex_unlock(&all->lock);
    return full;
}

/* Answers a late request with 408. In the stages concerned, no part of an answer was sent yet, so the whole answer
 * can be written directly to the socket. */
static void answer_late(const struct kd_connection *one)
{
    if (one->stage == KD_STAGE_HEADER)
        kd_problem_send_raw(one->socket, KD_PROBLEM_TIMEOUT, "the request's header took too long to arrive", NULL);
    else if (one->stage == KD_STAGE_BODY)
        kd_problem_send_raw(one->socket, KD_PROBLEM_TIMEOUT, "the request's body took too long to arrive", NULL);
}

/* Discards the bytes that have arrived, but at most 1 MiB per sweep, because the lock is held. Returns false if the
 * client has closed its end, or has sent more than LINGER_BYTES. */
static bool empty(struct kd_connection *one)
{
    enum { READS = 64 };
    char scrap[16384];
    ssize_t n = 0;
    for (int i = 0; i < READS && (n = recv(one->socket, scrap, sizeof scrap, MSG_DONTWAIT)) > 0; i++)
        if ((one->discarded += (size_t)n) > LINGER_BYTES)
            return false;
    return n > 0 || (n < 0 && (errno == EAGAIN || errno == EINTR));
}

static void empty_lingering(struct kd_connections *all, double now)
{
    for (struct kd_connection **link = &all->lingering; *link;) {
        if (now < (*link)->deadline && empty(*link))
            link = &(*link)->next;
        else
            drop(all, link);
    }
}

/* True if a request has arrived that its daemon has not read yet. The deadline does not apply to such a request. */
static bool waits_for_us(const struct kd_connection *one)
{
    int unread = 0;
    return one->handed_on && (one->stage == KD_STAGE_OPEN || one->stage == KD_STAGE_IDLE) &&
           !ioctl(one->socket, FIONREAD, &unread) && unread > 0;
}

void kd_connections_sweep(struct kd_connections *all)
{
    pthread_mutex_lock(&all->lock);
    double now = kd_clock_ms();
    for (struct kd_connection *one = all->first; one; one = one->next) {
        if (one->deadline <= 0 || now < one->deadline || waits_for_us(one))
            continue;
        answer_late(one);
        shutdown(one->socket, SHUT_RDWR);
        one->deadline = 0;
    }
    empty_lingering(all, now);
    pthread_mutex_unlock(&all->lock);
}

void kd_connections_cut_stalled(struct kd_connections *all)
{
    double now = kd_clock_ms();
    pthread_mutex_lock(&all->lock);
    for (struct kd_connection *one = all->first; one; one = one->next) {
        int unsent = 0;
        if (ioctl(one->socket, SIOCOUTQ, &unsent) || !unsent || unsent != one->unsent || !(one->stalled_ms > 0)) {
            one->unsent = unsent;
            one->stalled_ms = now;
        } else if (now - one->stalled_ms > STALL_MS) {
            shutdown(one->socket, SHUT_RDWR);
        }
    }
    pthread_mutex_unlock(&all->lock);
}

bool kd_socket_abandoned(int socket)
{
    struct pollfd p = { .fd = socket, .events = POLLRDHUP };
    return poll(&p, 1, 0) > 0 && (p.revents & (POLLRDHUP | POLLHUP | POLLERR));
}
