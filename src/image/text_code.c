#include "image/text_code.h"

#include <libdeflate.h>
#include <stdbool.h>
#include <string.h>

#define LEVEL 12 /* strongest compression, because the texts are short */

static const char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";

static enum kd_status no_memory(struct kd_error *error) { return kd_error_set(error, KD_ENOMEM, "out of memory"); }

static size_t letters_of(size_t bytes) { return (4 * bytes + 2) / 3; }

static void to_letters(const uint8_t *bytes, size_t size, char *out)
{
    uint32_t bits = 0;
    int held = 0;
    for (size_t i = 0; i < size; i++) {
        bits = bits << 8 | bytes[i];
        for (held += 8; held >= 6; held -= 6)
            *out++ = letters[bits >> (held - 6) & 63];
    }
    if (held)
        *out++ = letters[bits << (6 - held) & 63];
    *out = 0;
}

/* Decodes base64url to *size bytes. Returns false if the code differs from what to_letters would write. */
static bool to_bytes(const char *code, size_t length, uint8_t *out, size_t *size)
{
    uint32_t bits = 0;
    int held = 0;
    *size = 0;
    for (size_t i = 0; i < length; i++) {
        const char *letter = strchr(letters, code[i]);
        if (!letter)
            return false;
        bits = bits << 6 | (uint32_t)(letter - letters);
        if ((held += 6) >= 8)
            out[(*size)++] = (uint8_t)(bits >> (held -= 8));
    }
    return held < 6 && !(bits & ((1u << held) - 1));
}

enum kd_status kd_text_code_write(const void *text, size_t size, struct kd_buffer *out, struct kd_error *error)
{
    uint8_t packed[KD_TEXT_CODE_MOST];
    char code[KD_TEXT_CODE_MOST + 1];
    struct libdeflate_compressor *compressor = libdeflate_alloc_compressor(LEVEL);
    if (!compressor)
        return no_memory(error);
    const size_t n =
        size <= KD_TEXT_CODE_TEXT_MOST ? libdeflate_deflate_compress(compressor, text, size, packed, sizeof packed) : 0;
    libdeflate_free_compressor(compressor);
    if (!n || letters_of(n) > KD_TEXT_CODE_MOST)
        return kd_error_set(error, KD_ETOOBIG, "it is too long for a link, which has at most %d characters",
                            KD_TEXT_CODE_MOST);
    to_letters(packed, n, code);
    return kd_buffer_printf(out, "%s", code) ? no_memory(error) : KD_OK;
}

enum kd_status kd_text_code_read(const char *code, struct kd_buffer *out, struct kd_error *error)
{
    uint8_t packed[KD_TEXT_CODE_MOST];
    char text[KD_TEXT_CODE_TEXT_MOST];
    size_t n, read, size;
    const size_t length = strnlen(code, KD_TEXT_CODE_MOST + 1);
    if (length > KD_TEXT_CODE_MOST)
        return kd_error_set(error, KD_ETOOBIG, "the code of the link is longer than %d characters", KD_TEXT_CODE_MOST);
    if (!to_bytes(code, length, packed, &n))
        return kd_error_set(error, KD_EINVAL,
                            "the code of the link must be base64url (letters, digits, - and _) of whole bytes");
    struct libdeflate_decompressor *decompressor = libdeflate_alloc_decompressor();
    if (!decompressor)
        return no_memory(error);
    const enum libdeflate_result result =
        libdeflate_deflate_decompress_ex(decompressor, packed, n, text, sizeof text, &read, &size);
    libdeflate_free_decompressor(decompressor);
    if (result == LIBDEFLATE_INSUFFICIENT_SPACE)
        return kd_error_set(error, KD_ETOOBIG, "the code of the link unpacks to more than %d bytes",
                            KD_TEXT_CODE_TEXT_MOST);
    if (result != LIBDEFLATE_SUCCESS || read != n || memchr(text, 0, size))
        return kd_error_set(error, KD_EINVAL, "the code of the link must be one deflated text (RFC 1951)");
    return kd_buffer_append(out, text, size) || kd_buffer_printf(out, "%s", "") ? no_memory(error) : KD_OK;
}
