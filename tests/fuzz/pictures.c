/* Fuzz target: the scene in a picture file (PNG, JPEG, WebP, FITS, OpenEXR or NPZ), as for --from. A PNG's pixels and
 * texts are read too, and must read back the same after writing. Input that is not a picture becomes the scene in a
 * picture file. */
#include "fuzz.h"

#include "image/jpeg.h"
#include "image/png.h"
#include "image/webp.h"
#include "image/zip.h"
#include "mend.h"
#include "render/output/format.h"

static void check_png(const void *data, size_t size)
{
    struct kd_png picture, again;
    struct kd_png_about about;
    struct kd_buffer out = { 0 };
    struct kd_error error = { 0 };
    enum kd_status status = kd_png_decode(data, size, &picture, &error);
    if (status) {
        kd_fuzz_refused(status, &error);
        return;
    }
    if (!kd_png_look(data, size, &about, NULL))
        CHECK(about.width == picture.width && about.height == picture.height,
              "a picture of %u x %u pixels was %u x %u at a look", picture.width, picture.height, about.width,
              about.height);
    const struct kd_png_params params = { picture.width,  picture.height, picture.bit_depth, 1,
                                          picture.pixels, picture.text,   picture.n_text };
    status = kd_png_encode(&params, &out, &error);
    if (status)
        kd_fuzz_refused(status, &error); /* writing fails, because kerrd may not write the keys of some texts */
    else {
        CHECK(!kd_png_decode(out.data, out.size, &again, &error), "a picture that was written cannot be read: %s",
              error.message);
        CHECK(again.width == picture.width && again.height == picture.height && again.bit_depth == picture.bit_depth &&
                  again.n_text == picture.n_text,
              "a picture became another one");
        CHECK(!memcmp(again.pixels, picture.pixels,
                      (size_t)3 * picture.width * picture.height * ((size_t)picture.bit_depth / 8)),
              "pixels became others");
        for (size_t i = 0; i < picture.n_text; i++)
            CHECK(!strcmp(again.text[i].key, picture.text[i].key) &&
                      !strcmp(again.text[i].value, picture.text[i].value),
                  "a text of %s became another one", picture.text[i].key);
        kd_png_finish(&again);
    }
    kd_buffer_finish(&out);
    kd_png_finish(&picture);
}

/* A JPEG or WebP of one pixel with this scene in its XMP. */
static void wrap_lossy(bool webp, const char *text, struct kd_buffer *out)
{
    const uint8_t pixel[3] = { 1, 2, 3 };
    struct kd_buffer bare = { 0 }, xmp = { 0 };
    struct kd_error error = { 0 };
    CHECK(!(webp ? kd_webp_encode : kd_jpeg_encode)(1, 1, pixel, 90, &bare, &error), "a pixel cannot be encoded: %s",
          error.message);
    CHECK(!kd_buffer_printf(&xmp, "<kerrd:scene>%s</kerrd:scene>", text), "there is no memory");
    const enum kd_status status = (webp ? kd_webp_add_xmp : kd_jpeg_add_xmp)(&bare, xmp.data, xmp.size, out, &error);
    if (status)
        kd_fuzz_refused(status, &error);
    kd_buffer_finish(&bare);
    kd_buffer_finish(&xmp);
}

/* A picture of one pixel with this scene, or a ZIP file with these notes. The first letter chooses the kind. */
static void wrap(const char *text, size_t size, struct kd_buffer *out)
{
    const uint8_t pixel[3] = { 1, 2, 3 };
    const struct kd_png_text scene = { "kerrd:scene", text };
    const struct kd_png_params params = { 1, 1, 8, 0, pixel, &scene, 1 };
    struct kd_error error = { 0 };
    struct kd_zip *zip;
    if (*text == '%' || *text == '&') {
        wrap_lossy(*text == '&', text + 1, out);
        return;
    }
    if (*text != '!') {
        const enum kd_status status = kd_png_encode(&params, out, &error);
        if (status)
            kd_fuzz_refused(status, &error);
        return;
    }
    CHECK(!kd_zip_create(out, true, &zip) && !kd_zip_add(zip, "notes.json", text + 1, size - 1) && !kd_zip_close(zip),
          "a ZIP file cannot be made");
    kd_zip_destroy(zip);
}

int kd_fuzz_pictures(const uint8_t *data, size_t size)
{
    struct kd_buffer made = { 0 };
    struct kd_scene before, scene;
    struct kd_error error = { 0 };
    struct kd_fuzz_text text = kd_fuzz_copy(data, size);
    if (!kd_format_of_bytes(data, size))
        wrap(text.at, strlen(text.at), &made);
    struct kd_fuzz_text bytes = made.size ? kd_fuzz_bare(made.data, made.size) : kd_fuzz_bare(data, size);
    kd_fuzz_mend_png((uint8_t *)bytes.at, bytes.size);
    kd_scene_defaults(&before);
    scene = before;
    const enum kd_status status = kd_format_scene(bytes.at, bytes.size, &scene, &error);
    if (status) {
        kd_fuzz_refused(status, &error);
        CHECK(!memcmp(&scene, &before, sizeof scene), "the scene of a picture that was refused has changed");
    } else
        kd_fuzz_sound(&scene);
    if (bytes.size > 4 && !memcmp(bytes.at, "\x89PNG", 4))
        check_png(bytes.at, bytes.size);
    free(bytes.at);
    free(text.at);
    kd_buffer_finish(&made);
    return 0;
}
