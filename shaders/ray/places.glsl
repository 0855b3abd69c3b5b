/* Lists of rays by place: the nodes of an interpolated lens map, and the rays that are traced singly
 * (comp/lens_cells.comp makes both lists). */
#ifndef KD_PLACES_GLSL
#define KD_PLACES_GLSL

/* A place packed in one word, with KD_PLACE_BITS bits for x. Places count from the first block's first ray. */
uint kd_place_word(uvec2 at) { return at.x | at.y << KD_PLACE_BITS; }
uvec2 kd_place_at(uint word) { return uvec2(word & ((1u << KD_PLACE_BITS) - 1u), word >> KD_PLACE_BITS); }

uint kd_stage_count(uint stage) { return words[4u * stage + 3u]; }

/* Number of the first node that a stage traces. */
uint kd_stage_first(uint stage)
{
    uint first = 0u;
    for (uint i = 0u; i < stage; i++)
        first += kd_stage_count(i);
    return first;
}

#endif
