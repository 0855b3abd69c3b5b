/* Spreads the light of a star's image over 3 x 3 pixels, as a quadratic B-spline with a standard deviation of half a
 * pixel. The weights add up to 1, and their centre is the image's place. Light is summed in 64-bit fixed point, so that
 * the sum does not depend on the order. The buffer has the binding KD_STAR_LIGHT_BINDING. This file needs around.glsl.
 */
#ifndef KD_STAR_LIGHT_GLSL
#define KD_STAR_LIGHT_GLSL

layout(set = 0, binding = KD_STAR_LIGHT_BINDING) buffer PointLight { uint point_light[]; };

void kd_star_add(uint o, float light)
{
    float whole = floor(light * (KD_STAR_UNIT / 4294967296.0));
    uint low = uint(light * KD_STAR_UNIT - whole * 4294967296.0), high = uint(whole);
    uint was = atomicAdd(point_light[o], low);
    high += was + low < was ? 1u : 0u;
    if (high > 0u)
        atomicAdd(point_light[o + 1u], high);
}

/* Weights of three pixels in a line, for a place at the distance d from the centre of the middle one. */
vec3 kd_star_weights(float d) { return vec3(0.5 * (0.5 - d) * (0.5 - d), 0.75 - d * d, 0.5 * (0.5 + d) * (0.5 + d)); }

/* Solid angle of a pixel in a row, relative to a pixel at the equator, for a picture of all directions. */
float kd_star_level(float row, float rows) { return abs(sin(KD_PI * (row + 0.5) / rows)); }

/* Spreads the light of an image. place: in pixels of the picture. light: the mean radiance of a pixel centred there.
 * Near the poles of a picture of all directions adjacent rows have different solid angles. The weights are corrected
 * for this difference: the sum of light times solid angle over all pixels is the same as if one pixel, centred at the
 * place, had all the light. */
void kd_star_spread(vec2 place, vec3 light)
{
    vec2 middle = floor(place + 0.5);
    vec3 wx = kd_star_weights(place.x - middle.x), wy = kd_star_weights(place.y - middle.y);
    int pixels_x = int(emission.frame.pixels_x), pixels_y = int(push.pixels_y);
    ivec2 size = ivec2(0);
    if (SIGHT == KD_SIGHT_SPHERE) {
        size = kd_around_size(SIDE);
        float rows = float(size.y);
        vec3 levels = vec3(kd_star_level(middle.y - 1.0, rows), kd_star_level(middle.y, rows),
                           kd_star_level(middle.y + 1.0, rows));
        light *= kd_star_level(place.y, rows) / dot(wy, levels);
    }
    int k = 0;
    [[dont_unroll]] do { /* this loop tests at its end, for the reason given in lens_closed.comp */
        int r = k / 3, c = k - 3 * r;
        ivec2 at = ivec2(middle) + ivec2(c, r) - 1;
        if (SIGHT == KD_SIGHT_SPHERE)
            at = kd_around(at, size);
        at += ivec2(push.rightward, push.up);
        if (at.x >= 0 && at.x < pixels_x && at.y >= 0 && at.y < pixels_y) {
            uint o = KD_STAR_LIGHT * uint(at.y * pixels_x + at.x);
            vec3 part = min((r == 0   ? wy.x
                             : r == 1 ? wy.y
                                      : wy.z) *
                                (c == 0   ? wx.x
                                 : c == 1 ? wx.y
                                          : wx.z) *
                                light,
                            vec3(1e9));
            kd_star_add(o, part.r);
            kd_star_add(o + 2u, part.g);
            kd_star_add(o + 4u, part.b);
        }
    } while (++k < 9);
}

#endif
