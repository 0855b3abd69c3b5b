/* Numbers and tables of all emitters for the kernels of light: the C side of shaders/shared/emitters.h. */
#ifndef KD_RENDER_EMIT_EMISSION_H
#define KD_RENDER_EMIT_EMISSION_H

#include "emitters.h"

#include <stddef.h>
#include <stdint.h>

#define F(name) float name;
#define U(name) uint32_t name;
#define A(type, name, count) struct type name[count];
#define BLOCK(number, name) \
    struct kd_##name##_block { KD_BLOCK_##name(F, U, A) };
#define MEMBER(number, name) _Alignas(16) struct kd_##name##_block name;
struct kd_spot_block { KD_BLOCK_spot(F, U) };
KD_EMIT_BLOCKS(BLOCK)
/* The layout is that of std140: each block begins at a multiple of 16 bytes. */
struct kd_emission { KD_EMIT_BLOCKS(MEMBER) };
#undef F
#undef U
#undef A
#undef BLOCK
#undef MEMBER
_Static_assert(sizeof(struct kd_spot_block) % 16 == 0,
               "std140: the size of an array element must be a multiple of 16 bytes");

/* Tables are read as texels. On lavapipe, reading four floats then costs as much as reading one word of a storage
 * buffer. */
typedef float kd_table_row[4];
#define KD_T(table, rows) kd_table_row table[rows];
struct kd_emit_tables { KD_EMIT_TABLES };
#undef KD_T
#define KD_T(table, rows) +(rows)
_Static_assert(sizeof(struct kd_emit_tables) == sizeof(kd_table_row) * (0 KD_EMIT_TABLES),
               "tables must have no gaps, because the kernels address them by row number");
#undef KD_T

/* Checks that no two traits share a bit of a word. If two did, the sum of all traits would differ from their bitwise
 * or. */
#define ADDED(trait) +(uint64_t)KD_TRAIT_##trait
#define JOINED(trait) | KD_TRAIT_##trait
#define DISJOINT(number, name) \
    _Static_assert(KD_TRAIT_PRESENT KD_TRAITS_##name(ADDED) == (KD_TRAIT_PRESENT KD_TRAITS_##name(JOINED)), \
                   "traits must not share a bit: " #name);
KD_EMITTERS(DISJOINT, DISJOINT, DISJOINT, DISJOINT, DISJOINT, DISJOINT)
#undef ADDED
#undef JOINED
#undef DISJOINT

/* Numbers of the buffers that emitters fill on the device: KD_OWN_density and so on. */
#define KD_B(number, type, member) KD_OWN_##member = number,
enum { KD_EMIT_BUFFERS };
#undef KD_B
#define KD_B(number, type, member) +1
enum { KD_OWN_COUNT = 0 KD_EMIT_BUFFERS };
#undef KD_B
_Static_assert(KD_LIGHT_BINDING == KD_OWN_BINDING + KD_OWN_point_light,
               "KD_LIGHT_BINDING in shaders/shared/emitters.h must be the binding of point_light");
#define KD_B(number, type, member) +(1 << number)
_Static_assert((0 KD_EMIT_BUFFERS) == (1 << KD_OWN_COUNT) - 1,
               "the numbers of the buffers must be 0, 1, 2, ..., each used once");
#undef KD_B

/* Numbers and tables are in one buffer, numbers first. */
struct kd_emit_data {
    struct kd_emission emission;
    char gap[256 - sizeof(struct kd_emission) % 256];
    struct kd_emit_tables tables;
};
_Static_assert(
    offsetof(struct kd_emit_data, tables) % 256 == 0,
    "the offset must be a multiple of 256 bytes, the largest alignment that a device may require of a binding");
_Static_assert(sizeof(struct kd_emit_tables) / sizeof(kd_table_row) <= 65536,
               "tables must have at most 65536 texels, the number that every device can bind");

#endif
