#include "server/http/front.h"

#include "base/log.h"
#include "server/http/client.h"
#include "server/http/problem.h"
#include "server/http/sched_slice.h"
#include "server/http/route.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <sys/epoll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#define FULL_MS 10 /* pause in ms between two checks for a free descriptor */
#define BATCH 64   /* maximum number of events handled, and of connections accepted, in one iteration */

/* A connection that was not handed to a daemon yet. Its deadline is that of a header (connections.h). */
struct guest {
    struct guest *previous, *next;
    struct kd_connection *connection;
    int socket;
    struct sockaddr_storage address;
    socklen_t address_size;
    bool spare; /* true if the connection uses the reserved descriptor, so that only health routes are served */
};

struct kd_front {
    struct kd_front_params params;
    /* reserve: a spare descriptor, which is closed when there is no other free descriptor; -1: it is closed now */
    int epoll, stop, reserve;
    struct guest *first, *last; /* list of all guests; `first` is the newest */
    pthread_t thread;
};

static void unlink_guest(struct kd_front *front, struct guest *guest)
{
    *(guest->previous ? &guest->previous->next : &front->first) = guest->next;
    *(guest->next ? &guest->next->previous : &front->last) = guest->previous;
}

static void send_away(struct kd_front *front, struct guest *guest)
{
    unlink_guest(front, guest);
    /* Removed explicitly, because a lingering socket stays open through another descriptor. epoll would then report
     * events for a guest that is already freed. */
    epoll_ctl(front->epoll, EPOLL_CTL_DEL, guest->socket, NULL);
    kd_connections_remove(front->params.connections, guest->connection);
    close(guest->socket);
    free(guest);
}

static void refuse(struct kd_front *front, struct guest *guest, bool quota)
{
    if (guest->spare)
        kd_problem_send_raw(guest->socket, KD_PROBLEM_CROWDED,
                            "this server has no free descriptor for another connection", NULL);
    else if (quota)
        kd_problem_send_raw(guest->socket, KD_PROBLEM_QUOTA,
                            "you have too many open connections (limit for one client)", NULL);
    else
        kd_problem_send_raw(guest->socket, KD_PROBLEM_CROWDED, "too many connections are open", NULL);
    kd_connection_linger(guest->connection);
    send_away(front, guest);
}

static void hand_on(struct kd_front *front, struct guest *guest, bool health)
{
    struct MHD_Daemon *daemon = health ? front->params.health : front->params.others;
    enum kd_handed handed = kd_connections_hand_on(front->params.connections, guest->connection, health);
    if (handed || (guest->spare && !health)) {
        refuse(front, guest, handed == KD_OVER_SHARE);
        return;
    }
    unlink_guest(front, guest);
    /* this call has no effect if the socket is not watched yet */
    epoll_ctl(front->epoll, EPOLL_CTL_DEL, guest->socket, NULL);
    /* On failure the library has already closed the socket. */
    if (MHD_add_connection(daemon, guest->socket, (struct sockaddr *)&guest->address, guest->address_size) != MHD_YES)
        kd_connections_remove(front->params.connections, guest->connection);
    free(guest);
}

/* Hands a new connection to a daemon as soon as its first bytes show which daemon must serve it. gone: true if no
 * more bytes will come. Returns true if the connection was not handed over yet. */
static bool look_at(struct kd_front *front, struct guest *guest, bool gone)
{
    char begin[KD_BEGINS_BYTES];
    ssize_t n = recv(guest->socket, begin, sizeof begin, MSG_PEEK | MSG_DONTWAIT);
    bool wait = n < 0 && (errno == EAGAIN || errno == EINTR);
    enum kd_begins begins = n > 0 ? kd_route_begins(front->params.base, begin, (size_t)n) : KD_BEGINS_UNCLEAR;
    if (begins != KD_BEGINS_UNCLEAR)
        hand_on(front, guest, begins == KD_BEGINS_HEALTH);
    else if (gone || (n <= 0 && !wait))
        send_away(front, guest);
    else
        return true;
    return false;
}

static struct guest *admit(struct kd_front *front, int socket, const struct sockaddr_storage *address, socklen_t size)
{
    struct guest *guest = calloc(1, sizeof *guest);
    char client[KD_CLIENT];
    kd_client_at((const struct sockaddr *)address, client);
    struct kd_connection *connection = guest ? kd_connections_add(front->params.connections, socket, client) : NULL;
    if (!connection) {
        free(guest);
        kd_problem_send_raw(socket, KD_PROBLEM_NO_MEMORY, "out of memory for another connection", NULL);
        close(socket);
        return NULL;
    }
    *guest = (struct guest) {
        .next = front->first, .connection = connection, .socket = socket, .address = *address, .address_size = size
    };
    *(guest->next ? &guest->next->previous : &front->last) = guest;
    front->first = guest;
    return guest;
}

/* Watches a guest's socket. The events are edge-triggered: the bytes are only peeked at and stay in the socket, so
 * level-triggered events would repeat for ever. */
static void watch(struct kd_front *front, struct guest *guest)
{
    struct epoll_event event = { .events = EPOLLIN | EPOLLRDHUP | EPOLLET, .data.ptr = guest };
    if (epoll_ctl(front->epoll, EPOLL_CTL_ADD, guest->socket, &event))
        send_away(front, guest);
}

static int keep_reserve(void) { return open("/dev/null", O_RDONLY | O_CLOEXEC); }

/* Frees a descriptor when all are in use. If there are guests, closes the one that has waited longest. Otherwise
 * releases the reserve. If the reserve is already released, waits for FULL_MS. */
static void make_room(struct kd_front *front)
{
    struct pollfd waiting = { .fd = front->params.listener, .events = POLLIN };
    if (poll(&waiting, 1, 0) < 1)
        return; /* no connection waits; accept has failed only because there was no descriptor */
    if (front->last)
        send_away(front, front->last);
    else if (front->reserve >= 0) {
        close(front->reserve);
        front->reserve = -1;
        kd_log(KD_LOG_WARN, "no free descriptor for another connection");
    } else
        poll(NULL, 0, FULL_MS);
}

/* Accepts a connection. Returns false if none is waiting. */
static bool accept_one(struct kd_front *front)
{
    struct sockaddr_storage address = { 0 };
    socklen_t size = sizeof address;
    int socket = accept4(front->params.listener, (struct sockaddr *)&address, &size, SOCK_NONBLOCK | SOCK_CLOEXEC);
    if (socket < 0 && (errno == EMFILE || errno == ENFILE || errno == ENOBUFS || errno == ENOMEM)) {
        make_room(front);
        return false; /* the waiting connection will cause another event */
    }
    if (socket < 0)
        return errno != EAGAIN && errno != EWOULDBLOCK && errno != EINVAL &&
               errno != EBADF; /* all other errors concern a connection that no longer exists */
    if (front->reserve < 0)
        front->reserve = keep_reserve();
    struct guest *guest = admit(front, socket, &address, size);
    if (!guest)
        return true;
    guest->spare = front->reserve < 0;
    while (front->last != guest && kd_connections_full(front->params.connections))
        send_away(front, front->last);
    /* Most requests arrive together with their connection, which then need not be watched. */
    if (look_at(front, guest, false))
        watch(front, guest);
    return true;
}

static void *run(void *user)
{
    struct kd_front *front = user;
    kd_sched_short_slices();
    for (;;) {
        struct epoll_event events[BATCH];
        int n = epoll_wait(front->epoll, events, BATCH, -1);
        bool more = false;
        for (int i = 0; i < n; i++) {
            if (events[i].data.ptr == &front->stop)
                return NULL;
            if (events[i].data.ptr == front)
                more = true;
            else
                look_at(front, events[i].data.ptr, events[i].events & (EPOLLRDHUP | EPOLLHUP | EPOLLERR));
        }
        /* Connections are accepted after the events were handled, because accepting may close guests that have
         * events. */
        for (int i = 0; more && i < BATCH; i++)
            more = accept_one(front);
    }
}

static enum kd_status start(struct kd_front *front, struct kd_error *error)
{
    struct epoll_event listening = { .events = EPOLLIN, .data.ptr = front },
                       stopping = { .events = EPOLLIN, .data.ptr = &front->stop };
    front->epoll = epoll_create1(EPOLL_CLOEXEC);
    front->stop = eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
    front->reserve = keep_reserve();
    if (front->epoll < 0 || front->stop < 0 || front->reserve < 0 ||
        epoll_ctl(front->epoll, EPOLL_CTL_ADD, front->params.listener, &listening) ||
        epoll_ctl(front->epoll, EPOLL_CTL_ADD, front->stop, &stopping))
        return kd_error_set(error, KD_EIO, "no descriptor for the listening thread: %s", strerror(errno));
    return pthread_create(&front->thread, NULL, run, front)
               ? kd_error_set(error, KD_ENOMEM, "the listening thread could not be started")
               : KD_OK;
}

static void finish(struct kd_front *front)
{
    const int all[] = { front->epoll, front->stop, front->reserve, front->params.listener };
    while (front->first)
        send_away(front, front->first);
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
        if (all[i] >= 0)
            close(all[i]);
    free(front);
}

enum kd_status kd_front_create(const struct kd_front_params *params, struct kd_front **out, struct kd_error *error)
{
    struct kd_front *front = calloc(1, sizeof *front);
    if (!front) {
        close(params->listener);
        return kd_error_set(error, KD_ENOMEM, "out of memory");
    }
    *front = (struct kd_front) { .params = *params, .epoll = -1, .stop = -1, .reserve = -1 };
    enum kd_status status = start(front, error);
    if (status)
        finish(front);
    else
        *out = front;
    return status;
}

void kd_front_destroy(struct kd_front *front)
{
    uint64_t one = 1;
    if (!front)
        return;
    while (write(front->stop, &one, sizeof one) < 0 && errno == EINTR) {
    }
    pthread_join(front->thread, NULL);
    finish(front);
}
