/* Tests that the guiding radii of particles are dense enough for the rows of the particles' grid, for all distributions
 * of the particles. */
#include "render/emit/particles.h"

#include "physics/spacetime/kerr.h"
#include "scene/hole.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

/* The share of n equally weighted radii in each row of the grid. A radius is divided between neighbouring rows by
 * distance, as in the kernel. */
static void spread(const struct kd_scene *scene, const struct kd_particle_grid *grid, uint32_t n, double *out)
{
    double isco = kd_kerr_isco(kd_scene_hole(scene)), inner = isinf(scene->disk.inner) ? isco : scene->disk.inner;
    for (uint32_t i = 0; i <= grid->rows; i++)
        out[i] = 0;
    for (uint32_t k = 0; k < n; k++) {
        double row =
            grid->rows * log(kd_particle_radius(scene, (k + 0.5) / n) / inner) / log(scene->disk.outer / inner);
        if (row < 0 || row > grid->rows)
            continue;
        uint32_t i = (uint32_t)fmin(row, grid->rows - 1);
        out[i] += (i + 1 - row) / n;
        out[i + 1] += (row - i) / n;
    }
}

/* The shares equal those of 250 000 radii within the Poisson error of a row of 10 000 particles, which is the longest
 * possible row. With only 4096 radii some rows stay empty even for ten million particles, and rings of light appear. */
static void no_row_shows_single_radii(void **state)
{
    (void)state;
    static const double indices[] = { 0, 1, 2, 3.5, 4 };
    static const int counts[] = { 10000, 300000, 1000000, 10000000 };
    for (size_t s = 0; s < sizeof indices / sizeof *indices; s++)
        for (size_t c = 0; c < sizeof counts / sizeof *counts; c++) {
            struct kd_scene scene;
            kd_scene_defaults(&scene);
            scene.disk.model = KD_DISK_PARTICLES;
            scene.disk.particles = counts[c];
            scene.disk.density_index = indices[s];
            scene.disk.epicycles = 0;
            const struct kd_particle_grid grid = kd_particle_grid(&scene);
            double *got = malloc((grid.rows + 1) * sizeof *got), *want = malloc((grid.rows + 1) * sizeof *want),
                   worst = 0;
            assert_non_null(got);
            assert_non_null(want);
            spread(&scene, &grid, grid.radii, got);
            spread(&scene, &grid, 1 << 18, want);
            for (uint32_t i = 1; i < grid.rows; i++)
                worst = fmax(worst, fabs(got[i] / want[i] - 1));
            printf("%d particles as r^-%g: %u radii in %u rows, off by %.2g\n", counts[c], indices[s], grid.radii,
                   grid.rows, worst);
            assert_true(grid.radii <= grid.count - grid.plunging && worst < 0.01);
            free(got);
            free(want);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(no_row_shows_single_radii) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
