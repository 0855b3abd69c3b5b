#include "integral/compare.h"

#include "base/schema.h"
#include "integral/internal.h"
#include "integral/pictures.h"
#include "document/members.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { PRODUCT, HOUR, STATION, U = STATION + 4, V, DATA, ERROR, MODEL, RESIDUAL }; /* columns */
enum { FLUX, WORST = 7 };                                                          /* values */

enum kd_status kd_integral_set_observation(struct kd_integral_request *r, const void *data, size_t size,
                                           struct kd_error *error)
{
    kd_integral_drop_observation(r);
    if (!(r->observation = calloc(1, sizeof *r->observation)))
        return kd_error_set(error, KD_ENOMEM, "out of memory for an observation");
    enum kd_status status = kd_observation_read(data, size, r->observation, error);
    if (status) {
        free(r->observation);
        r->observation = NULL;
    }
    if (status == KD_EINVAL)
        kd_error_inside(error, "/observation");
    return status;
}

void kd_integral_drop_observation(struct kd_integral_request *r)
{
    if (r->comparison)
        kd_comparison_finish(r->comparison);
    if (r->observation)
        kd_observation_finish(r->observation);
    free(r->comparison);
    free(r->observation);
    r->comparison = NULL, r->observation = NULL;
}

/* Reads the observation by the name or the hash of its asset. */
enum kd_status kd_integral_read_observation(struct kd_integral_request *r, const cJSON *root, struct kd_error *error)
{
    const cJSON *given = r->what == KD_INTEGRAL_COMPARE ? cJSON_GetObjectItemCaseSensitive(root, "observation") : NULL;
    if (!given)
        return KD_OK;
    struct kd_asset_found found;
    struct kd_asset_bytes bytes;
    if (!cJSON_IsString(given))
        return kd_member_refuse(given, "/observation", "the name of an asset", error);
    if (!r->assets)
        return kd_error_field(
            error, "/observation",
            "observation names an asset of a server; on the command line, give the file with --observation FILE");
    if (!r->assets->find(r->assets->user, given->valuestring, &found) ||
        !r->assets->take(r->assets->user, found.hash, &bytes))
        return kd_error_field(error, "/observation",
                              "observation is not an asset of this server; it must be the SHA-256 of one");
    enum kd_status status = kd_integral_set_observation(r, bytes.data, bytes.size, error);
    r->assets->give_back(r->assets->user, &bytes);
    return status;
}

static enum kd_status make_comparison(struct kd_integral_request *r, struct kd_error *error)
{
    const struct kd_comparison_params params = { .products = r->products,
                                                 .average_s = r->average_s,
                                                 .uv_min_gl = r->uv_min_gl,
                                                 .systematic_visibility = r->systematic_visibility,
                                                 .systematic_amplitude = r->systematic_amplitude,
                                                 .systematic_closure_phase_deg = r->systematic_closure_phase_deg,
                                                 .snr_cut = r->snr_cut,
                                                 .measured = r->measured,
                                                 .maximal = r->maximal };
    if (!r->comparison && !(r->comparison = calloc(1, sizeof *r->comparison)))
        return kd_error_set(error, KD_ENOMEM, "out of memory for a comparison");
    kd_comparison_finish(r->comparison);
    enum kd_status status = kd_comparison_make(r->observation, &params, r->comparison, error);
    if (status == KD_EINVAL)
        kd_error_inside(error, "/observation");
    return status;
}

enum kd_status kd_integral_check_compare(struct kd_integral_request *r, struct kd_error *error)
{
    struct kd_number_list *u, *v;
    enum kd_status status;
    KD_TRY(kd_integral_check_map(r, error));
    if (!r->observation)
        return kd_error_field(error, "/observation",
                              "observation is missing; it must be a uvfits file or the EHT's CSV");
    if (r->solve && isfinite(r->flux_jy))
        return kd_error_field(error, "/solve", "solve cannot have flux with flux_jy, because flux_jy gives the flux");
    if (r->solve && !(r->products & 1u << KD_PRODUCT_AMPLITUDE))
        return kd_error_field(
            error, "/solve",
            "solve has flux; products must have amplitude, because only amplitudes determine the flux");
    KD_TRY(make_comparison(r, error));
    if (r->comparison->rows > KD_INTEGRAL_ROWS || r->comparison->n > KD_INTEGRAL_ROWS)
        return kd_error_field(error, "/observation",
                              "there are %zu visibilities and %zu rows to compare; there must be at most %u of each; a "
                              "larger average_s gives fewer",
                              r->comparison->n, r->comparison->rows, KD_INTEGRAL_ROWS);
    u = &r->u, v = &r->v;
    free(u->at), free(v->at);
    *u = (struct kd_number_list) { malloc(r->comparison->n * sizeof(double)), r->comparison->n };
    *v = (struct kd_number_list) { malloc(r->comparison->n * sizeof(double)), r->comparison->n };
    if (!u->at || !v->at)
        return kd_error_set(error, KD_ENOMEM, "out of memory for %zu visibilities", r->comparison->n);
    for (size_t i = 0; i < u->n; i++)
        u->at[i] = r->comparison->at[i].u * 1e-9, v->at[i] = r->comparison->at[i].v * 1e-9;
done:
    return status;
}

const char *kd_integral_word(const struct kd_integral_answer *answer, size_t column, double number)
{
    const struct kd_integral_request *r = answer->request;
    if (r->what != KD_INTEGRAL_COMPARE || !isfinite(number))
        return NULL;
    return column == PRODUCT ? kd_product_names[(int)number] : r->observation->station[(int)number];
}

void kd_integral_compare_lay_out(struct kd_integral_answer *answer)
{
    const struct kd_comparison *c = answer->request->comparison;
    double *const *columns = answer->columns;
    for (size_t i = 0; i < c->rows; i++) {
        const struct kd_comparison_row *row = &c->row[i];
        const struct kd_measured *m = &c->at[row->at[0]];
        const bool one = row->product == KD_PRODUCT_AMPLITUDE;
        columns[PRODUCT][i] = row->product, columns[HOUR][i] = row->hour;
        for (unsigned k = 0; k < 4; k++)
            columns[STATION + k][i] = k < kd_product_stations(row->product) ? row->station[k] : NAN;
        columns[U][i] = one ? m->u * 1e-9 : NAN, columns[V][i] = one ? m->v * 1e-9 : NAN;
        columns[DATA][i] = row->data, columns[ERROR][i] = row->error;
    }
    for (int p = 0; p < KD_PRODUCTS; p++)
        answer->chi2[0][p] = answer->chi2[1][p] = NAN;
}

/* Factor that scales the model; NaN if it cannot be determined. If the light has no frequency, the map that was
 * transformed had a flux of 1. */
static double scale_of(const struct kd_integral_answer *answer, const double (*model)[2])
{
    const struct kd_integral_request *r = answer->request;
    const bool is_known = isfinite(answer->map_jy);
    return isfinite(r->flux_jy)    ? r->flux_jy / (is_known ? answer->map_jy : 1)
           : r->solve || !is_known ? kd_comparison_scale(r->comparison, model)
                                   : 1;
}

void kd_integral_compare_judge(struct kd_integral_answer *answer, double (*model)[2], bool finer)
{
    const struct kd_integral_request *r = answer->request;
    struct kd_comparison *c = r->comparison;
    const double found = scale_of(answer, (const double (*)[2])model),
                 scale = isfinite(found) ? found : 1; /* closures do not determine the scale */
    for (size_t i = 0; i < c->n; i++)
        model[i][0] *= scale, model[i][1] *= scale;
    kd_comparison_judge(c, (const double (*)[2])model, answer->chi2[finer]);
    for (size_t i = 0; i < c->rows; i++) {
        if (finer && c->row[i].product == KD_PRODUCT_AMPLITUDE)
            answer->values[WORST] = fmax(answer->values[WORST],
                                         KD_INTEGRAL_OF_DIFFERENCE * fabs(c->row[i].model - answer->columns[MODEL][i]));
        if (!finer)
            answer->columns[MODEL][i] = c->row[i].model,
            answer->columns[RESIDUAL][i] = kd_comparison_residual(&c->row[i]);
    }
    if (!finer && !(r->products & 1u << KD_PRODUCT_AMPLITUDE))
        answer->values[WORST] = NAN;
    if (!finer)
        answer->values[FLUX] = found * (isfinite(answer->map_jy) ? answer->map_jy : 1);
}

static void write_products(struct kd_json *json, const char *name, const double chi2[KD_PRODUCTS])
{
    kd_json_object(json, name);
    for (int p = 0; p < KD_PRODUCTS; p++)
        kd_json_number(json, kd_product_names[p], chi2[p]);
    kd_json_end(json);
}

void kd_integral_compare_write(struct kd_json *json, const struct kd_integral_answer *answer)
{
    const struct kd_observation *o = answer->request->observation;
    const struct kd_comparison *c = answer->request->comparison;
    double n[KD_PRODUCTS];
    for (int p = 0; p < KD_PRODUCTS; p++)
        n[p] = (double)c->of[p];
    write_products(json, "chi2", answer->chi2[0]);
    write_products(json, "chi2_finer", answer->chi2[1]);
    write_products(json, "n", n);
    kd_json_object(json, "observation");
    kd_json_string(json, "source", o->source);
    kd_json_number(json, "mjd", o->mjd);
    kd_json_number(json, "frequency_ghz", o->frequency_hz * 1e-9);
    kd_json_array(json, "stations");
    for (uint32_t i = 0; i < o->stations; i++)
        kd_json_string(json, NULL, o->station[i]);
    kd_json_end(json);
    kd_json_number(json, "visibilities", (double)o->n);
    kd_json_number(json, "flagged", o->flagged);
    kd_json_number(json, "duplicates", o->duplicate);
    kd_json_number(json, "averaged", (double)(c->n + c->too_short));
    kd_json_number(json, "too_short", (double)c->too_short);
    kd_json_end(json);
}

#define OR_NULL "{\"type\":[\"number\",\"null\"]}"
#define COUNT "{\"type\":\"integer\",\"minimum\":0}"
#define OF_PRODUCTS(about, type) \
    "{\"type\":\"object\",\"additionalProperties\":false,\"description\":\"" about \
    "\",\"properties\":{\"amplitude\":" type ",\"closure_phase\":" type ",\"log_closure_amplitude\":" type \
    "},\"required\":[\"amplitude\",\"closure_phase\",\"log_closure_amplitude\"]}"

void kd_integral_compare_schema(struct kd_json *json)
{
    static const struct kd_schema_member members[] = {
        { "source", "{\"type\":\"string\"}", false, NULL },
        { "mjd", "{\"type\":\"number\"}", false, NULL },
        { "frequency_ghz", "{\"type\":\"number\"}", false, NULL },
        { "stations", "{\"type\":\"array\",\"items\":{\"type\":\"string\"}}", false, NULL },
        { "visibilities", COUNT, false, NULL },
        { "flagged", COUNT, false, NULL },
        { "duplicates", COUNT, false, NULL },
        { "averaged", COUNT, false, NULL },
        { "too_short", COUNT, false, NULL },
    };
    kd_schema_text(json, "chi2",
                   OF_PRODUCTS("chi^2 over the number of data; null for a product without data", OR_NULL));
    kd_schema_text(json, "chi2_finer",
                   OF_PRODUCTS("the same for a map 1.5 times as fine; null with check none", OR_NULL));
    kd_schema_text(json, "n", OF_PRODUCTS("number of data", COUNT));
    kd_schema_strict(json, "observation", members, sizeof members / sizeof *members);
}
