/* Counts the memory that an idle renderer keeps, in bytes of each kind, and frees the memory that it need not keep. */
#ifndef KD_RENDER_DEVICE_REST_H
#define KD_RENDER_DEVICE_REST_H

#include "render/device/renderer.h"

/* X(kind, label of the kind in /metrics) */
#define KD_CACHE_KINDS(X) \
    X(LENS_MAPS, "lens_maps") \
    X(BUFFERS, "buffers") X(KERNELS, "kernels") X(PANORAMAS, "panoramas") X(HEAP, "heap") X(OTHER, "other")
enum kd_cache_kind {
#define KD_CACHE_ENUM(kind, word) KD_CACHE_##kind,
    KD_CACHE_KINDS(KD_CACHE_ENUM)
#undef KD_CACHE_ENUM
        KD_N_CACHE_KINDS
};

/* Limits for what stays after kd_renderer_rest. Device memory is allocated in blocks of 64 MiB (vk/memory.c), and one
 * lens map may occupy two of them. */
#define KD_REST_MAPS_BYTES (64ull << 20) /* the latest lens maps stay, as far as they fit */
#define KD_REST_KERNELS 16u              /* enough of the most recently used kernels for one view and its refinement */
#define KD_REST_PANORAMAS 1u             /* the latest panorama, up to 45 MB */
/* Limit for the buffers of finished background renders (kd_render_in_background), except the last one. These buffers
 * are kept because their lens maps may serve the next picture. */
#define KD_IDLE_ASIDES_BYTES (128ull << 20)
/* Limit for lens maps that are kept besides the one in use. */
#define KD_KEPT_MAPS_BYTES (512ull << 20)
/* Limit for all kinds together at rest. If the sum exceeds this limit, the device is closed and reopened. This is
 * necessary because lavapipe keeps some memory of each kernel that it has ever compiled: an LLVM context is never
 * emptied. */
#define KD_REST_BYTES (256ull << 20)
/* If the sum exceeds this limit, memory is freed after a sixtieth of the usual pause without work
 * (server/render/rest.c). */
#define KD_REST_SOON_BYTES (768ull << 20)

/* The label of a kind; NULL after the last. */
static inline const char *kd_cached_documents_word(size_t kind)
{
#define KD_CACHE_WORD(kind, word) word,
    static const char *const words[] = { KD_CACHE_KINDS(KD_CACHE_WORD) };
#undef KD_CACHE_WORD
    return kind < KD_N_CACHE_KINDS ? words[kind] : NULL;
}
/* Counts the bytes of each kind. The kinds on the device were counted after the latest frame or rest. Kernels are
 * counted by the size of their SPIR-V. The last two kinds, `heap` and `other`, divide what is left of the resident
 * memory after subtraction of two sizes: the sum of the other kinds, and the size of the process when it first opened
 * the device. heap: memory in use on the heap, mostly what lavapipe has compiled. other: code, stacks, freed memory
 * that was not yet returned, and blocks of a MiB and more that are in use for rendering, encoding or sending. Reads a
 * file in /proc and inspects the heap, in about a millisecond. Any thread. */
void kd_renderer_cached(const struct kd_renderer *renderer, uint64_t out[KD_N_CACHE_KINDS]);
/* The sum of all kinds without inspecting the heap. Memory that remained after the device was reopened is not
 * included. Any thread. */
uint64_t kd_renderer_kept_sum(const struct kd_renderer *renderer);
/* Updates the counts after each frame, without system calls. Render thread only. */
void kd_renderer_count(struct kd_renderer *renderer);
/* Frees everything beyond the bounds above, and returns the host's free memory to the kernel. Later pictures are the
 * same. Pictures of the latest view take no longer than before, unless the device had to be reopened (KD_REST_BYTES).
 * Errors are those of kd_renderer_reopen. Render thread only, while nothing is being rendered, here or in the
 * background. */
enum kd_status kd_renderer_rest(struct kd_renderer *renderer, struct kd_error *error);
/* Call this after the process has opened the device for the first time. The memory that is resident at that moment is
 * not counted as kept. */
void kd_renderer_begin_count(struct kd_renderer *renderer);

#endif
