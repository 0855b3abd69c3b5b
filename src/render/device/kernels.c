#include "render/device/kernels.h"

#include "render/emit/emission.h"
#include "render/view/layout.h"

#include "beam_blur.spv.h"
#include "beam_blur_texels.spv.h"
#include "beam_gather.spv.h"
#include "beam_gather_texels.spv.h"
#include "beam_spline.spv.h"
#include "beam_spline_texels.spv.h"
#include "beam_spread.spv.h"
#include "beam_spread_texels.spv.h"
#include "between.spv.h"
#include "bloom_bright.spv.h"
#include "bloom_bright_texels.spv.h"
#include "bloom_down.spv.h"
#include "bloom_down_texels.spv.h"
#include "bloom_gather.spv.h"
#include "bloom_gather_texels.spv.h"
#include "bloom_up.spv.h"
#include "bloom_up_texels.spv.h"
#include "expose.spv.h"
#include "footprint.spv.h"
#include "footprint_texels.spv.h"
#include "layers.spv.h"
#include "layers_march.spv.h"
#include "lens_cells.spv.h"
#include "lens_closed.spv.h"
#include "lens_fill.spv.h"
#include "lens_fill_texels.spv.h"
#include "lens_map.spv.h"
#include "photometry.spv.h"
#include "post.spv.h"
#include "post_bloom.spv.h"
#include "post_bloom_heat.spv.h"
#include "post_bloom_heat_texels.spv.h"
#include "post_bloom_texels.spv.h"
#include "post_heat.spv.h"
#include "post_heat_texels.spv.h"
#include "post_texels.spv.h"
#include "rays.spv.h"
#include "rays_f64.spv.h"
#include "rays_kerr_schild.spv.h"
#include "rays_kerr_schild_f64.spv.h"
#include "rays_f64_trace.spv.h"
#include "rays_kerr_schild_f64_trace.spv.h"
#include "rays_kerr_schild_trace.spv.h"
#include "rays_trace.spv.h"
#include "settle.spv.h"
#include "star_images.spv.h"
#include "star_images_texels.spv.h"
#include "star_search.spv.h"
#include "star_search_texels.spv.h"
#include "star_tiles.spv.h"
#include "star_tiles_texels.spv.h"
#include "transfer.spv.h"
#include "transfer_march.spv.h"
#include "transfer_march_pieces.spv.h"
#include "transfer_march_probe.spv.h"
#include "transfer_probe.spv.h"
#include "transfer_texels.spv.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { MAKERS = 4 }; /* largest number of threads that make kernels concurrently */

#define KD_STORED_words 1
#define KD_STORED_pairs 1
#define KD_STORED_floats 1
#define KD_STORED_stored 1
#define KD_STORED_quads 1
#define KD_STORED_quad_texels 0
#define KD_B(number, type, member) +KD_STORED_##type
_Static_assert(KD_OWN_BINDING + KD_OWN_COUNT <= KD_VK_MAX_BINDINGS && 2 + (0 KD_EMIT_BUFFERS) <= KD_VK_MAX_STORAGE,
               "the kernels of light bind all buffers of the emitters, the lens map and the kernels' output");

#undef KD_B

/* Texel type of each kind of the emitters' buffers, for kernels that read them as texels
 * (shaders/light/inputs.glsl). */
#define KD_KIND_words KD_VK_TEXELS_WORD
#define KD_KIND_pairs KD_VK_TEXELS_PAIR
#define KD_KIND_floats KD_VK_TEXELS_R
#define KD_KIND_stored KD_VK_STORAGE
#define KD_KIND_quads KD_VK_STORAGE
#define KD_KIND_quad_texels KD_VK_TEXELS_QUAD
/* Bindings of a light kernel that reads its data as storage buffers where that is possible. */
#define STORED_KINDS \
    { [1] = KD_VK_UNIFORM, \
      [2] = KD_VK_TEXELS_RGBA, \
      [4] = KD_VK_UNIFORM, \
      [KD_OWN_BINDING + KD_OWN_plasma_texels] = KD_VK_TEXELS_QUAD }
#define KD_B(number, type, member) [KD_OWN_BINDING + (number)] = KD_KIND_##type,

static const struct kd_vk_pipeline_params sources[] = {
    [KD_KERNEL_LENS_CLOSED] = { "lens_closed",
                                kd_spv_lens_closed,
                                sizeof kd_spv_lens_closed,
                                4,
                                sizeof(struct kd_slice),
                                { [2] = KD_VK_UNIFORM } },
    [KD_KERNEL_LENS_MAP] = { "lens_map",
                             kd_spv_lens_map,
                             sizeof kd_spv_lens_map,
                             4,
                             sizeof(struct kd_slice),
                             { [2] = KD_VK_UNIFORM } },
    [KD_KERNEL_FOOTPRINT] = { "footprint", kd_spv_footprint, sizeof kd_spv_footprint, 2,
                              sizeof(struct kd_footprint_push) },
    [KD_KERNEL_FOOTPRINT_TEXELS] = { "footprint, texels",
                                     kd_spv_footprint_texels,
                                     sizeof kd_spv_footprint_texels,
                                     3,
                                     sizeof(struct kd_footprint_push),
                                     { [2] = KD_VK_TEXELS_R } },
    [KD_KERNEL_LENS_CELLS] = { "lens cells",
                               kd_spv_lens_cells,
                               sizeof kd_spv_lens_cells,
                               4,
                               sizeof(struct kd_sample_push),
                               { [3] = KD_VK_UNIFORM } },
    [KD_KERNEL_LENS_FILL] = { "lens fill",
                              kd_spv_lens_fill,
                              sizeof kd_spv_lens_fill,
                              5,
                              sizeof(struct kd_sample_push),
                              { [3] = KD_VK_UNIFORM } },
    [KD_KERNEL_LENS_FILL_TEXELS] = { "lens fill, texels",
                                     kd_spv_lens_fill_texels,
                                     sizeof kd_spv_lens_fill_texels,
                                     5,
                                     sizeof(struct kd_sample_push),
                                     { [1] = KD_VK_TEXELS_WORD, [2] = KD_VK_TEXELS_R, [3] = KD_VK_UNIFORM } },
    [KD_KERNEL_BETWEEN] = { "between", kd_spv_between, sizeof kd_spv_between, 2, sizeof(struct kd_between_push) },
    [KD_KERNEL_SETTLE] = { "settle", kd_spv_settle, sizeof kd_spv_settle, 2, 12 },
    [KD_KERNEL_RAYS_F32] = { "rays", kd_spv_rays, sizeof kd_spv_rays, 2, 8 },
    [KD_KERNEL_RAYS_F64] = { "rays f64", kd_spv_rays_f64, sizeof kd_spv_rays_f64, 2, 8 },
    [KD_KERNEL_RAYS_KS_F32] = { "rays Kerr-Schild", kd_spv_rays_kerr_schild, sizeof kd_spv_rays_kerr_schild, 2, 8 },
    [KD_KERNEL_RAYS_KS_F64] = { "rays Kerr-Schild f64", kd_spv_rays_kerr_schild_f64, sizeof kd_spv_rays_kerr_schild_f64,
                                2, 8 },
    [KD_KERNEL_RAYS_TRACE_F32] = { "rays, told", kd_spv_rays_trace, sizeof kd_spv_rays_trace, 3, 8 },
    [KD_KERNEL_RAYS_TRACE_F64] = { "rays f64, told", kd_spv_rays_f64_trace, sizeof kd_spv_rays_f64_trace, 3, 8 },
    [KD_KERNEL_RAYS_KS_TRACE_F32] = { "rays Kerr-Schild, told", kd_spv_rays_kerr_schild_trace,
                                      sizeof kd_spv_rays_kerr_schild_trace, 3, 8 },
    [KD_KERNEL_RAYS_KS_TRACE_F64] = { "rays Kerr-Schild f64, told", kd_spv_rays_kerr_schild_f64_trace,
                                      sizeof kd_spv_rays_kerr_schild_f64_trace, 3, 8 },
    [KD_KERNEL_STAR_TILES] = { "star tiles",
                               kd_spv_star_tiles,
                               sizeof kd_spv_star_tiles,
                               11,
                               sizeof(struct kd_stars_push),
                               { [1] = KD_VK_UNIFORM, [2] = KD_VK_TEXELS_RGBA, [8] = KD_VK_UNIFORM } },
    [KD_KERNEL_STAR_TILES_TEXELS] = { "star tiles, texels",
                                      kd_spv_star_tiles_texels,
                                      sizeof kd_spv_star_tiles_texels,
                                      11,
                                      sizeof(struct kd_stars_push),
                                      { KD_VK_TEXELS_R, [1] = KD_VK_UNIFORM, [2] = KD_VK_TEXELS_RGBA,
                                        [4] = KD_VK_TEXELS_RGBA, [5] = KD_VK_TEXELS_WORD, [8] = KD_VK_UNIFORM } },
    [KD_KERNEL_STAR_SEARCH] = { "star search",
                                kd_spv_star_search,
                                sizeof kd_spv_star_search,
                                9,
                                sizeof(struct kd_stars_push),
                                { [1] = KD_VK_UNIFORM, [2] = KD_VK_TEXELS_RGBA, [8] = KD_VK_UNIFORM } },
    [KD_KERNEL_STAR_SEARCH_TEXELS] = { "star search, texels",
                                       kd_spv_star_search_texels,
                                       sizeof kd_spv_star_search_texels,
                                       9,
                                       sizeof(struct kd_stars_push),
                                       { KD_VK_TEXELS_R, [1] = KD_VK_UNIFORM, [2] = KD_VK_TEXELS_RGBA,
                                         [4] = KD_VK_TEXELS_RGBA, [5] = KD_VK_TEXELS_WORD, [8] = KD_VK_UNIFORM } },
    [KD_KERNEL_STAR_IMAGES] = { "star images",
                                kd_spv_star_images,
                                sizeof kd_spv_star_images,
                                8,
                                sizeof(struct kd_stars_push),
                                { [1] = KD_VK_UNIFORM, [2] = KD_VK_TEXELS_RGBA, [5] = KD_VK_UNIFORM } },
    [KD_KERNEL_STAR_IMAGES_TEXELS] = { "star images, texels",
                                       kd_spv_star_images_texels,
                                       sizeof kd_spv_star_images_texels,
                                       8,
                                       sizeof(struct kd_stars_push),
                                       { KD_VK_TEXELS_R, [1] = KD_VK_UNIFORM, [2] = KD_VK_TEXELS_RGBA,
                                         [5] = KD_VK_UNIFORM } },
    [KD_KERNEL_TRANSFER] = { "transfer", kd_spv_transfer, sizeof kd_spv_transfer, KD_OWN_BINDING + KD_OWN_COUNT,
                             sizeof(struct kd_slice), STORED_KINDS },
    [KD_KERNEL_TRANSFER_TEXELS] = { "transfer, texels",
                                    kd_spv_transfer_texels,
                                    sizeof kd_spv_transfer_texels,
                                    KD_OWN_BINDING + KD_OWN_COUNT,
                                    sizeof(struct kd_slice),
                                    { KD_VK_TEXELS_R, [1] = KD_VK_UNIFORM, [2] = KD_VK_TEXELS_RGBA, [4] = KD_VK_UNIFORM,
                                      KD_EMIT_BUFFERS } },
    [KD_KERNEL_TRANSFER_PROBE] = { "transfer, told", kd_spv_transfer_probe, sizeof kd_spv_transfer_probe,
                                   KD_OWN_BINDING + KD_OWN_COUNT, sizeof(struct kd_slice), STORED_KINDS },
    [KD_KERNEL_MARCH_PROBE] = { "march, told", kd_spv_transfer_march_probe, sizeof kd_spv_transfer_march_probe,
                                KD_OWN_BINDING + KD_OWN_COUNT, sizeof(struct kd_slice), STORED_KINDS },
    [KD_KERNEL_LAYERS] = { "layers", kd_spv_layers, sizeof kd_spv_layers, KD_OWN_BINDING + KD_OWN_COUNT,
                           sizeof(struct kd_slice), STORED_KINDS },
    [KD_KERNEL_MARCH] = { "march", kd_spv_transfer_march, sizeof kd_spv_transfer_march, KD_OWN_BINDING + KD_OWN_COUNT,
                          sizeof(struct kd_slice), STORED_KINDS },
    [KD_KERNEL_MARCH_PIECES] = { "march, pieces", kd_spv_transfer_march_pieces, sizeof kd_spv_transfer_march_pieces,
                                 KD_OWN_BINDING + KD_OWN_COUNT, sizeof(struct kd_slice), STORED_KINDS },
    [KD_KERNEL_LAYERS_MARCH] = { "layers, march", kd_spv_layers_march, sizeof kd_spv_layers_march,
                                 KD_OWN_BINDING + KD_OWN_COUNT, sizeof(struct kd_slice), STORED_KINDS },
    [KD_KERNEL_PHOTOMETRY] = { "photometry", kd_spv_photometry, sizeof kd_spv_photometry, 2,
                               sizeof(struct kd_light_push) },
    [KD_KERNEL_EXPOSE] = { "expose", kd_spv_expose, sizeof kd_spv_expose, 2, 8 },
    [KD_KERNEL_POST] = { "post", kd_spv_post, sizeof kd_spv_post, 2, sizeof(struct kd_post_push) },
    [KD_KERNEL_POST_TEXELS] = { "post, texels",
                                kd_spv_post_texels,
                                sizeof kd_spv_post_texels,
                                2,
                                sizeof(struct kd_post_push),
                                { KD_VK_TEXELS_RGBA } },
    [KD_KERNEL_POST_BLOOM] = { "post, bloom", kd_spv_post_bloom, sizeof kd_spv_post_bloom, 3,
                               sizeof(struct kd_post_push) },
    [KD_KERNEL_POST_BLOOM_TEXELS] = { "post, bloom, texels",
                                      kd_spv_post_bloom_texels,
                                      sizeof kd_spv_post_bloom_texels,
                                      3,
                                      sizeof(struct kd_post_push),
                                      { KD_VK_TEXELS_RGBA, [2] = KD_VK_TEXELS_RGBA } },
    [KD_KERNEL_POST_HEAT] = { "post, heat",
                              kd_spv_post_heat,
                              sizeof kd_spv_post_heat,
                              3,
                              sizeof(struct kd_post_push),
                              { [2] = KD_VK_TEXELS_RGBA } },
    [KD_KERNEL_POST_HEAT_TEXELS] = { "post, heat, texels",
                                     kd_spv_post_heat_texels,
                                     sizeof kd_spv_post_heat_texels,
                                     3,
                                     sizeof(struct kd_post_push),
                                     { KD_VK_TEXELS_RGBA, [2] = KD_VK_TEXELS_RGBA } },
    [KD_KERNEL_POST_BLOOM_HEAT] = { "post, bloom, heat",
                                    kd_spv_post_bloom_heat,
                                    sizeof kd_spv_post_bloom_heat,
                                    4,
                                    sizeof(struct kd_post_push),
                                    { [3] = KD_VK_TEXELS_RGBA } },
    [KD_KERNEL_POST_BLOOM_HEAT_TEXELS] = { "post, bloom, heat, texels",
                                           kd_spv_post_bloom_heat_texels,
                                           sizeof kd_spv_post_bloom_heat_texels,
                                           4,
                                           sizeof(struct kd_post_push),
                                           { KD_VK_TEXELS_RGBA, [2] = KD_VK_TEXELS_RGBA, [3] = KD_VK_TEXELS_RGBA } },
    [KD_KERNEL_BEAM_GATHER] = { "beam, gather", kd_spv_beam_gather, sizeof kd_spv_beam_gather, 2,
                                sizeof(struct kd_beam_push) },
    [KD_KERNEL_BEAM_GATHER_TEXELS] = { "beam, gather, texels",
                                       kd_spv_beam_gather_texels,
                                       sizeof kd_spv_beam_gather_texels,
                                       2,
                                       sizeof(struct kd_beam_push),
                                       { KD_VK_TEXELS_RGBA } },
    [KD_KERNEL_BEAM_SPLINE] = { "beam, spline", kd_spv_beam_spline, sizeof kd_spv_beam_spline, 2,
                                sizeof(struct kd_beam_spline_push) },
    [KD_KERNEL_BEAM_SPLINE_TEXELS] = { "beam, spline, texels",
                                       kd_spv_beam_spline_texels,
                                       sizeof kd_spv_beam_spline_texels,
                                       2,
                                       sizeof(struct kd_beam_spline_push),
                                       { KD_VK_TEXELS_RGBA } },
    [KD_KERNEL_BEAM_BLUR] = { "beam, blur", kd_spv_beam_blur, sizeof kd_spv_beam_blur, 2,
                              sizeof(struct kd_beam_blur_push) },
    [KD_KERNEL_BEAM_BLUR_TEXELS] = { "beam, blur, texels",
                                     kd_spv_beam_blur_texels,
                                     sizeof kd_spv_beam_blur_texels,
                                     2,
                                     sizeof(struct kd_beam_blur_push),
                                     { KD_VK_TEXELS_RGBA } },
    [KD_KERNEL_BEAM_SPREAD] = { "beam, spread", kd_spv_beam_spread, sizeof kd_spv_beam_spread, 2,
                                sizeof(struct kd_beam_push) },
    [KD_KERNEL_BEAM_SPREAD_TEXELS] = { "beam, spread, texels",
                                       kd_spv_beam_spread_texels,
                                       sizeof kd_spv_beam_spread_texels,
                                       2,
                                       sizeof(struct kd_beam_push),
                                       { KD_VK_TEXELS_RGBA } },
    [KD_KERNEL_BLOOM_BRIGHT] = { "bloom, bright", kd_spv_bloom_bright, sizeof kd_spv_bloom_bright, 2,
                                 sizeof(struct kd_bloom_bright_push) },
    [KD_KERNEL_BLOOM_BRIGHT_TEXELS] = { "bloom, bright, texels",
                                        kd_spv_bloom_bright_texels,
                                        sizeof kd_spv_bloom_bright_texels,
                                        2,
                                        sizeof(struct kd_bloom_bright_push),
                                        { KD_VK_TEXELS_RGBA } },
    [KD_KERNEL_BLOOM_GATHER] = { "bloom, gather", kd_spv_bloom_gather, sizeof kd_spv_bloom_gather, 2,
                                 sizeof(struct kd_bloom_gather_push) },
    [KD_KERNEL_BLOOM_GATHER_TEXELS] = { "bloom, gather, texels",
                                        kd_spv_bloom_gather_texels,
                                        sizeof kd_spv_bloom_gather_texels,
                                        2,
                                        sizeof(struct kd_bloom_gather_push),
                                        { KD_VK_TEXELS_RGBA } },
    [KD_KERNEL_BLOOM_DOWN] = { "bloom, down", kd_spv_bloom_down, sizeof kd_spv_bloom_down, 2, 16 },
    [KD_KERNEL_BLOOM_DOWN_TEXELS] = { "bloom, down, texels",
                                      kd_spv_bloom_down_texels,
                                      sizeof kd_spv_bloom_down_texels,
                                      2,
                                      16,
                                      { KD_VK_TEXELS_RGBA } },
    [KD_KERNEL_BLOOM_UP] = { "bloom, up", kd_spv_bloom_up, sizeof kd_spv_bloom_up, 3, 16 },
    [KD_KERNEL_BLOOM_UP_TEXELS] = { "bloom, up, texels",
                                    kd_spv_bloom_up_texels,
                                    sizeof kd_spv_bloom_up_texels,
                                    3,
                                    16,
                                    { KD_VK_TEXELS_RGBA, KD_VK_TEXELS_RGBA } },
};

static enum kd_status make(struct kd_vk *vk, const struct kd_vk_pipeline_params *source, const uint32_t *constants,
                           size_t n, struct kd_vk_pipeline **out, struct kd_error *error)
{
    struct kd_vk_spec spec[KD_KERNEL_MAX_CONSTANTS];
    struct kd_vk_pipeline_params params = *source;
    for (size_t i = 0; i < n; i++)
        spec[i] = (struct kd_vk_spec) { (uint32_t)i, constants[i] };
    params.spec = spec;
    params.n_spec = n;
    return kd_vk_pipeline_create(vk, &params, out, error);
}

enum kd_status kd_kernels_get(struct kd_kernels *kernels, struct kd_vk *vk, enum kd_kernel kernel,
                              const uint32_t *constants, size_t n, const struct kd_vk_pipeline **out,
                              struct kd_error *error)
{
    return kd_kernels_get_of(kernels, vk, &sources[kernel], constants, n, out, error);
}

static size_t room_of(const struct kd_kernels *kernels) { return kernels->limit ? kernels->limit : KD_KERNELS_KEPT; }

/* The entry of a kernel; NULL if there is none. */
static struct kd_kernel_entry *find(struct kd_kernels *kernels, const struct kd_vk_pipeline_params *source,
                                    const uint32_t key[KD_KERNEL_MAX_CONSTANTS])
{
    for (struct kd_kernel_entry *e = kernels->entries; e < kernels->entries + room_of(kernels); e++)
        if (e->pipeline && e->source == source && !memcmp(e->constants, key, sizeof e->constants))
            return e;
    return NULL;
}

static void keep(struct kd_kernels *kernels, struct kd_vk *vk, const struct kd_vk_pipeline_params *source,
                 const uint32_t key[KD_KERNEL_MAX_CONSTANTS], size_t n, struct kd_vk_pipeline *pipeline)
{
    struct kd_kernel_entry *oldest = kernels->entries;
    for (struct kd_kernel_entry *e = kernels->entries; e < kernels->entries + room_of(kernels); e++)
        oldest = e->used < oldest->used ? e : oldest;
    kd_vk_pipeline_destroy(vk, oldest->pipeline);
    *oldest = (struct kd_kernel_entry) { .source = source, .n = n, .pipeline = pipeline, .used = ++kernels->clock };
    memcpy(oldest->constants, key, sizeof oldest->constants);
}

static void request_kernel(struct kd_kernels *kernels, const struct kd_vk_pipeline_params *source,
                           const uint32_t key[KD_KERNEL_MAX_CONSTANTS], size_t n)
{
    struct kd_kernel_requests *all = &kernels->wishes;
    for (size_t i = 0; i < all->n; i++)
        if (all->at[i].source == source && !memcmp(all->at[i].constants, key, sizeof all->at[i].constants))
            return;
    struct kd_kernel_entry *known = find(kernels, source, key);
    if (known)
        known->used = ++kernels->clock; /* marks the kernel as recently used, so that it is not evicted and made again
                                           for each frame */
    if (known || all->n == KD_KERNEL_WISHES || all->n == room_of(kernels))
        return;
    struct kd_kernel_request *w = &all->at[all->n++];
    *w = (struct kd_kernel_request) { .source = source, .n = n };
    memcpy(w->constants, key, sizeof w->constants);
}

enum kd_status kd_kernels_get_of(struct kd_kernels *kernels, struct kd_vk *vk,
                                 const struct kd_vk_pipeline_params *source, const uint32_t *constants, size_t n,
                                 const struct kd_vk_pipeline **out, struct kd_error *error)
{
    uint32_t key[KD_KERNEL_MAX_CONSTANTS] = { 0 };
    for (size_t i = 0; i < n; i++) /* constants is NULL if there are none */
        key[i] = constants[i];
    *out = NULL;
    if (kernels->noting) {
        request_kernel(kernels, source, key, n);
        return KD_OK;
    }
    struct kd_kernel_entry *known = find(kernels, source, key);
    if (known) {
        known->used = ++kernels->clock;
        *out = known->pipeline;
        return KD_OK;
    }
    struct kd_vk_pipeline *pipeline;
    enum kd_status status = make(vk, source, key, n, &pipeline, error);
    if (status)
        return status;
    keep(kernels, vk, source, key, n, pipeline);
    *out = pipeline;
    return KD_OK;
}

void kd_kernels_note(struct kd_kernels *kernels)
{
    kernels->noting = true;
    kernels->wishes.n = 0;
}

struct makers {
    struct kd_kernel_requests *wishes;
    struct kd_vk *vk;
    atomic_size_t next;
};

static void *make_wishes(void *user)
{
    struct makers *m = user;
    struct kd_error error = { 0 }; /* ignored here, because the next kd_kernels_get reports the error */
    size_t i;
    while ((i = atomic_fetch_add(&m->next, 1)) < m->wishes->n) {
        struct kd_kernel_request *w = &m->wishes->at[i];
        if (make(m->vk, w->source, w->constants, w->n, &w->made, &error))
            w->made = NULL;
    }
    return NULL;
}

/* Sorts by SPIR-V length, longest first, because the longest kernel takes longest to make. If that kernel were
 * started last, one thread would still work on it when all others are idle. */
static int longer_first(const void *a, const void *b)
{
    const size_t x = ((const struct kd_kernel_request *)a)->source->spirv_bytes,
                 y = ((const struct kd_kernel_request *)b)->source->spirv_bytes;
    return (x < y) - (x > y);
}

void kd_kernels_noted(struct kd_kernels *kernels, struct kd_kernel_requests *out)
{
    kernels->noting = false;
    *out = kernels->wishes;
    kernels->wishes.n = 0;
}

void kd_kernel_requests_make(struct kd_kernel_requests *wishes, struct kd_vk *vk)
{
    struct makers m = { .wishes = wishes, .vk = vk };
    pthread_t threads[MAKERS - 1];
    const long processors = sysconf(_SC_NPROCESSORS_ONLN);
    size_t n = 0;
    qsort(wishes->at, wishes->n, sizeof *wishes->at, longer_first);
    while (n < MAKERS - 1 && n + 1 < (size_t)processors && n + 1 < wishes->n &&
           !pthread_create(&threads[n], NULL, make_wishes, &m))
        n++;
    make_wishes(&m); /* this thread takes part, and works alone if no other thread could be created */
    for (size_t i = 0; i < n; i++)
        pthread_join(threads[i], NULL);
}

void kd_kernels_keep(struct kd_kernels *kernels, struct kd_vk *vk, const struct kd_kernel_requests *made)
{
    for (const struct kd_kernel_request *w = made->at; w < made->at + made->n; w++)
        if (w->made && find(kernels, w->source, w->constants))
            kd_vk_pipeline_destroy(vk, w->made); /* another thread has made this kernel meanwhile */
        else if (w->made)
            keep(kernels, vk, w->source, w->constants, w->n, w->made);
    kernels->noted = kernels->clock;
}

void kd_kernels_make(struct kd_kernels *kernels, struct kd_vk *vk)
{
    struct kd_kernel_requests wishes;
    kd_kernels_noted(kernels, &wishes);
    kd_kernel_requests_make(&wishes, vk);
    kd_kernels_keep(kernels, vk, &wishes);
}

bool kd_kernels_texels_of(const struct kd_vk *vk, uint64_t bytes) { return bytes <= 16 * kd_vk_info(vk)->max_texels; }

bool kd_kernels_texels(const struct kd_vk *vk, uint64_t pixels)
{
    return kd_kernels_texels_of(vk, kd_post_radiance_bytes(pixels));
}

bool kd_kernels_map_as_texels(const struct kd_vk *vk)
{
    return kd_vk_info(vk)->max_binding_bytes <= 4 * kd_vk_info(vk)->max_texels;
}

bool kd_kernels_cells_as_texels(const struct kd_vk *vk, const struct kd_bloom *bloom)
{
    return !bloom->levels || kd_bloom_most(bloom) <= kd_vk_info(vk)->max_texels;
}

void kd_kernels_rest(struct kd_kernels *kernels, struct kd_vk *vk, size_t n)
{
    for (;;) {
        struct kd_kernel_entry *oldest = NULL;
        size_t there = 0;
        for (struct kd_kernel_entry *e = kernels->entries; e < kernels->entries + KD_KERNELS_KEPT; e++) {
            there += e->pipeline != NULL;
            oldest = e->pipeline && (!oldest || e->used < oldest->used) ? e : oldest;
        }
        if (there <= n)
            return;
        kd_vk_pipeline_destroy(vk, oldest->pipeline);
        *oldest = (struct kd_kernel_entry) { 0 };
    }
}

void kd_kernels_list(const struct kd_kernels *kernels, struct kd_kernel_requests *out)
{
    out->n = 0;
    for (const struct kd_kernel_entry *e = kernels->entries; e < kernels->entries + KD_KERNELS_KEPT; e++) {
        if (!e->pipeline || out->n == KD_KERNEL_WISHES)
            continue;
        struct kd_kernel_request *w = &out->at[out->n++];
        *w = (struct kd_kernel_request) { .source = e->source, .n = e->n };
        memcpy(w->constants, e->constants, sizeof w->constants);
    }
}

uint64_t kd_kernels_spirv_bytes(const struct kd_kernels *kernels)
{
    uint64_t sum = 0;
    for (const struct kd_kernel_entry *e = kernels->entries; e < kernels->entries + KD_KERNELS_KEPT; e++)
        sum += e->pipeline ? e->source->spirv_bytes : 0;
    return sum;
}

void kd_kernels_finish(struct kd_kernels *kernels, struct kd_vk *vk)
{
    for (size_t i = 0; i < KD_KERNELS_KEPT; i++)
        kd_vk_pipeline_destroy(vk, kernels->entries[i].pipeline);
    memset(kernels, 0, sizeof *kernels);
}
