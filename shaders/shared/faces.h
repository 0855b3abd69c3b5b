/* Division of the sphere into cells: the six faces of a cube, each with a grid. A direction belongs to the face of its
 * largest component. Its place there is (p, q) in [-1, 1], the other two components divided by the largest. Each face
 * extends beyond its edges to KD_FACE_EDGE, so that the neighbourhood of a direction is on the direction's own face.
 * A star is therefore on up to three faces. */
#ifndef KD_FACES_GLSL
#define KD_FACES_GLSL

#define KD_FACE_EDGE 1.5
#define KD_FACE_FINE 192 /* fine cells along a side, edges included; all stars are sorted into fine cells */
/* coarse cells along a side; all stars are also sorted into these, for wide searches and for bright stars only */
#define KD_FACE_COARSE 32
#define KD_FACE_FAR 0.06 /* distance on a face from which a search counts as wide */
#define KD_FACES 6
/* words of a table: the start of each cell, and two words with the end of the last cell */
#define KD_FACE_TABLE(side) (KD_FACES * (side) * (side) + 2)

#ifdef VULKAN
struct kd_face {
    uint number;
    float p, q;
};

kd_face kd_face_of(vec3 n)
{
    vec3 a = abs(n);
    bool x = a.x >= a.y && a.x >= a.z, y = !x && a.y >= a.z;
    float along = x ? n.x : y ? n.y : n.z, unit = 1.0 / abs(along);
    return kd_face((x   ? 0u
                    : y ? 2u
                        : 4u) +
                       (along < 0.0 ? 1u : 0u),
                   (x   ? n.y
                    : y ? n.z
                        : n.x) *
                       unit,
                   (x   ? n.z
                    : y ? n.x
                        : n.y) *
                       unit);
}

/* The place of a direction on a face whose normal makes an acute angle with it. */
vec2 kd_face_place(uint face, vec3 n)
{
    float unit = 1.0 / abs(face < 2u ? n.x : face < 4u ? n.y : n.z);
    return vec2(face < 2u ? n.y : face < 4u ? n.z : n.x, face < 2u ? n.z : face < 4u ? n.x : n.y) * unit;
}

ivec2 kd_face_cell(float p, float q, float side)
{
    vec2 at = (vec2(p, q) + KD_FACE_EDGE) * (side * (1.0 / (2.0 * KD_FACE_EDGE)));
    return ivec2(clamp(at, vec2(0.0), vec2(side - 1.0)));
}
#endif

#endif
