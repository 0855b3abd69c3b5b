/* Tests of quantities, compared with published figures, each with its source, and with conservation laws and
 * symmetries. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>

#include "physics/math/constants.h"
#include "quantity/quantity.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* One value of a quantity; parameters as "name=value", ended by NULL. */
static double ask(const char *name, const char *output, const char *const settings[])
{
    struct kd_quantity_request request;
    struct kd_quantity_answer answer;
    struct kd_error error = { 0 };
    const struct kd_quantity *quantity = kd_quantity_find(name);
    double value = NAN;
    kd_quantity_request_init(&request, quantity);
    for (; *settings; settings++) {
        char key[40];
        size_t n = strcspn(*settings, "=");
        memcpy(key, *settings, n);
        key[n] = 0;
        if (kd_quantity_request_set(&request, key, *settings + n + 1, &error))
            fail_msg("%s %s: %s", name, *settings, error.message);
    }
    if (kd_quantity_evaluate(&request, &answer, &error))
        fail_msg("%s: %s", name, error.message);
    for (size_t i = 0; i < quantity->n_outputs; i++)
        if (!strcmp(quantity->outputs[i].name, output))
            value = answer.values[i];
    kd_quantity_answer_finish(&answer);
    return value;
}

#define ASK(name, output, ...) ask(name, output, (const char *const[]) { __VA_ARGS__, NULL })

static void published(const char *source, double got, double want, double allowed)
{
    if (!(fabs(got - want) <= allowed))
        fail_msg("%s: %.12g, not %.12g +- %.2g", source, got, want, allowed);
}

/* Tolerance: half a unit of the last published digit, unless the source gives an error. */
static void figures(void **state)
{
    (void)state;
    published("solar mass in seconds, Damour & Taylor 1991", ASK("scale", "m_s", "mass_msun=1"), 4.925490947e-6, 1e-14);
    published("M of M87*, EHT 2019, ApJL 875, L1", ASK("scale", "m_uas", "hole=m87"), 3.8, 0.4);
    published("GRAVITY 2022, A&A 657, L12, abstract: mass of Sgr A*, within 0.25 %", ASK("scale", "mass", "hole=sgra"),
              4.30e6, 1.1e4);
    published("GRAVITY 2021, arXiv:2101.12098: 8275 +- 9 pc to it", ASK("scale", "distance", "hole=sgra"), 8275, 9);
    published("radius of the horizon of one solar mass", ASK("scale", "horizon_km", "mass_msun=1"), 2.95325, 5e-6);
    published("Eiroa, Romero & Torres 2002, Phys. Rev. D 66, 024010: photon orbit at Q = 0.5",
              ASK("shadow", "orbit_r", "spin=0", "charge=0.5", "angle_deg=0"), 2.82288, 5e-6);
    published("the shadow's radius there, r^2/sqrt(Delta)", ASK("shadow", "mean_radius", "spin=0", "charge=0.5"),
              4.96791433, 5e-9);
    published("rain, from the horizon of Q = 0.8 to the inner one, (x^3)/6 + x q^2/2 with x^2 = 2r - q^2",
              ASK("infall", "proper_time_to_end", "spin=0", "charge=0.8", "r=1.6"),
              (pow(2.56, 1.5) - pow(0.16, 1.5)) / 6 + 0.32 * (1.6 - 0.4), 1e-12);
    published("Thorne 1974, ApJ 191, 507: efficiency at a = 0.998", ASK("kerr", "efficiency", "spin=0.998"), 0.321,
              5e-4);
    published("Thorne 1974: ISCO at a = 0.998", ASK("kerr", "isco", "spin=0.998"), 1.237, 5e-4);
    published("Wien's displacement law, CODATA 2018", ASK("blackbody", "peak_nm", "temperature_k=1000"), 2897.771955,
              5e-7);
    published("CIE 15: illuminant A, 2855.5 K, x", ASK("blackbody", "x", "temperature_k=2855.5"), 0.44758, 3e-5);
    published("CIE 15: illuminant A, y", ASK("blackbody", "y", "temperature_k=2855.5"), 0.40745, 3e-5);
    published("Page & Thorne 1974, Luminet 1979: the flux of a = 0 is largest at 9.55",
              ASK("disk-flux", "r_peak", "spin=0"), 9.55, 5e-3);
    published("Chandrasekhar 1983, ch. 7: b_c of a = 0", 1 / ASK("potential", "v_max_light", "l=1"), 5.196152422706632,
              1e-14);
    published("Misner, Thorne & Wheeler 1973, box 25.6: L = 4 is marginally bound",
              ASK("potential", "v_max_matter", "l=4"), 1, 1e-14);
    published("12.69 million km, Sgr A*'s horizon for its mass", ASK("scale", "horizon_km", "hole=sgra"), 1.269e7, 5e3);
}

/* The lensing ring and the photon ring of a hole without spin seen face on: S. E. Gralla, D. E. Holz & R. M. Wald
 * 2019, section III: b from 5.02 to 6.17 and from 5.19 to 5.23; each further ring is thinner by e^pi. M. D. Johnson
 * et al. 2020: gamma is smallest where light moves with the rotation. */
static void rings(void **state)
{
    (void)state;
    const double rho = ASK("photon-rings", "rho", "spin=0", "inclination_deg=0");
    published("critical curve", rho, sqrt(27), 1e-13);
    published("lensing ring", rho * (1 + ASK("photon-rings", "inner_edge", "spin=0", "inclination_deg=0", "order=1")),
              5.02, 5e-3);
    published("lensing ring", rho * (1 + ASK("photon-rings", "outer_edge", "spin=0", "inclination_deg=0", "order=1")),
              6.17, 5e-3);
    published("photon ring", rho * (1 + ASK("photon-rings", "inner_edge", "spin=0", "inclination_deg=0", "order=2")),
              5.19, 5e-3);
    published("photon ring", rho * (1 + ASK("photon-rings", "outer_edge", "spin=0", "inclination_deg=0", "order=2")),
              5.23, 5e-3);
    published("gamma of a = 0", ASK("photon-rings", "gamma", "spin=0"), M_PI, 1e-14);
    for (int k = 0; k < 4; k++) {
        const char *const angles[] = { "angle_deg=0", "angle_deg=70", "angle_deg=160", "angle_deg=250" };
        double fifth = ASK("photon-rings", "width", "order=5", angles[k]),
               sixth = ASK("photon-rings", "width", "order=6", angles[k]);
        published("a ring over the one before", log(fifth / sixth), ASK("photon-rings", "gamma", angles[k]), 1e-3);
        /* the picture is upside down when seen from below */
        const char *const mirrored[] = { "angle_deg=0", "angle_deg=-70", "angle_deg=-160", "angle_deg=-250" };
        published("from below", ASK("photon-rings", "width", "order=3", "inclination_deg=120", mirrored[k]),
                  ASK("photon-rings", "width", "order=3", angles[k]), 1e-16);
    }
    assert_true(ASK("photon-rings", "gamma", "angle_deg=180") < ASK("photon-rings", "gamma", "angle_deg=0"));
    assert_true(isnan(ASK("photon-rings", "width", "inclination_deg=90")));
}

/* The constants that constants.h calls exact follow from the definitions of the units, and the derived ones from
 * each other. */
static void constants(void **state)
{
    (void)state;
    double k = KD_K_J_K, h = KD_H_J_S, c = KD_C_M_S;
    double stefan = 2 * pow(M_PI, 5) * k * k * k * k / (15 * h * h * h * c * c);
    published("Stefan-Boltzmann", KD_STEFAN_BOLTZMANN_SI / stefan, 1, 1e-15);
    double x = 5, y = 3; /* the maxima of B_lambda and B_nu are at x = 5 (1 - e^-x) and y = 3 (1 - e^-y) */
    for (int i = 0; i < 100; i++)
        x = -5 * expm1(-x), y = -3 * expm1(-y);
    published("Wien", KD_WIEN_M_K / (h * c / (k * x)), 1, 1e-15);
    published("Wien, frequency", KD_WIEN_HZ_K / (k * y / h), 1, 1e-15);
    published("parsec", KD_PARSEC_M / (648000 / M_PI * KD_AU_M), 1, 1e-15);
    published("microarcsecond", KD_MICROARCSECOND_RAD / (M_PI / 6.48e11), 1, 1e-15);
    published("mass of the sun, kg, IAU 2015 B3 with CODATA 2014", KD_GM_SUN_SI / KD_G_SI, 1.98848e30, 1e26);
    published("Thomson: 8 pi/3 r_e^2, r_e of CODATA 2018", KD_THOMSON_M2 / (8 * M_PI / 3 * pow(2.8179403262e-15, 2)), 1,
              1e-9);
    published("astronomical unit over the radius of the sun", KD_AU_M / KD_R_SUN_M, 215.032, 5e-4);
}

/* The energy that reaches infinity is 1 - E(ISCO) per unit of accreted mass: F is the flux per proper time and proper
 * area, r dr dphi on both faces, and carries the energy E = -u_t. The integral is by Simpson's rule in x =
 * sqrt(r_isco/r), in which F and E are smooth and vanish at the ends. */
static void energy_is_conserved(void **state)
{
    (void)state;
    static const char *const spins[] = { "spin=0", "spin=0.9", "spin=-0.7" };
    for (size_t s = 0; s < 3; s++) {
        double isco = ASK("kerr", "isco", spins[s]), sum = 0;
        enum { N = 200 };
        for (int i = 1; i < N; i++) {
            char r_text[40];
            double x = (double)i / N, r = isco / (x * x), dr = 2 * r / x;
            snprintf(r_text, sizeof r_text, "r=%.17g", r);
            double share = 4 * M_PI * r * ASK("disk-flux", "page_thorne", spins[s], r_text) *
                           ASK("kerr", "energy", spins[s], r_text) * dr;
            sum += share * (i % 2 ? 4 : 2) / (3. * N);
        }
        published("luminosity of the disk", sum, ASK("disk-flux", "efficiency", spins[s]), 1e-8);
    }
}

/* A face-on ring at a = 0 has g = sqrt(1 - 3/r) all round. The formula for straight rays gives the same, because
 * lensing does not change g face-on. */
static void face_on(void **state)
{
    (void)state;
    double want = sqrt(0.5);
    published("g", ASK("redshift", "g", "spin=0", "inclination_deg=0", "r=6", "phi_deg=70"), want, 1e-15);
    published("g of order 1", ASK("redshift", "g_1", "spin=0", "inclination_deg=0", "r=6", "phi_deg=70"), want, 1e-15);
    published("g_flat", ASK("redshift", "g_flat", "spin=0", "inclination_deg=0", "r=6", "phi_deg=70"), want, 1e-15);
    /* Seen from below, the picture is upside down and has the same colours. */
    double above = ASK("redshift", "g", "inclination_deg=70", "phi_deg=200"),
           below = ASK("redshift", "g", "inclination_deg=110", "phi_deg=200");
    published("g from below", below, above, 1e-12);
    published("beta from below", ASK("redshift", "beta", "inclination_deg=110", "phi_deg=200"),
              -ASK("redshift", "beta", "inclination_deg=70", "phi_deg=200"), 1e-11);
}

/* The azimuth that rain from r covers until the inner horizon, by Simpson's rule. In the coordinates of C. Doran 2000,
 * eq. 16 and 18, it is constant. Doran's azimuth differs from ingoing Kerr-Schild azimuth by the integral of -a/((r^2 +
 * a^2) (1 + (2r/(r^2 + a^2))^(1/2))) dr. */
static double rain_turns(double a, double r)
{
    enum { PARTS = 2000 };
    double low = 1 - sqrt(1 - a * a), step = (r - low) / PARTS, sum = 0;
    for (int i = 0; i <= PARTS; i++) {
        double x = low + i * step, w = x * x + a * a;
        sum += (i == 0 || i == PARTS ? 1 : i % 2 ? 4 : 2) * a / (w * (1 + sqrt(2 * x / w)));
    }
    return -sum * step / 3;
}

/* The proper time of a fall from rest at r to the radius r cos^2(eta/2) is sqrt(r^3/2) (eta + sin eta)/2 (Misner,
 * Thorne & Wheeler 1973, eq. 31.10), in all pi/2 sqrt(r^3/2). */
static void fall(void **state)
{
    (void)state;
    double seconds = KD_M_SUN_S * 4.3e6, rain = 0, steps = 20000, end = 0.81 / 1.4358898943540673,
           span = sqrt(3) - sqrt(end);
    published("rain, horizon to singularity", ASK("infall", "proper_time_to_end", "r=2"), 4.0 / 3, 1e-9);
    published("rain in seconds", ASK("scale", "fall_s", "mass_msun=1") / ASK("scale", "m_s", "mass_msun=1"), 4.0 / 3,
              1e-14);
    assert_true(isnan(ASK("scale", "fall_s", "charge=0.5")) && isnan(ASK("scale", "fall_longest_s", "charge=0.5")));
    published("rain, 8 M to the horizon", ASK("infall", "proper_time_to_horizon", "r=8"),
              sqrt(2) / 3 * (pow(8, 1.5) - pow(2, 1.5)), 1e-12);
    published("the longest time within", ASK("infall", "proper_time_to_end", "r=1", "infall_energy=0"), 0.5 * M_PI - 1,
              1e-12); /* E = 0 is a fall from rest at 2 M, which takes pi */
    published("from rest", ASK("infall", "proper_time_to_end", "r=10", "infall_from=10"), 0.5 * M_PI * sqrt(500),
              1e-10);
    published("halfway", ASK("infall", "proper_time_to_end", "r=5", "infall_from=10"),
              0.5 * sqrt(500) * (0.5 * M_PI - 1), 1e-10);
    /* Rain in the coordinates of Painleve and Gullstrand: the energy at infinity of light that falls in is
     * 1 + v times the energy that rain measures, with rain's velocity v = sqrt(2/r). */
    published("starlight behind rain", ASK("infall", "g_behind", "r=8"), 2.0 / 3, 1e-14);
    published("starlight behind rain at the horizon", ASK("infall", "g_behind", "r=2"), 0.5, 1e-14);
    published("starlight behind rain within", ASK("infall", "g_behind", "r=0.5"), 1.0 / 3, 1e-14);
    /* Without spin the t of ingoing Kerr-Schild coordinates is that of Painleve and Gullstrand, the proper time of
     * rain, minus 2 (2r)^(1/2) - 4 ln(1 + (r/2)^(1/2)). */
    published("rain's coordinate time", ASK("infall", "time_to_end", "r=8"), 32.0 / 3 + 8 - 4 * log(3), 1e-10);
    published("rain's turn", ASK("infall", "azimuth_to_end_deg", "spin=0.9", "r=10"),
              rain_turns(0.9, 10) * (180 / M_PI), 1e-7);
    published("rain's turn on the axis", ASK("infall", "azimuth_to_end_deg", "spin=-0.5", "r=3", "inclination_deg=0"),
              rain_turns(-0.5, 3) * (180 / M_PI), 1e-7);
    published("seconds of Sgr A*", ASK("infall", "proper_time_to_end_s", "r=2", "mass_msun=4.3e6"), 4.0 / 3 * seconds,
              1e-6);
    published("velocity", ASK("infall", "velocity", "r=8"), 0.5, 1e-14);
    for (int i = 0; i <= steps; i++) { /* Simpson's rule for r^2/sqrt(2r (r^2 + a^2)), in sqrt(r) */
        double x = sqrt(end) + span * i / steps, r = x * x;
        rain += (i == 0 || i == steps ? 1
                 : i % 2              ? 4
                                      : 2) *
                2 * x * r * r / sqrt(2 * r * (r * r + 0.81)) * span / steps / 3;
    }
    published("rain into Kerr", ASK("infall", "proper_time_to_end", "spin=0.9", "r=3"), rain, 1e-10);
}

/* The sky that rain sees in Schwarzschild. Light from behind is shifted as in the test of Painleve-Gullstrand
 * coordinates. Light from the side, with L = 0 and p^r = 0 in rain's frame, is unshifted. At the horizon the dark disk
 * has the angular radius x = 2 atan(2/sqrt(27)), and light at its edge has E = 1/(1 - sqrt(2/r) cos x). */
static void sky_of_rain(void **state)
{
    (void)state;
    const double half = 2 / sqrt(27), cosine = (1 - half * half) / (1 + half * half);
#define RAIN "spin=0", "observer=infall"
    published("behind", ASK("sky", "g_behind", RAIN, "observer_r=8"), 2.0 / 3, 1e-14);
    published("the least is behind", ASK("sky", "g_least", RAIN, "observer_r=8"), 2.0 / 3, 1e-14);
    published("overhead", ASK("sky", "g_above", RAIN, "observer_r=0.7"), 1, 1e-14);
    published("30 degrees from straight behind", ASK("sky", "g", RAIN, "observer_r=8", "yaw_deg=150"),
              1 / (1 + 0.5 * cos(M_PI / 6)), 1e-14);
    published("the same upwards", ASK("sky", "g", RAIN, "observer_r=8", "yaw_deg=180", "pitch_deg=30"),
              1 / (1 + 0.5 * cos(M_PI / 6)), 1e-14);
    published("the dark disk at the horizon", ASK("sky", "dark_radius_deg", RAIN, "observer_r=2"),
              2 * atan(half) * (180 / M_PI), 1e-9);
    published("its edge", ASK("sky", "g_greatest", RAIN, "observer_r=2"), 1 / (1 - cosine), 1e-12);
    assert_true(isnan(ASK("sky", "g_ahead", RAIN, "observer_r=2")));
    published("far away", ASK("sky", "g_greatest", "observer_r=infinity"), 1, 0);
    /* An observer at rest at 6 M sees the sky shifted by 1/sqrt(2/3). An observer on the orbit there, with v = 1/2,
     * sees light from behind shifted further, by sqrt((1 - v)/(1 + v)). */
    published("from behind one that goes round",
              ASK("sky", "g_left", "spin=0", "observer=keplerian", "observer_r=6", "inclination_deg=90"), sqrt(0.5),
              1e-14);
    published("and from before it",
              ASK("sky", "g_right", "spin=0", "observer=keplerian", "observer_r=6", "inclination_deg=90"),
              3 * sqrt(0.5), 1e-14);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(figures),    cmocka_unit_test(constants), cmocka_unit_test(energy_is_conserved),
        cmocka_unit_test(face_on),    cmocka_unit_test(rings),     cmocka_unit_test(fall),
        cmocka_unit_test(sky_of_rain)
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
