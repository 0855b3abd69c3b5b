/* Fuzz target: parts of files, selected by the first byte: NPY arrays, ZIP members, FITS headers, Base64. */
#include "fuzz.h"

#include "image/exr.h"
#include "image/fits.h"
#include "image/npy.h"
#include "image/unzip.h"
#include "playground/base64.h"

/* A header that was read is written. The written header must read as the same array. */
static void read_array(const struct kd_fuzz_text *bytes)
{
    struct kd_npy array, again;
    struct kd_buffer out = { 0 }, text = { 0 };
    struct kd_error error = { 0 };
    enum kd_status status = kd_npy_read(bytes->at, bytes->size, &array, &error);
    if (status)
        kd_fuzz_refused(status, &error);
    else {
        CHECK(array.header_size + array.items * array.item_size == bytes->size, "an array of %llu items has %zu bytes",
              (unsigned long long)array.items, bytes->size);
        CHECK(!kd_npy_write_header(&array, &out) &&
                  !kd_buffer_append(&out, bytes->at + array.header_size, bytes->size - array.header_size),
              "an array cannot be written");
        CHECK(!kd_npy_read(out.data, out.size, &again, &error), "an array that was written: %s", error.message);
        CHECK(again.items == array.items && again.item_size == array.item_size &&
                  again.n_dimensions == array.n_dimensions && !memcmp(again.shape, array.shape, sizeof array.shape),
              "an array became one of another shape");
        CHECK(again.n_fields == array.n_fields &&
                  !memcmp(again.fields, array.fields, array.n_fields * sizeof *array.fields),
              "an array became one of other fields");
    }
    status = kd_npy_read_text(bytes->at, bytes->size, &text, &error);
    if (status)
        kd_fuzz_refused(status, &error);
    kd_buffer_finish(&out);
    kd_buffer_finish(&text);
}

static void read_members(const struct kd_fuzz_text *bytes)
{
    static const char *const names[] = { "a", "header.npy", "notes.json" };
    struct kd_unzip zip;
    struct kd_error error = { 0 };
    enum kd_status status = kd_unzip_open(bytes->at, bytes->size, &zip, &error);
    if (status)
        kd_fuzz_refused(status, &error);
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        const struct kd_unzip_member *member = status ? NULL : kd_unzip_find(&zip, names[i]);
        struct kd_buffer out = { 0 };
        enum kd_status taken = member ? kd_unzip_take(&zip, member, 1 << 16, &out, &error) : KD_OK;
        if (taken)
            kd_fuzz_refused(taken, &error);
        CHECK(out.size <= 1 << 16 && !(taken && out.data), "a member has %zu bytes", out.size);
        kd_buffer_finish(&out);
    }
    kd_unzip_finish(&zip);
}

static void read_header(const struct kd_fuzz_text *bytes)
{
    struct kd_buffer out = { 0 };
    long long number;
    const size_t n = kd_fits_head_size(bytes->at, bytes->size);
    CHECK(n <= bytes->size && !(n % KD_FITS_BLOCK), "a header has %zu bytes of %zu", n, bytes->size);
    if (n) {
        kd_fits_number(bytes->at, n, "NAXIS", &number);
        kd_fits_find_real(bytes->at, n, "BSCALE");
    }
    kd_fits_find(bytes->at, bytes->size, "SCENE", &out);
    kd_buffer_finish(&out);
}

/* A header written with these texts must read back with the same texts. */
static void write_header(const struct kd_fuzz_text *text)
{
    struct kd_buffer cards = { 0 }, file = { 0 }, back = { 0 };
    const float pixel = 0;
    const struct kd_fits_array array = { 1, 1, 1, &pixel };
    char *plain = text->at;
    for (char *c = plain; *c; c++)
        if (*c < ' ' || *c > '~')
            *c = '?';
    size_t n = strlen(plain);
    /* FITS 4.0, 4.2.1: trailing blanks are not significant, and "&" marks a continuation */
    while (n && (plain[n - 1] == ' ' || plain[n - 1] == '&'))
        plain[--n] = 0;
    CHECK(!kd_fits_text(&cards, "SCENE", plain, NULL) && !kd_fits_image(&file, true, &array, &cards),
          "a header cannot be written");
    const enum kd_status status = kd_fits_find(file.data, file.size, "SCENE", &back);
    while (back.size && back.data[back.size - 1] == ' ')
        back.size--;
    CHECK(!status && back.size == n && !memcmp(back.data ? (char *)back.data : "", plain, n),
          "the text \"%s\" became \"%.*s\"", plain, (int)back.size, (char *)back.data);
    kd_buffer_finish(&cards);
    kd_buffer_finish(&file);
    kd_buffer_finish(&back);
}

static void read_exr(const struct kd_fuzz_text *bytes)
{
    struct kd_buffer out = { 0 };
    struct kd_error error = { 0 };
    const enum kd_status status = kd_exr_find_text(bytes->at, bytes->size, "scene", &out, &error);
    if (status)
        kd_fuzz_refused(status, &error);
    kd_buffer_finish(&out);
}

static void read_base64(const struct kd_fuzz_text *text)
{
    const size_t length = strlen(text->at);
    char bytes[300], again[404];
    for (size_t n = length / 4 * 3 >= 2 ? length / 4 * 3 - 2 : 0; n <= length / 4 * 3 && n <= sizeof bytes; n++)
        if (kd_base64_read(bytes, n, text->at)) {
            kd_base64_write(again, bytes, n);
            CHECK(!strcmp(again, text->at), "%s became %s", text->at, again);
        }
}

int kd_fuzz_files(const uint8_t *data, size_t size)
{
    static void (*const read[])(const struct kd_fuzz_text *) = { read_array,   read_members, read_header,
                                                                 write_header, read_base64,  read_exr };
    if (!size)
        return 0;
    const unsigned which = *data % 6;
    struct kd_fuzz_text bytes =
        which == 3 || which == 4 ? kd_fuzz_copy(data + 1, size - 1) : kd_fuzz_bare(data + 1, size - 1);
    read[which](&bytes);
    free(bytes.at);
    return 0;
}
