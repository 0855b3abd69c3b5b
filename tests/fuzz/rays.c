/* Fuzz target: a request for rays, as JSON or an NPY array. A few rays are also traced, by the closed form, which needs
 * no device. */
#include "fuzz.h"

#include "image/npy.h"
#include "render/rays/answer.h"
#include "render/rays/check.h"
#include "render/rays/request.h"

#include <math.h>

enum { FOLLOWED = 3 };

static void check_end(const struct kd_rays_params *params, const struct kd_ray_end *end,
                      const struct kd_ray_crossing *crossings)
{
    CHECK(end->n_crossings <= params->orders, "a ray crosses %u times, asked for are %u", end->n_crossings,
          params->orders);
    for (uint32_t i = 0; i < end->n_crossings; i++)
        CHECK(isfinite(crossings[i].r) && isfinite(crossings[i].phi) && isfinite(crossings[i].delay),
              "crossing %u is at r %g, phi %g, delay %g", i, crossings[i].r, crossings[i].phi, crossings[i].delay);
    CHECK(end->fate != KD_RAY_ESCAPED || (isfinite(end->theta) && isfinite(end->phi)),
          "a ray escapes towards theta %g, phi %g", end->theta, end->phi);
}

static void follow(const struct kd_rays_request *request)
{
    struct kd_rays_params params = request->params;
    struct kd_ray_crossing crossings[FOLLOWED * KD_RAYS_MAX_ORDERS];
    struct kd_ray_end ends[FOLLOWED];
    struct kd_error error = { 0 };
    const size_t n = request->n < FOLLOWED ? request->n : FOLLOWED;
    params.engine = KD_ENGINE_CLOSED;
    params.precision = KD_PRECISION_F64;
    params.steps = 0;
    const enum kd_status status =
        kd_rays_trace(NULL, &params, request->alpha_beta, n, crossings, ends, NULL, NULL, &error);
    if (status)
        kd_fuzz_refused(status, &error);
    for (size_t i = 0; i < n && !status; i++)
        check_end(&params, &ends[i], crossings + i * params.orders);
}

/* A list read from JSON must equal the list read from an NPY array. */
static void check_array(const struct kd_rays_request *request)
{
    const struct kd_npy array = {
        .fields = { { "", KD_NPY_F8, 0 } }, .n_fields = 1, .shape = { request->n, 2 }, .n_dimensions = 2
    };
    struct kd_buffer bytes = { 0 };
    struct kd_rays_request other;
    struct kd_error error = { 0 };
    CHECK(!kd_npy_write_header(&array, &bytes) &&
              !kd_buffer_append(&bytes, request->alpha_beta, 2 * sizeof(double) * request->n),
          "an array cannot be written");
    kd_rays_request_init(&other);
    CHECK(!kd_rays_request_npy(&other, bytes.data, bytes.size, &error), "%s: %s", error.pointer, error.message);
    CHECK(other.n == request->n && !memcmp(other.alpha_beta, request->alpha_beta, 2 * sizeof(double) * other.n),
          "an array reads back as another one");
    kd_rays_request_finish(&other);
    kd_buffer_finish(&bytes);
}

int kd_fuzz_rays(const uint8_t *data, size_t size)
{
    const bool npy = kd_rays_request_is_npy(data, size);
    struct kd_fuzz_text text = npy ? kd_fuzz_bare(data, size) : kd_fuzz_copy(data, size);
    const struct kd_capacity device = kd_fuzz_device();
    struct kd_rays_request request;
    struct kd_error error = { 0 };
    kd_rays_request_init(&request);
    enum kd_status status = npy ? kd_rays_request_npy(&request, text.at, text.size, &error)
                                : kd_rays_request_json(&request, text.at, text.size, &error);
    if (!status && request.n && request.alpha_beta)
        check_array(&request);
    if (!status)
        status = kd_rays_request_settle(&request, &device, &error);
    if (!status)
        status = kd_rays_request_check(&request, &error);
    if (status)
        kd_fuzz_refused(status, &error);
    else
        follow(&request);
    kd_rays_request_finish(&request);
    free(text.at);
    return 0;
}
