/* Division of the sphere into cells. The sphere is projected on the six faces of a cube, and each face has a grid of
 * cells. A direction belongs to the face of its largest component. Its place on the face is (p, q) in [-1, 1]: its
 * other two components divided by the largest. The grid of a face extends beyond the face's edges to KD_FACE_EDGE, so
 * that the neighbourhood of a direction is always on one face. A star is therefore on up to three faces. */
#ifndef KD_FACES_GLSL
#define KD_FACES_GLSL

#define KD_FACE_EDGE 1.5
#define KD_FACE_FINE 192 /* number of fine cells along a side, edges included; all stars are sorted into fine cells */
/* number of coarse cells along a side. All stars are sorted into coarse cells as well, for wide searches of bright
 * stars */
#define KD_FACE_COARSE 32
#define KD_FACE_FAR 0.06 /* a search that extends this far on a face, or further, counts as wide */
#define KD_FACES 6
/* number of words of a table: the start of each cell, and two words with the end of the last cell */
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

/* The place (p, q) of a direction on a face. The face's normal must make an acute angle with the direction. */
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
