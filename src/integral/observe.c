/* Simulates an observation: visibilities of a scene at the times and baselines of an observed file, with the errors of
 * that file. */
#include "observe/simulate.h"
#include "integral/compare.h"
#include "integral/integral_internal.h"
#include "integral/pictures.h"

#include <math.h>
#include <stdlib.h>

enum { HOUR, STATION, U = STATION + 2, V, RE, IM, SIGMA, MODEL_RE, MODEL_IM }; /* columns */
enum { FLUX, WORST = 7 };                                                      /* values */

enum kd_status kd_integral_check_observe(struct kd_integral_request *r, struct kd_error *error)
{
    struct kd_number_list *const lists[2] = { &r->u, &r->v };
    enum kd_status status;
    KD_TRY(kd_integral_check_map(r, error));
    if (!r->observation)
        return kd_error_field(error, "/observation",
                              "observation is missing; it must be a uvfits file or the EHT's CSV");
    if (isnan(r->flux_jy) && !kd_scene_is_radio_alone(r->scene))
        return kd_error_field(error, "/flux_jy",
                              "flux_jy is auto; it must be a number, because the scene's light has no frequency and "
                              "thus no flux in Jy");
    if (r->observation->n > KD_INTEGRAL_ROWS)
        return kd_error_field(error, "/observation",
                              "the observation has %zu visibilities; it must have at most %u to be simulated",
                              r->observation->n, KD_INTEGRAL_ROWS);
    for (int k = 0; k < 2; k++) {
        free(lists[k]->at);
        *lists[k] = (struct kd_number_list) { malloc(r->observation->n * sizeof(double)), r->observation->n };
    }
    if (!r->u.at || !r->v.at)
        return kd_error_set(error, KD_ENOMEM, "out of memory for %zu visibilities", r->observation->n);
    for (size_t i = 0; i < r->u.n; i++)
        r->u.at[i] = r->observation->at[i].u * 1e-9, r->v.at[i] = r->observation->at[i].v * 1e-9;
done:
    return status;
}

void kd_integral_observe_lay_out(struct kd_integral_answer *answer)
{
    const struct kd_observation *o = answer->request->observation;
    double *const *c = answer->columns;
    for (size_t i = 0; i < o->n; i++) {
        const struct kd_measured *m = &o->at[i];
        c[HOUR][i] = m->hour, c[SIGMA][i] = m->sigma;
        c[STATION][i] = m->station[0], c[STATION + 1][i] = m->station[1];
        c[U][i] = m->u * 1e-9, c[V][i] = m->v * 1e-9;
    }
    answer->solved = KD_ALIGNMENT_NONE;
}

void kd_integral_observe_take(struct kd_integral_answer *answer, uint8_t *marks, double (*model)[2],
                              double (*simulated)[2], bool finer)
{
    const struct kd_integral_request *r = answer->request;
    const bool is_known = isfinite(answer->map_jy);
    const double scale = isnan(r->flux_jy) ? 1 : r->flux_jy / (is_known ? answer->map_jy : 1);
    double *const *c = answer->columns;
    for (size_t i = 0; i < r->observation->n; i++) {
        model[i][0] *= scale, model[i][1] *= scale;
        if (finer)
            answer->values[WORST] =
                fmax(answer->values[WORST],
                     KD_INTEGRAL_OF_DIFFERENCE * hypot(model[i][0] - c[MODEL_RE][i], model[i][1] - c[MODEL_IM][i]));
    }
    if (finer)
        return;
    answer->values[FLUX] = scale * (is_known ? answer->map_jy : 1);
    kd_simulate(&(struct kd_simulation) { .observation = r->observation,
                                          .file = r->file,
                                          .size = r->file_size,
                                          .marks = marks,
                                          .noise = !r->noiseless,
                                          .seed = r->seed },
                (const double (*)[2])model, simulated);
    for (size_t i = 0; i < r->observation->n; i++) {
        c[MODEL_RE][i] = model[i][0], c[MODEL_IM][i] = model[i][1];
        c[RE][i] = simulated[i][0], c[IM][i] = simulated[i][1];
    }
}

enum kd_status kd_integral_observe_csv(const struct kd_integral_answer *answer, struct kd_buffer *out)
{
    const size_t n = answer->rows;
    double (*v)[2] = malloc(n * sizeof *v);
    if (!v)
        return KD_ENOMEM;
    for (size_t i = 0; i < n; i++)
        v[i][0] = answer->columns[RE][i], v[i][1] = answer->columns[IM][i];
    enum kd_status status = kd_observation_write_csv(answer->request->observation, (const double (*)[2])v, out);
    free(v);
    return status;
}
