/* Tests that layouts agree between C and kernels. Offsets and types of the members of push constants and buffers in the
 * SPIR-V are compared with offsetof. */
#include "render/view/layout.h"
#include "render/emit/emitter.h"

#include "beam_blur.spv.h"
#include "beam_gather.spv.h"
#include "beam_spline.spv.h"
#include "beam_spread.spv.h"
#include "bloom_bright.spv.h"
#include "bloom_gather.spv.h"
#include "between.spv.h"
#include "footprint.spv.h"
#include "lens_closed.spv.h"
#include "lens_map.spv.h"
#include "photometry.spv.h"
#include "particles.spv.h"
#include "post.spv.h"
#include "transfer.spv.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

/* SPIR-V 1.5 specification, sections 2.3 and 3: a header of five words, then instructions whose first word has their
 * length and opcode; text is stored from the low end of each word. */
enum {
    OP_NAME = 5,
    OP_MEMBER_NAME = 6,
    OP_TYPE_INT = 21,
    OP_TYPE_FLOAT = 22,
    OP_TYPE_STRUCT = 30,
    OP_MEMBER_DECORATE = 72,
    DECORATION_OFFSET = 35
};

struct spirv {
    const char *kernel;
    const uint32_t *words;
    size_t n;
};
#define SPIRV(name) { #name, kd_spv_##name, sizeof kd_spv_##name / 4 }

/* Finds the next instruction, from *at on, with this opcode and with `id` as its first operand (0: any). Returns NULL
 * at the end. */
static const uint32_t *next(const struct spirv *s, size_t *at, uint32_t opcode, uint32_t id)
{
    while (*at < s->n) {
        const uint32_t *op = s->words + *at;
        if (!(op[0] >> 16))
            fail_msg("%s: an instruction of no length", s->kernel);
        *at += op[0] >> 16;
        if ((op[0] & 0xffff) == opcode && (!id || op[1] == id))
            return op;
    }
    return NULL;
}

/* The struct with the offsets of a buffer. If variables use the struct too, the module has a second copy without
 * offsets. */
static uint32_t struct_called(const struct spirv *s, const char *name)
{
    size_t at = 5;
    for (const uint32_t *op; (op = next(s, &at, OP_NAME, 0));) {
        size_t decorations = 5;
        if (!strcmp((const char *)(op + 2), name) && next(s, &decorations, OP_MEMBER_DECORATE, op[1]))
            return op[1];
    }
    fail_msg("%s: nothing is called %s", s->kernel, name);
    return 0;
}

/* Index of a member, or -1. */
static int member_called(const struct spirv *s, uint32_t id, const char *name)
{
    size_t at = 5;
    for (const uint32_t *op; (op = next(s, &at, OP_MEMBER_NAME, id));)
        if (!strcmp((const char *)(op + 3), name))
            return (int)op[2];
    return -1;
}

static uint32_t member_offset(const struct spirv *s, uint32_t id, int member)
{
    size_t at = 5;
    for (const uint32_t *op; (op = next(s, &at, OP_MEMBER_DECORATE, id));)
        if (op[2] == (uint32_t)member && op[3] == DECORATION_OFFSET)
            return op[4];
    return UINT32_MAX;
}

/* The type of a member: the first operand of OpTypeStruct is the struct itself. */
static uint32_t member_type(const struct spirv *s, uint32_t id, int member, int *count)
{
    size_t at = 5;
    const uint32_t *op = next(s, &at, OP_TYPE_STRUCT, id);
    *count = op ? (int)(op[0] >> 16) - 2 : 0;
    return op && member < *count ? op[2 + member] : 0;
}

static bool is_scalar(const struct spirv *s, uint32_t type, uint32_t opcode)
{
    size_t at = 5;
    const uint32_t *op = next(s, &at, opcode, type);
    return op && op[2] == 32 && (opcode == OP_TYPE_FLOAT || op[3] == 0); /* unsigned */
}

struct field {
    const char *name;
    size_t offset;
    uint32_t opcode;
};

/* Checks that every field of the C struct is at its place in the kernel. `more`: number of the kernel's members that
 * are not in the list. */
static void same(const struct spirv *s, const char *block, const struct field *fields, size_t n, int more)
{
    uint32_t id = struct_called(s, block);
    int count = 0;
    for (size_t i = 0; i < n; i++) {
        int member = member_called(s, id, fields[i].name);
        if (member < 0)
            fail_msg("%s: %s has no %s", s->kernel, block, fields[i].name);
        uint32_t offset = member_offset(s, id, member);
        if (offset != fields[i].offset)
            fail_msg("%s: %s.%s is at %u, C has it at %zu", s->kernel, block, fields[i].name, offset, fields[i].offset);
        if (!is_scalar(s, member_type(s, id, member, &count), fields[i].opcode))
            fail_msg("%s: %s.%s is of another type than in C", s->kernel, block, fields[i].name);
    }
    if (count != (int)n + more)
        fail_msg("%s: %s has %d members, C has %zu and %d", s->kernel, block, count, n, more);
}

#define COUNT(x) (sizeof(x) / sizeof *(x))

#define F(name) { #name, offsetof(struct kd_camera_block, name), OP_TYPE_FLOAT },
#define U(name) { #name, offsetof(struct kd_camera_block, name), OP_TYPE_INT },
static const struct field camera_fields[] = { KD_CAMERA_FIELDS_(F, U) };
#undef F
#undef U
#define F(name) { #name, offsetof(struct kd_slice, name), OP_TYPE_FLOAT },
#define U(name) { #name, offsetof(struct kd_slice, name), OP_TYPE_INT },
static const struct field slice_fields[] = { KD_SLICE_FIELDS_(F, U) };
#undef F
#undef U
#define F(name) { #name, offsetof(struct kd_post_push, name), OP_TYPE_FLOAT },
#define U(name) { #name, offsetof(struct kd_post_push, name), OP_TYPE_INT },
static const struct field post_fields[] = { KD_POST_FIELDS_(F, U) };
#undef F
#undef U
#define F(name) { #name, offsetof(struct kd_bloom_bright_push, name), OP_TYPE_FLOAT },
#define U(name) { #name, offsetof(struct kd_bloom_bright_push, name), OP_TYPE_INT },
static const struct field bright_fields[] = { KD_BLOOM_BRIGHT_FIELDS_(F, U) };
#undef F
#undef U
#define F(name) { #name, offsetof(struct kd_bloom_gather_push, name), OP_TYPE_FLOAT },
#define U(name) { #name, offsetof(struct kd_bloom_gather_push, name), OP_TYPE_INT },
static const struct field gather_fields[] = { KD_BLOOM_GATHER_FIELDS_(F, U) };
#undef F
#undef U
#define F(name) { #name, offsetof(struct kd_beam_push, name), OP_TYPE_FLOAT },
#define U(name) { #name, offsetof(struct kd_beam_push, name), OP_TYPE_INT },
static const struct field beam_fields[] = { KD_BEAM_BAND_FIELDS_(F, U) };
#undef F
#undef U
#define F(name) { #name, offsetof(struct kd_beam_spline_push, name), OP_TYPE_FLOAT },
#define U(name) { #name, offsetof(struct kd_beam_spline_push, name), OP_TYPE_INT },
static const struct field beam_spline_fields[] = { KD_BEAM_SPLINE_FIELDS_(F, U) };
#undef F
#undef U
#define F(name) { #name, offsetof(struct kd_beam_blur_push, name), OP_TYPE_FLOAT },
#define U(name) { #name, offsetof(struct kd_beam_blur_push, name), OP_TYPE_INT },
static const struct field beam_blur_fields[] = { KD_BEAM_BLUR_FIELDS_(F, U) };
#undef F
#undef U
#define F(name) { #name, offsetof(struct kd_light_push, name), OP_TYPE_FLOAT },
#define U(name) { #name, offsetof(struct kd_light_push, name), OP_TYPE_INT },
static const struct field light_fields[] = { KD_LIGHT_FIELDS_(F, U) };
#undef F
#undef U
#define F(name) { #name, offsetof(struct kd_footprint_push, name), OP_TYPE_FLOAT },
#define U(name) { #name, offsetof(struct kd_footprint_push, name), OP_TYPE_INT },
static const struct field footprint_fields[] = { KD_FOOTPRINT_FIELDS_(F, U) };
#undef F
#undef U
#define F(name) { #name, offsetof(struct kd_between_push, name), OP_TYPE_FLOAT },
#define U(name) { #name, offsetof(struct kd_between_push, name), OP_TYPE_INT },
static const struct field between_fields[] = { KD_BETWEEN_FIELDS_(F, U) };
#undef F
#undef U
#define F(name) { #name, offsetof(struct kd_particles_push, name), OP_TYPE_FLOAT },
#define U(name) { #name, offsetof(struct kd_particles_push, name), OP_TYPE_INT },
static const struct field particles_fields[] = { KD_PARTICLES_FIELDS_(F, U) };
#undef F
#undef U
#define F(name) { #name, offsetof(struct kd_guide, name), OP_TYPE_FLOAT },
#define U(name) { #name, offsetof(struct kd_guide, name), OP_TYPE_INT },
static const struct field guide_fields[] = { KD_GUIDE_FIELDS_(F, U) };

static const struct spirv transfer = SPIRV(transfer), post = SPIRV(post), bloom_bright = SPIRV(bloom_bright),
                          bloom_gather = SPIRV(bloom_gather), particles = SPIRV(particles), light = SPIRV(photometry),
                          footprint = SPIRV(footprint), between = SPIRV(between);

static void camera(void **state)
{
    (void)state;
    const struct spirv kernels[] = { SPIRV(lens_closed), SPIRV(lens_map), transfer };
    for (size_t i = 0; i < COUNT(kernels); i++) {
        same(&kernels[i], "kd_camera_block", camera_fields, COUNT(camera_fields), 0);
        same(&kernels[i], "kd_slice", slice_fields, COUNT(slice_fields), 0);
    }
    assert_int_equal(sizeof(struct kd_camera_block), 4 * COUNT(camera_fields)); /* no padding */
    assert_int_equal(sizeof(struct kd_slice), 4 * COUNT(slice_fields));
}

static void post_push(void **state)
{
    (void)state;
    same(&post, "Push", post_fields, COUNT(post_fields), 0);
    assert_int_equal(sizeof(struct kd_post_push), 4 * COUNT(post_fields));
    same(&bloom_bright, "Push", bright_fields, COUNT(bright_fields), 0);
    same(&bloom_gather, "Push", gather_fields, COUNT(gather_fields), 0);
    assert_int_equal(sizeof(struct kd_bloom_bright_push), 4 * COUNT(bright_fields));
    assert_int_equal(sizeof(struct kd_bloom_gather_push), 4 * COUNT(gather_fields));
}

static void beam_push(void **state)
{
    (void)state;
    const struct spirv bands[] = { SPIRV(beam_gather), SPIRV(beam_spread) }, spline = SPIRV(beam_spline),
                       blur = SPIRV(beam_blur);
    for (size_t i = 0; i < COUNT(bands); i++)
        same(&bands[i], "Push", beam_fields, COUNT(beam_fields), 0);
    same(&spline, "Push", beam_spline_fields, COUNT(beam_spline_fields), 0);
    same(&blur, "Push", beam_blur_fields, COUNT(beam_blur_fields), 0);
    assert_int_equal(sizeof(struct kd_beam_push), 4 * COUNT(beam_fields));
    assert_int_equal(sizeof(struct kd_beam_spline_push), 4 * COUNT(beam_spline_fields));
    assert_int_equal(sizeof(struct kd_beam_blur_push), 4 * COUNT(beam_blur_fields));
}

static void light_push(void **state)
{
    (void)state;
    same(&light, "Push", light_fields, COUNT(light_fields), 0);
    assert_int_equal(sizeof(struct kd_light_push), 4 * COUNT(light_fields));
}

static void footprint_push(void **state)
{
    (void)state;
    same(&footprint, "kd_footprint", footprint_fields, COUNT(footprint_fields), 0);
    assert_int_equal(sizeof(struct kd_footprint_push), 4 * COUNT(footprint_fields));
}

static void between_push(void **state)
{
    (void)state;
    same(&between, "kd_between", between_fields, COUNT(between_fields), 0);
    assert_int_equal(sizeof(struct kd_between_push), 4 * COUNT(between_fields));
}

static void particles_kernel(void **state)
{
    (void)state;
    same(&particles, "Push", particles_fields, COUNT(particles_fields), 0);
    same(&particles, "kd_guide", guide_fields, COUNT(guide_fields), 0);
    assert_int_equal(sizeof(struct kd_particles_push), 4 * COUNT(particles_fields));
    assert_int_equal(sizeof(struct kd_guide), 4 * COUNT(guide_fields));
}

/* Checks the blocks of all emitters: their members, and the offsets of the blocks. A list in a block ends in an unnamed
 * element and may have only arrays; the elements are checked separately. */
#undef F
#undef U
#define F(name) { #name, offsetof(BLOCK, name), OP_TYPE_FLOAT },
#define U(name) { #name, offsetof(BLOCK, name), OP_TYPE_INT },
#define A(type, name, count)
#define NONE(name)
#define ONE(type, name, count) +1
#define SAME(number, name) \
    static void same_##name(void) \
    { \
        typedef struct kd_##name##_block BLOCK; \
        _Static_assert(sizeof(BLOCK), "it has members"); \
        const struct field fields[] = { KD_BLOCK_##name(F, U, A) { NULL, 0, 0 } }; \
        if (COUNT(fields) > 1) \
            same(&transfer, "kd_" #name "_block", fields, COUNT(fields) - 1, 0 KD_BLOCK_##name(NONE, NONE, ONE)); \
    }
KD_EMIT_BLOCKS(SAME)

static void emission(void **state)
{
    (void)state;
    typedef struct kd_spot_block BLOCK;
    const struct field spot[] = { KD_BLOCK_spot(F, U) };
    same(&transfer, "kd_spot_block", spot, COUNT(spot), 0);
    uint32_t id = struct_called(&transfer, "Emission");
#define WHERE(number, name) \
    same_##name(); \
    assert_int_equal(member_offset(&transfer, id, member_called(&transfer, id, #name)), \
                     offsetof(struct kd_emission, name));
    KD_EMIT_BLOCKS(WHERE)
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(camera),           cmocka_unit_test(post_push),      cmocka_unit_test(beam_push),
        cmocka_unit_test(light_push),       cmocka_unit_test(footprint_push), cmocka_unit_test(between_push),
        cmocka_unit_test(particles_kernel), cmocka_unit_test(emission),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
