#include "image/fits.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    VALUE = 10,
    PIECE = 67,
    ROOM = 20
    /* VALUE: column at which a value starts. PIECE: maximum number of characters between the quotes of a text,
     * including a "&". ROOM: width of a number. */
};

static enum kd_status put_card(struct kd_buffer *cards, const char *text)
{
    char card[KD_FITS_CARD + 1];
    snprintf(card, sizeof card, "%-*.*s", KD_FITS_CARD, KD_FITS_CARD, text);
    return kd_buffer_append(cards, card, KD_FITS_CARD);
}

/* value: already formatted. */
static enum kd_status put_value(struct kd_buffer *cards, const char *key, const char *value, const char *comment)
{
    char card[2 * KD_FITS_CARD];
    snprintf(card, sizeof card, "%-8.8s= %-*s%s%s", key, ROOM, value, comment ? " / " : "", comment ? comment : "");
    return put_card(cards, card);
}

enum kd_status kd_fits_integer(struct kd_buffer *cards, const char *key, long long value, const char *comment)
{
    char text[32];
    snprintf(text, sizeof text, "%*lld", ROOM, value);
    return put_value(cards, key, text, comment);
}

enum kd_status kd_fits_real(struct kd_buffer *cards, const char *key, double value, const char *comment)
{
    char number[40], text[48];
    for (int digits = 15; digits <= 17; digits++) {
        snprintf(number, sizeof number, "%.*G", digits, value);
        if (strtod(number, NULL) == value)
            break;
    }
    snprintf(text, sizeof text, "%*s%s", ROOM - (strpbrk(number, ".E") ? 0 : 1), number,
             strpbrk(number, ".E") ? "" : ".");
    return put_value(cards, key, text, comment);
}

enum kd_status kd_fits_logical(struct kd_buffer *cards, const char *key, bool value, const char *comment)
{
    char text[32];
    snprintf(text, sizeof text, "%*s", ROOM, value ? "T" : "F");
    return put_value(cards, key, text, comment);
}

enum kd_status kd_fits_comment(struct kd_buffer *cards, const char *text)
{
    char card[2 * KD_FITS_CARD];
    snprintf(card, sizeof card, "COMMENT %s", text);
    return put_card(cards, card);
}

/* Length of the next piece of a text. Quotes in the text are doubled, and the two quotes of a pair always stay in
 * the same piece. */
static size_t piece_of(const char *text, size_t most, char *out)
{
    size_t used = 0, n = 0;
    for (; text[n]; n++) {
        size_t needs = text[n] == '\'' ? 2 : 1;
        if (used + needs > most)
            break;
        memset(out + used, text[n] >= ' ' && text[n] <= '~' ? text[n] : '?', needs);
        used += needs;
    }
    out[used] = 0;
    return n;
}

enum kd_status kd_fits_text(struct kd_buffer *cards, const char *key, const char *value, const char *comment)
{
    char piece[KD_FITS_CARD], text[KD_FITS_CARD + 8];
    size_t n = piece_of(value, PIECE + 1, piece);
    if (!value[n]) { /* the whole text fits into one card; a text is padded to at least eight characters */
        snprintf(text, sizeof text, "'%-8s'", piece);
        return put_value(cards, key, text, comment);
    }
    for (bool first = true; *value; first = false) {
        size_t taken = piece_of(value, PIECE, piece);
        value += taken;
        snprintf(text, sizeof text, "'%s%s'", piece, *value ? "&" : "");
        char card[2 * KD_FITS_CARD];
        snprintf(card, sizeof card, "%-8.8s%s%s", first ? key : "CONTINUE", first ? "= " : "  ", text);
        enum kd_status status = put_card(cards, card);
        if (status)
            return status;
    }
    return KD_OK;
}

uint32_t kd_fits_add_sums(uint32_t a, uint32_t b)
{
    uint64_t all = (uint64_t)a + b;
    return (uint32_t)(all & 0xffffffffu) + (uint32_t)(all >> 32);
}

uint32_t kd_fits_sum(uint32_t sum, const void *bytes, size_t size)
{
    const uint8_t *data = bytes;
    uint64_t all = sum;
    for (size_t i = 0; i < size; i += 4)
        all += (uint32_t)data[i] << 24 | (uint32_t)data[i + 1] << 16 | (uint32_t)data[i + 2] << 8 | data[i + 3];
    while (all >> 32)
        all = (all & 0xffffffffu) + (all >> 32);
    return (uint32_t)all;
}

/* Encodes a sum as sixteen letters and digits, whose own sum at their place in the header is the complement of `sum`
 * (appendix J.2 of the standard). */
static void encode_sum(uint32_t sum, char out[17])
{
    uint32_t value = ~sum;
    char letters[16];
    for (int i = 0; i < 4; i++) {
        int byte = (int)(value >> (24 - 8 * i) & 0xff), ch[4];
        for (int j = 0; j < 4; j++)
            ch[j] = byte / 4 + '0' + (j ? 0 : byte % 4);
        for (bool again = true; again;) { /* shifts pairs of characters until none of them is punctuation */
            again = false;
            for (int j = 0; j < 4; j += 2)
                for (int k = 0; k < 2; k++)
                    if ((ch[j + k] >= ':' && ch[j + k] <= '@') || (ch[j + k] >= '[' && ch[j + k] <= '`')) {
                        ch[j]++;
                        ch[j + 1]--;
                        again = true;
                        break;
                    }
        }
        for (int j = 0; j < 4; j++)
            letters[4 * j + i] = (char)ch[j];
    }
    for (int i = 0; i < 16; i++)
        out[i] = letters[(i + 15) % 16];
    out[16] = 0;
}

static enum kd_status pad(struct kd_buffer *out, size_t from, char with)
{
    char block[KD_FITS_BLOCK];
    memset(block, with, sizeof block);
    size_t over = (out->size - from) % KD_FITS_BLOCK;
    return over ? kd_buffer_append(out, block, KD_FITS_BLOCK - over) : KD_OK;
}

static void put_row(const struct kd_fits_array *array, uint32_t y, uint32_t channel, uint8_t *to)
{
    const float *from = array->data + (size_t)y * array->width * array->channels + channel;
    for (uint32_t x = 0; x < array->width; x++, to += 4) {
        uint32_t bits;
        memcpy(&bits, from + (size_t)x * array->channels, 4);
        to[0] = (uint8_t)(bits >> 24);
        to[1] = (uint8_t)(bits >> 16);
        to[2] = (uint8_t)(bits >> 8);
        to[3] = (uint8_t)bits;
    }
}

static enum kd_status put_data(struct kd_buffer *out, const struct kd_fits_array *array)
{
    size_t row = 4ull * array->width, from = out->size;
    uint8_t *bytes = malloc(row);
    enum kd_status status = bytes ? KD_OK : KD_ENOMEM;
    for (uint32_t c = 0; c < array->channels; c++)
        for (uint32_t y = array->height; y-- && !status;) {
            put_row(array, y, c, bytes);
            status = kd_buffer_append(out, bytes, row);
        }
    free(bytes);
    return status ? status : pad(out, from, 0);
}

/* Appends the cards that describe the data. */
static enum kd_status put_shape(struct kd_buffer *out, const struct kd_fits_shape *shape)
{
    char key[16];
    enum kd_status status;
    if (shape->primary)
        KD_TRY(put_value(out, "SIMPLE", "                   T", "conforms to the FITS standard"));
    else
        KD_TRY(kd_fits_text(out, "XTENSION", shape->table ? "BINTABLE" : "IMAGE",
                            shape->table ? "table" : "image extension"));
    KD_TRY(kd_fits_integer(out, "BITPIX", shape->table ? 8 : -32, shape->table ? NULL : "IEEE numbers of 32 bits"));
    KD_TRY(kd_fits_integer(out, "NAXIS", shape->n_axes, NULL));
    for (unsigned i = 0; i < shape->n_axes; i++) {
        snprintf(key, sizeof key, "NAXIS%u", i + 1);
        KD_TRY(kd_fits_integer(out, key, (long long)shape->axes[i],
                               shape->table || i > 1 ? NULL
                               : i                   ? "from the lowest row"
                                                     : "from the left"));
    }
    if (shape->primary) {
        KD_TRY(put_value(out, "EXTEND", "                   T", NULL));
    } else {
        KD_TRY(kd_fits_integer(out, "PCOUNT", 0, NULL));
        KD_TRY(kd_fits_integer(out, "GCOUNT", 1, NULL));
    }
    if (shape->table)
        KD_TRY(kd_fits_integer(out, "TFIELDS", shape->columns, NULL));
done:
    return status;
}

enum kd_status kd_fits_head(struct kd_buffer *out, const struct kd_fits_shape *shape, const struct kd_buffer *cards,
                            uint32_t data_sum)
{
    const size_t from = out->size;
    char text[32], letters[17];
    enum kd_status status;
    KD_TRY(put_shape(out, shape));
    KD_TRY(kd_buffer_append(out, cards->data, cards->size));
    snprintf(text, sizeof text, "%u", data_sum);
    KD_TRY(kd_fits_text(out, "DATASUM", text, "checksum of the data, ones' complement"));
    const size_t checksum = out->size + VALUE + 1;
    KD_TRY(kd_fits_text(out, "CHECKSUM", "0000000000000000", "checksum of header and data"));
    KD_TRY(put_card(out, "END"));
    KD_TRY(pad(out, from, ' '));
    encode_sum(kd_fits_sum(data_sum, out->data + from, out->size - from), letters);
    memcpy(out->data + checksum, letters, 16);
done:
    return status;
}

enum kd_status kd_fits_image(struct kd_buffer *out, bool primary, const struct kd_fits_array *array,
                             const struct kd_buffer *cards)
{
    const struct kd_fits_shape shape = { .primary = primary,
                                         .n_axes = array->channels > 1 ? 3 : 2,
                                         .axes = { array->width, array->height, array->channels } };
    struct kd_buffer data = { 0 };
    enum kd_status status;
    KD_TRY(put_data(&data, array));
    KD_TRY(kd_fits_head(out, &shape, cards, kd_fits_sum(0, data.data, data.size)));
    KD_TRY(kd_buffer_append(out, data.data, data.size));
done:
    kd_buffer_finish(&data);
    return status;
}

size_t kd_fits_head_size(const void *data, size_t size)
{
    for (size_t at = 0; at + KD_FITS_CARD <= size; at += KD_FITS_CARD)
        if (!strncmp((const char *)data + at, "END     ", 8)) {
            size_t whole = (at / KD_FITS_BLOCK + 1) * KD_FITS_BLOCK;
            return whole <= size ? whole : 0;
        }
    return 0;
}

/* Gets the text after the "= " of a card; "" if there is no such card. */
static void value_of(const void *head, size_t size, const char *key, char out[KD_FITS_CARD - VALUE + 1])
{
    char wanted[12];
    snprintf(wanted, sizeof wanted, "%-8.8s= ", key);
    *out = 0;
    for (size_t at = 0; at + KD_FITS_CARD <= size && !*out; at += KD_FITS_CARD)
        if (!strncmp((const char *)head + at, wanted, VALUE))
            snprintf(out, KD_FITS_CARD - VALUE + 1, "%.*s", KD_FITS_CARD - VALUE, (const char *)head + at + VALUE);
}

bool kd_fits_number(const void *head, size_t size, const char *key, long long *out)
{
    char value[KD_FITS_CARD - VALUE + 1], *end;
    value_of(head, size, key, value);
    *out = strtoll(value, &end, 10);
    return end > value;
}

double kd_fits_find_real(const void *head, size_t size, const char *key)
{
    char value[KD_FITS_CARD - VALUE + 1], *end;
    value_of(head, size, key, value);
    const double number = strtod(value, &end);
    return end > value ? number : NAN;
}

/* Appends the text between the quotes of a card. *more: true if another piece follows. */
static enum kd_status unquote(const char *card, struct kd_buffer *out, bool *more)
{
    const char *at = card + VALUE, *end = card + KD_FITS_CARD;
    size_t from = out->size;
    *more = false;
    if (*at++ != '\'')
        return KD_EINVAL;
    for (; at < end; at++) {
        if (*at == '\'' && (at + 1 == end || at[1] != '\''))
            break;
        at += *at == '\'';
        enum kd_status status = kd_buffer_append(out, at, 1);
        if (status)
            return status;
    }
    if (at == end)
        return KD_EINVAL;
    *more = out->size > from && out->data[out->size - 1] == '&';
    if (*more)
        out->size--;
    return KD_OK;
}

enum kd_status kd_fits_find(const void *data, size_t size, const char *key, struct kd_buffer *out)
{
    char wanted[12];
    snprintf(wanted, sizeof wanted, "%-8.8s= ", key);
    for (size_t at = 0; at + KD_FITS_CARD <= size; at += KD_FITS_CARD) {
        const char *card = (const char *)data + at;
        bool more = true;
        if (!strncmp(card, "END     ", 8))
            break;
        if (strncmp(card, wanted, VALUE))
            continue;
        enum kd_status status = unquote(card, out, &more);
        while (!status && more && (at += KD_FITS_CARD) + KD_FITS_CARD <= size) {
            card = (const char *)data + at;
            status = strncmp(card, "CONTINUE  ", VALUE) ? KD_EINVAL : unquote(card, out, &more);
        }
        return status ? status : more ? KD_EINVAL : KD_OK;
    }
    return KD_EINVAL;
}
