#include "server/http/access.h"

#include "base/read.h"
#include "base/clock.h"
#include "base/hash.h"
#include "server/http/cors.h"
#include "server/http/auth_throttle.h"
#include "server/http/link_budgets.h"
#include "server/http/request.h"

#include <errno.h>
#include <fcntl.h>
#include <nettle/hmac.h>
#include <nettle/memops.h>
#include <nettle/sha2.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <time.h>

#define FILE_MOST ((size_t)64 << 10) /* maximum size of a token file, in bytes */
#define BLANK " \t\r"
#define LETTERS "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789"
/* the characters of RFC 6750 tokens that need no escape in addresses and cookies */
#define TOKEN_CHARACTERS LETTERS "-._~="

struct entry {
    struct kd_visitor visitor;
    uint8_t hash[SHA256_DIGEST_SIZE]; /* hash of the token or key; the token or key itself is not stored */
    /* for a key: the HMAC state after the key was fed in; each signature starts from a copy of it */
    struct hmac_sha256_ctx key;
};

struct kd_access {
    struct entry *entries;
    size_t n;
};

static void hash_of(const char *token, uint8_t out[SHA256_DIGEST_SIZE])
{
    struct sha256_ctx context;
    sha256_init(&context);
    sha256_update(&context, strlen(token), (const uint8_t *)token);
    sha256_digest(&context, SHA256_DIGEST_SIZE, out);
}

/* Returns the entry with this token or key, or NULL. */
static const struct entry *entry_of(const struct kd_access *access, const char *token)
{
    uint8_t hash[SHA256_DIGEST_SIZE];
    const struct entry *found = NULL;
    hash_of(token, hash);
    for (size_t i = 0; i < access->n; i++)
        if (memeql_sec(hash, access->entries[i].hash, sizeof hash))
            found = &access->entries[i];
    return found;
}

const struct kd_visitor *kd_access_find(const struct kd_access *access, const char *token)
{
    const struct entry *found = entry_of(access, token);
    return found && found->visitor.role != KD_ROLE_LINK ? &found->visitor : NULL;
}

bool kd_access_sign(const struct kd_access *access, const char *name, const void *text, size_t size,
                    uint8_t signature[KD_ACCESS_SIGNATURE], const struct kd_visitor **owner)
{
    for (size_t i = 0; i < access->n; i++) {
        const struct entry *entry = &access->entries[i];
        if (entry->visitor.role != KD_ROLE_LINK || strcmp(entry->visitor.name, name))
            continue;
        struct hmac_sha256_ctx context = entry->key;
        hmac_sha256_update(&context, size, text);
        hmac_sha256_digest(&context, KD_ACCESS_SIGNATURE, signature);
        *owner = &entry->visitor;
        return true;
    }
    return false;
}

static bool parse_role(const char *text, enum kd_role *out)
{
    static const char *const words[] = {
#define ROLE_WORD(name, word) [KD_ROLE_##name] = word,
        KD_ROLES(ROLE_WORD)
#undef ROLE_WORD
    };
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (!strcmp(text, words[i])) {
            *out = (enum kd_role)i;
            return true;
        }
    return false;
}

/* Checks a line. Returns NULL if it is valid, or otherwise the fault, worded as the end of a sentence. This text
 * does not contain the token. */
static const char *fault_of(const struct kd_access *access, const char *name, const char *role, const char *token,
                            const char *more, struct entry *entry)
{
    if (!role || !token || more)
        return "a line must be NAME ROLE TOKEN";
    if (strlen(name) > KD_ACCESS_NAME_MAX || name[strspn(name, LETTERS "-._@")])
        return "a name must have at most 32 letters, digits and -._@";
    if (!parse_role(role, &entry->visitor.role))
        return "the role must be view, render or link";
    if (strlen(token) < KD_ACCESS_TOKEN_MIN || strlen(token) > KD_ACCESS_TOKEN_MAX)
        return "a token must have 16 to 256 characters";
    if (entry->visitor.role == KD_ROLE_LINK && strlen(token) < KD_ACCESS_KEY_MIN)
        return "a key for links must have 32 to 256 characters";
    if (token[strspn(token, TOKEN_CHARACTERS)])
        return "a token must consist of letters, digits and -._~=";
    if (entry_of(access, token))
        return "another line has the same token";
    for (size_t i = 0; i < access->n; i++)
        if (!strcmp(access->entries[i].visitor.name, name))
            return "another line has the same name";
    snprintf(entry->visitor.name, sizeof entry->visitor.name, "%s", name);
    hash_of(token, entry->hash);
    hmac_sha256_set_key(&entry->key, strlen(token), (const uint8_t *)token);
    return NULL;
}

static enum kd_status add_line(struct kd_access *access, const char *path, unsigned number, char *line,
                               struct kd_error *error)
{
    struct entry entry = { 0 };
    char *rest;
    line[strcspn(line, "#")] = 0;
    const char *name = strtok_r(line, BLANK, &rest);
    if (!name)
        return KD_OK;
    const char *role = strtok_r(NULL, BLANK, &rest), *token = strtok_r(NULL, BLANK, &rest),
               *more = strtok_r(NULL, BLANK, &rest);
    const char *fault = fault_of(access, name, role, token, more, &entry);
    if (fault)
        return kd_error_set(error, KD_EINVAL, "line %u of the token file %.200s: %s", number, path, fault);
    struct entry *entries = realloc(access->entries, (access->n + 1) * sizeof *entries);
    if (!entries)
        return kd_error_set(error, KD_ENOMEM, "out of memory");
    access->entries = entries;
    entries[access->n++] = entry;
    return KD_OK;
}

static enum kd_status add_lines(struct kd_access *access, const char *path, char *text, struct kd_error *error)
{
    enum kd_status status = KD_OK;
    unsigned number = 0;
    for (char *line = text, *next; line && !status; line = next) {
        next = strchr(line, '\n');
        if (next)
            *next++ = 0;
        status = add_line(access, path, ++number, line, error);
    }
    if (!status && !access->n)
        return kd_error_set(error, KD_EINVAL, "the token file %.200s has no token: a line must be NAME ROLE TOKEN",
                            path);
    return status;
}

static enum kd_status read_text(const char *path, struct kd_buffer *text, struct kd_error *error)
{
    struct stat about;
    if (stat(path, &about) || !kd_read_file(AT_FDCWD, path, 0, FILE_MOST, text))
        return kd_error_set(error, KD_EINVAL, "the token file %.200s cannot be read: %s", path, strerror(errno));
    if (about.st_mode & (S_IROTH | S_IWOTH | S_IWGRP))
        return kd_error_set(
            error, KD_EINVAL,
            "the token file %.200s must be readable and writable by its owner only, and has mode %03o: use chmod 600",
            path, (unsigned)about.st_mode & 0777);
    if (memchr(text->data ? text->data : (void *)"", 0, text->size))
        return kd_error_set(error, KD_EINVAL, "the token file %.200s is not a text: it has a zero byte", path);
    return kd_buffer_append(text, "", 1) ? kd_error_set(error, KD_ENOMEM, "out of memory") : KD_OK;
}

enum kd_status kd_access_read(const char *path, struct kd_access **out, struct kd_error *error)
{
    struct kd_access *access = calloc(1, sizeof *access);
    struct kd_buffer text = { 0 };
    enum kd_status status = access ? read_text(path, &text, error) : kd_error_set(error, KD_ENOMEM, "out of memory");
    if (!status)
        status = add_lines(access, path, (char *)text.data, error);
    kd_buffer_finish(&text);
    if (status)
        kd_access_free(access);
    else
        *out = access;
    return status;
}

void kd_access_free(struct kd_access *access)
{
    if (access)
        free(access->entries);
    free(access);
}

/* Number of kerrd's cookies that are checked. A browser sends several if paths are nested, or if an old cookie is
 * left. The limit prevents clients from testing many tokens in one request. */
enum { COOKIES = 4 };

/* The tokens that a request contains. */
struct brought {
    /* alone: the token in the page's address or in Kerrd-Access; if there is one, only this token is checked.
     * bearer: the token in Authorization. Both may be NULL. */
    const char *alone, *bearer;
    const char *cookies[COOKIES]; /* tokens in cookies, which are checked after `bearer` if `alone` is NULL */
    size_t n_cookies;
};

static enum MHD_Result add_cookie(void *cls, enum MHD_ValueKind kind, const char *key, const char *value)
{
    struct brought *brought = cls;
    (void)kind;
    if (value && !strcmp(key, KD_ACCESS_COOKIE) && brought->n_cookies < COOKIES)
        brought->cookies[brought->n_cookies++] = value;
    return MHD_YES;
}

static struct brought brought_by(struct kd_request *request)
{
    const char *query = kd_access_query(request);
    const char *own = MHD_lookup_connection_value(request->mhd, MHD_HEADER_KIND, KD_ACCESS_HEADER);
    struct brought brought = { .alone = query ? query : own, .bearer = kd_bearer_of(request) };
    if (!kd_cors_foreign(request))
        MHD_get_connection_values(request->mhd, MHD_COOKIE_KIND, add_cookie, &brought);
    return brought;
}

/* Returns the visitor of a request, or NULL. If there is a token in the page's address or in Kerrd-Access, only this
 * token is checked. Authorization may contain the token of a session instead of an access token; therefore the
 * cookies are checked as well. */
static const struct kd_visitor *visitor_of(struct kd_request *request, const struct brought *brought)
{
    const struct kd_access *access = request->server->access;
    if (brought->alone)
        return kd_access_find(access, brought->alone);
    const struct kd_visitor *visitor = brought->bearer ? kd_access_find(access, brought->bearer) : NULL;
    request->spent = visitor;
    for (size_t i = 0; !visitor && i < brought->n_cookies; i++)
        visitor = kd_access_find(access, brought->cookies[i]);
    return visitor;
}

/* True if a bearer token may be the token of a session, which has 32 hexadecimal digits. An access token of this
 * form has too many digits to be guessed, so it need not count as a guess. */
static bool may_be_sessions(const char *bearer)
{
    return strlen(bearer) == 32 && strspn(bearer, "0123456789abcdef") == 32;
}

/* Returns the number of seconds for which tokens from this address are not checked. Returns 0 if they are checked
 * now, or if the request has no token. Must be called while request->client still contains the address. */
static unsigned guesses_wait_s(const struct kd_request *request, const struct brought *brought)
{
    struct kd_auth_throttle *auth_throttle = request->server->auth_throttle;
    const char *const texts[] = { brought->alone, brought->alone ? NULL : brought->bearer };
    /* always the same initial value, so that a token has the same hash in an address, a header and a cookie */
    uint64_t hash = KD_HASH_BEGIN;
    /* The visitor may have been identified by a valid cookie alone. A wrong token in Authorization then counts as a
     * guess, unless it may be the token of a session. */
    if (request->visitor) {
        const bool tried = brought->bearer && !brought->alone && !request->spent && !may_be_sessions(brought->bearer);
        const unsigned wait =
            tried ? kd_auth_throttle_wrong(auth_throttle, request->client,
                                           kd_hash(hash, brought->bearer, strlen(brought->bearer) + 1), kd_clock_ms())
                  : 0;
        return wait ? wait : kd_auth_throttle_right(auth_throttle, request->client, request->visitor, kd_clock_ms());
    }
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
        hash = texts[i] ? kd_hash(hash, texts[i], strlen(texts[i]) + 1) : hash;
    for (size_t i = 0; !brought->alone && i < brought->n_cookies; i++)
        hash = kd_hash(hash, brought->cookies[i], strlen(brought->cookies[i]) + 1);
    return hash == KD_HASH_BEGIN ? 0 : kd_auth_throttle_wrong(auth_throttle, request->client, hash, kd_clock_ms());
}

const char *kd_access_query(const struct kd_request *request)
{
    if (!request->server->access || !request->route || !request->route->page)
        return NULL;
    for (size_t i = 0; i < request->target.n_pairs; i++)
        if (!strcmp(request->target.pairs[i].name, KD_ACCESS_QUERY))
            return request->target.pairs[i].value;
    return NULL;
}

bool kd_role_may(enum kd_role role, const struct kd_route *route, unsigned method)
{
    if (role == KD_ROLE_LINK)
        return route->signable && method == KD_GET;
    return role == KD_ROLE_RENDER || method == KD_GET || (method == KD_POST && route->question);
}

/* True if the request comes by a signed link. In that case nothing but the link's signature authorises it. */
static bool has_link(const struct kd_request *request)
{
    return request->route && kd_role_may(KD_ROLE_LINK, request->route, kd_route_method(request->method)) &&
           kd_link_is(&request->target);
}

/* Authorises a request by its signed link. */
static bool check_link(struct kd_request *request, struct kd_problem *problem, struct kd_error *error)
{
    struct kd_server *server = request->server;
    struct kd_buffer path = { 0 };
    const uint64_t now_s = (uint64_t)time(NULL);
    if (kd_route_path(request->route, request->rest, &path))
        kd_error_set(error, KD_ENOMEM, "out of memory for a link");
    else
        request->visitor =
            kd_link_check(server->access, (const char *)path.data, &request->target, now_s, &request->link, error);
    kd_buffer_finish(&path);
    *problem = kd_problem_from(error);
    if (error->status == KD_EINVAL)
        problem->type = KD_PROBLEM_LINK;
    if (!request->visitor)
        return false;
    switch (kd_link_budget(server->links, &request->link, now_s)) {
    case KD_LINK_LEFT: return true;
    case KD_LINK_SPENT:
        kd_error_set(error, KD_EINVAL, "the link's budget is spent: %.3g s of device time",
                     (double)request->link.terms.budget_ms * 1e-3);
        *problem = (struct kd_problem) { .type = KD_PROBLEM_LINK, .detail = error->message };
        return false;
    case KD_LINK_CROWDED:
        *problem =
            (struct kd_problem) { .type = KD_PROBLEM_LINKS_FULL,
                                  .retry_after = 3600,
                                  .detail =
                                      "the server counts the device time of too many links that have not expired" };
        return false;
    }
    return false;
}

bool kd_access_check(struct kd_request *request, struct kd_problem *problem, struct kd_error *error)
{
    if (!request->server->access || (request->route && request->route->open))
        return true;
    if (has_link(request))
        return check_link(request, problem, error);
    const struct brought brought = brought_by(request);
    request->visitor = visitor_of(request, &brought);
    *problem = (struct kd_problem) {
        .type = KD_PROBLEM_WRONG_TOKENS,
        .close = request->body_announced,
        .retry_after = guesses_wait_s(request, &brought),
        .detail = "too many wrong access tokens have come from this address; try again in a few seconds"
    };
    if (problem->retry_after) {
        request->visitor = NULL;
        return false;
    }
    *problem = (struct kd_problem) {
        .type = KD_PROBLEM_UNAUTHORIZED,
        .close = request->body_announced,
        .detail = "this server needs an access token, as Authorization: Bearer TOKEN or " KD_ACCESS_HEADER ": TOKEN"
    };
    if (!request->visitor)
        return false;
    problem->type = KD_PROBLEM_ROLE;
    problem->detail =
        "a request that changes or stores something needs a token with the role render; yours has the role view";
    return !request->route || kd_role_may(request->visitor->role, request->route, kd_route_method(request->method));
}
