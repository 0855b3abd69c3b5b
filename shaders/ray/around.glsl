/* Wrap-around of a picture of all directions (KD_SIGHT_SPHERE). Beyond its left and right edges the picture continues
 * at the opposite edge. Beyond the upper and lower edges it continues at the same edge, half a turn further on. Needs
 * camera.glsl. */
#ifndef KD_AROUND_GLSL
#define KD_AROUND_GLSL

/* Numbers of columns and rows of the whole picture: of rays if `side` is 1, of pixels if `side` is SIDE. */
ivec2 kd_around_size(uint side) { return ivec2(vec2(4.0, 2.0) / (vec2(cam.turn_x, cam.turn_y) * float(side)) + 0.5); }

/* Moves a place outside the picture, by up to a whole picture, into it. If the number of columns is odd, the result is
 * wrong by half a column for a place beyond a pole. */
ivec2 kd_around(ivec2 at, ivec2 size)
{
    bool over = at.y < 0 || at.y >= size.y;
    at.y = at.y < 0 ? -1 - at.y : over ? 2 * size.y - 1 - at.y : at.y;
    at.x += over ? size.x / 2 : 0;
    at.x += at.x < 0 ? size.x : at.x >= size.x ? -size.x : 0;
    return at;
}

/* Converts a place next to a ray of the current map to the equivalent place in the map. Returns (-1, -1) if the map
 * does not contain it. */
ivec2 kd_around_neighbour(ivec2 at)
{
    if (SIGHT == KD_SIGHT_SPHERE && !AT_RIM) {
        ivec2 first = ivec2(push.column0, push.row0);
        at = kd_around(at + first, kd_around_size(1u)) - first;
    }
    bool inside = at.x >= 0 && at.x < int(push.width) && at.y >= 0 && at.y < int(push.rows);
    return inside ? at : ivec2(-1);
}

#endif
