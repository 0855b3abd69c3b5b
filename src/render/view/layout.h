/* C side of the lists in shaders/shared: structs of interface.h, specialisation constants of spec.h, planes of
 * lens.h. */
#ifndef KD_RENDER_VIEW_LAYOUT_H
#define KD_RENDER_VIEW_LAYOUT_H

#include "emitters.h"
#include "interface.h"
#include "lens.h"
#include "spec.h"

#include <math.h>
#include <stddef.h>
#include <stdint.h>

/* The least size of a value that is not 0. Such a value must not become 0 as a float on the device, because it decides
 * whether a ray lies in the plane or on the axis. Where the device flushes denormals, products and quotients with other
 * values must not become denormal either. An observer may be 2.5e-16 from the plane. There a label of 1e-20 would move
 * the node by 1e-5, and 1e-22 moves it by 1e-7. A third of 1e-22, times 2.5e-16, would be denormal. */
#define KD_LEAST_FLOAT 1e-22
static inline double kd_lifted(double x)
{
    return x != 0 && fabs(x) < KD_LEAST_FLOAT ? copysign(KD_LEAST_FLOAT, x) : x;
}

#define F(name) float name;
#define U(name) uint32_t name;
struct kd_camera_block { KD_CAMERA_FIELDS_(F, U) };
struct kd_slice { KD_SLICE_FIELDS_(F, U) };
struct kd_footprint_push { KD_FOOTPRINT_FIELDS_(F, U) };
struct kd_sample_push { KD_SAMPLE_FIELDS_(F, U) };
struct kd_stars_push { KD_STARS_FIELDS_(F, U) };
struct kd_between_push { KD_BETWEEN_FIELDS_(F, U) };
struct kd_guide { KD_GUIDE_FIELDS_(F, U) };
struct kd_particles_push { KD_PARTICLES_FIELDS_(F, U) };
struct kd_light_push { KD_LIGHT_FIELDS_(F, U) };
struct kd_post_push { KD_POST_FIELDS_(F, U) };
struct kd_bloom_bright_push { KD_BLOOM_BRIGHT_FIELDS_(F, U) };
struct kd_bloom_gather_push { KD_BLOOM_GATHER_FIELDS_(F, U) };
struct kd_beam_push { KD_BEAM_BAND_FIELDS_(F, U) };
struct kd_beam_spline_push { KD_BEAM_SPLINE_FIELDS_(F, U) };
struct kd_beam_blur_push { KD_BEAM_BLUR_FIELDS_(F, U) };
#undef F
#undef U

/* Sizes for post.comp. kd_post_groups: number of workgroups for a number of pixels. kd_post_radiance_bytes: bytes of
 * radiance that these workgroups read, in blocks of four pixels. kd_post_bytes: bytes of packed pixels that they write,
 * a multiple of what one workgroup writes. */
static inline uint32_t kd_post_groups(uint64_t pixels)
{
    const uint64_t each = KD_GROUP_SIZE * KD_POST_PIXELS;
    return (uint32_t)((pixels + each - 1) / each);
}
static inline uint64_t kd_post_radiance_bytes(uint64_t pixels)
{
    return (pixels + KD_POST_PIXELS - 1) / KD_POST_PIXELS * (12 * KD_POST_PIXELS);
}
static inline uint64_t kd_post_bytes(uint64_t pixels, int bit_depth)
{
    return (uint64_t)kd_post_groups(pixels) * KD_GROUP_SIZE * KD_POST_PIXELS * (bit_depth == 16 ? 6 : 3);
}
/* Two counts of a band are read back after its pixels. The last word of the band's light counts rays on which the march
 * gave up. The word after the pixels counts pixels whose light is not finite. */
#define KD_POST_COUNTS 2

_Static_assert(sizeof(struct kd_slice) <= 128 && sizeof(struct kd_footprint_push) <= 128 &&
                   sizeof(struct kd_particles_push) <= 128 && sizeof(struct kd_light_push) <= 128 &&
                   sizeof(struct kd_post_push) <= 128,
               "the push constants that every device has");

/* Cameras of a frame, in one buffer at offsets at which a binding may begin. In order: for rays of the grid; for rays
 * at the critical curve; for extra rays of refined pixels, on the grid and at the curve; for rays that measure the
 * remaining error; for the whole picture, if this one is a tile. */
enum {
    KD_CAMERA_GRID,
    KD_CAMERA_CRITICAL,
    KD_CAMERA_DENSE,
    KD_CAMERA_DENSE_CRITICAL,
    KD_CAMERA_TRUTH,
    KD_CAMERA_WHOLE,
    KD_CAMERAS,
    KD_CAMERA_BYTES = 256
};
_Static_assert(sizeof(struct kd_camera_block) <= KD_CAMERA_BYTES, "the next camera begins behind this one");

/* Specialisation constants as structs: a member's offset is four times the constant's id. */
#define SPEC_U(id, name, value) uint32_t name;
#define SPEC_CHECK(of, id, name) _Static_assert(offsetof(struct of, name) == 4 * (id), "a constant's id is its place");
#define SPEC(of, LIST, CHECK, more) \
    struct of { LIST(SPEC_U, SPEC_U) more }; \
    LIST(CHECK, CHECK)
#define CHECK_CLOSED(id, name, value) SPEC_CHECK(kd_spec_lens_closed, id, name)
#define CHECK_MAP(id, name, value) SPEC_CHECK(kd_spec_lens_map, id, name)
#define CHECK_FOOTPRINT(id, name, value) SPEC_CHECK(kd_spec_footprint, id, name)
#define CHECK_BETWEEN(id, name, value) SPEC_CHECK(kd_spec_between, id, name)
#define CHECK_SAMPLE(id, name, value) SPEC_CHECK(kd_spec_sample, id, name)
#define CHECK_FILL(id, name, value) SPEC_CHECK(kd_spec_fill, id, name)
#define CHECK_TRANSFER(id, name, value) SPEC_CHECK(kd_spec_transfer, id, name)
#define CHECK_RAYS(id, name, value) SPEC_CHECK(kd_spec_rays, id, name)
#define CHECK_PARTICLES(id, name, value) SPEC_CHECK(kd_spec_particles, id, name)
#define CHECK_PHOTOMETRY(id, name, value) SPEC_CHECK(kd_spec_photometry, id, name)
#define CHECK_STARS(id, name, value) SPEC_CHECK(kd_spec_stars, id, name)
#define CHECK_POST(id, name, value) SPEC_CHECK(kd_spec_post, id, name)
#define CHECK_BRIGHT(id, name, value) SPEC_CHECK(kd_spec_bloom_bright, id, name)
#define CHECK_GATHER(id, name, value) SPEC_CHECK(kd_spec_bloom_gather, id, name)
#define CHECK_GRID(id, name, value) SPEC_CHECK(kd_spec_bloom_grid, id, name)
#define CHECK_BEAM(id, name, value) SPEC_CHECK(kd_spec_beam, id, name)
#define CHECK_BEAM_BLUR(id, name, value) SPEC_CHECK(kd_spec_beam_blur, id, name)
#define TRAIT(number, name) +1
SPEC(kd_spec_lens_closed, KD_SPEC_LENS_CLOSED, CHECK_CLOSED, )
SPEC(kd_spec_lens_map, KD_SPEC_LENS_MAP, CHECK_MAP, )
SPEC(kd_spec_footprint, KD_SPEC_FOOTPRINT, CHECK_FOOTPRINT, )
SPEC(kd_spec_between, KD_SPEC_BETWEEN, CHECK_BETWEEN, )
SPEC(kd_spec_sample, KD_SPEC_SAMPLE, CHECK_SAMPLE, )
SPEC(kd_spec_fill, KD_SPEC_FILL, CHECK_FILL, )
SPEC(kd_spec_transfer, KD_SPEC_TRANSFER, CHECK_TRANSFER,
     uint32_t traits[KD_EMITTERS(TRAIT, TRAIT, TRAIT, TRAIT, TRAIT, TRAIT)];)
SPEC(kd_spec_rays, KD_SPEC_RAYS, CHECK_RAYS, )
SPEC(kd_spec_particles, KD_SPEC_PARTICLES, CHECK_PARTICLES, )
SPEC(kd_spec_stars, KD_SPEC_STARS, CHECK_STARS, )
SPEC(kd_spec_photometry, KD_SPEC_PHOTOMETRY, CHECK_PHOTOMETRY, )
SPEC(kd_spec_bloom_bright, KD_SPEC_BLOOM_BRIGHT, CHECK_BRIGHT, )
SPEC(kd_spec_bloom_gather, KD_SPEC_BLOOM_GATHER, CHECK_GATHER, )
SPEC(kd_spec_bloom_grid, KD_SPEC_BLOOM_GRID, CHECK_GRID, )
SPEC(kd_spec_post, KD_SPEC_POST, CHECK_POST, )
SPEC(kd_spec_beam, KD_SPEC_BEAM, CHECK_BEAM, )
SPEC(kd_spec_beam_blur, KD_SPEC_BEAM_BLUR, CHECK_BEAM_BLUR, )
_Static_assert(offsetof(struct kd_spec_transfer, traits) == 4 * KD_SPEC_TRAITS,
               "the emitters' words are behind the others");
#undef SPEC_U
#undef SPEC_CHECK
#undef SPEC
#undef CHECK_CLOSED
#undef CHECK_MAP
#undef CHECK_FOOTPRINT
#undef CHECK_BETWEEN
#undef CHECK_SAMPLE
#undef CHECK_FILL
#undef CHECK_TRANSFER
#undef CHECK_RAYS
#undef CHECK_PARTICLES
#undef CHECK_PHOTOMETRY
#undef CHECK_STARS
#undef CHECK_POST
#undef CHECK_BEAM
#undef CHECK_BEAM_BLUR
#undef TRAIT

/* Index of the first plane of one quantity in a lens map with these quantities. kd_lens_planes: the number of all
 * planes. */
static inline uint32_t kd_lens_plane(uint32_t quantities, uint32_t orders, uint32_t quantity)
{
    uint32_t before = quantities & (quantity - 1);
    return (uint32_t)__builtin_popcount(before & KD_LENS_CROSSINGS) * orders +
           (uint32_t)__builtin_popcount(before & ~(uint32_t)KD_LENS_CROSSINGS);
}
static inline uint32_t kd_lens_planes(uint32_t quantities, uint32_t orders)
{
    return kd_lens_plane(quantities, orders, 1u << 31);
}

#endif
