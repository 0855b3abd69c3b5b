/* The quantities of a lens map, in the order of their planes. The quantities of a crossing come first, and have a plane
 * for each image order. The quantities of a ray follow, and have one plane. A set of bits says which quantities a map
 * holds. C and GLSL expand both lists.
 *
 *   W        1/r of the crossing; 0: there is none; negative: the ray was given up on the way to it
 *   PHI      azimuth of the crossing, source minus observer, radians
 *   DELAY    delay of light, t_observed - t_emitted, M (minus r_o + 2 ln r_o at infinity)
 *   SLOPE    w', in Mino time, of the ray traced back
 *   FOOTPRINT  size of a ray's footprint on the disk, M: the distance of the crossings, in (r, r phi), of rays one step
 *            of the camera apart, along the direction in which it is largest (comp/footprint.comp)
 *   SHAPE    shape of the ellipse whose long axis FOOTPRINT is, as 1 + (i + 2048 j)/2^23: of M = J J^T, J from steps of
 *            the camera to (r, r phi), i/2047 = M_rr/(M_rr + M_ff) and j/2047 = (1 + M_rf/sqrt(M_rr M_ff))/2
 *   ALPHA    impact parameter of the ray, M, if rays are not on the camera's grid
 *   SKY_U    cosine of the polar angle of the direction in which the ray escapes
 *   SKY_PHI  azimuth of that direction, source minus observer, radians
 *   FATE     KD_FATE_... of interface.h
 *   SKY_FOOTPRINT  size of a ray's footprint on the sky, radians
 *
 * Shapes need footprints. Footprints need W and PHI, or SKY_U, SKY_PHI and FATE. The footprint of a ray without
 * neighbours is KD_FOOTPRINT_EDGE. */
#ifndef KD_LENS_H
#define KD_LENS_H

#define KD_LENS_OF_CROSSINGS(Q) Q(0, W) Q(1, PHI) Q(2, DELAY) Q(3, SLOPE) Q(4, FOOTPRINT) Q(5, SHAPE)
#define KD_LENS_OF_RAYS(Q) Q(6, ALPHA) Q(7, SKY_U) Q(8, SKY_PHI) Q(9, FATE) Q(10, SKY_FOOTPRINT)

#ifdef VULKAN /* GLSL */
#define Q(number, name) const uint KD_LENS_##name = 1u << number;
KD_LENS_OF_CROSSINGS(Q)
KD_LENS_OF_RAYS(Q)
#undef Q
#else
#define Q(number, name) KD_LENS_##name = 1 << number,
enum { KD_LENS_OF_CROSSINGS(Q) KD_LENS_OF_RAYS(Q) };
#undef Q
#endif

#define Q(number, name) | (1u << number)
#ifdef VULKAN
const uint KD_LENS_CROSSINGS = 0u KD_LENS_OF_CROSSINGS(Q);
#else
enum { KD_LENS_CROSSINGS = 0u KD_LENS_OF_CROSSINGS(Q) };
#endif
#undef Q

#ifdef VULKAN
#define KD_LENS_SKY (KD_LENS_SKY_U | KD_LENS_SKY_PHI | KD_LENS_FATE)
#else
enum { KD_LENS_SKY = KD_LENS_SKY_U | KD_LENS_SKY_PHI | KD_LENS_FATE };
#endif

#endif
