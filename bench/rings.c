/* Prints lensing bands and demagnification as Markdown tables, for docs/physics/photon-rings.md. The program needs no
 * device, has no options, and takes a millisecond. */
#include "physics/null/lensing.h"
#include "physics/spacetime/kerr.h"

#include <math.h>
#include <stdio.h>

enum { ORDERS = 6 };

static struct kd_critical curve_of(double spin, double inclination_deg)
{
    double i = inclination_deg * (M_PI / 180);
    return kd_critical_of(&(struct kd_critical_observer) { .hole = kd_hole_of(spin),
                                                           .radius = INFINITY,
                                                           .cos_theta = inclination_deg == 90 ? 0 : cos(i),
                                                           .sin_theta = sin(i) });
}

static void bands(void)
{
    struct kd_critical c = curve_of(0, 0);
    struct kd_critical_point p = kd_critical_at(&c, 0);
    puts("| n | inner edge, b/M | outer edge, b/M | width, M | to the critical curve: inside | outside |\n"
         "|---|---|---|---|---|---|");
    for (int n = 1; n <= ORDERS; n++) {
        double in = kd_lensing_edge(&c, &p, n, 2), out = kd_lensing_edge(&c, &p, n, INFINITY);
        printf("| %d | %.9f | %.9f | %.5g | %.5g | %.5g |\n", n, p.rho * (1 + in), p.rho * (1 + out),
               p.rho * (out - in), -p.rho * in, p.rho * out);
    }
}

struct ring { double spin, inclination_deg, angle_deg; };

static void demagnification(const struct ring *rings, int count, double source)
{
    double d[8][ORDERS + 1], gamma[8];
    for (int k = 0; k < count; k++) {
        struct kd_critical c = curve_of(rings[k].spin, rings[k].inclination_deg);
        struct kd_critical_point p = kd_critical_at(&c, rings[k].angle_deg * (M_PI / 180));
        gamma[k] = kd_shell_exponents(&p.orbit).gamma;
        for (int n = 1; n <= ORDERS; n++)
            d[k][n] = kd_lensing_edge(&c, &p, n, source);
    }
    printf("| n");
    for (int k = 0; k < count; k++)
        printf(" | a = %g, i = %g°, at %g°: d | ratio", rings[k].spin, rings[k].inclination_deg, rings[k].angle_deg);
    printf(" |\n|---");
    for (int k = 0; k < count; k++)
        printf("|---|---");
    puts("|");
    for (int n = 1; n <= ORDERS; n++) {
        printf("| %d", n);
        for (int k = 0; k < count; k++) {
            printf(" | %.4e | ", d[k][n]);
            if (n > 1)
                printf("%.9f", d[k][n] / d[k][n - 1]);
        }
        puts(" |");
    }
    printf("| e^−γ");
    for (int k = 0; k < count; k++)
        printf(" | γ = %.9f | %.9f", gamma[k], exp(-gamma[k]));
    puts(" |");
}

int main(void)
{
    static const struct ring rings[] = { { 0, 60, 30 }, { 0.9, 60, 0 }, { 0.9, 60, 160 }, { 0.998, 80, 170 } };
    bands();
    puts("");
    demagnification(rings, 4, 6);
    return 0;
}
