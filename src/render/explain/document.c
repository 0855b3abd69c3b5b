/* Writes the explanation of a pixel as JSON. */
#include "base/json.h"
#include "render/explain/explain.h"
#include "render/explain/steps.h"
#include "render/emit/emitter.h"

#include <math.h>
#include <stdio.h>

static double luminance(const float light[3])
{
    return 0.2126 * (double)light[0] + 0.7152 * (double)light[1] + 0.0722 * (double)light[2];
}

static void put_rgb(struct kd_json *json, const char *name, const float light[3], double times)
{
    kd_json_array(json, name);
    for (int i = 0; i < 3; i++)
        kd_json_number(json, NULL, times * (double)light[i]);
    kd_json_end(json);
}

/* Writes an optical depth. Infinity, where nothing is transmitted, becomes null. */
static void put_depth(struct kd_json *json, double through)
{
    kd_json_number(json, "optical_depth", through > 0 ? 0 - log(through) : INFINITY);
}

static double passed(const struct kd_probed_stretch *s)
{
    return s->through[0] > 0 ? (double)s->through[1] / (double)s->through[0] : 1;
}

static void put_at(struct kd_json *json, const char *name, const struct kd_picture *picture,
                   const struct kd_explained *x)
{
    double at[2];
    kd_explained_ray_at(picture, x, at);
    kd_json_array(json, name);
    kd_json_number(json, NULL, at[0]);
    kd_json_number(json, NULL, at[1]);
    kd_json_end(json);
}

static void put_pixel(struct kd_json *json, const struct kd_picture *picture, const struct kd_explained *x)
{
    const struct kd_window window = kd_scene_window(picture->scene);
    kd_json_array(json, "pixel");
    kd_json_number(json, NULL, window.left + picture->plan->report.probe.x);
    kd_json_number(json, NULL, window.top + picture->plan->report.probe.y);
    kd_json_end(json);
    if (x->eye)
        kd_json_string(json, "eye", x->eye);
    put_at(json, "ray_at", picture, x);
    kd_json_number(json, "rays", x->pixel->rays);
}

static void put_colour(struct kd_json *json, const struct kd_picture *picture, const struct kd_explained *x)
{
    kd_json_object(json, "colour");
    kd_json_array(json, "shown");
    for (int i = 0; i < 3; i++)
        kd_json_number(json, NULL, x->shown[i]);
    kd_json_end(json);
    put_rgb(json, "pixel", x->pixel->radiance, 1);
    put_rgb(json, "ray", x->told->light, 1);
    kd_json_number(json, "exposure", picture->frame->exposure);
    kd_json_end(json);
}

/* Writes the constants of motion, in units of the energy that the observer measures. */
static void put_constants(struct kd_json *json, const struct kd_explained *x)
{
    const double e = x->label.energy;
    kd_json_object(json, "constants");
    kd_json_number(json, "alpha", x->label.alpha);
    kd_json_number(json, "beta", x->label.beta);
    kd_json_number(json, "lambda", x->motion.lambda);
    kd_json_number(json, "eta", x->motion.eta);
    kd_json_number(json, "E", e);
    kd_json_number(json, "L", e * x->motion.lambda);
    kd_json_number(json, "Q", e * e * x->motion.eta);
    kd_json_bool(json, "outward", x->label.outward);
    kd_json_end(json);
}

static void put_glow(struct kd_json *json, const struct kd_probed_glow *g, bool opacity)
{
    kd_json_object(json, NULL);
    kd_json_string(json, "name", kd_emitters[g->emitter]->name);
    put_rgb(json, "light", g->light, 1);
    put_rgb(json, "seen", g->light, g->through);
    kd_json_number(json, "luminance", luminance(g->light));
    kd_json_number(json, "luminance_seen", (double)g->through * luminance(g->light));
    if (opacity)
        kd_json_number(json, "opacity", g->opacity);
    else
        kd_json_bool(json, "points", g->points);
    kd_json_end(json);
}

/* Writes the emitters and absorbers at a place, as the picture's kernel has reported them. */
static void put_place(struct kd_json *json, const struct kd_explained *x, const struct kd_probed_place *p)
{
    double left = 1;
    kd_json_object(json, "picture");
    kd_json_number(json, "r", 1 / (double)p->w);
    kd_json_number(json, "g", p->g);
    if (p->footprint > 0)
        kd_json_number(json, "footprint", p->footprint);
    kd_json_end(json);
    kd_json_number(json, "through", p->through);
    kd_json_array(json, "emitters");
    for (size_t i = 0; i < p->n_glows; i++) {
        left *= 1 - (double)p->glows[i].opacity;
        put_glow(json, &p->glows[i], true);
    }
    kd_json_end(json);
    put_depth(json, left);
    (void)x;
}

static void put_evpa(struct kd_json *json, const double stokes[3])
{
    kd_json_number(json, "evpa", kd_explained_evpa(stokes));
    kd_json_number(json, "polarization_fraction", kd_explained_polarized(stokes));
}

static void put_polarization(struct kd_json *json, const char *name, const double *stokes, int n)
{
    kd_json_object(json, name);
    kd_json_array(json, "stokes");
    for (int i = 0; i < n; i++)
        kd_json_number(json, NULL, stokes[i]);
    kd_json_end(json);
    put_evpa(json, stokes);
    kd_json_end(json);
}

static void put_polarized_ray(struct kd_json *json, const struct kd_probed_ray *ray)
{
    double stokes[KD_EXPLAINED_STOKES];
    const int n = kd_explained_stokes(ray, stokes);
    if (n)
        put_polarization(json, "polarization", stokes, n);
}

/* Writes the polarisation of the mean over the pixel's rays. */
static void put_polarized_pixel(struct kd_json *json, const struct kd_probed_pixel *pixel)
{
    double stokes[KD_EXPLAINED_STOKES], sum[KD_EXPLAINED_STOKES] = { 0 };
    int n = 0;
    for (uint32_t i = 0; i < pixel->rays; i++) {
        const int known = kd_explained_stokes(&pixel->each[i], stokes);
        n = known > n ? known : n;
        for (int k = 0; k < KD_EXPLAINED_STOKES; k++)
            sum[k] += stokes[k] / pixel->rays;
    }
    if (n)
        put_polarization(json, "pixel_polarization", sum, n);
}

/* c: the crossing; NULL if there is none outside the horizon. */
static void put_velocity(struct kd_json *json, const struct kd_explained *x, const struct kd_ray_crossing *c)
{
    const struct kd_gas_velocity v = c ? kd_explained_velocity(x, c) : (struct kd_gas_velocity) { NAN, NAN };
    kd_json_number(json, "speed", v.speed);
    kd_json_number(json, "approach", v.approach);
}

static void put_crossing(struct kd_json *json, const struct kd_explained *x, uint32_t n)
{
    const bool has = n < x->end.n_crossings;
    const struct kd_ray_crossing *c = &x->crossings[n];
    const struct kd_probed_place *p = kd_explained_place(x, n);
    kd_json_object(json, NULL);
    kd_json_number(json, "order", n);
    kd_json_number(json, "r", has ? c->r : NAN);
    kd_json_number(json, "phi", has ? c->phi : NAN);
    kd_json_number(json, "azimuth", has && c->r > x->motion.horizon ? kd_explained_azimuth(x, c->phi) : NAN);
    kd_json_number(json, "delay", has ? c->delay : NAN);
    kd_json_number(json, "g", has ? c->g : NAN);
    kd_json_bool(json, "seen", p != NULL);
    if (kd_explained_has_gas(p)) {
        kd_json_number(json, "temperature", p->temperature);
        kd_json_number(json, "emission_angle", p->angle);
        put_velocity(json, x, has && c->r > x->motion.horizon ? c : NULL);
    }
    if (p && p->polarized)
        put_evpa(json, (double[]) { 1, (double)p->stokes[0], (double)p->stokes[1] });
    if (p)
        put_place(json, x, p);
    kd_json_end(json);
}

static void put_crossings(struct kd_json *json, const struct kd_explained *x)
{
    uint32_t n = x->end.n_crossings;
    for (size_t i = 0; i < x->told->n_places; i++)
        n = x->told->places[i].order >= n ? x->told->places[i].order + 1 : n;
    kd_json_array(json, "crossings");
    for (uint32_t k = 0; k < n && k < KD_RAYS_MAX_ORDERS; k++)
        put_crossing(json, x, k);
    kd_json_end(json);
}

static void put_volume(struct kd_json *json, const struct kd_probed_volume *v)
{
    kd_json_object(json, NULL);
    kd_json_string(json, "name", kd_emitters[v->emitter]->name);
    put_rgb(json, "seen", v->light, 1);
    kd_json_number(json, "luminance_seen", luminance(v->light));
    kd_json_number(json, "optical_depth", v->depth);
    kd_json_end(json);
}

static void put_stretch(struct kd_json *json, const struct kd_explained *x, const struct kd_probed_stretch *s)
{
    kd_json_object(json, NULL);
    kd_json_number(json, "order", s->order);
    for (int end = 0; end < 2; end++) {
        kd_json_number(json, end ? "to_r" : "from_r", 1 / (double)s->w[end]);
        kd_json_number(json, end ? "to_theta" : "from_theta", acos(fmax(-1, fmin(1, (double)s->u[end]))));
        kd_json_number(json, end ? "to_delay" : "from_delay", x->motion.within ? NAN : (double)s->delay[end]);
    }
    put_rgb(json, "seen", s->light, 1);
    kd_json_number(json, "through", s->through[0]);
    put_depth(json, passed(s));
    kd_json_end(json);
}

/* Writes the volumes along the ray, if the scene has any. */
static void put_along(struct kd_json *json, const struct kd_explained *x, bool stretches)
{
    const struct kd_probed_ray *t = x->told;
    float sum[3] = { 0 };
    double passes = 1;
    for (size_t i = 0; i < t->n_stretches; i++) {
        passes *= passed(&t->stretches[i]);
        for (int c = 0; c < 3; c++)
            sum[c] += t->stretches[i].light[c];
    }
    if (!kd_emit_along(&x->scene))
        return;
    kd_json_object(json, "along");
    kd_json_array(json, "names");
    for (size_t i = 0; i < t->n_volumes; i++)
        kd_json_string(json, NULL, kd_emitters[t->volumes[i].emitter]->name);
    kd_json_end(json);
    kd_json_number(json, "steps", t->steps);
    kd_json_number(json, "samples", t->samples);
    put_rgb(json, "seen", sum, 1);
    kd_json_number(json, "luminance_seen", luminance(sum));
    put_depth(json, passes);
    kd_json_number(json, "delay", kd_explained_along_delay(x));
    kd_json_array(json, "volumes");
    for (size_t i = 0; i < t->n_volumes; i++)
        put_volume(json, &t->volumes[i]);
    kd_json_end(json);
    if (stretches) {
        kd_json_array(json, "stretches");
        for (size_t i = 0; i < t->n_stretches; i++)
            put_stretch(json, x, &t->stretches[i]);
        kd_json_end(json);
    }
    kd_json_end(json);
}

/* Writes the opaque surface at which the visible part of the ray ends, if there is one. */
static void put_met(struct kd_json *json, const struct kd_explained *x)
{
    const struct kd_probed_met *m = &x->told->met;
    if (!m->met)
        return;
    kd_json_object(json, "met");
    kd_json_string(json, "name", kd_emitters[m->emitter]->name);
    kd_json_number(json, "index", m->which);
    kd_json_number(json, "order", m->order);
    kd_json_number(json, "r", 1 / (double)m->w);
    kd_json_number(json, "theta", acos(fmax(-1, fmin(1, (double)m->u))));
    kd_json_number(json, "phi", m->phi);
    kd_json_number(json, "azimuth", kd_explained_azimuth(x, m->phi));
    kd_json_number(json, "g", m->g);
    kd_json_number(json, "emission_angle", acos(fmax(0, fmin(1, (double)m->cosine))));
    put_rgb(json, "light", m->light, 1);
    put_rgb(json, "seen", m->light, m->through);
    kd_json_number(json, "luminance_seen", (double)m->through * luminance(m->light));
    kd_json_number(json, "through", m->through);
    kd_json_end(json);
}

static void put_end(struct kd_json *json, const struct kd_explained *x)
{
    const struct kd_probed_ray *t = x->told;
    kd_json_object(json, "end");
    kd_json_string(json, "fate", kd_ray_fate_name(x->end.fate));
    kd_json_string(json, "why", x->why);
    kd_json_number(json, "through", t->through);
    put_depth(json, t->through);
    if (x->end.fate == KD_RAY_ESCAPED) {
        kd_json_number(json, "theta", x->end.theta);
        kd_json_number(json, "phi", x->end.phi);
        kd_json_number(json, "azimuth", kd_explained_azimuth(x, x->end.phi));
        kd_json_number(json, "g", 1 / x->label.energy);
    }
    kd_json_array(json, "emitters");
    for (size_t i = 0; i < t->n_ends; i++)
        put_glow(json, &t->ends[i], false);
    kd_json_end(json);
    kd_json_end(json);
}

static void put_accuracy(struct kd_json *json, const struct kd_picture *picture, const struct kd_explained *x)
{
    const struct kd_setting *by = &picture->plan->lens.setting;
    kd_json_object(json, "accuracy");
    kd_json_string(json, "engine", kd_engine_name(by->engine));
    kd_json_string(json, "precision", kd_precision_name(by->precision));
    kd_json_number(json, "steps", by->steps);
    kd_json_number(json, "closed_form", x->end.error);
    kd_json_number(json, "picture", x->picture_error);
    kd_json_number(json, "path", x->path.error);
    kd_json_number(json, "first_integrals", x->path.course.drift);
    kd_json_number(json, "sum", kd_explained_sum_error(x->pixel));
    kd_json_end(json);
}

/* Writes one of the rays whose mean is the pixel's light. The object has the members of the middle ray, except those
 * for drawing. */
static void put_ray(struct kd_json *json, const struct kd_picture *picture, const struct kd_explained *x)
{
    kd_json_object(json, NULL);
    put_at(json, "ray_at", picture, x);
    kd_json_number(json, "weight", x->weight);
    put_rgb(json, "light", x->told->light, 1);
    kd_json_number(json, "luminance", luminance(x->told->light));
    put_constants(json, x);
    kd_ray_motion_json(json, &x->motion);
    put_crossings(json, x);
    put_along(json, x, false);
    put_met(json, x);
    put_end(json, x);
    put_polarized_ray(json, x->told);
    kd_json_number(json, "closed_form", x->end.error);
    kd_json_number(json, "picture", x->picture_error);
    kd_json_number(json, "lost", (double)x->told->lost);
    kd_json_end(json);
}

static enum kd_status put_each(struct kd_json *json, const struct kd_picture *picture,
                               const struct kd_probed_pixel *pixel, struct kd_error *error)
{
    enum kd_status status = KD_OK;
    kd_json_array(json, "each_ray");
    for (uint32_t i = 0; i < pixel->rays && !status; i++) {
        struct kd_explained x;
        status = kd_explain_each(picture, i, &x, error);
        if (!status)
            put_ray(json, picture, &x);
    }
    kd_json_end(json);
    return status;
}

/* Writes the engine's steps, or the reason why there are none. Writes nothing if steps were not requested. */
static void put_trace(struct kd_json *json, const struct kd_picture *picture, const struct kd_probed_pixel *told)
{
    if (!picture->plan->report.probe.steps)
        return;
    if (told->steps) {
        kd_steps_json(json, told->steps);
        return;
    }
    kd_json_object(json, "trace");
    kd_json_string(json, "none", told->no_steps);
    kd_json_end(json);
}

static enum kd_status write(const struct kd_picture *picture, const struct kd_explained *x, struct kd_buffer *out,
                            struct kd_error *error)
{
    struct kd_json json = kd_json_begin(out);
    kd_json_object(&json, NULL);
    put_pixel(&json, picture, x);
    put_colour(&json, picture, x);
    put_constants(&json, x);
    kd_ray_motion_json(&json, &x->motion);
    put_crossings(&json, x);
    put_along(&json, x, true);
    put_met(&json, x);
    put_end(&json, x);
    put_polarized_ray(&json, x->told);
    put_polarized_pixel(&json, x->pixel);
    kd_ray_path_json(&json, &x->path);
    put_trace(&json, picture, x->pixel);
    put_accuracy(&json, picture, x);
    kd_json_number(&json, "lost", (double)x->told->lost);
    kd_json_number(&json, "weight", x->weight);
    const enum kd_status status = put_each(&json, picture, x->pixel, error);
    kd_json_array(&json, "approximations");
    for (size_t i = 0; i < picture->plan->report.n_approximations; i++)
        kd_json_string(&json, NULL, picture->plan->report.approximations[i].text);
    kd_json_end(&json);
    kd_json_end(&json);
    const enum kd_status written = kd_json_finish_line(&json);
    return status || !written ? status : kd_error_set(error, KD_ENOMEM, "out of memory for the report on a pixel");
}

static enum kd_status encode(const struct kd_picture *picture, enum kd_effort effort, void **memory,
                             struct kd_buffer *out, struct kd_error *error)
{
    struct kd_explained x;
    (void)effort, (void)memory;
    enum kd_status status = kd_explain(picture, &x, error);
    if (!status)
        status = write(picture, &x, out, error);
    kd_explained_finish(&x);
    return status;
}

/* Replaces a tile by the whole picture, because places are counted in the whole picture. Of several layers only "rgb"
 * is kept. */
static enum kd_status draws(struct kd_scene *scene, struct kd_error *error)
{
    (void)error;
    *scene = kd_scene_whole(scene);
    if (scene->image.layers.count > 1)
        scene->image.layers = (struct kd_words) { 1, { { KD_LAYER_rgb, -1 } } };
    return KD_OK;
}

const struct kd_format kd_format_pixel = {
    .name = "json",
    .media_type = KD_JSON_TYPE,
    .magic = "",
    .carries = KD_CARRIES_PICTURE,
    .draws = draws,
    .encode = encode,
};
