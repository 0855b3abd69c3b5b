/* Matter on a grid of nodes. Values are interpolated linearly in log r, in columns of theta, in phi and in time. The
 * buffer plasma_grid holds one or two quads for each node of each frame, and then the table of uneven columns
 * (src/render/emit/matter_grid.h). emit/plasma.glsl includes this file. */

/* Interpolated values. matter: log2 of density, log2 of Theta, u^r, and r u^theta. rest: u_phi/(r sin^2 theta), and the
 * field's b^r, r b^theta and b_phi/(r sin^2 theta) in the grid's unit. */
struct kd_grid_node { vec4 matter, rest; };

const bool KD_GRID_SERIES = (TRAITS_plasma & KD_TRAIT_PLASMA_SERIES) != 0u,
           KD_GRID_SLOW = (TRAITS_plasma & KD_TRAIT_SLOW) != 0u;
const bool KD_GRID_TEXELS = (TRAITS_plasma & KD_TRAIT_TEXELS) != 0u;
uvec4 kd_grid_quad(uint at) { return KD_GRID_TEXELS ? texelFetch(plasma_texels, int(at)) : plasma_grid[at]; }

kd_grid_node kd_grid_whole(uint node)
{
    return kd_grid_node(uintBitsToFloat(kd_grid_quad(2u * node)), uintBitsToFloat(kd_grid_quad(2u * node + 1u)));
}

/* Reads a packed node. It holds density and Theta as fractions of their ranges, in 16 bits each, and six half floats.
 */
kd_grid_node kd_grid_packed(uint node)
{
    uvec4 words = kd_grid_quad(node);
    vec2 heat = unpackUnorm2x16(words.x), out_down = unpackHalf2x16(words.y), third = unpackHalf2x16(words.z),
         last = unpackHalf2x16(words.w);
    return kd_grid_node(vec4(emission.plasma.grid_density + emission.plasma.grid_densities * heat.x,
                             emission.plasma.grid_heat + emission.plasma.grid_heats * heat.y,
                             emission.plasma.grid_speed * out_down),
                        vec4(emission.plasma.grid_speed * third.x, emission.plasma.grid_scale * vec3(third.y, last)));
}

void kd_grid_add(inout kd_grid_node sum, kd_grid_node one, float weight)
{
    sum.matter += weight * one.matter;
    sum.rest += weight * one.rest;
}

/* Difference of azimuths: phi of ingoing Kerr-Schild coordinates minus Boyer-Lindquist phi. It is int a/Delta dr =
 * a/(r+ - r-) ln((r - r+)/(r - r-)) = -a/(r - 1) artanh(x)/x, with x = (r+ - 1)/(r - 1). */
float kd_grid_fallen(float r)
{
    float x = min(cam.root / max(r - 1.0, 1e-6), 0.999999), x2 = x * x;
    return -emission.plasma.grid_fall / max(r - 1.0, 1e-6) *
           (x2 < 0.01 ? 1.0 + x2 * (1.0 / 3.0 + 0.2 * x2) : atanh(x) / x);
}

/* Difference of times: time of ingoing Kerr-Schild coordinates minus Boyer-Lindquist time. The advanced time v has dv =
 * dt + dr (r^2 + a^2)/Delta (B. Carter 1968, Phys. Rev. 174, 1559), and the time of Kerr-Schild coordinates is v - r.
 * The difference is int (2r - q^2)/Delta dr = ln(Delta/4) + (2 - q^2) int dr/Delta, because Delta' = 2r - 2. Without
 * spin and charge it is 2 ln(r/2 - 1). This difference decreases without bound towards the horizon. The Boyer-Lindquist
 * time at which light left does the same. The two are added, so there is no cancellation. */
float kd_grid_later(float w) { return kd_log(0.25 * kd_horizons(w, cam.root) / (w * w)) - kd_late(w); }

/* Number of the frame at a place, with a fraction between two frames. It is kept between the first and the last frame.
 */
float kd_grid_frame(kd_midst p)
{
    float at = emission.plasma.grid_now;
    if (KD_GRID_SLOW) {
        float ago = p.ago;
        /* a loop is used instead of an if, for the reason given below */
        for (uint n = 0u; n < (emission.plasma.grid_late > 0.0 ? 1u : 0u); n++)
            ago -= kd_grid_later(p.w);
        at -= emission.plasma.grid_per_time * ago;
    }
    return at > 0.0 ? min(at, float(emission.plasma.grid_frames - 1u)) : 0.0;
}

/* Row and column at a place, both with fractions, and the number of columns per radian of theta there. */
struct kd_grid_place { float row, column, per_theta; };
kd_grid_place kd_grid_place_at(kd_midst p, float log2_r)
{
    uvec2 most = uvec2(emission.plasma.grid_rows, emission.plasma.grid_columns) - 1u;
    float theta = kd_atan2(sqrt(max(1.0 - p.u * p.u, 0.0)), p.u);
    kd_grid_place at;
    at.row = clamp((log2_r - emission.plasma.grid_r) * emission.plasma.grid_per_r, 0.0, float(most.x));
    at.column = clamp((theta - emission.plasma.grid_theta) * emission.plasma.grid_per_theta, 0.0, float(most.y));
    at.per_theta = emission.plasma.grid_per_theta;
    /* lavapipe skips the rounds of a loop that are not needed, but executes both branches of an if */
    for (uint n = 0u; n < min(emission.plasma.grid_steps, 1u); n++) {
        float steps = float(emission.plasma.grid_steps), row = min(floor(at.row), float(most.x - 1u)),
              x = clamp(theta * (steps / KD_PI), 0.0, steps), cell = min(floor(x), steps - 1.0);
        uint line = uint(min(row, float(emission.plasma.grid_place_rows - 1u))),
             quads = (2u - emission.plasma.grid_packed) * emission.plasma.grid_rows * emission.plasma.grid_columns *
                     emission.plasma.grid_layers * (KD_GRID_SERIES ? emission.plasma.grid_frames : 1u);
        vec4 corners = uintBitsToFloat(kd_grid_quad(quads + line * emission.plasma.grid_steps + uint(cell)));
        vec2 ends = mix(corners.xy, corners.zw, at.row - row);
        at.column = mix(ends.x, ends.y, x - cell);
        at.per_theta = max(ends.y - ends.x, 0.0) * (steps / KD_PI);
    }
    return at;
}

/* Weighted sum of the nodes at the corners of a cell, in the two layers next to the place and in the two frames about
 * its time. node: function that reads a node. */
#define KD_GRID_SUM(node, times) \
    for (uint m = 0u; m < (times); m++) { \
        uint n = KD_GRID_SERIES && m >= rounds ? m - rounds : m, k = first + n, from = at + (k < layers ? k : 0u); \
        vec4 w = weights * (layers == 1u ? 1.0 : n == 0u ? 1.0 - past : past); \
        if (KD_GRID_SERIES) { \
            w *= m < rounds ? 1.0 - later : later; \
            from += m < rounds ? 0u : row * emission.plasma.grid_rows; \
        } \
        kd_grid_add(sum, node(from), w.x); \
        kd_grid_add(sum, node(from + row), w.y); \
        kd_grid_add(sum, node(from + layers), w.z); \
        kd_grid_add(sum, node(from + layers + row), w.w); \
    }

kd_grid_node kd_grid_at(kd_midst p, float log2_r)
{
    kd_grid_place place = kd_grid_place_at(p, log2_r);
    vec2 most = vec2(float(emission.plasma.grid_rows - 1u), float(emission.plasma.grid_columns - 1u)),
         x = vec2(place.row, place.column), cell = min(floor(x), most - 1.0), part = x - cell;
    uint layers = emission.plasma.grid_layers, row = layers * emission.plasma.grid_columns,
         at = uint(cell.x) * row + uint(cell.y) * layers, rounds = min(layers, 2u);
    float turned = (p.phi + emission.frame.azimuth + kd_grid_fallen(1.0 / p.w) - emission.plasma.grid_phi) *
                   emission.plasma.grid_per_phi,
          layer = floor(turned), past = turned - layer;
    uint first = uint(clamp(layer - floor(layer / float(layers)) * float(layers), 0.0, float(layers - 1u)));
    float later = 0.0;
    uint times = rounds;
    if (KD_GRID_SERIES) {
        float moment = kd_grid_frame(p), frame = min(floor(moment), float(max(emission.plasma.grid_frames, 2u) - 2u));
        later = moment - frame;
        at += uint(frame) * row * emission.plasma.grid_rows;
        times *= later > 0.0 ? 2u : 1u;
    }
    kd_grid_node sum = kd_grid_node(vec4(0.0), vec4(0.0));
    vec4 weights = vec4(1.0 - part.x, part.x, 1.0 - part.x, part.x) * vec4(1.0 - part.yy, part.yy);
    /* two loops are used instead of an if, for the reason given above; one of them has no rounds */
    KD_GRID_SUM(kd_grid_whole, emission.plasma.grid_packed == 0u ? times : 0u)
    KD_GRID_SUM(kd_grid_packed, emission.plasma.grid_packed == 0u ? 0u : times)
    return sum;
}

/* The edges of cells are visible in the light, so a grain covers at most KD_GRID_CELLS. The grain is at least half of
 * one of the finest rows that a grid may have. Columns and layers next to the axis are finer, but do not shorten the
 * grain. With slow light, frames are edges as well; their distance along the ray is estimated as if the light moved
 * along the radius. */
float kd_grid_grain(kd_midst p, float sharp)
{
    float r = 1.0 / p.w, s2 = max(1.0 - p.u * p.u, 1e-4);
    float cells = KD_LOG2_E * abs(p.dw) * r * emission.plasma.grid_per_r +
                  abs(p.du) * inversesqrt(s2) * kd_grid_place_at(p, -log2(p.w)).per_theta +
                  abs(p.momentum) / s2 * emission.plasma.grid_per_phi;
    if (KD_GRID_SLOW)
        cells += p.speed * emission.plasma.grid_per_time / max(kd_horizons(p.w, cam.root), 0.05);
    return max(min(r / (4.0 + sharp), KD_GRID_CELLS * p.speed / max(cells, 1e-12)), r / 2048.0);
}
