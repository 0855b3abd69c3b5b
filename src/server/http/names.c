#include "server/http/names.h"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netdb.h>
#include <netinet/in.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

#define MOST 64 /* maximum number of names; if a machine has more addresses, --host can add the others */

bool kd_names_any(const char *listen)
{
    return !strcmp(listen, "0.0.0.0") || !strcmp(listen, "::") || !strcmp(listen, "[::]");
}

void kd_names_free(char **names)
{
    for (size_t i = 0; names && names[i]; i++)
        free(names[i]);
    free(names);
}

/* Writes an address in the form for URLs. Writes "" for other address families, and for addresses that are valid on
 * one interface only. */
static void text_of(const struct sockaddr *address, int family, char out[80])
{
    char text[INET6_ADDRSTRLEN] = "";
    *out = 0;
    if (!address || address->sa_family != family)
        return;
    if (family == AF_INET) {
        inet_ntop(AF_INET, &((const struct sockaddr_in *)address)->sin_addr, text, sizeof text);
        snprintf(out, 80, "%s", text);
    } else if (!IN6_IS_ADDR_LINKLOCAL(&((const struct sockaddr_in6 *)address)->sin6_addr)) {
        inet_ntop(AF_INET6, &((const struct sockaddr_in6 *)address)->sin6_addr, text, sizeof text);
        snprintf(out, 80, "[%s]", text);
    }
}

static bool add(char **names, size_t *n, const char *name)
{
    for (size_t i = 0; i < *n; i++)
        if (!strcmp(names[i], name))
            return true;
    if (!*name || *n == MOST)
        return true;
    names[*n] = strdup(name);
    return names[(*n)++];
}

/* True if the address belongs to this machine. Loopback addresses count, because Debian resolves the host name to
 * 127.0.1.1. */
static bool is_own(const char *text, char **names, size_t n)
{
    for (size_t i = 0; i < n; i++)
        if (!strcmp(names[i], text))
            return true;
    return !strncmp(text, "127.", 4) || !strcmp(text, "[::1]");
}

static bool add_host_name(char **names, size_t *n, int family)
{
    char name[256], text[80];
    struct addrinfo hints = { .ai_family = family, .ai_socktype = SOCK_STREAM }, *found = NULL;
    bool own = false;
    if (gethostname(name, sizeof name - 1) || getaddrinfo(name, NULL, &hints, &found))
        return true;
    name[sizeof name - 1] = 0;
    for (const struct addrinfo *one = found; one; one = one->ai_next) {
        text_of(one->ai_addr, family, text);
        own |= is_own(text, names, *n);
    }
    freeaddrinfo(found);
    return !own || add(names, n, name);
}

char **kd_names_own(const char *listen)
{
    int family = strchr(listen, ':') ? AF_INET6 : AF_INET;
    char **names = calloc(MOST + 1, sizeof *names);
    struct ifaddrs *all = NULL;
    size_t n = 0;
    char text[80];
    bool good = names && !getifaddrs(&all);
    for (const struct ifaddrs *one = all; good && one; one = one->ifa_next) {
        text_of(one->ifa_flags & IFF_LOOPBACK ? NULL : one->ifa_addr, family, text);
        good = add(names, &n, text);
    }
    if (good)
        good = add_host_name(names, &n, family);
    if (all)
        freeifaddrs(all);
    if (good)
        return names;
    kd_names_free(names);
    return NULL;
}
