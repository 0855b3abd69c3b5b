#include "playground/mutual.h"

#include "base/pause.h"

#include <math.h>
#include <stdlib.h>

/* Compiles a function for several vector widths. The widest one that the processor has is selected when the program
 * starts. Sums and their order are the same in all versions, and there is no fused arithmetic. Sanitizers are not
 * initialised yet when the selection runs, so builds with sanitizers have one version. */
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__) && \
    !defined(__SANITIZE_THREAD__)
#define WIDE __attribute__((target_clones("default", "avx2", "avx512f")))
#else
#define WIDE
#endif

enum { ARRAYS = 11, LANES = 8 };
enum { AX, AY, AZ, POTENTIAL, RATE, NEAR, SUMS };

enum kd_status kd_playground_mutual_reserve(struct kd_playground_mutual *mutual, size_t n, struct kd_error *error)
{
    if (n <= mutual->room)
        return KD_OK;
    const size_t room = n < 64 ? 64 : (n * 3 / 2 + 7) / 8 * 8;
    double *block = malloc(ARRAYS * room * sizeof *block);
    if (!block)
        return kd_error_set(error, KD_ENOMEM, "no memory for %zu bodies", n);
    free(mutual->block);
    double **const arrays[ARRAYS] = { &mutual->x,         &mutual->y,    &mutual->z,   &mutual->mass,
                                      &mutual->radius,    &mutual->ax,   &mutual->ay,  &mutual->az,
                                      &mutual->potential, &mutual->rate, &mutual->near };
    for (size_t i = 0; i < ARRAYS; i++)
        *arrays[i] = block + i * room;
    mutual->block = block;
    mutual->room = room;
    return KD_OK;
}

void kd_playground_mutual_finish(struct kd_playground_mutual *mutual)
{
    free(mutual->block);
    *mutual = (struct kd_playground_mutual) { 0 };
}

/* Computes the acceleration of LANES bodies, from index `first` on, by all n bodies. The lanes run in parallel, in
 * vectors if available. Each lane sums over the other bodies in order, so that the result does not depend on the
 * vector width. */
WIDE static void pull(const struct kd_playground_mutual *p, size_t first, size_t n, double softening2, double margin)
{
    double x[LANES], y[LANES], z[LANES], mass[LANES], radius[LANES], self[LANES], sum[SUMS][LANES] = { 0 };
    for (size_t l = 0; l < LANES; l++) {
        x[l] = p->x[first + l];
        y[l] = p->y[first + l];
        z[l] = p->z[first + l];
        mass[l] = p->mass[first + l];
        radius[l] = p->radius[first + l] + margin;
        self[l] = (double)(first + l);
    }
    for (size_t j = 0; j < n; j++) {
        const double xj = p->x[j], yj = p->y[j], zj = p->z[j], mj = p->mass[j], rj = p->radius[j], number = (double)j;
        for (size_t l = 0; l < LANES; l++) {
            const double dx = xj - x[l], dy = yj - y[l], dz = zj - z[l];
            const double d2 = dx * dx + dy * dy + dz * dz;
            const double inverse = self[l] != number ? 1 / sqrt(d2 + softening2) : 0;
            const double cube = inverse * inverse * inverse, strength = mj * cube, reach = radius[l] + rj;
            sum[AX][l] += strength * dx;
            sum[AY][l] += strength * dy;
            sum[AZ][l] += strength * dz;
            sum[POTENTIAL][l] -= mj * inverse;
            sum[RATE][l] += (mass[l] + mj) * cube;
            sum[NEAR][l] += d2 < reach * reach ? 1. : 0.;
        }
    }
    double *const out[SUMS] = { p->ax, p->ay, p->az, p->potential, p->rate, p->near };
    for (size_t s = 0; s < SUMS; s++)
        for (size_t l = 0; l < LANES; l++)
            out[s][first + l] = sum[s][l] - (s == NEAR); /* does not count the body itself among the near bodies */
}

void kd_playground_mutual_fill(struct kd_playground_mutual *mutual, const struct kd_playground_body *bodies, size_t n,
                               double softening, double margin)
{
    for (size_t i = 0; i < n; i++) {
        mutual->x[i] = bodies[i].x[0];
        mutual->y[i] = bodies[i].x[1];
        mutual->z[i] = bodies[i].x[2];
        mutual->mass[i] = bodies[i].mass;
        mutual->radius[i] = bodies[i].radius;
    }
    for (size_t i = n; i % LANES; i++) /* fills unused lanes */
        mutual->x[i] = mutual->y[i] = mutual->z[i] = mutual->mass[i] = mutual->radius[i] = 0;
    for (size_t first = 0; first < n; first += LANES) {
        kd_pause_every(first, 16 * LANES);
        pull(mutual, first, n, softening * softening, margin);
    }
}
