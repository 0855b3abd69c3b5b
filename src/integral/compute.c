/* Each integral fills the columns that its kind lists. */
#include "integral/answer.h"
#include "integral/kept.h"

#include <math.h>
#include <stdlib.h>

static const char *const line_sources[] = {
    "C. T. Cunningham 1975, ApJ 202, 788 (redshift and transfer)",
    "S. E. Gralla & A. Lupsasca 2020, Phys. Rev. D 101, 044032 (rays in closed form)",
    "T. Dauser et al. 2013, MNRAS 430, 1694 (lamppost)",
    "A. Laor 1991, ApJ 376, 90; F. Haardt 1993, ApJ 413, 680 (limb)",
    NULL,
};
static const char *const disk_approximations[] = {
    "a thin opaque disk in the equatorial plane, gas on circular orbits, nothing within its inner edge",
    "the direct image alone: light that goes round the hole and comes through the plane again is left out",
    NULL,
};

static const struct kd_integral_kind_of kinds[KD_INTEGRALS] = {
    [KD_INTEGRAL_LINE] = { "relativistic line profile of a thin disk",
                           { { "isco", "M", "innermost stable circular orbit" },
                             { "total", "M^2", "all photons, or energies: the integral of g^3 epsilon f, or g^4, over the image plane" },
                             { "inside", "1", "share of them between the first and the last edge" },
                             { "error", "1", "estimated, of the cumulative share at any edge" } },
                           { { "energy_low", "unit of rest_energy", "edge of the bin" },
                             { "energy_high", "unit of rest_energy", "edge of the bin" },
                             { "share", "1", "of all photons, or energies, of the line that arrive in the bin" },
                             { "cumulative", "1", "share up to energy_high from the first edge" } },
                           line_sources,
                           disk_approximations },
};

const struct kd_integral_kind_of *kd_integral_kind_of(enum kd_integral what) { return &kinds[what]; }

static enum kd_status make_columns(struct kd_integral_answer *answer, size_t rows, struct kd_error *error)
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

static enum kd_status compute_line(const struct kd_integral_request *r, const struct kd_disk_image *image, struct kd_integral_answer *answer, struct kd_error *error)
{
    const struct kd_line_params params = { .inner = r->inner, .outer = r->outer, .emissivity = r->emissivity, .index = r->index, .outer_index = r->outer_index,
                                           .break_r = r->break_r, .height = r->height, .photon_index = r->photon_index, .limb = r->limb, .energy = r->energy };
    struct kd_line_profile profile;
    double sum = 0;
    enum kd_status status;
    KD_TRY(make_columns(answer, r->bins, error));
    double *const *c = answer->columns, *edges = malloc((r->bins + 1) * sizeof *edges);
    for (size_t i = 0; edges && i <= r->bins; i++)
        edges[i] = r->edges.at[i] / r->rest_energy;
    status = edges ? kd_line_profile(image, &params, edges, (int)r->bins, c[2], &profile, error) : kd_error_set(error, KD_ENOMEM, "out of memory for %u bins", r->bins);
    free(edges);
    for (size_t i = 0; !status && i < r->bins; i++)
        c[0][i] = r->edges.at[i], c[1][i] = r->edges.at[i + 1], c[3][i] = sum = fmin(sum + c[2][i], 1); /* rounding */
    const double values[] = { image->isco, profile.total, sum, profile.error };
    for (size_t i = 0; !status && i < sizeof values / sizeof *values; i++)
        answer->values[i] = values[i];
done:
    return status;
}

enum kd_status kd_integral_compute(const struct kd_integral_request *request, struct kd_integral_answer *answer, struct kd_error *error)
{
    static enum kd_status (*const compute[KD_INTEGRALS])(const struct kd_integral_request *, const struct kd_disk_image *, struct kd_integral_answer *,
                                                         struct kd_error *) = { compute_line };
    struct kd_disk_image *image = NULL;
    enum kd_status status;
    *answer = (struct kd_integral_answer) { .request = request };
    KD_TRY(kd_kept_image(request->spin, request->inclination_deg, &image, error));
    KD_TRY(compute[request->what](request, image, answer, error));
done:
    free(image);
    if (status)
        kd_integral_answer_finish(answer);
    return status;
}

void kd_integral_answer_finish(struct kd_integral_answer *answer)
{
    free(answer->columns[0]);
    *answer = (struct kd_integral_answer) { 0 };
}
