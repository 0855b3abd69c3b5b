#include "base/markup.h"

#include <string.h>

static const struct {
    char character;
    const char *reference;
} table[] = { { '&', "&amp;" }, { '<', "&lt;" }, { '>', "&gt;" }, { '"', "&quot;" }, { '\'', "&#39;" } };
enum { N = sizeof table / sizeof *table };

enum kd_status kd_markup_escape(const char *text, const char *characters, struct kd_buffer *out)
{
    enum kd_status status = kd_buffer_append(out, "", 0);
    while (*text && !status) {
        const size_t plain = strcspn(text, characters);
        status = kd_buffer_append(out, text, plain);
        text += plain;
        for (int i = 0; i < N && *text && !status; i++)
            if (*text == table[i].character) {
                status = kd_buffer_printf(out, "%s", table[i].reference);
                text++;
                break;
            }
    }
    return status;
}

void kd_markup_unescape(struct kd_buffer *text)
{
    size_t to = 0;
    for (size_t from = 0; from < text->size; to++) {
        const char *at = (const char *)text->data + from;
        size_t taken = 1;
        char character = *at;
        for (int i = 0; i < N && *at == '&'; i++)
            if (!strncmp(at, table[i].reference, strlen(table[i].reference))) {
                character = table[i].character;
                taken = strlen(table[i].reference);
                break;
            }
        text->data[to] = (uint8_t)character;
        from += taken;
    }
    text->size = to;
    text->data[to] = 0;
}
