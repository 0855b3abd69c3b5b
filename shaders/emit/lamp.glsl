/* The light of a lamp on the axis, as the gas of the plane receives it. No light of its own: the flash reads the
 * table. */
#ifndef KD_BLOCK_lamp
#define KD_LAMP_TABLE 512
/* clang-format off */
#define KD_BLOCK_lamp(F, U, A) \
    F(first) F(per_row)    /* ln r of the first row; rows for each unit of ln r */
/* clang-format on */
/* lamp: for light that goes from the lamp to r, the coordinate time minus r, and its difference to the next row. Then
 * r^3 times the light that the gas receives, divided by the largest on the disk, and its difference to the next row. */
#define KD_TABLES_lamp(T) T(lamp, KD_LAMP_TABLE)
#define KD_TRAITS_lamp(T)
#define KD_BUFFERS_lamp(B)
#define KD_PASS_lamp(P)
#endif

#ifdef KD_EMIT_CODE
/* Time of the light from the lamp to r = 1/w, minus r; and the light received there. */
vec2 kd_lamp_at(float w)
{
    float at = max((-log(w) - emission.lamp.first) * emission.lamp.per_row, 0.0);
    uint row = min(uint(at), KD_LAMP_TABLE - 2u);
    vec4 f = kd_table_row(lamp, row);
    float x = at - float(row);
    return vec2(f.x + x * f.y, (f.z + x * f.w) * w * w * w);
}
#endif
