#include "render/device/rest.h"

#include "base/allocator.h"
#include "base/clock.h"
#include "base/log.h"
#include "render/device/internal.h"

#include <stdio.h>
#include <unistd.h>

#define HEAP_MS 1000. /* between two looks at the heap, which take longer than the rest of it */

static uint64_t resident_bytes(void)
{
    unsigned long size, resident = 0;
    FILE *f = fopen("/proc/self/statm", "re");
    if (f && fscanf(f, "%lu %lu", &size, &resident) != 2)
        resident = 0;
    if (f)
        fclose(f);
    return (uint64_t)resident * (uint64_t)sysconf(_SC_PAGESIZE);
}

static uint64_t sum_of(const struct kd_renderer *r)
{
    uint64_t sum = 0;
    for (size_t i = 0; i < KD_N_KEPT_KINDS; i++)
        sum += atomic_load(&r->kept_bytes[i]);
    return sum;
}

void kd_renderer_begin_count(struct kd_renderer *r)
{
    r->opened_bytes = resident_bytes();
    r->opened_heap = kd_allocator_used();
}

void kd_renderer_kept(const struct kd_renderer *r, uint64_t out[KD_N_KEPT_KINDS])
{
    for (size_t i = 0; i < KD_N_KEPT_KINDS; i++)
        out[i] = atomic_load(&r->kept_bytes[i]);
}

/* What is resident and has no name yet. Of the device's memory, which is counted as a whole, pages may never have been
 * touched: so the heap is no more than what is left. */
static void count_rest(struct kd_renderer *r)
{
    const double now = kd_clock_ms();
    if (!(now - r->heap_ms < HEAP_MS)) {
        const uint64_t known = r->opened_heap + atomic_load(&r->kept_bytes[KD_KEPT_KERNELS]),
                       used = kd_allocator_used();
        r->heap_bytes = used > known ? used - known : 0;
        r->heap_ms = now;
    }
    atomic_store(&r->kept_bytes[KD_KEPT_HEAP], 0);
    atomic_store(&r->kept_bytes[KD_KEPT_OTHER], 0);
    const uint64_t named = r->opened_bytes + sum_of(r), resident = resident_bytes(),
                   left = resident > named ? resident - named : 0, heap = r->heap_bytes < left ? r->heap_bytes : left;
    atomic_store(&r->kept_bytes[KD_KEPT_HEAP], heap);
    atomic_store(&r->kept_bytes[KD_KEPT_OTHER], left - heap);
}

void kd_renderer_count(struct kd_renderer *r)
{
    const uint64_t held = kd_vk_allocated(r->vk);
    uint64_t maps = kd_store_map_bytes(&r->store);
    for (size_t i = 0; i < KD_ASIDES; i++)
        maps += kd_store_map_bytes(&r->asides[i].store);
    atomic_store(&r->held, held);
    atomic_store(&r->kept_bytes[KD_KEPT_LENS_MAPS], maps);
    atomic_store(&r->kept_bytes[KD_KEPT_BUFFERS], held > maps ? held - maps : 0);
    atomic_store(&r->kept_bytes[KD_KEPT_KERNELS], kd_kernels_spirv_bytes(&r->kernels));
    atomic_store(&r->kept_bytes[KD_KEPT_PANORAMAS], kd_panoramas_bytes(&r->panoramas));
    count_rest(r);
}

static void empty_asides(struct kd_renderer *r)
{
    for (size_t i = 0; i < KD_ASIDES; i++) {
        struct kd_aside *a = &r->asides[i];
        if (a->busy)
            continue;
        kd_store_empty(&a->store);
        kd_prepared_finish(&a->prepared, r->vk);
    }
}

/* All that can be given back while the device stays open. */
static void give_back(struct kd_renderer *r)
{
    empty_asides(r);
    kd_store_rest(&r->store, KD_REST_MAPS_BYTES);
    kd_prepared_finish(&r->prepared, r->vk);
    for (size_t i = 0; i < sizeof r->rays / sizeof **r->rays; i++) {
        kd_vk_buffer_destroy(r->vk, r->rays[i / 3][i % 3]);
        r->rays[i / 3][i % 3] = NULL;
    }
    kd_kernels_rest(&r->kernels, r->vk, KD_REST_KERNELS);
    kd_panoramas_rest(&r->panoramas, KD_REST_PANORAMAS);
}

enum kd_status kd_renderer_rest(struct kd_renderer *r, struct kd_error *error)
{
    enum kd_status status;
    if (!r->vk)
        return KD_OK;
    KD_TRY(kd_vk_wait(r->vk, 0, error));
    give_back(r);
    KD_TRY(kd_vk_wait(r->vk, 0, error)); /* what was destroyed is freed now */
    kd_allocator_trim();
    r->heap_ms = 0;
    kd_renderer_count(r);
    if (sum_of(r) <= KD_REST_BYTES)
        return KD_OK;
    kd_log(KD_LOG_INFO, "%.0f MiB are kept at rest: the device is opened again", (double)sum_of(r) / 0x1p20);
    KD_TRY(kd_renderer_reopen(r, error));
    kd_allocator_trim();
    r->heap_ms = 0;
    kd_renderer_count(r);
done:
    return status;
}
