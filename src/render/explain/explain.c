#include "render/explain/explain.h"

#include "physics/math/angle.h"
#include "physics/spacetime/kerr.h"
#include "render/lens/label.h"
#include "render/plan/sample.h"
#include "render/plan/tile.h"
#include "render/rays/closed.h"
#include "render/view/critical_pixels.h"
#include "scene/hole.h"
#include "document/number.h"
#include "document/text.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static struct kd_null_ray null_ray(const struct kd_explained *x)
{
    const struct kd_vantage at = kd_scene_vantage(&x->scene);
    return (struct kd_null_ray) {
        .hole = at.hole,
        .radius = at.r,
        .cos_theta = at.u,
        .sin_theta = at.s,
        .alpha = x->label.alpha,
        .beta = x->label.beta,
        .outward = x->label.outward && isfinite(at.r),
        .orders = x->scene.accuracy.orders,
    };
}

/* Computes crossings and end of the ray, with azimuths and frequencies of the scene. A ray of negative energy rotates
 * the other way (view/camera.h). */
static enum kd_status find_crossings(struct kd_explained *x, struct kd_error *error)
{
    const struct kd_rays_params params = {
        KD_HOLE_FROM(&x->scene.spacetime),
        .r = x->scene.camera.r,
        .inclination_deg = x->scene.camera.inclination_deg,
        .orders = (uint32_t)x->scene.accuracy.orders,
        .engine = KD_ENGINE_CLOSED,
        .precision = KD_PRECISION_F64,
    };
    const double alpha_beta[] = { x->label.alpha, x->label.beta };
    const struct kd_ray_labels ray = { alpha_beta, &x->label.outward, 1 };
    enum kd_status status =
        x->motion.within ? kd_ray_within(&x->motion, x->frame.reversed, x->crossings, &x->end, error)
                         : kd_rays_closed(&params, &ray, KD_CLOSED_ERRORS, x->crossings, &x->end, NULL, NULL, error);
    for (uint32_t n = 0; n < x->end.n_crossings && !status; n++) {
        struct kd_ray_crossing *c = &x->crossings[n];
        c->phi = kd_ray_path_phi(&x->frame, c->phi);
        c->delay = kd_ray_path_delay(&x->frame, c->delay);
        /* both c->g and the energy are negative for light whose energy at infinity is negative */
        c->g /= x->label.energy;
    }
    x->end.phi = kd_ray_path_phi(&x->frame, x->end.phi);
    return status;
}

/* Compares the crossings with those of the picture. The picture's list ends at the last visible crossing. */
static void compare(struct kd_explained *x)
{
    x->picture_error = x->told->n_places ? 0 : NAN;
    for (size_t i = 0; i < x->told->n_places; i++) {
        const struct kd_probed_place *p = &x->told->places[i];
        const bool has = p->order < x->end.n_crossings;
        x->picture_error = fmax(x->picture_error, has ? fabs(1 / ((double)p->w * x->crossings[p->order].r) - 1) : 1);
    }
}

/* The first place at which the ray is blocked by opaque matter of the plane. NULL if the ray has none, or if a volume
 * in front of it is opaque. */
static const struct kd_probed_place *hiding(const struct kd_probed_ray *told)
{
    for (size_t i = 0; i < told->n_places; i++) {
        const struct kd_probed_place *p = &told->places[i];
        float left = p->through;
        for (size_t k = 0; k < p->n_glows; k++)
            left *= 1 - p->glows[k].opacity;
        if (left <= 0)
            return p;
    }
    return NULL;
}

static void say_why(struct kd_explained *x)
{
    int n = kd_ray_motion_why(&x->motion, x->end.fate, x->why, sizeof x->why);
#define SAY(...) n += snprintf(x->why + n, sizeof x->why - (size_t)n, __VA_ARGS__)
    if (x->told->through <= 0 && !x->told->given_up) {
        const struct kd_probed_place *hides = hiding(x->told);
        if (x->told->met.met)
            SAY(" None of this is visible: the ray ends on a surface at r = %.6g M.", 1 / (double)x->told->met.w);
        else if (hides)
            SAY(" None of this is visible: what the ray crosses at r = %.6g M hides everything behind it.",
                1 / (double)hides->w);
        else
            SAY(" None of this is visible: the matter along the ray hides everything behind it.");
    }
    if (x->told->given_up)
        SAY(" The picture's engine could not follow the ray, and shows the pixel in magenta.");
#undef SAY
}

/* The displayed colour of the pixel. */
static void find_shown(const struct kd_picture *picture, struct kd_explained *x)
{
    const struct kd_frame *f = picture->frame;
    const uint32_t column = picture->plan->report.probe.x, row = picture->plan->report.probe.y;
    const size_t at = 3 * ((size_t)row * f->width + column);
    for (size_t i = 0; i < 3; i++)
        x->shown[i] = kd_frame_bit_depth(f) == 16 ? ((const uint16_t *)kd_frame_pixels(f))[at + i] / 65535.0
                                                  : ((const uint8_t *)kd_frame_pixels(f))[at + i] / 255.0;
}

/* Computes the ray's labels, using a camera whose unit is the step between rays. */
static void find_label(const struct kd_picture *picture, struct kd_explained *x)
{
    const uint32_t steps = x->told->steps_a_pixel;
    const struct kd_scene counted = steps == picture->plan->lens.side ? x->scene : kd_critical_camera(&x->scene, steps);
    kd_lens_label(&counted, &picture->plan->lens, x->told->x, x->told->y, &x->label);
}

/* Computes everything except the path. */
static enum kd_status explain(const struct kd_picture *picture, const struct kd_probed_ray *ray, struct kd_explained *x,
                              struct kd_error *error)
{
    const bool pair = picture->plan->picture.eyes == 2,
               right = pair && picture->plan->report.probe.x >= picture->frame->width / 2;
    *x = (struct kd_explained) {
        .pixel = picture->frame->told,
        .told = ray,
        .eye = !pair   ? NULL
               : right ? "right"
                       : "left",
        .scene = pair ? kd_scene_eye(picture->scene, right ? 1 : -1) : *picture->scene,
    };
    for (uint32_t i = 0; i < x->pixel->rays; i++)
        if (x->pixel->each[i].steps_a_pixel == ray->steps_a_pixel && x->pixel->each[i].x == ray->x &&
            x->pixel->each[i].y == ray->y)
            x->weight = 1.0 / x->pixel->rays;
    find_label(picture, x);
    const struct kd_null_ray labels = null_ray(x);
    x->frame = (struct kd_ray_path_frame) { x->scene.camera.azimuth_deg * (M_PI / 180), kd_camera_twist(&x->scene),
                                            x->label.energy < 0 };
    x->motion = kd_ray_motion_of(&labels);
    enum kd_status status = find_crossings(x, error);
    if (status)
        return status;
    compare(x);
    say_why(x);
    find_shown(picture, x);
    return KD_OK;
}

enum kd_status kd_explain(const struct kd_picture *picture, struct kd_explained *x, struct kd_error *error)
{
    enum kd_status status;
    *x = (struct kd_explained) { 0 };
    if (!picture->frame->told)
        return kd_error_set(error, KD_EINTERNAL, "the frame has no report on a pixel");
    KD_TRY(explain(picture, &picture->frame->told->middle, x, error));
    KD_TRY(kd_ray_path_draw(&x->motion, &x->frame, x->crossings, x->end.n_crossings, &x->path, error));
done:
    return status;
}

enum kd_status kd_explain_each(const struct kd_picture *picture, uint32_t number, struct kd_explained *x,
                               struct kd_error *error)
{
    return explain(picture, &picture->frame->told->each[number], x, error);
}

void kd_explained_ray_at(const struct kd_picture *picture, const struct kd_explained *x, double out[2])
{
    const double steps = x->told->steps_a_pixel;
    const struct kd_window window = kd_scene_window(picture->scene);
    out[0] = window.left + (x->eye && *x->eye == 'r' ? picture->frame->width / 2 : 0) + (x->told->x + 0.5) / steps;
    out[1] = window.top + (x->told->y + 0.5) / steps;
}

double kd_explained_sum_error(const struct kd_probed_pixel *pixel)
{
    double off = 0, size = 0;
    for (int c = 0; c < 3; c++) {
        double sum = 0;
        for (uint32_t i = 0; i < pixel->rays; i++)
            sum += (double)pixel->each[i].light[c];
        off = fmax(off, fabs(sum / pixel->rays - (double)pixel->radiance[c]));
        size = fmax(size, fabs((double)pixel->radiance[c]));
    }
    return off > 0 ? off / size : 0;
}

static double luminance(const float light[3])
{
    return 0.2126 * (double)light[0] + 0.7152 * (double)light[1] + 0.0722 * (double)light[2];
}

int kd_explained_stokes(const struct kd_probed_ray *ray, double out[KD_EXPLAINED_STOKES])
{
    bool polarized = false;
    out[0] = luminance(ray->light);
    for (int c = 0; c < 3; c++)
        out[1 + c] = (double)ray->stokes[c];
    for (size_t i = 0; i < ray->n_places; i++) {
        const struct kd_probed_place *p = &ray->places[i];
        polarized |= p->polarized;
        for (size_t k = 0; k < p->n_glows; k++)
            for (int c = 0; c < 2; c++)
                out[1 + c] += (double)p->glows[k].through * luminance(p->glows[k].light) * (double)p->stokes[c];
    }
    return ray->transfers ? 4 : polarized ? 3 : 0;
}

double kd_explained_evpa(const double s[3]) { return s[1] != 0 || s[2] != 0 ? 0.5 * atan2(s[2], s[1]) : NAN; }
double kd_explained_polarized(const double s[3]) { return s[0] > 0 ? hypot(s[1], s[2]) / s[0] : NAN; }

double kd_explained_along_delay(const struct kd_explained *x)
{
    double sum = 0, light = 0;
    for (size_t i = 0; i < x->told->n_stretches; i++) {
        const struct kd_probed_stretch *s = &x->told->stretches[i];
        const double seen = luminance(s->light);
        sum += seen > 0 ? 0.5 * seen * ((double)s->delay[0] + (double)s->delay[1]) : 0;
        light += seen;
    }
    return light > 0 && !x->motion.within ? sum / light : NAN;
}

void kd_explained_finish(struct kd_explained *x) { kd_ray_path_finish(&x->path); }

const struct kd_probed_place *kd_explained_place(const struct kd_explained *x, uint32_t order)
{
    for (size_t i = 0; i < x->told->n_places; i++)
        if (x->told->places[i].order == order)
            return &x->told->places[i];
    return NULL;
}

bool kd_explained_has_gas(const struct kd_probed_place *p)
{
    for (size_t i = 0; p && i < p->n_glows; i++)
        if (p->glows[i].opacity > 0)
            return true;
    return false;
}

/* A is the lapse and W the frame dragging. The local observer measures the gas's energy per unit mass (E - W L)/A,
 * which is its Lorentz factor. The observer measures the energy (1 - W lambda)/A of light with E = 1. The gas measures
 * the energy 1/g of this light. This 1/g is the product of the Lorentz factor, of the light's local energy, and of 1 -
 * approach. */
struct kd_gas_velocity kd_explained_velocity(const struct kd_explained *x, const struct kd_ray_crossing *at)
{
    const struct kd_hole *hole = kd_scene_hole(&x->scene);
    const struct kd_metric_scalars m = kd_metric_at(hole, at->r, 0);
    const double orbit = fmax(at->r, kd_kerr_isco(hole)), lapse = sqrt(m.lapse2);
    const double gamma = (kd_kerr_energy(hole, orbit) - m.omega * kd_kerr_momentum(hole, orbit)) / lapse;
    const double local = (1 - m.omega * x->motion.lambda) / lapse, received = 1 / (x->label.energy * at->g);
    return (struct kd_gas_velocity) { sqrt(1 - 1 / (gamma * gamma)), 1 - received / (gamma * local) };
}

double kd_explained_azimuth(const struct kd_explained *x, double phi)
{
    const double turned = remainder(phi + x->frame.azimuth, 2 * M_PI);
    return turned > -M_PI ? turned : M_PI;
}

enum kd_status kd_explain_at(const char *text, struct kd_plan *plan, struct kd_error *error)
{
    const uint32_t width = plan->picture.width * (plan->picture.eyes == 2 ? 2 : 1);
    const size_t n = kd_number_span_typed(text, strlen(text)),
                 m = text[n] == ',' ? kd_number_span_typed(text + n + 1, strlen(text + n + 1)) : 0;
    const double x = n && m ? kd_number_parse(text) : NAN, y = n && m ? kd_number_parse(text + n + 1) : NAN;
    if (!(x >= 0 && x < width && y >= 0 && y < plan->picture.height) || text[n + 1 + m]) {
        char shown[64];
        kd_text_clip(shown, sizeof shown, text);
        return kd_error_field(
            error, "/at",
            "at is \"%s\"; it must be X,Y in pixels from the upper left corner, X below %u and Y below %u", shown,
            width, plan->picture.height);
    }
    kd_plan_follow_all(plan);
    plan->report.probe.on = true;
    plan->report.probe.x = (uint32_t)x;
    plan->report.probe.y = (uint32_t)y;
    return KD_OK;
}

enum kd_status kd_explain_narrow(const struct kd_capacity *capacity, struct kd_scene *scene, struct kd_plan *plan,
                                 struct kd_error *error)
{
    const struct kd_scene tile =
        kd_scene_tile(scene, (struct kd_window) { plan->report.probe.x, plan->report.probe.y, 1, 1 });
    struct kd_needs needs = kd_needs_of(scene);
    struct kd_error why = { 0 }; /* a pixel that needs the whole picture is not an error */
    struct kd_window cut;
    struct kd_plan narrow;
    if (kd_tile_check(&tile, &needs, &why))
        return KD_OK;
    needs.followed = true;
    enum kd_status status = kd_plan_make_for(&tile, &needs, capacity, &narrow, error);
    if (status)
        return status;
    *scene = kd_tile_with_margin(&tile, &cut);
    narrow.picture.cut = (struct kd_window) { 0 }; /* the tile with its margin is rendered as a picture of its own */
    /* the approximations of the picture, not those of the tile */
    memcpy(narrow.report.approximations, plan->report.approximations, sizeof narrow.report.approximations);
    narrow.report.n_approximations = plan->report.n_approximations;
    narrow.report.probe = plan->report.probe;
    narrow.report.probe.x = cut.left;
    narrow.report.probe.y = cut.top;
    *plan = narrow;
    return KD_OK;
}

enum kd_status kd_explain_trace(const char *text, struct kd_plan *plan, struct kd_error *error)
{
    char shown[64];
    kd_text_clip(shown, sizeof shown, text);
    if (strcmp(text, "steps"))
        return kd_error_field(error, "/trace",
                              "trace is \"%s\"; it must be \"steps\", for the engine's steps along the ray", shown);
    plan->report.probe.steps = true;
    return KD_OK;
}
