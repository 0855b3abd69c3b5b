/* Light spread by a lens to a point of the picture; shared by bloom_*.comp and post.comp.
 *
 * Spread light is on a grid of cells that covers the picture exactly, a vec4 for each cell, rows from the top. Beyond
 * the edge the grid is its own mirror image: light that would leave the picture stays at its edge. In a picture of all
 * directions the left and right edges adjoin. */
#ifndef KD_BLOOM_GLSL
#define KD_BLOOM_GLSL

/* Limits of spreading, in units of white, which is the light that the exposure maps to 1. FROM: light above this value
 * may be spread. KNEE: half the width of the transition about FROM. MOST: the most light that is spread from one place.
 * Light near white is included, because the film-like curve shows the brightest parts of many pictures there. */
#define KD_BLOOM_FROM 0.6
#define KD_BLOOM_KNEE 0.4
#define KD_BLOOM_MOST 64.0

/* The part of exposed light c that a lens spreads. strength: the spread fraction of bright light. With the luminance y
 * of c, nothing is spread if y is below FROM - KNEE. If y is above FROM + KNEE, the light above FROM is spread. Between
 * these values the part is a parabola in y. If y is 10^30 or more, or NaN, nothing is spread. */
vec3 bloom_of(vec3 c, float strength)
{
    float y = 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b;
    float knee = clamp(y - (KD_BLOOM_FROM - KD_BLOOM_KNEE), 0.0, 2 * KD_BLOOM_KNEE);
    float over = min(max(knee * knee / (4 * KD_BLOOM_KNEE), y - KD_BLOOM_FROM), KD_BLOOM_MOST);
    return over > 0 && y < 1e30 ? c * (strength * over / y) : vec3(0);
}

/* Weights of a quadratic B-spline on three cells. t: distance from the centre of the second cell, in cells. */
vec3 bloom_spline(float t) { return vec3(0.5 * (0.5 - t) * (0.5 - t), 0.75 - t * t, 0.5 * (0.5 + t) * (0.5 + t)); }

/* The weight of a cell for a place at the distance t from its centre; one of the three weights of bloom_spline. */
float bloom_weight(float t)
{
    float a = max(1.5 - abs(t), 0.0), b = max(0.5 - abs(t), 0.0);
    return 0.5 * a * a - 1.5 * b * b;
}

/* Column and row of invocation n, if a row has `across` invocations. The row is a quotient in floats, which may be
 * wrong by one, as rows reach 2^15; the code corrects it. */
uvec2 bloom_place(uint n, uint across)
{
    int width = int(across), y = int(float(n) * (1 / float(width))), x = int(n) - y * width;
    int more = x >= width ? 1 : x < 0 ? -1 : 0;
    return uvec2(x - more * width, y + more);
}

/* Index of cell i in n cells that are mirrored at their edges, for i from -1 to n. */
int bloom_mirror(int i, int n) { return clamp(i, 0, n - 1); }

/* bloom_mirror for a column i from -2n on. If `around` is true, the picture shows all directions, and columns wrap
 * round instead. */
int bloom_column(int i, int n, bool around) { return around ? (i + 2 * n) % n : bloom_mirror(i, n); }

#endif
