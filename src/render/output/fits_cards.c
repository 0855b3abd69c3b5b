/* Cards of FITS headers shared by several files. */
#include "render/output/fits_cards.h"

#include "image/fits.h"
#include "physics/spacetime/scale.h"
#include "scene/dynamic_bodies.h"
#include "scene/table.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

enum kd_status kd_fits_put_world_axes(struct kd_buffer *cards, const struct kd_wcs *wcs,
                                      const struct kd_wcs_axis axes[2], const char *alternate)
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
    if (!wcs)
        return kd_fits_comment(cards, "world coordinates of the pictures: they differ from scene to scene");
    if (!wcs->known)
        return kd_fits_comment(cards, "no world coordinates: a ring, or two pictures side by side");
    KD_TRY(kd_fits_put_world_axes(cards, wcs, wcs->at, ""));
    if (!wcs->far) {
        KD_TRY(kd_fits_text(cards, "WCSNAME", "camera", "to the right of its axis, and above it"));
        return KD_OK;
    }
    KD_TRY(kd_fits_put_world_axes(cards, wcs, wcs->impact, "A"));
    KD_TRY(kd_fits_text(cards, "WCSNAMEA", "impact parameters", "M"));
done:
    return status;
}

/* Name of the Stokes parameter of all light that the layer of this name contains. NULL: the layer contains no such
 * parameter. */
static const char *stokes_of(const char *name)
{
    static const char *const known[][2] = { { "intensity", "I" },    { "specific_intensity", "I" },
                                            { "jy_per_pixel", "I" }, { "stokes_q", "Q" },
                                            { "stokes_u", "U" },     { "stokes_v", "V" } };
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        if (!strcmp(name, known[i][0]))
            return known[i][1];
    return NULL;
}

enum kd_status kd_fits_put_layer(struct kd_buffer *cards, const char *name, const char *unit, bool rgb,
                                 const struct kd_wcs *wcs)
{
    enum kd_status status;
    const char *stokes = stokes_of(name);
    KD_TRY(kd_fits_text(cards, "EXTNAME", name, "word of image.layers"));
    KD_TRY(kd_fits_text(cards, "BUNIT", unit, !*unit ? "a pure number" : *unit == 'M' ? "G m/c^2" : NULL));
    if (stokes)
        KD_TRY(kd_fits_text(cards, "STOKES", stokes, NULL));
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

static double microarcseconds(const struct kd_scene *s)
{
    return kd_scale_microarcseconds(s->spacetime.mass_msun, s->spacetime.distance_pc);
}

static bool varies(const struct kd_sweep *sweep, const char *path)
{
    for (size_t i = 0; sweep && i < sweep->n_axes; i++)
        if (kd_scene_same_path(sweep->axes[i].path, path))
            return true;
    return false;
}

/* FITS 4.0, section 9.5: DATE-OBS is MJD-OBS as a calendar date; ehtim reads MJD. mjd: 0 to 1e6, which is in the year
 * 4596. 40587 is the MJD of 1 January 1970. */
static enum kd_status put_date(struct kd_buffer *cards, double mjd)
{
    const time_t seconds = (time_t)llround((mjd - 40587) * 86400);
    struct tm day;
    char text[32];
    enum kd_status status;
    gmtime_r(&seconds, &day);
    strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%S", &day);
    KD_TRY(kd_fits_text(cards, "DATE-OBS", text, "UTC; of the picture"));
    KD_TRY(kd_fits_real(cards, "MJD-OBS", mjd, "days"));
    KD_TRY(kd_fits_real(cards, "MJD", mjd, "days"));
done:
    return status;
}

enum kd_status kd_fits_put_scene(struct kd_buffer *cards, const struct kd_scene *s, const struct kd_sweep *sweep)
{
    const struct {
        const char *key;
        double value;
        const char *comment, *of[2];
    } numbers[] = {
        { "OBSRA", s->source.ra_deg, "deg; of the hole", { "source.ra_deg" } },
        { "OBSDEC", s->source.dec_deg, "deg", { "source.dec_deg" } },
        { "SPIN", s->spacetime.spin, "a/M", { "spacetime.spin" } },
#define MORE(x, name, member, least, most, shown, unit, card, ...) \
    { card, s->spacetime.name, unit "; of the hole", { "spacetime." #name } },
        KD_HOLE_MORE(MORE, )
#undef MORE
            { "MASS", s->spacetime.mass_msun, "solar masses", { "spacetime.mass_msun" } },
        { "DISTANCE", s->spacetime.distance_pc, "pc", { "spacetime.distance_pc" } },
        { "M_UAS",
          microarcseconds(s),
          "M on the sky, microarcseconds",
          { "spacetime.mass_msun", "spacetime.distance_pc" } },
        { "CAM_R", s->camera.r, "M; Boyer-Lindquist radius of the observer", { "camera.r" } },
        { "CAM_INCL", s->camera.inclination_deg, "deg; from the axis of spin", { "camera.inclination_deg" } },
        { "CAM_AZIM", s->camera.azimuth_deg, "deg", { "camera.azimuth_deg" } },
        { "TIME_M", s->top.time, "M; coordinate time of the scene", { "time" } },
    };
    enum kd_status status;
    static const char *const objects[] = { [KD_SOURCE_NONE] = "Kerr black hole",
                                           [KD_SOURCE_M87] = "M87",
                                           [KD_SOURCE_SGRA] = "SGRA" }; /* ehtim's names */
    if (!varies(sweep, "source.name"))
        KD_TRY(kd_fits_text(cards, "OBJECT", objects[s->source.name], NULL));
    KD_TRY(kd_fits_text(cards, "TELESCOP", "kerrd", "a model, and no observation"));
    if (isfinite(s->source.mjd) && !varies(sweep, "source.mjd"))
        KD_TRY(put_date(cards, s->source.mjd));
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
        if (!varies(sweep, numbers[i].of[0]) && !(numbers[i].of[1] && varies(sweep, numbers[i].of[1])))
            KD_TRY(put_number(cards, numbers[i].key, numbers[i].value, numbers[i].comment));
    if ((kd_scene_is_radio(s) || kd_scene_has_disk_frequency(s)) && !varies(sweep, kd_scene_frequency_path(s)) &&
        !varies(sweep, "volume.model") && !varies(sweep, "disk.band") && !varies(sweep, "disk.model"))
        KD_TRY(kd_fits_real(cards, "FREQ", kd_scene_frequency_ghz(s) * 1e9, "Hz; that is observed"));
    if (s->dynamic.at) {
        KD_TRY(kd_fits_real(cards, "PLAY_T", s->dynamic.at->time, "M; time of the playground that is shown"));
        KD_TRY(kd_fits_real(cards, "PLAY_N", (double)s->dynamic.at->n, "its bodies"));
        KD_TRY(kd_fits_real(cards, "PLAY_D", s->dynamic.at->debris.pieces, "its pieces of debris"));
    }
    if (s->dynamic.at && *s->dynamic.at->snapshot)
        KD_TRY(kd_fits_text(cards, "PLAYSHA", s->dynamic.at->snapshot, "SHA-256"));
done:
    return status;
}
