/* Computes the integrals that need no pictures, and fills the columns of their answers. */
#include "base/pause.h"
#include "integral/answer.h"
#include "integral/image_cache.h"
#include "integral/integral_internal.h"
#include "physics/disk/disk_spectrum.h"
#include "physics/disk/disk_stokes.h"
#include "physics/disk/thin_disk.h"
#include "physics/disk/transfer_function.h"
#include "physics/math/constants.h"
#include "physics/spacetime/kerr.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static const char *const line_sources[] = {
    "C. T. Cunningham 1975, ApJ 202, 788 (redshift and transfer)",
    "S. E. Gralla & A. Lupsasca 2020, Phys. Rev. D 101, 044032 (rays in closed form)",
    "T. Dauser et al. 2013, MNRAS 430, 1694 (lamppost)",
    "D. R. Wilkins & A. C. Fabian 2012, MNRAS 424, 1284 (coronae off the axis)",
    "A. Laor 1991, ApJ 376, 90; F. Haardt 1993, ApJ 413, 680; S. Chandrasekhar 1960, Radiative Transfer, 68 (limb)",
    NULL,
};
static const char *const transfer_sources[] = {
    "C. T. Cunningham 1975, ApJ 202, 788",
    "R. Speith, H. Riffert & H. Ruder 1995, Comput. Phys. Commun. 88, 109, eq. 1",
    "S. E. Gralla & A. Lupsasca 2020, Phys. Rev. D 101, 044032 (rays in closed form)",
    NULL,
};
static const char *const spectrum_sources[] = {
    "D. N. Page & K. S. Thorne 1974, ApJ 191, 499 (flux)",
    "L.-X. Li et al. 2005, ApJS 157, 335, eq. 6 (spectrum)",
    "T. Shimura & F. Takahara 1995, ApJ 445, 780 (colour correction)",
    "S. E. Gralla & A. Lupsasca 2020, Phys. Rev. D 101, 044032 (rays in closed form)",
    NULL,
};
static const char *const spectrum_approximations[] = {
    "the disk is thin and opaque and lies in the equatorial plane; its gas is on circular orbits, with no torque at "
    "the ISCO and no gas inside it",
    "each ring shines as a black body of its colour temperature, dimmed so that its flux is conserved",
    "only the direct image counts; light that goes round the hole is ignored",
    NULL,
};
static const char no_returning[] = "light that returns to the disk is ignored";
static const char with_returning[] = "the disk absorbs all light that returns to it and radiates it again as a black "
                                     "body; this light is that of a disk without outer edge";
static const char *const echo_sources[] = {
    "P. Uttley et al. 2014, A&ARv 22, 72 (lags)",
    "C. S. Reynolds et al. 1999, ApJ 514, 164 (impulse response)",
    "D. R. Wilkins & A. C. Fabian 2012, MNRAS 424, 1284 (rings of a corona)",
    "C. T. Cunningham 1975, ApJ 202, 788 (redshift and transfer)",
    "S. E. Gralla & A. Lupsasca 2020, Phys. Rev. D 101, 044032 (rays in closed form)",
    NULL,
};
static const char *const echo_approximations[] = {
    "the disk is thin and opaque and lies in the equatorial plane; its gas is on circular orbits, and there is none "
    "inside the inner edge",
    "only direct light counts; light that crosses the plane inside the inner edge, or goes round the hole, is ignored",
    "the gas emits without delay; the source shines isotropically in its own frame; all parts of a ring flash at the "
    "same time",
    NULL,
};
static const char scattered_once[] =
    "a deep atmosphere of free electrons reflects the light that returns to it for the first time, without changing "
    "its energy in the gas's frame; light that returns again is ignored, and so is the work of the stresses that its "
    "angular momentum causes";
static const char *const disk_approximations[] = {
    "the disk is thin and opaque and lies in the equatorial plane; its gas is on circular orbits, and there is none "
    "inside the inner edge",
    "only the direct image counts; light that goes round the hole and crosses the plane again is ignored",
    NULL,
};

static const char lower_face[] = "nearly edge on, the lower face of the disk is seen past its outer edge; the light of "
                                 "this face is included, except light that crosses the plane inside the inner edge";
static const char upper_face[] = "only the upper face is computed; nearly edge on, the lower face would also be seen "
                                 "past the outer edge of the disk";

static const char *const visibility_sources[] = {
    "A. R. Thompson, J. M. Moran & G. W. Swenson 2017, Interferometry and Synthesis in Radio Astronomy, 3rd ed., eq. "
    "3.7",
    "M. D. Johnson et al. 2020, Sci. Adv. 6, eaaz1310 (rings at long baselines)",
    NULL,
};
static const char *const visibility_approximations[] = {
    "no light comes from beyond the map's border; edge_share shows how bright the border is",
    "each pixel is a point at its centre; baselines beyond nyquist_gl are aliased to shorter ones",
    "the instrument is ideal: it has no beam, noise or gaps, and does not average over time or bandwidth",
    NULL,
};
static const char *const compare_sources[] = {
    "A. A. Chael et al. 2018, ApJ 857, 23, 2.2 and appendix C (closures, chi^2), as ehtim 1.3.2 has them with ttype "
    "\"direct\"",
    "A. R. Thompson, J. M. Moran & G. W. Swenson 2017, Interferometry and Synthesis in Radio Astronomy, 3rd ed., eq. "
    "3.7, 9.3 (debiasing), 10.3 (closures)",
    "A. E. E. Rogers et al. 1974, ApJ 193, 293 (closure phases)",
    "M. D. Johnson et al. 2018, ApJ 865, 104; D. Psaltis et al. 2018, arXiv:1805.01242 (scattering)",
    NULL,
};
static const char *const compare_approximations[] = {
    "no light comes from beyond the map's border; edge_share shows how bright the border is",
    "each pixel has the shape that pulse names; amplitudes of baselines beyond nyquist_gl are too small",
    "errors of closures are taken as Gaussian and independent, also where closures have a baseline in common",
    "the model has one time and one frequency, those of the scene",
    "interstellar scattering, if requested, is the average kernel without refractive noise",
    NULL,
};
static const char *const observe_sources[] = {
    "A. R. Thompson, J. M. Moran & G. W. Swenson 2017, Interferometry and Synthesis in Radio Astronomy, 3rd ed., eq. "
    "3.7, 6.2 (noise)",
    "M. D. Johnson et al. 2018, ApJ 865, 104; D. Psaltis et al. 2018, arXiv:1805.01242 (scattering)",
    NULL,
};
static const char *const observe_approximations[] = {
    "no light comes from beyond the map's border; edge_share shows how bright the border is",
    "each pixel has the shape that pulse names; amplitudes of baselines beyond nyquist_gl are too small",
    "noise is Gaussian and independent; stations have no errors of amplitude and phase",
    "the model has one time and one frequency, those of the scene, and Stokes I alone",
    "interstellar scattering, if requested, is the average kernel without refractive noise",
    NULL,
};
static const char *const volume_sources[] = {
    "G. B. Rybicki & A. P. Lightman 1979, Radiative Processes in Astrophysics, 1.3, 4.9 (flux, and I/nu^3)",
    NULL,
};
static const char *const volume_approximations[] = {
    "no light comes from beyond the border of the picture",
    NULL,
};

#define ECHO_VALUES \
    { "isco", "M", "innermost stable circular orbit", false }, \
        { "strength", "1", \
          "equivalent width of the line at the observer over that in the gas's frame, for gas that emits as many " \
          "line photons as continuum photons per unit of energy reach it", \
          false }, \
        { "direct_flux", "1", \
          "ratio of the source's continuum at the observer to that of the same source at rest far from the hole", \
          false }, \
        { "direct_g", "1", "mean redshift factor of the continuum", false }, \
        { "direct_time", "M", \
          "mean arrival time of the continuum after the flash, minus r + 2 ln r at the observer's radius r", false }, \
    { \
        "unit_s", "s", "GM/c^3", false \
    }

/* Values that describe a map of light. */
#define MAP_VALUES \
    { "pixel_uas", "uas", "distance from one pixel to the next", false }, \
        { "width_uas", "uas", "width of the map", false }, { "height_uas", "uas", "height of the map", false }, \
        { "nyquist_gl", "Gl", "longest baseline that the width of the pixels resolves", false }, \
        { "edge_share", "1", \
          "flux of a map that is everywhere as bright as the map's border, as a share of the map's flux", false }, \
    { \
        "undefined", "pixels", "number of pixels whose light is not a number; they count as dark", false \
    }

static const struct kd_integral_kind_of kinds[KD_INTEGRALS] = {
    [KD_INTEGRAL_LINE] = { "relativistic line profile of a thin disk",
                           { { "isco", "M", "innermost stable circular orbit" },
                             { "total", "M^2",
                               "number of the line's photons, which is the integral of g^3 epsilon f over the image "
                               "plane; with counts \"energy\", energy of the line, the integral of g^4 epsilon f" },
                             { "inside", "1", "share of the line between the first and the last edge" },
                             { "error", "1", "estimated largest error of the cumulative share at any edge" },
                             { "strength", "1",
                               "equivalent width of the line at the observer over that in the gas's frame, for gas "
                               "that emits as many line photons as continuum photons per unit of energy reach it; null "
                               "without a source" },
                             { "direct_flux", "1",
                               "ratio of the source's continuum at the observer to that of the same source at rest far "
                               "from the hole; null without a source" },
                             { "direct_g", "1",
                               "mean redshift factor of the source's continuum at the observer; null without "
                               "a source" } },
                           { { "energy_low", "unit of rest_energy", "edge of the bin" },
                             { "energy_high", "unit of rest_energy", "edge of the bin" },
                             { "share", "1", "share of the line's photons, or of its energy, in the bin" },
                             { "cumulative", "1", "share of the line from the first edge to energy_high" } },
                           line_sources,
                           disk_approximations },
    [KD_INTEGRAL_TRANSFER] = { "Cunningham's transfer function of a thin disk",
                               { { "isco", "M", "innermost stable circular orbit" } },
                               { { "r", "M", "radius of the ring" },
                                 { "g_star", "1", "(g - g_min)/(g_max - g_min)" },
                                 { "g", "1", "redshift factor: energy at infinity over energy in the gas's frame" },
                                 { "f_near", "1", "f of the side that is closer to the observer" },
                                 { "f_far", "1", "f of the far side" },
                                 { "mu_near", "1",
                                   "near side: cosine of the angle between the emitted light and the disk's normal in "
                                   "the gas's frame" },
                                 { "mu_far", "1", "far side: cosine of the same angle" },
                                 { "g_min", "1", "smallest g of the ring" },
                                 { "g_max", "1", "largest g of the ring" } },
                               transfer_sources,
                               disk_approximations },
    [KD_INTEGRAL_SPECTRUM] = { "spectrum of a thin disk of black bodies",
                               { { "isco", "M", "innermost stable circular orbit" },
                                 { "t_max_k", "K", "effective temperature of the hottest ring" },
                                 { "luminosity_w", "W", "efficiency times Mdot c^2" },
                                 { "error", "1",
                                   "estimated relative error of the flux where it exceeds a millionth of its "
                                   "maximum" } },
                               { { "frequency_hz", "Hz", "at the observer" },
                                 { "flux_w_m2_hz", "W/m^2/Hz", "F_nu" },
                                 { "flux_jy", "Jy", "F_nu" },
                                 { "nu_l_nu_w", "W",
                                   "4 pi D^2 nu F_nu, the luminosity of an isotropic source with this flux" },
                                 { "degree", "1", "degree of linear polarisation; null unless polarization is yes" },
                                 { "angle_deg", "deg",
                                   "angle of the electric field from the projection of the disk's axis, which is "
                                   "north, "
                                   "to the east, from -90 to 90; null unless polarization is yes" } },
                               spectrum_sources,
                               spectrum_approximations },
    [KD_INTEGRAL_IMPULSE] = { "echo of a flash on a thin disk, by energy and time",
                              { ECHO_VALUES,
                                { "inside", "1", "share of the line in all bins", false },
                                { "mean_time", "M", "mean time of all photons of the line", false },
                                { "error", "1",
                                  "estimated largest error of the share of the line before a time and below an energy",
                                  false } },
                              { { "energy_low", "unit of rest_energy", "edge of the bin", false },
                                { "energy_high", "unit of rest_energy", "edge of the bin", false },
                                { "time_low", "M", "edge of the bin, after the direct light's mean arrival", false },
                                { "time_high", "M", "edge of the bin", false },
                                { "share", "1", "share of the line's photons in the bin", false } },
                              echo_sources,
                              echo_approximations },
    [KD_INTEGRAL_LAGS] = { "lags of an echo by frequency and energy",
                           { ECHO_VALUES, { "error", "M", "largest value of the column error", false } },
                           { { "frequency", "c^3/GM", "Fourier frequency", false },
                             { "frequency_hz", "Hz", "the same", false },
                             { "energy_low", "unit of rest_energy", "edge of the bin", false },
                             { "energy_high", "unit of rest_energy", "edge of the bin", false },
                             { "lag", "M",
                               "phase of the cross spectrum over 2 pi frequency; positive: the bin comes after the "
                               "reference",
                               false },
                             { "lag_s", "s", "the same", false },
                             { "reflected", "1", "share of the line in the bin's photons: R/(1 + R), the dilution",
                               false },
                             { "error", "M", "estimated error of the lag", false } },
                           echo_sources,
                           echo_approximations },
    [KD_INTEGRAL_VOLUME] = { "spectrum of a scene at one frequency, with one picture for each frequency",
                             { { "width", "pixels", "of each picture" },
                               { "height", "pixels", "of each picture" },
                               { "error", "1", "largest value of the column error" } },
                             { { "frequency_hz", "Hz", "at the observer" },
                               { "flux_w_m2_hz", "W/m^2/Hz", "F_nu" },
                               { "flux_jy", "Jy", "F_nu" },
                               { "nu_l_nu_w", "W",
                                 "4 pi D^2 nu F_nu, the luminosity of an isotropic source with this flux" },
                               { "error", "1",
                                 "estimated relative error of the flux, from a picture 1.5 times as fine; 1: the error "
                                 "is at least as large as the flux" } },
                             volume_sources,
                             volume_approximations },
    [KD_INTEGRAL_VISIBILITY] = { "visibilities of a scene's picture",
                                 { { "flux_jy", "Jy", "flux of the whole map; null if its light has no frequency" },
                                   { "pixel_uas", "uas", "distance from one pixel to the next" },
                                   { "width_uas", "uas", "width of the map" },
                                   { "height_uas", "uas", "height of the map" },
                                   { "nyquist_gl", "Gl", "longest baseline that the width of the pixels resolves" },
                                   { "edge_share", "1",
                                     "flux of a map that is everywhere as bright as the map's border, as a share of "
                                     "the map's flux" },
                                   { "undefined", "pixels",
                                     "number of pixels whose light is not a number; they count as dark" },
                                   { "error", NULL, "largest value of the column error" } },
                                 { { "u_gl", "Gl", "baseline to the east, in units of 1e9 wavelengths" },
                                   { "v_gl", "Gl", "to the north" },
                                   { "length_gl", "Gl", "of the baseline" },
                                   { "order", "1", "-1: all light; n: light of image order n alone" },
                                   { "re", NULL, "real part" },
                                   { "im", NULL, "imaginary part" },
                                   { "amplitude", NULL, "amplitude, in Jy or as a share of the flux of all light" },
                                   { "phase_deg", "deg", "phase about the position of the hole, from -180 to 180" },
                                   { "error", NULL, "estimated error of re and im, from a map 1.5 times as fine" } },
                                 visibility_sources,
                                 visibility_approximations },
    [KD_INTEGRAL_COMPARE] = { "a scene compared with an interferometer's observation",
                              { { "flux_jy", "Jy", "flux of the whole compared map; null if nothing determines it",
                                  false },
                                MAP_VALUES,
                                { "model_error", "Jy",
                                  "largest estimated error of the model's amplitudes, from a map 1.5 times as fine",
                                  false },
                                { "size", "1", "factor by which the map is enlarged, at the same flux", false },
                                { "position_angle_deg", "deg", "angle by which the map is rotated, from north to east",
                                  false },
                                { "shift_east_uas", "uas", "shift of the map to the east", false },
                                { "shift_north_uas", "uas", "shift of the map to the north", false } },
                              { { "product", "",
                                  "amplitude, closure_phase, log_closure_amplitude, visibility_re or visibility_im",
                                  true },
                                { "hour", "h", "UTC, hours since the start of the observation's mjd", false },
                                { "station_1", "", "station of the baseline, triangle or quadrangle", true },
                                { "station_2", "", "the same", true },
                                { "station_3", "", "station of a triangle or quadrangle", true },
                                { "station_4", "",
                                  "station of a quadrangle: the log closure amplitude is that of 12 34 / 14 23", true },
                                { "u_gl", "Gl", "baseline of an amplitude or visibility, in units of 1e9 wavelengths",
                                  false },
                                { "v_gl", "Gl", "the same", false },
                                { "data", "Jy, deg, 1",
                                  "observed amplitude, closure phase, log closure amplitude or part of a visibility",
                                  false },
                                { "error", "Jy, deg, 1", "error of the datum, with systematic errors", false },
                                { "model", "Jy, deg, 1", "value of the scene", false },
                                { "residual", "1", "difference of data and model over the error", false } },
                              compare_sources,
                              compare_approximations },
    [KD_INTEGRAL_SETS] = { "parameter sets of a scene compared with an interferometer's observation",
                           { { "pictures", "1", "number of different scenes, each rendered once", false },
                             { "pixel_uas", "uas", "distance from one pixel to the next, in the last picture", false },
                             { "width_uas", "uas", "width of the last map", false },
                             { "height_uas", "uas", "height of the last map", false },
                             { "nyquist_gl", "Gl", "longest baseline that the pixels of the last map resolve", false },
                             { "edge_share", "1",
                               "flux of a map that is everywhere as bright as the map's border, as a share of the "
                               "map's flux; the largest of all maps",
                               false },
                             { "undefined", "pixels",
                               "number of pixels whose light is not a number, in all pictures; they count as dark",
                               false } },
                           { { "chi2_amplitude", "1",
                               "chi^2 of the amplitudes over their number; null without data, or if the picture is "
                               "dark",
                               false },
                             { "chi2_closure_phase", "1", "chi^2 of the closure phases over their number", false },
                             { "chi2_log_closure_amplitude", "1",
                               "chi^2 of the log closure amplitudes over their number", false },
                             { "chi2_visibility", "1", "chi^2 of the visibilities over their number", false },
                             { "total", "1", "chi^2 summed over all data; null if the picture is dark", false },
                             { "flux_jy", "Jy", "flux of the compared map; null if nothing determines it", false },
                             { "size", "1", "factor by which the map is enlarged, at the same flux", false },
                             { "position_angle_deg", "deg", "angle by which the map is rotated, from north to east",
                               false },
                             { "shift_east_uas", "uas", "shift of the map to the east", false },
                             { "shift_north_uas", "uas", "shift of the map to the north", false },
                             { "converged", "1", "1: all searches converged; 0: one did not, or the picture is dark",
                               false } },
                           compare_sources,
                           compare_approximations },
    [KD_INTEGRAL_OBSERVE] = { "observation of a scene by the array of another observation",
                              { { "flux_jy", "Jy", "flux of the whole map", false },
                                MAP_VALUES,
                                { "model_error", "Jy",
                                  "largest estimated error of the model, from a map 1.5 times as fine", false } },
                              { { "hour", "h", "UTC, hours since the start of the observation's mjd", false },
                                { "station_1", "", "station of the baseline", true },
                                { "station_2", "", "the same", true },
                                { "u_gl", "Gl", "baseline to the east, in units of 1e9 wavelengths", false },
                                { "v_gl", "Gl", "to the north", false },
                                { "re", "Jy", "real part of the simulated visibility", false },
                                { "im", "Jy", "imaginary part", false },
                                { "sigma", "Jy", "error of each part, as in the observation", false },
                                { "model_re", "Jy", "real part without noise", false },
                                { "model_im", "Jy", "imaginary part without noise", false } },
                              observe_sources,
                              observe_approximations },
};

const struct kd_integral_kind_of *kd_integral_kind_of(enum kd_integral what) { return &kinds[what]; }

enum kd_status kd_integral_make_columns(struct kd_integral_answer *answer, size_t rows, struct kd_error *error)
{
    const struct kd_integral_kind_of *kind = &kinds[answer->request->what];
    size_t n = 0;
    while (n < KD_INTEGRAL_COLUMNS && kind->columns[n].name)
        n++;
    if (!(answer->columns[0] = calloc(rows * n, sizeof(double))))
        return kd_error_set(error, KD_ENOMEM, "out of memory for %zu rows", rows);
    for (size_t i = 1; i < n; i++)
        answer->columns[i] = answer->columns[0] + i * rows;
    answer->rows = rows;
    return KD_OK;
}

struct kd_line_params kd_integral_line_params(const struct kd_integral_request *r)
{
    return (struct kd_line_params) { .inner = r->inner,
                                     .outer = r->outer,
                                     .emissivity = r->emissivity,
                                     .index = r->index,
                                     .outer_index = r->outer_index,
                                     .break_r = r->break_r,
                                     .height = r->height,
                                     .photon_index = r->photon_index,
                                     .corona = kd_integral_corona(r),
                                     .tolerance = r->tolerance,
                                     .limb = r->limb,
                                     .energy = r->energy };
}

/* Least cos i at which rays from a source to the observer are searched. Below it they are not found, because they pass
 * the plane of the observer. From here to edge-on the flux changes by 3e-5. */
#define FLATTEST 1.7e-4

/* The light that reaches the observer from the source itself; NaN if there is no source. */
static enum kd_status continuum_of(const struct kd_integral_request *r, const struct kd_disk_image *image,
                                   struct kd_corona_continuum *out, struct kd_error *error)
{
    struct kd_corona_shape shape = kd_integral_corona(r);
    *out = (struct kd_corona_continuum) { NAN, NAN };
    if (r->emissivity < KD_LINE_LAMPPOST)
        return KD_OK;
    if (r->emissivity == KD_LINE_LAMPPOST)
        shape = (struct kd_corona_shape) { .height = r->height, .top = r->height };
    if (!kd_corona_continuum_of(&image->hole, &shape, r->photon_index, fmax(image->cos_i, FLATTEST), out))
        return kd_error_field(error, "/height",
                              "no direct light from the source to the observer was found for this height and "
                              "corona_radius; one of them, or inclination_deg, must be different");
    return KD_OK;
}

static enum kd_status compute_line(const struct kd_integral_request *r, const struct kd_disk_image *image,
                                   struct kd_integral_answer *answer, struct kd_error *error)
{
    const struct kd_line_params params = kd_integral_line_params(r);
    struct kd_line_profile profile;
    double sum = 0;
    enum kd_status status;
    KD_TRY(kd_integral_make_columns(answer, r->bins, error));
    double *const *c = answer->columns, *edges = malloc((r->bins + 1) * sizeof *edges);
    for (size_t i = 0; edges && i <= r->bins; i++)
        edges[i] = r->edges.at[i] / r->rest_energy;
    status = edges ? kd_line_profile(image, &params, edges, (int)r->bins, c[2], &profile, error)
                   : kd_error_set(error, KD_ENOMEM, "out of memory for %u bins", r->bins);
    free(edges);
    for (size_t i = 0; !status && i < r->bins; i++)
        /* the minimum guards against rounding */
        c[0][i] = r->edges.at[i], c[1][i] = r->edges.at[i + 1], c[3][i] = sum = fmin(sum + c[2][i], 1);
    struct kd_corona_continuum direct;
    if (!status)
        status = continuum_of(r, image, &direct, error);
    if (status)
        return status;
    const double one = profile.total * kd_limb_scale(r->limb) / (M_PI * direct.flux),
                 values[] = { image->isco,           profile.total,          sum,     profile.error,
                              r->energy ? NAN : one, 4 * M_PI * direct.flux, direct.g };
    for (size_t i = 0; !status && i < sizeof values / sizeof *values; i++)
        answer->values[i] = values[i];
    if (!image->angles)
        answer->told[answer->n_told++] = lower_face;
done:
    return status;
}

static enum kd_status one_ring(const struct kd_integral_request *r, const struct kd_disk_image *image, size_t at,
                               struct kd_integral_answer *answer, struct kd_error *error)
{
    struct kd_transfer_ring ring;
    char pointer[40];
    snprintf(pointer, sizeof pointer, "/radii/%zu", at);
    if (!kd_transfer_ring_of(image, r->radii.at[at], &ring))
        return kd_error_field(error, pointer,
                              "a radius is %.9g, for which no extreme values of g were found at this inclination; the "
                              "inclination must be further from face on and edge on",
                              r->radii.at[at]);
    for (size_t k = 0; k < r->g_stars; k++) {
        if (kd_pause_every(k, 16))
            return KD_ECANCELLED;
        double g_star = r->g_star.at[k];
        struct kd_transfer side[2];
        if (!kd_transfer_at(image, &ring, g_star, side))
            return kd_error_field(error, pointer, "a radius is %.9g, for which no position with g* %.9g was found",
                                  ring.r, g_star);
        const double row[] = { ring.r,     g_star,     ring.g_min + g_star * (ring.g_max - ring.g_min),
                               side[0].f,  side[1].f,  side[0].mu,
                               side[1].mu, ring.g_min, ring.g_max };
        for (size_t i = 0; i < sizeof row / sizeof *row; i++)
            answer->columns[i][at * r->g_stars + k] = row[i];
    }
    return KD_OK;
}

static enum kd_status compute_transfer(const struct kd_integral_request *r, const struct kd_disk_image *image,
                                       struct kd_integral_answer *answer, struct kd_error *error)
{
    enum kd_status status = kd_integral_make_columns(answer, kd_integral_rows(r), error);
    for (size_t i = 0; !status && i < r->rings; i++)
        status = one_ring(r, image, i, answer, error);
    answer->values[0] = image->isco;
    if (!image->angles)
        answer->told[answer->n_told++] = upper_face;
    return status;
}

static enum kd_status returning_of(const struct kd_integral_request *r, struct kd_returning **table,
                                   struct kd_error *error)
{
    const struct kd_hole *const hole = kd_integral_hole(r);
    const struct kd_hole_parameter largest = kd_hole_largest(hole);
    *table = malloc(sizeof **table);
    if (!*table)
        return kd_error_set(error, KD_ENOMEM, "out of memory for the kernel of returning light");
    kd_returning_init(*table, hole, r->limb);
    if (!((*table)->error < KD_RETURNING_WRONG))
        return kd_error_field(error, largest.pointer,
                              "%s is %.17g, so close to an extremal hole that the energy balance of returning light "
                              "has an error of %.1g (limit %g); it must be further from extremal",
                              largest.name, largest.value, (*table)->error, KD_RETURNING_WRONG);
    return KD_OK;
}

/* Adds scattered light to the fluxes, and fills the columns of polarisation. This computes the direct light a second
 * time; the largest relative difference from the first result is added to the error. */
static enum kd_status add_stokes(const struct kd_integral_request *r, const struct kd_disk_image *image,
                                 const struct kd_disk_spectrum_params *params, struct kd_integral_answer *answer,
                                 struct kd_error *error)
{
    double *const *c = answer->columns, most = 0, off = 0;
    struct kd_disk_stokes *stokes = malloc(sizeof *stokes);
    enum kd_status status = stokes ? KD_OK : kd_error_set(error, KD_ENOMEM, "out of memory for a polarised spectrum");
    KD_TRY(status);
    KD_TRY(kd_disk_stokes_init(stokes, image, params, r->returning == KD_INTEGRAL_SCATTERED, error));
    for (size_t i = 0; i < r->frequencies; i++)
        most = fmax(most, c[1][i]);
    for (size_t i = 0; i < r->frequencies; i++) {
        const struct kd_disk_iqu direct = kd_disk_stokes_at(stokes, stokes->direct, c[0][i]),
                                 scattered = kd_disk_stokes_at(stokes, stokes->scattered, c[0][i]);
        const double q = direct.q + scattered.q, u = direct.u + scattered.u;
        if (c[1][i] > 1e-6 * most)
            off = fmax(off, fabs(direct.i / c[1][i] - 1));
        c[1][i] += scattered.i;
        if (r->polarized && c[1][i] > 0) {
            c[4][i] = hypot(q, u) / c[1][i];
            c[5][i] = atan2(u, q) * (90 / M_PI);
        }
    }
    answer->values[3] += off;
done:
    free(stokes);
    return status;
}

static enum kd_status compute_spectrum(const struct kd_integral_request *r, const struct kd_disk_image *image,
                                       struct kd_integral_answer *answer, struct kd_error *error)
{
    struct kd_disk_spectrum_params params = { r->inner,       r->outer,    r->mass_msun,
                                              r->distance_pc, r->mdot_edd, r->colour_correction,
                                              r->limb,        NULL };
    struct kd_returning *table = NULL; /* table of the scattered light, whose only check is the balance of energies */
    const struct kd_hole *const hole = kd_integral_hole(r);
    const double hottest = fmax(r->inner, kd_disk_peak_page_thorne(hole)), distance = r->distance_pc * KD_PARSEC_M;
    enum kd_status status;
    KD_TRY(kd_integral_make_columns(answer, r->frequencies, error));
    double *const *c = answer->columns;
    if (r->returning)
        KD_TRY(returning_of(r, &table, error));
    params.returning = r->returning == KD_INTEGRAL_ABSORBED ? table : NULL;
    KD_TRY(
        kd_disk_spectrum(image, &params, r->frequencies_hz.at, (int)r->frequencies, c[1], &answer->values[3], error));
    for (size_t i = 0; i < r->frequencies; i++) {
        c[0][i] = r->frequencies_hz.at[i];
        c[4][i] = c[5][i] = NAN;
    }
    if (r->polarized || r->returning == KD_INTEGRAL_SCATTERED)
        KD_TRY(add_stokes(r, image, &params, answer, error));
    for (size_t i = 0; i < r->frequencies; i++) {
        c[2][i] = c[1][i] * 1e26;
        c[3][i] = 4 * M_PI * distance * distance * c[0][i] * c[1][i];
    }
    answer->values[0] = image->isco;
    answer->values[1] = kd_disk_temperature(table ? table->largest : kd_disk_flux_page_thorne(hole, hottest), hole,
                                            r->mass_msun, r->mdot_edd);
    answer->values[3] += table ? table->error : 0;
    answer->told[answer->n_told++] = r->returning == KD_INTEGRAL_SCATTERED ? scattered_once
                                     : table                               ? with_returning
                                                                           : no_returning;
    if (!image->angles)
        answer->told[answer->n_told++] = lower_face;
    answer->values[2] = kd_kerr_efficiency(hole) * kd_disk_rate(hole, r->mass_msun, r->mdot_edd) * KD_C_M_S * KD_C_M_S;
done:
    free(table);
    return status;
}

enum kd_status kd_integral_compute(const struct kd_integral_request *request, struct kd_integral_answer *answer,
                                   struct kd_error *error)
{
    static enum kd_status (*const compute[KD_INTEGRAL_VOLUME])(
        const struct kd_integral_request *, const struct kd_disk_image *, struct kd_integral_answer *,
        struct kd_error *) = { compute_line, compute_transfer, compute_spectrum, kd_integral_impulse,
                               kd_integral_lags };
    struct kd_disk_image *image = NULL;
    enum kd_status status;
    *answer = (struct kd_integral_answer) { .request = request };
    KD_TRY(kd_cached_disk_image(kd_integral_hole(request), request->inclination_deg, &image, error));
    KD_TRY(compute[request->what](request, image, answer, error));
    const struct kd_hole_sentence *of_hole;
    for (size_t i = 0; (of_hole = kd_hole_sentence(kd_hole_given(request), i)); i++)
        answer->told[answer->n_told++] = of_hole->text;
done:
    free(image);
    if (kd_pause()) /* counts as a failure: if kd_pause returned true, the result is incomplete */
        status = kd_error_set(error, KD_ECANCELLED, "the computation of the %s was cancelled",
                              kd_integral_name(request->what));
    if (status)
        kd_integral_answer_finish(answer);
    return status;
}

void kd_integral_answer_finish(struct kd_integral_answer *answer)
{
    free(answer->columns[0]);
    *answer = (struct kd_integral_answer) { 0 };
}
