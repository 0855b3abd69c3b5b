/* This is where rays by their places stand: the nodes of a lens map between which it is interpolated, and the rays that
 * are followed alone (comp/lens_cells.comp makes both lists). */
#ifndef KD_PLACES_GLSL
#define KD_PLACES_GLSL

/* How many rays a stage has. */
uint kd_stage_count(uint stage) { return words[4u * stage + 3u]; }

/* The number of its first node. */
uint kd_stage_first(uint stage)
{
    uint first = 0u;
    for (uint i = 0u; i < stage; i++)
        first += kd_stage_count(i);
    return first;
}

#endif
