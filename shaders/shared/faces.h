/* The sphere is divided into cells by the six faces of a cube about it, each a grid. A direction belongs to the face of its largest component, where
 * it has a place (p, q) in [-1, 1]: the two others over that one. Each face goes on beyond its edges, to KD_FACE_EDGE, so that what lies near a
 * direction lies on the direction's own face: stars are on up to three of them. */
#ifndef KD_FACES_GLSL
#define KD_FACES_GLSL

#define KD_FACE_EDGE 1.5
#define KD_FACE_CELLS 192 /* along a side, edges included */
#define KD_FACES 6

#ifdef VULKAN
struct kd_face { int number; float p, q; };

kd_face kd_face_of(vec3 n)
{
    vec3 a = abs(n);
    bool x = a.x >= a.y && a.x >= a.z, y = !x && a.y >= a.z;
    float along = x ? n.x : y ? n.y : n.z, unit = 1.0 / abs(along);
    return kd_face((x ? 0 : y ? 2 : 4) + (along < 0.0 ? 1 : 0), (x ? n.y : y ? n.z : n.x) * unit, (x ? n.z : y ? n.x : n.y) * unit);
}

ivec2 kd_face_cell(float p, float q)
{
    vec2 at = (vec2(p, q) + KD_FACE_EDGE) * (float(KD_FACE_CELLS) / (2.0 * KD_FACE_EDGE));
    return ivec2(clamp(at, vec2(0.0), vec2(float(KD_FACE_CELLS - 1))));
}
#endif

#endif
