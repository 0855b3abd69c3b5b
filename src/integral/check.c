/* Checks the rules between fields of a request, and fills in fields that follow from others. */
#include "integral/integral_internal.h"
#include "integral/request.h"
#include "integral/sets.h"

#include "physics/disk/thin_disk.h"
#include "physics/math/constants.h"
#include "physics/spacetime/kerr.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

bool kd_integral_given(const struct kd_integral_request *request, const char *name)
{
    const struct kd_row *f = kd_integral_field_named(request, name);
    const size_t at = f ? (size_t)(f - kd_integral_fields) : 0;
    return f && request->seen[at / 64] & UINT64_C(1) << at % 64;
}

/* Refuses inclinations very close to edge-on. The image of such a disk has only cells and no table
 * (physics/disk/disk_columns.h), and these integrals need the table. */
static enum kd_status check_edge_on(const struct kd_integral_request *r, struct kd_error *error)
{
    const bool echo = r->what == KD_INTEGRAL_IMPULSE || r->what == KD_INTEGRAL_LAGS,
               stokes = r->what == KD_INTEGRAL_SPECTRUM && (r->polarized || r->returning == KD_INTEGRAL_SCATTERED);
    if (!(echo || stokes) || fabs(r->inclination_deg - 90) >= KD_DISK_IMAGE_EDGE_ON)
        return KD_OK;
    return kd_error_field(
        error, "/inclination_deg",
        "inclination_deg is %.9g; %s it must be 0 to 87 or 93 to 180, because nearer to edge on the lower face of the "
        "disk is seen too (3 %% of the light at 89 degrees, half at 90)",
        r->inclination_deg,
        echo           ? "for an echo"
        : r->polarized ? "with polarization \"yes\""
                       : "with returning \"scattered\"");
}

static enum kd_status check_disk(struct kd_integral_request *r, struct kd_error *error)
{
    const struct kd_hole *const hole = kd_integral_hole(r);
    const double isco = kd_kerr_isco(hole);
    enum kd_status status = kd_hole_check(hole, error);
    if (!status)
        status = check_edge_on(r, error);
    if (status)
        return status;
    if (isnan(r->inner))
        r->inner = isco;
    if (r->inner < isco * (1 - 1e-9))
        return kd_error_field(error, "/inner",
                              "inner is %.9g; it must be \"isco\" or at least %.9g M, the ISCO of this hole", r->inner,
                              isco);
    if (r->returning && r->inner > isco * (1 + 1e-9))
        return kd_error_field(error, "/inner",
                              "inner is %.9g; with returning \"%s\" it must be the ISCO, %.9g M, or \"isco\"", r->inner,
                              r->returning == KD_INTEGRAL_SCATTERED ? "scattered" : "yes", isco);
    if (r->returning == KD_INTEGRAL_SCATTERED && r->limb != KD_LIMB_SCATTERING)
        return kd_error_field(error, "/returning",
                              "returning is \"scattered\", which needs an atmosphere of electrons; limb must be "
                              "\"scattering\"");
    if (r->polarized && r->limb != KD_LIMB_SCATTERING)
        return kd_error_field(error, "/polarization",
                              "polarization is \"yes\", which needs an atmosphere of electrons; limb must be "
                              "\"scattering\"");
    r->inner = fmax(r->inner, isco);
    if (r->outer <= r->inner * (1 + 1e-6))
        return kd_error_field(error, "/outer", "outer is %.9g and inner is %.9g; outer must be larger than inner",
                              r->outer, r->inner);
    return KD_OK;
}

/* Checks that a list is strictly increasing. */
enum kd_status kd_integral_check_growth(const struct kd_number_list *list, const char *name, struct kd_error *error)
{
    for (size_t i = 1; i < list->n; i++)
        if (!(list->at[i] > list->at[i - 1])) {
            char pointer[60];
            snprintf(pointer, sizeof pointer, "/%s/%zu", name, i);
            return kd_error_field(error, pointer, "%s has %.9g after %.9g; each must be larger than the one before",
                                  name, list->at[i], list->at[i - 1]);
        }
    return KD_OK;
}

#define BIT(word) (1u << KD_LINE_##word)
#define OFF_AXIS (BIT(RING) | BIT(DISK) | BIT(SLAB))

/* Refuses a field that belongs to another emissivity than the request's, because the field would have no effect. */
static enum kd_status check_belongs(const struct kd_integral_request *r, struct kd_error *error)
{
    static const struct {
        const char *name, *words;
        unsigned of;
    } belongs[] = {
        { "index", "power and broken", BIT(POWER) | BIT(BROKEN) },
        { "outer_index", "broken", BIT(BROKEN) },
        { "break_r", "broken", BIT(BROKEN) },
        { "height", "lamppost, ring, disk and slab", BIT(LAMPPOST) | OFF_AXIS },
        { "photon_index", "lamppost, ring, disk and slab", BIT(LAMPPOST) | OFF_AXIS },
        { "corona_radius", "ring, disk and slab", OFF_AXIS },
        { "motion", "ring, disk and slab", OFF_AXIS },
        { "corona_inner", "disk and slab", BIT(DISK) | BIT(SLAB) },
        { "corona_top", "slab", BIT(SLAB) },
    };
    for (size_t i = 0; i < sizeof belongs / sizeof *belongs; i++)
        if (kd_integral_given(r, belongs[i].name) && !(belongs[i].of & 1u << r->emissivity)) {
            char pointer[40];
            snprintf(pointer, sizeof pointer, "/%s", belongs[i].name);
            return kd_error_field(error, pointer, "%s cannot be used here; it belongs to emissivity %s",
                                  belongs[i].name, belongs[i].words);
        }
    return KD_OK;
}

struct kd_corona_shape kd_integral_corona(const struct kd_integral_request *r)
{
    const bool wide = r->emissivity == KD_LINE_DISK || r->emissivity == KD_LINE_SLAB;
    return (struct kd_corona_shape) { .inner = wide ? r->corona_inner : r->corona_radius,
                                      .outer = r->corona_radius,
                                      .height = r->height,
                                      .top = r->emissivity == KD_LINE_SLAB ? r->corona_top : r->height,
                                      .motion = r->motion };
}

/* Checks that a ring of the corona can exist. It must be far enough from the hole, and its motion must be slower than
 * light. */
static enum kd_status check_ring(const struct kd_integral_request *r, double radius, double height,
                                 struct kd_error *error)
{
    struct kd_corona_source source;
    const double at = hypot(radius, height),
                 least = KD_CORONA_LEAST * kd_kerr_ergosphere(kd_integral_hole(r), height / at);
    if (at < least)
        return kd_error_field(error, "/height",
                              "height is %.9g, which places the source %.9g M from the hole; the source must be at "
                              "least %.9g M away, %g times the radius of the ergosphere",
                              r->height, at, least, KD_CORONA_LEAST);
    if (!kd_corona_source_of(kd_integral_hole(r), radius, height, r->motion, &source))
        return kd_error_field(error, "/motion",
                              "motion is corotating, which is faster than light %.9g M from the axis and %.9g M above "
                              "the plane; it must be static or zamo, or the corona must be elsewhere",
                              radius, height);
    return KD_OK;
}

static enum kd_status check_corona(const struct kd_integral_request *r, struct kd_error *error)
{
    struct kd_corona_ring rings[KD_CORONA_PARTS];
    const struct kd_corona_shape shape = kd_integral_corona(r);
    const double flattest = shape.outer > shape.inner ? KD_CORONA_FLATTEST_SHAPE : KD_CORONA_FLATTEST;
    enum kd_status status = KD_OK;
    if (shape.inner > shape.outer || (shape.inner == shape.outer && r->emissivity != KD_LINE_RING))
        return kd_error_field(
            error, "/corona_inner",
            "corona_inner is %.9g and corona_radius %.9g; corona_radius must be larger than corona_inner", shape.inner,
            shape.outer);
    if (shape.top < shape.height || (shape.top == shape.height && r->emissivity == KD_LINE_SLAB))
        return kd_error_field(error, "/corona_top",
                              "corona_top is %.9g and height %.9g; corona_top must be larger than height", shape.top,
                              shape.height);
    if (r->height < flattest * r->corona_radius)
        return kd_error_field(error, "/height", "height is %.9g; it must be at least %.9g, %g times corona_radius",
                              r->height, flattest * r->corona_radius, flattest);
    const int n = kd_corona_rings(&shape, rings);
    for (int i = 0; i < n; i++)
        KD_TRY(check_ring(r, rings[i].radius, rings[i].height, error));
done:
    return status;
}

static enum kd_status check_emissivity(const struct kd_integral_request *r, struct kd_error *error)
{
    const enum kd_status status = check_belongs(r, error);
    if (status)
        return status;
    double least = 1.05 * kd_integral_hole(r)->outer;
    if (r->emissivity == KD_LINE_LAMPPOST && r->height < least)
        return kd_error_field(error, "/height",
                              "height is %.9g; it must be at least %.9g, 1.05 times the horizon of this hole",
                              r->height, least);
    return 1u << r->emissivity & OFF_AXIS ? check_corona(r, error) : KD_OK;
}

static enum kd_status fill_edges(struct kd_integral_request *r, struct kd_error *error)
{
    struct kd_number_list *list;
    const struct kd_row *f = kd_integral_field_named(r, "edges");
    if (isnan(r->energy_max))
        r->energy_max = 1.7 * r->rest_energy;
    if (!(r->energy_max > r->energy_min))
        return kd_error_field(error, "/energy_max",
                              "energy_max is %.9g and energy_min %.9g; energy_max must be larger than energy_min",
                              r->energy_max, r->energy_min);
    enum kd_status status = kd_integral_make_room(r, f, (size_t)r->bins + 1, "/bins", &list, error);
    for (size_t i = 0; !status && i <= r->bins; i++)
        list->at[i] =
            i == r->bins ? r->energy_max : r->energy_min + (r->energy_max - r->energy_min) * (double)i / r->bins;
    return status;
}

static enum kd_status check_edges(struct kd_integral_request *r, struct kd_error *error)
{
    static const char *const even[] = { "energy_min", "energy_max", "bins" };
    if (!r->edges.n)
        return fill_edges(r, error);
    for (size_t i = 0; i < 3; i++)
        if (kd_integral_given(r, even[i]))
            return kd_error_field(error, "/edges", "edges cannot be used with %s", even[i]);
    r->bins = (uint32_t)r->edges.n - 1, r->energy_min = r->edges.at[0], r->energy_max = r->edges.at[r->bins];
    return kd_integral_check_growth(&r->edges, "edges", error);
}

/* Fills a list with n numbers in geometric progression. If `first` is 0, the numbers are the midpoints of n equal parts
 * of the range from 0 to 1. */
enum kd_status kd_integral_fill_list(struct kd_integral_request *r, const char *name, uint32_t n, double first,
                                     double last, struct kd_error *error)
{
    struct kd_number_list *list;
    enum kd_status status = kd_integral_make_room(r, kd_integral_field_named(r, name), n, "", &list, error);
    for (size_t i = 0; !status && i < n; i++)
        list->at[i] = !(first > 0) ? ((double)i + 0.5) / n
                      : n == 1     ? first
                      : i + 1 == n ? last
                                   : first * pow(last / first, (double)i / (n - 1));
    return status;
}

/* Refuses a list together with fields that would generate the same list. */
enum kd_status kd_integral_check_beside(const struct kd_integral_request *r, const char *list,
                                        const char *const *others, size_t n, struct kd_error *error)
{
    char pointer[40];
    snprintf(pointer, sizeof pointer, "/%s", list);
    for (size_t i = 0; i < n; i++)
        if (kd_integral_given(r, others[i]))
            return kd_error_field(error, pointer, "%s cannot be used with %s", list, others[i]);
    return KD_OK;
}

static enum kd_status check_transfer(struct kd_integral_request *r, struct kd_error *error)
{
    enum kd_status status = KD_OK;
    if (r->inclination_deg < KD_INTEGRAL_FACE_ON || r->inclination_deg > 180 - KD_INTEGRAL_FACE_ON)
        return kd_error_field(error, "/inclination_deg",
                              "inclination_deg is %.9g, too close to face on, where each ring has a single redshift "
                              "and no transfer function; it must be 0.1 to 89.99 or 90.01 to 179.9",
                              r->inclination_deg);
    if (fabs(r->inclination_deg - 90) < KD_INTEGRAL_EDGE_ON)
        return kd_error_field(error, "/inclination_deg",
                              "inclination_deg is %.9g, so close to edge on that the near side of a ring has no "
                              "width; it must be 0.1 to 89.99 or 90.01 to 179.9",
                              r->inclination_deg);
    if (r->radii.n) {
        KD_TRY(kd_integral_check_beside(r, "radii", (const char *const[]) { "rings" }, 1, error));
        r->rings = (uint32_t)r->radii.n;
    } else {
        KD_TRY(kd_integral_fill_list(r, "radii", r->rings, r->inner, r->outer, error));
    }
    if (r->g_star.n) {
        KD_TRY(kd_integral_check_beside(r, "g_star", (const char *const[]) { "g_stars" }, 1, error));
        r->g_stars = (uint32_t)r->g_star.n;
    } else {
        KD_TRY(kd_integral_fill_list(r, "g_star", r->g_stars, 0, 0, error));
    }
    for (size_t i = 0; i < r->radii.n; i++)
        if (r->radii.at[i] < r->inner * (1 - 1e-12) || r->radii.at[i] > r->outer) {
            char pointer[60];
            snprintf(pointer, sizeof pointer, "/radii/%zu", i);
            return kd_error_field(error, pointer, "a radius is %.9g; it must be %.9g to %.9g, from inner to outer",
                                  r->radii.at[i], r->inner, r->outer);
        }
    if (r->radii.n * r->g_star.n > KD_INTEGRAL_TRANSFERS)
        return kd_error_field(error, r->radii.n > r->g_star.n ? "/radii" : "/g_star",
                              "%zu radii with %zu values of g* make too many rows (limit %u)", r->radii.n, r->g_star.n,
                              KD_INTEGRAL_TRANSFERS);
done:
    return status;
}

/* Requires either a list of frequencies or both ends of a range. */
enum kd_status kd_integral_check_frequencies(struct kd_integral_request *r, uint32_t most, struct kd_error *error)
{
    static const char *const even[] = { "frequency_min_hz", "frequency_max_hz", "frequencies" };
    enum kd_status status = KD_OK;
    if (r->frequencies_hz.n) {
        KD_TRY(kd_integral_check_beside(r, "frequencies_hz", even, 3, error));
        if (r->frequencies_hz.n > most)
            return kd_error_field(error, "/frequencies_hz", "frequencies_hz has %zu numbers; it must have 1 to %u",
                                  r->frequencies_hz.n, most);
        r->frequencies = (uint32_t)r->frequencies_hz.n, r->frequency_min_hz = r->frequencies_hz.at[0],
        r->frequency_max_hz = r->frequencies_hz.at[r->frequencies - 1];
        return kd_integral_check_growth(&r->frequencies_hz, "frequencies_hz", error);
    }
    if (r->frequencies > most)
        return kd_error_field(error, "/frequencies", "frequencies is %u; it must be 2 to %u", r->frequencies, most);
    if (!(r->frequency_max_hz > r->frequency_min_hz))
        return kd_error_field(
            error, "/frequency_max_hz",
            "frequency_max_hz is %.9g and frequency_min_hz %.9g; frequency_max_hz must be larger than frequency_min_hz",
            r->frequency_max_hz, r->frequency_min_hz);
    KD_TRY(kd_integral_fill_list(r, "frequencies_hz", r->frequencies, r->frequency_min_hz, r->frequency_max_hz, error));
done:
    return status;
}

static enum kd_status check_frequencies(struct kd_integral_request *r, struct kd_error *error)
{
    const struct kd_hole *const hole = kd_integral_hole(r);
    const double hottest = fmax(r->inner, kd_disk_peak_page_thorne(hole)),
                 flux = kd_disk_flux_page_thorne(hole, hottest);
    const double t = r->colour_correction * kd_disk_temperature(flux, hole, r->mass_msun, r->mdot_edd);
    if (isnan(r->frequency_min_hz))
        r->frequency_min_hz = 1e-3 * t * KD_K_J_K / KD_H_J_S;
    if (isnan(r->frequency_max_hz))
        r->frequency_max_hz = 30 * t * KD_K_J_K / KD_H_J_S;
    return kd_integral_check_frequencies(r, KD_INTEGRAL_FREQUENCIES, error);
}

static enum kd_status check_impulse(struct kd_integral_request *r, struct kd_error *error)
{
    enum kd_status status = KD_OK;
    KD_TRY(check_emissivity(r, error));
    KD_TRY(check_edges(r, error));
    if (!(r->time_max > r->time_min))
        return kd_error_field(error, "/time_max",
                              "time_max is %.9g and time_min %.9g; time_max must be larger than time_min", r->time_max,
                              r->time_min);
    if ((size_t)r->bins * r->times > KD_INTEGRAL_ROWS)
        return kd_error_field(error, r->bins > r->times ? "/bins" : "/times",
                              "%u bins of energy with %u of time make too many rows (limit %u)", r->bins, r->times,
                              KD_INTEGRAL_ROWS);
done:
    return status;
}

static enum kd_status check_lags(struct kd_integral_request *r, struct kd_error *error)
{
    static const char *const even[] = { "frequency_min", "frequency_max", "frequencies" };
    enum kd_status status = KD_OK;
    KD_TRY(check_emissivity(r, error));
    KD_TRY(check_edges(r, error));
    if (!(r->edges.at[0] > 0))
        return kd_error_field(
            error, kd_integral_given(r, "edges") ? "/edges/0" : "/energy_min",
            "the first edge is 0; it must be above 0, because a power law has infinitely many photons down to 0");
    if (r->frequencies_m.n) {
        KD_TRY(kd_integral_check_beside(r, "frequencies_m", even, 3, error));
        KD_TRY(kd_integral_check_growth(&r->frequencies_m, "frequencies_m", error));
        r->frequencies = (uint32_t)r->frequencies_m.n;
        r->frequency_min = r->frequencies_m.at[0], r->frequency_max = r->frequencies_m.at[r->frequencies - 1];
    } else {
        if (!(r->frequency_max > r->frequency_min))
            return kd_error_field(error, "/frequency_max",
                                  "frequency_max is %.9g and frequency_min %.9g; frequency_max must be larger than "
                                  "frequency_min",
                                  r->frequency_max, r->frequency_min);
        KD_TRY(kd_integral_fill_list(r, "frequencies_m", r->frequencies, r->frequency_min, r->frequency_max, error));
    }
    if ((size_t)r->bins * r->frequencies > KD_INTEGRAL_ROWS)
        return kd_error_field(error, "/bins", "%u bins with %u frequencies make too many rows (limit %u)", r->bins,
                              r->frequencies, KD_INTEGRAL_ROWS);
    if (isnan(r->reference_min) != isnan(r->reference_max))
        return kd_error_field(
            error, isnan(r->reference_min) ? "/reference_min" : "/reference_max",
            "reference_min and reference_max are a number and \"continuum\"; they must be two numbers "
            "or both \"continuum\"");
    if (r->reference_max <= r->reference_min)
        return kd_error_field(error, "/reference_max",
                              "reference_max is %.9g and reference_min %.9g; reference_max must be larger than "
                              "reference_min",
                              r->reference_max, r->reference_min);
done:
    return status;
}

size_t kd_integral_rows(const struct kd_integral_request *r)
{
    switch (r->what) {
    case KD_INTEGRAL_LINE: return r->bins;
    case KD_INTEGRAL_TRANSFER: return (size_t)r->rings * r->g_stars;
    case KD_INTEGRAL_IMPULSE: return (size_t)r->bins * r->times;
    case KD_INTEGRAL_LAGS: return (size_t)r->bins * r->frequencies;
    case KD_INTEGRAL_VISIBILITY: return r->u.n * (1 + r->orders);
    case KD_INTEGRAL_COMPARE: return r->comparison->rows;
    case KD_INTEGRAL_SETS: return r->sets->n;
    case KD_INTEGRAL_OBSERVE: return r->observation->n;
    case KD_INTEGRAL_SPECTRUM:
    case KD_INTEGRAL_VOLUME:
    case KD_INTEGRALS: break;
    }
    return r->frequencies;
}

enum kd_status kd_integral_request_check(struct kd_integral_request *r, struct kd_error *error)
{
    enum kd_status status = KD_OK;
    if (!kd_integral_is_pictured(r->what))
        KD_TRY(check_disk(r, error));
    switch (r->what) {
    case KD_INTEGRAL_LINE:
        KD_TRY(check_emissivity(r, error));
        KD_TRY(check_edges(r, error));
        break;
    case KD_INTEGRAL_TRANSFER: KD_TRY(check_transfer(r, error)); break;
    case KD_INTEGRAL_SPECTRUM: KD_TRY(check_frequencies(r, error)); break;
    case KD_INTEGRAL_IMPULSE: KD_TRY(check_impulse(r, error)); break;
    case KD_INTEGRAL_LAGS: KD_TRY(check_lags(r, error)); break;
    case KD_INTEGRAL_VOLUME: KD_TRY(kd_integral_check_volume(r, error)); break;
    case KD_INTEGRAL_VISIBILITY: KD_TRY(kd_integral_check_visibility(r, error)); break;
    case KD_INTEGRAL_COMPARE:
    case KD_INTEGRAL_SETS: KD_TRY(kd_integral_check_compare(r, error)); break;
    case KD_INTEGRAL_OBSERVE: KD_TRY(kd_integral_check_observe(r, error)); break;
    case KD_INTEGRALS: break;
    }
done:
    return status;
}
