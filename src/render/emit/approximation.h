/* An approximation is what a picture leaves out or chooses. Constant data.
 *
 * Its name is short and stable, for headers and programs: "disk.thin". Names differ from each other, and all of them
 * together fit into the header of an answer (tests/unit/emitters.c). */
#ifndef KD_RENDER_EMIT_APPROXIMATION_H
#define KD_RENDER_EMIT_APPROXIMATION_H

struct kd_approximation { const char *name, *text; /* text: a sentence */ };

#endif
