/* Measures line profiles on one thread: the processor time of the table for a spin and an inclination, the processor
 * time of the sum, and the error of the profile. Prints one line of JSON for each spin and inclination.
 *
 *     kd_bench_line [TOLERANCE [REPEAT [DIRECTIONS]]]      defaults: 0.003, 7, 0
 *
 * DIRECTIONS: number of directions of tests/oracle/line_triangles.h, which computes the true error; 0: not computed.
 * The profile has 500 bins from 0 to 1.7. Its emissivity is r^-3 from the ISCO to 400 M. The least time of REPEAT runs
 * counts. No device is used. */
#include "physics/disk/line_profile.h"
#include "physics/spacetime/hole.h"

#include "line_triangles.h"

#include <stdio.h>
#include <time.h>

enum { BINS = 500 };
static const double spins[] = { -0.998, -0.5, 0, 0.5, 0.9, 0.99, 0.998 },
                    inclinations[] = { 5, 30, 45, 60, 70, 75, 80, 85 };
static struct kd_disk_image image;

static double own_ms(void)
{
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return 1e3 * (double)t.tv_sec + 1e-6 * (double)t.tv_nsec;
}

static double true_error(const double *edges, const double *share, int directions)
{
    double want[BINS], sum = 0, worst = 0;
    if (lt_profile(&image, 3, 400, directions, directions * 3 / 4, edges, BINS, want) < 0)
        return NAN;
    for (int i = 0; i < BINS; i++) {
        sum += share[i];
        worst = fmax(worst, fabs(sum - want[i]));
    }
    return worst;
}

static bool pair(double a, double i, double tolerance, int repeat, int directions)
{
    double edges[BINS + 1], share[BINS], table = INFINITY, sum = INFINITY;
    struct kd_line_profile profile;
    struct kd_error error;
    for (int e = 0; e <= BINS; e++)
        edges[e] = 1.7 * e / BINS;
    for (int n = 0; n < repeat; n++) {
        double begun = own_ms();
        if (!kd_disk_image_init(&image, kd_hole(a), i * M_PI / 180))
            return false;
        double made = own_ms();
        const struct kd_line_params params = { .inner = image.isco, .outer = 400, .index = 3, .tolerance = tolerance };
        if (kd_line_profile(&image, &params, edges, BINS, share, &profile, &error) != KD_OK)
            return false;
        table = fmin(table, made - begun), sum = fmin(sum, own_ms() - made);
    }
    printf("{\"spin\": %g, \"inclination_deg\": %g, \"table_ms\": %.3f, \"sum_ms\": %.3f, \"told\": %.2e", a, i, table,
           sum, profile.error);
    if (directions)
        printf(", \"true\": %.2e", true_error(edges, share, directions));
    puts("}");
    return true;
}

int main(int count, char **words)
{
    double tolerance = count > 1 ? atof(words[1]) : 0.003;
    int repeat = count > 2 ? atoi(words[2]) : 7, directions = count > 3 ? atoi(words[3]) & ~3 : 0;
    for (size_t k = 0; k < sizeof inclinations / sizeof *inclinations; k++)
        for (size_t s = 0; s < sizeof spins / sizeof *spins; s++)
            if (!pair(spins[s], inclinations[k], tolerance, repeat, directions)) {
                fprintf(stderr, "no profile at a = %g, i = %g\n", spins[s], inclinations[k]);
                return 1;
            }
    return 0;
}
