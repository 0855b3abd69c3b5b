/* The light of a lamp on the axis, as the gas of the plane receives it. This emitter has no light of its own; the flash
 * reads its table. */
#ifndef KD_BLOCK_lamp
#define KD_LAMP_TABLE 512
/* clang-format off */
#define KD_BLOCK_lamp(F, U, A) \
    F(first) F(per_row)    /* ln r of the table's first row; number of rows per unit of ln r */
/* clang-format on */
/* The table `lamp` holds four numbers for each r. The first is the coordinate time of light from the lamp to r, minus
 * r. The third is r^3 times the light that the gas receives, divided by its largest value on the disk. The second and
 * the fourth are the differences of these two from this row to the next. */
#define KD_TABLES_lamp(T) T(lamp, KD_LAMP_TABLE)
#define KD_TRAITS_lamp(T)
#define KD_BUFFERS_lamp(B)
#define KD_PASS_lamp(P)
#endif

#ifdef KD_EMIT_CODE
/* The table's values at r = 1/w: the time of the light from the lamp minus r, and the light that the gas receives. */
vec2 kd_lamp_at(float w)
{
    float at = max((-log(w) - emission.lamp.first) * emission.lamp.per_row, 0.0);
    uint row = min(uint(at), KD_LAMP_TABLE - 2u);
    vec4 f = kd_table_row(lamp, row);
    float x = at - float(row);
    return vec2(f.x + x * f.y, (f.z + x * f.w) * w * w * w);
}
#endif
