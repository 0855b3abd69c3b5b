/* Colours of black bodies, from tables that do not depend on the scene.
 *
 * Nodes are at the temperatures T = 2^k (1 + m/KD_COLOUR_NODES), which are the floats whose low bits are zero. So the
 * upper bits of a temperature, as a float, are the index of its row. A row holds red and blue of linear sRGB of
 * luminance 1, and their differences to the next node. Green follows from the luminance, 0.2126 r + 0.7152 g + 0.0722 b
 * = 1. */
#ifndef KD_BLOCK_colour
#define KD_BLOCK_colour(F, U, A)
#define KD_COLOUR_NODES 64 /* nodes an octave */
#define KD_COLOUR_SHIFT 17 /* a float has 23 bits of fraction; 6 of them number the nodes */
#define KD_COLOUR_LEAST 64.0
#define KD_COLOUR_LEAST_BITS 0x42800000
#define KD_COLOUR_OCTAVES 24           /* the highest temperature is 1.07e9 K */
#define KD_COLOUR_MOST_BITS 0x4e7fffff /* bits of the largest float below 64 K times 2^24 */
#define KD_COLOUR_ROWS (KD_COLOUR_OCTAVES * KD_COLOUR_NODES)
#define KD_TABLES_colour(T) \
    T(colour, KD_COLOUR_ROWS)   /* red, blue, and the differences of both from this row to the next */ \
    T(luminous, KD_COLOUR_ROWS) /* log2 of the fraction of the radiance that the eye perceives, and the difference to \
                                 * the next row */
#endif

#ifdef KD_EMIT_CODE
struct kd_colour_place {
    uint node;
    float part;
};

kd_colour_place kd_colour_at(float kelvin)
{
    uint bits = clamp(floatBitsToUint(kelvin), KD_COLOUR_LEAST_BITS, KD_COLOUR_MOST_BITS) - KD_COLOUR_LEAST_BITS;
    kd_colour_place o;
    o.node = bits >> KD_COLOUR_SHIFT;
    o.part = float(bits & ((1u << KD_COLOUR_SHIFT) - 1u)) * (1.0 / float(1u << KD_COLOUR_SHIFT));
    return o;
}

/* Linear sRGB of luminance 1. */
vec3 kd_colour_of(kd_colour_place at)
{
    vec4 row = kd_table_row(colour, at.node);
    vec2 c = row.xy + at.part * row.zw;
    return vec3(c.x, max((1.0 - 0.2126 * c.x - 0.0722 * c.y) * (1.0 / 0.7152), 0.0), c.y);
}

float kd_colour_luminous(kd_colour_place at)
{
    vec4 row = kd_table_row(luminous, at.node);
    return row.x + at.part * row.y;
}
#endif
