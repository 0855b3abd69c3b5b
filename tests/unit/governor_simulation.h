/* Simulates a session with a governor, on a machine whose costs are formulas. The simulation gives the times of
 * requests, the cost of each frame, and the chosen quality. */
#ifndef KD_TESTS_GOVERNOR_SIMULATION_H
#define KD_TESTS_GOVERNOR_SIMULATION_H

#include "render/live/governor.h"

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static uint64_t seed = 1;
static double uniform(void) /* in [0, 1) */
{
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(seed >> 11) * 0x1p-53;
}

struct simulation;

/* Cost of a frame of this scene on the machine. */
typedef struct kd_frame_cost machine(const struct simulation *s, const struct kd_scene *scene, bool reused);

/* A machine whose frames have a cost by rays, a cost by pixels and a fixed cost, with noise and spikes. */
struct truth {
    /* ms of a full-size frame: for tracing its rays; for reusing their lens map; for its pixels */
    double traced, reused, pixels;
    double fixed, hidden; /* ms of a frame at any size: a part that frames report, and a part that they do not report */
    double noise;         /* largest deviation relative to the time, uniformly distributed */
    double spikes, spike; /* rate of spikes, and the factor by which a spike lengthens a frame */
    bool silent;          /* true: frames report only their total time */
};

struct simulation {
    struct kd_governor governor;
    struct kd_scene asked;
    struct truth truth;
    machine *cost;
    double now;
    /* changes: number of changes of rung, over both kinds of frames; climbs: number of those upwards */
    uint64_t frames, changes, climbs;
    double last_change, sum, load, least_pause; /* least_pause: shortest time between a change and the next climb */
    uint64_t summed;
    uint32_t lens;             /* number of the scene's current lens map; a change that needs a new map increases it */
    uint32_t kept[4][3], next; /* cached lens maps: number of the map, width, samples */
    struct kd_quality last;    /* quality of the last frame rendered */
    bool forgets;              /* true: lens maps are never cached */
};

static double rays_of(const struct kd_scene *scene)
{
    return (double)scene->image.width * scene->image.height * scene->image.samples * scene->image.samples;
}

/* The true cost of orders and profiles differs here from what ray_cost() in quality.c assumes. */
static double ray_weight(const struct kd_scene *scene)
{
    static const double profile[] = { 0.9, 0.95, 1, 1.1, 9 };
    return profile[scene->accuracy.profile] * (5 + scene->accuracy.orders);
}

static inline struct kd_frame_cost truthful(const struct simulation *s, const struct kd_scene *scene, bool reused)
{
    const struct truth *t = &s->truth;
    double rays = rays_of(scene) / rays_of(&s->asked), pixels = rays * s->asked.image.samples * s->asked.image.samples /
                                                                (scene->image.samples * scene->image.samples);
    rays *= ray_weight(scene) / ray_weight(&s->asked);
    struct kd_frame_cost c = { .fixed_ms = t->fixed,
                               .rays_ms = rays * (reused ? t->reused : t->traced),
                               .pixels_ms = pixels * t->pixels };
    double factor = s->load * (1 + t->noise * (2 * uniform() - 1)) * (uniform() < t->spikes ? t->spike : 1);
    c.fixed_ms *= factor;
    c.rays_ms *= factor;
    c.pixels_ms *= factor;
    c.total_ms = c.fixed_ms + c.rays_ms + c.pixels_ms + factor * t->hidden;
    if (t->silent)
        c.fixed_ms = c.rays_ms = c.pixels_ms = 0;
    return c;
}

/* Models the renderer's cache, which holds the last four lens maps. */
static bool lens_kept(struct simulation *s, const struct kd_scene *scene)
{
    uint32_t key[3] = { s->lens, (uint32_t)scene->image.width, (uint32_t)scene->image.samples };
    for (int i = 0; i < 4 && !s->forgets; i++)
        if (memcmp(s->kept[i], key, sizeof key) == 0)
            return true;
    memcpy(s->kept[s->next++ % 4], key, sizeof key);
    return false;
}

static inline void begin(struct simulation *s, const struct kd_governor_params *params, int width, int height,
                         struct truth truth)
{
    *s = (struct simulation) { .truth = truth, .cost = truthful, .load = 1, .least_pause = INFINITY };
    kd_scene_smooth(&s->asked);
    s->asked.image.width = width;
    s->asked.image.height = height;
    kd_governor_init(&s->governor, params);
}

static inline void change(struct simulation *s, bool lens)
{
    s->lens += lens;
    kd_governor_changed(&s->governor, s->now, &s->asked, lens);
}

/* Renders the frame that the governor requests, if any. Returns true if there was one. */
static inline bool frame(struct simulation *s)
{
    struct kd_frame_decision turn = kd_governor_decide(&s->governor, s->now);
    if (turn.wait_ms > 0)
        return false;
    struct kd_scene scene;
    kd_quality_apply(&turn.quality, &s->asked, &scene);
    bool reused = lens_kept(s, &scene);
    struct kd_frame_cost c = s->cost(s, &scene, reused);
    c.lens_reused = reused;
    struct kd_pace before[2] = { s->governor.paces[0], s->governor.paces[1] };
    s->now += c.total_ms;
    kd_governor_frame(&s->governor, s->now, &turn, &c);
    for (int i = 0; i < 2; i++) {
        uint32_t after = s->governor.paces[i].rung;
        s->climbs += after < before[i].rung;
        s->changes += after != before[i].rung;
        if (after != before[i].rung)
            s->last_change = s->now;
        if (after < before[i].rung)
            s->least_pause = fmin(s->least_pause, s->now - before[i].changed_at);
    }
    s->frames++;
    s->sum += c.total_ms;
    s->summed++;
    s->last = turn.quality;
    return true;
}

/* The scene changes before each frame, at most 60 times a second; `lens` determines the kind of change. */
enum pattern { PLAY, DRAG, BOTH_IN_TURN, AT_RANDOM, DRAG_IN_BURSTS, PATTERNS };

static bool moves_lens(const struct simulation *s, enum pattern pattern)
{
    switch (pattern) {
    case PLAY: return false;
    case DRAG: return true;
    case BOTH_IN_TURN: return s->frames % 2;
    case AT_RANDOM: return uniform() < 0.1;
    default: return fmod(s->now, 1500) < 500;
    }
}

static inline uint32_t rung_of(const struct simulation *s, enum pattern pattern)
{
    return s->governor.paces[pattern != PLAY].rung;
}

static inline void run(struct simulation *s, enum pattern pattern, double ms)
{
    for (double end = s->now + ms; s->now < end;) {
        double start = s->now;
        change(s, s->lens == 0 || moves_lens(s, pattern));
        frame(s);
        s->now = fmax(s->now, start + 1000.0 / 60);
    }
}

static inline double mean_over(struct simulation *s, enum pattern pattern, double ms)
{
    s->sum = 0;
    s->summed = 0;
    run(s, pattern, ms);
    return s->sum / (double)s->summed;
}

/* True cost of a frame on a rung, without noise. */
static inline double true_cost(const struct simulation *s, uint32_t rung, bool reused)
{
    struct simulation quiet = *s;
    struct kd_scene scene;
    quiet.truth.noise = quiet.truth.spikes = 0;
    kd_quality_apply(&s->governor.ladder.rungs[rung].quality, &s->asked, &scene);
    return truthful(&quiet, &scene, reused).total_ms;
}

static inline struct truth some_truth(void)
{
    double all = exp(log(3) + uniform() * log(1000)); /* ms of a full-size frame: from 3 ms to 3 s */
    double fixed = uniform() < 0.5 ? 0 : exp(7 * uniform()), hidden = uniform() < 0.5 ? 0 : 30 * uniform() * uniform();
    double rays = all * (0.3 + 0.6 * uniform());
    return (struct truth) { .traced = rays,
                            .reused = rays * (0.05 + 0.5 * uniform()),
                            .pixels = all - rays,
                            .fixed = fixed,
                            .hidden = hidden };
}

/* Time that frames with a fixed part may take: at most the target, if that leaves half of it for the picture. */
static inline double may_take(double target, double fixed)
{
    double picture = fmax(target / 2, fixed / 4);
    return fixed + picture > target ? fixed + picture : target;
}

#endif
