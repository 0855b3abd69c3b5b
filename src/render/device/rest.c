#include "render/device/rest.h"

#include "base/allocator.h"
#include "base/clock.h"
#include "base/log.h"
#include "render/device/device_internal.h"

#include <stdio.h>
#include <unistd.h>

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

void kd_renderer_begin_count(struct kd_renderer *r)
{
    r->opened_bytes = r->started_bytes = resident_bytes();
    r->started_heap = kd_allocator_used();
}

static uint64_t more_than(uint64_t a, uint64_t b) { return a > b ? a - b : 0; }

static uint64_t named_bytes(const struct kd_renderer *r, uint64_t out[KD_N_CACHE_KINDS])
{
    uint64_t sum = 0;
    for (size_t i = 0; i < KD_N_CACHE_KINDS; i++)
        sum += out[i] = i == KD_CACHE_HEAP || i == KD_CACHE_OTHER ? 0 : atomic_load(&r->kept_bytes[i]);
    return sum;
}

uint64_t kd_renderer_kept_sum(const struct kd_renderer *r)
{
    uint64_t each[KD_N_CACHE_KINDS], named = named_bytes(r, each);
    return named + more_than(resident_bytes(), r->opened_bytes + named);
}

/* Resident memory of no other kind is divided between `heap` and `other`. Memory in use on the heap counts as `heap`,
 * but at most this remainder. The remainder may be smaller than the heap, because device memory counts in full although
 * some of its pages may never have been touched. */
void kd_renderer_cached(const struct kd_renderer *r, uint64_t out[KD_N_CACHE_KINDS])
{
    const uint64_t left = more_than(resident_bytes(), r->started_bytes + named_bytes(r, out)),
                   heap = more_than(kd_allocator_used(), r->started_heap + out[KD_CACHE_KERNELS]);
    out[KD_CACHE_HEAP] = heap < left ? heap : left;
    out[KD_CACHE_OTHER] = left - out[KD_CACHE_HEAP];
}

void kd_renderer_count(struct kd_renderer *r)
{
    const uint64_t held = kd_vk_allocated(r->vk);
    uint64_t maps = kd_store_map_bytes(&r->store);
    for (size_t i = 0; i < KD_BACKGROUND_RENDERS; i++)
        maps += kd_store_map_bytes(&r->background_renders[i].store);
    atomic_store(&r->held, held);
    atomic_store(&r->kept_bytes[KD_CACHE_LENS_MAPS], maps);
    atomic_store(&r->kept_bytes[KD_CACHE_BUFFERS], held > maps ? held - maps : 0);
    atomic_store(&r->kept_bytes[KD_CACHE_KERNELS], kd_kernels_spirv_bytes(&r->kernels));
    atomic_store(&r->kept_bytes[KD_CACHE_PANORAMAS], kd_panoramas_bytes(&r->panoramas));
}

static void empty_backgrounds(struct kd_renderer *r)
{
    for (size_t i = 0; i < KD_BACKGROUND_RENDERS; i++) {
        struct kd_background_render *a = &r->background_renders[i];
        if (a->busy)
            continue;
        kd_store_empty(&a->store);
        kd_prepared_finish(&a->prepared, r->vk);
    }
}

/* Frees everything that can be freed while the device stays open. */
static void give_back(struct kd_renderer *r)
{
    empty_backgrounds(r);
    kd_store_rest(&r->store, KD_REST_MAPS_BYTES);
    kd_prepared_finish(&r->prepared, r->vk);
    for (size_t i = 0; i < sizeof r->rays / sizeof **r->rays; i++) {
        kd_vk_buffer_destroy(r->vk, r->rays[i / 3][i % 3]);
        r->rays[i / 3][i % 3] = NULL;
    }
    kd_kernels_rest(&r->kernels, r->vk, KD_REST_KERNELS);
    kd_panoramas_rest(&r->panoramas, KD_REST_PANORAMAS);
    kd_grids_rest(&r->grids);
}

/* Closes the device and reopens it. Memory that is still resident afterwards no longer counts in kd_renderer_kept_sum,
 * so that the device is not reopened again because of it. The latest kernels are made again, in a third of a second on
 * two cores. So the next picture of the same view does not wait for them. */
static enum kd_status open_again(struct kd_renderer *r, struct kd_error *error)
{
    _Static_assert(KD_REST_KERNELS <= KD_KERNEL_WISHES, "all kernels that are kept are made again");
    struct kd_kernel_requests latest;
    kd_kernels_list(&r->kernels, &latest);
    enum kd_status status = kd_renderer_reopen(r, error);
    if (status && !r->vk) /* there is no device, because reopening failed */
        status = error->status = KD_EDEVICE;
    if (status)
        return status;
    kd_allocator_trim();
    r->opened_bytes = resident_bytes();
    kd_kernel_requests_make(&latest, r->vk);
    kd_kernels_keep(&r->kernels, r->vk, &latest);
    kd_renderer_count(r);
    return KD_OK;
}

enum kd_status kd_renderer_rest(struct kd_renderer *r, struct kd_error *error)
{
    enum kd_status status;
    if (!r->vk)
        return KD_OK;
    KD_TRY(kd_vk_wait(r->vk, 0, error));
    give_back(r);
    /* waits, because buffers that were destroyed are freed only when the device is idle */
    KD_TRY(kd_vk_wait(r->vk, 0, error));
    kd_allocator_trim();
    kd_renderer_count(r);
    const uint64_t sum = kd_renderer_kept_sum(r);
    if (sum <= KD_REST_BYTES)
        return KD_OK;
    kd_log(KD_LOG_INFO, "%.0f MiB remain in use at rest; the device is reopened", (double)sum / 0x1p20);
    return open_again(r, error);
done:
    return status;
}
