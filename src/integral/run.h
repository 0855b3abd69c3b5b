/* Computes an integral in pieces. If the integral needs pictures, the caller renders them. A run may be used by one
 * thread at a time.
 *
 *     struct kd_integral_run run;
 *     kd_integral_run_begin(&run, &request, &error);
 *     while (run.picture < run.pictures) {
 *         ... render kd_integral_scene(&request, run.picture) to a file in the format kd_integral_picture_format ...
 *         kd_integral_run_take(&run, &file, &scene, &plan, &error);
 *         while (kd_integral_run_step(&run, until_ms)) ...;
 *     }
 *     ... kd_integral_write(&run.answer, ...) ...
 *     kd_integral_run_finish(&run); */
#ifndef KD_INTEGRAL_RUN_H
#define KD_INTEGRAL_RUN_H

#include "integral/answer.h"
#include "integral/fourier.h"
#include "integral/pictures.h"

struct kd_integral_run {
    struct kd_integral_answer answer;
    unsigned picture, pictures;
    /* maps of the current picture, which are being summed */
    struct kd_buffer maps;
    struct kd_fourier_grid grid;
    const float *map[1 + KD_INTEGRAL_ORDERS];
    double scale; /* factor that converts a sum over pixels to the answer's unit */
    size_t baseline;
    size_t set;   /* for a comparison of sets: index of the current set */
    bool is_dark; /* true if the set's picture has no light */
    /* for an observation: the model at each visibility; the simulated visibilities */
    double (*model)[2], (*simulated)[2];
    uint8_t *marks; /* memory of marks for kd_simulate */
    double *scratch;
    double *scattering;         /* factor of scattering at each visibility; NULL if scattering is not applied */
    struct kd_align_room *room; /* memory of a search; NULL if there is no search */
};

/* Begins a run. Computes everything at once if no pictures are needed. After a failure the run need not be finished. */
enum kd_status kd_integral_run_begin(struct kd_integral_run *run, const struct kd_integral_request *request,
                                     struct kd_error *error);
/* Gives the run a rendered picture. Takes ownership of the file's bytes. Returns KD_EINVAL at /scene if the picture has
 * no light. */
enum kd_status kd_integral_run_take(struct kd_integral_run *run, struct kd_buffer *file, const struct kd_scene *scene,
                                    const struct kd_plan_report *report, struct kd_error *error);
/* Continues with the current picture until the time `until_ms` of kd_clock_ms. Returns false when that picture is
 * finished. */
bool kd_integral_run_step(struct kd_integral_run *run, double until_ms);
void kd_integral_run_finish(struct kd_integral_run *run);

#endif
