/* Tests of the deadlines of connections: a sweep shuts down a connection whose client is late. It does not do so if
 * only the daemon is late. */
#include "server/http/connections.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

#include <cmocka.h>

enum { HEADER_MS = 20 };

struct pair {
    struct kd_connections *all;
    struct kd_connection *one;
    int server, client;
};

static struct pair opened(void)
{
    int ends[2];
    struct pair p = { .all = kd_connections_create(8, 8, HEADER_MS, HEADER_MS) };
    assert_non_null(p.all);
    assert_int_equal(socketpair(AF_UNIX, SOCK_STREAM, 0, ends), 0);
    p.server = ends[0];
    p.client = ends[1];
    p.one = kd_connections_add(p.all, p.server, "127.0.0.1");
    assert_non_null(p.one);
    return p;
}

static void closed(struct pair *p)
{
    kd_connections_remove(p->all, p->one);
    kd_connections_destroy(p->all);
    close(p->server);
    close(p->client);
}

static void sweep_past_the_deadline(struct pair *p)
{
    nanosleep(&(struct timespec) { .tv_nsec = 2000000L * HEADER_MS }, NULL);
    kd_connections_sweep(p->all);
}

/* True if the server has shut down its end, as seen by the client. */
static bool is_shut(const struct pair *p)
{
    char byte;
    return recv(p->client, &byte, 1, MSG_DONTWAIT) == 0;
}

static void test_a_silent_client_is_late(void **state)
{
    (void)state;
    struct pair p = opened();
    assert_int_equal(kd_connections_hand_on(p.all, p.one, true), KD_HANDED_ON);
    sweep_past_the_deadline(&p);
    assert_true(is_shut(&p));
    closed(&p);
}

/* Half a request line has arrived and stays unread. A client must not be able to keep a connection open by this. */
static void test_half_a_line_is_late(void **state)
{
    (void)state;
    struct pair p = opened();
    assert_int_equal(send(p.client, "GE", 2, 0), 2);
    sweep_past_the_deadline(&p);
    assert_true(is_shut(&p));
    closed(&p);
}

static void test_a_request_that_waits_for_its_daemon_is_not_late(void **state)
{
    (void)state;
    const char request[] = "GET /healthz HTTP/1.1\r\n\r\n";
    char read[sizeof request];
    struct pair p = opened();
    assert_int_equal(send(p.client, request, sizeof request, 0), sizeof request);
    assert_int_equal(kd_connections_hand_on(p.all, p.one, true), KD_HANDED_ON);
    sweep_past_the_deadline(&p);
    assert_false(is_shut(&p));
    assert_int_equal(recv(p.server, read, sizeof read, 0), sizeof request); /* now the daemon starts reading */
    sweep_past_the_deadline(&p);
    assert_true(is_shut(&p));
    closed(&p);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_silent_client_is_late),
        cmocka_unit_test(test_half_a_line_is_late),
        cmocka_unit_test(test_a_request_that_waits_for_its_daemon_is_not_late),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
