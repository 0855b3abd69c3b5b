/* Settles undecided rays, whose fate or number of crossings single precision cannot determine. Such rays are few. The
 * host traces them again in double precision: in closed form, or by steps for an observer inside the horizon. It writes
 * the results into the lens map before the map is read. */
#include "render/frame/lens.h"

#include "render/lens/listed.h"
#include "render/view/camera.h"

#include <stdlib.h>
#include <string.h>

/* The undecided rays in a band of the grid, or in a part of a list. */
struct open_rays {
    struct kd_vk_buffer *lens;
    uint32_t n, stride;
    uint32_t *places; /* indices of the rays in a plane of the map */
    struct kd_camera_label *labels;
};

enum { READ_AT_ONCE = 255 }; /* number of indices that are read at once; most maps have fewer */

static const char *pass_of(const struct kd_frame_part *part)
{
    return part && part->list->pass ? part->list->pass : kd_passes[KD_PASS_TRACE].name;
}

enum kd_status kd_frame_forget_open(struct kd_frame_job *j, const struct kd_frame_part *part)
{
    return j->plan->lens.path != KD_LENS_LISTED
               ? kd_vk_fill(j->r->vk, pass_of(part), j->store->undecided, 0, 4, 0, j->error)
               : KD_OK;
}

static uint32_t places_of(const struct kd_frame_job *j)
{
    return (uint32_t)(kd_vk_buffer_size(j->store->undecided) / 4 - 1);
}

/* Reads the list of undecided rays: first its counter and the first indices, which are enough for most maps. */
static enum kd_status read_list(struct kd_frame_job *j, uint32_t places)
{
    enum kd_status status;
    KD_TRY(kd_vk_copy(j->r->vk, "readback", j->store->undecided_host, 0, j->store->undecided, 0, 4ull * (1 + places),
                      j->error));
    KD_TRY(kd_vk_submit(j->r->vk, NULL, j->error));
    KD_TRY(kd_vk_wait(j->r->vk, 0, j->error));
done:
    return status;
}

/* Traces the undecided rays, and uploads the results to their places. host: buffer for the upload. It begins with
 * the indices and continues with the planes. */
static enum kd_status follow(struct kd_frame_job *j, const struct open_rays *open, const char *pass,
                             struct kd_vk_buffer *host, struct kd_vk_buffer *device)
{
    const struct kd_plan *p = j->plan;
    uint32_t *words = kd_vk_buffer_map(host);
    const uint32_t push[3] = { open->n, p->lens.planes, open->stride };
    struct kd_vk_dispatch d = {
        pass, NULL, { { open->lens, 0, 0, true }, { device, 0, 0, false } }, push, { kd_frame_groups(open->n) }
    };
    enum kd_status status;
    memcpy(words, open->places, 4ull * open->n);
    KD_TRY(kd_lens_again(j->scene, p, open->labels, open->n, (float *)words + open->n, &j->undecided, j->error));
    KD_TRY(kd_vk_copy(j->r->vk, "upload", device, 0, host, 0, 4ull * open->n * (1 + p->lens.planes), j->error));
    KD_TRY(kd_kernels_get(&j->r->kernels, j->r->vk, KD_KERNEL_SETTLE, NULL, 0, &d.pipeline, j->error));
    KD_TRY(kd_vk_dispatch(j->r->vk, &d, j->error));
done:
    return status;
}

static enum kd_status send(struct kd_frame_job *j, const struct open_rays *open, const char *pass)
{
    const uint64_t bytes = 4ull * open->n * (1 + j->plan->lens.planes);
    struct kd_vk_buffer *host = NULL, *device = NULL;
    enum kd_status status;
    KD_TRY(kd_vk_buffer_create(j->r->vk, bytes, KD_VK_UPLOAD, "rays that were settled", &host, j->error));
    KD_TRY(
        kd_vk_buffer_create(j->r->vk, bytes, KD_VK_DEVICE, "rays that were settled, on the device", &device, j->error));
    memset(kd_vk_buffer_map(host), 0, bytes); /* 0 now; the footprints are made later */
    KD_TRY(follow(j, open, pass, host, device));
done:
    kd_vk_buffer_destroy(j->r->vk, host);
    kd_vk_buffer_destroy(j->r->vk, device);
    return status;
}

/* Computes the labels of the rays at these indices. */
static void label(const struct kd_frame_job *j, struct open_rays *open, const struct kd_frame_part *part, uint32_t band)
{
    const struct kd_critical_lattice *l = part ? &part->list->lattice : NULL;
    const struct kd_scene camera = part ? kd_critical_camera(j->scene, kd_critical_steps(l)) : *j->scene;
    const struct kd_camera_exact exact = kd_camera_exact(&camera);
    const uint32_t width = part ? l->rays : j->plan->picture.width * j->plan->lens.side,
                   row0 = part ? 0 : kd_frame_band_first(j, band) * j->plan->lens.side;
    for (uint32_t i = 0; i < open->n; i++) {
        struct kd_pixel at = { open->places[i] % width, row0 + open->places[i] / width };
        if (part)
            at = kd_critical_place(l, part->list->pixels->pixels[part->first + at.y], at.x);
        kd_camera_label(&exact, at.x, at.y, &open->labels[i]);
    }
}

/* Settles the undecided rays. found: the number of undecided rays; rays beyond the list's capacity are counted but not
 * listed. */
static enum kd_status settle(struct kd_frame_job *j, const struct kd_frame_part *part, uint32_t band, uint32_t found)
{
    const struct kd_plan *p = j->plan;
    const uint32_t most = places_of(j);
    struct open_rays open = {
        .lens = part ? part->lens : kd_frame_band_lens(j, band),
        .n = found < most ? found : most,
        .stride = part ? part->push.stride : p->picture.width * p->lens.side * p->picture.band_rows * p->lens.side,
    };
    enum kd_status status = KD_OK;
    if (open.n > READ_AT_ONCE)
        KD_TRY(read_list(j, open.n));
    open.places = malloc(open.n * sizeof *open.places);
    open.labels = malloc(open.n * sizeof *open.labels);
    if (!open.places || !open.labels)
        KD_TRY(kd_error_set(j->error, KD_ENOMEM, "out of memory for %u rays", open.n));
    memcpy(open.places, (const uint32_t *)kd_vk_buffer_map(j->store->undecided_host) + 1, open.n * sizeof *open.places);
    label(j, &open, part, band);
    j->undecided += found - open.n;
    KD_TRY(send(j, &open, pass_of(part)));
done:
    free(open.places);
    free(open.labels);
    return status;
}

enum kd_status kd_frame_settle(struct kd_frame_job *j, const struct kd_frame_part *part, uint32_t band)
{
    if (j->plan->lens.path == KD_LENS_LISTED)
        return KD_OK;
    const uint32_t most = places_of(j);
    enum kd_status status = read_list(j, most < READ_AT_ONCE ? most : READ_AT_ONCE);
    const uint32_t found = status ? 0 : *(const uint32_t *)kd_vk_buffer_map(j->store->undecided_host);
    return found ? settle(j, part, band, found) : status;
}
