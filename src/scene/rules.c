#include "scene/observer_fault.h"
#include "scene/rules.h"

#include "physics/spacetime/kerr.h"
#include "physics/disk/lamppost.h"
#include "physics/disk/torus.h"
#include "physics/waves/qnm.h"
#include "physics/spacetime/worldline.h"
#include "scene/hole.h"
#include "document/number.h"
#include "scene/sky_scale.h"
#include "document/value.h"
#include "scene/table.h"

#include <stdio.h>

struct shown { char text[KD_NUMBER_SIZE]; };

static struct shown show(double value)
{
    struct shown s;
    kd_number_format(s.text, value);
    return s;
}

/* The fields of the hole and their values, for messages. */
struct hole_shown { char text[(1 + KD_HOLE_MORE_COUNT) * (KD_NUMBER_SIZE + 40)]; };

static struct hole_shown show_hole(const struct kd_scene *scene)
{
    struct hole_shown s;
    int n = snprintf(s.text, sizeof s.text, "spacetime.spin %s", show(scene->spacetime.spin).text);
#define SHOW(x, name, ...) \
    if (scene->spacetime.name != 0) \
        n += snprintf(s.text + n, sizeof s.text - (size_t)n, " and spacetime." #name " %s", \
                      show(scene->spacetime.name).text);
    KD_HOLE_MORE(SHOW, )
#undef SHOW
    return s;
}

/* Rounds a computed bound up to a number with few digits that is itself an accepted value. */
static struct shown show_bound(double value) { return show(ceil(value * 1e9) / 1e9); }

#define WORD_OF_NEAR(projection) \
    ((projection) == KD_PROJECTION_EQUIRECTANGULAR ? "equirectangular" \
     : (projection) == KD_PROJECTION_FULLDOME      ? "fulldome" \
                                                   : "pinhole")

/* True if the projection requires a camera at a finite radius. */
static bool is_near(enum kd_projection projection)
{
    return projection == KD_PROJECTION_PINHOLE || projection == KD_PROJECTION_EQUIRECTANGULAR ||
           projection == KD_PROJECTION_FULLDOME;
}

static bool looks_from_near(const struct kd_camera *camera)
{
    return is_near(camera->projection) || (camera->projection == KD_PROJECTION_AUTO && isfinite(camera->r));
}

enum { BITS = 8, STEPS = 4, BEAM_WIDTHS = 1000 };

static enum kd_status bit_depth(const struct kd_scene *scene, struct kd_error *error)
{
    /* the range of the field is 8 to 16, of which only two values are accepted */
    if (scene->image.bit_depth % BITS == 0)
        return KD_OK;
    return kd_error_field(error, "/image/bit_depth", "image.bit_depth is %d; it must be 8 or 16 bits",
                          scene->image.bit_depth);
}

/* The largest charge is defined like the largest spin: the horizons differ by at least 1e-6. */
static enum kd_status charge(const struct kd_scene *scene, struct kd_error *error)
{
    const double least = 1e-12, a = scene->spacetime.spin;
    if (scene->spacetime.charge == 0 || kd_scene_hole(scene)->root >= (1 - 1e-3) * sqrt(least))
        return KD_OK;
    return kd_error_field(error, "/spacetime/charge",
                          "spacetime.charge is %s M; with spacetime.spin %s it must be at most %s M",
                          show(scene->spacetime.charge).text, show(a).text,
                          show(floor(sqrt(fmax(0, (1 - a) * (1 + a) - least)) * 1e9) / 1e9).text);
}

/* The modes of a ringdown are known only for a hole without charge. */
static enum kd_status uncharged(const struct kd_scene *scene, struct kd_error *error)
{
    if (scene->spacetime.charge == 0 || scene->style.ringdown == 0)
        return KD_OK;
    return kd_error_field(error, "/style/ringdown",
                          "style.ringdown is %s; with spacetime.charge %s it must be 0, because it is known for an "
                          "uncharged hole only",
                          show(scene->style.ringdown).text, show(scene->spacetime.charge).text);
}

static enum kd_status projection(const struct kd_scene *scene, struct kd_error *error)
{
    const struct kd_camera *camera = &scene->camera;
    if (is_near(camera->projection) && !isfinite(camera->r))
        return kd_error_field(
            error, "/camera/projection",
            "camera.projection is \"%s\", which needs a finite camera.r; at \"infinity\" it must be \"plane\"",
            WORD_OF_NEAR(camera->projection));
    if (camera->projection == KD_PROJECTION_PLANE && isfinite(camera->r))
        return kd_error_field(error, "/camera/projection",
                              "camera.projection is \"plane\", whose parallel rays need camera.r \"infinity\"; at %s M "
                              "it must be \"pinhole\"",
                              show(camera->r).text);
    if (camera->projection == KD_PROJECTION_RING && isfinite(camera->r))
        return kd_error_field(error, "/camera/projection",
                              "camera.projection is \"ring\", which needs camera.r \"infinity\"; at %s M it must be "
                              "\"pinhole\"",
                              show(camera->r).text);
    return KD_OK;
}

/* A field that is set but has no effect is an error. Otherwise a user could change the value without any visible
 * result. */
static enum kd_status aim(const struct kd_scene *scene, struct kd_error *error)
{
    const struct kd_camera *camera = &scene->camera;
    const bool near = looks_from_near(camera), ring = camera->projection == KD_PROJECTION_RING;
    const struct {
        const char *pointer;
        double value;
        bool idle;
    } knobs[] = {
        { "/camera/centre_alpha", camera->centre_alpha, near || ring },
        { "/camera/centre_beta", camera->centre_beta, near || ring },
        { "/camera/yaw_deg", camera->yaw_deg, !near },
        { "/camera/pitch_deg", camera->pitch_deg, !near },
    };
    for (size_t i = 0; i < sizeof knobs / sizeof *knobs; i++)
        if (knobs[i].idle && knobs[i].value != 0)
            return kd_error_field(error, knobs[i].pointer,
                                  "camera.%s is %s; in the %s projection it must be 0, because %s aim the camera",
                                  knobs[i].pointer + sizeof "/camera", show(knobs[i].value).text,
                                  near   ? WORD_OF_NEAR(camera->projection)
                                  : ring ? "ring"
                                         : "plane",
                                  near   ? "camera.yaw_deg and camera.pitch_deg"
                                  : ring ? "camera.roll_deg and camera.ring_decades_max and _min"
                                         : "camera.centre_alpha and camera.centre_beta");
    return KD_OK;
}

static enum kd_status decades(const struct kd_scene *scene, struct kd_error *error)
{
    const struct kd_camera *camera = &scene->camera;
    if (camera->ring_decades_min < camera->ring_decades_max)
        return KD_OK;
    return kd_error_field(error, "/camera/ring_decades_min",
                          "camera.ring_decades_min is %s; it must be less than camera.ring_decades_max, %s",
                          show(camera->ring_decades_min).text, show(camera->ring_decades_max).text);
}

static enum kd_status horizon(const struct kd_scene *scene, struct kd_error *error)
{
    double r = scene->camera.r, least = kd_scene_hole(scene)->outer;
    if (r > least || scene->camera.observer == KD_OBSERVER_INFALL)
        return KD_OK;
    return kd_error_field(error, "/camera/r", "camera.r is %s M; it must be more than %s M, the horizon of %s",
                          show(r).text, show_bound(least).text, show_hole(scene).text);
}

static const struct kd_observer_names observer_names = { "/camera", "camera.", "r", "observer" };

static enum kd_status observer(const struct kd_scene *scene, struct kd_error *error)
{
    const struct kd_vantage at = kd_scene_vantage(scene);
    return kd_observer_check_place(&observer_names, (enum kd_observer)scene->camera.observer, &at, error);
}

/* Checks the numbers that describe the observer's own motion. */
static enum kd_status motion(const struct kd_scene *scene, struct kd_error *error)
{
    const struct kd_vantage at = kd_scene_vantage(scene);
    const struct kd_observer_motion m = kd_scene_observer(scene);
    return isfinite(scene->camera.r) ? kd_observer_check_numbers(&observer_names, &m, &at, error) : KD_OK;
}

/* Numbers that have no effect are an error, for the same reason as in aim(). */
static enum kd_status idle_motion(const struct kd_scene *scene, struct kd_error *error)
{
    const struct kd_camera *c = &scene->camera;
    const struct {
        const char *pointer;
        double value, idle;
        int observer;
    } knobs[] = {
        { "/camera/velocity_r", c->velocity_r, 0, KD_OBSERVER_VELOCITY },
        { "/camera/velocity_theta", c->velocity_theta, 0, KD_OBSERVER_VELOCITY },
        { "/camera/velocity_phi", c->velocity_phi, 0, KD_OBSERVER_VELOCITY },
        { "/camera/infall_from", c->infall_from, INFINITY, KD_OBSERVER_INFALL },
        { "/camera/infall_energy", c->infall_energy, INFINITY, KD_OBSERVER_INFALL },
        { "/camera/infall_momentum", c->infall_momentum, 0, KD_OBSERVER_INFALL },
    };
    for (size_t i = 0; i < sizeof knobs / sizeof *knobs; i++)
        if (knobs[i].value != knobs[i].idle && (c->observer != knobs[i].observer || !isfinite(c->r)))
            return kd_error_field(
                error, knobs[i].pointer,
                "camera.%s is %s; it must be %s unless camera.observer is \"%s\" at a finite camera.r",
                knobs[i].pointer + sizeof "/camera", show(knobs[i].value).text,
                knobs[i].idle == 0 ? "0"
                : i == 3           ? "\"infinity\""
                                   : "\"rest\"",
                kd_observers[knobs[i].observer].word);
    return KD_OK;
}

/* The motion of an observer on a path determines azimuth and time, so neither may also advance at a rate of its own. */
static enum kd_status path(const struct kd_scene *scene, struct kd_error *error)
{
    const struct kd_motion *m = &scene->motion;
    const struct kd_vantage at = kd_scene_vantage(scene);
    const struct kd_observer_motion motion = kd_scene_observer(scene);
    if (m->proper_time_rate == 0)
        return KD_OK;
    if (!kd_worldline_is_known(&motion, &at))
        return kd_error_field(
            error, "/motion/proper_time_rate",
            "motion.proper_time_rate is %s; it must be 0 unless the observer stays at a finite camera.r, orbits there "
            "in the equatorial plane, or falls from there at constant latitude",
            show(m->proper_time_rate).text);
    if (kd_scene_is_slow(scene) && scene->camera.observer == KD_OBSERVER_INFALL) {
        const char *of = scene->disk.slow_light ? "disk" : "volume";
        return kd_error_field(error, scene->disk.slow_light ? "/disk/slow_light" : "/volume/slow_light",
                              "%s.slow_light is true; with motion.proper_time_rate %s of a falling observer it must "
                              "be false, because the fall enters the ergosphere, where slow light is not computed",
                              of, show(m->proper_time_rate).text);
    }
    if (m->time_rate == 0 && m->azimuth_rate_deg == 0)
        return KD_OK;
    const bool time = m->time_rate != 0;
    return kd_error_field(error, time ? "/motion/time_rate" : "/motion/azimuth_rate_deg",
                          "motion.%s is %s; with motion.proper_time_rate %s it must be 0, because the observer's path "
                          "determines time and azimuth",
                          time ? "time_rate" : "azimuth_rate_deg", show(time ? m->time_rate : m->azimuth_rate_deg).text,
                          show(m->proper_time_rate).text);
}

static enum kd_status stereo(const struct kd_scene *scene, struct kd_error *error)
{
    const struct kd_camera *camera = &scene->camera;
    double bound;
    if (camera->stereo == KD_STEREO_NONE)
        return KD_OK;
    if (!isfinite(camera->r) ||
        (camera->projection != KD_PROJECTION_AUTO && camera->projection != KD_PROJECTION_PINHOLE))
        return kd_error_field(
            error, "/camera/stereo",
            "camera.stereo is \"pair\"; it must be \"none\" unless camera.r is finite and the projection is pinhole");
    for (int side = -1; side <= 1; side += 2) {
        const struct kd_scene eye = kd_scene_eye(scene, side);
        const struct kd_vantage at = kd_scene_vantage(&eye);
        const struct kd_observer_motion m = kd_scene_observer(&eye);
        if (!(camera->eye_distance < camera->r && kd_observer_exists(m.observer, &at) && at.r >= 0.01 && at.r <= 1e7 &&
              kd_observer_check(&m, &at, &bound) == KD_OBSERVER_SOUND))
            return kd_error_field(error, "/camera/eye_distance",
                                  "camera.eye_distance is %s M; it must be smaller, because camera.observer cannot "
                                  "exist at an eye's position",
                                  show(camera->eye_distance).text);
    }
    return KD_OK;
}

/* True if something between the disk's edges shines. */
static bool has_edges(const struct kd_scene *scene)
{
    return scene->disk.model != KD_DISK_NONE || scene->flash.brightness > 0;
}

static enum kd_status inner_edge(const struct kd_scene *scene, struct kd_error *error)
{
    double least = kd_kerr_isco(kd_scene_hole(scene));
    if (!has_edges(scene) || scene->disk.inner >= least)
        return KD_OK;
    return kd_error_field(error, "/disk/inner",
                          "disk.inner is %s M; it must be at least %s M, the ISCO of %s, or \"isco\"",
                          show(scene->disk.inner).text, show_bound(least).text, show_hole(scene).text);
}

static enum kd_status outer_edge(const struct kd_scene *scene, struct kd_error *error)
{
    bool isco = isinf(scene->disk.inner);
    double least = isco ? kd_kerr_isco(kd_scene_hole(scene)) : scene->disk.inner;
    if (!has_edges(scene) || scene->disk.outer > least)
        return KD_OK;
    return kd_error_field(error, "/disk/outer", "disk.outer is %s M; it must be more than the inner edge, %s M%s",
                          show(scene->disk.outer).text, show_bound(least).text, isco ? ", which is the ISCO" : "");
}

#define LEAST_HEIGHT 1e-5 /* minimum height at which single precision resolves positions within the disk */
static enum kd_status height(const struct kd_scene *scene, struct kd_error *error)
{
    if (scene->disk.height > 0 && scene->disk.height < LEAST_HEIGHT)
        return kd_error_field(error, "/disk/height", "disk.height is %s; it must be 0 or at least %s",
                              show(scene->disk.height).text, show(LEAST_HEIGHT).text);
    if (scene->disk.height == 0 || scene->disk.model != KD_DISK_PARTICLES)
        return KD_OK;
    return kd_error_field(error, "/disk/height", "disk.height is %s; with disk.model \"particles\" it must be 0",
                          show(scene->disk.height).text);
}

static enum kd_status disk_frequency(const struct kd_scene *scene, struct kd_error *error)
{
    if (!kd_scene_has_disk_frequency(scene) || scene->disk.frequency_ghz <= kd_scene_disk_most_ghz(scene))
        return KD_OK;
    return kd_error_field(error, "/disk/frequency_ghz",
                          "disk.frequency_ghz is %s GHz; it must be at most %s GHz, %d k T/h of the disk's largest "
                          "colour temperature, beyond which the disk is dark",
                          show(scene->disk.frequency_ghz).text,
                          show(floor(kd_scene_disk_most_ghz(scene) * 1e9) * 1e-9).text, KD_DISK_QUANTA);
}

/* A thick disk has no atmosphere: its light is integrated along rays, because such a disk has no surface. */
static enum kd_status atmosphere(const struct kd_scene *scene, struct kd_error *error)
{
    if (!scene->disk.atmosphere || scene->disk.height == 0)
        return KD_OK;
    return kd_error_field(error, "/disk/atmosphere",
                          "disk.atmosphere is \"%s\", which needs a thin disk; with disk.height %s it must be "
                          "\"isotropic\"",
                          scene->disk.atmosphere == KD_ATMOSPHERE_LAOR ? "laor" : "scattering",
                          show(scene->disk.height).text);
}

/* Limits of the spin for a disk on which its own light falls. Above FASTEST_RETURNS the error of the energy balance
 * exceeds 1e-3. Above FASTEST_REFLECTS, light that is reflected repeatedly would gain energy without bound. */
#define FASTEST_RETURNS 0.999999
#define FASTEST_REFLECTS 0.998

/* The kernel of returning light was computed for a thin disk that starts at the ISCO and has Page & Thorne's flux. */
static enum kd_status returning(const struct kd_scene *scene, struct kd_error *error)
{
    const bool reflects = scene->disk.returning == KD_RETURNS_REFLECTED;
    const char *word = reflects ? "reflected" : "thermalised";
    const double fastest = reflects ? FASTEST_REFLECTS : FASTEST_RETURNS;
    if (!scene->disk.returning || scene->disk.model == KD_DISK_NONE)
        return KD_OK;
    if (scene->disk.model == KD_DISK_SHAKURA_SUNYAEV)
        return kd_error_field(error, "/disk/returning",
                              "disk.returning is \"%s\", which needs the exact flux; with disk.model "
                              "\"shakura-sunyaev\" it must be \"none\"",
                              word);
    if (!isinf(scene->disk.inner))
        return kd_error_field(error, "/disk/returning",
                              "disk.returning is \"%s\", which needs disk.inner \"isco\"; with disk.inner %s M it must "
                              "be \"none\"",
                              word, show(scene->disk.inner).text);
    if (scene->disk.height != 0)
        return kd_error_field(error, "/disk/returning",
                              "disk.returning is \"%s\", which needs a thin disk; with disk.height %s it must be "
                              "\"none\"",
                              word, show(scene->disk.height).text);
    if (kd_hole_horizons(kd_scene_hole(scene)) > fastest * fastest)
        return kd_error_field(error, "/disk/returning",
                              "disk.returning is \"%s\", which needs a^2 + Q^2 of at most %s^2; with %s it must be "
                              "\"none\"",
                              word, show(fastest).text, show_hole(scene).text);
    return KD_OK;
}

static enum kd_status volume(const struct kd_scene *scene, struct kd_error *error)
{
    const struct kd_volume *v = &scene->volume;
    const double least = kd_scene_volume_inner(scene);
    if (v->model == KD_VOLUME_TORUS) {
        const double isco = kd_kerr_isco(kd_scene_hole(scene));
        if (!(v->torus_radius > isco))
            return kd_error_field(error, "/volume/torus_radius",
                                  "volume.torus_radius is %s M; it must be more than the ISCO, %s M",
                                  show(v->torus_radius).text, show_bound(isco).text);
        const double light = kd_kerr_photon_orbit(kd_scene_hole(scene));
        if (!(least < v->torus_radius) || !(least > light))
            return kd_error_field(error, "/volume/inner",
                                  "volume.inner is %s%s M; it must be less than volume.torus_radius, %s M, and more "
                                  "than the photon orbit, %s M",
                                  isinf(v->inner) ? "\"horizon\", for a torus " : "", show(least).text,
                                  show_bound(v->torus_radius).text, show_bound(light).text);
        const struct kd_torus torus = kd_torus_of(kd_scene_hole(scene), least, v->torus_radius);
        if (!isfinite(torus.outer) || !(torus.log_most > 0))
            return kd_error_field(error, "/volume/torus_radius",
                                  "volume.torus_radius is %s M with the inner edge at %s M, for which the torus has no "
                                  "outer edge; it must be smaller, or volume.inner larger",
                                  show(v->torus_radius).text, show(least).text);
    }
    if (v->model >= KD_VOLUME_RIAF && v->electrons == KD_VOLUME_POWER_LAW && !(v->gamma_max > v->gamma_min))
        return kd_error_field(error, "/volume/gamma_max",
                              "volume.gamma_max is %s; it must be more than volume.gamma_min, %s",
                              show(v->gamma_max).text, show_bound(v->gamma_min).text);
    if (v->normalise_to_jy > 0 &&
        !(kd_scene_is_radio(scene) && kd_scene_is_radio_alone(scene) && kd_scene_is_flat(scene)))
        return kd_error_field(error, "/volume/normalise_to_jy",
                              "volume.normalise_to_jy is %s Jy; it must be 0 unless only a volume at a radio frequency "
                              "shines, in the plane or pinhole projection",
                              show(v->normalise_to_jy).text);
    if (v->normalise_to_jy > 0 && scene->camera.stereo != KD_STEREO_NONE)
        return kd_error_field(error, "/volume/normalise_to_jy",
                              "volume.normalise_to_jy is %s Jy; for a pair of eyes it must be 0, because the density "
                              "would differ between the eyes",
                              show(v->normalise_to_jy).text);
    if (v->model == KD_VOLUME_NONE || v->outer > least)
        return KD_OK;
    return kd_error_field(error, "/volume/outer", "volume.outer is %s M; it must be more than the inner edge, %s M",
                          show(v->outer).text, show_bound(least).text);
}

/* limit, in octaves, of the growth of a jet's brightness between its edges; more growth would overflow single
 * precision */
#define JETS_GROWTH 60
static enum kd_status jets(const struct kd_scene *scene, struct kd_error *error)
{
    const struct kd_jets *j = &scene->jets;
    double least = fmax(j->inner, 1.05 * kd_scene_hole(scene)->outer);
    if (!(j->brightness > 0))
        return KD_OK;
    const double slowest = -JETS_GROWTH / log2(j->outer / least);
    if (j->outer > least && j->falloff < slowest)
        return kd_error_field(
            error, "/jets/falloff",
            "jets.falloff is %s, for which the light grows by more than 2^60 from %s to %s M; it must be at least %s",
            show(j->falloff).text, show(least).text, show(j->outer).text, show_bound(slowest).text);
    if (j->outer > least)
        return KD_OK;
    return kd_error_field(error, "/jets/outer", "jets.outer is %s M; it must be more than the inner edge, %s M",
                          show(j->outer).text, show_bound(least).text);
}

static enum kd_status spots(const struct kd_scene *scene, struct kd_error *error)
{
    const struct kd_row *r = kd_field_find("spots", "r");
    double least = kd_kerr_isco(kd_scene_hole(scene));
    for (size_t i = 0; i < scene->spots.count; i++) {
        const struct kd_spot *spot = &scene->spots.at[i];
        char path[KD_PATH_SIZE], pointer[KD_PATH_SIZE];
        if (spot->brightness == 0 || spot->r >= least)
            continue;
        kd_field_path(r, i, path);
        kd_field_pointer(r, i, pointer);
        return kd_error_field(error, pointer, "%s is %s M; it must be at least %s M, the ISCO of %s", path,
                              show(spot->r).text, show_bound(least).text, show_hole(scene).text);
    }
    return KD_OK;
}

/* minimum time between two flashes, in units of the duration of a flash; half-way between two flashes, exp(-18) of
 * the peak is left */
#define FLASH_APART 12
#define BODIES_CLEAR 1.05 /* minimum radius at which a body may be, in units of the horizon's radius */

/* Returns the error for a field of a body. */
static enum kd_status body_field(const char *name, size_t index, const char *is, const char *allowed,
                                 struct kd_error *error)
{
    char path[KD_PATH_SIZE], pointer[KD_PATH_SIZE];
    const struct kd_row *field = kd_field_find("bodies", name);
    kd_field_path(field, index, path);
    kd_field_pointer(field, index, pointer);
    return kd_error_field(error, pointer, "%s is %s; it must be %s", path, is, allowed);
}

static enum kd_status body(const struct kd_scene *scene, size_t index, struct kd_error *error)
{
    const struct kd_body *b = &scene->bodies.at[index];
    const struct kd_vantage at = kd_body_vantage(scene, b);
    const double least = BODIES_CLEAR * kd_scene_hole(scene)->outer,
                 v[] = { b->velocity_r, b->velocity_theta, b->velocity_phi };
    const bool circular = kd_observer_sense(b->motion) != 0;
    const struct kd_observer_row *row = &kd_observers[b->motion];
    char allowed[160];
    double most;
    if (b->r < least) {
        snprintf(allowed, sizeof allowed, "at least %s M, a twentieth outside the horizon", show_bound(least).text);
        return body_field("r", index, show(b->r).text, allowed, error);
    }
    if (circular && b->inclination_deg != 90) {
        snprintf(allowed, sizeof allowed, "90 with motion \"%s\", which is an orbit in the disk's plane", row->word);
        return body_field("inclination_deg", index, show(b->inclination_deg).text, allowed, error);
    }
    if (!kd_observer_exists((enum kd_observer)b->motion, &at)) {
        snprintf(allowed, sizeof allowed, "more than %s M, %s, with motion \"%s\", because inside %s",
                 show_bound(row->outside(&at.hole, at.u)).text, row->edge, row->word, row->why);
        return body_field("r", index, show(b->r).text, allowed, error);
    }
    if (b->motion == KD_OBSERVER_VELOCITY && !(v[0] * v[0] + v[1] * v[1] + v[2] * v[2] <= 0.999 * 0.999)) {
        const char *fastest = kd_observer_fastest(v, &most);
        return body_field(fastest, index, show(most).text,
                          "a velocity of at most 0.999 together with the other two components", error);
    }
    for (int i = 0; i < 3; i++)
        if (b->motion != KD_OBSERVER_VELOCITY && v[i] != 0)
            return body_field((const char *[]) { "velocity_r", "velocity_theta", "velocity_phi" }[i], index,
                              show(v[i]).text, "0 unless motion is \"velocity\"", error);
    return KD_OK;
}

static enum kd_status bodies(const struct kd_scene *scene, struct kd_error *error)
{
    enum kd_status status = KD_OK;
    for (size_t i = 0; i < scene->bodies.count && !status; i++)
        if (scene->bodies.at[i].radius > 0)
            status = body(scene, i, error);
    return status;
}

static enum kd_status flash(const struct kd_scene *scene, struct kd_error *error)
{
    const struct kd_flash *f = &scene->flash;
    const double least = KD_LAMPPOST_LEAST * kd_scene_hole(scene)->outer;
    if (!(f->brightness > 0))
        return KD_OK;
    if (f->height < least)
        return kd_error_field(error, "/flash/height", "flash.height is %s M; it must be at least %s M for %s",
                              show(f->height).text, show_bound(least).text, show_hole(scene).text);
    if (f->period > 0 && f->period < FLASH_APART * f->duration)
        return kd_error_field(error, "/flash/period",
                              "flash.period is %s M; it must be 0 or at least %s M, %d times flash.duration",
                              show(f->period).text, show_bound(FLASH_APART * f->duration).text, FLASH_APART);
    if (scene->disk.height == 0)
        return KD_OK;
    return kd_error_field(error, "/flash/brightness",
                          "flash.brightness is %s; with disk.height %s it must be 0, because a flash needs a thin disk",
                          show(f->brightness).text, show(scene->disk.height).text);
}

static enum kd_status ringdown(const struct kd_scene *scene, struct kd_error *error)
{
    if (scene->style.ringdown == 0 || fabs(scene->spacetime.spin) <= KD_QNM_SPIN_MAX)
        return KD_OK;
    return kd_error_field(error, "/style/ringdown",
                          "style.ringdown is %s; with spacetime.spin %s it must be 0, because beyond %s the modes of a "
                          "hole crowd together and none rings alone",
                          show(scene->style.ringdown).text, show(scene->spacetime.spin).text,
                          show(KD_QNM_SPIN_MAX).text);
}

static enum kd_status field_uas(const struct kd_scene *scene, struct kd_error *error)
{
    const struct kd_row *field = kd_field_find("camera", "field_m");
    const double width = kd_scene_field_of_uas(scene), of_m = scene->camera.field_uas / width;
    if (isinf(scene->camera.field_uas) || kd_row_holds(field, width))
        return KD_OK;
    return kd_error_field(error, "/camera/field_uas",
                          "camera.field_uas is %s microarcseconds; it must be %s to %s, camera.field_m %s to %s, at "
                          "this spacetime.mass_msun and spacetime.distance_pc",
                          show(scene->camera.field_uas).text, show(of_m * field->least).text,
                          show(of_m * field->most).text, show(field->least).text, show(field->most).text);
}

static enum kd_status beam(const struct kd_scene *scene, struct kd_error *error)
{
    const double width = kd_scene_width_uas(scene), most = BEAM_WIDTHS * width;
    /* Both comparisons are false for a width of NAN, so the beam is then refused. */
    if (scene->style.beam_uas == 0 || scene->style.beam_uas <= most)
        return KD_OK;
    if (isnan(width))
        return kd_error_field(error, "/style/beam_uas",
                              "style.beam_uas is %s; it must be 0 except in the plane and pinhole projections, because "
                              "in the others the angle of a pixel varies",
                              show(scene->style.beam_uas).text);
    return kd_error_field(
        error, "/style/beam_uas",
        "style.beam_uas is %s microarcseconds; it must be at most %s, %d times the width of the picture at "
        "this spacetime.mass_msun and spacetime.distance_pc",
        show(scene->style.beam_uas).text, show(most).text, BEAM_WIDTHS);
}

/* A colour bar is possible only with the heat palette and the sRGB tone map. */
static enum kd_status colour_bar(const struct kd_scene *scene, struct kd_error *error)
{
    const bool heat = scene->style.palette == KD_PALETTE_HEAT;
    if (!scene->style.colour_bar || (heat && scene->style.tone_map == KD_TONE_SRGB))
        return KD_OK;
    return kd_error_field(
        error, "/style/colour_bar",
        "style.colour_bar is true; it must be false unless style.palette is \"heat\" and style.tone_map \"srgb\", "
        "because otherwise a brightness has no unique colour, or the scale is not linear");
}

/* All other rules about accuracy.* depend on the device; they are in render/accuracy/engine.h. */
static enum kd_status steps(const struct kd_scene *scene, struct kd_error *error)
{
    if (scene->accuracy.steps % STEPS == 0)
        return KD_OK;
    return kd_error_field(error, "/accuracy/steps", "accuracy.steps is %d; it must be 0 or a multiple of 4 up to 2048",
                          scene->accuracy.steps);
}

/* A tile must lie inside its picture. Effects that need the whole picture are refused later, when a plan is made
 * (render/plan/tile.h). */
static enum kd_status tile(const struct kd_scene *scene, struct kd_error *error)
{
    const struct kd_tile *t = &scene->tile;
    if ((t->width > 0) != (t->height > 0))
        return kd_error_field(error, t->width ? "/image/tile/height" : "/image/tile/width",
                              "image.tile.width is %d and image.tile.height %d pixels; both must be above 0, or "
                              "both 0, for the whole picture",
                              t->width, t->height);
    if (!t->width && (t->left || t->top))
        return kd_error_field(error, t->left ? "/image/tile/left" : "/image/tile/top",
                              "image.tile.left is %d and image.tile.top %d pixels; both must be 0 without "
                              "image.tile.width and image.tile.height",
                              t->left, t->top);
    if (t->left + t->width > scene->image.width)
        return kd_error_field(
            error, "/image/tile/width",
            "image.tile.width is %d pixels from column %d; it must be at most %d in a picture of image.width %d",
            t->width, t->left, scene->image.width > t->left ? scene->image.width - t->left : 0, scene->image.width);
    if (t->top + t->height > scene->image.height)
        return kd_error_field(
            error, "/image/tile/height",
            "image.tile.height is %d pixels from row %d; it must be at most %d in a picture of image.height %d",
            t->height, t->top, scene->image.height > t->top ? scene->image.height - t->top : 0, scene->image.height);
    return KD_OK;
}

/* Polarised transfer needs a magnetic field. No other light source is permitted with it, because the polarisation of
 * other sources is not modelled. */
static enum kd_status transfer(const struct kd_scene *scene, struct kd_error *error)
{
    if (scene->polarization.model != KD_POLARIZATION_TRANSFER)
        return KD_OK;
    if (!kd_scene_is_magnetic(scene))
        return kd_error_field(error, "/polarization/model",
                              "polarization.model is \"transfer\", which needs a volume.model with electrons in a "
                              "magnetic field: \"riaf\", \"torus\" or \"grid\"");
    if (scene->volume.electrons == KD_VOLUME_KAPPA && !(scene->volume.kappa >= 3.5 && scene->volume.kappa <= 5))
        return kd_error_field(error, "/volume/kappa",
                              "volume.kappa is %s; with polarization.model \"transfer\" it must be 3.5 to 5, for which "
                              "Faraday rotation is known",
                              show(scene->volume.kappa).text);
    if (!kd_scene_is_radio_alone(scene))
        return kd_error_field(error, "/polarization/model",
                              "polarization.model is \"transfer\", which needs a scene where only the volume shines: "
                              "disk.model and sky.model \"none\", no jets, spots, flash or bodies");
    if (scene->camera.projection == KD_PROJECTION_RING)
        return kd_error_field(error, "/polarization/model",
                              "polarization.model is \"transfer\"; with camera.projection \"ring\", whose picture has "
                              "no upward direction, it must be \"none\"");
    return KD_OK;
}

const struct kd_rule kd_rules[] = {
    { "`spacetime.charge` is at most sqrt(1 - a^2 - 1e-12) with the spin a.", charge },
    { "Unless `spacetime.charge` is 0, `style.ringdown` is 0.", uncharged },
    { "`image.bit_depth` is 8 or 16.", bit_depth, "image", "bit_depth", BITS },
    { "`camera.projection` \"pinhole\", \"equirectangular\" and \"fulldome\" need a finite `camera.r`, \"plane\" and "
      "\"ring\" need `camera.r` \"infinity\".",
      projection },
    { "`camera.centre_alpha` and `camera.centre_beta` aim the plane projection, `camera.yaw_deg` and "
      "`camera.pitch_deg` those from a finite radius; in the other projections they are 0.",
      aim },
    { "`camera.field_uas` corresponds to a width within the range of `camera.field_m`. In a document with both, "
      "`camera.field_uas` counts; `camera.field_m` alone sets `camera.field_uas` to \"none\".",
      field_uas },
    { "`camera.ring_decades_min` is less than `camera.ring_decades_max`.", decades },
    { "`camera.r` is outside the outer horizon, 1 + sqrt(1 - a^2 - Q^2), unless `camera.observer` is \"infall\".",
      horizon },
    { "Each `camera.observer` exists in a region of its own" KD_OBSERVER_PLACES ".", observer },
    { "`camera.velocity_r`, `camera.velocity_theta` and `camera.velocity_phi` make a speed below 1. A falling observer "
      "can reach its position: `camera.infall_from` is at least `camera.r`, without a turning point between them; "
      "`camera.infall_energy` suffices for `camera.r`, and is \"rest\" if `camera.infall_from` is finite.",
      motion },
    { "`camera.velocity_*` and `camera.infall_*` have their defaults unless `camera.observer` is \"velocity\" or "
      "\"infall\" at a finite "
      "`camera.r`.",
      idle_motion },
    { "`motion.proper_time_rate` needs an observer at a finite `camera.r` that stays there (static, zamo), orbits in "
      "the equatorial plane, or falls at constant latitude. A fall is at constant latitude if the hole has no spin, "
      "in the equatorial plane, on the axis, or from rest at infinity. `motion.time_rate` and "
      "`motion.azimuth_rate_deg` are then 0, and `disk.slow_light`, and `volume.slow_light` of a grid, are false for a "
      "falling observer.",
      path },
    { "`camera.stereo` \"pair\" needs a finite `camera.r` and the pinhole projection. `camera.eye_distance` is then "
      "less than `camera.r`, and `camera.observer` exists at both eyes.",
      stereo },
    { "`disk.inner` is at least the ISCO of the spin, if there is a disk or a flash.", inner_edge },
    { "`disk.outer` is larger than the inner edge, if there is a disk or a flash.", outer_edge },
    { "`disk.height` is 0, or at least 1e-5; it is 0 for a disk of particles.", height, "disk", "height", 0,
      LEAST_HEIGHT },
    { "`disk.returning` is \"none\" unless the disk, if there is one, is thin and has the exact flux from the ISCO on: "
      "`disk.model` "
      "\"novikov-thorne\" or \"particles\", `disk.inner` \"isco\", `disk.height` 0; and a^2 + Q^2 is at most "
      "0.999999^2, "
      "for \"reflected\" 0.998^2.",
      returning },
    { "`disk.atmosphere` is \"isotropic\" unless `disk.height` is 0.", atmosphere },
    { "With `disk.band` \"frequency\", `disk.frequency_ghz` is at most 64 k T/h, with the disk's largest colour "
      "temperature T.",
      disk_frequency },
    { "If there is a volume, `volume.outer` is larger than the inner edge, which is at least 1 % outside the horizon, "
      "or 0.05 % for the models at a radio frequency. A torus has its inner edge between the photon orbit and "
      "`volume.torus_radius`, which is outside the ISCO, and an outer edge. With power-law electrons "
      "`volume.gamma_max` is larger than `volume.gamma_min`. `volume.normalise_to_jy` is 0 unless only a volume at a "
      "radio frequency shines, in the plane or pinhole projection, without stereo.",
      volume },
    { "If `jets.brightness` is not 0, `jets.outer` is larger than the inner edge, which is at least 5 % outside the "
      "horizon. If `jets.falloff` is below 0, the light grows by at most 2^60 between the edges.",
      jets },
    { "`spots.N.r` is at least the ISCO of the spin, if the spot's brightness is not 0.", spots },
    { "If `flash.brightness` is not 0: `flash.height` is at least 1.05 times the radius of the horizon, `flash.period` "
      "is 0 or at least 12 times `flash.duration`, and `disk.height` is 0.",
      flash },
    { "If the body's radius is not 0: `bodies.N.r` is at least 5 % outside the horizon, and `bodies.N.motion` exists "
      "there; " KD_OBSERVER_CIRCULAR " orbits have `bodies.N.inclination_deg` 90; `bodies.N.velocity_*` make a speed "
      "of at most 0.999, and are 0 unless the motion is \"velocity\".",
      bodies },
    { "`polarization.model` \"transfer\" needs a scene where only a volume with electrons in a magnetic field shines "
      "(`volume.model` \"riaf\", \"torus\" or \"grid\"), in a projection other than \"ring\". With a kappa "
      "distribution `volume.kappa` is then 3.5 to 5.",
      transfer },
    { "`style.ringdown` is 0 unless `spacetime.spin` is from -0.9999 to 0.9999.", ringdown },
    { "`style.beam_uas` is at most a thousand times the width of the picture in the plane and pinhole projections, and "
      "0 in the others.",
      beam },
    { "`style.colour_bar` needs `style.palette` \"heat\" and `style.tone_map` \"srgb\".", colour_bar },
    { "`image.tile` lies within the picture; its width and height are both above 0, or its four fields are 0.", tile },
    { "`accuracy.steps` is a multiple of 4.", steps, "accuracy", "steps", STEPS, 0 },
};
const size_t kd_rule_count = sizeof kd_rules / sizeof *kd_rules;
