/* Light: from the lens map to linear sRGB radiance, front to back over the image orders.
 *
 * A disk element at radius r shines as a black body of temperature T(r). Liouville: I_nu/nu^3 is constant along the ray,
 * so that it is seen as a black body of g T, its bolometric intensity g^4 F / pi. With
 *   g = nu_obs / nu_em = 1 / (u^t (E - Omega L)),   E, L per unit of energy that the observer measures,
 *   u^t = (1 + a r^-3/2) / sqrt(1 - 3/r + 2a r^-3/2),   Omega = 1/(r^3/2 + a)      (Bardeen, Press & Teukolsky 1972).
 * Radiance is in units of the brightest surface brightness of the disk at g = 1. */
#version 450
#extension GL_GOOGLE_include_directive : require
#include "shared/interface.h"
#include "shared/math.glsl"
#include "ray/kerr_ray.glsl"

layout(constant_id = 0) const uint ORDERS = 3;
layout(constant_id = 1) const uint SIDE = 1; /* rays along each side of a pixel */
layout(constant_id = 2) const bool FINITE = false;
layout(constant_id = 3) const bool DISK = true;
layout(constant_id = 4) const bool SKY = false;
layout(constant_id = 5) const uint SKY_PLANE = 3;
layout(constant_id = 6) const bool DOPPLER = true;
layout(constant_id = 7) const bool REDSHIFT = true;
layout(constant_id = 8) const bool VISIBLE = false; /* brightness as the eye weighs it instead of bolometric */
layout(constant_id = 9) const bool OPAQUE = true;   /* the first crossing that meets the disk ends the ray */
layout(constant_id = 10) const bool RING = false;   /* rays are not on the camera's grid: the map holds alpha */
layout(constant_id = 11) const uint ALPHA_PLANE = 0;
layout(constant_id = 12) const bool PARTICLES = false; /* the grid of particles modulates the light */
layout(constant_id = 13) const bool SLOW = false; /* particles and spots as they were when the light left them */
layout(constant_id = 14) const uint SPOTS = 0;    /* hot spots that are on */
layout(constant_id = 15) const bool RINGDOWN = false; /* the hole was struck: image orders 1 and up ring */
layout(constant_id = 16) const bool PLUNGE = false; /* some particles fall from the ISCO; the map holds w' */
layout(constant_id = 17) const uint CRITICAL = 0; /* rays of each listed pixel; 0: the picture's grid */
layout(constant_id = 18) const uint GENERATOR = 1; /* of the lattice that they are on */
layout(constant_id = 19) const uint SHIFT = 0;
layout(local_size_x = KD_GROUP_SIZE) in;

#define F(name) float name;
#define U(name) uint name;
layout(push_constant) uniform Camera { KD_CAMERA_FIELDS_(F, U) } cam;
layout(set = 0, binding = 0) readonly buffer LensMap { float lens[]; };
struct kd_transfer { KD_TRANSFER_FIELDS_(F, U) };
struct kd_spot_block { KD_SPOT_FIELDS_(F, U) };
layout(set = 0, binding = 1) readonly buffer Transfer {
    kd_transfer header;
    float pad[KD_TRANSFER_HEADER - 32];
    kd_spot_block spots[KD_SPOT_MAX];
    float disk_table[KD_DISK_TABLE];
    vec4 colour_table[KD_COLOUR_TABLE];
    vec2 plunge_table[KD_PLUNGE_TABLE];
} tables;
kd_transfer tr; /* tables.header, read once: lavapipe reads a storage buffer anew for each lane and each use */
layout(set = 0, binding = 2) writeonly buffer Radiance { float radiance[]; };
layout(set = 0, binding = 3) readonly buffer Density { float density[]; };
#include "ray/camera.glsl"
#include "ray/place.glsl"

/* Nothing in the sky has this colour: a ray that was given up is not painted as if it had finished. */
const vec3 UNDECIDED = vec3(1.0, 0.0, 1.0);

/* g of gas on the circular orbit at r = 1/w, outside the ISCO, for the ray's constants. */
float shift(float w, float energy, float momentum)
{
    /* 1 - 3/r + 2a r^-3/2 = ((x - 1)^2 (x + 2) - 2 (1 - a)) / x^3 with x = sqrt(r): near the ISCO of a fast hole the left-hand
     * side has no digits left. */
    float r = 1.0 / w, g = 1.0, x = sqrt(r), x3 = r * x, d = (1.0 - w) / (w * (x + 1.0));
    precise float rest = d * d * (x + 2.0) - 2.0 * tr.one_minus_a;
    if (REDSHIFT)
        g *= sqrt(max(rest * x3, 0.0)) / (x3 + cam.spin);
    if (DOPPLER)
        g /= energy - momentum / (x3 + cam.spin);
    else if (FINITE)
        g /= energy;
    return g;
}

/* Of a black body at this log2 of its temperature: linear sRGB of luminance 1, and log2 of the luminous fraction over its value
 * at T_peak. */
vec4 colour(float log_t)
{
    float place = (log_t - KD_COLOUR_LOG_MIN) * (float(KD_COLOUR_TABLE - 1) / (KD_COLOUR_LOG_MAX - KD_COLOUR_LOG_MIN));
    place = clamp(place, 0.0, float(KD_COLOUR_TABLE - 1));
    uint k = min(uint(place), KD_COLOUR_TABLE - 2);
    return mix(tables.colour_table[k], tables.colour_table[k + 1], place - float(k));
}

/* A black body of t, over the disk's largest temperature. */
vec3 black_body(float t)
{
    vec4 c = colour(tr.log_t_peak + log2(max(t, 1e-20)));
    float t4 = t * t * t * t;
    return c.rgb * (VISIBLE ? t4 * exp2(c.w) : t4);
}

/* What shines at a crossing: its temperature over the disk's largest, as it is seen, and its opacity. */
struct kd_gas { float t, alpha; };

/* The disk at w = 1/r, seen with the ray's constants. */
kd_gas disk_gas(float w, float energy, float momentum)
{
    float r = 1.0 / w;
    if (r < tr.r_in || r > tr.r_out)
        return kd_gas(0.0, 0.0);
    float y = sqrt(max(1.0 - tr.r_isco * w, 0.0)) * float(KD_DISK_TABLE - 1);
    uint i = min(uint(y), KD_DISK_TABLE - 2);
    float t = mix(tables.disk_table[i], tables.disk_table[i + 1], y - float(i)); /* T r^(3/4) over T_peak */
    float w34 = sqrt(w * sqrt(w));
    t *= w34 * shift(w, energy, momentum);

    /* The outer fade: 1 inside, 0 at r_out, with vanishing slope at both ends. */
    float f = clamp((tr.r_out - r) / max(tr.r_out - tr.taper_r, 1e-6), 0.0, 1.0);
    float fade = f * f * (3.0 - 2.0 * f);
    return kd_gas(t, tr.opacity * fade);
}

/* A place on one of the grids, which begins at node `first`: its row, and its azimuth in turns on the row before and the one
 * after. */
struct kd_place { uint first, rows, columns; float row, before, after; };

/* Of the disk. What goes round with a row's Omega was at `turn` a time `ago`, and is ahead now. */
float ahead(uint row, float ago)
{
    float r = tr.r_in * exp2(float(row) / tr.rows_octave);
    return ago * (0.5 / KD_PI) / (r * sqrt(r) + cam.spin);
}

kd_place disk_place(float w, float turn, float ago)
{
    float row = clamp(-log2(w * tr.r_in) * tr.rows_octave, 0.0, float(tr.rows));
    kd_place o = kd_place(0, tr.rows, tr.columns, row, turn, turn);
    if (SLOW) {
        uint i = min(uint(row), tr.rows - 1);
        o.before += ahead(i, ago);
        o.after += ahead(i + 1, ago);
    }
    return o;
}

float density_of_row(kd_place at, uint row, float turn)
{
    float column = (turn - floor(turn)) * float(at.columns);
    uint j = uint(column), first = at.first + row * at.columns;
    return mix(density[first + (j & (at.columns - 1))], density[first + ((j + 1) & (at.columns - 1))], column - float(j));
}

/* Particles over the number expected: bilinear between the nodes. */
float density_at(kd_place at)
{
    uint i = min(uint(at.row), at.rows - 1);
    return mix(density_of_row(at, i, at.before), density_of_row(at, i + 1, at.after), at.row - float(i));
}

#include "emit/plunge.glsl"

/* Hot spots at w = 1/r and this azimuth, whose light left them so long before that which shows spots[].phi; alpha: its luminance.
 * The gas of each place shines, with the g of its own orbit: the figure goes round with its centre, what it is made of shears.
 * I_nu/nu^3 is constant along the ray: I_nu ~ nu^-index is seen times g^(3 + index). Such spots, but as spheres in a hot flow:
 * A. E. Broderick & A. Loeb 2006, MNRAS 367, 905. */
vec4 spot_light(float w, float phi, float ago, float energy, float momentum)
{
    vec4 sum = vec4(0.0);
    float r = 1.0 / w;
    if (r < tr.r_isco)
        return sum;
    for (uint i = 0; i < SPOTS; i++) {
        kd_spot_block spot = tables.spots[i];
        float s = kd_cos_sin(0.5 * (phi - spot.phi + (SLOW ? spot.omega * ago : 0.0))).s;
        float off = (r - spot.r) * (r - spot.r) + 4.0 * r * spot.r * s * s;
        if (off > spot.reach)
            continue;
        float log_g = log2(shift(w, energy, momentum));
        float light = spot.brightness * exp2(spot.power * log_g - spot.sharp * off);
        sum += light * vec4(colour(spot.log_t + log_g).rgb, 1.0);
    }
    return sum;
}

/* A celestial sphere: four quadrants in quiet colours, meridians and parallels in white. The line's width is a fortieth of
 * the spacing. */
vec3 sky_light(uint at)
{
    float fate = lens[at + 2 * cam.stride];
    if (fate != KD_FATE_ESCAPED)
        return fate == KD_FATE_UNDECIDED ? UNDECIDED : vec3(0.0);
    float u = lens[at], phi = lens[at + cam.stride] + tr.azimuth;
    float latitude = atan(u, sqrt(max(1.0 - u * u, 0.0)));
    float longitude = phi - 2.0 * KD_PI * floor(phi / (2.0 * KD_PI));
    vec2 q = vec2(longitude, latitude) / tr.sky_grid;
    vec2 d = abs(q - floor(q + 0.5));
    d.x *= sqrt(max(1.0 - u * u, 0.0)); /* meridians keep their width towards the pole */
    float line = min(d.x, d.y) < 0.025 ? 1.0 : 0.0;
    vec3 base = longitude < KD_PI ? (u > 0.0 ? vec3(0.10, 0.22, 0.55) : vec3(0.08, 0.38, 0.26))
                                         : (u > 0.0 ? vec3(0.45, 0.16, 0.30) : vec3(0.48, 0.33, 0.08));
    return tr.sky_brightness * mix(base, vec3(1.0), line);
}

void main()
{
    tr = tables.header;
    uint px = gl_GlobalInvocationID.x, py = cam.row0 / SIDE + gl_WorkGroupID.y, listed = 0;
    if (px >= (CRITICAL > 0 ? cam.rows : tr.pixels_x))
        return;
    if (CRITICAL > 0) {
        listed = cam.row0 + px;
        uvec2 pixel = kd_listed_pixel(listed);
        px = pixel.x;
        py = pixel.y;
    }
    vec3 sum = vec3(0.0);
    float spots = 0.0;
    const uint rays = CRITICAL > 0 ? CRITICAL : SIDE * SIDE;
    for (uint i = 0; i < rays; i++) {
        uint at;
        uvec2 step_;
        if (CRITICAL > 0) {
            at = listed * CRITICAL + i;
            step_ = kd_critical_place(uvec2(px, py), i);
        } else {
            step_ = uvec2(px, py) * SIDE + uvec2(i % SIDE, i / SIDE);
            at = (step_.y - cam.band0) * cam.width + step_.x;
        }
        float energy = 1.0, momentum = 0.0;
        if ((DISK || SPOTS > 0) && (DOPPLER || FINITE)) {
            kd_ray ray = kd_camera_ray(step_.x, step_.y);
            energy = ray.e;
            momentum = (RING ? -lens[at + ALPHA_PLANE * cam.stride] : ray.l) * cam.s;
        }
        vec3 light = vec3(0.0);
        float through = 1.0; /* what the gas in front lets pass */
        if (DISK || SPOTS > 0) {
            for (uint n = 0; n < ORDERS; n++) {
                float w = lens[at + n * cam.stride];
                if (w < 0.0) { /* given up here */
                    light += through * UNDECIDED;
                    through = 0.0;
                }
                if (w <= 0.0)
                    break;
                kd_gas gas = kd_gas(0.0, 0.0);
                if (DISK)
                    gas = disk_gas(w, energy, momentum);
                float phi = PARTICLES || SPOTS > 0 ? lens[at + (ORDERS + n) * cam.stride] : 0.0;
                float ago = SLOW ? lens[at + (2 * ORDERS + n) * cam.stride] - tr.delay : 0.0;
                float number = 1.0; /* of particles, over that expected */
                if (PARTICLES) {
                    float turn = (phi + tr.azimuth) * (0.5 / KD_PI);
                    kd_place place = disk_place(w, turn, ago);
                    bool falls = PLUNGE && w >= tr.plunge_first && w <= tr.plunge_last;
                    if (falls)
                        place = plunge_place(w, turn, ago);
                    number = density_at(place);
                    if (falls) {
                        gas = plunge_gas(w, lens[at + ((SLOW ? 3 : 2) * ORDERS + n) * cam.stride], energy, momentum, number);
                        number = 1.0;
                    }
                }
                float seen = RINGDOWN && n > 0 ? through * tr.ringing : through;
                light += seen * gas.alpha * number * black_body(gas.t);
                if (SPOTS > 0) { /* in the gas: its own element does not hide it */
                    vec4 spot = seen * spot_light(w, phi, ago, energy, momentum);
                    light += spot.rgb;
                    spots += spot.a;
                }
                through *= 1.0 - gas.alpha;
                if (OPAQUE && through <= 0.0)
                    break;
            }
        }
        if (SKY)
            light += through * sky_light(at + SKY_PLANE * cam.stride);
        sum += light;
    }
    float share = 1.0 / float(rays);
    uint o = (py - (CRITICAL > 0 ? cam.band0 : cam.band0 / SIDE)) * tr.pixels_x + px;
    radiance[3 * o] = share * sum.r;
    radiance[3 * o + 1] = share * sum.g;
    radiance[3 * o + 2] = share * sum.b;
    if (SPOTS > 0) /* behind the band's pixels */
        radiance[3 * tr.band_pixels + o] = share * spots;
}
