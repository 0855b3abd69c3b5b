/* Tests of Peters's inspiral. It is compared with the quadrupole formula summed over an orbit, with quadrature
 * (tests/oracle/inspiral_reference.py), and with published data of pulsars. */
#include "physics/waves/inspiral.h"

#include "inspiral_reference.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

#define COUNT(x) (sizeof(x) / sizeof *(x))

static const double sun_s = 4.925490947641267e-6; /* G M_sun/c^3, IAU 2015 */

static void close_to(const char *what, double a, double e, double got, double want, double relative)
{
    if (!(fabs(got - want) <= relative * fabs(want)))
        fail_msg("%s at a = %.17g, e = %.17g: %.17g, not %.17g: off by %.2g, allowed %.2g", what, a, e, got, want,
                 fabs(got / want - 1), relative);
}

/* The losses of energy and angular momentum, computed from the third derivatives of the quadrupole moments. Finite
 * differences would be noisy. The equation of motion x'' = -x/r^3 gives the derivatives exactly: d3(x_i x_j) =
 * -(4/r^3)(x_i v_j + v_i x_j) + (6 r v/r^5) x_i x_j, and d2(x_i x_j) = 2 v_i v_j - 2 x_i x_j/r^3. Traces are
 * subtracted. */
struct loss { double energy, momentum; /* losses per time, for eta = 1 */ };

static struct loss radiated(double a, double e)
{
    struct loss sum = { 0, 0 };
    enum { POINTS = 4000 };
    for (int k = 0; k < POINTS; k++) {
        double u = 2 * M_PI * k / POINTS, b = sqrt(1 - e * e), r = a * (1 - e * cos(u)), du = 1 / (sqrt(a) * r);
        double x[2] = { a * (cos(u) - e), a * b * sin(u) };
        double v[2] = { -a * sin(u) * du, a * b * cos(u) * du };
        double rv = x[0] * v[0] + x[1] * v[1], d2[3][3] = { 0 }, d3[3][3] = { 0 };
        for (int i = 0; i < 2; i++)
            for (int j = 0; j < 2; j++) {
                d2[i][j] = 2 * v[i] * v[j] - 2 * x[i] * x[j] / pow(r, 3);
                d3[i][j] = -4 / pow(r, 3) * (x[i] * v[j] + v[i] * x[j]) + 6 * rv / pow(r, 5) * x[i] * x[j];
            }
        double trace2 = (d2[0][0] + d2[1][1]) / 3, trace3 = (d3[0][0] + d3[1][1]) / 3;
        double power = 0, torque = 0;
        for (int i = 0; i < 3; i++)
            d2[i][i] -= trace2, d3[i][i] -= trace3;
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++)
                power += d3[i][j] * d3[i][j];
        for (int i = 0; i < 3; i++)
            torque += d2[0][i] * d3[1][i] - d2[1][i] * d3[0][i];
        sum.energy += power / 5 * r / a / POINTS; /* dt is proportional to r du */
        sum.momentum += 2.0 / 5 * torque * r / a / POINTS;
    }
    return sum;
}

/* The rates of a and e follow from the losses of energy and angular momentum, with E = -eta/(2a) and L = eta sqrt(a (1
 * - e^2)). */
static void rates(void **state)
{
    (void)state;
    for (double e = 0; e < 0.95; e += 0.1) {
        double a = 37, eta = 0.21;
        struct loss loss = radiated(a, e);
        close_to("power", a, e, kd_inspiral_power(eta, a, e), eta * eta * loss.energy, 1e-12);
        double da = -2 * a * a * eta * loss.energy, momentum = sqrt(a * (1 - e * e));
        close_to("da/dt", a, e, kd_inspiral_axis_rate(eta, a, e), da, 1e-12);
        if (e > 0) {
            double de = (da * (1 - e * e) + 2 * momentum * eta * loss.momentum) / (2 * a * e);
            close_to("de/dt", a, e, kd_inspiral_eccentricity_rate(eta, a, e), de, 1e-10);
        }
        close_to("dP/dt", a, e, kd_inspiral_period_rate(eta, a, e), 3 * M_PI * sqrt(a) * da, 1e-12);
    }
    close_to("enhancement", 1, 0.617131, kd_inspiral_enhancement(0.617131), 11.857,
             1e-4); /* Hulse and Taylor's pulsar: the enhancement by eccentricity is 11.86 */
}

static void time_by_quadrature(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT(inspiral_reference); i++) {
        const struct inspiral_reference *x = &inspiral_reference[i];
        close_to("time", x->a, x->e, kd_inspiral_time(x->eta, x->a, x->e), x->time, 1e-13);
    }
}

/* Peters 1964: a circular orbit lasts a^4/(4 beta). For e -> 1 an orbit lasts 768/425 (1 - e^2)^(7/2) times as long as
 * the circle; the next term is smaller by the factor sqrt(1 - e^2). */
static void limits(void **state)
{
    (void)state;
    double eta = 0.2, a = 300, circle = 5 * pow(a, 4) / (256 * eta);
    close_to("circle", a, 0, kd_inspiral_time(eta, a, 0), circle, 1e-14);
    for (double d = 1e-4; d > 1e-12; d /= 10) {
        double e = 1 - d, flat = (1 - e) * (1 + e);
        close_to("nearly parabolic", a, e, kd_inspiral_time(eta, a, e), circle * 768.0 / 425 * pow(flat, 3.5),
                 2.5 * sqrt(d));
    }
}

/* Along a(e) the remaining time decreases at the rate that da/dt gives. Slopes are central differences of second
 * order. */
static void axis_and_time_agree(void **state)
{
    (void)state;
    double a0 = 1e4, e0 = 0.8, eta = 0.23;
    for (double e = 0.05; e < 0.78; e += 0.05) {
        double h = 1e-4, a = kd_inspiral_axis(a0, e0, e);
        double low = kd_inspiral_axis(a0, e0, e - h), high = kd_inspiral_axis(a0, e0, e + h);
        double de = kd_inspiral_eccentricity_rate(eta, a, e);
        close_to("da/de", a, e, (high - low) / (2 * h), kd_inspiral_axis_rate(eta, a, e) / de, 1e-5);
        double dt = (kd_inspiral_time(eta, high, e + h) - kd_inspiral_time(eta, low, e - h)) / (2 * h);
        close_to("dT/de", a, e, dt, -1 / de, 1e-4);
    }
    assert_true(kd_inspiral_axis(a0, e0, e0) == a0 && kd_inspiral_axis(a0, e0, 0) == 0);
}

/* PSR B1913+16, by Weisberg, Nice & Taylor 2010, ApJ 722, 1030, table 2: 1.4398 and 1.3886 solar masses, period
 * 0.322997448911 d, e = 0.6171334. From these they compute dP/dt = -2.402531e-12 +- 14 in the last digits. Taylor &
 * Weisberg 1989 give "300 million years" until the merger. The double pulsar, by Kramer et al. 2006, Science 314, 97:
 * 1.3381 and 1.2489 solar masses, period 0.10225156248 d, e = 0.0877775, dP/dt of 1.24787e-12 (13) in size, and 85 Myr
 * until the merger. */
static void pulsars(void **state)
{
    (void)state;
    static const struct {
        double m1, m2, days, e, rate, error, myr;
    } pulsar[] = {
        { 1.4398, 1.3886, 0.322997448911, 0.6171334, -2.402531e-12, 1e-4, 300 },
        { 1.3381, 1.2489, 0.10225156248, 0.0877775, -1.24787e-12, 2e-4, 85 },
    };
    for (size_t i = 0; i < COUNT(pulsar); i++) {
        double unit = (pulsar[i].m1 + pulsar[i].m2) * sun_s, eta = kd_inspiral_eta(pulsar[i].m1 / pulsar[i].m2);
        double a = pow(pulsar[i].days * 86400 / unit / (2 * M_PI), 2.0 / 3), e = pulsar[i].e;
        close_to("dP/dt", a, e, kd_inspiral_period_rate(eta, a, e), pulsar[i].rate, pulsar[i].error);
        close_to("Myr", a, e, kd_inspiral_time(eta, a, e) * unit / 3.15576e13, pulsar[i].myr, 0.02);
    }
}

/* The chirp obeys f' = 96/5 pi^(8/3) Mc^(5/3) f^(11/3). Known frequencies: 4.4 kHz at the last stable orbit for a total
 * of one solar mass; 134 Hz one second before the end for a chirp mass of 1.21 solar masses (Maggiore 4.20). The latter
 * is 2.8 % more than Kepler's law gives for the wave of a circle at that time. */
static void chirp(void **state)
{
    (void)state;
    for (double eta = 0.05; eta <= 0.25; eta += 0.05)
        for (double tau = 1e5; tau < 1e12; tau *= 10) {
            double f = kd_inspiral_frequency(eta, tau), h = 1e-3 * tau;
            double slope = (kd_inspiral_frequency(eta, tau - h) - kd_inspiral_frequency(eta, tau + h)) / (2 * h);
            double want = 96.0 / 5 * pow(M_PI, 8.0 / 3) * pow(kd_inspiral_chirp_mass(eta), 5.0 / 3) * pow(f, 11.0 / 3);
            close_to("df/dt", tau, 0, slope, want, 1e-5);
            double a = pow(M_PI * f, -2.0 / 3);
            close_to("tau", a, 0, kd_inspiral_time(eta, a, 0), tau, 1e-13);
            /* Isaacson's flux of a wave seen face-on: each of h+ and hx has the mean flux (2 pi f h)^2/(32 pi). The
             * flux depends on the inclination by (1 + c^2)^2/4 + c^2, with its cosine c. This factor is 2 face-on, and
             * its mean over all directions is 4/5 */
            double strain = kd_inspiral_strain(eta, f, 1e9),
                   flux = pow(2 * M_PI * f * strain, 2) / (32 * M_PI) * 2 * 0.4;
            close_to("power", a, 0, flux * 4 * M_PI * 1e18, kd_inspiral_power(eta, a, 0), 1e-12);
        }
    close_to("last stable", 6, 0, kd_inspiral_frequency_isco() / sun_s, 4397, 1e-3);
    double mass = 1.21 / kd_inspiral_chirp_mass(0.25) * sun_s;
    close_to("134 Hz", 0, 0, kd_inspiral_frequency(0.25, 1 / mass) / mass, 134, 1e-2);
    double last = kd_inspiral_time(0.25, 6, 0);
    close_to("the end", 6, 0, kd_inspiral_frequency(0.25, last), kd_inspiral_frequency_isco(), 1e-13);
    assert_true(isnan(kd_inspiral_frequency(0.25, last * 0.999)));
}

static void outside_the_domain(void **state)
{
    (void)state;
    assert_true(isnan(kd_inspiral_time(0.26, 10, 0)) && isnan(kd_inspiral_time(0.2, 10, 1)) &&
                isnan(kd_inspiral_time(0.2, -1, 0)));
    assert_true(isnan(kd_inspiral_axis(10, 0, 0)) && isnan(kd_inspiral_eta(0)) &&
                isnan(kd_inspiral_strain(0.2, 0.1, 0)));
    assert_true(isnan(kd_inspiral_enhancement(1)) && isnan(kd_inspiral_period_rate(0.2, 10, -0.1)));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rates),
        cmocka_unit_test(time_by_quadrature),
        cmocka_unit_test(limits),
        cmocka_unit_test(pulsars),
        cmocka_unit_test(axis_and_time_agree),
        cmocka_unit_test(chirp),
        cmocka_unit_test(outside_the_domain),
    };
    return cmocka_run_group_tests_name("physics_inspiral", tests, NULL, NULL);
}
