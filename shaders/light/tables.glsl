/* Tables of all emitters for the kernels of light, at binding 2. Needs shared/emitters.h. */
#ifndef KD_TABLES_GLSL
#define KD_TABLES_GLSL

layout(set = 0, binding = 2) uniform textureBuffer tables;
/* Index, in `tables`, of each table's first row; computed at compile time. */
#define KD_T(table, rows) uint table;
struct kd_table_places { KD_EMIT_TABLES };
#undef KD_T
#define KD_T(table, rows) \
    at.table = end; \
    end += rows;
kd_table_places kd_tables()
{
    kd_table_places at;
    uint end = 0u;
    KD_EMIT_TABLES
    return at;
}
/* The offsets are computed once in a kernel. Otherwise the driver would fold the constants again at each read. */
kd_table_places kd_table_at = kd_tables();
/* A row of a table, by the table's name. */
#define kd_table_row(table, row) texelFetch(tables, int(kd_table_at.table + (row)))

#endif
