#include "render/plan.h"


#include <math.h>
#include <string.h>

/* Steps of the integrator a half period, by profile; docs/accuracy.md has the errors that go with them. */
static const uint32_t profile_steps[] = {
    [KD_PROFILE_DRAFT] = 4,
    [KD_PROFILE_INTERACTIVE] = 4,
    [KD_PROFILE_BALANCED] = 8,
    [KD_PROFILE_HIGH] = 16,
};

static void say(struct kd_plan *plan, bool condition, const char *sentence)
{
    if (condition && plan->n_approximations < KD_PLAN_MAX_APPROXIMATIONS)
        plan->approximations[plan->n_approximations++] = sentence;
}

static void approximations(struct kd_plan *plan, const struct kd_scene *scene)
{
    const struct kd_disk *d = &scene->disk;
    bool disk = d->model != KD_DISK_NONE;
    say(plan, disk, "disk: geometrically thin, in the equatorial plane, gas on circular Kerr orbits that ends at the inner edge");
    say(plan, disk, "disk: each element shines as an isotropic black body; no limb darkening, no irradiation by returning light");
    say(plan, disk && d->model == KD_DISK_SHAKURA_SUNYAEV,
        "disk: Newtonian thin-disk flux cut at the ISCO instead of the Page-Thorne integral");
    say(plan, disk && d->colour == KD_COLOUR_PEAK,
        "disk: the peak temperature is chosen to be seen, not computed from a mass and an accretion rate");
    say(plan, disk && d->band == KD_BAND_BOLOMETRIC,
        "disk: brightness is bolometric (g^4), colour is that of the visible part of the spectrum");
    say(plan, disk && !d->doppler, "disk: Doppler shift and beaming of the gas are switched off");
    say(plan, disk && !d->redshift, "disk: gravitational redshift and time dilation of the gas are switched off");
    say(plan, disk && d->taper > 0, "disk: the outer edge fades out over a chosen range");
    say(plan, disk && d->opacity < 1, "disk: opacity is a chosen number a crossing, not computed from the gas");
    say(plan, disk, "disk: image orders beyond accuracy.orders are left out");
    say(plan, disk, "colour: black bodies outside the sRGB gamut are moved to its edge at equal luminance");
    say(plan, plan->sky, "sky: a drawn celestial grid; its lensing is exact, its brightness carries no redshift");
    say(plan, scene->style.tone_map == KD_TONE_ACES, "post: a film-like tone curve; pixel values are not proportional to radiance");
    say(plan, true, "arithmetic: 32-bit; rays closer than about 1e-5 to the critical curve may be given the wrong fate");
}

/* What the lens map depends on, as a scene with all else at its default: its hash is the key of the cache. */
static enum kd_status lens_key(struct kd_plan *plan, const struct kd_scene *scene)
{
    struct kd_scene key;
    kd_scene_defaults(&key);
    key.spacetime.spin = scene->spacetime.spin;
    key.camera = scene->camera;
    key.camera.azimuth_deg = 0; /* adds a constant to every azimuth: transfer does that */
    key.image = scene->image;
    key.image.bit_depth = 8;
    key.accuracy = scene->accuracy;
    if (plan->radius_only)
        key.accuracy.profile = KD_PROFILE_BALANCED; /* the closed form has no steps */
    key.sky.model = plan->sky ? KD_SKY_GRID : KD_SKY_NONE;
    return kd_scene_hash(&key, plan->lens_key);
}

static void add_pass(struct kd_plan *plan, const char *name, const char *kernel, uint64_t n, double ns)
{
    plan->passes[plan->n_passes++] = (struct kd_plan_pass){ name, kernel, n, (double)n * ns * 1e-6 };
    plan->estimate_ms += (double)n * ns * 1e-6;
}

static void passes(struct kd_plan *plan, const struct kd_scene *scene, const struct kd_capacity *c)
{
    uint64_t pixels = (uint64_t)plan->width * plan->height;
    if (plan->planes)
        add_pass(plan, "trace", plan->radius_only ? "lens_radius.comp" : "lens_map.comp", plan->rays,
                 plan->radius_only ? c->ns_per_ray_radius : c->ns_per_ray_full);
    if (plan->audit)
        add_pass(plan, "audit", "rays.comp", KD_AUDIT_RAYS, 20 * c->ns_per_ray_full);
    add_pass(plan, "transfer", "transfer.comp", plan->rays, c->ns_per_sample_transfer);
    if (isinf(scene->style.exposure))
        add_pass(plan, "expose", "expose.comp", pixels, 0.25 * c->ns_per_pixel_post);
    add_pass(plan, "post", "post.comp", pixels, c->ns_per_pixel_post);
    add_pass(plan, "readback", "", pixels, 0.1 * c->ns_per_pixel_post);
}

/* Rows of pixels whose lens map, radiance and packed pixels each fit one binding. */
static enum kd_status bands(struct kd_plan *plan, const struct kd_scene *scene, const struct kd_capacity *c,
                            struct kd_error *error)
{
    uint64_t row_lens = 4ull * plan->planes * plan->width * plan->side * plan->side;
    uint64_t row_light = 12ull * plan->width, row_out = (scene->image.bit_depth == 16 ? 6ull : 3ull) * plan->width;
    uint64_t widest = row_lens > row_light ? row_lens : row_light;
    uint64_t rows = (c->max_binding_bytes - 64) / widest;
    if (rows < 1)
        return kd_error_set(error, KD_ETOOBIG, "one row of the picture needs %llu bytes, this device binds %llu at once",
                            (unsigned long long)widest, (unsigned long long)c->max_binding_bytes);
    if (rows > 65535 / plan->side)
        rows = 65535 / plan->side;
    plan->band_rows = (uint32_t)(rows < plan->height ? rows : plan->height);
    plan->bands = (plan->height + plan->band_rows - 1) / plan->band_rows;
    plan->lens_bytes = row_lens * plan->height;
    plan->host_bytes = row_out * plan->height;
    uint64_t fixed = row_light * plan->height + 2 * (row_out * plan->band_rows + 64) + (1 << 20);
    uint64_t one_band = row_lens * plan->band_rows;
    plan->cacheable = fixed + plan->lens_bytes <= c->memory_bytes;
    plan->device_bytes = fixed + (plan->cacheable ? plan->lens_bytes : one_band);
    if (plan->device_bytes > c->memory_bytes)
        return kd_error_set(error, KD_ETOOBIG,
                            "the picture needs %.1f GiB of device memory, %.1f GiB are allowed: lower image.width, "
                            "image.height or image.samples",
                            (double)plan->device_bytes / (1 << 30), (double)c->memory_bytes / (1 << 30));
    return KD_OK;
}

enum kd_status kd_plan_make_for(const struct kd_scene *scene, const struct kd_needs *needs,
                                const struct kd_capacity *capacity, struct kd_plan *out, struct kd_error *error)
{
    struct kd_plan plan = { 0 };
    plan.width = (uint32_t)scene->image.width;
    plan.height = (uint32_t)scene->image.height;
    plan.side = (uint32_t)scene->image.samples;
    plan.rays = (uint64_t)plan.width * plan.height * plan.side * plan.side;
    plan.phi = needs->phi;
    plan.sky = needs->sky;
    plan.radius_only = isinf(scene->camera.r) && !plan.phi && !plan.sky && !needs->integrate;
    /* Without a disk a ray still passes from crossing to crossing in long strides before it escapes. */
    plan.orders = needs->disk || needs->phi || needs->sky ? (uint32_t)scene->accuracy.orders : 0;
    plan.steps = plan.radius_only ? 0 : needs->steps ? needs->steps : profile_steps[scene->accuracy.profile];
    plan.planes = plan.orders + (plan.phi ? plan.orders : 0) + (plan.sky ? 3 : 0);
    plan.measured = capacity->measured;

    enum kd_status status = bands(&plan, scene, capacity, error);
    if (status)
        return status;
    plan.audit = plan.cacheable && plan.orders && capacity->float64;
    passes(&plan, scene, capacity);
    approximations(&plan, scene);
    if (lens_key(&plan, scene))
        return kd_error_set(error, KD_ENOMEM, "out of memory while hashing the scene");
    *out = plan;
    return KD_OK;
}

enum kd_status kd_plan_make(const struct kd_scene *scene, const struct kd_capacity *capacity, struct kd_plan *out,
                            struct kd_error *error)
{
    struct kd_needs needs = {
        .disk = scene->disk.model != KD_DISK_NONE,
        .sky = scene->sky.model != KD_SKY_NONE && scene->sky.brightness > 0,
    };
    return kd_plan_make_for(scene, &needs, capacity, out, error);
}
