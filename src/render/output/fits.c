/* This writes a frame's layers as a FITS file: kd_format_fits. The first word of image.layers is the primary array, each more an IMAGE extension of
 * that name; "rgb" has a third axis. The primary header tells the scene, the hole, the observer, accuracy, and each approximation in force;
 * all have world coordinates. */
#include "render/output/format.h"

#include "image/fits.h"
#include "physics/scale.h"
#include "render/output/notes.h"
#include "render/output/numbers.h"
#include "render/output/wcs.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static enum kd_status put_axes(struct kd_buffer *cards, const struct kd_wcs *wcs, const struct kd_wcs_axis axes[2], const char *alternate)
{
    static const char *const names[] = { "CTYPE", "CRPIX", "CRVAL", "CDELT", "CUNIT" };
    enum kd_status status;
    for (int i = 0; i < 2; i++) {
        const double numbers[] = { 0, axes[i].pixel, axes[i].value, axes[i].step };
        char key[16];
        for (int k = 0; k < 5; k++) {
            snprintf(key, sizeof key, "%s%d%s", names[k], i + 1, alternate);
            if (k == 0 || k == 4) {
                const char *text = k ? axes[i].unit : axes[i].type;
                if (*text)
                    KD_TRY(kd_fits_text(cards, key, text, NULL));
            } else {
                KD_TRY(kd_fits_real(cards, key, numbers[k], NULL));
            }
        }
        for (int j = 0; j < 2 && wcs->turn[0][0] != 1; j++) {
            snprintf(key, sizeof key, "PC%d_%d%s", i + 1, j + 1, alternate);
            KD_TRY(kd_fits_real(cards, key, wcs->turn[i][j], NULL));
        }
    }
    return KD_OK;
done:
    return status;
}

static enum kd_status put_world(struct kd_buffer *cards, const struct kd_wcs *wcs)
{
    enum kd_status status = KD_OK;
    if (!wcs->known)
        return kd_fits_comment(cards, "no world coordinates: a ring, or two pictures side by side");
    KD_TRY(put_axes(cards, wcs, wcs->at, ""));
    if (!wcs->far) {
        KD_TRY(kd_fits_text(cards, "WCSNAME", "camera", "to the right of its axis, and above it"));
        return KD_OK;
    }
    KD_TRY(put_axes(cards, wcs, wcs->impact, "A"));
    KD_TRY(kd_fits_text(cards, "WCSNAMEA", "impact parameters", "M"));
done:
    return status;
}

/* What a unit of the file says of its own layer. */
static enum kd_status put_layer(struct kd_buffer *cards, const struct kd_number_layer *layer, const struct kd_wcs *wcs)
{
    enum kd_status status;
    const bool rgb = layer->layer->channels > 1;
    KD_TRY(kd_fits_text(cards, "EXTNAME", layer->name, "word of image.layers"));
    if (*layer->unit)
        KD_TRY(kd_fits_text(cards, "BUNIT", layer->unit, *layer->unit == 'M' ? "G m/c^2" : NULL));
    KD_TRY(put_world(cards, wcs));
    if (rgb) {
        KD_TRY(kd_fits_text(cards, "CTYPE3", "RGB", "linear sRGB"));
        KD_TRY(kd_fits_comment(cards, "in units of the brightest surface brightness of the disk at g = 1"));
    }
done:
    return status;
}

static enum kd_status put_number(struct kd_buffer *cards, const char *key, double value, const char *comment)
{
    return isfinite(value) ? kd_fits_real(cards, key, value, comment) : kd_fits_text(cards, key, "infinity", comment);
}

/* The hole and the observer, for readers that know nothing of scenes. */
static enum kd_status put_scene(struct kd_buffer *cards, const struct kd_scene *s)
{
    enum kd_status status;
    KD_TRY(kd_fits_text(cards, "OBJECT", "Kerr black hole", NULL));
    KD_TRY(kd_fits_real(cards, "OBSRA", 0, "deg; the hole is taken to be there"));
    KD_TRY(kd_fits_real(cards, "OBSDEC", 0, "deg"));
    KD_TRY(put_number(cards, "SPIN", s->spacetime.spin, "a/M"));
    KD_TRY(put_number(cards, "MASS", s->spacetime.mass_msun, "solar masses"));
    KD_TRY(put_number(cards, "DISTANCE", s->spacetime.distance_pc, "pc"));
    KD_TRY(put_number(cards, "M_UAS", kd_scale_microarcseconds(s->spacetime.mass_msun, s->spacetime.distance_pc), "M on the sky, microarcseconds"));
    KD_TRY(put_number(cards, "CAM_R", s->camera.r, "M; Boyer-Lindquist radius of the observer"));
    KD_TRY(put_number(cards, "CAM_INCL", s->camera.inclination_deg, "deg; from the axis of spin"));
    KD_TRY(put_number(cards, "CAM_AZIM", s->camera.azimuth_deg, "deg"));
    KD_TRY(put_number(cards, "TIME_M", s->top.time, "M; coordinate time of the scene"));
done:
    return status;
}

static enum kd_status put_notes(struct kd_buffer *cards, const struct kd_picture *picture, const struct kd_notes *notes)
{
    enum kd_status status;
    KD_TRY(kd_fits_text(cards, "ORIGIN", "kerrd " KD_VERSION, NULL));
    KD_TRY(put_scene(cards, picture->scene));
    KD_TRY(kd_fits_text(cards, "LONGSTRN", "OGIP 1.0", "texts may go on: CONTINUE"));
    KD_TRY(kd_fits_text(cards, "KDHASH", notes->hash, NULL));
    KD_TRY(kd_fits_text(cards, "KDDEVICE", picture->device, NULL));
    KD_TRY(kd_fits_text(cards, "KDACCUR", notes->accuracy, NULL));
    for (size_t i = 0; i < picture->plan->n_approximations; i++) {
        char key[32];
        snprintf(key, sizeof key, "KDAPPR%zu", i + 1);
        KD_TRY(kd_fits_text(cards, key, picture->plan->approximations[i], NULL));
    }
    if (*picture->frame->credit)
        KD_TRY(kd_fits_text(cards, "KDCREDIT", picture->frame->credit, NULL));
    if (*notes->clock)
        KD_TRY(kd_fits_text(cards, "KDCLOCK", notes->clock, NULL));
    KD_TRY(kd_fits_text(cards, "KDSCENE", (const char *)notes->scene.data, NULL));
done:
    return status;
}

static enum kd_status put_unit(struct kd_buffer *out, const struct kd_picture *picture, const struct kd_number_layer *layer, const struct kd_notes *notes)
{
    struct kd_buffer cards = { 0 };
    const struct kd_wcs wcs = kd_wcs_of(picture->scene);
    const struct kd_fits_array array = { picture->frame->width, picture->frame->height, layer->layer->channels, layer->layer->data };
    enum kd_status status;
    KD_TRY(put_layer(&cards, layer, &wcs));
    if (notes)
        KD_TRY(put_notes(&cards, picture, notes));
    KD_TRY(kd_fits_image(out, notes != NULL, &array, &cards));
done:
    kd_buffer_finish(&cards);
    return status;
}

static enum kd_status encode(const struct kd_picture *picture, enum kd_effort effort, void **memory, struct kd_buffer *out,
                             struct kd_error *error)
{
    struct kd_numbers numbers;
    struct kd_notes notes = { 0 };
    enum kd_status status;
    (void)effort, (void)memory;
    KD_TRY(kd_numbers_of(picture, &numbers, error));
    KD_TRY(kd_notes_of(picture, &notes, error));
    for (size_t i = 0; i < numbers.n && !status; i++)
        status = put_unit(out, picture, &numbers.at[i], i ? NULL : &notes);
    if (status)
        kd_error_set(error, status, "out of memory for a FITS file of %zu layers", numbers.n);
done:
    kd_notes_finish(&notes);
    return status;
}

static enum kd_status scene_in(const void *data, size_t size, struct kd_scene *out, struct kd_error *error)
{
    struct kd_buffer text = { 0 };
    enum kd_status status = kd_fits_find(data, size, "KDSCENE", &text);
    status = status ? kd_error_set(error, status, "the FITS file holds no scene: its primary header has no whole card KDSCENE")
                    : kd_notes_scene((const char *)text.data, text.size, out, error);
    kd_buffer_finish(&text);
    return status;
}

const struct kd_format kd_format_fits = {
    .name = "fits", .media_type = "application/fits", .magic = "SIMPLE  =", .carries = KD_CARRIES_LAYERS, .encode = encode, .scene = scene_in,
};
