/* Parses requests for kd_rays_trace: a JSON document, an NPY array, or fields by name. Any thread.
 *
 *     {"spin": 0.9, "observer": {"r": "infinity", "inclination_deg": 60}, "rays": [[-5, 0], [2.5, 1e-3]],
 *      "orders": 3, "accuracy": {"profile": "high" | "tolerance": 1e-8 | "engine": "closed", "precision": "f64",
 *        "steps": 0}}
 *
 * Only "rays" is required. An NPY array has the shape (n, 2) and 8-byte floats; the other fields are then given by
 * name. */
#ifndef KD_RENDER_RAYS_REQUEST_H
#define KD_RENDER_RAYS_REQUEST_H

#include "render/rays/rays.h"

#define KD_RAYS_BODY_MAX ((size_t)64 << 20) /* bytes of a document */

struct kd_rays_request {
    struct kd_rays_params params; /* engine, precision and steps are set by kd_rays_request_settle */
    struct kd_accuracy_request asked_accuracy;
    double *alpha_beta; /* malloc'd, 2 n numbers */
    size_t n;
};

/* Initialises with the observer and the spin of the default scene, and no rays. */
void kd_rays_request_init(struct kd_rays_request *request);
void kd_rays_request_finish(struct kd_rays_request *request);

/* Merges a document into a request that has no rays yet. text[length] must be NUL. Checks types;
 * kd_rays_request_check checks ranges. Returns KD_EINVAL without a pointer if the text is not a JSON document. Time
 * is linear in length. Memory is 32 bytes a ray besides the text. */
enum kd_status kd_rays_request_json(struct kd_rays_request *request, const char *text, size_t length,
                                    struct kd_error *error);
/* Takes rays from an NPY file. Returns KD_EINVAL at "/rays" if the array's shape or type is wrong. */
enum kd_status kd_rays_request_npy(struct kd_rays_request *request, const void *data, size_t size,
                                   struct kd_error *error);
bool kd_rays_request_is_npy(const void *data, size_t size);

/* Sets one field by the last part of its name: spin, r, inclination_deg, orders, profile, tolerance, engine,
 * precision, steps. */
enum kd_status kd_rays_request_set(struct kd_rays_request *request, const char *name, const char *text,
                                   struct kd_error *error);
enum kd_status kd_rays_request_add(struct kd_rays_request *request, double alpha, double beta, struct kd_error *error);

/* Resolves engine, precision and steps from the accuracy request (render/accuracy/engine.h), once everything is
 * parsed. capacity may be NULL if the request needs no device. */
enum kd_status kd_rays_request_settle(struct kd_rays_request *request, const struct kd_capacity *capacity,
                                      struct kd_error *error);

/* Checks everything that kd_rays_trace would reject. */
enum kd_status kd_rays_request_check(const struct kd_rays_request *request, struct kd_error *error);

#endif
