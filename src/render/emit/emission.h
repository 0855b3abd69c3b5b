/* The kernels of light read this: numbers and tables of all emitters. It is the C side of shaders/shared/emitters.h. */
#ifndef KD_RENDER_EMIT_EMISSION_H
#define KD_RENDER_EMIT_EMISSION_H

#include "emitters.h"

#include <stddef.h>
#include <stdint.h>

#define F(name) float name;
#define U(name) uint32_t name;
#define A(type, name, count) struct type name[count];
#define BLOCK(number, name) struct kd_##name##_block { KD_BLOCK_##name(F, U, A) };
#define MEMBER(number, name) _Alignas(16) struct kd_##name##_block name;
struct kd_spot_block { KD_BLOCK_spot(F, U) };
KD_EMIT_BLOCKS(BLOCK)
/* The layout is that of std140: the blocks begin at multiples of 16 bytes. */
struct kd_emission { KD_EMIT_BLOCKS(MEMBER) };
#undef F
#undef U
#undef A
#undef BLOCK
#undef MEMBER
_Static_assert(sizeof(struct kd_spot_block) % 16 == 0, "elements of an array, by std140");

/* Tables are read as texels: on lavapipe those come four at the price of one of a storage buffer's words. */
typedef float kd_table_row[4];
#define T(name, first, rows) kd_table_row name[rows];
struct kd_emit_tables { KD_EMIT_TABLES(T) };
#undef T
#define T(name, first, rows) _Static_assert(offsetof(struct kd_emit_tables, name) == sizeof(kd_table_row) * (first), "a table's first row");
KD_EMIT_TABLES(T)
#undef T

/* Both lie in one buffer, the tables behind the numbers. */
struct kd_emit_data {
    struct kd_emission emission;
    char gap[256 - sizeof(struct kd_emission) % 256];
    struct kd_emit_tables tables;
};
_Static_assert(offsetof(struct kd_emit_data, tables) % 256 == 0, "no device asks for more of a binding's offset");
_Static_assert(sizeof(struct kd_emit_tables) / sizeof(kd_table_row) <= 65536, "texels that every device can bind");

#endif
