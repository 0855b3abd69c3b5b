/* Layout of the planes of a lens map. Needs the specialisation constants QUANTITIES and ORDERS. */
#ifndef KD_PLANES_GLSL
#define KD_PLANES_GLSL

#include "shared/lens.h"

/* Index of the first plane of a quantity, as kd_lens_plane of src/render/view/layout.h computes it. The value is
 * constant after specialisation. */
uint kd_plane(uint quantity)
{
    uint before = QUANTITIES & (quantity - 1u);
    return uint(bitCount(before & KD_LENS_CROSSINGS)) * ORDERS + uint(bitCount(before & ~KD_LENS_CROSSINGS));
}

/* Number of all planes. */
uint kd_planes_of_all()
{
    return uint(bitCount(QUANTITIES & KD_LENS_CROSSINGS)) * ORDERS + uint(bitCount(QUANTITIES & ~KD_LENS_CROSSINGS));
}

#endif
