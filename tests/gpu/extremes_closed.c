/* Tests of the closed form at the extremes, compared with Taylor series to 20 digits (tests/oracle/null_reference.py
 * extremes). The other files compare the kernels with the closed form. */
#include "extremes.h"

#include "physics/null/null_geodesic.h"
#include "physics/spacetime/kerr.h"

#include "null_extremes.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { COUNT = sizeof null_extremes / sizeof *null_extremes, ORDERS = 8 };

struct tally {
    double r[COUNT * ORDERS], phi;
    size_t n;
};

static void judge(const struct null_extreme *e, struct tally *t, struct extreme_row *row)
{
    struct kd_null_ray ray = { .hole = kd_hole_of(e->spin),
                               .radius = e->radius,
                               .cos_theta = e->cos_theta,
                               .alpha = e->alpha,
                               .beta = e->beta,
                               .outward = e->outward,
                               .orders = ORDERS };
    struct kd_null_path p = kd_null_trace(&ray);
    double gain[ORDERS], phi_gain[ORDERS];
    bool over = false, told = p.status == KD_NULL_CRITICAL;
    row->rays++;
    row->broken +=
        !told && (p.crossings != e->crossings || p.fate != (e->captured ? KD_NULL_CAPTURED : KD_NULL_ESCAPED));
    extreme_condition(&ray, &p, 1e-14, NULL, gain, phi_gain);
    for (int n = 0; n < p.crossings && n < e->crossings; n++) {
        const struct kd_null_crossing *x = &p.crossing[n];
        double r = fabs(x->r / e->crossing[n].r - 1), phi = fabs(remainder(x->phi - e->crossing[n].phi, 2 * M_PI));
        double delay = fabs(x->delay - e->crossing[n].delay);
        row->broken += !isfinite(x->r) || !isfinite(x->phi) || !isfinite(x->delay) || isnan(x->error_r);
        over = over || r > x->error_r || phi > x->error_phi || delay > x->error_delay;
        told = told || x->error_r > 0.01;
        t->r[t->n++] = r / (1 + gain[n]);
        t->phi = fmax(t->phi, phi / (1 + phi_gain[n]));
    }
    row->unsure += told;
    row->loose += over;
}

void extreme_closed(void)
{
    static struct tally t;
    for (int i = 0; i < COUNT;) {
        struct extreme_row row = { .engine = "closed f64", .bound = 1e-13, .phi_bound = 1e-9, .unsure_most = 1 };
        snprintf(row.what, sizeof row.what, "%s, against series", null_extremes[i].what);
        t.n = 0, t.phi = 0;
        const char *group = null_extremes[i].what;
        for (; i < COUNT && !strcmp(null_extremes[i].what, group); i++)
            judge(&null_extremes[i], &t, &row);
        extreme_spread(t.r, t.n, &row);
        row.phi = t.phi;
        extreme_row(&row);
    }
}
