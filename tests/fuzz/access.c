/* Fuzz target: a token file. The words of the file are looked up as tokens after it is read. */
#include "fuzz.h"

#include "server/http/access.h"

int kd_fuzz_access(const uint8_t *data, size_t size)
{
    struct kd_access *access = NULL;
    struct kd_error error = { 0 };
    char path[64];
    kd_fuzz_file("tokens", data, size);
    snprintf(path, sizeof path, "%s/tokens", kd_fuzz_folder(NULL));
    const enum kd_status status = kd_access_read(path, &access, &error);
    if (status) {
        kd_fuzz_refused(status, &error);
        CHECK(!access, "a token file was refused, and is there");
        return 0;
    }
    struct kd_fuzz_text text = kd_fuzz_copy(data, size);
    size_t found = 0;
    for (char *rest, *word = strtok_r(text.at, " \t\r\n", &rest); word; word = strtok_r(NULL, " \t\r\n", &rest)) {
        const struct kd_visitor *visitor = kd_access_find(access, word);
        const size_t length = strlen(word);
        found += visitor != NULL;
        CHECK(!visitor || (length >= KD_ACCESS_TOKEN_MIN && length <= KD_ACCESS_TOKEN_MAX), "%s is a token", word);
        CHECK(!visitor || ((visitor->role == KD_ROLE_VIEW || visitor->role == KD_ROLE_RENDER) && *visitor->name),
              "a token is of nobody");
    }
    CHECK(found || memchr(data, '#', size), "a token file that was read holds no token");
    CHECK(!kd_access_find(access, ""), "no token is one");
    free(text.at);
    kd_access_free(access);
    return 0;
}
