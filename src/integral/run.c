#include "integral/run.h"

#include "base/clock.h"
#include "base/pause.h"
#include "integral/compare.h"
#include "integral/integral_internal.h"
#include "observe/scattering.h"
#include "observe/simulate.h"
#include "physics/math/angle.h"
#include "physics/math/constants.h"
#include "render/emit/radio.h"
#include "render/output/wcs.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* width of the map's border, in pixels; the border's brightness shows whether there is light beyond the map */
#define EDGE 1

enum { U, V, LENGTH, ORDER, RE, IM, AMPLITUDE, PHASE, ERROR };          /* columns of a visibility */
enum { HZ, SI, JY, NU_L_NU, FLUX_ERROR };                               /* columns of a spectrum of pictures */
enum { FLUX, PIXEL, WIDTH, HEIGHT, LONGEST, BORDER, UNDEFINED, WORST }; /* values of a visibility */
/* index of the value that takes the place of FLUX for a comparison of sets */
enum { PICTURES };

static unsigned bands(const struct kd_integral_run *run) { return 1 + run->answer.request->orders; }

/* Fills the columns that identify each row. */
static void lay_out(struct kd_integral_answer *answer)
{
    const struct kd_integral_request *r = answer->request;
    double *const *c = answer->columns;
    if (r->what == KD_INTEGRAL_VOLUME)
        memcpy(c[HZ], r->frequencies_hz.at, answer->rows * sizeof(double));
    for (size_t row = 0; r->what == KD_INTEGRAL_VISIBILITY && row < answer->rows; row++) {
        const size_t at = row / (1 + r->orders);
        c[U][row] = r->u.at[at], c[V][row] = r->v.at[at], c[LENGTH][row] = hypot(c[U][row], c[V][row]),
        c[ORDER][row] = (double)(row % (1 + r->orders)) - 1;
    }
    if (r->what == KD_INTEGRAL_SETS) {
        answer->values[PICTURES] = r->sets->pictures;
        answer->solved = KD_ALIGNMENT_NONE;
        return;
    }
    if (kd_integral_is_observed(r->what)) {
        (r->what == KD_INTEGRAL_COMPARE ? kd_integral_compare_lay_out : kd_integral_observe_lay_out)(answer);
        return;
    }
    for (size_t row = 0; r->unchecked && row < answer->rows; row++)
        c[r->what == KD_INTEGRAL_VOLUME ? FLUX_ERROR : ERROR][row] = NAN;
}

/* Allocates the arrays for a model of an observation, and computes the factors of scattering. */
static enum kd_status begin_model(struct kd_integral_run *run, struct kd_error *error)
{
    const struct kd_integral_request *r = run->answer.request;
    struct kd_scattering scattering;
    run->model = calloc(r->u.n, sizeof *run->model);
    if (r->what == KD_INTEGRAL_OBSERVE) {
        run->simulated = calloc(r->u.n, sizeof *run->simulated);
        run->marks = calloc(1, KD_SIMULATION_MARKS);
        if (!run->simulated || !run->marks)
            return kd_error_set(error, KD_ENOMEM, "out of memory for %zu visibilities", r->u.n);
    }
    if (kd_integral_is_searched(r))
        run->room = malloc(sizeof *run->room);
    if (r->scattering)
        run->scattering = malloc(r->u.n * sizeof *run->scattering);
    if (!run->model || (kd_integral_is_searched(r) && !run->room) || (r->scattering && !run->scattering))
        return kd_error_set(error, KD_ENOMEM, "out of memory for %zu visibilities", r->u.n);
    if (r->scattering)
        kd_scattering_sgra(&scattering, r->observation->frequency_hz);
    for (size_t i = 0; r->scattering && i < r->u.n; i++) {
        if (kd_pause_every(i, 32))
            return kd_error_set(error, KD_ECANCELLED, "the computation of the visibilities was cancelled");
        run->scattering[i] = kd_scattering_at(&scattering, r->u.at[i] * 1e9, r->v.at[i] * 1e9);
    }
    return KD_OK;
}

enum kd_status kd_integral_run_begin(struct kd_integral_run *run, const struct kd_integral_request *request,
                                     struct kd_error *error)
{
    *run = (struct kd_integral_run) { .pictures = kd_integral_pictures(request), .answer.request = request };
    if (!run->pictures)
        return kd_integral_compute(request, &run->answer, error);
    enum kd_status status = kd_integral_make_columns(&run->answer, kd_integral_rows(request), error);
    if (status)
        return status;
    if (kd_integral_is_observed(request->what) && (status = begin_model(run, error))) {
        kd_integral_run_finish(run);
        return status;
    }
    if (kd_integral_is_mapped(request->what))
        run->answer.light = kd_scene_is_radio_alone(request->scene) ? "Jy" : "1";
    lay_out(&run->answer);
    return KD_OK;
}

/* Sums a map. Sets values that are not finite to 0, and adds their number to *undefined. */
static double total(float *map, size_t n, double *undefined)
{
    double sum = 0;
    for (size_t i = 0; i < n; i++) {
        if (!isfinite(map[i]))
            map[i] = 0, *undefined += 1;
        sum += map[i];
    }
    return sum;
}

static void multiply(float *map, size_t n, float factor)
{
    for (size_t i = 0; i < n; i++)
        map[i] *= factor;
}

/* Estimate of the light beyond the map, as a fraction of the map's sum. It is the sum of a map that has the border's
 * mean brightness everywhere. */
static double border_share(const float *map, uint32_t width, uint32_t height, double sum)
{
    double edge = 0, n = 0;
    for (uint32_t j = 0; j < height; j++)
        for (uint32_t i = 0; i < width; i++)
            if (i < EDGE || j < EDGE || i + EDGE >= width || j + EDGE >= height)
                edge += map[(size_t)j * width + i], n++;
    return edge / n * width * height / sum;
}

static void tell_map(struct kd_integral_run *run, const struct kd_scene *scene, double sum, double undefined)
{
    const double pixel = run->grid.pixel, jy = kd_scene_is_radio_alone(scene) ? sum * pixel * pixel : NAN;
    const double told[] = { [FLUX] = jy,
                            [PIXEL] = pixel * KD_UAS_PER_RADIAN,
                            [WIDTH] = pixel * KD_UAS_PER_RADIAN * run->grid.width,
                            [HEIGHT] = pixel * KD_UAS_PER_RADIAN * run->grid.height,
                            [LONGEST] = kd_integral_nyquist_gl(scene),
                            [BORDER] = border_share(run->map[0], run->grid.width, run->grid.height, sum),
                            [UNDEFINED] = undefined,
                            [WORST] = run->answer.request->unchecked ? NAN : 0 };
    memcpy(run->answer.values, told, sizeof told);
}

/* For a comparison of sets: writes the worst value of all maps, and the number of pictures in place of the flux. */
static void tell_sets(struct kd_integral_run *run, const struct kd_scene *scene, double sum, double undefined)
{
    double *values = run->answer.values;
    const double before = values[BORDER], all = values[UNDEFINED];
    if (run->is_dark) {
        values[UNDEFINED] += undefined;
        return;
    }
    tell_map(run, scene, sum, undefined);
    values[PICTURES] = run->answer.request->sets->pictures;
    values[BORDER] = fmax(values[BORDER], before), values[UNDEFINED] += all;
}

static enum kd_status begin_map(struct kd_integral_run *run, struct kd_buffer *file, const struct kd_scene *scene,
                                struct kd_error *error)
{
    const struct kd_wcs wcs = kd_wcs_of(scene);
    const uint32_t width = (uint32_t)scene->image.width, height = (uint32_t)scene->image.height;
    const size_t n = (size_t)width * height;
    double undefined = 0, sum = 0;
    run->maps = *file;
    *file = (struct kd_buffer) { 0 };
    if (run->maps.size != bands(run) * n * sizeof(float))
        return kd_error_set(error, KD_EINVAL, "the renderer returned a map of %zu bytes for %u x %u pixels",
                            run->maps.size, width, height);
    run->grid = (struct kd_fourier_grid) { width, height, kd_integral_pixel(scene), wcs.at[0].pixel - 1,
                                           height - wcs.at[1].pixel };
    for (unsigned k = bands(run); k--;) {
        float *map = (float *)run->maps.data + k * n;
        /* layers of image orders are in units of light, but the layer of the total light is in Jy/sr */
        if (k && kd_scene_is_radio_alone(scene))
            multiply(map, n, (float)kd_radio_jansky_steradian(scene));
        sum = total(map, n, &undefined); /* map 0, the total light, is summed last, so that `sum` becomes its sum */
        run->map[k] = map;
    }
    run->is_dark = !(sum > 0);
    if (run->is_dark && run->answer.request->what != KD_INTEGRAL_SETS)
        return kd_error_field(error, "/scene", "the picture of %u x %u pixels is dark and has no visibilities", width,
                              height);
    run->scale = kd_scene_is_radio_alone(scene) ? run->grid.pixel * run->grid.pixel : 1 / sum;
    run->answer.map_jy = kd_scene_is_radio_alone(scene) ? sum * run->scale : NAN;
    run->baseline = 0;
    free(run->scratch);
    if (!(run->scratch = malloc(2 * width * sizeof(double))))
        return kd_error_set(error, KD_ENOMEM, "out of memory for a row of %u pixels", width);
    if (run->answer.request->what == KD_INTEGRAL_SETS)
        tell_sets(run, scene, sum, undefined);
    else if (!kd_integral_is_finer(run->answer.request, run->picture))
        tell_map(run, scene, sum, undefined);
    return KD_OK;
}

static enum kd_status take_flux(struct kd_integral_run *run, struct kd_buffer *file, const struct kd_scene *scene,
                                struct kd_error *error)
{
    const struct kd_integral_request *r = run->answer.request;
    const size_t row = run->picture / (r->unchecked ? 1 : 2);
    const double away = scene->spacetime.distance_pc * KD_PARSEC_M;
    double *const *c = run->answer.columns, jy = NAN;
    if (file->size != sizeof jy)
        return kd_error_set(error, KD_EINVAL, "the renderer returned a flux of %zu bytes", file->size);
    memcpy(&jy, file->data, sizeof jy);
    kd_buffer_finish(file);
    if (kd_integral_is_finer(r, run->picture)) {
        c[FLUX_ERROR][row] = jy == c[JY][row] ? 0
                                              : fmin(KD_INTEGRAL_OF_DIFFERENCE * fabs(jy / c[JY][row] - 1),
                                                     1); /* the error is 1 if the coarser picture showed no light */
        run->answer.values[2] = fmax(run->answer.values[2], c[FLUX_ERROR][row]);
        return KD_OK;
    }
    c[JY][row] = jy, c[SI][row] = jy * 1e-26, c[NU_L_NU][row] = 4 * M_PI * away * away * c[HZ][row] * c[SI][row];
    const double told[] = { scene->image.width, scene->image.height, r->unchecked ? NAN : run->answer.values[2] };
    memcpy(run->answer.values, told, sizeof told);
    return KD_OK;
}

static void tell_once(struct kd_integral_answer *answer, const char *text)
{
    for (size_t i = 0; i < answer->n_told; i++)
        if (!strcmp(answer->told[i], text))
            return;
    if (answer->n_told < sizeof answer->told / sizeof *answer->told)
        answer->told[answer->n_told++] = text;
}

enum kd_status kd_integral_run_take(struct kd_integral_run *run, struct kd_buffer *file, const struct kd_scene *scene,
                                    const struct kd_plan_report *report, struct kd_error *error)
{
    /* the pictures of different sets may have different approximations */
    for (size_t i = 0; i < report->n_approximations; i++)
        tell_once(&run->answer, report->approximations[i].text);
    return run->answer.request->what == KD_INTEGRAL_VOLUME ? take_flux(run, file, scene, error)
                                                           : begin_map(run, file, scene, error);
}

static void put(struct kd_integral_run *run, size_t row, double re, double im)
{
    double *const *c = run->answer.columns;
    if (kd_integral_is_finer(run->answer.request, run->picture)) {
        c[ERROR][row] = KD_INTEGRAL_OF_DIFFERENCE * hypot(re - c[RE][row], im - c[IM][row]);
        run->answer.values[WORST] = fmax(run->answer.values[WORST], c[ERROR][row]);
        return;
    }
    c[RE][row] = re, c[IM][row] = im, c[AMPLITUDE][row] = hypot(re, im), c[PHASE][row] = atan2(im, re) * (180 / M_PI);
}

/* Visibility of the map, enlarged and rotated, at a baseline. That map itself is not computed. A map enlarged by a
 * factor is equivalent to a baseline that is longer by this factor, and a rotated map is equivalent to a baseline that
 * is rotated back. Observations use the conjugate of kd_fourier's sign (observe/observation.h). */
static void model_at(struct kd_integral_run *run, size_t i, double size, double angle_deg, double out[2])
{
    const struct kd_integral_request *r = run->answer.request;
    const struct kd_integral_set *set = run->answer.set;
    const double all = size * (set ? set->size : 1), turn_deg = angle_deg + (set ? set->angle_deg : 0),
                 c = all * kd_cos_deg(turn_deg), s = all * kd_sin_deg(turn_deg), u = c * r->u.at[i] - s * r->v.at[i],
                 v = s * r->u.at[i] + c * r->v.at[i], turns = 1e9 * run->grid.pixel,
                 scale = run->scale * kd_pulse_at(r->pulse, u * turns, v * turns) *
                         (run->scattering ? run->scattering[i] : 1);
    double sum[1][2];
    kd_fourier(&run->grid, run->map, 1, u, v, run->scratch, sum);
    out[0] = scale * sum[0][0], out[1] = -scale * sum[0][1];
}

static void model(void *user, double size, double angle_deg, double (*out)[2])
{
    struct kd_integral_run *run = user;
    for (size_t i = 0; i < run->answer.request->u.n && !kd_pause(); i++) {
        model_at(run, i, size, angle_deg, out[i]);
    }
}

/* Searches for the quantities that the request solves for. At the end, run->model holds the model with the values
 * found. */
static void search(struct kd_integral_run *run)
{
    const struct kd_integral_request *r = run->answer.request;
    const struct kd_integral_answer *a = &run->answer;
    const double flux_jy = a->set ? a->set->flux_jy : r->flux_jy;
    const bool is_known = isfinite(a->map_jy), is_free = r->solve & KD_ALIGN_FLUX || (!is_known && isnan(flux_jy));
    const struct kd_align_params params = {
        .solve = r->solve | (is_free ? KD_ALIGN_FLUX : 0),
        .most_shift = 0.5 * run->grid.pixel * fmax(run->grid.width, run->grid.height),
        .model = model,
        .user = run,
    };
    run->answer.solved = KD_ALIGNMENT_NONE;
    run->answer.solved.scale = isfinite(flux_jy) ? flux_jy / (is_known ? a->map_jy : 1) : 1;
    kd_align(r->comparison, &params, run->room, run->model, &run->answer.solved);
}

/* Evaluates the sets of the current picture, in order. Returns true if some are left when the time is over. */
static bool step_sets(struct kd_integral_run *run, double until_ms)
{
    const struct kd_integral_request *r = run->answer.request;
    const struct kd_integral_sets *sets = r->sets;
    for (; run->set < sets->first[run->picture + 1]; run->set++, run->baseline = 0) {
        run->answer.set = &sets->at[run->set];
        if (!run->baseline)
            run->answer.solved = KD_ALIGNMENT_NONE;
        if (kd_clock_ms() > until_ms)
            return true;
        if (kd_integral_is_searched(r) && !run->is_dark)
            search(run), run->baseline = r->u.n;
        for (; run->baseline < r->u.n && !run->is_dark; run->baseline++) {
            if (run->baseline % 64 == 63 && kd_clock_ms() > until_ms)
                return true;
            model_at(run, run->baseline, 1, 0, run->model[run->baseline]);
        }
        kd_integral_sets_judge(&run->answer, run->is_dark ? NULL : run->model);
    }
    kd_buffer_finish(&run->maps);
    run->picture++;
    return false;
}

bool kd_integral_run_step(struct kd_integral_run *run, double until_ms)
{
    const struct kd_integral_request *r = run->answer.request;
    double sum[1 + KD_INTEGRAL_ORDERS][2];
    if (r->what == KD_INTEGRAL_SETS)
        return step_sets(run, until_ms);
    const bool is_finer = kd_integral_is_finer(r, run->picture);
    const struct kd_alignment *solved = &run->answer.solved;
    if (kd_integral_is_searched(r) && !is_finer)
        search(run), run->baseline = r->u.n;
    while (kd_integral_is_observed(r->what) && run->baseline < r->u.n) {
        model_at(run, run->baseline, solved->size, solved->angle_deg, run->model[run->baseline]);
        run->baseline++;
        if (kd_clock_ms() > until_ms)
            return true;
    }
    while (kd_integral_is_mapped(r->what) && run->baseline < r->u.n) {
        kd_fourier(&run->grid, run->map, bands(run), r->u.at[run->baseline], r->v.at[run->baseline], run->scratch, sum);
        for (unsigned k = 0; k < bands(run); k++)
            put(run, run->baseline * bands(run) + k, sum[k][0] * run->scale, sum[k][1] * run->scale);
        run->baseline++;
        if (kd_clock_ms() > until_ms)
            return true;
    }
    if (r->what == KD_INTEGRAL_COMPARE && is_finer)
        kd_align_shift(r->comparison, solved->east, solved->north, run->model);
    if (r->what == KD_INTEGRAL_COMPARE)
        kd_integral_compare_judge(&run->answer, run->model, is_finer);
    if (r->what == KD_INTEGRAL_OBSERVE)
        kd_integral_observe_take(&run->answer, run->marks, run->model, run->simulated, is_finer);
    kd_buffer_finish(&run->maps);
    run->picture++;
    return false;
}

void kd_integral_run_finish(struct kd_integral_run *run)
{
    kd_integral_answer_finish(&run->answer);
    kd_buffer_finish(&run->maps);
    free(run->scratch);
    free(run->model);
    free(run->simulated);
    free(run->marks);
    free(run->scattering);
    free(run->room);
    *run = (struct kd_integral_run) { 0 };
}
