/* Writes a frame's layers as a FITS file: kd_format_fits. The first word of image.layers is the primary array. Each
 * further word is an IMAGE extension of that name. "rgb" has a third axis. The primary header has the scene, the hole,
 * the observer, the accuracy, and each approximation in force. All headers have world coordinates. */
#include "render/output/format.h"

#include "image/fits.h"
#include "render/output/fits_cards.h"
#include "render/output/notes.h"
#include "render/output/numbers.h"
#include "render/emit/radio.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static enum kd_status put_notes(struct kd_buffer *cards, const struct kd_picture *picture, const struct kd_notes *notes)
{
    enum kd_status status;
    KD_TRY(kd_fits_text(cards, "ORIGIN", "kerrd " KD_VERSION, NULL));
    KD_TRY(kd_fits_put_scene(cards, picture->scene, NULL));
    KD_TRY(kd_fits_text(cards, "LONGSTRN", "OGIP 1.0", "texts may go on: CONTINUE"));
    KD_TRY(kd_fits_text(cards, "KDHASH", notes->hash, NULL));
    KD_TRY(kd_fits_text(cards, "KDDEVICE", picture->device, NULL));
    KD_TRY(kd_fits_text(cards, "KDACCUR", notes->accuracy, NULL));
    struct kd_approximation one;
    for (size_t i = 0; kd_picture_approximation(&picture->plan->report, &picture->frame->accuracy, i, &one); i++) {
        char key[32];
        snprintf(key, sizeof key, "KDAPPR%zu", i + 1);
        KD_TRY(kd_fits_text(cards, key, one.text, NULL));
    }
    if (*picture->frame->credit)
        KD_TRY(kd_fits_text(cards, "KDCREDIT", picture->frame->credit, NULL));
    if (*notes->clock)
        KD_TRY(kd_fits_text(cards, "KDCLOCK", notes->clock, NULL));
    if (*notes->flux) {
        KD_TRY(
            kd_fits_real(cards, KD_FITS_FLUX, kd_flux_jy(picture->scene, picture->frame), "Jy; of the whole picture"));
        KD_TRY(kd_fits_text(cards, "KDFLUX", notes->flux, NULL));
    }
    KD_TRY(kd_fits_text(cards, "KDSCENE", (const char *)notes->scene.data, NULL));
done:
    return status;
}

static bool is_stokes(int kind)
{
    return kind == KD_LAYER_stokes_q || kind == KD_LAYER_stokes_u || kind == KD_LAYER_stokes_v;
}

static bool has(const struct kd_scene *scene, int kind)
{
    for (int i = 0; i < scene->image.layers.count; i++)
        if (scene->image.layers.at[i].word == kind)
            return true;
    return false;
}

/* If only the picture of a radio source is requested, the file holds the flux of each pixel instead, and Stokes Q, U
 * and V if the light is polarised. Radio astronomy programs (ehtim, CASA, DS9) expect the flux as the primary array.
 * ehtim 1.3.2 reads no file in which any array is a picture of three colours. */
static enum kd_status draws(struct kd_scene *scene, struct kd_error *error)
{
    struct kd_words *layers = &scene->image.layers;
    const int polarised = scene->polarization.model == KD_POLARIZATION_NONE       ? 0
                          : scene->polarization.model == KD_POLARIZATION_TRANSFER ? 3
                                                                                  : 2;
    static const int stokes[] = { KD_LAYER_stokes_q, KD_LAYER_stokes_u, KD_LAYER_stokes_v };
    (void)error;
    if (layers->count != 1 || layers->at[0].word != KD_LAYER_rgb || !kd_layers_have_flux(scene))
        return KD_OK;
    layers->at[0].word = KD_LAYER_jy_per_pixel;
    for (int i = 0; i < polarised; i++)
        layers->at[layers->count++] = (struct kd_numbered_word) { (int16_t)stokes[i], -1 };
    return KD_OK;
}

/* If the file also has the layer jy_per_pixel, Stokes Q, U and V are converted to that layer's unit. Programs that read
 * these layers together expect the same unit. Sets *out to numbers that the caller frees, or to NULL if nothing is
 * converted. */
static enum kd_status in_jansky(const struct kd_picture *picture, size_t word, const struct kd_layer *layer,
                                float **out)
{
    const size_t n = (size_t)picture->frame->width * picture->frame->height;
    *out = NULL;
    if (!is_stokes(picture->scene->image.layers.at[word].word) || !has(picture->scene, KD_LAYER_jy_per_pixel))
        return KD_OK;
    const float unit = (float)kd_radio_jansky_pixel(picture->scene), *from = layer->data;
    if (!(*out = malloc(n * sizeof **out)))
        return KD_ENOMEM;
    for (size_t i = 0; i < n; i++)
        (*out)[i] = unit * from[i];
    return KD_OK;
}

/* word: index in image.layers. */
static enum kd_status put_unit(struct kd_buffer *out, const struct kd_picture *picture, size_t word,
                               const struct kd_number_layer *layer, const struct kd_notes *notes)
{
    struct kd_buffer cards = { 0 };
    float *jansky;
    const struct kd_wcs wcs = kd_wcs_of(picture->scene);
    enum kd_status status;
    KD_TRY(in_jansky(picture, word, layer->layer, &jansky));
    const bool flux = jansky || picture->scene->image.layers.at[word].word == KD_LAYER_jy_per_pixel;
    const struct kd_fits_array array = { picture->frame->width, picture->frame->height, layer->layer->channels,
                                         jansky ? jansky : layer->layer->data };
    KD_TRY(kd_fits_put_layer(&cards, layer->name, flux ? "JY/PIXEL" : layer->unit, layer->layer->channels > 1, &wcs));
    if (notes)
        KD_TRY(put_notes(&cards, picture, notes));
    KD_TRY(kd_fits_image(out, notes != NULL, &array, &cards));
done:
    free(jansky);
    kd_buffer_finish(&cards);
    return status;
}

static enum kd_status encode(const struct kd_picture *picture, enum kd_effort effort, void **memory,
                             struct kd_buffer *out, struct kd_error *error)
{
    struct kd_numbers numbers;
    struct kd_notes notes = { 0 };
    enum kd_status status;
    (void)effort, (void)memory;
    KD_TRY(kd_numbers_of(picture, &numbers, error));
    KD_TRY(kd_notes_of(picture, &notes, error));
    for (size_t i = 0; i < numbers.n && !status; i++)
        status = put_unit(out, picture, i, &numbers.at[i], i ? NULL : &notes);
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
    status = status ? kd_error_set(error, status,
                                   "the FITS file contains no scene: its primary header has no complete card KDSCENE")
                    : kd_notes_scene((const char *)text.data, text.size, out, error);
    kd_buffer_finish(&text);
    return status;
}

const struct kd_format kd_format_fits = {
    .name = "fits",
    .media_type = KD_FITS_TYPE,
    .magic = "SIMPLE  =",
    .carries = KD_CARRIES_LAYERS,
    .draws = draws,
    .encode = encode,
    .scene = scene_in,
};

const struct kd_format kd_format_cubed = {
    .name = "fits",
    .media_type = KD_FITS_TYPE,
    .magic = "SIMPLE  =",
    .carries = KD_CARRIES_LAYERS,
    .encode = encode,
    .scene = scene_in,
};
