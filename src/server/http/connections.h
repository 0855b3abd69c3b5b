/* Deadlines of open connections. libmicrohttpd's timeout counts idle time only, so a client could hold a connection
 * for ever by sending one byte every few seconds. Here each stage of a request has its own deadline, and a sweep
 * shuts down the sockets that have missed their deadline.
 *
 * A socket is not closed before its connection is removed. Removal takes the same lock as the sweep, so the sweep
 * never uses a closed socket. Any thread. */
#ifndef KD_SERVER_HTTP_CONNECTIONS_H
#define KD_SERVER_HTTP_CONNECTIONS_H

#include "server/http/problem.h"
#include "server/http/shares.h"

#include <stdbool.h>

/* maximum number of open connections to the daemon of the health routes; when it is exceeded, the oldest connection
 * is shut down */
#define KD_HEALTH_CONNECTIONS 64u

struct kd_connections;
struct kd_connection;

enum kd_stage {
    KD_STAGE_OPEN,   /* the connection is accepted, but its request line is not complete */
    KD_STAGE_HEADER, /* the request line has arrived, but the header is not complete */
    KD_STAGE_BODY,
    KD_STAGE_WORK, /* the server computes the answer; this stage has no deadline */
    KD_STAGE_REPLY,
    KD_STAGE_IDLE, /* the connection stays open between two requests */
};

/* limit: maximum number of connections. share: maximum number of connections of one client; if it equals limit,
 * there is no separate limit for one client. */
struct kd_connections *kd_connections_create(unsigned limit, unsigned share, unsigned header_ms, unsigned body_ms);
void kd_connections_destroy(struct kd_connections *all);

/* Registers an accepted connection. Returns NULL when out of memory. */
struct kd_connection *kd_connections_add(struct kd_connections *all, int socket, const char *client);
/* Marks a connection as handed to a daemon of libmicrohttpd. health: true for the daemon of the health routes.
 * Connections to that daemon do not count towards the limits; if there are too many of them, the oldest is shut
 * down. The caller must refuse the connection in two cases: the result is KD_OVER_LIMIT (the daemon's limit is
 * reached) or KD_OVER_SHARE (the client's share is reached). */
enum kd_handed { KD_HANDED_ON, KD_OVER_LIMIT, KD_OVER_SHARE };
enum kd_handed kd_connections_hand_on(struct kd_connections *all, struct kd_connection *one, bool health);
/* Finds the connection of an open socket. */
struct kd_connection *kd_connections_find(struct kd_connections *all, int socket);
bool kd_connection_is_health(const struct kd_connection *one);
void kd_connections_remove(struct kd_connections *all, struct kd_connection *one);
/* Call this while the client is still sending a body that the server will not read. When the connection has been
 * removed, the socket then stays open and is drained for a while. If it were closed at once, the kernel would answer
 * the remaining bytes with a reset, and the client could lose the refusal before reading it. */
void kd_connection_linger(struct kd_connection *one);
int kd_connection_socket(const struct kd_connection *one);

/* Moves a connection to a stage, and sets the deadline of that stage. bytes: size of a large body or reply, which
 * extends the deadline; otherwise 0. */
void kd_connections_stage(struct kd_connections *all, struct kd_connection *one, enum kd_stage stage,
                          unsigned long bytes);

/* Sends a problem document to the connection of this socket, and then shuts down the socket for writing. Does
 * nothing unless the request is still arriving. Only the thread that works on the connection may call this. */
void kd_connections_refuse(struct kd_connections *all, int socket, enum kd_problem_type type, const char *detail);

/* True if a new request on this connection must be refused, because more connections are open than the limit
 * permits. A client with few connections (at most limit - share) is never refused. */
bool kd_connections_crowded(struct kd_connections *all, const struct kd_connection *one);
/* True if connections that have not sent anything yet must be closed, to make room for others. */
bool kd_connections_full(struct kd_connections *all);
/* Capacity of the main daemon for a given limit of connections. It is larger than the limit, so that a connection
 * beyond the limit gets an answer with the reason. */
unsigned kd_connections_most(unsigned limit);

/* Shuts down connections that have missed their deadline. If a request has begun, it is answered with 408 first.
 * Also drains lingering sockets. Call this often, always from the same thread. */
void kd_connections_sweep(struct kd_connections *all);

/* For shutdown: closes connections whose clients have not read a byte of their answer for STALL_MS. Call this often,
 * always from the same thread. */
void kd_connections_cut_stalled(struct kd_connections *all);

/* True if the peer has closed its end, at least for writing. The caller guarantees that the socket is open. */
bool kd_socket_abandoned(int socket);

#endif
