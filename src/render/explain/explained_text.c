/* Writes the explanation of a pixel as tables in plain text. */
#include "render/emit/emitter.h"
#include "render/explain/explain.h"

#include <math.h>
#include <stdio.h>

#define DEGREES (180 / M_PI)

static enum kd_status put_head(const struct kd_picture *picture, const struct kd_explained *x, struct kd_buffer *out)
{
    enum kd_status status;
    const struct kd_window window = kd_scene_window(picture->scene);
    KD_TRY(kd_buffer_printf(out, "pixel %u, %u", window.left + picture->plan->report.probe.x,
                            window.top + picture->plan->report.probe.y));
    if (x->eye)
        KD_TRY(kd_buffer_printf(out, " of the %s eye", x->eye));
    KD_TRY(x->pixel->rays > 1
               ? kd_buffer_printf(out,
                                  x->weight > 0 ? ": the middle one of its %u rays\n"
                                                : ": the ray in its middle, and not one of its %u rays\n",
                                  x->pixel->rays)
               : kd_buffer_printf(out, ": its one ray\n"));
    KD_TRY(kd_buffer_printf(out, "alpha %.9g, beta %.9g, lambda %.9g, eta %.9g, E %.9g\n", x->label.alpha,
                            x->label.beta, x->motion.lambda, x->motion.eta, x->label.energy));
    KD_TRY(kd_ray_motion_text(&x->motion, out));
    KD_TRY(kd_buffer_printf(out, "%s\n\n", x->why));
done:
    return status;
}

static enum kd_status put_glow(const struct kd_probed_glow *g, const char *where, struct kd_buffer *out)
{
    const double k = g->through;
    return kd_buffer_printf(out, "%-8s %-10s %11.4e %11.4e %11.4e   %11.4e %11.4e %11.4e %8.4f\n", where,
                            kd_emitters[g->emitter]->name, (double)g->light[0], (double)g->light[1],
                            (double)g->light[2], k * (double)g->light[0], k * (double)g->light[1],
                            k * (double)g->light[2], (double)g->opacity);
}

static enum kd_status put_crossings(const struct kd_explained *x, struct kd_buffer *out)
{
    enum kd_status status;
    KD_TRY(kd_buffer_printf(out, "%5s %12s %10s %12s %9s %9s %9s %9s\n", "order", "r (M)", "phi (deg)", "delay (M)",
                            "g", "T (K)", "angle", "through"));
    for (uint32_t n = 0; n < x->end.n_crossings; n++) {
        const struct kd_ray_crossing *c = &x->crossings[n];
        const struct kd_probed_place *p = kd_explained_place(x, n);
        KD_TRY(kd_buffer_printf(out, "%5u %12.6f %10.3f %12.5f %9.5f", n, c->r, DEGREES * c->phi, c->delay, c->g));
        KD_TRY(kd_explained_has_gas(p)
                   ? kd_buffer_printf(out, " %9.1f %9.2f", (double)p->temperature, DEGREES * (double)p->angle)
                   : kd_buffer_printf(out, " %9s %9s", "-", "-"));
        KD_TRY(p ? kd_buffer_printf(out, " %9.5f\n", (double)p->through)
                 : kd_buffer_printf(out, " %9s\n", x->told->n_places ? "hidden" : "-"));
    }
    double stokes[KD_EXPLAINED_STOKES];
    for (size_t i = 0; i < x->told->n_places; i++) {
        const struct kd_probed_place *p = &x->told->places[i];
        const double own[3] = { 1, (double)p->stokes[0], (double)p->stokes[1] };
        if (p->polarized)
            KD_TRY(kd_buffer_printf(out, "order %u is polarised: EVPA %.4f deg, fraction %.5f\n", p->order,
                                    DEGREES * kd_explained_evpa(own), kd_explained_polarized(own)));
    }
    const int known = kd_explained_stokes(x->told, stokes);
    if (known)
        KD_TRY(kd_buffer_printf(out, "of the ray: EVPA %.4f deg, fraction %.5f\n", DEGREES * kd_explained_evpa(stokes),
                                kd_explained_polarized(stokes)));
    if (known == 4)
        KD_TRY(kd_buffer_printf(out, "of the ray: Stokes I %.6g, Q %.6g, U %.6g, V %.6g\n", stokes[0], stokes[1],
                                stokes[2], stokes[3]));
    if (x->end.fate == KD_RAY_ESCAPED)
        KD_TRY(kd_buffer_printf(out, "sky: theta %.4f deg, phi %.4f deg, g %.5f\n", DEGREES * x->end.theta,
                                DEGREES * x->end.phi, 1 / x->label.energy));
done:
    return status;
}

static enum kd_status put_light(const struct kd_explained *x, struct kd_buffer *out)
{
    const struct kd_probed_ray *t = x->told;
    char where[16];
    enum kd_status status;
    KD_TRY(kd_buffer_printf(out, "\n%-8s %-10s %35s   %35s %8s\n", "order", "emitter", "light there, linear RGB",
                            "as it arrives", "opacity"));
    for (size_t i = 0; i < t->n_places; i++)
        for (size_t k = 0; k < t->places[i].n_glows; k++) {
            snprintf(where, sizeof where, "%u", t->places[i].order);
            KD_TRY(put_glow(&t->places[i].glows[k], where, out));
        }
    for (size_t i = 0; i < t->n_volumes; i++) {
        const struct kd_probed_volume *v = &t->volumes[i];
        KD_TRY(kd_buffer_printf(out, "%-8s %-10s %35s   %11.4e %11.4e %11.4e   depth %.5g\n", "along",
                                kd_emitters[v->emitter]->name, "", (double)v->light[0], (double)v->light[1],
                                (double)v->light[2], (double)v->depth));
    }
    if (!isnan(kd_explained_along_delay(x)))
        KD_TRY(kd_buffer_printf(out, "%-19s delay %.5g M, the mean over its light\n", "along",
                                kd_explained_along_delay(x)));
    if (t->met.met) {
        const struct kd_probed_met *m = &t->met;
        const struct kd_probed_glow glow = { .emitter = m->emitter,
                                             .light = { m->light[0], m->light[1], m->light[2] },
                                             .opacity = 1,
                                             .through = m->through };
        snprintf(where, sizeof where, "after %u", m->order);
        KD_TRY(put_glow(&glow, where, out));
    }
    for (size_t i = 0; i < t->n_ends; i++)
        KD_TRY(put_glow(&t->ends[i], t->ends[i].points ? "points" : "end", out));
    if (t->lost)
        KD_TRY(kd_buffer_printf(out, "%zu records of the ray did not fit and are not listed; the sum includes them\n",
                                t->lost));
    KD_TRY(kd_buffer_printf(out, "%-19s %35s   %11.4e %11.4e %11.4e\n", "ray", "", (double)t->light[0],
                            (double)t->light[1], (double)t->light[2]));
    KD_TRY(kd_buffer_printf(out, "%-19s %35s   %11.4e %11.4e %11.4e\n", "pixel", "", (double)x->pixel->radiance[0],
                            (double)x->pixel->radiance[1], (double)x->pixel->radiance[2]));
    KD_TRY(kd_buffer_printf(out, "%-19s %35s   %11.4f %11.4f %11.4f\n", "shown", "", x->shown[0], x->shown[1],
                            x->shown[2]));
done:
    return status;
}

static enum kd_status put_accuracy(const struct kd_picture *picture, const struct kd_explained *x,
                                   struct kd_buffer *out)
{
    enum kd_status status;
    KD_TRY(kd_buffer_printf(out, "\npath: %zu points of %zu steps, least r %.6g M; first integrals hold to %.1e",
                            x->path.course.n, x->path.course.steps, x->path.course.least_r, x->path.course.drift));
    if (!isnan(x->path.error))
        KD_TRY(kd_buffer_printf(out, ", crossings of the closed form to %.1e", x->path.error));
    KD_TRY(kd_buffer_printf(out, "\n"));
    if (x->told->n_volumes)
        KD_TRY(
            kd_buffer_printf(out, "march: %u steps, light sampled at %u places\n", x->told->steps, x->told->samples));
    if (!isnan(x->picture_error))
        KD_TRY(kd_buffer_printf(out, "picture: %s %s, radii off by %.1e at most\n",
                                kd_engine_name(picture->plan->lens.setting.engine),
                                kd_precision_name(picture->plan->lens.setting.precision), x->picture_error));
done:
    return status;
}

/* Writes the rays whose mean is the pixel's light, if there are several. */
static enum kd_status put_each(const struct kd_picture *picture, const struct kd_probed_pixel *pixel,
                               struct kd_buffer *out, struct kd_error *error)
{
    enum kd_status status = KD_OK;
    if (pixel->rays > 1)
        KD_TRY(kd_buffer_printf(out, "\n%-9s %10s %10s %5s %-9s %4s %35s   %s\n", "ray", "x", "y", "case", "fate",
                                "seen", "its light, linear RGB", "radii of crossings (M)"));
    for (uint32_t i = 0; i < pixel->rays && pixel->rays > 1; i++) {
        struct kd_explained x;
        double at[2];
        KD_TRY(kd_explain_each(picture, i, &x, error));
        kd_explained_ray_at(picture, &x, at);
        KD_TRY(kd_buffer_printf(out, "1/%-7u %10.4f %10.4f %5s %-9s %4zu %11.4e %11.4e %11.4e  ", pixel->rays, at[0],
                                at[1], x.motion.radial_case, kd_ray_fate_name(x.end.fate), x.told->n_places,
                                (double)x.told->light[0], (double)x.told->light[1], (double)x.told->light[2]));
        for (uint32_t n = 0; n < x.end.n_crossings; n++)
            KD_TRY(kd_buffer_printf(out, " %.6g", x.crossings[n].r));
        KD_TRY(kd_buffer_printf(out, "\n"));
    }
    if (pixel->rays > 1)
        KD_TRY(kd_buffer_printf(out, "their mean is the pixel's light to %.1e\n", kd_explained_sum_error(pixel)));
done:
    return status;
}

enum kd_status kd_explain_text(const struct kd_picture *picture, struct kd_buffer *out, struct kd_error *error)
{
    struct kd_explained x;
    enum kd_status status = kd_explain(picture, &x, error);
    if (!status && (put_head(picture, &x, out) || put_crossings(&x, out) || put_light(&x, out) ||
                    put_each(picture, x.pixel, out, error) || put_accuracy(picture, &x, out)))
        status = kd_error_set(error, KD_ENOMEM, "out of memory for the report on a pixel");
    kd_explained_finish(&x);
    return status;
}
