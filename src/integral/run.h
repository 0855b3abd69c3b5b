/* Computes an integral in pieces. If it needs pictures, the caller renders them. One thread at a time.
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
    /* the maps being summed */
    struct kd_buffer maps;
    struct kd_fourier_grid grid;
    const float *map[1 + KD_INTEGRAL_ORDERS];
    double scale; /* factor by which a sum over pixels is multiplied */
    size_t baseline;
    size_t set;   /* for a comparison of sets: index of the current set */
    bool is_dark; /* true if the set's picture has no light */
    /* for an observation: the model at each visibility, and the simulated visibilities */
    double (*model)[2], (*simulated)[2];
    uint8_t *marks; /* marks for kd_simulate */
    double *scratch;
    double *scattering;         /* factor of scattering at each visibility; NULL: none */
    struct kd_align_room *room; /* memory of a search; NULL if there is no search */
};

/* Computes everything if no pictures are needed. On failure there is nothing to finish. */
enum kd_status kd_integral_run_begin(struct kd_integral_run *run, const struct kd_integral_request *request,
                                     struct kd_error *error);
/* Takes ownership of the file's bytes. Returns KD_EINVAL at /scene if the picture has no light. */
enum kd_status kd_integral_run_take(struct kd_integral_run *run, struct kd_buffer *file, const struct kd_scene *scene,
                                    const struct kd_plan_report *report, struct kd_error *error);
/* Continues with the current picture until `until_ms` on kd_clock_ms. Returns false when that picture is finished. */
bool kd_integral_run_step(struct kd_integral_run *run, double until_ms);
void kd_integral_run_finish(struct kd_integral_run *run);

#endif
