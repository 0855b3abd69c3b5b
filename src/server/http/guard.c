#include "server/http/guard.h"

#include "document/text.h"
#include "server/http/negotiate.h"

#include <stdio.h>
#include <string.h>
#include <strings.h>

struct scan {
    struct kd_header *header;
    unsigned hosts, lengths, encodings, types;
    const char *fault;
};

static bool parse_length(const char *text, uint64_t *out)
{
    uint64_t value = 0;
    if (!*text || strlen(text) > 18) /* at most 18 digits, so that the number fits into 64 bits */
        return false;
    for (; *text; text++) {
        if (*text < '0' || *text > '9')
            return false;
        value = value * 10 + (uint64_t)(*text - '0');
    }
    *out = value;
    return true;
}

static bool is_token(const char *text, size_t size)
{
    for (size_t i = 0; i < size; i++)
        if (text[i] <= ' ' || text[i] >= 0x7f || strchr("\"(),/:;<=>?@[\\]{}", text[i]))
            return false;
    return size > 0;
}

/* Length of a value without trailing blanks, which do not belong to it (RFC 9110 5.5). libmicrohttpd 0.9.75 does not
 * remove them. */
static size_t trim(const char *value, size_t size)
{
    union {
        const char *in;
        char *out;
    } text = { value }; /* `value` points to the library's own copy, which ends with a NUL */
    const size_t given = size;
    while (size && (value[size - 1] == ' ' || value[size - 1] == '\t'))
        size--;
    if (size < given)
        text.out[size] = 0;
    return size;
}

/* Stores Host. A Host that is too long for the buffer is longer than every name that is served, so it is refused. */
static void keep_host(struct kd_header *header, const char *value, size_t n)
{
    snprintf(header->host_text, sizeof header->host_text, "%.*s",
             (int)(n < sizeof header->host_text ? n : sizeof header->host_text - 1), value);
}

static enum MHD_Result look(void *cls, enum MHD_ValueKind kind, const char *key, size_t key_size, const char *value,
                            size_t value_size)
{
    struct scan *scan = cls;
    (void)kind;
    if (!value)
        value = "", value_size = 0;
    const bool sound = strlen(value) == value_size && !strpbrk(value, "\r\n");
    const size_t size = sound ? trim(value, value_size) : 0;
    if (!is_token(key, key_size))
        scan->fault = "a header field's name is not a token";
    else if (!sound)
        scan->fault = "a header field's value holds a control character";
    else if (!strcasecmp(key, "Host"))
        scan->hosts++, keep_host(scan->header, value, size);
    else if (!strcasecmp(key, "Content-Type"))
        scan->types++, scan->header->content_type = value;
    else if (!strcasecmp(key, "Transfer-Encoding")) {
        scan->encodings++;
        if (strcasecmp(value, "chunked"))
            scan->fault = "Transfer-Encoding must be chunked";
    } else if (!strcasecmp(key, "Content-Length")) {
        scan->lengths++;
        if (!parse_length(value, &scan->header->content_length))
            scan->fault = "Content-Length must be one decimal number";
    }
    return MHD_YES;
}

static const char *framing_fault(const struct scan *scan, bool http10)
{
    if (scan->fault)
        return scan->fault;
    if (scan->lengths > 1)
        return "Content-Length must be given at most once";
    if (scan->encodings > 1)
        return "Transfer-Encoding must be given at most once";
    if (scan->lengths && scan->encodings)
        return "Content-Length cannot be used with Transfer-Encoding";
    if (scan->encodings && http10)
        return "Transfer-Encoding cannot be used with HTTP/1.0";
    if (scan->types > 1)
        return "Content-Type must be given at most once";
    return NULL;
}

static bool refuse(struct kd_problem *problem, enum kd_problem_type type, const char *detail)
{
    *problem = (struct kd_problem) { .type = type, .detail = detail, .close = true };
    return false;
}

static const char *wrong_host(struct kd_header *header)
{
    char given[80], name[80];
    size_t size = *header->host == '[' ? strcspn(header->host, "]") + 1 : strcspn(header->host, ":");
    kd_text_clip(given, sizeof given, header->host);
    bool whole = size < sizeof name &&
                 size <= strspn(header->host, "0123456789abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ.-_[:]");
    snprintf(name, sizeof name, "%.*s", whole && size ? (int)size : 4, whole && size ? header->host : "NAME");
    snprintf(header->wrong_host, sizeof header->wrong_host,
             "the Host is \"%s\", which is not a name of this server; kerrd serve --host %s adds it", given, name);
    return header->wrong_host;
}

bool kd_guard_check(struct MHD_Connection *connection, const char *version, const char *authority,
                    const char *const *hosts, bool hostless, struct kd_header *header, struct kd_problem *problem)
{
    struct scan scan = { .header = header };
    bool http10 = !strcmp(version, "HTTP/1.0");

    *header = (struct kd_header) { 0 };
    if (!http10 && strcmp(version, "HTTP/1.1"))
        return refuse(problem, KD_PROBLEM_HTTP_VERSION, version);
    MHD_get_connection_values_n(connection, MHD_HEADER_KIND, look, &scan);
    const char *fault = framing_fault(&scan, http10);
    if (fault)
        return refuse(problem, KD_PROBLEM_BAD_REQUEST, fault);
    header->has_length = scan.lengths;
    header->chunked = scan.encodings;
    if (!scan.hosts && http10 && hostless && !authority)
        return true;
    if (scan.hosts != 1)
        return refuse(problem, KD_PROBLEM_BAD_REQUEST, "exactly one Host is required");
    header->host = authority ? authority : header->host_text;
    if (!kd_host_is_sound(header->host))
        return refuse(problem, KD_PROBLEM_BAD_REQUEST,
                      authority ? "the host in the request target is not valid" : "Host is not a valid host");
    if (!kd_host_listed(header->host, hosts))
        return refuse(problem, KD_PROBLEM_MISDIRECTED, wrong_host(header));
    return true;
}
