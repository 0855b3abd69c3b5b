#include "integral/compare.h"

#include "base/schema.h"
#include "integral/integral_internal.h"
#include "integral/pictures.h"
#include "integral/sets.h"
#include "document/members.h"
#include "observe/embedded.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { PRODUCT, HOUR, STATION, U = STATION + 4, V, DATA, ERROR, MODEL, RESIDUAL }; /* columns */
enum { FLUX, WORST = 7, SIZE, ANGLE, EAST, NORTH };                                /* values */

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
    if (!status && r->what == KD_INTEGRAL_OBSERVE && kd_observation_kind_of(data, size) == KD_OBSERVATION_UVFITS) {
        if (!(r->file = malloc(size)))
            return kd_error_set(error, KD_ENOMEM, "out of memory for an observation of %zu bytes", size);
        memcpy(r->file, data, size);
        r->file_size = size;
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
    free(r->file);
    r->comparison = NULL, r->observation = NULL, r->file = NULL, r->file_size = 0;
}

/* Reads the observation from the asset that has the given name or hash. */
enum kd_status kd_integral_read_observation(struct kd_integral_request *r, const cJSON *root, struct kd_error *error)
{
    const cJSON *given =
        kd_integral_is_observed(r->what) ? cJSON_GetObjectItemCaseSensitive(root, "observation") : NULL;
    if (!given)
        return KD_OK;
    struct kd_asset_found found;
    struct kd_asset_bytes bytes;
    if (!cJSON_IsString(given))
        return kd_member_refuse(given, "/observation", "the name of an asset", error);
    const struct kd_embedded_observation *own = kd_embedded_observation_find(given->valuestring);
    if (own)
        return kd_integral_set_observation(r, own->data, own->size, error);
    if (!r->assets)
        return kd_error_field(
            error, "/observation",
            "observation names an asset of a server; on the command line, give the file with --observation FILE");
    if (!r->assets->find(r->assets->user, given->valuestring, &found) ||
        !r->assets->take(r->assets->user, found.hash, &bytes))
        return kd_error_field(error, "/observation",
                              "observation is not an asset of this server; it must be the SHA-256 of one, or %s",
                              KD_EMBEDDED_OBSERVATIONS);
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
    if (r->solve & KD_ALIGN_FLUX && isfinite(r->flux_jy))
        return kd_error_field(error, "/solve", "solve cannot have flux with flux_jy, because flux_jy gives the flux");
    if (r->solve & KD_ALIGN_FLUX && !(r->products & (1u << KD_PRODUCT_AMPLITUDE | 1u << KD_PRODUCT_VISIBILITY)))
        return kd_error_field(error, "/solve",
                              "solve has flux; products must have amplitude or visibility, because closures do not "
                              "depend on the flux");
    if (r->solve & KD_ALIGN_SHIFT && !(r->products & 1u << KD_PRODUCT_VISIBILITY))
        return kd_error_field(error, "/solve",
                              "solve has shift; products must have visibility, because amplitudes and closures do not "
                              "depend on the position");
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
    if (r->what == KD_INTEGRAL_SETS && kd_integral_given(r, "check") && !r->unchecked)
        return kd_error_field(error, "/check", "check is finer; with sets it must be none");
    if (r->what == KD_INTEGRAL_SETS) {
        r->unchecked = 1;
        KD_TRY(kd_integral_make_sets(r, error));
    }
done:
    return status;
}

const char *kd_integral_word(const struct kd_integral_answer *answer, size_t column, double number)
{
    const struct kd_integral_request *r = answer->request;
    if (!kd_integral_is_observed(r->what) || !isfinite(number))
        return NULL;
    return r->what == KD_INTEGRAL_OBSERVE || column != PRODUCT ? r->observation->station[(int)number]
           : number < KD_PRODUCT_VISIBILITY                    ? kd_product_names[(int)number]
           : number > KD_PRODUCT_VISIBILITY                    ? "visibility_im"
                                                               : "visibility_re";
}

void kd_integral_compare_lay_out(struct kd_integral_answer *answer)
{
    const struct kd_comparison *c = answer->request->comparison;
    double *const *columns = answer->columns;
    for (size_t i = 0; i < c->rows; i++) {
        const struct kd_comparison_row *row = &c->row[i];
        const struct kd_measured *m = &c->at[row->at[0]];
        const bool one = kd_product_stations(row->product) == 2;
        columns[PRODUCT][i] = row->product + row->imaginary, columns[HOUR][i] = row->hour;
        for (unsigned k = 0; k < 4; k++)
            columns[STATION + k][i] = k < kd_product_stations(row->product) ? row->station[k] : NAN;
        columns[U][i] = one ? m->u * 1e-9 : NAN, columns[V][i] = one ? m->v * 1e-9 : NAN;
        columns[DATA][i] = row->data, columns[ERROR][i] = row->error;
    }
    for (int p = 0; p < KD_PRODUCTS; p++)
        answer->chi2[0][p] = answer->chi2[1][p] = NAN;
    answer->solved = KD_ALIGNMENT_NONE;
}

/* Factor that scales the model; NaN if it cannot be determined. For light without a frequency, the map was transformed
 * as if its flux were 1. */
static double scale_of(const struct kd_integral_answer *answer, const double (*model)[2])
{
    const struct kd_integral_request *r = answer->request;
    const bool is_known = isfinite(answer->map_jy);
    const double flux_jy = answer->set ? answer->set->flux_jy : r->flux_jy;
    return isfinite(flux_jy)                       ? flux_jy / (is_known ? answer->map_jy : 1)
           : r->solve & KD_ALIGN_FLUX || !is_known ? kd_comparison_scale(r->comparison, model)
                                                   : 1;
}

void kd_integral_compare_judge(struct kd_integral_answer *answer, double (*model)[2], bool finer)
{
    const struct kd_integral_request *r = answer->request;
    struct kd_comparison *c = r->comparison;
    const double found = scale_of(answer, (const double (*)[2])model),
                 scale = isfinite(found) ? found : 1; /* closures do not determine the scale, so it is 1 */
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
    if (finer)
        return;
    answer->values[FLUX] = found * (isfinite(answer->map_jy) ? answer->map_jy : 1);
    answer->values[SIZE] = answer->solved.size, answer->values[ANGLE] = answer->solved.angle_deg;
    answer->values[EAST] = answer->solved.east * KD_UAS_PER_RADIAN;
    answer->values[NORTH] = answer->solved.north * KD_UAS_PER_RADIAN;
}

/* Lists the quantities that are solved for. The flux is one of them if nothing else determines it. */
static void write_solved(struct kd_json *json, const struct kd_integral_answer *answer)
{
    static const struct {
        const char *name;
        unsigned bit, value;
    } all[] = { { "flux_jy", KD_ALIGN_FLUX, FLUX },
                { "size", KD_ALIGN_SIZE, SIZE },
                { "position_angle_deg", KD_ALIGN_ANGLE, ANGLE },
                { "shift_east_uas", KD_ALIGN_SHIFT, EAST },
                { "shift_north_uas", KD_ALIGN_SHIFT, NORTH } };
    const struct kd_integral_request *r = answer->request;
    const bool is_free = isnan(answer->map_jy) && isnan(r->flux_jy);
    kd_json_array(json, "solved");
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        const double value = answer->values[all[i].value];
        if (!((r->solve | (is_free ? KD_ALIGN_FLUX : 0)) & all[i].bit))
            continue;
        kd_json_object(json, NULL);
        kd_json_string(json, "name", all[i].name);
        kd_json_number(json, "value", value);
        kd_json_bool(json, "converged",
                     all[i].bit == KD_ALIGN_FLUX    ? isfinite(value) && value > 0
                     : all[i].bit == KD_ALIGN_SIZE  ? answer->solved.converged[1]
                     : all[i].bit == KD_ALIGN_ANGLE ? answer->solved.converged[2]
                                                    : answer->solved.converged[3]);
        kd_json_end(json);
    }
    kd_json_end(json);
}

static void write_products(struct kd_json *json, const char *name, const double chi2[KD_PRODUCTS]);

void kd_integral_sets_judge(struct kd_integral_answer *answer, double (*model)[2])
{
    enum { TOTAL = KD_PRODUCTS, FLUX_JY, SIZE_OF, ANGLE_OF, EAST_OF, NORTH_OF, CONVERGED };
    struct kd_comparison *c = answer->request->comparison;
    const struct kd_alignment *solved = &answer->solved;
    const size_t row = answer->set->row;
    double *const *columns = answer->columns, chi2[KD_PRODUCTS], total = 0;
    const double found = model ? scale_of(answer, (const double (*)[2])model) : NAN,
                 scale = isfinite(found) ? found : 1; /* closures do not determine the scale, so it is 1 */
    for (size_t i = 0; model && i < c->n; i++)
        model[i][0] *= scale, model[i][1] *= scale;
    if (model)
        kd_comparison_judge(c, (const double (*)[2])model, chi2);
    for (int p = 0; p < KD_PRODUCTS; p++) {
        columns[p][row] = model ? chi2[p] : NAN;
        total += c->of[p] ? columns[p][row] * (double)c->of[p] : 0;
    }
    columns[TOTAL][row] = total;
    columns[FLUX_JY][row] = found * (isfinite(answer->map_jy) ? answer->map_jy : 1);
    columns[SIZE_OF][row] = model ? solved->size * answer->set->size : NAN;
    columns[ANGLE_OF][row] = model ? solved->angle_deg + answer->set->angle_deg : NAN;
    columns[EAST_OF][row] = model ? solved->east * KD_UAS_PER_RADIAN : NAN;
    columns[NORTH_OF][row] = model ? solved->north * KD_UAS_PER_RADIAN : NAN;
    columns[CONVERGED][row] = model && solved->converged[1] && solved->converged[2] && solved->converged[3];
}

void kd_integral_sets_write(struct kd_json *json, const struct kd_integral_answer *answer)
{
    double n[KD_PRODUCTS];
    for (int p = 0; p < KD_PRODUCTS; p++)
        n[p] = (double)answer->request->comparison->of[p];
    write_products(json, "n", n);
}

static void write_products(struct kd_json *json, const char *name, const double chi2[KD_PRODUCTS])
{
    kd_json_object(json, name);
    for (int p = 0; p < KD_PRODUCTS; p++)
        kd_json_number(json, kd_product_names[p], chi2[p]);
    kd_json_end(json);
}

void kd_integral_observation_write(struct kd_json *json, const struct kd_integral_request *r)
{
    const struct kd_observation *o = r->observation;
    const struct kd_comparison *c = r->comparison;
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
    if (c) {
        kd_json_number(json, "averaged", (double)(c->n + c->too_short));
        kd_json_number(json, "too_short", (double)c->too_short);
    }
    kd_json_end(json);
}

void kd_integral_compare_write(struct kd_json *json, const struct kd_integral_answer *answer)
{
    const struct kd_comparison *c = answer->request->comparison;
    double n[KD_PRODUCTS];
    for (int p = 0; p < KD_PRODUCTS; p++)
        n[p] = (double)c->of[p];
    write_products(json, "chi2", answer->chi2[0]);
    write_products(json, "chi2_finer", answer->chi2[1]);
    write_products(json, "n", n);
    write_solved(json, answer);
}

#define OR_NULL "{\"type\":[\"number\",\"null\"]}"
#define COUNT "{\"type\":\"integer\",\"minimum\":0}"
#define OF_PRODUCTS(about, type) \
    "{\"type\":\"object\",\"additionalProperties\":false,\"description\":\"" about \
    "\",\"properties\":{\"amplitude\":" type ",\"closure_phase\":" type ",\"log_closure_amplitude\":" type \
    ",\"visibility\":" type \
    "},\"required\":[\"amplitude\",\"closure_phase\",\"log_closure_amplitude\",\"visibility\"]}"
#define SOLVED \
    "{\"type\":\"array\",\"description\":\"quantities that were fitted; converged is false if a search ended at its " \
    "bounds or before its steps became small\",\"items\":{\"type\":\"object\",\"additionalProperties\":false," \
    "\"properties\":{\"name\":{\"type\":\"string\"},\"value\":{\"type\":[\"number\",\"null\"]},\"converged\":{" \
    "\"type\":\"boolean\"}},\"required\":[\"name\",\"value\",\"converged\"]}}"

void kd_integral_compare_schema(struct kd_json *json)
{
    kd_schema_text(json, "chi2",
                   OF_PRODUCTS("chi^2 over the number of data; null for a product without data", OR_NULL));
    kd_schema_text(
        json, "chi2_finer",
        OF_PRODUCTS("chi^2 over the number of data for a map 1.5 times as fine; null with check none", OR_NULL));
    kd_schema_text(json, "n", OF_PRODUCTS("number of data; two for each visibility", COUNT));
    kd_schema_text(json, "solved", SOLVED);
}

void kd_integral_observation_schema(struct kd_json *json, bool compared)
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
    const size_t n = sizeof members / sizeof *members;
    kd_schema_strict(json, "observation", members, compared ? n : n - 2);
}

void kd_integral_sets_schema(struct kd_json *json)
{
    kd_schema_text(json, "n", OF_PRODUCTS("number of data; two for each visibility", COUNT));
}
