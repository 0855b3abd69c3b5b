/* What an idle renderer keeps, in bytes by kind, and how it frees the rest. */
#ifndef KD_RENDER_DEVICE_REST_H
#define KD_RENDER_DEVICE_REST_H

#include "render/device/renderer.h"

/* X(kind, its word in /metrics) */
#define KD_KEPT_KINDS(X) \
    X(LENS_MAPS, "lens_maps") \
    X(BUFFERS, "buffers") X(KERNELS, "kernels") X(PANORAMAS, "panoramas") X(HEAP, "heap") X(OTHER, "other")
enum kd_kept_kind {
#define KD_KEPT_ENUM(kind, word) KD_KEPT_##kind,
    KD_KEPT_KINDS(KD_KEPT_ENUM)
#undef KD_KEPT_ENUM
        KD_N_KEPT_KINDS
};

/* Bounds of what stays after kd_renderer_rest. Device memory is held in blocks of 64 MiB (vk/memory.c): one map may
 * keep two of them. */
#define KD_REST_MAPS_BYTES (64ull << 20) /* the latest lens map, or none if it is larger */
#define KD_REST_KERNELS 16u              /* the latest ones: as many as one view and its refinement take */
#define KD_REST_PANORAMAS 1u             /* the latest one, up to 45 MB */
/* What buffers of pictures that were made aside (kd_render_aside) may hold when these are done, beside those of the
 * last one: lens maps that the next picture may use. */
#define KD_IDLE_ASIDES_BYTES (128ull << 20)
/* Lens maps that are kept beside the one in use. */
#define KD_KEPT_MAPS_BYTES (512ull << 20)
/* What all kinds together may be at rest. Beyond it the device is closed and opened again: lavapipe keeps something
 * of each kernel that it has ever compiled (an LLVM context is never emptied) until then. */
#define KD_REST_BYTES (256ull << 20)
#define KD_REST_SOON_BYTES \
    (768ull << 20) /* beyond this a moment without work is taken for a rest (server/render/rest.c) */

/* NULL behind the last. */
static inline const char *kd_kept_word(size_t kind)
{
#define KD_KEPT_WORD(kind, word) word,
    static const char *const words[] = { KD_KEPT_KINDS(KD_KEPT_WORD) };
#undef KD_KEPT_WORD
    return kind < KD_N_KEPT_KINDS ? words[kind] : NULL;
}
/* The device's kinds are as after the latest frame or rest; kernels are counted by their SPIR-V. The last two are what
 * is resident now beyond these and what was when the device had first been opened: heap, in use there, mostly what
 * lavapipe has made of kernels; other: code, stacks, what is freed and not given back, and blocks of a MiB and more
 * that are being rendered, encoded or sent. It takes the reading of a file in /proc and a look at the heap, a
 * millisecond or so. Any thread. */
void kd_renderer_kept(const struct kd_renderer *renderer, uint64_t out[KD_N_KEPT_KINDS]);
/* The sum of all kinds, without the look at the heap, and without what a device that was opened again has left. Any
 * thread. */
uint64_t kd_renderer_kept_sum(const struct kd_renderer *renderer);
/* Counts it anew, after each frame: it calls nothing of the system. Render thread only. */
void kd_renderer_count(struct kd_renderer *renderer);
/* Gives back everything but what the bounds above name, and the host's free memory to the kernel. Pictures come out
 * the same afterwards; those of the latest view as soon, unless the device had to be opened again (KD_REST_BYTES).
 * Errors as kd_renderer_reopen. Render thread only, while nothing is rendered, here or aside. */
enum kd_status kd_renderer_rest(struct kd_renderer *renderer, struct kd_error *error);
/* The process has just opened the device for the first time: what is resident now is no kind of what is kept. */
void kd_renderer_begin_count(struct kd_renderer *renderer);

#endif
