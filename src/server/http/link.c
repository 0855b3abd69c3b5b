#include "server/http/link.h"

#include "base/percent.h"

#include <inttypes.h>
#include <nettle/memops.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

#define SIGNER "signer"
#define EXPIRES "expires"
#define BUDGET "budget_ms"
#define SIGNATURE "signature"
#define WRONG \
    "the signature does not belong to this address; a link must be as `kerrd sign` made it, with a key of this server"

static enum kd_status add_pair(struct kd_buffer *text, const char *name, const char *value)
{
    enum kd_status status;
    KD_TRY(kd_buffer_printf(text, "\n"));
    KD_TRY(kd_percent_append(name, strlen(name), "", text));
    KD_TRY(kd_buffer_printf(text, "="));
    KD_TRY(kd_percent_append(value, strlen(value), "", text));
done:
    return status;
}

static enum kd_status add_address(struct kd_buffer *text, const char *path, const struct kd_target *target)
{
    enum kd_status status = kd_percent_append(path, strlen(path), "/", text);
    for (size_t i = 0; target && i < target->n_pairs && !status; i++)
        if (strcmp(target->pairs[i].name, SIGNATURE))
            status = add_pair(text, target->pairs[i].name, target->pairs[i].value);
    return status;
}

static bool is_of_link(const char *name)
{
    return !strcmp(name, SIGNER) || !strcmp(name, EXPIRES) || !strcmp(name, BUDGET) || !strcmp(name, SIGNATURE);
}

enum kd_status kd_link_sign(const struct kd_access *access, const char *name, const char *path,
                            const struct kd_target *target, const struct kd_link_terms *terms, struct kd_buffer *out,
                            struct kd_error *error)
{
    struct kd_buffer text = { 0 }, query = { 0 };
    char expires[24], budget[24];
    uint8_t signature[KD_ACCESS_SIGNATURE];
    const struct kd_visitor *owner;
    enum kd_status status;
    snprintf(expires, sizeof expires, "%" PRIu64, terms->expires_s);
    snprintf(budget, sizeof budget, "%" PRIu64, terms->budget_ms);
    for (size_t i = 0; target && i < target->n_pairs; i++)
        if (is_of_link(target->pairs[i].name))
            return kd_error_set(error, KD_EINVAL, "the address has a parameter %s; it must be an address without one",
                                target->pairs[i].name);
    KD_TRY(add_address(&text, path, target));
    KD_TRY(add_pair(&text, SIGNER, name));
    KD_TRY(add_pair(&text, EXPIRES, expires));
    if (terms->budget_ms)
        KD_TRY(add_pair(&text, BUDGET, budget));
    if (!kd_access_sign(access, name, text.data, text.size, signature, &owner)) {
        kd_error_set(error, KD_EINVAL, "the token file has no key with the name %.40s: a line must be NAME link KEY",
                     name);
        status = KD_EINVAL;
        goto done;
    }
    KD_TRY(kd_buffer_printf(&query, SIGNER "=%s&" EXPIRES "=%s", name, expires));
    if (terms->budget_ms)
        KD_TRY(kd_buffer_printf(&query, "&" BUDGET "=%s", budget));
    KD_TRY(kd_buffer_printf(&query, "&" SIGNATURE "="));
    for (size_t i = 0; i < sizeof signature; i++)
        KD_TRY(kd_buffer_printf(&query, "%02x", signature[i]));
    KD_TRY(kd_buffer_printf(out, "%s", (const char *)query.data));
done:
    kd_buffer_finish(&text);
    kd_buffer_finish(&query);
    return status == KD_ENOMEM ? kd_error_set(error, status, "out of memory for a link") : status;
}

bool kd_link_is(const struct kd_target *target) { return kd_target_value(target, SIGNATURE); }

static bool read_signature(const char *text, uint8_t out[KD_ACCESS_SIGNATURE])
{
    static const char digits[] = "0123456789abcdef";
    if (strlen(text) != 2 * KD_ACCESS_SIGNATURE || strspn(text, digits) != 2 * KD_ACCESS_SIGNATURE)
        return false;
    for (size_t i = 0; i < KD_ACCESS_SIGNATURE; i++)
        out[i] = (uint8_t)((strchr(digits, text[2 * i]) - digits) << 4 | (strchr(digits, text[2 * i + 1]) - digits));
    return true;
}

/* Reads the terms of the link before its signature is checked, so that the error for a truncated link says that it
 * is truncated. */
static enum kd_status read_terms(const struct kd_target *target, struct kd_link *out, uint8_t signature[],
                                 struct kd_error *error)
{
    const char *signer = kd_target_value(target, SIGNER), *expires = kd_target_value(target, EXPIRES),
               *budget = kd_target_value(target, BUDGET), *text = kd_target_value(target, SIGNATURE);
    enum kd_status status;
    KD_TRY(kd_target_distinct(target, error));
    if (!read_signature(text, signature))
        return kd_error_set(error, KD_EINVAL, "signature is \"%.40s\"; it must be %d digits of 0-9 and a-f", text,
                            2 * KD_ACCESS_SIGNATURE);
    if (!signer || strlen(signer) >= sizeof out->signer)
        return kd_error_set(error, KD_EINVAL, signer ? WRONG : "signer is missing; a signed link must have it");
    snprintf(out->signer, sizeof out->signer, "%s", signer);
    if (!expires || !kd_target_number(expires, KD_LINK_LATEST_S, &out->terms.expires_s))
        return kd_error_set(error, KD_EINVAL, "expires is %s%.40s%s; it must be a Unix time in whole seconds",
                            expires ? "\"" : "", expires ? expires : "missing", expires ? "\"" : "");
    if (budget && (!kd_target_number(budget, KD_LINK_BUDGET_MS, &out->terms.budget_ms) || !out->terms.budget_ms))
        return kd_error_set(error, KD_EINVAL, "budget_ms is \"%.40s\"; it must be a whole number, 1 to %u", budget,
                            KD_LINK_BUDGET_MS);
done:
    return status;
}

static enum kd_status refuse_expired(uint64_t expires_s, struct kd_error *error)
{
    char text[40] = "";
    struct tm tm;
    const time_t then = (time_t)expires_s;
    if (gmtime_r(&then, &tm))
        strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &tm);
    return kd_error_set(error, KD_EINVAL, "the link expired at %s", text);
}

const struct kd_visitor *kd_link_check(const struct kd_access *access, const char *path, struct kd_target *target,
                                       uint64_t now_s, struct kd_link *out, struct kd_error *error)
{
    struct kd_buffer text = { 0 };
    uint8_t right[KD_ACCESS_SIGNATURE] = { 0 }, given[KD_ACCESS_SIGNATURE];
    const struct kd_visitor *owner = NULL;
    enum kd_status status;
    *out = (struct kd_link) { 0 };
    KD_TRY(read_terms(target, out, given, error));
    if (add_address(&text, path, target))
        KD_TRY(kd_error_set(error, KD_ENOMEM, "out of memory for a link"));
    if (!kd_access_sign(access, out->signer, text.data, text.size, right, &owner) ||
        !memeql_sec(right, given, sizeof right))
        KD_TRY(kd_error_set(error, KD_EINVAL, WRONG));
    if (out->terms.expires_s + KD_LINK_LEEWAY_S < now_s)
        KD_TRY(refuse_expired(out->terms.expires_s, error));
    memcpy(&out->id, given, sizeof out->id);
    out->on = true;
    size_t n = 0;
    for (size_t i = 0; i < target->n_pairs; i++)
        if (!is_of_link(target->pairs[i].name))
            target->pairs[n++] = target->pairs[i];
    target->n_pairs = n;
done:
    kd_buffer_finish(&text);
    return status ? NULL : owner;
}
