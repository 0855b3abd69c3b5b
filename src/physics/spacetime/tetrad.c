#include "physics/spacetime/tetrad.h"

#include "physics/spacetime/kerr.h"

#include <math.h>

struct kd_covector kd_tetrad_covector(const struct kd_tetrad *frame, const double x[4])
{
    const struct kd_covector *t = &frame->t, *r = &frame->r, *h = &frame->theta, *f = &frame->phi;
    return (struct kd_covector) {
        .energy = x[0] * t->energy + x[1] * r->energy + x[2] * h->energy + x[3] * f->energy,
        .momentum = x[0] * t->momentum + x[1] * r->momentum + x[2] * h->momentum + x[3] * f->momentum,
        .polar = x[0] * t->polar + x[1] * r->polar + x[2] * h->polar + x[3] * f->polar,
        .radial = x[0] * t->radial + x[1] * r->radial + x[2] * h->radial + x[3] * f->radial,
    };
}

struct kd_tetrad kd_tetrad_boosted(const struct kd_tetrad *frame, const double x[4])
{
    double legs[4][4] = { { x[0], x[1], x[2], x[3] } };
    for (int i = 1; i < 4; i++) {
        legs[i][0] = x[i];
        for (int j = 1; j < 4; j++)
            legs[i][j] = (i == j) + x[i] * x[j] / (1 + x[0]);
    }
    return (struct kd_tetrad) {
        .at = frame->at,
        .t = kd_tetrad_covector(frame, legs[0]),
        .r = kd_tetrad_covector(frame, legs[1]),
        .theta = kd_tetrad_covector(frame, legs[2]),
        .phi = kd_tetrad_covector(frame, legs[3]),
    };
}

static void swap(double *a, double *b)
{
    for (int i = 0; i < 5; i++) {
        double kept = a[i];
        a[i] = b[i];
        b[i] = kept;
    }
}

/* Scale of a row: the largest magnitude of its entries. The unknowns are pure numbers, so rows are compared relative to
 * their scales. */
static double size(const double row[5])
{
    return fmax(fmax(fabs(row[0]), fabs(row[1])), fmax(fabs(row[2]), fabs(row[3])));
}

/* Solves for the components by Gaussian elimination with scaled partial pivoting. Components that the frame does not
 * mix are exact. */
void kd_tetrad_components(const struct kd_tetrad *frame, const struct kd_covector *p, double x[4])
{
    const struct kd_covector *t = &frame->t, *r = &frame->r, *h = &frame->theta, *f = &frame->phi;
    double m[4][5] = {
        { t->energy, r->energy, h->energy, f->energy, p->energy },
        { t->momentum, r->momentum, h->momentum, f->momentum, p->momentum },
        { t->polar, r->polar, h->polar, f->polar, p->polar },
        { t->radial, r->radial, h->radial, f->radial, p->radial },
    };
    for (int i = 0; i < 4; i++) {
        int pivot = i;
        for (int k = i + 1; k < 4; k++)
            if (fabs(m[k][i]) * size(m[pivot]) > fabs(m[pivot][i]) * size(m[k]))
                pivot = k;
        swap(m[i], m[pivot]);
        for (int k = i + 1; k < 4; k++) {
            double share = m[k][i] / m[i][i];
            for (int j = i; j < 5; j++)
                m[k][j] -= share * m[i][j];
        }
    }
    for (int i = 3; i >= 0; i--) {
        x[i] = m[i][4];
        for (int j = i + 1; j < 4; j++)
            x[i] -= m[i][j] * x[j];
        x[i] /= m[i][i];
    }
}

int kd_tetrad_is_level(const struct kd_tetrad *frame)
{
    return frame->t.polar == 0 && frame->r.polar == 0 && frame->phi.polar == 0 && frame->theta.energy == 0 &&
           frame->theta.momentum == 0 && frame->theta.radial == 0;
}

/* Converts a direction from the rain frame, by the inverse of the boost that made the frame. */
struct kd_look kd_tetrad_look_past_rain(const struct kd_tetrad *frame, double energy, const double x[4])
{
    const double *v = frame->past_rain, along = v[1] * x[1] + v[2] * x[2] + v[3] * x[3], t = v[0] * x[0] - along;
    double y[4] = { 0 };
    for (int i = 1; i < 4; i++)
        y[i] = x[i] - v[i] * x[0] + v[i] * along / (1 + v[0]);
    return (struct kd_look) { -y[3] / t, y[2] / t, y[1] / t, energy / t };
}

/* In the rain frame, with B and F of observer.c, x_t - x_r is (sqrt(B) (E - omega L) - p^r)/(sqrt(B) + F). The norm of
 * the photon then gives x_t + x_r. */
struct kd_look kd_tetrad_look_inwards(const struct kd_tetrad *frame, const struct kd_covector *photon, double polar2)
{
    const double a = frame->at.hole.a, r = frame->at.r, s = frame->at.s,
                 sigma = r * r + a * a * frame->at.u * frame->at.u, w2 = r * r + a * a;
    const double delta = kd_hole_delta(&frame->at.hole, r), big = w2 * w2 - a * a * delta * s * s;
    const double round = photon->momentum * sqrt(sigma / big), up = photon->polar / sqrt(sigma);
    const double mass = kd_hole_mass(&frame->at.hole, r);
    const double energy = photon->energy - mass * a / big * photon->momentum * s;
    const double less = (sqrt(big) * energy - photon->radial) / (sqrt(big) + sqrt(mass * w2)),
                 more = (polar2 / sigma + round * round) / less;
    return kd_tetrad_look_past_rain(frame, photon->energy,
                                    (double[]) { 0.5 * (more + less), 0.5 * (more - less), up, round });
}

struct kd_look kd_tetrad_look(const struct kd_tetrad *frame, const struct kd_covector *photon)
{
    if (frame->falls && photon->radial <= 0)
        return kd_tetrad_look_inwards(frame, photon, photon->polar * photon->polar);
    double x[4];
    kd_tetrad_components(frame, photon, x);
    return (struct kd_look) { -x[3] / x[0], x[2] / x[0], x[1] / x[0], photon->energy / x[0] };
}

/* R = ((r^2 + a^2) E - a L)^2 - Delta (p_theta^2 + (L/sin(theta) - a E sin(theta))^2), from the norm of a photon. */
struct kd_covector kd_tetrad_outgoing(const struct kd_vantage *at, double alpha, double beta)
{
    double a = at->hole.a, r = at->r, across = alpha + a * at->s, along = r * r + a * a + a * alpha * at->s;
    double delta = kd_hole_delta(&at->hole, r);
    return (struct kd_covector) { 1, -alpha, beta,
                                  sqrt(fmax(0, along * along - delta * (beta * beta + across * across))) };
}
