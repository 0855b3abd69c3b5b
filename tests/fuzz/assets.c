/* Fuzz target: an asset, checked as a server does before it stores one, and decoded as by a renderer: a picture of the
 * sky, or a grid of matter.
 *
 * The checksums of a PNG's chunks, which mutations break, are repaired first. Input that begins with "grid" becomes an
 * NPZ file. After "grid" it consists of records. A record is a byte, two bytes of length, and an array's bytes (or only
 * the text of a header). The first byte selects a name from the list and a value of `ways`. */
#include "fuzz.h"

#include "image/npy.h"
#include "image/zip.h"
#include "mend.h"
#include "render/emit/matter_grid.h"
#include "render/sky/image.h"
#include "server/asset/folder.h"

#include <math.h>

#define PIXELS (1u << 16) /* maximum size of a picture that is also decoded */

static const char *const names[] = { "header",      "r",           "theta",       "phi",       "density",
                                     "temperature", "u_con_r",     "u_con_theta", "u_cov_phi", "u_con_t",
                                     "b_con_r",     "b_con_theta", "b_cov_phi",   "time" };
enum { NAMES = sizeof names / sizeof *names, MEMBERS = 64 };

/* How a member is stored in the file, or which error it has. */
enum way { STORED, DEFLATED, LONG, METHOD, CHECKSUM, ENCRYPTED, SIZE, PLACE, WAYS };

static void add(struct kd_zip *zip, const char *name, enum way way, const uint8_t *data, size_t size)
{
    struct kd_buffer bytes = { 0 };
    char file[40];
    static const uint8_t zeros[4096];
    const struct kd_npy text = {
        .fields = { { "", KD_NPY_U1, 0 } }, .n_fields = 1, .shape = { size }, .n_dimensions = 1
    };
    snprintf(file, sizeof file, "%s.npy", name);
    CHECK(!(size && *data == '{' && kd_npy_write_header(&text, &bytes)) && !kd_buffer_append(&bytes, data, size),
          "out of memory");
    for (int i = 0; way == LONG && i < 4200; i++) /* 17 MB, which exceeds every limit */
        CHECK(!kd_buffer_append(&bytes, zeros, sizeof zeros), "out of memory");
    const void *at = bytes.data ? (void *)bytes.data : "";
    if (way == STORED)
        CHECK(!kd_zip_begin(zip, file, bytes.size) && !kd_zip_append(zip, at, bytes.size), "a member cannot be added");
    else
        CHECK(!kd_zip_add(zip, file, at, bytes.size), "a member cannot be added");
    kd_buffer_finish(&bytes);
}

/* Corrupts entries of the ZIP directory, in the fields of APPNOTE 4.3.12. */
static void spoil(struct kd_buffer *file, const enum way *ways, const uint8_t *values, size_t n)
{
    static const int fields[WAYS] = { [METHOD] = 10, [CHECKSUM] = 16, [ENCRYPTED] = 8, [SIZE] = 24, [PLACE] = 42 };
    size_t at = 0;
    memcpy(&at, file->data + file->size - 6, 4); /* the file is little-endian, like this machine */
    for (size_t i = 0; i < n; i++) {
        uint8_t *entry = file->data + at;
        if (fields[ways[i]])
            entry[fields[ways[i]]] ^= values[i] | 1;
        at += 46 + (size_t)entry[28] + (size_t)entry[30];
    }
}

static void make_grid(const uint8_t *data, size_t size, struct kd_buffer *out)
{
    struct kd_zip *zip;
    enum way ways[MEMBERS];
    uint8_t values[MEMBERS];
    size_t members = 0;
    CHECK(!kd_zip_create(out, true, &zip), "a ZIP file cannot be begun");
    while (size >= 3 && members < MEMBERS) {
        const size_t length = data[1] | (size_t)data[2] << 8, n = length < size - 3 ? length : size - 3;
        ways[members] = (enum way)(data[0] / NAMES % WAYS);
        values[members] = (uint8_t)(data[1] + (n ? data[3] : 0));
        add(zip, names[data[0] % NAMES], ways[members++], data + 3, n);
        data += 3 + n;
        size -= 3 + n;
    }
    CHECK(!kd_zip_close(zip), "a ZIP file cannot be ended");
    kd_zip_destroy(zip);
    spoil(out, ways, values, members);
}

static void check_grid(const void *data, size_t size, const struct kd_asset_about *about, enum kd_status looked)
{
    struct kd_matter_grid grid;
    struct kd_error error = { 0 };
    const enum kd_status status = kd_matter_grid_read(data, size, &grid, &error);
    CHECK(!status == !looked, "a grid is looked at as %s and read as %s", kd_status_name(looked),
          kd_status_name(status));
    if (status) {
        kd_fuzz_refused(status, &error);
        return;
    }
    const struct kd_asset_grid told = kd_matter_grid_told(&grid);
    CHECK(!memcmp(told.nodes, about->grid.nodes, sizeof told.nodes) && told.spin == about->grid.spin &&
              told.charge == about->grid.charge && told.frames == about->grid.frames && told.late == about->grid.late &&
              !memcmp(told.time, about->grid.time, sizeof told.time),
          "a grid is another one than it was looked at");
    CHECK(fabs(told.spin) <= 1 && told.charge >= 0 && told.spin * told.spin + told.charge * told.charge <= 1,
          "a grid is for a hole of spin %g and charge %g", told.spin, told.charge);
    for (int k = 0; grid.packed && k < 2; k++)
        CHECK(isfinite(grid.least[k]) && grid.range[k] >= 0, "range %d is %g from %g", k, grid.range[k], grid.least[k]);
    for (size_t i = 0;
         !grid.packed && i < (size_t)grid.frames * grid.rows * grid.columns * grid.layers * KD_MATTER_FLOATS; i++)
        CHECK(isfinite(grid.nodes[i]), "number %zu of node %zu is %g", i % KD_MATTER_FLOATS, i / KD_MATTER_FLOATS,
              (double)grid.nodes[i]);
    kd_matter_grid_finish(&grid);
}

static void check_sky(const void *data, size_t size)
{
    struct kd_sky_picture picture = { 0 };
    char credit[KD_SKY_CREDIT];
    struct kd_error error = { 0 };
    const enum kd_status status = kd_sky_image(data, size, &picture, credit, &error);
    if (status) {
        kd_fuzz_refused(status, &error);
        return;
    }
    kd_fuzz_shown(credit);
    CHECK(picture.height && !(picture.height & (picture.height - 1)) && picture.width == 2 * picture.height,
          "a sky has %u x %u texels", picture.width, picture.height);
    for (size_t i = 0; i < (size_t)3 * picture.width * picture.height; i++)
        CHECK(picture.texels[i] >= 0 && picture.texels[i] <= 1.000001f, "a texel is %g", (double)picture.texels[i]);
    kd_sky_picture_finish(&picture);
}

int kd_fuzz_assets(const uint8_t *data, size_t size)
{
    struct kd_buffer made = { 0 };
    struct kd_asset_about about = { 0 };
    struct kd_error error = { 0 };
    const bool grid = size > 4 && !memcmp(data, "grid", 4);
    if (grid)
        make_grid(data + 4, size - 4, &made);
    struct kd_fuzz_text bytes = grid ? kd_fuzz_bare(made.data, made.size) : kd_fuzz_bare(data, size);
    kd_fuzz_mend_png((uint8_t *)bytes.at, bytes.size);
    const enum kd_status status = kd_asset_look(bytes.at, bytes.size, &about, &error);
    if (status)
        kd_fuzz_refused(status, &error);
    if (kd_matter_grid_is(bytes.at, bytes.size))
        check_grid(bytes.at, bytes.size, &about, status);
    else if (!status && (uint64_t)about.width * about.height <= PIXELS)
        check_sky(bytes.at, bytes.size);
    free(bytes.at);
    kd_buffer_finish(&made);
    return 0;
}
