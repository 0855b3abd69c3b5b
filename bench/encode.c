/* Measures the cost of encoding a live frame. Real pictures, with and without dither, are encoded by kerrd's own code
 * for files and live frames. For comparison they are also compressed by libdeflate and ISA-L, at each level, after each
 * PNG filter. Times are processor times of the calling thread, which other programs change little. The least time of
 * --repeat runs counts. With --threads N the program instead measures the wall time of files and live frames on 1 to N
 * threads. Prints one line of JSON; encode.py makes the table. */
#include "base/clock.h"
#include "base/parallel.h"
#include "image/jpeg.h"
#include "image/png.h"
#include "image/png_live.h"
#include "render/render.h"

#include <argp.h>
#include <cJSON.h>
#include <libdeflate.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#ifdef KD_HAVE_ISAL
#include <isa-l/igzip_lib.h>
#endif

static const struct {
    const char *name, *fields[3][2];
    bool noise;
} subjects[] = {
    { .name = "default scene" },
    { .name = "with a sky", .fields = { { "sky.model", "grid" } } },
    { .name = "close, with a sky",
      .fields = { { "camera.r", "12" }, { "sky.model", "grid" }, { "camera.fov_deg", "90" } } },
    { .name = "noise", .noise = true },
};
static const char *const filters[] = { "none", "sub", "up", "average", "paeth" };
enum { FILTERS = sizeof filters / sizeof *filters };

/* One frame, and the buffer for its encoded form. */
struct job {
    uint32_t width, height;
    const uint8_t *pixels;
    uint8_t *rows, *packed;
    size_t filtered, room;
    int filter, level, depth;
    struct libdeflate_compressor *compressor;
    struct kd_png_live *live;
    struct kd_buffer out;
};

static double now_ms(void)
{
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return 1e3 * (double)t.tv_sec + 1e-6 * (double)t.tv_nsec;
}

static int predict(int filter, int left, int up, int corner)
{
    int l = abs(up - corner), u = abs(left - corner), c = abs(left + up - 2 * corner);
    switch (filter) {
    case 1: return left;
    case 2: return up;
    case 3: return (left + up) / 2;
    case 4: return l <= u && l <= c ? left : u <= c ? up : corner;
    default: return 0;
    }
}

/* Inlined, so that each filter has its own loop. Pixels left of the first one and above the first row count as zero. */
static inline __attribute__((always_inline)) void filter_rows(struct job *job, int filter)
{
    size_t stride = 3 * (size_t)job->width;
    static const uint8_t zeros[3 * 32768];
    for (uint32_t y = 0; y < job->height; y++) {
        uint8_t *restrict to = job->rows + y * (stride + 1);
        const uint8_t *restrict row = job->pixels + y * stride, *up = y ? row - stride : zeros;
        *to++ = (uint8_t)filter;
        for (size_t i = 0; i < 3; i++)
            to[i] = (uint8_t)(row[i] - predict(filter, 0, up[i], 0));
        for (size_t i = 3; i < stride; i++)
            to[i] = (uint8_t)(row[i] - predict(filter, row[i - 3], up[i], up[i - 3]));
    }
}

/* not inlined: all callers use one copy of the code */
__attribute__((noinline)) static size_t by_filter(struct job *job)
{
    switch (job->filter) {
    case 0: filter_rows(job, 0); break;
    case 1: filter_rows(job, 1); break;
    case 2: filter_rows(job, 2); break;
    case 3: filter_rows(job, 3); break;
    default: filter_rows(job, 4); break;
    }
    return job->filtered;
}

static size_t by_png(struct job *job)
{
    const struct kd_png_params params = {
        .width = job->width,
        .height = job->height,
        .bit_depth = job->depth,
        .compression = job->level,
        .pixels = job->pixels,
    };
    job->out.size = 0;
    return kd_png_encode(&params, &job->out, NULL) ? 0 : job->out.size;
}

static size_t by_live(struct job *job)
{
    job->out.size = 0;
    return kd_png_live_encode(job->live, job->width, job->height, job->pixels, &job->out, NULL) ? 0 : job->out.size;
}

static size_t by_jpeg(struct job *job) /* Encodes at the JPEG quality `level`. */
{
    job->out.size = 0;
    return kd_jpeg_encode(job->width, job->height, job->pixels, (unsigned)job->level, &job->out, NULL) ? 0
                                                                                                       : job->out.size;
}

static size_t by_libdeflate(struct job *job)
{
    by_filter(job);
    return libdeflate_zlib_compress(job->compressor, job->rows, job->filtered, job->packed, job->room);
}

#ifdef KD_HAVE_ISAL
static size_t by_isal(struct job *job)
{
    static const uint32_t sizes[] = { 0, ISAL_DEF_LVL1_DEFAULT, ISAL_DEF_LVL2_DEFAULT, ISAL_DEF_LVL3_DEFAULT };
    static uint8_t
        memory[ISAL_DEF_LVL3_DEFAULT > ISAL_DEF_LVL2_DEFAULT ? ISAL_DEF_LVL3_DEFAULT : ISAL_DEF_LVL2_DEFAULT];
    static struct isal_zstream stream;
    by_filter(job);
    isal_deflate_init(&stream);
    stream.level = (uint32_t)job->level;
    stream.level_buf = memory;
    stream.level_buf_size = sizes[job->level];
    stream.gzip_flag = IGZIP_ZLIB;
    stream.end_of_stream = 1;
    stream.next_in = job->rows;
    stream.avail_in = (uint32_t)job->filtered;
    stream.next_out = job->packed;
    stream.avail_out = (uint32_t)job->room;
    isal_deflate(&stream);
    return stream.internal_state.state == ZSTATE_END ? stream.total_out : 0;
}
#endif

static void row(cJSON *rows, struct job *job, size_t (*work)(struct job *), const char *name, int repeat)
{
    double best = INFINITY;
    size_t bytes = 0;
    for (int i = 0; i < repeat; i++) {
        double start = now_ms();
        bytes = work(job);
        best = fmin(best, now_ms() - start);
    }
    if (!bytes) {
        fprintf(stderr, "kd_bench_encode: %s failed\n", name);
        exit(1);
    }
    cJSON *r = cJSON_CreateObject();
    cJSON_AddStringToObject(r, "encoder", name);
    cJSON_AddNumberToObject(r, "level", job->level);
    cJSON_AddStringToObject(r, "filter", filters[job->filter]);
    cJSON_AddNumberToObject(r, "ms", best);
    cJSON_AddNumberToObject(r, "bytes", (double)bytes);
    cJSON_AddItemToArray(rows, r);
}

static void measure(struct job *job, cJSON *rows, int repeat)
{
    job->filter = 1; /* the filter that kd_png_encode chooses at level 1 */
    job->level = 1;
    row(rows, job, by_png, "file", repeat);
    for (enum kd_deflate_engine e = 0; e < KD_DEFLATE_COUNT; e++) {
        if (kd_png_live_create(e, &job->live, NULL))
            continue;
        char name[32];
        snprintf(name, sizeof name, "live, %s", kd_deflate_name(e));
        row(rows, job, by_live, name, repeat);
        kd_png_live_destroy(job->live);
    }
    for (job->filter = 0; job->filter < FILTERS; job->filter++) {
        job->level = 0;
        row(rows, job, by_filter, "filter alone", repeat);
        for (job->level = 0; job->level <= 3; job->level++) {
            job->compressor = libdeflate_alloc_compressor(job->level);
            row(rows, job, by_libdeflate, "libdeflate", repeat);
            libdeflate_free_compressor(job->compressor);
        }
#ifdef KD_HAVE_ISAL
        for (job->level = 0; job->level <= 2; job->level++)
            row(rows, job, by_isal, "isa-l", repeat);
#endif
    }
}

static void one_picture(const char *name, bool dither, const struct kd_frame *frame, int repeat, cJSON *pictures)
{
    uint32_t width = frame->width, height = frame->height;
    struct job job = { .width = width,
                       .height = height,
                       .depth = 8,
                       .pixels = kd_frame_pixels(frame),
                       .filtered = (3 * (size_t)width + 1) * height };
    job.room = 2 * job.filtered + 65536;
    job.rows = malloc(job.filtered);
    job.packed = malloc(job.room);
    cJSON *picture = cJSON_CreateObject();
    cJSON_AddStringToObject(picture, "picture", name);
    cJSON_AddBoolToObject(picture, "dither", dither);
    cJSON_AddNumberToObject(picture, "width", width);
    cJSON_AddNumberToObject(picture, "height", height);
    if (job.rows && job.packed)
        measure(&job, cJSON_AddArrayToObject(picture, "rows"), repeat);
    cJSON_AddItemToArray(pictures, picture);
    kd_buffer_finish(&job.out);
    free(job.rows);
    free(job.packed);
}

/* Measures the least wall time. */
static void timed(cJSON *rows, struct job *job, size_t (*work)(struct job *), const char *name, int repeat)
{
    double best = INFINITY;
    size_t bytes = 0;
    for (int i = 0; i < repeat; i++) {
        const double start = kd_clock_ms();
        bytes = work(job);
        best = fmin(best, kd_clock_ms() - start);
    }
    cJSON *r = cJSON_CreateObject();
    cJSON_AddStringToObject(r, "encoder", name);
    cJSON_AddNumberToObject(r, "depth", job->depth);
    cJSON_AddNumberToObject(r, "level", job->level);
    cJSON_AddNumberToObject(r, "height", job->height);
    cJSON_AddNumberToObject(r, "threads", kd_parallel_threads);
    cJSON_AddNumberToObject(r, "ms", best);
    cJSON_AddNumberToObject(r, "bytes", (double)bytes);
    cJSON_AddItemToArray(rows, r);
}

/* Measures files at both levels that kerrd writes, and the encodings of live views. */
static void on_threads(const struct kd_frame *frame, int repeat, cJSON *rows)
{
    struct job job = { .width = frame->width,
                       .height = frame->height,
                       .pixels = kd_frame_pixels(frame),
                       .depth = kd_frame_bit_depth(frame) };
    for (job.level = 1; job.level <= 5; job.level += 4)
        timed(rows, &job, by_png, "PNG", repeat);
    job.level = 1;
    if (job.depth == 8 && !kd_png_live_create(kd_deflate_fastest(), &job.live, NULL))
        timed(rows, &job, by_live, "live PNG", repeat);
    kd_png_live_destroy(job.live);
    for (job.level = 75; job.depth == 8 && job.level <= 90; job.level += 15)
        timed(rows, &job, by_jpeg, "JPEG", repeat);
    kd_buffer_finish(&job.out);
}

/* The default scene at 1280 x 720 and 3840 x 2160, of 8 and 16 bits. */
static enum kd_status by_threads(struct kd_renderer *renderer, unsigned most, int repeat, cJSON *rows,
                                 struct kd_error *error)
{
    enum kd_status status = KD_OK;
    struct kd_capacity capacity;
    kd_renderer_capacity(renderer, &capacity);
    for (int k = 0; k < 4 && !status; k++) {
        struct kd_scene scene;
        struct kd_plan plan;
        struct kd_frame frame;
        kd_scene_defaults(&scene);
        scene.image.height = k < 2 ? 720 : 2160;
        scene.image.width = scene.image.height * 16 / 9;
        scene.image.bit_depth = k % 2 ? 16 : 8;
        KD_TRY(kd_plan_make(&scene, &capacity, &plan, error));
        KD_TRY(kd_render(renderer, &scene, &plan, NULL, NULL, &frame, error));
        for (kd_parallel_threads = 1; kd_parallel_threads <= most; kd_parallel_threads *= 2)
            on_threads(&frame, repeat, rows);
        kd_frame_finish(&frame);
    }
done:
    return status;
}

static enum kd_status one_subject(struct kd_renderer *renderer, size_t subject, bool dither, int height, int repeat,
                                  cJSON *pictures, struct kd_error *error)
{
    struct kd_scene scene;
    struct kd_capacity capacity;
    struct kd_plan plan;
    struct kd_frame frame;
    kd_scene_smooth(&scene);
    scene.image.width = height * 16 / 9;
    scene.image.height = height;
    scene.style.dither = dither;
    enum kd_status status = KD_OK;
    for (size_t i = 0; i < 3 && subjects[subject].fields[i][0] && !status; i++)
        status = kd_scene_set(&scene, subjects[subject].fields[i][0], subjects[subject].fields[i][1], error);
    kd_renderer_capacity(renderer, &capacity);
    if (!status)
        status = kd_plan_make(&scene, &capacity, &plan, error);
    if (!status)
        status = kd_render(renderer, &scene, &plan, NULL, NULL, &frame, error);
    if (status)
        return status;
    for (size_t i = 0; subjects[subject].noise && i < 3 * (size_t)frame.width * frame.height; i++)
        ((uint8_t *)kd_frame_pixels(&frame))[i] = (uint8_t)(random() >> 8);
    one_picture(subjects[subject].name, dither, &frame, repeat, pictures);
    kd_frame_finish(&frame);
    return KD_OK;
}

struct options {
    const char *device;
    int repeat, threads;
};

static error_t option(int key, char *text, struct argp_state *state)
{
    struct options *o = state->input;
    switch (key) {
    case 'd': o->device = text; return 0;
    case 'r': o->repeat = atoi(text); return 0;
    case 't': o->threads = atoi(text); return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

int main(int argc, char **argv)
{
    static const struct argp_option table[] = {
        { "device", 'd', "DEVICE", 0, "auto, an index or part of a name", 0 },
        { "repeat", 'r', "N", 0, "times that each encoder gets each picture (9)", 0 },
        { "threads", 't', "N", 0, "what files take on 1, 2, 4 ... N threads, and nothing else", 0 },
        { 0 },
    };
    struct options o = { "auto", 9, 0 };
    struct argp parser = { table, option, NULL, "What encoding a live frame costs.", NULL, NULL, NULL };
    argp_parse(&parser, argc, argv, 0, NULL, &o);

    struct kd_error error = { 0 };
    struct kd_renderer *renderer;
    enum kd_status status =
        kd_renderer_create(&(struct kd_renderer_params) { .device = o.device, .passing = true }, &renderer, &error);
    cJSON *root = cJSON_CreateObject(), *pictures = cJSON_AddArrayToObject(root, "pictures");
    if (!status)
        cJSON_AddStringToObject(root, "device", kd_renderer_device_name(renderer));
    if (!status && o.threads > 0)
        status = by_threads(renderer, (unsigned)o.threads, o.repeat, cJSON_AddArrayToObject(root, "threads"), &error);
    kd_parallel_threads = 1;
    for (int height = 360; height <= 720 && !status && !o.threads; height += 360)
        for (size_t i = 0; i < sizeof subjects / sizeof *subjects; i++)
            for (int dither = 1; dither >= subjects[i].noise && !status; dither--)
                status = one_subject(renderer, i, dither, height, o.repeat, pictures, &error);
    char *text = cJSON_PrintUnformatted(root);
    if (status)
        fprintf(stderr, "kd_bench_encode: %s\n", error.message);
    else if (text)
        puts(text);
    cJSON_free(text);
    cJSON_Delete(root);
    if (renderer)
        kd_renderer_destroy(renderer);
    return status != KD_OK;
}
