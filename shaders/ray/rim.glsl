/* The rim of the shadow: rays next to the critical curve (src/render/view/rim.h) on several grids (rim_grid.h). Images
 * of stars of all orders are found between these rays. The rim has binding 7. This file needs sky_map.glsl, camera.glsl
 * and the specialisation constant RIM. If RIM is 0, there is no rim. If it is 1, the rays are the picture's, and images
 * next to the curve are left to the rim. If it is 2, the rays are those of a grid of the rim. */
#ifndef KD_RIM_GLSL
#define KD_RIM_GLSL

layout(set = 0, binding = 7) readonly buffer Rim
{
    float rim[];
    /* distance of the curve from the middle for each angle; from index push.rim on, the table of the current grid
     */
};

const bool AT_RIM = RIM == 2u;

/* Direction of the camera's ray at a place of the picture. At infinity its components are alpha and beta. */
vec3 kd_camera_look(vec2 place)
{
    float x = place.x - cam.middle_x, y = cam.middle_y - place.y, ahead = kd_camera_ahead(x, y);
    return ahead * vec3(cam.c0x, cam.c0y, cam.c0z) + x * vec3(cam.cxx, cam.cxy, cam.cxz) +
           y * vec3(cam.cyx, cam.cyy, cam.cyz);
}

/* Where the camera sees a direction. place: place in the picture. steps: squared steps of the picture per unit of area
 * on the rim's plane, which is perpendicular to `ahead`; 0 for a direction behind a pinhole. */
struct kd_seen {
    vec2 place;
    float steps;
};

kd_seen kd_camera_seen(vec3 d)
{
    vec3 c0 = vec3(cam.c0x, cam.c0y, cam.c0z), cx = vec3(cam.cxx, cam.cxy, cam.cxz),
         cy = vec3(cam.cyx, cam.cyy, cam.cyz);
    vec2 middle = vec2(cam.middle_x, cam.middle_y);
    if (SIGHT == KD_SIGHT_PLANE)
        return kd_seen(middle + vec2(dot(d - c0, cx), -dot(d - c0, cy)) / dot(cx, cx), 1.0 / dot(cx, cx));
    float depth = dot(d, c0), right = dot(d, cx), up = dot(d, cy), length2 = dot(d, d), all = sqrt(length2),
          solid = 1.0 / (length2 * all);
    if (SIGHT == KD_SIGHT_PINHOLE) {
        float ahead = max(depth, 1e-6), c = ahead / all;
        return kd_seen(depth > 1e-6 ? middle + vec2(right, -up) / (ahead * dot(cx, cx)) : vec2(-1e6),
                       solid / (dot(cx, cx) * c * c * c));
    }
    float quarter = 0.5 * KD_PI;
    if (SIGHT == KD_SIGHT_SPHERE) {
        float level = sqrt(right * right + depth * depth);
        vec2 angles = vec2(kd_atan2(right, depth), -kd_atan2(up, level));
        return kd_seen(middle + angles / (quarter * vec2(cam.turn_x, cam.turn_y)),
                       solid * all / (quarter * quarter * cam.turn_x * cam.turn_y * max(level, 1e-6)));
    }
    float lateral = sqrt(right * right + up * up), off = kd_atan2(lateral, depth), unit = off / (quarter * cam.turn_x);
    vec2 towards = lateral > 0.0 ? vec2(right, -up) / lateral : vec2(0.0);
    return kd_seen(middle + unit * towards,
                   solid * off * all / (quarter * quarter * cam.turn_x * cam.turn_x * max(lateral, 1e-6)));
}

vec3 kd_rim_ahead() { return vec3(push.ahead_x, push.ahead_y, push.ahead_z); }
vec3 kd_rim_right() { return vec3(push.right_x, push.right_y, push.right_z); }
vec3 kd_rim_up() { return vec3(push.up_x, push.up_y, push.up_z); }

/* Place of a direction on the rim's plane. */
vec2 kd_rim_place(vec3 d)
{
    float depth = dot(d, kd_rim_ahead());
    if (SIGHT == KD_SIGHT_PLANE)
        return d.xy - kd_rim_ahead().xy;
    return depth > 1e-6 ? vec2(dot(d, kd_rim_right()), dot(d, kd_rim_up())) / depth : vec2(1e6);
}

/* Fraction of an image's light that the rim contributes at a place. */
float kd_rim_share(vec2 place)
{
    float angle = kd_atan2(place.y, place.x) * (float(KD_RIM_EDGES) / (2.0 * KD_PI)), low = floor(angle);
    uint i = uint(int(low) + KD_RIM_EDGES) % KD_RIM_EDGES;
    float edge = mix(rim[i], rim[(i + 1u) % KD_RIM_EDGES], angle - low), off = length(place) / edge - 1.0;
    return clamp((push.none - off) / (push.none - push.full), 0.0, 1.0);
}

/* The quartic through five values at -2 ... 2: coefficients of x, x^2 and x^3. The constant and the term of fourth
 * order are not needed. */
struct kd_quartic { vec2 x, xx, xxx; };

kd_quartic kd_quartic_of(vec2 p2, vec2 p1, vec2 o, vec2 n1, vec2 n2)
{
    vec2 far = n2 - p2, near = n1 - p1;
    return kd_quartic((8.0 * near - far) * (1.0 / 12.0), (16.0 * (n1 + p1) - (n2 + p2) - 30.0 * o) * (1.0 / 24.0),
                      (far - 2.0 * near) * (1.0 / 12.0));
}

/* A point of a grid, at the place p in the cell (x, y). place: its place on the rim's plane. d: its direction. area:
 * area of the cell on the plane. */
struct kd_rim_cell {
    vec2 place;
    vec3 d;
    float area;
};

/* For a column of the grid: the point of the curve, and the curve's derivative there. */
struct kd_rim_column { vec2 at, by; };

kd_rim_column kd_rim_curve(uint k)
{
    uint i = push.rim + 6u + 4u * k;
    return kd_rim_column(vec2(rim[i], rim[i + 1u]), vec2(rim[i + 2u], rim[i + 3u]));
}

/* The point at p in the cell (x, y). Between columns the derivative of the curve is interpolated as a parabola. */
kd_rim_cell kd_rim_cell_at(uint x, uint y, vec2 p)
{
    kd_rim_column own = kd_rim_curve(x);
    vec2 before = kd_rim_curve(x == 0u ? 0u : x - 1u).by, after = kd_rim_curve(min(x + 1u, push.width - 1u)).by,
         b = 0.5 * (after - before), c = 0.5 * (after + before) - own.by;
    vec2 at = own.at + p.x * (own.by + p.x * (0.5 * b + p.x * (1.0 / 3.0) * c)), along = own.by + p.x * (b + p.x * c);
    float off = push.far * exp(-push.fall * (float(y) + p.y));
    kd_rim_cell o;
    o.place = (1.0 + off) * at;
    o.area = abs(along.x * at.y - along.y * at.x) * (1.0 + off) * push.fall * off;
    o.d = SIGHT == KD_SIGHT_PLANE ? kd_rim_ahead() + vec3(o.place, 0.0)
                                  : kd_rim_ahead() + o.place.x * kd_rim_right() + o.place.y * kd_rim_up();
    return o;
}

/* The share that the current grid has of the light of an image. at: column and row of the image. If `within` is above
 * 0, the result is an upper bound of the shares of all images at most that far from the place. */
float kd_rim_part(vec2 at, float within)
{
    vec2 low = (at + within - vec2(rim[push.rim], rim[push.rim + 3u])),
         high = (vec2(rim[push.rim + 1u], rim[push.rim + 4u]) - at + within),
         by = vec2(rim[push.rim + 2u], rim[push.rim + 5u]);
    vec2 share = clamp(low * by + 0.5, 0.0, 1.0) * clamp(high * by + 0.5, 0.0, 1.0);
    return share.x * share.y;
}

/* The area of the picture, in squared steps, that the ray at (x, y) of the current map stands for. */
float kd_steps_of(uint x, uint y)
{
    if (!AT_RIM)
        return 1.0;
    kd_rim_cell cell = kd_rim_cell_at(x, y, vec2(0.0));
    return cell.area * kd_camera_seen(cell.d).steps;
}

#endif
