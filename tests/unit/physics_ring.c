/* Tests of the lensed image of a ring and of embedded planes. They are compared with quadratures
 * (tests/oracle/ring_reference.py) and, with spin, with rays integrated in Kerr-Schild coordinates
 * (tests/oracle/kerr_schild.h). */
#include "physics/disk/thin_disk.h"
#include "physics/spacetime/embedding.h"
#include "physics/spacetime/kerr.h"
#include "physics/null/ring_image.h"
#include "physics/spacetime/observer.h"

#include "kerr_schild.h"
#include "ring_reference.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

#define COUNT(x) (sizeof(x) / sizeof *(x))
#define RADIAN (M_PI / 180)

static void within(const char *what, double a, double x, double got, double want, double bound)
{
    if (!(fabs(got - want) <= bound))
        fail_msg("%s at a = %.17g, %.17g: %.17g, not %.17g: off by %.2g, allowed %.2g", what, a, x, got, want,
                 fabs(got - want), bound);
}

static struct kd_ring_image_point image_of(double a, double q, double i_deg, double r, double phi_deg, int order)
{
    struct kd_ring_image ring;
    struct kd_ring_image_point point = { 0 };
    if (!kd_ring_image_init(&ring, (const struct kd_hole[]) { kd_hole_charged(a, q) }, i_deg * RADIAN, r, order) ||
        !kd_ring_image_find(&ring, phi_deg * RADIAN, &point))
        fail_msg("no image of order %d of a ring at %.17g, %.17g degrees, a = %.17g, i = %.17g", order, r, phi_deg, a,
                 i_deg);
    return point;
}

/* The constants of the ray follow from the place of the image, and with them g. All agree to 1e-12. */
static void without_spin(void **state)
{
    (void)state;
    for (size_t k = 0; k < COUNT(ring_reference); k++) {
        const struct ring_reference *f = &ring_reference[k];
        struct kd_ring_image_point p = image_of(0, 0, f->inclination_deg, f->r, f->phi_deg, f->order);
        double size = hypot(f->alpha, f->beta), lambda = -p.alpha * sin(f->inclination_deg * RADIAN);
        within("alpha", 0, f->r, p.alpha, f->alpha, 1e-12 * size);
        within("beta", 0, f->r, p.beta, f->beta, 1e-12 * size);
        if (f->r >= 6)
            within("g", 0, f->r, kd_disk_redshift(kd_hole(0), f->r, lambda), f->g, 1e-12 * f->g);
        assert_int_equal(p.images, 1);
    }
}

/* The reference's ray from the image meets the plane at the ring. The start of that ray has an error of 1e-9, because
 * it is at r = 1e6, with the first terms of a series for the rest of the way. Each half turn magnifies an error of
 * alpha by about 25. */
static void with_spin(void **state)
{
    static const double cases[][5] = {
        /* rows of a, i, r, phi, and of q if there is a charge */
        { 0.9, 60, 6, 90 },        { 0.9, 60, 6, 200 },   { 0.9, 60, 2.5, 20 },      { 0.998, 80, 1.5, 300 },
        { -0.7, 30, 12, 150 },     { 0.5, 85, 4.5, 5 },   { 0.99, 10, 3, 250 },      { 0.999999, 45, 2, 120 },
        { 0.3, 70, 100, 181 },     { -0.95, 75, 9, 330 }, { 0, 60, 4.5, 200, 0.99 }, { 0.6, 75, 3, 20, 0.75 },
        { -0.5, 40, 8, 300, 0.8 },
    };
    (void)state;
    for (size_t k = 0; k < COUNT(cases); k++)
        for (int order = 0; order < 2; order++) {
            const double *c = cases[k];
            struct kd_ring_image_point p = image_of(c[0], c[4], c[1], c[2], c[3], order);
            struct ks_path path =
                ks_trace(ks_from_infinity_charged(c[0], c[4], cos(c[1] * RADIAN), p.alpha, p.beta), order + 1);
            double magnified = order ? 1e3 : 30;
            assert_int_equal(path.crossings, order + 1);
            within("r", c[0], c[2], path.r[order], c[2], 1e-9 * magnified * c[2]);
            within("phi", c[0], c[3], remainder(path.phi[order] - c[3] * RADIAN, 2 * M_PI), 0, 1e-9 * magnified);
        }
}

/* Every point of every ring has an odd number of images, because two images appear or vanish together at a caustic.
 * Several images of one order occur only at high inclination, and several of order 0 only nearly edge-on. */
static void everywhere(void **state)
{
    static const double spins[] = { 0, 0.5, -0.9, 0.998 }, inclinations[] = { 0, 0.01, 20, 60, 80, 89 };
    int several = 0;
    (void)state;
    for (size_t s = 0; s < COUNT(spins); s++)
        for (size_t i = 0; i < COUNT(inclinations); i++)
            for (double r = 1.5 * kd_hole(spins[s])->outer; r < 1e4; r *= 5)
                for (int order = 0; order < 2; order++) {
                    struct kd_ring_image ring;
                    struct kd_ring_image_point p;
                    if (!kd_ring_image_init(&ring, kd_hole(spins[s]), inclinations[i] * RADIAN, r, order))
                        fail_msg("order %d, a = %g, i = %g, r = %.17g", order, spins[s], inclinations[i], r);
                    for (double phi = 0; phi < 2 * M_PI; phi += 0.7) {
                        if (!kd_ring_image_find(&ring, phi, &p))
                            fail_msg("order %d, a = %g, i = %g, r = %.17g, phi = %g", order, spins[s], inclinations[i],
                                     r, phi);
                        if (p.images % 2 == 0 || (p.images > 1 && inclinations[i] < (order ? 50 : 85)))
                            fail_msg("%d images of order %d, a = %g, i = %g, r = %.17g, phi = %g", p.images, order,
                                     spins[s], inclinations[i], r, phi);
                        several += p.images > 1;
                    }
                }
    assert_true(several > 0);
}

/* Height and distance are as accurate as r - r+. At 1 - a = 1e-12, r - r+ has an error of 1e-16 over a range of
 * 1e-6. */
static void embedding(void **state)
{
    (void)state;
    for (size_t k = 0; k < COUNT(embedding_reference); k++) {
        const struct embedding_reference *e = &embedding_reference[k];
        within("R", e->a, e->r, kd_embedding_radius(kd_hole(e->a), e->r), e->radius, 1e-15 * e->radius);
        within("z", e->a, e->r, kd_embedding_height(kd_hole(e->a), e->r), e->z, 1e-14 * e->z);
        within("distance", e->a, e->r, kd_embedding_distance(kd_hole(e->a), e->r), e->distance, 1e-14 * e->distance);
    }
    for (double a = -0.95; a < 1; a += 0.19)
        assert_true(kd_embedding_height(kd_hole(a), kd_hole(a)->outer) == 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(without_spin), cmocka_unit_test(with_spin),
                                        cmocka_unit_test(everywhere), cmocka_unit_test(embedding) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
