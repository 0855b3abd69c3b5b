/* Deadlines of open connections. libmicrohttpd's timeout counts idle time only, so that one byte every few seconds
 * would hold a connection for ever. Here each stage of a request has its own deadline, and a sweep shuts down sockets
 * that missed it.
 *
 * A socket stays open until its connection is removed, which takes the same lock as the sweep. Any thread. */
#ifndef KD_SERVER_HTTP_CONNECTIONS_H
#define KD_SERVER_HTTP_CONNECTIONS_H

#include "server/http/problem.h"
#include "server/http/shares.h"

#include <stdbool.h>

#define KD_HEALTH_CONNECTIONS 64u /* at once, on the health routes' daemon; older ones give way */

struct kd_connections;
struct kd_connection;

enum kd_stage {
    KD_STAGE_OPEN,   /* accepted, nothing understood yet */
    KD_STAGE_HEADER, /* the request line has arrived */
    KD_STAGE_BODY,
    KD_STAGE_WORK, /* ours to answer: no deadline */
    KD_STAGE_REPLY,
    KD_STAGE_IDLE, /* kept alive between requests */
};

/* share: how many of the limit one client may have; where it is the limit, no client is refused for what it has. */
struct kd_connections *kd_connections_create(unsigned limit, unsigned share, unsigned header_ms, unsigned body_ms);
void kd_connections_destroy(struct kd_connections *all);

/* Enters a connection that has been accepted. NULL when out of memory. */
struct kd_connection *kd_connections_add(struct kd_connections *all, int socket, const char *client);
/* Hands a connection on to a daemon of libmicrohttpd. health: to that of the health routes; the connection counts no
 * longer, and where too many are open there the oldest is shut down for it. Unless the answer is KD_HANDED_ON it
 * must be refused: as many as can be told why are there already, or with KD_OVER_SHARE as many of its client as one
 * may have. */
enum kd_handed { KD_HANDED_ON, KD_OVER_LIMIT, KD_OVER_SHARE };
enum kd_handed kd_connections_hand_on(struct kd_connections *all, struct kd_connection *one, bool health);
/* Finds the connection of an open socket, for the daemon it was handed to. */
struct kd_connection *kd_connections_find(struct kd_connections *all, int socket);
bool kd_connection_is_health(const struct kd_connection *one);
void kd_connections_remove(struct kd_connections *all, struct kd_connection *one);
/* Says that the client is still sending what will not be read. Closed at once, the socket would answer that with a
 * reset, and a reset makes the client lose the refusal it has not read yet; so it is emptied for a while after
 * removal. */
void kd_connection_linger(struct kd_connection *one);
int kd_connection_socket(const struct kd_connection *one);

/* bytes: of a large body about to come or of the reply about to be sent, else 0. */
void kd_connections_stage(struct kd_connections *all, struct kd_connection *one, enum kd_stage stage,
                          unsigned long bytes);

/* Send a problem document to the connection of this socket, and nothing after it. Only while its request is still
 * arriving; without effect for any other. The thread that works on it. */
void kd_connections_refuse(struct kd_connections *all, int socket, enum kd_problem_type type, const char *detail);

/* Whether more are open than may be served. A client that has no more than the share leaves to others is served all
 * the same. */
bool kd_connections_crowded(struct kd_connections *all, const struct kd_connection *one);
/* Whether more are open than can be told so: those that have not said anything yet must go. */
bool kd_connections_full(struct kd_connections *all);
/* The most connections that are handed to the daemon of all other routes than health, at a limit. */
unsigned kd_connections_most(unsigned limit);

/* Shut down what is overdue, with a 408 where a request had begun; empty what lingers. One thread, often. */
void kd_connections_sweep(struct kd_connections *all);

/* Called on the way down: shuts down those whose clients have not taken a byte for STALL_MS of what is on its way to
 * them. One thread, often. */
void kd_connections_cut_stalled(struct kd_connections *all);

/* Whether the peer has closed, or half-closed, its end. The socket must be known to be open. */
bool kd_socket_abandoned(int socket);

#endif
